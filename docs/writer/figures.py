"""Figures compared: another processor may turn the last digit of a coordinate, which nobody sees."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

#: By how much a coordinate of a figure may differ, in points; and the pixels of a picture, root of the mean square of
#: levels from 0 to 255.
COORDINATES, PIXELS = 0.02, 1.0
_DIGITS = re.compile(rb"-?\d+\.?\d*(?:e[+-]?\d+)?")


def same(before: Path, now: Path) -> bool:
    """Whether two files show the same figure."""
    if not before.is_file():
        return False
    first, second = before.read_bytes(), now.read_bytes()
    if first == second:
        return True
    if now.suffix == ".svg":
        return _same_drawing(first, second)
    return now.suffix == ".png" and _same_picture(before, now)


def _same_drawing(first: bytes, second: bytes) -> bool:
    if _DIGITS.sub(b"0", first) != _DIGITS.sub(b"0", second):
        return False
    one, other = (np.array([float(x) for x in _DIGITS.findall(text)]) for text in (first, second))
    return bool(np.all(np.abs(one - other) <= COORDINATES))


def _same_picture(before: Path, now: Path) -> bool:
    import matplotlib.image

    first, second = (255 * matplotlib.image.imread(path) for path in (before, now))
    return first.shape == second.shape and bool(np.sqrt(np.mean((first - second) ** 2)) <= PIXELS)
