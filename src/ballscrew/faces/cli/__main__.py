"""``python -m ballscrew.faces.cli``."""

from ballscrew.faces.cli.start import main

main()
