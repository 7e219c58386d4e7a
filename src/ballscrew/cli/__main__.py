"""``python -m ballscrew.cli``."""

from ballscrew.cli.start import main

main()
