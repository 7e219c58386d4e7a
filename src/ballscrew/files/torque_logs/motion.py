"""Motion of a log: derivatives of the speed at each row over windows of several widths, and the noise of the speed.

All of it is local, so that a log read piece by piece, with an overlap, gives the same numbers as one read whole.
"""

from __future__ import annotations

import dataclasses
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]

#: Widths of the windows on either side of a row, in rows: a slow log needs the narrowest, a fast and noisy one the
#: widest.
SCALES = (1, 4, 16, 64)
#: A step of time this much longer than both its neighbours is a gap, and nothing is differentiated across it.
_GAP = 10.0
#: Time that goes back begins a new run, if it goes back to where the run began and runs are this long on average.
SHORTEST_RUN = 5
#: This share of the rows lies below 1.036 standard deviations; up to three in ten may be corners of ramps.
_NOISE_SHARE, _NOISE_QUANTILE = 0.7, 1.0364
#: So many standard deviations are no noise.
CLEAR = 6.0


@dataclasses.dataclass(frozen=True, eq=False)
class Motion:
    """Changes of the speed at the rows of a log; arrays of shape (scales, rows), NaN where a window does not fit.

    ``bend`` is the distance of a speed from the line between its neighbours, scaled to the noise of one speed.
    """

    slope: Floats
    span: Floats
    bend: Floats

    def select(self, keep: NDArray[Any] | slice) -> Motion:
        """The motion of some of the rows."""
        return Motion(self.slope[:, keep], self.span[:, keep], self.bend[keep])

    def noise(self) -> float:
        """The standard deviation of one speed, rad/s; ramps and steps do not count, if they are the fewer."""
        known = np.abs(self.bend[np.isfinite(self.bend)])
        return float(np.quantile(known, _NOISE_SHARE)) / _NOISE_QUANTILE if known.size else 0.0

    def acceleration(self, least: float) -> tuple[Floats, Floats]:
        """Acceleration at each row and its standard deviation, rad/s²: of the narrowest window that can tell ``least``.

        Where that window does not fit between two gaps, a narrower one counts. NaN where no neighbour is known.
        """
        deviations = self.noise() * np.sqrt(2.0 / np.array(SCALES))[:, np.newaxis] / self.span
        wanted = len(SCALES) - 1
        for number, row in enumerate(deviations):
            known = row[np.isfinite(row)]
            if known.size and CLEAR * float(np.median(known)) <= least:
                wanted = number
                break
        slope, deviation = self.slope[wanted].copy(), deviations[wanted].copy()
        for number in range(wanted - 1, -1, -1):
            unknown = np.isnan(slope)
            slope[unknown], deviation[unknown] = self.slope[number][unknown], deviations[number][unknown]
        return slope, deviation


def joined(parts: list[Motion]) -> Motion:
    """The motion of rows that follow each other."""
    return Motion(
        np.concatenate([part.slope for part in parts], axis=1),
        np.concatenate([part.span for part in parts], axis=1),
        np.concatenate([part.bend for part in parts]),
    )


def runs_in(time: Floats) -> int | None:
    """Number of runs in a log, each with a time that does not go back; None if its rows are out of order."""
    drops = np.flatnonzero(np.diff(time) < 0) + 1
    starts = np.concatenate([[0], drops])
    restarts = time[drops] <= time[starts[:-1]]
    if restarts.all() and (not drops.size or time.size >= SHORTEST_RUN * starts.size):
        return int(starts.size)
    return None


def motion_of(time: Floats, speed: Floats) -> Motion:
    """Changes of the speed at each row of a log in order; rows of the same time count as one, with their mean speed.

    Across gaps, and where time goes back, nothing is differentiated.
    """
    if not time.size:
        return Motion(np.empty((len(SCALES), 0)), np.empty((len(SCALES), 0)), np.empty(0))
    new = np.concatenate([[True], np.diff(time) != 0])
    first = np.flatnonzero(new)
    t = time[first]
    w = np.add.reduceat(speed, first) / np.diff(np.append(first, time.size))
    left, right = _room(t)
    differences = [_differences(t, w, left, right, scale) for scale in SCALES]
    slope, span = np.stack([one[0] for one in differences]), np.stack([one[1] for one in differences])
    _one_sided(t, w, left, right, slope[0], span[0])
    motion = Motion(slope, span, _bend(t, w, left, right))
    return motion if first.size == time.size else motion.select(np.cumsum(new) - 1)


def _room(t: Floats) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Numbers of rows to the left and to the right of each before a gap or an end."""
    step = np.diff(t)
    known = np.maximum(step, 0.0)
    before, after = np.concatenate([[0.0], known[:-1]]), np.concatenate([known[1:], [0.0]])
    beside = np.maximum(before, after)[: step.size]
    gap = (step < 0) | ((beside > 0) & (step > _GAP * beside))
    place = np.arange(t.size)
    begins = np.concatenate([[True], gap])
    ends = np.concatenate([gap, [True]])
    left = place - np.maximum.accumulate(np.where(begins, place, 0))
    right = np.minimum.accumulate(np.where(ends, place, t.size)[::-1])[::-1] - place
    return left, right


def _window_sums(values: Floats, width: int) -> Floats:
    """Sums of ``width`` values (a power of two) that follow each other, added in the same order wherever they stand."""
    sums, size = values, 1
    while size < width:
        sums, size = sums[:-size] + sums[size:], 2 * size
    return sums


def _differences(
    t: Floats, w: Floats, left: NDArray[np.int64], right: NDArray[np.int64], scale: int
) -> tuple[Floats, Floats]:
    """Slopes between the means of the rows to the right and to the left, and the times between those means."""
    slope, span = np.full(t.size, np.nan), np.full(t.size, np.nan)
    at = np.flatnonzero((left >= scale) & (right >= scale))
    if at.size:
        times, speeds = _window_sums(t, scale), _window_sums(w, scale)
        span[at] = (times[at + 1] - times[at - scale]) / scale
        slope[at] = (speeds[at + 1] - speeds[at - scale]) / scale / span[at]
    return slope, span


def _one_sided(
    t: Floats, w: Floats, left: NDArray[np.int64], right: NDArray[np.int64], slope: Floats, span: Floats
) -> None:
    """Fill in the slopes at the ends."""
    for at, other in (
        (np.flatnonzero((left == 0) & (right > 0)), 1),
        (np.flatnonzero((left > 0) & (right == 0)), -1),
    ):
        span[at] = np.abs(t[at + other] - t[at])
        slope[at] = other * (w[at + other] - w[at]) / span[at]


def _bend(t: Floats, w: Floats, left: NDArray[np.int64], right: NDArray[np.int64]) -> Floats:
    bend = np.full(t.size, np.nan)
    at = np.flatnonzero((left > 0) & (right > 0))
    share = (t[at] - t[at - 1]) / (t[at + 1] - t[at - 1])
    distance = w[at] - (1 - share) * w[at - 1] - share * w[at + 1]
    bend[at] = distance / np.sqrt(1 + share**2 + (1 - share) ** 2)
    return bend
