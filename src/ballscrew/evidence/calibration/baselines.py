"""Empirical baselines without physics: the two descriptions of friction that drives and simulators use.

They are fitted with the same loss as the model, so that the rows held out show what physics buys.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.evidence.calibration.robust import Loss, Vector, biweight, minimum_scatter, pseudo_huber, scatter_above

#: Half the width of the 95 % interval of an oil temperature, K: that of a sensor near the nut, and without any.
LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE = 2.0, 10.0


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
