"""Pareto fronts: which of many designs no other one beats in everything."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def front(costs: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether no other row is better, for each row of costs, all to be small.

    A row beats another that it is nowhere above and somewhere below; equal rows beat each other not. Rows with NaN are
    on no front.
    """
    values = np.zeros(len(costs), dtype=bool)
    known = np.flatnonzero(~np.isnan(costs).any(axis=1))
    # a row that beats another comes before it in the order of its columns, one after the other
    order = known[np.lexsort(costs[known].T[::-1])]
    kept: list[int] = []
    for place in order:
        best, row = costs[kept], costs[place]
        if not np.any((best <= row).all(axis=1) & (best < row).any(axis=1)):
            kept.append(int(place))
    values[kept] = True
    return values
