"""Speed of the nut from its position and the time: slopes of straight lines through the rows around each."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.files.torque_logs.motion import Floats

#: Numbers of rows on either side that a line goes through.
_HALF_WIDTHS = (1, 2, 4, 8, 16, 32, 64)
#: Quantile of the speeds that stands for motion: a log may rest most of its time.
_FAST = 0.95
#: The noise of the speed, as a share of a typical speed, for which no wider line is taken.
_NOISE_SHARE = 0.01
#: A step of time so many times the usual one is a gap: no line crosses it.
_GAP = 10.0
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
            if noise / usual * np.sqrt(12 / (rows * (rows**2 - 1))) <= _NOISE_SHARE * typical:
                break
        return cls(width, _GAP * usual)

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
