"""Speed of the nut from its position and the time: slopes of straight lines through the rows around each."""

from __future__ import annotations

import numpy as np

from ballscrew.torque_logs.motion import Floats

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


def feed_rate(time: Floats, position: Floats) -> tuple[Floats, int]:
    r"""Speed at each row, and the number of rows on either side that its line goes through at most.

    .. math:: v = \frac{\sum (t - \bar t)(x - \bar x)}{\sum (t - \bar t)^2}

    The lines are as narrow as the noise of the position allows, which its second differences show. None crosses a gap,
    and none a clock that goes back; there, and at the ends, they are shorter. NaN where no row is near, or a value is
    missing. At the ends of strokes the speed changes within a line: the cleaning leaves such rows out.
    """
    known = np.isfinite(time) & np.isfinite(position)
    speed, half_width = _slopes(time[known], position[known])
    found = np.full(time.size, np.nan)
    found[known] = speed
    return found, half_width


def _slopes(t: Floats, x: Floats) -> tuple[Floats, int]:
    if t.size < 3:
        return np.full(t.size, np.nan), 0
    step = np.diff(t)
    usual = float(np.median(step[step > 0])) if (step > 0).any() else np.inf
    part = np.concatenate([[0], np.cumsum((step < 0) | (step > _GAP * usual))])
    noise = _SECOND_DIFFERENCE * float(np.median(np.abs(np.diff(x, 2))))
    typical = float(np.quantile(np.abs(np.diff(x)), _FAST)) / usual
    width = _HALF_WIDTHS[0]
    for width in _HALF_WIDTHS:
        rows = 2 * width + 1
        if noise / usual * np.sqrt(12 / (rows * (rows**2 - 1))) <= _NOISE_SHARE * typical:
            break
    return _lines(t, x, part, width), width


def _lines(t: Floats, x: Floats, part: Floats, width: int) -> Floats:
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
