"""Instants within phases where a quantity of a motion changes its sign, or is the largest.

Between kinks a quantity is smooth in a part of a phase, and the polynomial through its values there is as good as the
quadrature of the same nodes: nothing is computed again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from ballscrew.axis.motion.states import MotionStates, Numbers

#: Values below this share of the largest are rounding; a largest value that is so little above those at the nodes, too.
_ROUNDING, _GAIN = 1e-12, 1e-7


def sign_changes(states: MotionStates, values: Numbers) -> list[float]:
    """The instants within phases at which a quantity changes its sign, s; ``values`` is it at the states."""
    result: list[float] = []
    known = np.abs(values[np.isfinite(values)])
    least = _ROUNDING * float(np.max(known, initial=0.0))
    for time, own in _parts(states, values):
        seen = np.flatnonzero(np.abs(own) > least)
        sign = np.sign(own[seen])
        for at in np.flatnonzero(sign[1:] != sign[:-1]):
            ends = float(time[seen[at]]), float(time[seen[at + 1]])
            root: Any = brentq(_through(time, own), *ends, xtol=1e-14 * (ends[1] - ends[0]))
            result.append(float(root))
    return result


def largest_within(states: MotionStates, values: Numbers) -> list[float]:
    """The instants at which a quantity is larger than at all states of its part of a phase, and than zero, s."""
    result: list[float] = []
    for time, own in _parts(states, values):
        at = int(np.argmax(own))
        if not 0 < at < own.size - 1 or not own[at] > 0 or not np.ptp(own) > _GAIN * own[at]:
            continue
        near = 1e-7 * (time[at + 1] - time[at - 1])
        best: Any = minimize_scalar(
            _through(time, -own), bounds=(time[at - 1], time[at + 1]), method="bounded", options={"xatol": near}
        )
        if -best.fun > own[at] * (1 + _GAIN):
            result.append(float(best.x))
    return result


def _parts(states: MotionStates, values: Numbers) -> Iterator[tuple[Numbers, Numbers]]:
    """Times and values in each part of a phase in which all of them are known, and the times differ in their digits."""
    for part in states.parts:
        time = states.time[part]
        if np.isfinite(values[part]).all() and np.all(np.diff(time) > 0):
            yield time, values[part]


def _through(time: Numbers, values: Numbers) -> Callable[[float], float]:
    """The polynomial through values by time, in its barycentric form; SciPy's has its nodes in a random order."""
    scale = 4.0 / (time[-1] - time[0])  # with which products of many gaps stay near one
    gaps = scale * (time[:, None] - time)
    np.fill_diagonal(gaps, 1.0)
    weights = 1.0 / np.prod(gaps, axis=1)

    def through(at: float) -> float:
        away = scale * (at - time)
        if not np.all(away):
            return float(values[np.argmin(np.abs(away))])
        shares = weights / away
        return float(shares @ values / np.sum(shares))

    return through
