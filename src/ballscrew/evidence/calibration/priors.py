"""Priors: knowledge of parameters before a log is read, as residuals beside those of the log."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence

import numpy as np

from ballscrew.engine.uncertainty.distributions import Distribution, LogNormal, Normal, Triangular, Uniform
from ballscrew.evidence.calibration.robust import (
    Prior,
    Vector,
)

#: Regularisation of unidentified parameters: a weak normal prior about the start with this many scales as deviation.
REGULARISATION_SCALE = 10.0


@dataclasses.dataclass(frozen=True, eq=False)
class Priors:
    """Distributions of some of the parameters of a fit, by place.

    A normal prior is the residual ``(x − mean)/deviation``, a log-normal one ``ln(x/median)/ln(factor)``; a triangular
    one counts as the normal of its mean and deviation, and a uniform one as bounds alone.
    """

    given: Mapping[int, Distribution]
    start: Vector
    scale: Vector

    @property
    def all(self) -> Prior:
        """The priors, and the weak regularisation of all parameters."""

        def residuals(x: Vector) -> Vector:
            return np.concatenate([self.residuals(x), (x - self.start) / (REGULARISATION_SCALE * self.scale)])

        def slopes(x: Vector) -> Vector:
            return np.vstack([self.slopes(x), np.diag(1 / (REGULARISATION_SCALE * self.scale))])

        return Prior(residuals, slopes)

    def residuals(self, x: Vector) -> Vector:
        """Residuals of the priors, in standard deviations."""
        return np.array([_residual(prior, x[i])[0] for i, prior in self._informative])

    def slopes(self, x: Vector) -> Vector:
        """Derivatives of the residuals by the parameters."""
        slopes = np.zeros((len(self._informative), x.size))
        for row, (i, prior) in enumerate(self._informative):
            slopes[row, i] = _residual(prior, x[i])[1]
        return slopes

    def deviation(self, place: int, value: float) -> float | None:
        """The standard deviation that the prior of a parameter leaves; None without one."""
        told = dict(self._informative)
        return None if place not in told else abs(1 / _residual(told[place], value)[1])

    @property
    def _informative(self) -> Sequence[tuple[int, Normal | LogNormal | Triangular]]:
        return [(i, prior) for i, prior in self.given.items() if not isinstance(prior, Uniform)]


def _residual(prior: Normal | LogNormal | Triangular, x: float) -> tuple[float, float]:
    """The residual of a prior and its derivative."""
    match prior:
        case LogNormal(median, factor):
            x = max(x, 1e-12 * median)
            return math.log(x / median) / math.log(factor), 1 / (x * math.log(factor))
        case Normal(mean, deviation):
            return (x - mean) / deviation, 1 / deviation
        case Triangular(low, mode, high):
            mean = (low + mode + high) / 3
            deviation = math.sqrt((low**2 + mode**2 + high**2 - low * mode - low * high - mode * high) / 18)
            return (x - mean) / deviation, 1 / deviation
