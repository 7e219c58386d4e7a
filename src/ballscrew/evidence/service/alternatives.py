"""Other causes of a change of torque: the value that one number would need if the preload were as before."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import Quantity
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution, allowed
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.evidence.calibration.fit import CONSTANT_LOSS, with_constant_torque
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.response import VISCOSITY, resolve_input, torque_of_model
from ballscrew.evidence.calibration.robust import BIWEIGHT_CUTOFF, Vector, noise_of
from ballscrew.evidence.service.posterior import PRELOAD, Readings, errors_of_sensor
from ballscrew.physics.components.oil_grades import TEMPERATURE

#: A cause explains a log as well as the preload if it is off by no more than this many times as much.
AS_WELL = 1.05
#: A number is looked for between this share and this multiple of what it is; an oil within so many kelvin.
FACTOR, KELVIN = 20.0, 60.0
#: Rounds in which outliers are found.
ROUNDS = 3
#: Steps of the differences, as a share of that range.
_STEP_SHARE = 1e-5
#: The interval that holds 95 % of a distribution.
_LEVEL = 0.025, 0.975
BOUNDARY_FRICTION = "boundary_friction_coefficient"


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
        """True where this explains the log as well as the preload does."""
        return self.rms <= AS_WELL * self.rms_of_preload


@dataclasses.dataclass(frozen=True)
class _Cause:
    """A number with the change of it that is looked for, from 0."""

    name: str
    quantity: Quantity
    low: float
    high: float
    #: The subject and how much warmer the oil is, with a change of the number.
    changed: Callable[[Configuration, float], tuple[Configuration, float]]
    value: Callable[[float], float]
    instead_of: float
    plausible: Callable[[float], bool | None]


@dataclasses.dataclass(frozen=True)
class CountedRows:
    """The rows of a log that count."""

    log: Readings
    scatter: Vector
    kept: NDArray[np.bool_]

    def residuals(self, subject: Configuration, warmer: float) -> Vector:
        """Residuals in units of the scatter, the errors of the sensor taken out of them."""
        torque = torque_of_model(subject, self.log.points, self.log.weights, warmer)
        if not np.isfinite(torque[self.kept]).all():
            return np.full(np.count_nonzero(self.kept), 1e3)
        factor = np.where(self.kept, 1 / self.scatter, 0.0)
        torque = np.where(self.kept, torque, self.log.torque)
        off = torque + self.log.sensor.columns @ errors_of_sensor(self.log, torque, factor) - self.log.torque
        return (off / self.scatter)[self.kept]

    def rms(self, subject: Configuration, warmer: float) -> float:
        """Root mean square of the residuals, N m."""
        off = self.residuals(subject, warmer) * self.scatter[self.kept]
        return float(np.sqrt(np.mean(off**2)))


def rows_that_count(log: Readings, subject: Configuration, warmer: float) -> CountedRows:
    """The rows of a log but for outliers, with their scatter about what the numbers that were found give."""
    torque = torque_of_model(subject, log.points, log.weights, warmer)
    torque = np.where(np.isfinite(torque), torque, 0.0)
    scatter, kept = log.fit.solution.noise.of(log.torque), np.ones(torque.size, dtype=bool)
    for _ in range(ROUNDS):
        off = torque + log.sensor.columns @ errors_of_sensor(log, torque, kept / scatter) - log.torque
        scatter = noise_of(off, log.torque).of(log.torque)
        kept = np.abs(off) < BIWEIGHT_CUTOFF * scatter
    return CountedRows(log, scatter, kept)


def alternatives(
    log: Readings,
    subject: Configuration,
    warmer: float,
    preload: float,
    rows: CountedRows,
    uncertain: Mapping[str, Distribution],
) -> list[Alternative]:
    """Explanations of a log other than the preload that it told, were the preload as given.

    ``subject`` and ``warmer`` are what all logs together told. Each number is fitted by itself, beside the errors of
    the sensor and what is not known of the temperature, to the rows that count.
    """
    held = subject.changed({PRELOAD: preload})
    _, of_preload = _explained(_by_number(log, subject, warmer, PRELOAD, None), subject, rows)
    made: list[Alternative] = []
    for cause in _causes(log, subject, warmer, uncertain):
        change, rms = _explained(cause, held, rows)
        made.append(
            Alternative(
                cause.name,
                cause.quantity,
                cause.value(change),
                cause.instead_of,
                rms,
                of_preload,
                cause.plausible(change),
            )
        )
    return made


def _causes(
    log: Readings, subject: Configuration, warmer: float, uncertain: Mapping[str, Distribution]
) -> list[_Cause]:
    causes = [_by_oil(log, subject, warmer), _by_constant_torque(log, subject, warmer)]
    try:
        name = resolve_input(subject, BOUNDARY_FRICTION)
    except InputError:  # a law of one's own, without such a number
        return causes
    if float(subject.value_of(name)) > 0:
        causes.insert(0, _by_number(log, subject, warmer, name, uncertain.get(name)))
    return causes


def _by_number(
    log: Readings, subject: Configuration, warmer: float, name: str, distribution: Distribution | None
) -> _Cause:
    quantity, now = subject.inputs[name][1], float(subject.value_of(name))
    low, high = allowed(quantity.info)

    def plausible(change: float) -> bool | None:
        if distribution is None:
            return None
        first, last = (float(distribution.quantile(share)) for share in _LEVEL)
        return first <= now * math.exp(change) <= last

    return _Cause(
        name=name.rpartition(".")[2],
        quantity=quantity,
        low=max(-math.log(FACTOR), math.log(low) - math.log(now) if low > 0 else -math.inf),
        high=min(math.log(FACTOR), math.log(high) - math.log(now)),
        changed=lambda one, change: (one.changed({name: now * math.exp(change)}), warmer),
        value=lambda change: now * math.exp(change),
        instead_of=float(log.fit.subject.value_of(name)),
        plausible=plausible,
    )


def _by_oil(log: Readings, subject: Configuration, warmer: float) -> _Cause:
    """A temperature; of an oil without a grade the viscosity that it makes."""
    usual = NORMAL_95 * log.temperature_deviation
    graded = TEMPERATURE.name in log.points
    rows = np.atleast_1d(log.points[TEMPERATURE.name]) + warmer if graded else np.zeros(1)
    low, high = allowed(subject.lubricant.temperature_quantity.info) if graded else (-math.inf, math.inf)
    oil, mean = subject.lubricant, float(np.mean(rows))
    fall = float(oil.temperature_coefficient)

    def value(change: float) -> float:
        return mean + change if graded else float(oil.viscosity) * math.exp(-fall * (warmer + change))

    return _Cause(
        name=TEMPERATURE.name if graded else VISCOSITY,
        quantity=TEMPERATURE if graded else subject.inputs[VISCOSITY][1],
        low=max(-KELVIN, low - float(np.min(rows))),
        high=min(KELVIN, high - float(np.max(rows))),
        changed=lambda one, change: (one, warmer + change),
        value=value,
        instead_of=mean - warmer if graded else float(oil.viscosity),
        plausible=lambda change: abs(warmer + change) <= usual,
    )


def _by_constant_torque(log: Readings, subject: Configuration, warmer: float) -> _Cause:
    now = float(getattr(subject.nut.losses.get(CONSTANT_LOSS), CONSTANT_TORQUE.name, 0.0))
    result = subject.model(subject.screw, subject.lubricant, axial_load=0.0, screw_speed=1.0)
    losses = float(sum(abs(float(result.contributions[name])) for name in subject.nut.losses))
    widest = 10 * max(float(np.max(np.abs(log.torque))), log.friction)

    def plausible(change: float) -> bool | None:
        # no more can be lost than what the seals have; where the case has none, nobody knows
        return None if losses == 0 else -losses <= change <= losses

    return _Cause(
        name=CONSTANT_TORQUE.name,
        quantity=CONSTANT_TORQUE,
        low=-widest,
        high=widest,
        changed=lambda one, change: (with_constant_torque(one, now + change), warmer),
        value=lambda change: now + change,
        instead_of=now,
        plausible=plausible,
    )


def _explained(cause: _Cause, held: Configuration, rows: CountedRows) -> tuple[float, float]:
    """The change that explains the rows best, and the root mean square of what it leaves, N m."""
    from scipy.optimize import least_squares  # slow to import: for those only who fit

    # the temperature stays open as far as it is not known, but for the oil as a cause
    opened = cause.name not in (TEMPERATURE.name, VISCOSITY)
    deviation = rows.log.temperature_deviation

    def at(x: Vector) -> tuple[Configuration, float]:
        subject, there = cause.changed(held, float(x[0]))
        return subject, there + (deviation * float(x[1]) if opened else 0.0)

    def residuals(x: Vector) -> Vector:
        subject, there = at(x)
        known = [there / deviation] if opened else []
        return np.concatenate([rows.residuals(subject, there), known])

    low, high = [cause.low], [cause.high]
    if opened:
        low, high = [*low, -KELVIN / deviation], [*high, KELVIN / deviation]
    step = _STEP_SHARE * (np.array(high) - np.array(low))

    def slopes(x: Vector) -> Vector:
        each = np.diag(step)
        return np.stack([(residuals(x + h) - residuals(x - h)) / (2 * np.max(h)) for h in each], axis=1)

    options: Any = {"jac": slopes}  # SciPy's types know only names
    start = np.zeros(len(low))
    best = least_squares(residuals, start, bounds=(low, high), x_scale=1e3 * step, xtol=1e-5, ftol=1e-7, **options).x
    return float(best[0]), rows.rms(*at(best))
