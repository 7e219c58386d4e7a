"""Pareto fronts: which of many designs no other one beats in everything."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def fronts(costs: NDArray[np.float64]) -> NDArray[np.int64]:
    """The number of the front of each row of costs, all to be small: 0 where no other row is better.

    A row beats another that it is nowhere above and somewhere below. Front 1 is what is not beaten once front 0 is
    taken away, and so on (non-dominated sorting). Rows with NaN are in no front: -1.
    """
    found = np.full(len(costs), -1)
    left = np.flatnonzero(~np.isnan(costs).any(axis=1))
    number = 0
    while left.size:
        here = costs[left]
        beaten = np.array(
            [bool(np.any((here <= row).all(axis=1) & (here < row).any(axis=1))) for row in here], dtype=bool
        )
        found[left[~beaten]] = number
        left, number = left[beaten], number + 1
    return found


def hypervolume(costs: NDArray[np.float64], reference: NDArray[np.float64]) -> float:
    """The volume that rows of costs dominate below a reference point: larger is a better front.

    By slices along the last cost; exact for any number of costs, for fronts of some hundred rows.
    """
    inside = costs[(costs < reference).all(axis=1)]
    if not inside.size:
        return 0.0
    if costs.shape[1] == 1:
        return float(reference[0] - inside.min())
    order = np.argsort(inside[:, -1], kind="stable")
    inside = inside[order]
    ends = np.append(inside[1:, -1], reference[-1])
    total = 0.0
    for count, (row, end) in enumerate(zip(inside, ends, strict=True), start=1):
        if end > row[-1]:
            total += (end - row[-1]) * hypervolume(inside[:count, :-1], reference[:-1])
    return total
