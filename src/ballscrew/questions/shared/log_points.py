"""Points of logs for pictures: so many of their rows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]


def some(places: NDArray[np.int64], most: int) -> NDArray[np.int64]:
    """At most so many of some rows, the same each time."""
    return places if places.size <= most else np.random.default_rng(0).choice(places, most, replace=False)
