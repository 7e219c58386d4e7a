"""Motion of a log: derivatives of the speed at each row over windows of several widths, and the noise of the speed.

All of it is local, so that a log read piece by piece, with an overlap, gives the same numbers as one read whole.

Speed of the nut from its position and the time: slopes of straight lines through the rows around each.
"""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple, TypeAlias

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


#: Numbers of rows on either side that a line goes through.
_HALF_WIDTHS = (1, 2, 4, 8, 16, 32, 64)
#: Quantile of the speeds that stands for motion: a log may rest most of its time.
_FAST = 0.95
#: The noise of the speed, as a share of a typical speed, for which no wider line is taken.
_NOISE_OF_SPEED = 0.01
#: A step of time so many times the usual one is a gap: no line crosses it.
_GAP_OF_TIME = 10.0
#: From the median of absolute second differences to the standard deviation of one position: 1.4826 / √6.
_SECOND_DIFFERENCE = 0.6053


class Lines(NamedTuple):
    """The lines through a log: the number of rows on either side at most, and the step of time that none crosses."""

    half_width: int
    gap: float

    @classmethod
    def of(cls, time: Floats, position: Floats) -> Lines:
        """The lines as narrow as the noise of the position allows, which its second differences show."""
        if time.size < 3:
            return cls(0, np.inf)
        step = np.diff(time)
        usual = float(np.median(step[step > 0])) if (step > 0).any() else np.inf
        noise = _SECOND_DIFFERENCE * float(np.median(np.abs(np.diff(position, 2))))
        typical = float(np.quantile(np.abs(np.diff(position)), _FAST)) / usual
        width = _HALF_WIDTHS[0]
        for width in _HALF_WIDTHS:
            rows = 2 * width + 1
            if noise / usual * np.sqrt(12 / (rows * (rows**2 - 1))) <= _NOISE_OF_SPEED * typical:
                break
        return cls(width, _GAP_OF_TIME * usual)

    def slopes(self, time: Floats, position: Floats) -> Floats:
        """The slope of the line of each row."""
        if not self.half_width:
            return np.full(time.size, np.nan)
        step = np.diff(time, prepend=time[:1])
        part = np.cumsum((step < 0) | (step > self.gap), dtype=np.int64)
        return _slopes(time, position, part, self.half_width)


def feed_rate(time: Floats, position: Floats) -> tuple[Floats, int]:
    r"""Speed at each row, and the number of rows on either side that its line goes through at most.

    .. math:: v = \frac{\sum (t - \bar t)(x - \bar x)}{\sum (t - \bar t)^2}

    The lines are as narrow as the noise of the position allows, which its second differences show. None crosses a gap,
    and none a clock that goes back; there, and at the ends, they are shorter. NaN where no row is near, or a value is
    missing. At the ends of strokes the speed changes within a line: the cleaning leaves such rows out.
    """
    rates = FeedRates(time.size + 1)
    columns = rates.add({"time": time, "position": position}), rates.end()
    return np.concatenate([part["feed_rate"] for part in columns]), rates.lines.half_width


class FeedRates:
    """The speeds of :func:`feed_rate` of rows that come in pieces, the same however they are cut.

    The first ``learnt`` rows, which wait for each other, tell how wide the lines are; after them each row waits for as
    many as its line goes through. The columns of the rows come back with ``feed_rate`` in place of ``position``.
    """

    def __init__(self, learnt: int) -> None:
        self._learnt = learnt
        #: How many rows came.
        self.rows = 0
        self._parts: list[dict[str, NDArray[Any]]] = []
        self._found: Lines | None = None
        #: Times and positions behind the rows that wait, as many as a line goes through.
        self._before = np.empty((2, 0))

    @property
    def lines(self) -> Lines:
        """The lines, once they are known."""
        assert self._found is not None
        return self._found

    def add(self, columns: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
        """Add rows; return those whose speed is known by now, perhaps none."""
        self._parts.append(columns)
        self.rows += columns["time"].size
        if self._found is None and self.rows < self._learnt:
            return _with_speeds({name: values[:0] for name, values in columns.items()}, np.empty(0))
        return self._settled(last=False)

    def end(self) -> dict[str, NDArray[Any]]:
        """Return the rows that are left."""
        return self._settled(last=True)

    def _settled(self, *, last: bool) -> dict[str, NDArray[Any]]:
        rows = {name: np.concatenate([part[name] for part in self._parts]) for name in self._parts[0]}
        time, position = rows["time"], rows["position"]
        known = np.flatnonzero(np.isfinite(time) & np.isfinite(position))
        if self._found is None:
            learnt = known[known < self._learnt]
            self._found = Lines.of(time[learnt], position[learnt])
        width = self._found.half_width
        # after so many rows without a position, more than a gap of time has gone by
        last = last or known.size <= width < self._learnt < time.size
        final = known.size if last else max(known.size - width, 0)
        end = time.size if final == known.size else int(known[final])
        t, x = np.concatenate([self._before, [time[known], position[known]]], axis=1)
        begin = self._before.shape[1]
        speed = np.full(end, np.nan)
        speed[known[:final]] = self._found.slopes(t, x)[begin : begin + final]
        done = np.array([t, x])[:, : begin + final]
        self._before = done[:, max(0, done.shape[1] - width) :]
        self._parts = [{name: values[end:] for name, values in rows.items()}]
        return _with_speeds({name: values[:end] for name, values in rows.items()}, speed)


def _with_speeds(columns: dict[str, NDArray[Any]], speed: Floats) -> dict[str, NDArray[Any]]:
    return {**{name: values for name, values in columns.items() if name != "position"}, "feed_rate": speed}


def _slopes(t: Floats, x: Floats, part: NDArray[np.int64], width: int) -> Floats:
    """Slopes of lines through the rows of the same part, so many on either side."""
    place = np.arange(t.size)
    sums = np.zeros((5, t.size))
    for offset in range(-width, width + 1):
        other = np.clip(place + offset, 0, t.size - 1)
        counts = (other == place + offset) & (part[other] == part)
        dt, dx = np.where(counts, t[other] - t, 0.0), np.where(counts, x[other] - x, 0.0)
        sums += counts, dt, dx, dt * dx, dt * dt
    count, of_t, of_x, of_both, of_squares = sums
    spread = of_squares - of_t**2 / count
    flat = spread <= 0
    return np.where(flat, np.nan, (of_both - of_t * of_x / count) / np.where(flat, 1.0, spread))
