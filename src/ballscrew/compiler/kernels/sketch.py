"""Quantile sketches: histogram, moments and extremes of many numbers in constant memory.

A sketch counts numbers in bins that are the leading bits of a double: sign, exponent and
``MANTISSA_BITS`` of the mantissa. Counts are whole numbers, so it does not matter in which order
numbers come and sketches are merged. A number that is looked up by its rank lies in its bin, so it
is found to ``RELATIVE_ERROR``; interpolation within the bin usually does better. Mean and deviation
are sums, which do depend on order: they are taken over units of ``UNIT`` numbers and merged in the
order of the units. Written once for NumPy and once for a compiled kernel.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels.counting import (
    BINS,
    DROPPED_BITS,
    FRACTION_BITS,
    MANTISSA_BITS,
    OCTAVES,
    STATISTICS,
    counting_kernel,
)

#: How far apart two numbers of one bin can be, as a share of them.
RELATIVE_ERROR = 2.0**-MANTISSA_BITS
#: Numbers in one unit of the sums: few enough for buffers of them to stay in the cache,
#: and enough to keep a kernel busy for much longer than Python needs to call it.
UNIT = 2**14

#: In the number of an octave, the bit of the sign.
_NEGATIVE = OCTAVES // 2
#: The largest exponent is that of infinities, in the first bin, and of NaN, in another (a signalling
#: NaN may be in the first, but no operation yields one). To the smallest belong zero and the subnormal
#: numbers, which are as good as zero.
_SPECIAL = _NEGATIVE - 1

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class Moments(NamedTuple):
    """Of each series: how many finite numbers, their mean, the sum of the squares of their deviations, their ends."""

    numbers: Floats
    mean: Floats
    squares: Floats
    minimum: Floats
    maximum: Floats

    @classmethod
    def empty(cls, series: int) -> Moments:
        """The moments of no numbers."""
        nothing, infinite = np.zeros(series), np.full(series, np.inf)
        return cls(nothing, np.full(series, np.nan), nothing, infinite, -infinite)

    @classmethod
    def of(cls, values: Floats) -> Moments:
        """Those of one unit, (series, numbers); deviations are from the unit's own mean, so that nothing cancels."""
        found = np.array([_moments(row) for row in values])
        return cls(*found.T)

    def merged(self, later: Moments) -> Moments:
        """Those of both together: M = M₁ + M₂ + (x̄₂ − x̄₁)² n₁n₂/n.

        Chan, T. F., Golub, G. H. & LeVeque, R. J. (1983), "Algorithms for computing the sample
        variance: analysis and recommendations", The American Statistician 37(3), 242–247.
        """
        numbers = self.numbers + later.numbers
        share = later.numbers / np.maximum(numbers, 1.0)
        # where one side has no numbers, the mean is that of the other and there is no step
        old = np.where(self.numbers > 0, self.mean, later.mean)
        with np.errstate(over="ignore", invalid="ignore"):
            step = np.where(later.numbers > 0, later.mean, old) - old
            mean = old + step * share
            squares = self.squares + later.squares + step * step * (self.numbers * share)
        least, largest = np.minimum(self.minimum, later.minimum), np.maximum(self.maximum, later.maximum)
        return Moments(numbers, mean, squares, least, largest)


def _moments(values: Floats) -> tuple[float, float, float, float, float]:
    """Those of the finite numbers of one series."""
    least, largest = values.min(), values.max()
    if not (np.isfinite(least) and np.isfinite(largest)):
        values = values[np.isfinite(values)]
        if not values.size:
            return 0.0, np.nan, 0.0, np.inf, -np.inf
        least, largest = values.min(), values.max()
    if least == largest:
        return values.size, least, 0.0, least, largest
    with np.errstate(over="ignore", invalid="ignore"):
        mean = np.add.reduce(values) / values.size
        deviations = values - mean
        return values.size, mean, np.add.reduce(deviations * deviations), least, largest


class Sketch:
    """Several series of numbers side by side, each with its ends, mean, deviation and quantiles.

    NaN, as arithmetic gives it, is counted as ``missing`` and enters nothing else. Infinities enter
    ends, mean and quantiles as they would in an array. The bins of a series take 16 KiB for each
    power of two and sign that its numbers have. With ``compiled``, a kernel counts, which does not
    wait for Python's lock.
    """

    def __init__(self, series: int = 1, *, compiled: bool = False) -> None:
        self.series = series
        self.moments = Moments.empty(series)
        self._kernel = counting_kernel() if compiled else None
        #: For each series and octave, where its bins begin; row 0 of the bins is for octaves not seen before.
        self._starts: Integers = np.zeros((series, OCTAVES), dtype=np.int64)
        self._bins: Integers = np.zeros((1 + series, BINS), dtype=np.int64)
        self._used = 1

    def add(self, values: Floats) -> None:
        """Count numbers, (series, numbers) or, of a single series, (numbers,), after those added before.

        Every ``UNIT`` of them, and what is left, makes a unit: cut into arrays of whole units, the
        same numbers give the same results to the last bit, however many each array has.
        """
        values = np.asarray(values, dtype=np.float64).reshape(self.series, -1)
        for start in range(0, values.shape[1], UNIT):
            unit = values[:, start : start + UNIT]
            self.moments = self.moments.merged(self._count_compiled(unit) if self._kernel else self._count(unit))

    def merge(self, later: Sketch) -> None:
        """Count what another one has counted, after what this one has.

        Ends, counts and quantiles are those of one sketch with all the numbers, to the last bit;
        mean and deviation to rounding, and always the same for the same sketches in the same order.
        """
        for series in range(self.series):
            octaves = np.flatnonzero(later._starts[series])
            self._allocate_octaves(series, octaves)
            here = self._starts[series, octaves] // BINS
            self._bins[here] += later._bins[later._starts[series, octaves] // BINS]
        self.moments = self.moments.merged(later.moments)

    def take_moments(self) -> Moments:
        """Return the moments and reset them; the histogram stays.

        For sketches that count parts of a whole in no fixed order, whose moments are merged in the
        order of the parts by the caller.
        """
        moments, self.moments = self.moments, Moments.empty(self.series)
        return moments

    @property
    def count(self) -> Integers:
        """The number of values other than NaN, (series,)."""
        return self.moments.numbers.astype(np.int64) + self._infinite(0) + self._infinite(_NEGATIVE)

    @property
    def missing(self) -> Integers:
        """The number of NaN, (series,)."""
        bins = [self._bins[self._starts[:, _SPECIAL + sign] // BINS] for sign in (0, _NEGATIVE)]
        return np.asarray(sum(here[:, 1:].sum(axis=1) for here in bins))

    @property
    def minimum(self) -> Floats:
        """The least number, (series,); NaN for none."""
        least = np.where(self.moments.numbers > 0, self.moments.minimum, np.inf)
        return np.where(self._infinite(_NEGATIVE) > 0, -np.inf, np.where(self.count > 0, least, np.nan))

    @property
    def maximum(self) -> Floats:
        """The largest number, (series,); NaN for none."""
        largest = np.where(self.moments.numbers > 0, self.moments.maximum, -np.inf)
        return np.where(self._infinite(0) > 0, np.inf, np.where(self.count > 0, largest, np.nan))

    @property
    def mean(self) -> Floats:
        """The mean, (series,); NaN for no numbers and for infinities of both signs."""
        above, below = (np.where(self._infinite(sign) > 0, np.inf, 0.0) for sign in (0, _NEGATIVE))
        with np.errstate(invalid="ignore"):
            infinite = above - below
        return np.where(infinite == 0, self.moments.mean, infinite)

    @property
    def deviation(self) -> Floats:
        """The standard deviation √(Σ(x − x̄)²/(n − 1)), (series,); NaN for fewer than two numbers or infinite ones."""
        count = self.moments.numbers
        known = (count == self.count) & (count > 1)
        return np.where(known, np.sqrt(self.moments.squares / np.maximum(count - 1, 1.0)), np.nan)

    def quantile(self, share: float) -> Floats:
        """The number below which a share of the numbers lies, (series,); NaN for no numbers.

        Between two numbers next to each other by rank it is interpolated, as ``numpy.quantile``
        does. Each of the two is found to ``RELATIVE_ERROR`` of itself, the least and the largest
        exactly; of zeros and subnormal numbers only the size is known, and zero is returned.
        """
        return np.array([self._quantile(series, share) for series in range(self.series)])

    def _quantile(self, series: int, share: float) -> float:
        count = int(self.count[series])
        if not count:
            return np.nan
        position = share * (count - 1)
        rank = int(position)
        number = self._value_at_rank(series, rank, count)
        if rank == position:
            return number
        following = self._value_at_rank(series, rank + 1, count)
        return number if number == following else number + (following - number) * (position - rank)

    def _value_at_rank(self, series: int, rank: int, count: int) -> float:
        """The value at a rank, to the width of a bin."""
        least, largest = float(self.minimum[series]), float(self.maximum[series])
        if rank in (0, count - 1):
            return largest if rank else least
        for octave, bins in self._octaves_ascending(series):
            reached = np.cumsum(bins)
            if rank < reached[-1]:
                place = int(np.searchsorted(reached, rank, side="right"))
                within = (rank - int(reached[place] - bins[place]) + 0.5) / int(bins[place])
                return min(max(_value_in_bin(octave, place, within), least), largest)
            rank -= int(reached[-1])
        raise AssertionError("a rank is less than the count")

    def _octaves_ascending(self, series: int) -> Iterator[tuple[int, Integers]]:
        """The octaves and their bins by rising numbers; NaN left out."""
        seen = np.flatnonzero(self._starts[series])
        for octave in [*seen[seen >= _NEGATIVE][::-1].tolist(), *seen[seen < _NEGATIVE].tolist()]:
            bins = self._bins[self._starts[series, octave] // BINS]
            bins = bins[:1] if octave % _NEGATIVE == _SPECIAL else bins
            yield octave, bins[::-1] if octave >= _NEGATIVE else bins

    def _infinite(self, sign: int) -> Integers:
        """The number of infinities of a sign, (series,)."""
        return self._bins[self._starts[:, _SPECIAL + sign] // BINS, 0]

    def _allocate_octaves(self, series: int, octaves: Integers) -> None:
        """Allocate bins for octaves that have none."""
        new = octaves[self._starts[series, octaves] == 0]
        if self._used + new.size > len(self._bins):
            more = max(new.size, len(self._bins))
            self._bins = np.concatenate([self._bins, np.zeros((more, BINS), dtype=np.int64)])
        self._starts[series, new] = np.arange(self._used, self._used + new.size) * BINS
        self._used += new.size

    def _count(self, unit: Floats) -> Moments:
        """Count one unit; returns its moments."""
        for series, values in enumerate(unit):
            self._count_series(series, values)
        return Moments.of(unit)

    def _count_series(self, series: int, values: Floats) -> None:
        """Count numbers of one series."""
        bits = np.ascontiguousarray(values).view(np.uint64)
        octaves = (bits >> np.uint64(FRACTION_BITS)).view(np.int64)
        starts = self._starts[series][octaves]
        if not starts.all():
            self._allocate_octaves(series, np.unique(octaves[starts == 0]))
            starts = self._starts[series][octaves]
        starts += (bits >> np.uint64(DROPPED_BITS)).view(np.int64) & (BINS - 1)
        np.add.at(self._bins.reshape(-1), starts, 1)

    def _count_compiled(self, unit: Floats) -> Moments:
        """:meth:`_count` by the kernel."""
        assert self._kernel is not None, "there is a kernel where this is called"
        numbers = unit.shape[1]
        if numbers < UNIT or not unit.flags.c_contiguous:
            whole = np.full((self.series, UNIT), np.nan)  # to the moments, NaN is no number
            whole[:, :numbers] = unit
            unit = whole
        found = np.empty((self.series, len(STATISTICS)))
        self._kernel(slice(0, self.series), slice(0, numbers), UNIT, [unit], [self._starts, self._bins, found])
        for series in np.flatnonzero(found[:, -1]):
            values = unit[series, :numbers]
            octaves = (values.view(np.uint64) >> np.uint64(FRACTION_BITS)).view(np.int64)
            self._count_series(int(series), values[self._starts[series][octaves] == 0])
        self._bins[0] = 0
        return Moments(*found[:, :-1].T)


def _value_in_bin(octave: int, place: int, within: float) -> float:
    """The number a share of the way through a bin of an octave; places are by rising numbers."""
    sign, exponent = octave & _NEGATIVE, octave % _NEGATIVE
    if exponent == 0:
        return 0.0
    if sign:
        place, within = BINS - 1 - place, 1 - within
    if exponent == _SPECIAL:
        return -np.inf if sign else np.inf
    bits = (exponent << FRACTION_BITS) + (place << DROPPED_BITS)
    low = np.array(bits, dtype=np.int64).view(np.float64)
    number = float(low + np.spacing(low) * 2.0**DROPPED_BITS * within)
    return -number if sign else number
