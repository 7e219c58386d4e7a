"""The value of a condition over time: the state in each test, trend, alarm, warnings and verdicts.

Torques of the tests of an axis reduced to one temperature and speed, and the share of the preload that they ask for.

The model is made to agree with the first tests by a factor, which stands for what it does not know of this screw: so
only changes count. With it, the torque of each test asks for a preload, and that preload has a torque at the
reference: what the speed and the temperature of the day did has gone from it. All this is done for samples of the
numbers of the model; what they do not agree on is the doubt of the reduction.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Temperature, TemperatureCoefficient
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE
from ballscrew.evidence.calibration.response import resolve_input, torque_of_model
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.alternatives import BOUNDARY_FRICTION
from ballscrew.evidence.service.condition_means import Chart, Means, Trend, points_of
from ballscrew.evidence.service.posterior import FRICTION, MODEL_ERROR, PRELOAD
from ballscrew.evidence.service.preload_change import Verdict, verdict_of
from ballscrew.physics.components.oil_grades import TEMPERATURE

if TYPE_CHECKING:
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

#: Samples of the numbers of the model, a power of two.
SAMPLES = 64
#: A preload is looked for between these multiples of that of the first tests, by so many steps of the secant method.
LEAST, MOST, STEPS = 0.02, 50.0, 7
#: A torque that the preload found does not give to this share is given by none.
EXACT = 1e-6
#: A preload is told where more than this share of the samples have one.
MOST_TOLD = 0.9
#: The difference for slopes by temperature, K.
_KELVIN = 1.0


@dataclasses.dataclass(frozen=True, eq=False)
class Reduction:
    """The tests at the reference. Arrays have a number for each test, those of samples a row for each sample, too."""

    #: Logarithms of the torque over 1 N m and of the preload over that of the first tests: medians of the samples.
    torque: Vector
    preload: Vector
    #: Standard deviations over the samples: of the torque over that of the first tests, and of the preload.
    torque_doubt: Vector
    preload_doubt: Vector
    #: Derivatives of the logarithm of the torque by that of the preload, and by the temperature, 1/K.
    exponent: Vector
    per_kelvin: Vector
    #: By mean of the nominal screw: the logarithm of the measured torque over that of the model with its factor.
    off: Vector
    #: Measured torque of the first tests over that of the model: the median of the samples, and the 95 % interval.
    factor: float
    factor_interval: tuple[float, float]
    #: Where the tests are reduced to, K and rad/s.
    temperature: float
    screw_speed: float

    def temperature_deviation(self, means: Means, graded: bool) -> Vector:
        """Uncertainty of the temperature, by test, as a standard deviation of the logarithm of the torque."""
        known = means.logged & graded
        return np.abs(self.per_kelvin) * np.where(known, LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE) / NORMAL_95


@dataclasses.dataclass(frozen=True, eq=False)
class _Samples:
    """Screws that could be this one, the nominal one first."""

    subject: Configuration
    values: Mapping[str, Vector]
    nominal: float
    size: int

    @classmethod
    def of(
        cls, subject: Configuration, known: Mapping[str, Distribution], joint: JointNormal | None, seed: int
    ) -> _Samples:
        from ballscrew.engine.uncertainty.monte_carlo import Sampler, sobol_sequence  # loads xarray

        together = () if joint is None else joint.names
        sampler = Sampler(subject, {n: one for n, one in known.items() if n not in together}, {}, (), joint)
        nominal = float(subject.value_of(PRELOAD) or math.nan)
        if not sampler.names:
            return cls(subject, {}, nominal, 1)
        drawn = sampler.inputs_at(sobol_sequence(len(sampler.names), SAMPLES, seed))
        values = {
            name: np.concatenate([[_central(subject, name, known[name])], np.broadcast_to(one, SAMPLES)])
            for name, one in drawn.items()
            if name in known
        }
        return cls(subject, values, nominal, 1 + SAMPLES)

    def select(self, usable: NDArray[np.bool_]) -> _Samples:
        """The samples of a mask."""
        values = {name: one[usable] for name, one in self.values.items()}
        return dataclasses.replace(self, values=values, size=int(np.count_nonzero(usable)))

    def logarithms(self, points: Mapping[str, Vector], preload: Vector, warmer: float = 0.0) -> Vector:
        """Logarithms of the torques of all samples at points; the preload, as its logarithm, by sample and point."""
        shape = np.broadcast_shapes(preload.shape, (self.size, next(iter(points.values())).size))
        there = {name: np.broadcast_to(one[:, np.newaxis], shape).ravel() for name, one in self.values.items()}
        there[PRELOAD] = self.nominal * np.exp(np.broadcast_to(preload, shape).ravel())
        at = {name: np.broadcast_to(one, shape).ravel() for name, one in points.items()}
        torque = torque_of_model(self.subject.changed(there), at, FRICTION, np.full(at["screw_speed"].size, warmer))
        with np.errstate(divide="ignore", invalid="ignore"):
            values = np.log(torque).reshape(shape)
        return np.where(np.isfinite(values), values, np.nan)


def reduced(
    subject: Configuration,
    means: Means,
    baseline: int,
    known: Mapping[str, Distribution],
    joint: JointNormal | None,
    temperature: float | None,
    seed: int,
) -> Reduction:
    """The tests at the temperature (K; by default the mean of the first tests, or that of the case) and mean speed of
    the first tests.

    Raises :class:`~ballscrew.basis.errors.InputError` for tests at which the model has no torque.
    """
    samples = _Samples.of(subject, known, joint, seed)
    points = points_of(means, subject)
    first = means.test < baseline
    logarithm = np.log(means.torque)
    weights = 1 / np.maximum(means.deviation, 1e-3) ** 2
    at_zero = samples.logarithms(points, np.zeros((samples.size, logarithm.size)))
    raise_if_any(_faults_of_points(means, at_zero[0]))
    usable = np.asarray(np.isfinite(at_zero).all(axis=1))
    samples, at_zero = samples.select(usable), at_zero[usable]
    plain = _by_test(logarithm - at_zero, means, weights)
    factor = plain[:, :baseline].mean(axis=1)
    off = logarithm - at_zero - factor[:, np.newaxis]
    # what the model is off by at a speed is in the first tests, too, and goes out
    at_speeds = of_first_tests(off, means, baseline)
    target = logarithm - factor[:, np.newaxis] - at_speeds
    each, exponents = _preloads(samples, points, target, at_zero)
    preload = _by_test(each, means, weights * np.nanmean(exponents, axis=0) ** 2)
    if not means.at_the_same_speeds:
        preload = preload - preload[:, :baseline].mean(axis=1, keepdims=True)
    reference, usual = _reference(subject, points, first, temperature)
    there = {name: np.full(means.count, value) for name, value in reference.items()}
    torque = factor[:, np.newaxis] + samples.logarithms(there, preload)
    # a torque that no preload gives is reduced by what the reduction is for the preload of the first tests
    torque = np.where(np.isfinite(torque), torque, plain + samples.logarithms(there, np.zeros(preload.shape)))
    told = np.mean(np.isfinite(preload), axis=0) > MOST_TOLD
    preload = np.where(told, preload, 0.0)
    warm = factor[0] + samples.logarithms(there, preload, _KELVIN)[0]
    relative = torque - torque[:, :baseline].mean(axis=1, keepdims=True)
    low, high = np.exp(np.quantile(factor, [0.025, 0.975])).tolist()
    return Reduction(
        torque=np.median(torque, axis=0),
        preload=np.where(told, np.nanmedian(preload, axis=0), math.nan),
        torque_doubt=np.std(relative, axis=0),
        preload_doubt=np.where(told, np.nanstd(preload, axis=0), math.nan),
        exponent=_by_test(np.median(exponents, axis=0)[np.newaxis], means, weights)[0],
        per_kelvin=(warm - samples.logarithms(there, preload)[0] - factor[0]) / _KELVIN,
        off=off[0],
        factor=math.exp(float(np.median(factor))),
        factor_interval=(low, high),
        temperature=usual,
        screw_speed=reference["screw_speed"],
    )


def _faults_of_points(means: Means, at_zero: Vector) -> list[Fault]:
    bad = list(dict.fromkeys(means.test[~np.isfinite(at_zero)].tolist()))
    remedy = "look at its temperature and its speed, and at their units"
    return [Fault(f"condition: {means.labels[i]}", "the model has no torque there", "", remedy) for i in bad]


def _central(subject: Configuration, name: str, distribution: Distribution) -> float:
    value = subject.value_of(name)
    return float(distribution.quantile(0.5) if value is None else value)


def _preloads(
    samples: _Samples, points: Mapping[str, Vector], target: Vector, at_zero: Vector
) -> tuple[Vector, Vector]:
    """Logarithms of the preloads that give torques, by the secant method, and slopes; NaN where none does."""
    low, high = math.log(LEAST), math.log(MOST)
    before, off_before = np.zeros(target.shape), at_zero - target
    now = np.clip(-off_before, low, high)
    now = np.where(np.abs(now) < 1e-3, 1e-3, now)  # two points are needed, also where nothing changed
    slope = np.ones(target.shape)
    off = off_before
    for _ in range(STEPS):
        off = samples.logarithms(points, now) - target
        moved = now - before
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = np.where(np.abs(moved) > 1e-9, (off - off_before) / moved, slope)
            step = np.where(np.abs(off) > EXACT / 10, off / np.clip(slope, 0.05, 5.0), 0.0)
        before, off_before = now, off
        now = np.clip(now - step, low, high)
    return np.where(np.abs(off) < EXACT, before, np.nan), slope


def _reference(
    subject: Configuration, points: Mapping[str, Vector], first: Any, temperature: float | None
) -> tuple[dict[str, float], float]:
    """The operating point to which all is reduced, and its temperature."""
    speed = math.exp(float(np.mean(np.log(points["screw_speed"][first]))))
    reference = {"axial_load": float(np.mean(points["axial_load"][first])), "screw_speed": speed}
    usual: Any = subject.lubricant.temperature
    if TEMPERATURE.name not in points:
        return reference, math.nan
    warm = float(usual) if temperature is None else temperature
    if temperature is None:
        warm = float(np.mean(points[TEMPERATURE.name][first]))
    return {**reference, TEMPERATURE.name: warm}, warm


def of_first_tests(values: Vector, means: Means, baseline: int) -> Vector:
    """Values of means, averaged over the first tests at each speed, for all means; 0 if the tests have other speeds."""
    if not means.at_the_same_speeds:
        return np.zeros(values.shape)
    each = values.reshape(*values.shape[:-1], means.count, -1)[..., :baseline, :].mean(axis=-2)
    return np.tile(each, means.count)


def _by_test(values: Vector, means: Means, weights: Vector) -> Vector:
    """Weighted means of the values of each test; values that are not known are left out. Rows are samples."""
    vector = np.full((values.shape[0], means.count), math.nan)
    for test in range(means.count):
        rows = means.test == test
        own, weight = values[:, rows], np.broadcast_to(weights[rows], (values.shape[0], int(np.count_nonzero(rows))))
        weight = np.where(np.isfinite(own), weight, 0.0)
        total = weight.sum(axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            vector[:, test] = np.where(total > 0, (weight * np.nan_to_num(own)).sum(axis=1) / total, math.nan)
    return vector


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
        """True where the interval of the preload lies below that of the first tests."""
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
        """Direction of the torque, fall or rise, where there is an alarm."""
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
        return verdict_of(self.probability_of_loss)

    @property
    def warnings(self) -> list[str]:
        """The texts of the warnings."""
        return [record.text for record in self.warning_records]
