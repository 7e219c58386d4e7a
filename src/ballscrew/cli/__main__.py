"""``python -m ballscrew.cli``."""

from ballscrew.cli.main import main

main()
