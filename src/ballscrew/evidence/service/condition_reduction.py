"""Torques of the tests of an axis reduced to one temperature and speed, and the share of the preload that they ask for.

The model is made to agree with the first tests by a factor, which stands for what it does not know of this screw: so
only changes count. With it, the torque of each test asks for a preload, and that preload has a torque at the
reference: what the speed and the temperature of the day did has gone from it. All this is done for samples of the
numbers of the model; what they do not agree on is the doubt of the reduction.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE
from ballscrew.evidence.calibration.oil_temperature import torque_of_model
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.condition_means import Means, points_of
from ballscrew.evidence.service.posterior import FRICTION, PRELOAD
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
        """By test, what is not known of its temperature, as a standard deviation of the logarithm of the torque."""
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
