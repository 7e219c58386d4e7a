"""Texts for people: within XML and HTML, in lines no longer than a terminal is wide, and with numbers written out."""

from __future__ import annotations

import html
import re
import textwrap
from collections.abc import Collection, Sequence

#: What may not stand in XML at all, not even escaped.
_FORBIDDEN = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def escaped(words: str) -> str:
    """Words as they stand between tags and in attributes."""
    return html.escape(_FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", words))


#: Columns of the widest line, and of the narrowest last column.
WIDTH, _NARROWEST = 120, 20


def wrapped(line: str, indent: int = 4) -> str:
    """A line, broken between words if it is too long; what follows is indented."""
    return "\n".join(cut(line, WIDTH, indent)) if len(line) > WIDTH else line


def cut(text: str, width: int, indent: int = 0) -> list[str]:
    """The lines of a text; a word is never broken."""
    return textwrap.wrap(
        text, width, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False
    ) or [""]


def beside(prefix: str, words: str) -> str:
    """Words in a last column, which goes on below itself."""
    lines = cut(words, max(_NARROWEST, WIDTH - len(prefix)))
    return "\n".join([(prefix + lines[0]).rstrip(), *(" " * len(prefix) + line for line in lines[1:])])


def aligned(lines: Sequence[Sequence[str]], of_text: Collection[int] = (0,)) -> list[str]:
    """Cells in columns: those of text to the left, the others to the right."""
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]

    def one(line: Sequence[str]) -> str:
        cells = enumerate(zip(line, widths, strict=True))
        placed = [cell.ljust(width) if place in of_text else cell.rjust(width) for place, (cell, width) in cells]
        return "  ".join(placed).rstrip()

    return [one(line) for line in lines]


#: A number as programs write it, such as 4.03e+08.
_WRITTEN_BY_PROGRAMS = re.compile(r"(?<![\w.])(?P<sign>[-\u2212]?)(?P<digits>\d+(?:\.\d+)?)e(?P<power>[+-]?\d+)(?!\w)")
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
#: From where on and up to where numbers are counted in millions; below which size they are not written out.
MILLIONS, _LARGEST, _SMALLEST = 1e7, 1e12, 1e-4


def plain(text: str) -> str:
    """A text with its numbers written out: ``4.03e+08`` is ``403 million``, ``1.5e-08`` is ``1.5 × 10⁻⁸``."""
    return _WRITTEN_BY_PROGRAMS.sub(_written_out, text)


def _written_out(match: re.Match[str]) -> str:
    digits, power = match["digits"], int(match["power"])
    size = float(f"{digits}e{power}")
    if size and not _SMALLEST <= size < _LARGEST:
        times = "" if digits == "1" else f"{digits} × "
        return f"{match['sign']}{times}10{str(power).translate(_SUPERSCRIPTS)}"
    if size >= MILLIONS:
        return f"{match['sign']}{size / 1e6:.10g} million"
    decimals = max(0, len(digits.partition(".")[2]) - power)
    return f"{match['sign']}{size:.{decimals}f}"
