"""Distributions of uncertain inputs, each by its quantile function.

The quantile of a uniform random number between 0 and 1 is a random number of the distribution.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import TypeAlias, get_args

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, as_float, is_concrete, nearest, raise_if_any
from ballscrew.basis.quantities import Array, Info, Quantity

#: Less than the least share that is ever drawn, 2^-53.
UNREACHED = 2.0**-64


@dataclasses.dataclass(frozen=True)
class Uniform:
    """Every value between two ends, ``low`` and ``high``, is as likely as any other.

    Raises :class:`~ballscrew.basis.errors.InputError` unless low < high.
    """

    low: float
    high: float

    def __post_init__(self) -> None:
        raise_if_any(_faults_of_numbers("uniform", self) or _faults_of_order("uniform", self.low, self.high))

    def quantile(self, u: Array) -> Array:
        """``low + (high − low) u`` for ``u`` in (0, 1), in the shape of u."""
        return self.low + (self.high - self.low) * u

    @property
    def characteristic_values(self) -> tuple[float, ...]:
        """The ends: what any bound must leave room for."""
        return self.low, self.high

    def describe(self, unit: str) -> str:
        """The distribution as a phrase; ``unit`` is that of its numbers, as it is written."""
        return f"uniform from {_shown(self.low, unit)} to {_shown(self.high, unit)}"


@dataclasses.dataclass(frozen=True)
class Normal:
    """The normal distribution by its ``mean`` and standard ``deviation``, perhaps cut off at ``low`` and ``high``.

    Without ends its tails go beyond the bounds of an input, where values are invalid; see :func:`within`.
    Raises :class:`~ballscrew.basis.errors.InputError` unless the deviation is positive and the mean between the ends.
    """

    mean: float
    deviation: float
    low: float = -math.inf
    high: float = math.inf

    def __post_init__(self) -> None:
        faults = _faults_of_numbers("normal", self)
        if not faults and self.deviation <= 0:
            faults = [
                Fault(
                    "normal.deviation",
                    "must be positive",
                    f"{self.deviation:g}",
                    "a value without spread needs no distribution",
                )
            ]
        raise_if_any(faults or _faults_of_ends("normal", self.mean, self.low, self.high))

    def quantile(self, u: Array) -> Array:
        """``mean + deviation Φ⁻¹(s)`` for ``u`` in (0, 1), in the shape of u; see :func:`standard_normal_quantile`.

        s = u without ends; with ends ``s = Φ(a) + (Φ(b) − Φ(a)) u``, a and b the ends as multiples of the deviation.
        """
        share = _share_within(u, *self.in_deviations(self.low, self.high))
        return _not_beyond(self.mean + self.deviation * standard_normal_quantile(share), self.low, self.high)

    def in_deviations(self, *values: float) -> tuple[float, ...]:
        """Standard scores of ``values``: deviations from the mean in standard deviations."""
        return tuple((value - self.mean) / self.deviation for value in values)

    @property
    def characteristic_values(self) -> tuple[float, ...]:
        """The mean: what any bound must leave room for."""
        return (self.mean,)

    def describe(self, unit: str) -> str:
        """The distribution as a phrase; ``unit`` is that of its numbers, as it is written."""
        cut = _describe_ends(self.low, self.high, unit)
        return f"normal, mean {_shown(self.mean, unit)}, standard deviation {_shown(self.deviation, unit)}{cut}"


@dataclasses.dataclass(frozen=True)
class LogNormal:
    """The logarithm is normal: about two thirds of the values lie between median/factor and median·factor.

    The ``factor`` is exp of the standard deviation of the logarithm. It may be cut off at ends, ``low`` and ``high``;
    the ``median`` is that without them. Raises :class:`~ballscrew.basis.errors.InputError` unless the median is
    positive and between the ends, and the factor above 1.
    """

    median: float
    factor: float
    low: float = -math.inf
    high: float = math.inf

    def __post_init__(self) -> None:
        faults = _faults_of_numbers("log_normal", self)
        if not faults and self.median <= 0:
            faults.append(Fault("log_normal.median", "must be positive", f"{self.median:g}"))
        if not faults and self.factor <= 1:
            remedy = "1.1 is about ten per cent up or down"
            faults.append(Fault("log_normal.factor", "must be above 1", f"{self.factor:g}", remedy))
        raise_if_any(faults or _faults_of_ends("log_normal", self.median, self.low, self.high))

    def quantile(self, u: Array) -> Array:
        """``median factor^Φ⁻¹(s)`` for ``u`` in (0, 1), in the shape of u; see :func:`standard_normal_quantile`.

        s is that of :meth:`Normal.quantile`, with the ends of the logarithm.
        """
        share = _share_within(u, *self.in_deviations(self.low, self.high))
        values = self.median * np.exp(math.log(self.factor) * standard_normal_quantile(share))
        return _not_beyond(values, self.low, self.high)

    def in_deviations(self, *values: float) -> tuple[float, ...]:
        """Standard scores of the logarithms of ``values``."""
        width = math.log(self.factor)
        return tuple(-math.inf if value <= 0 else self._log_ratio(value) / width for value in values)

    def _log_ratio(self, value: float) -> float:
        ratio = value / self.median
        if 0 < ratio < math.inf:
            return math.log(ratio)
        return math.log(value) - math.log(self.median)  # the least number there is, over a large one

    @property
    def characteristic_values(self) -> tuple[float, ...]:
        """The median: what any bound must leave room for."""
        return (self.median,)

    def describe(self, unit: str) -> str:
        """The distribution as a phrase; ``unit`` is that of its numbers, as it is written."""
        cut = _describe_ends(self.low, self.high, unit)
        return f"log-normal, median {_shown(self.median, unit)}, factor {_shown(self.factor, '1')}{cut}"


@dataclasses.dataclass(frozen=True)
class Triangular:
    """The density rises in a straight line from the ``low`` end to the ``mode``, and falls to the ``high`` end.

    Raises :class:`~ballscrew.basis.errors.InputError` unless low ≤ mode ≤ high and low < high.
    """

    low: float
    mode: float
    high: float

    def __post_init__(self) -> None:
        faults = _faults_of_numbers("triangular", self) or _faults_of_order("triangular", self.low, self.high)
        if not faults and not self.low <= self.mode <= self.high:
            given = f"{self.mode:g}"
            faults = [
                Fault(
                    "triangular.mode",
                    "must lie between the ends",
                    given,
                    f"{units.to_significant(self.low, 6)} to {units.to_significant(self.high, 6)}",
                )
            ]
        raise_if_any(faults)

    def quantile(self, u: Array) -> Array:
        """The value for ``u`` in (0, 1), in the shape of u.

        ``low + √(u (high − low)(mode − low))`` up to the mode,
        ``high − √((1 − u)(high − low)(high − mode))`` beyond.
        """
        width, below, above = self.high - self.low, self.mode - self.low, self.high - self.mode
        rising = self.low + np.sqrt(width * below * u)
        falling = self.high - np.sqrt(width * above * (1 - u))
        return np.where(u < below / width, rising, falling)[()]

    @property
    def characteristic_values(self) -> tuple[float, ...]:
        """The ends: what any bound must leave room for."""
        return self.low, self.high

    def describe(self, unit: str) -> str:
        """The distribution as a phrase; ``unit`` is that of its numbers, as it is written."""
        low, mode, high = (_shown(value, unit) for value in (self.low, self.mode, self.high))
        return f"triangular from {low} to {high}, mode {mode}"


#: What an uncertain input may be.
Distribution: TypeAlias = Uniform | Normal | LogNormal | Triangular


def scaled(distribution: Distribution, factor: float) -> Distribution:
    """The distribution of a positive multiple of a quantity."""
    kept = {"factor"} if isinstance(distribution, LogNormal) else set[str]()
    numbers = {field.name: getattr(distribution, field.name) for field in dataclasses.fields(distribution)}
    return dataclasses.replace(distribution, **{n: factor * value for n, value in numbers.items() if n not in kept})


def within(distribution: Distribution, info: Info) -> Distribution:
    """The distribution, its tails cut off at the bounds of a quantity; those of others are left as they are.

    Where no sample could be beyond a bound, there is no end. Raises :class:`~ballscrew.basis.errors.InputError` where
    the mean or the median is out of bounds.
    """
    if not isinstance(distribution, Normal | LogNormal):
        return distribution
    low, high = allowed(info)
    first, last = distribution.in_deviations(low, high)
    below, beyond = standard_normal_share(first), standard_normal_share(-last)
    return dataclasses.replace(
        distribution,
        low=max(distribution.low, low if below > UNREACHED else -math.inf),
        high=min(distribution.high, high if beyond > UNREACHED else math.inf),
    )


def distribution_fault(
    where: str, name: str, given: object, known: Mapping[str, tuple[str, Quantity]], remedy: str
) -> Fault | None:
    """Fault of the distribution of an input; ``remedy`` is for a whole number, which has none."""
    if name not in known:
        return Fault(where, "unknown name", "", nearest(name, known))
    if not isinstance(given, Distribution):
        kinds = ", ".join(kind.__name__ for kind in get_args(Distribution))
        return Fault(where, "is no distribution", str(given), f"one of {kinds}")
    if known[name][1].info.whole:
        return Fault(where, "is a whole number, which has no distribution", "", remedy)
    return None


def allowed(info: Info) -> tuple[float, float]:
    """The least and the greatest number within the bounds of a quantity; infinite where there is no bound."""
    low = -math.inf if info.at_least is None else float(info.at_least)
    low = low if info.above is None else max(low, math.nextafter(info.above, math.inf))
    high = math.inf if info.at_most is None else float(info.at_most)
    high = high if info.below is None else min(high, math.nextafter(info.below, -math.inf))
    return low, high


def standard_normal_share(x: float) -> float:
    """Φ(x): the share of a standard normal distribution below a number."""
    return math.erfc(-x / math.sqrt(2)) / 2


def standard_normal_quantile(u: Array) -> Array:
    """Φ⁻¹(u): below which a standard normal number lies with probability u in (0, 1); in the shape of u."""
    from scipy.special import ndtri  # for those only who sample

    return ndtri(u)


def normal_half_width(level: float) -> float:
    """Half the width of the interval that holds a share of a standard normal distribution."""
    return float(standard_normal_quantile(0.5 + level / 2))


def _share_within(u: Array, low: float, high: float) -> Array:
    """The share of a standard normal distribution at which a share u of what lies between two ends is reached."""
    below, above = standard_normal_share(low), standard_normal_share(high)
    if (below, above) == (0.0, 1.0):  # no end that a number of ours could reach: the same bits as without
        return u
    share = below + (above - below) * u
    return np.minimum(share, 1 - 2.0**-53)  # rounding may make it 1, which has no quantile


def _not_beyond(values: Array, low: float, high: float) -> Array:
    """Values moved to the ends where rounding has carried them beyond."""
    values = values if low == -math.inf else np.maximum(values, low)
    return values if high == math.inf else np.minimum(values, high)


def _shown(value: float, unit: str) -> str:
    """A number to its last digit: who reads it can draw the same samples."""
    return f"{float(value)!r}" if unit == "1" else f"{float(value)!r} {unit}"


def _faults_of_numbers(section: str, distribution: Distribution) -> list[Fault]:
    """Fields that are no finite numbers; ends that may be left out may be infinite."""
    return [
        Fault(f"{section}.{field.name}", "must be a finite number", str(value), "give one number in SI")
        for field in dataclasses.fields(distribution)
        if not is_concrete(value := getattr(distribution, field.name))
        or (field.default is dataclasses.MISSING and not math.isfinite(as_float(value)))
    ]


def _faults_of_ends(section: str, middle: float, low: float, high: float) -> list[Fault]:
    """Ends that leave the middle out, or that are one."""
    if low <= middle <= high and low < high:
        return []
    problem = "must leave the middle between its ends"
    return [Fault(f"{section}.low", problem, f"{low:g} to {high:g}, middle {middle:g}", "leave the ends out")]


def _describe_ends(low: float, high: float, unit: str) -> str:
    """The ends as a phrase; empty without ends."""
    ends = {"below": low, "above": high}
    said = [f"{side} {_shown(end, unit)}" for side, end in ends.items() if math.isfinite(end)]
    return f", cut {' and '.join(said)}" if said else ""


def _faults_of_order(section: str, low: float, high: float) -> list[Fault]:
    if low < high:
        return []
    return [
        Fault(f"{section}.high", "must be above low", f"{high:g} against {low:g}", "one value needs no distribution")
    ]
