"""The value of a preload that was found: with its interval, where that comes from, and the rows behind it."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.quantities import Force
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.robust import Vector


class Mixture(NamedTuple):
    """A number as a mixture of normal ones: weights that sum to 1, means, variances. NaN where it is not told."""

    weights: Vector
    mean: Vector
    variance: Vector

    @classmethod
    def of(cls, mean: float, deviation: float) -> Mixture:
        """A normal number."""
        return cls(np.ones(1), np.array([mean]), np.array([deviation**2]))

    @property
    def told(self) -> bool:
        """Whether it has a distribution."""
        return bool(np.isfinite(self.variance).all() and np.isfinite(self.weights).all())

    @property
    def total_variance(self) -> float:
        """The variance of the number."""
        middle = float(self.weights @ self.mean)
        return float(self.weights @ (self.variance + (self.mean - middle) ** 2))

    def less(self, other: Mixture) -> Mixture:
        """The difference to another number: of the same samples, or of its own."""
        if other.weights.size == 1:
            return Mixture(self.weights, self.mean - other.mean[0], self.variance + other.variance[0])
        return Mixture(self.weights, self.mean - other.mean, self.variance + other.variance)

    def share_below(self, value: float) -> float:
        """Probability that it is less than a value."""
        from scipy.special import ndtr  # slow to import: for those only who fit

        if not self.told:
            return math.nan
        deviation = np.sqrt(np.maximum(self.variance, 1e-24))
        return float(self.weights @ ndtr((value - self.mean) / deviation))

    def quantile(self, share: float) -> float:
        """The value below which it lies with a probability; without a distribution the mean for the median, or NaN."""
        from scipy.optimize import brentq

        if not self.told:
            return float(np.median(self.mean)) if share == 0.5 else math.nan
        reach = 10 * np.sqrt(np.maximum(self.variance, 1e-24))
        counted = self.weights > 0
        low, high = float(np.min((self.mean - reach)[counted])), float(np.max((self.mean + reach)[counted]))

        def off(value: float) -> float:
            return self.share_below(value) - share

        result: Any = brentq(off, low, high, xtol=1e-9)
        return float(result)

    def interval(self, level: float) -> tuple[float, float]:
        """The interval of the number whose logarithm this is, with equal shares beyond its ends."""
        low, high = (self.quantile(0.5 + side * level / 2) for side in (-1, 1))
        return math.exp(low), math.exp(high)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class PreloadEstimate:
    """A preload with its distribution."""

    #: The logarithm of the preload in N.
    logarithm: Mixture
    #: By unknown, the share of the variance of the logarithm that goes along with it.
    shares: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    #: The screw with the numbers that are the most probable, and how much warmer its oil is than logged, K.
    subject: Configuration | None = None
    warmer: float = 0.0
    #: The fit of the preload alone; None for a preload that is not from a log.
    fit: CalibratedModel | None = None
    #: Root mean square of the residuals, N m, outliers left out.
    residual_rms: float = math.nan
    #: Mean temperature of the log, K.
    temperature: float | None = None
    #: Rows whose load takes the preload off one side: they tell nothing of it.
    rows_beyond_lift_off: int = 0

    @property
    def preload(self) -> Force:
        """The preload, N: the median."""
        return math.exp(self.logarithm.quantile(0.5))

    def interval(self, level: float = 0.95) -> tuple[float, float]:
        """The interval of the preload, N; NaN where the log does not tell it."""
        return self.logarithm.interval(level)
