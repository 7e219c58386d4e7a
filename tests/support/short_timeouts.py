"""The program with a short timeout of reading, for tests that wait until it has passed."""

from ballscrew.faces.cli.main import main
from ballscrew.faces.web import bodies, connections

#: Seconds; what is served at once is served well within them, also on a busy machine.
READ_TIMEOUT = 4.0

if __name__ == "__main__":
    bodies.READ_TIMEOUT = connections.READ_TIMEOUT = READ_TIMEOUT
    main()
