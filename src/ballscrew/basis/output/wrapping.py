"""Lines for people, no longer than a terminal is wide."""

from __future__ import annotations

import textwrap
from collections.abc import Collection, Sequence

#: Columns of the widest line.
WIDTH = 120


def wrapped(line: str, indent: int = 4) -> str:
    """A line, broken between words if it is too long; what follows is indented."""
    return "\n".join(cut(line, WIDTH, indent)) if len(line) > WIDTH else line


def cut(text: str, width: int, indent: int = 0) -> list[str]:
    """The lines of a text; a word is never broken."""
    return textwrap.wrap(
        text, width, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False
    ) or [""]


def beside(prefix: str, words: str, narrowest: int = 20) -> str:
    """Words in a last column, which goes on below itself."""
    lines = cut(words, max(narrowest, WIDTH - len(prefix)))
    return "\n".join([(prefix + lines[0]).rstrip(), *(" " * len(prefix) + line for line in lines[1:])])


def aligned(lines: Sequence[Sequence[str]], of_text: Collection[int] = (0,), gap: int = 2) -> list[str]:
    """Cells in columns: those of text to the left, the others to the right."""
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]

    def one(line: Sequence[str]) -> str:
        cells = enumerate(zip(line, widths, strict=True))
        placed = [cell.ljust(width) if place in of_text else cell.rjust(width) for place, (cell, width) in cells]
        return (" " * gap).join(placed).rstrip()

    return [one(line) for line in lines]
