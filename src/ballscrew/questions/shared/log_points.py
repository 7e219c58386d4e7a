"""Points of logs for pictures: so many of their rows, with so many digits; SI."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
#: Points of a log in a document, and digits of each.
MOST_POINTS, DIGITS = 1500, 5


def some(places: NDArray[np.int64], most: int) -> NDArray[np.int64]:
    """At most so many of some rows, the same each time."""
    return places if places.size <= most else np.random.default_rng(0).choice(places, most, replace=False)


def short(values: Numbers) -> list[float]:
    """Numbers with as many digits as a picture shows."""
    return [float(f"{value:.{DIGITS}g}") for value in values]
