"""Texts and figures compared: another processor turns the last of sixteen digits, and nobody sees it in a figure."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

#: By how much a number of a text may differ, relative to it, or at all: that of a difference which rounding makes.
RELATIVE, ROUNDING = 1e-9, 1e-12
#: By how much a coordinate of a figure may differ, in points; and the pixels of a picture, root of the mean square of
#: levels from 0 to 255.
COORDINATES, PIXELS = 0.02, 1.0
_NUMBER = re.compile(r"(?<![\w#.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w.])")
#: Names of parts of a drawing: matplotlib makes those of clip paths from all digits of their coordinates.
_NAMED = re.compile(r'\bid="([^"]+)"')


def same_text(before: str, now: str) -> bool:
    """Whether two texts have the same words, and the same numbers but for rounding."""
    if _NUMBER.sub("0", before) != _NUMBER.sub("0", now):
        return False
    first, second = (np.array(_NUMBER.findall(text), dtype=float) for text in (before, now))
    return bool(np.allclose(first, second, rtol=RELATIVE, atol=ROUNDING))


def same_figure(before: Path, now: Path) -> bool:
    """Whether two files show the same figure."""
    if not before.is_file():
        return False
    first, second = before.read_bytes(), now.read_bytes()
    if first == second:
        return True
    if now.suffix == ".svg":
        return _same_drawing(first, second)
    if now.suffix == ".pdf":
        return _words(before) == _words(now)
    return now.suffix == ".png" and _same_picture(before, now)


def _same_drawing(first: bytes, second: bytes) -> bool:
    one, other = _in_order(first.decode()), _in_order(second.decode())
    if _NUMBER.sub("0", one) != _NUMBER.sub("0", other):
        return False
    numbers = (np.array(_NUMBER.findall(text), dtype=float) for text in (one, other))
    return bool(np.all(np.abs(np.subtract(*numbers)) <= COORDINATES))


def _in_order(drawing: str) -> str:
    """A drawing whose parts are named by the order in which they come."""
    names = {name: f"part_{number}" for number, name in enumerate(dict.fromkeys(_NAMED.findall(drawing)))}
    return re.sub(
        r'(?P<before>\bid="|#)(?P<name>[\w-]+)', lambda at: at["before"] + names.get(at["name"], at["name"]), drawing
    )


def _same_picture(before: Path, now: Path) -> bool:
    import matplotlib.image

    first, second = (255 * matplotlib.image.imread(path) for path in (before, now))
    return first.shape == second.shape and bool(np.sqrt(np.mean((first - second) ** 2)) <= PIXELS)


def _words(document: Path) -> list[str]:
    """The text of a document, page by page: how its bytes are packed depends on libraries."""
    import pypdf

    return [page.extract_text() for page in pypdf.PdfReader(document).pages]
