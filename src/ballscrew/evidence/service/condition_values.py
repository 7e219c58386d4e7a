"""The value of a condition over time: the state in each test, trend, alarm, warnings and verdicts."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import AngularSpeed, Temperature, TemperatureCoefficient
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE
from ballscrew.evidence.calibration.oil_temperature import torque_of_model
from ballscrew.evidence.calibration.response import resolve_input
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.alternatives import BOUNDARY_FRICTION
from ballscrew.evidence.service.change_detection import Chart, Trend
from ballscrew.evidence.service.condition_means import Means, points_of
from ballscrew.evidence.service.condition_reduction import Reduction, of_first_tests
from ballscrew.evidence.service.posterior import FRICTION, MODEL_ERROR, PRELOAD
from ballscrew.evidence.service.preload_change import CERTAIN, Verdict

#: Names of the causes.
CONSTANT, WARMER = "constant_torque", "temperature"
#: What a change may be before the torques are looked at, as standard deviations: of the logarithms of preload and
#: boundary friction, and of a constant torque over the usual friction (judgement).
USUAL: Mapping[str, float] = {PRELOAD: 1.0, BOUNDARY_FRICTION: 0.5, CONSTANT: 0.5}
#: What tests at the same speeds differ by, where nothing changed, beside the scatter within a log (judgement); of tests
#: at different speeds it is the error of the model.
REPEATABILITY = 0.005
#: A cause is told from the others where its deviation is less than this share of that, and of one test it needs so many
#: speeds.
TOLD, LEAST_SPEEDS = 0.5, 3
#: Steps of Gauss and Newton, and the differences of their slopes.
_STEPS, _DIFFERENCE = 4, 1e-3


@dataclasses.dataclass(frozen=True)
class Part:
    """A cause in one test: what it is now with its 95 % interval, beside the others and since the first tests.

    A share of what it was for preload and boundary friction, N m for a constant torque, K for a temperature.
    """

    value: float
    low: float
    high: float
    #: Whether the torques tell it from the others; if not, the interval is hardly less than what was known before.
    told: bool


def parts_of(subject: Configuration, means: Means, reduction: Reduction, baseline: int) -> list[dict[str, Part]]:
    """The causes by name, for each test; nothing for tests of fewer speeds than :data:`LEAST_SPEEDS`."""
    if int(means.speeds.min()) < LEAST_SPEEDS:
        return [{} for _ in range(means.count)]
    names = _names(subject)
    keys = [PRELOAD, *names, CONSTANT, WARMER]
    usual = math.exp(float(np.mean(np.log(means.torque))))
    priors = np.array([USUAL[PRELOAD], *(USUAL[BOUNDARY_FRICTION] for _ in names), USUAL[CONSTANT] * usual])
    kelvin = np.where(means.logged, LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE) / NORMAL_95
    before = np.column_stack([np.broadcast_to(priors, (means.count, len(keys) - 1)), kelvin])
    state, spread = np.zeros((means.count, len(keys))), np.zeros((means.count, len(keys)))
    factor = np.exp(np.log(means.torque) - reduction.off - _logarithms(subject, means, {}, np.zeros(1)))
    factor = factor * np.exp(of_first_tests(reduction.off, means, baseline))
    error = REPEATABILITY if means.at_the_same_speeds else MODEL_ERROR
    for _ in range(_STEPS):
        now, slopes = _model(subject, means, names, state, factor)
        for test in range(means.count):
            rows = means.test == test
            prior = before[test]
            weight = 1 / (np.hypot(means.deviation[rows], error) * means.torque[rows])
            matrix = np.vstack([slopes[rows] * weight[:, np.newaxis], np.diag(1 / prior)])
            right = np.concatenate([(means.torque[rows] - now[rows]) * weight, -state[test] / prior])
            state[test] += np.clip(np.linalg.lstsq(matrix, right, rcond=None)[0], -prior, prior)
            spread[test] = np.sqrt(np.diagonal(np.linalg.inv(matrix.T @ matrix)))
    state = state - state[:baseline].mean(axis=0)
    deviation = spread * math.sqrt(1 + 1 / baseline)
    told = spread < TOLD * before
    return [
        {
            key: _part(key, float(state[test, i]), float(deviation[test, i]), bool(told[test, i]))
            for i, key in enumerate([PRELOAD, *(BOUNDARY_FRICTION for _ in names), CONSTANT, WARMER])
        }
        for test in range(means.count)
    ]


def _part(key: str, value: float, deviation: float, told: bool) -> Part:
    ends = value - NORMAL_95 * deviation, value, value + NORMAL_95 * deviation
    low, middle, high = map(math.exp, ends) if key in (PRELOAD, BOUNDARY_FRICTION) else map(float, ends)
    return Part(middle, low, high, told)


def _names(subject: Configuration) -> list[str]:
    """The boundary friction of the model, if it has one."""
    try:
        name = resolve_input(subject, BOUNDARY_FRICTION)
    except InputError:  # a law of one's own, without such a number
        return []
    return [name] if float(subject.value_of(name)) > 0 else []


def _logarithms(subject: Configuration, means: Means, changes: Mapping[str, Any], warmer: Vector) -> Vector:
    torque = torque_of_model(
        subject.changed(changes) if changes else subject, points_of(means, subject), FRICTION, warmer
    )
    return np.log(np.broadcast_to(torque, means.torque.shape))


def _model(
    subject: Configuration, means: Means, names: list[str], state: Vector, factor: Vector
) -> tuple[Vector, Vector]:
    """Torques of the means with the state of their tests, and their derivatives."""
    numbers = [PRELOAD, *names]
    nominal = {name: float(subject.value_of(name)) for name in numbers}

    def at(shift: Vector) -> Vector:
        own = (state + shift)[means.test]
        changes = {name: nominal[name] * np.exp(own[:, i]) for i, name in enumerate(numbers)}
        return factor * np.exp(_logarithms(subject, means, changes, own[:, -1])) + own[:, -2]

    steps = _DIFFERENCE * np.eye(state.shape[1])
    here = at(np.zeros(state.shape[1]))
    return here, np.stack([(at(step) - here) / _DIFFERENCE for step in steps], axis=1)


@dataclasses.dataclass(frozen=True)
class State:
    """The state of an axis in one test; intervals hold 95 %."""

    #: Its time as written, or its name.
    label: str
    #: In s from the first test, or the number of the test.
    time: float
    #: As it was logged, K; None where it was not.
    temperature: Temperature | None
    #: Friction torque at the reference temperature and speed, N m; its interval has the temperature's doubt in it.
    torque: float
    torque_low: float
    torque_high: float
    #: Preload over that of the first tests, were nothing else changed; NaN where no preload gives the torque.
    preload: float
    preload_low: float
    preload_high: float
    #: Preload, constant torque, boundary friction and temperature beside each other, for tests of several speeds.
    parts: Mapping[str, Part]

    @property
    def preload_lost(self) -> bool:
        """Whether the interval of the preload lies below that of the first tests."""
        return self.preload_high < 1


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Condition:
    """Result of :func:`~ballscrew.evidence.service.condition.condition`."""

    #: Torque and preload of each test.
    states: Sequence[State]
    #: Number of the first tests, that the others are held against.
    baseline: int
    #: Share of healthy tests that give an alarm.
    false_alarms: float
    #: Temperature that is reduced to, K; NaN for an oil without a grade.
    reference_temperature: Temperature
    #: Speed that is reduced to, rad/s.
    reference_speed: AngularSpeed
    #: Sums of the torque's changes with their limits.
    chart: Chart
    #: Of the logarithm of the preload, by s or by test (``per``).
    trend: Trend
    #: What the trend is by: ``"s"``, or ``"test"`` for numbers of tests.
    per: str
    #: Standard deviation of the logarithm of the torque from test to test.
    scatter: float
    #: Share of the preload that may be lost.
    tolerance: float
    #: Probability that less than 1 − tolerance of the preload is left in the last test.
    probability_of_loss: float
    #: Derivative of the logarithm of the torque by the temperature at the reference in the last test, 1/K.
    per_kelvin: TemperatureCoefficient
    #: Derivative of the logarithm of the torque by that of the preload in the last test.
    exponent: float
    #: The torque of the first tests over that of the model.
    factor: float
    #: The interval of the factor.
    factor_interval: tuple[float, float]
    #: Tests whose temperature was logged and is used.
    temperatures: int
    #: Name and SHA-256 of the files.
    sources: Sequence[tuple[str, str]] = ()
    #: Remarks on the data, one line each.
    notes: Sequence[str] = ()
    #: Warnings as records.
    warning_records: Sequence[Record] = ()
    #: Verdicts as records.
    verdict_records: Sequence[Record] = ()

    @property
    def alarm(self) -> int | None:
        """The first test, from 0, in which the torque has changed beyond its scatter; None if there is none."""
        return self.chart.alarm

    @property
    def alarm_direction(self) -> Literal["fall", "rise"] | None:
        """Whether the torque falls or rises where there is an alarm."""
        return None if self.alarm is None else "fall" if self.chart.falls else "rise"

    @property
    def lost_since(self) -> int | None:
        """The first test, from the alarm on, whose interval of the preload, with all doubts, lies below the first."""
        if self.alarm is None:
            return None
        later = range(self.alarm, len(self.states))
        return next((i for i in later if self.states[i].preload_lost), None)

    @property
    def verdict(self) -> Verdict:
        """``"lost"`` or ``"kept"`` where that has a probability of :data:`CERTAIN`, otherwise ``"open"``."""
        probability = self.probability_of_loss
        return "lost" if probability >= CERTAIN else "kept" if probability <= 1 - CERTAIN else "open"

    @property
    def warnings(self) -> list[str]:
        """The texts of the warnings."""
        return [record.text for record in self.warning_records]
