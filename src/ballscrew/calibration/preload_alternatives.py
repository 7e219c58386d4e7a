"""Other causes of a change of torque: the value that one number would need if the preload were as before."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from ballscrew.calibration.calibrated_model import CalibratedModel
from ballscrew.calibration.fit import CONSTANT_LOSS, points_of, with_constant_torque
from ballscrew.calibration.preload_estimate import (
    LOGGED_TEMPERATURE,
    PRELOAD,
    UNKNOWN_TEMPERATURE,
    chosen_rows,
    torque_of_model,
)
from ballscrew.calibration.problem import CONSTANT_TORQUE
from ballscrew.calibration.response import resolve_input
from ballscrew.calibration.robust import Vector
from ballscrew.components.materials import TEMPERATURE
from ballscrew.errors import InputError
from ballscrew.evaluation.plan import Configuration
from ballscrew.quantities import Quantity
from ballscrew.uncertainty.distributions import Distribution, allowed

#: A cause explains a log as well as the preload if it is off by no more than this many times as much.
AS_WELL = 1.05
#: A number is looked for between this share and this multiple of what it is; an oil within so many kelvin.
FACTOR, KELVIN = 20.0, 60.0
#: Steps of the differences, as a share of that range.
STEP_SHARE = 1e-5
#: The interval that holds 95 % of a distribution.
_LEVEL = 0.025, 0.975
BOUNDARY_FRICTION, VISCOSITY = "boundary_friction_coefficient", "viscosity"


@dataclasses.dataclass(frozen=True)
class Alternative:
    """A number that would explain the worn log with the preload of the new one."""

    name: str
    quantity: Quantity
    #: The value it would need, and the one that it has, SI.
    value: float
    instead_of: float
    #: Root mean square of the residuals of the worn log with it, and with the preload in its place, N m.
    rms: float
    rms_of_preload: float
    #: Whether the value is within the uncertainty of the number; None where none is known.
    plausible: bool | None

    @property
    def explains(self) -> bool:
        """Whether it explains the log as well as the preload does."""
        return self.rms <= AS_WELL * self.rms_of_preload


class _Cause(NamedTuple):
    name: str
    quantity: Quantity
    start: float
    low: float
    high: float
    #: The torque of the rows with this value, from a subject.
    torque: Callable[[Configuration, float], Vector]
    value: Callable[[float], float]
    instead_of: float
    plausible: Callable[[float], bool | None]


def alternatives(found: CalibratedModel, preload: float, uncertain: Mapping[str, Distribution]) -> list[Alternative]:
    """What else could explain a log than the preload that its fit found, were the preload as given.

    Each number is fitted by itself, beside the errors of the sensor and a viscosity that the fit left open, to the
    rows that counted for the fit.
    """
    log = found.rows.log
    chosen = chosen_rows(len(log))
    chosen = chosen[~found.rows.outlying[chosen]]
    points = {name: values[chosen] for name, values in points_of(log, found.lubricant).items()}
    weights = found.rows.convention.weights(log.axial_load, log.screw_speed)[:, chosen]
    rows = _Rows(log.torque[chosen], found.rows.scatter[chosen], found.problem.sensor_columns[chosen], _wander(found))
    held = found.subject.changed({PRELOAD: preload})
    of_preload = rows.rms(torque_of_model(found.subject, points, weights))
    made: list[Alternative] = []
    for cause in _causes(found, points, weights, uncertain):
        value, rms = _explained(cause, held, rows, found)
        made.append(
            Alternative(
                cause.name, cause.quantity, cause.value(value), cause.instead_of, rms, of_preload,
                cause.plausible(value),
            )
        )  # fmt: skip
    return made


@dataclasses.dataclass(frozen=True)
class _Rows:
    """Measured torques, their scatter, and the columns of the sensor's errors with what is known of these."""

    torque: Vector
    scatter: Vector
    columns: Vector
    known: Vector

    def residuals(self, torque: Vector) -> Vector:
        """Residuals in units of the scatter, the errors of the sensor taken out of them."""
        off = (torque - self.torque) / self.scatter
        if not self.columns.shape[1] or not np.isfinite(off).all():
            return np.where(np.isfinite(off), off, 1e3)
        stacked = np.vstack([self.columns / self.scatter[:, np.newaxis], self.known])
        right = np.concatenate([off, np.zeros(self.known.shape[0])])
        return right - stacked @ np.linalg.lstsq(stacked, right, rcond=None)[0]

    def rms(self, torque: Vector) -> float:
        """Root mean square of the residuals, N m."""
        off = self.residuals(torque)[: self.torque.size] * self.scatter
        return float(np.sqrt(np.mean(off**2)))


def _wander(found: CalibratedModel) -> Vector:
    """What is known of the errors of the sensor, as rows beside those of the log."""
    free, deviations = found.problem.free, found.problem.deviations
    known: list[Vector] = []
    for place, prior in deviations.items():
        row = np.zeros(len(found.problem.parameters) - free)
        row[place - free] = 1 / getattr(prior, "deviation")  # noqa: B009  (normal ones are the only kind here)
        known.append(row)
    return np.array(known).reshape(len(known), len(found.problem.parameters) - free)


def _causes(
    found: CalibratedModel, points: Mapping[str, Any], weights: Vector, uncertain: Mapping[str, Distribution]
) -> list[_Cause]:
    subject = found.subject
    causes: list[_Cause] = []
    try:
        name = resolve_input(subject, BOUNDARY_FRICTION)
    except InputError:  # a law of one's own, without such a number
        pass
    else:
        causes.append(_by_number(found, name, points, weights, uncertain))
    if TEMPERATURE.name in points:
        causes.append(_by_temperature(found, points, weights))
    else:
        causes.append(_by_number(found, VISCOSITY, points, weights, uncertain))
    causes.append(_by_constant_torque(subject, points, weights))
    return causes


def _by_number(
    found: CalibratedModel, name: str, points: Mapping[str, Any], weights: Vector, uncertain: Mapping[str, Distribution]
) -> _Cause:
    quantity, now = found.subject.inputs[name][1], float(found.subject.value_of(name))
    if name in found.response.names:  # as it was in the case
        now = float(found.response.start[found.response.names.index(name)])
    low, high = allowed(quantity.info)
    distribution = uncertain.get(name)

    def plausible(logarithm: float) -> bool | None:
        if distribution is None:
            return None
        ends = (float(distribution.quantile(share)) for share in _LEVEL)
        first, last = ends
        return first <= now * math.exp(logarithm) <= last

    return _Cause(
        name.rpartition(".")[2],
        quantity,
        0.0,
        max(-math.log(FACTOR), math.log(low / now) if low > 0 else -math.inf),
        min(math.log(FACTOR), math.log(high / now)),
        lambda one, x: torque_of_model(one.changed({name: now * math.exp(x)}), points, weights),
        lambda x: now * math.exp(x),
        now,
        plausible,
    )


def _by_temperature(found: CalibratedModel, points: Mapping[str, Any], weights: Vector) -> _Cause:
    low, high = allowed(TEMPERATURE.info)
    rows = points[TEMPERATURE.name]
    usual = UNKNOWN_TEMPERATURE if found.rows.log.temperature is None else LOGGED_TEMPERATURE
    mean = float(np.mean(rows))
    return _Cause(
        TEMPERATURE.name, TEMPERATURE, 0.0,
        max(-KELVIN, low - float(np.min(rows))), min(KELVIN, high - float(np.max(rows))),
        lambda one, x: torque_of_model(_at_grade(one, found), points, weights, x),
        lambda x: mean + x, mean, lambda x: abs(x) <= usual,
    )  # fmt: skip


def _at_grade(subject: Configuration, found: CalibratedModel) -> Configuration:
    """The subject with the oil of the case, where the fit had found another viscosity: the temperature replaces it."""
    if VISCOSITY not in found.response.names:
        return subject
    start = found.response.start[found.response.names.index(VISCOSITY)]
    return subject.changed({VISCOSITY: float(start)})


def _by_constant_torque(subject: Configuration, points: Mapping[str, Any], weights: Vector) -> _Cause:
    known = subject.nut.losses.get(CONSTANT_LOSS)
    now = float(getattr(known, CONSTANT_TORQUE.name, 0.0))
    losses = _torque_of_losses(subject)
    usual = float(np.max(np.abs(torque_of_model(subject, points, np.abs(weights))))) or 1.0

    def plausible(torque: float) -> bool | None:
        # no more can be lost than what the seals have; where the case has none, nobody knows
        return None if losses == 0 else -losses <= torque - now <= losses

    return _Cause(
        CONSTANT_TORQUE.name, CONSTANT_TORQUE, now, now - 10 * usual, now + 10 * usual,
        lambda one, x: torque_of_model(with_constant_torque(one, x), points, weights),
        lambda x: x, now, plausible,
    )  # fmt: skip


def _torque_of_losses(subject: Configuration) -> float:
    result = subject.model(subject.screw, subject.lubricant, axial_load=0.0, screw_speed=1.0)
    return float(sum(abs(float(result.contributions[name])) for name in subject.nut.losses))


def _explained(cause: _Cause, held: Configuration, rows: _Rows, found: CalibratedModel) -> tuple[float, float]:
    """The value that explains the rows best, and the root mean square of what it leaves, N m."""
    from scipy.optimize import least_squares

    # a viscosity that the log left open stays open, but for a cause that stands in its place
    open_viscosity = VISCOSITY in found.response.names and cause.name not in (VISCOSITY, TEMPERATURE.name)
    viscosity = float(held.lubricant.viscosity)
    place = found.response.names.index(VISCOSITY) if VISCOSITY in found.response.names else 0

    def torque(x: Vector) -> Vector:
        subject = held.changed({VISCOSITY: viscosity * math.exp(x[1])}) if open_viscosity else held
        return cause.torque(subject, float(x[0]))

    def residuals(x: Vector) -> Vector:
        off = rows.residuals(torque(x))
        if not open_viscosity:
            return off
        values = found.solution.values.copy()
        values[place] = viscosity * math.exp(x[1])
        return np.concatenate([off, found.priors.residuals(values)])

    start, low, high = [cause.start], [cause.low], [cause.high]
    if open_viscosity:
        start, low, high = [*start, 0.0], [*low, -math.log(FACTOR)], [*high, math.log(FACTOR)]
    step = STEP_SHARE * (np.array(high) - np.array(low))

    def slopes(x: Vector) -> Vector:
        each = np.diag(step)
        return np.stack([(residuals(x + h) - residuals(x - h)) / (2 * np.max(h)) for h in each], axis=1)

    options: Any = {"jac": slopes}  # SciPy's types know only names
    best = least_squares(residuals, start, bounds=(low, high), x_scale=1e3 * step, xtol=1e-6, ftol=1e-8, **options).x
    return float(best[0]), rows.rms(torque(best))
