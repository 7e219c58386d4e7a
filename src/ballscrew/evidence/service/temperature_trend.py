"""A trend of torques with the temperature that is left once the model has accounted for it: too much, or too little.

Torques of other days are compared at one temperature by the model. Where the tests of a healthy nut still go with the
temperature after that, what the model does at other temperatures is wrong by as much.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.evidence.calibration.identifiability import long_run_covariance
from ballscrew.evidence.calibration.oil_temperature import LOGGED_TEMPERATURE
from ballscrew.evidence.calibration.robust import Vector, autocorrelation_lag

#: A trend is said if chance makes one so clear in no more than this share of the tests in which there is none.
CHANCE = 0.01
#: Temperatures that differ by less than what a sensor is off by tell nothing, K.
LEAST_RANGE = LOGGED_TEMPERATURE
#: Half of the values beyond the interval of 95 %.
_LEVEL = 0.95


class TemperatureTrend(NamedTuple):
    """The slope of the logarithm of torques by their temperature, 1/K, with its 95 % interval."""

    slope: float
    low: float
    high: float
    #: Probability of a slope as clear as this without a trend.
    chance: float
    #: Between the coldest and the warmest torque, K.
    temperature_range: float

    @property
    def told(self) -> bool:
        """Whether it is clear, by :data:`CHANCE`."""
        return self.chance < CHANCE

    def text(self, per_kelvin: float) -> str:
        """The trend and what it says of a model whose torque has this derivative of its logarithm, 1/K."""
        rises, over = self.slope > 0, self.slope * per_kelvin < 0
        low, high = (units.fixed(end, 2) for end in sorted(abs(100 * end) for end in (self.low, self.high)))
        verb = "rises" if rises else "falls"
        model = "over-corrects, it accounts for too much" if over else "under-corrects, it accounts for too little"
        return (
            f"still {verb} by {units.percent(abs(self.slope), 2)} a kelvin ({low} to {high} %, 95 %): "
            f"the model {model} of the temperature"
        )


def temperature_trend(logarithms: Vector, temperature: Vector, others: Vector | None = None) -> TemperatureTrend | None:
    """The trend of logarithms of torques by least squares, ``others`` (columns) accounted for; None where none is told.

    Values that follow each other may be alike: the error is the larger of that of independent ones and of that with
    the products of neighbours (NeweyWest1987).
    """
    from scipy.special import stdtr, stdtrit  # slow to import: for those only who have logs

    width = float(np.ptp(temperature)) if temperature.size else 0.0
    if width < LEAST_RANGE:
        return None
    columns = [np.ones(temperature.size), temperature - temperature.mean()]
    if others is not None:
        columns += [each - each.mean() for each in others.T if np.ptp(each) > 0]
    x = np.stack(columns, axis=1)
    x = x / np.linalg.norm(x, axis=0)
    freedom = temperature.size - x.shape[1]
    if freedom < 1 or np.linalg.matrix_rank(x) < x.shape[1]:
        return None
    inverse = np.linalg.inv(x.T @ x)
    result = inverse @ (x.T @ logarithms)
    off = logarithms - x @ result
    even = float(off @ off) / freedom * inverse
    along = inverse @ long_run_covariance(x * off[:, np.newaxis], autocorrelation_lag(off)) @ inverse
    scale = float(np.linalg.norm(temperature - temperature.mean()))
    slope, error = float(result[1]) / scale, float(np.sqrt(max(even[1, 1], along[1, 1]))) / scale
    half = float(stdtrit(freedom, 0.5 + _LEVEL / 2)) * error
    chance = 2 * float(stdtr(freedom, -abs(slope) / error)) if error > 0 else float(slope == 0)
    return TemperatureTrend(slope, slope - half, slope + half, chance, width)
