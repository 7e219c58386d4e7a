"""Detection of a change in a short series: a CUSUM with a stated rate of false alarms, and a robust trend.

The scatter and the mean of a healthy series are not known but estimated from it. The limits of the CUSUM are those of
series whose mean and scatter are estimated in the same way, so the rate holds from five tests on; with limits for a
known mean it would not.
"""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numpy as np

from ballscrew.evidence.calibration.robust import Vector

#: The allowance of the CUSUM in standard deviations: half of the change that it finds soonest.
ALLOWANCE = 1.0
#: A single test counts for no more standard deviations than these, so that one wild test is no alarm.
LARGEST_SCORE = 4.0
#: The standard deviation of a normal distribution over the median of the absolute values.
OF_MAD = 1.4826
#: Healthy series that the limits are from, and their seed.
_SERIES, _SEED = 50_000, 20261122


class Chart(NamedTuple):
    """A CUSUM chart: by test the sums of a fall and of a rise, and the limit; NaN in the tests of the baseline."""

    fall: Vector
    rise: Vector
    limit: Vector

    @property
    def alarm(self) -> int | None:
        """The first test beyond its limit."""
        beyond = np.flatnonzero(np.fmax(self.fall, self.rise) > self.limit)
        return int(beyond[0]) if beyond.size else None

    @property
    def falls(self) -> bool:
        """Whether the alarm, if there is one, is of a fall."""
        return self.alarm is not None and bool(self.fall[self.alarm] > self.limit[self.alarm])


class Trend(NamedTuple):
    """The slope of a series over its times, with its 95 % interval."""

    slope: float
    low: float
    high: float

    @property
    def told(self) -> bool:
        """Whether the interval leaves out zero."""
        return bool(self.low > 0 or self.high < 0)


def scatter_of(values: Vector) -> Vector:
    """Scatter of a series up to each of its values: root mean square of the successive differences over √2.

    A slow drift is hardly in it (the mean of the squared successive differences, MSSD). NaN for the first value; the
    last axis is the series.
    """
    squares = np.cumsum(np.diff(values, axis=-1) ** 2, axis=-1)
    count = np.arange(1, values.shape[-1])
    start = np.full((*values.shape[:-1], 1), math.nan)
    return np.concatenate([start, np.sqrt(squares / (2 * count))], axis=-1)


def robust_scatter(values: Vector) -> float:
    """Scatter of a series by the median of its successive differences: a step is not in it, nor is a wild value."""
    return OF_MAD * float(np.median(np.abs(np.diff(values)))) / math.sqrt(2)


def chart(values: Vector, baseline: int, besides: Vector, rate: float) -> Chart:
    r"""CUSUM of a series against the mean of its first tests (Page1954).

    ``S_i = max(0, S_{i−1} ± z_i − k)`` with ``z_i = (y_i − ȳ) / √(s_i² + b_i²)``: ȳ is the mean of the ``baseline``,
    s the scatter up to the test, b the standard deviations ``besides`` it. ``rate`` is the share of healthy tests, with
    normal errors, that give the first alarm; b > 0 makes alarms rarer.
    """
    scatter = scatter_of(values)
    deviation = np.sqrt(scatter**2 + besides**2)
    off = values - np.mean(values[:baseline])
    # values that are all the same have no deviation
    score = np.clip(off / np.where(deviation > 0, deviation, math.inf), -LARGEST_SCORE, LARGEST_SCORE)
    fall, rise = (np.full(values.size, math.nan) for _ in range(2))
    low = high = 0.0
    for i in range(baseline, values.size):
        low, high = max(0.0, low - score[i] - ALLOWANCE), max(0.0, high + score[i] - ALLOWANCE)
        fall[i], rise[i] = low, high
    limit = np.concatenate([np.full(baseline, math.nan), limits(baseline, values.size - baseline, rate)])
    return Chart(fall, rise, limit)


@functools.lru_cache(maxsize=16)
def _simulated(baseline: int, count: int, rate: float) -> tuple[float, ...]:
    random = np.random.default_rng(_SEED)
    first = random.standard_normal((_SERIES, baseline))
    mean, last = first.mean(axis=1), first[:, -1]
    squares = np.sum(np.diff(first, axis=1) ** 2, axis=1)
    differences = baseline - 1
    fall = rise = np.zeros(_SERIES)
    values: list[float] = []
    for _ in range(count):
        value = random.standard_normal(mean.size)
        squares = squares + (value - last) ** 2
        differences += 1
        score = np.clip((value - mean) / np.sqrt(squares / (2 * differences)), -LARGEST_SCORE, LARGEST_SCORE)
        fall, rise = np.maximum(0, fall - score - ALLOWANCE), np.maximum(0, rise + score - ALLOWANCE)
        worst = np.maximum(fall, rise)
        limit = float(np.quantile(worst, 1 - rate))
        values.append(limit)
        healthy = worst <= limit  # series with an alarm have ended
        mean, last, squares, fall, rise = (one[healthy] for one in (mean, value, squares, fall, rise))
    return tuple(values)


def limits(baseline: int, count: int, rate: float) -> Vector:
    """Limits of the CUSUM in the tests after the baseline: of healthy series without an alarm so far, the share
    ``rate`` is beyond.
    """
    # rounded up, so that a series that grows by a test simulates nothing anew
    whole = 50 * math.ceil(count / 50)
    return np.array(_simulated(baseline, whole, rate)[:count])


def trend(times: Vector, values: Vector) -> Trend:
    """Slope by Theil and Sen with the interval by Kendall's statistic (Sen1968, by SciPy).

    Nearly a third of the values may be wild. The interval holds for errors that are independent from test to test. NaN
    for fewer than three times that differ.
    """
    from scipy.stats import theilslopes  # slow to import: for those only who ask for it

    if np.unique(times).size < 3:
        return Trend(math.nan, math.nan, math.nan)
    result: Any = theilslopes(values, times, 0.95)  # SciPy's types have no names
    return Trend(float(result.slope), float(result.low_slope), float(result.high_slope))
