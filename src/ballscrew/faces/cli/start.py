"""The entry of the program: loads the commands, and ends with a line where that is interrupted."""

from __future__ import annotations

import sys

from ballscrew.faces.cli import INTERRUPTED


def main() -> None:
    """Load the commands and run one; Ctrl-C meanwhile ends with one line and exit code 130, without a traceback."""
    try:
        from ballscrew.faces.cli.main import main

        main()
    except KeyboardInterrupt:
        sys.exit(_interrupted())


def _interrupted() -> int:
    if sys.stderr is not None:  # pyright: ignore[reportUnnecessaryComparison]  (None where the stream is closed)
        sys.stderr.write("interrupted\n")
    return INTERRUPTED
