"""Empirical baselines without physics: the two descriptions of friction that drives and simulators use.

They are fitted with the same loss as the model, so that the rows held out show what physics buys.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.quantities import Info, Quantity
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.evidence.calibration.robust import Loss, Vector, biweight, minimum_scatter, pseudo_huber, scatter_above
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.materials import TEMPERATURE, Lubricant

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


#: Speeds of Stribeck that are tried, as shares of the largest speed of the log.
STRIBECK_SHARES = np.geomspace(0.002, 1.0, 25)
#: The two descriptions, as people read them.
STRIBECK, EFFICIENCY_PAIR = "Stribeck, viscous and load", "efficiency pair"
_MAXIMUM_ITERATIONS, _TOLERANCE = 50, 1e-7


@dataclasses.dataclass(frozen=True, eq=False)
class Conditions:
    """Magnitudes of load and speed at the rows of a log, the ideal torque with the sign of the load, and whether the
    load helps the motion.

    ``weights`` are the factors of ideal torque and friction torque in what was measured, of shape (2, rows); ``sensor``
    are the errors of the sensor that are fitted beside, as columns: the model has them, too.
    """

    axial_load: Vector
    screw_speed: Vector
    ideal_torque: Vector
    helping: NDArray[np.bool_]
    weights: Vector
    sensor: Vector

    def rows(self, chosen: NDArray[np.bool_]) -> Conditions:
        """Some of the rows."""
        return Conditions(
            self.axial_load[chosen],
            self.screw_speed[chosen],
            self.ideal_torque[chosen],
            self.helping[chosen],
            self.weights[:, chosen],
            self.sensor[chosen],
        )


#: Rows by which Stribeck's speed is searched for, of a longer log evenly spread.
MOST_ROWS_OF_SEARCH = 2000


@dataclasses.dataclass(frozen=True, eq=False)
class Baseline:
    """An empirical description of a friction torque: its coefficients in SI, and the torque measured."""

    description: str
    coefficients: dict[str, float]
    #: How many were fitted, those of the sensor among them.
    parameters: int
    torque: Callable[[Conditions], Vector]


def stribeck(conditions: Conditions, torque: Vector) -> Baseline:
    """``M = T_c + c F + (T_s − T_c) exp(−ω/ω_s) + k ω``: Coulomb and load, Stribeck's fall, a viscous rise.

    As drives compensate friction; the term in the load makes it fair. Fitted by robust least squares, ω_s by search.
    """
    fastest = float(np.max(conditions.screw_speed))

    def columns(rows: Conditions, speed: float) -> Vector:
        n = rows.screw_speed
        friction = np.stack([np.ones_like(n), rows.axial_load, np.exp(-n / speed), n], axis=1)
        return np.hstack([rows.weights[1][:, np.newaxis] * friction, rows.sensor])

    def torque_of(rows: Conditions, speed: float, vector: Vector) -> Vector:
        return rows.weights[0] * rows.ideal_torque + columns(rows, speed) @ vector

    rest = torque - conditions.weights[0] * conditions.ideal_torque
    # a search over so many speeds needs no more rows than these
    some = np.zeros(rest.size, dtype=bool)
    some[:: -(-rest.size // MOST_ROWS_OF_SEARCH)] = True
    searched, values = (conditions, rest) if some.all() else (conditions.rows(some), rest[some])
    tried = [(first_loss(columns(searched, speed), values), float(speed)) for speed in STRIBECK_SHARES * fastest]
    speed = min(tried)[1]
    result, _ = robust_linear(columns(conditions, speed), rest)
    names = ("coulomb_torque", "torque_per_load", "stribeck_torque", "viscous_torque_coefficient")
    coefficients = {**dict(zip(names, result.tolist(), strict=False)), "stribeck_speed": speed}
    return Baseline(STRIBECK, coefficients, result.size + 1, lambda rows: torque_of(rows, speed, result))


def efficiency_pair(conditions: Conditions, torque: Vector) -> Baseline:
    """Friction as a share of the ideal torque, one for each way of the power: ``1/η_d − 1`` and ``1 − η_b``.

    What selectors and simulators do with a pair of efficiencies.
    """

    def columns(rows: Conditions) -> Vector:
        friction = rows.weights[1] * np.abs(rows.ideal_torque)
        pair = np.stack([np.where(rows.helping, 0.0, friction), np.where(rows.helping, friction, 0.0)], axis=1)
        return np.hstack([pair, rows.sensor])

    rest = torque - conditions.weights[0] * conditions.ideal_torque
    result, _ = robust_linear(columns(conditions), rest)
    coefficients = {"efficiency": 1 / (1 + result[0]), "back_driving_efficiency": 1 - result[1]}
    return Baseline(
        EFFICIENCY_PAIR,
        {name: float(value) for name, value in coefficients.items()},
        result.size,
        lambda rows: rows.weights[0] * rows.ideal_torque + columns(rows) @ result,
    )


def robust_linear(columns: Vector, values: Vector) -> tuple[Vector, float]:
    """Coefficients of a linear model by the two losses of :mod:`~ballscrew.evidence.calibration.robust`.

    With them the root of the first loss, in the unit of the values. Iteratively reweighted least squares.
    """
    scaled, scale = _scaled(columns)
    result, scatter, loss = _by_first_loss(scaled, values)
    return _reweighted(scaled, values, result, lambda _: scatter, biweight)[0] / scale, loss


def first_loss(columns: Vector, values: Vector) -> float:
    """The root of the first loss that :func:`robust_linear` ends with, for a search: the second one is not needed."""
    return _by_first_loss(_scaled(columns)[0], values)[2]


def _scaled(columns: Vector) -> tuple[Vector, Vector]:
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0] = 1.0
    return columns / scale, scale


def _by_first_loss(scaled: Vector, values: Vector) -> tuple[Vector, float, float]:
    """Coefficients by the first loss, the scatter that they leave, and the root of the loss."""
    scatter = functools.partial(scatter_above, minimum_scatter(values))
    result, residuals = _reweighted(scaled, values, _by_least_squares(scaled, values), scatter, pseudo_huber)
    left = scatter(residuals)
    # the root, for a square of the scatter may be beyond all floats
    return result, left, left * float(np.sqrt(np.sum(pseudo_huber((residuals / left) ** 2)[0])))


def _by_least_squares(columns: Vector, values: Vector) -> Vector:
    vector: Any = np.linalg.lstsq(columns, values, rcond=None)[0]  # NumPy's types leave the precision open
    return vector


def _reweighted(
    scaled: Vector, values: Vector, vector: Vector, scatter: Callable[[Vector], float], loss: Loss
) -> tuple[Vector, Vector]:
    """Coefficients by a loss of residuals in units of their scatter, and the residuals."""
    residuals = scaled @ vector - values
    for _ in range(_MAXIMUM_ITERATIONS):
        root = np.sqrt(loss((residuals / scatter(residuals)) ** 2)[1])
        before, vector = vector, _by_least_squares(root[:, np.newaxis] * scaled, root * values)
        residuals = scaled @ vector - values
        if np.max(np.abs(vector - before)) <= _TOLERANCE * np.max(np.abs(vector), initial=1e-300):
            break
    return vector, residuals


ALL: Sequence[Callable[[Conditions, Vector], Baseline]] = (stribeck, efficiency_pair)
