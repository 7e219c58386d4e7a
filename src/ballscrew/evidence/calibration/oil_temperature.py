"""The error of the oil temperature of a log: one for all of its rows, as of a sensor beside the oil.

A fit takes the temperatures as they are, and so the error is not in its residuals: no number of rows makes it
smaller. It moves every estimate by what a warmer oil does to the torques.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from ballscrew.basis.quantities import Info, Quantity
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE

#: Half the width of the 95 % interval of an oil temperature, K: that of a sensor near the nut, and without any.
LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE = 2.0, 10.0
#: It as a quantity, and a value of it that says nothing of the oil any more, K.
TEMPERATURE_ERROR = Quantity(
    "temperature_error", "K", Info(r"\Delta T", "half the width of the 95 % interval of the oil temperature of a log")
)
MOST_TEMPERATURE_ERROR = 100.0
#: The input that a temperature changes where the oil has no grade.
VISCOSITY = "viscosity"
#: The difference for slopes by the temperature, K.
_STEP = 0.5


def uses_temperatures(lubricant: Lubricant, log: TorqueLog) -> bool:
    """Whether the temperatures of a log are used: there are some, and the oil follows them."""
    return bool(lubricant.follows_temperature and log.temperature is not None)


def usual_error(lubricant: Lubricant, log: TorqueLog) -> float:
    """Half the width of the 95 % interval of the oil temperature of a log, K: less where it is logged and used."""
    return LOGGED_TEMPERATURE if uses_temperatures(lubricant, log) else UNKNOWN_TEMPERATURE


def torque_of_model(subject: Configuration, points: Mapping[str, Any], weights: Vector, warmer: Any = 0.0) -> Vector:
    """The torque as it would be measured at the rows of a log, with an oil that is ``warmer`` by so many kelvin.

    What was changed of an oil keeps its ratio to that of the grade at all temperatures of the log.
    """
    oil = subject.lubricant
    if TEMPERATURE.name in points:
        oil = oil.at(points[TEMPERATURE.name] + warmer)
    elif np.any(warmer):
        oil = dataclasses.replace(oil, viscosity=oil.viscosity * np.exp(-warmer * oil.temperature_coefficient))
    model = subject.model(subject.screw, oil, **{name: points[name] for name in OPERATION})
    return weights[0] * model.ideal_torque + weights[1] * model.screw_torque


@dataclasses.dataclass(frozen=True, eq=False)
class TemperatureError:
    """The error of the oil temperature of a log, and what it does to the estimates of a fit."""

    #: Half the width of its 95 % interval, K.
    half_width: float
    #: Derivatives of the torques of the rows by the temperature of all, N m/K.
    torque_per_kelvin: Vector
    #: Change of each estimate for an oil that was a kelvin warmer than logged, in SI by K.
    shift: Vector

    @property
    def deviation(self) -> float:
        """Its standard deviation, K."""
        return self.half_width / NORMAL_95

    @property
    def covariance(self) -> Vector:
        """What it adds to the covariance of the estimates: ``J J^T s^2``."""
        return np.outer(self.shift, self.shift) * self.deviation**2


def torque_per_kelvin(
    subject: Configuration, free: Collection[str], points: Mapping[str, Any], weights: Vector
) -> Vector:
    """Derivatives of the torques of rows by a temperature that they share, N m/K.

    Zero where the viscosity itself is free: it is that of the log, whatever its temperature.
    """
    size = weights.shape[1]
    if VISCOSITY in free:
        return np.zeros(size)
    down, up = np.full(size, -_STEP), np.full(size, _STEP)
    if TEMPERATURE.name in points:
        info, rows = subject.lubricant.temperature_quantity.info, np.asarray(points[TEMPERATURE.name], dtype=float)
        low, high = (end if end is not None else np.nan for end in (info.at_least, info.at_most))
        down, up = np.fmax(down, low - rows), np.fmin(up, high - rows)
    torques = [torque_of_model(subject, points, weights, warmer) for warmer in (down, up)]
    slopes = (torques[1] - torques[0]) / (up - down)
    return np.where(np.isfinite(slopes), slopes, 0.0)
