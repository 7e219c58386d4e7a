"""Preloads from logs of torque, with the numbers of the model as uncertain as they are.

All logs of a screw are looked at together. Unknown are the preload of each, the numbers of the model, which are off by
the same in every log, and the temperature of each log. Samples of the numbers and temperatures are drawn from what is
known of them. With each sample, what every preload would have to be follows from the torques, and so does how well the
sample explains them: that is its weight. Errors that both preloads share so go from their ratio, however wide they are,
and what the torques say of a number counts.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution, standard_normal_quantile, standard_normal_share
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.fit import points_of
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.response import torque_of_model, usual_error
from ballscrew.evidence.calibration.robust import Vector

if TYPE_CHECKING:
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

#: Weights of ideal and friction torque: the friction torque alone.
FRICTION = np.array([[0.0], [1.0]])
#: Places of some of the rows of a log.
Places = NDArray[np.int64]
#: The input that a service finds.
PRELOAD = "nut.preload"
#: Rows of a log that alternatives are fitted to, evenly over it.
MOST_ROWS = 400
#: No model follows a nut to the noise of a sensor: taken to be off by this share of the torque at each of so many
#: parts of a log, independently (judgement).
MODEL_ERROR, MODEL_PARTS = 0.02, 10
#: Means of so many groups of rows at most stand for a log, each of so many rows.
MOST_GROUPS, LOAD_GROUPS, GROUP_ROWS = 12, 4, 3
#: Samples of a round, a power of two, and rounds at most: each draws from where the ones before found the weight, until
#: there are as many effective samples as are enough.
SAMPLES, ROUNDS, ENOUGH = 512, 24, 300
#: Preloads over that of the first fit between which the logarithm is tabulated, and how finely.
LEAST, MOST, NODES, FINE = 0.05, 4.0, 9, 161
#: The samples of a round are spread this much wider than the weight of the last one, those of a temperature that was
#: not logged from the beginning.
_WIDER, _WIDER_TEMPERATURE = 1.15, 2.0
#: Few samples tell variances better than how numbers go together: of that so much is believed.
_BELIEVED = 0.95
#: Share of the samples drawn from what was known in every round, so that no weight runs away.
_FROM_PRIOR = 0.2
#: With fewer samples of even weight than these, what is found is not to be used.
MINIMUM_SAMPLES = 20
#: A share so near 0 or 1 is as far as any number goes.
_LAST_SHARE = 1e-12


class Sensor(NamedTuple):
    """Derivatives of the rows by the errors of a sensor, and what is known of these, as rows beside them."""

    columns: Vector
    known: Vector

    @classmethod
    def of(cls, calibrated_model: CalibratedModel, chosen: Places) -> Sensor:
        """Those of a fit: a constant torque where it was free, zero error, drift, wandering."""
        columns = calibrated_model.problem.columns[chosen]
        linear = calibrated_model.problem.parameters[len(calibrated_model.response.names) :]
        rows = [
            row / parameter.deviation
            for parameter, row in zip(linear, np.eye(columns.shape[1]), strict=True)
            if parameter.deviation is not None
        ]
        return cls(columns, np.array(rows).reshape(len(rows), columns.shape[1]))


@dataclasses.dataclass(frozen=True, eq=False)
class Readings:
    """The rows of one log that are looked at."""

    fit: CalibratedModel
    points: Mapping[str, Any]
    weights: Vector
    torque: Vector
    sensor: Sensor
    #: Standard deviation of the oil temperature, K.
    temperature_deviation: float
    #: A usual friction torque, N m.
    friction: float

    @classmethod
    def of(cls, calibrated_model: CalibratedModel) -> Readings:
        """Rows evenly over the log of a fit."""
        log, convention = calibrated_model.rows.log, calibrated_model.rows.convention
        chosen = np.unique(np.linspace(0, len(log) - 1, min(len(log), MOST_ROWS)).astype(np.int64))
        return cls(
            fit=calibrated_model,
            points={
                name: values[chosen] for name, values in points_of(log, calibrated_model.lubricant, convention).items()
            },
            weights=convention.weights(log.axial_load, log.screw_speed)[:, chosen],
            torque=log.torque[chosen],
            sensor=Sensor.of(calibrated_model, chosen),
            temperature_deviation=oil_deviation(calibrated_model),
            friction=float(np.median(np.abs(calibrated_model.rows.friction))),
        )


class Groups(NamedTuple):
    """Means of groups of rows with alike loads and speeds: friction torque and its standard deviation, N m."""

    points: Mapping[str, Vector]
    friction: Vector
    deviation: Vector
    #: Whether a constant torque is unknown besides.
    constant: bool

    @classmethod
    def of(cls, calibrated_model: CalibratedModel) -> Groups:
        """Means of the rows of a fit, the errors of its sensor and its outliers taken out.

        A mean is the torque of the fit at the middle of the group, less what the fit is off by there: so it matters
        little that rows of a group are not at one point.
        """
        kept = np.flatnonzero(~calibrated_model.rows.outlying)
        rows = points_of(calibrated_model.rows.log, calibrated_model.lubricant, calibrated_model.rows.convention)
        load, speed = rows["axial_load"][kept], rows["screw_speed"][kept]
        # the mean of loads of both signs would be none that was there
        sides = [side for side in (np.flatnonzero(load >= 0), np.flatnonzero(load < 0)) if side.size]
        count = max(1, min(MOST_GROUPS, kept.size // GROUP_ROWS) // len(sides))
        loads = LOAD_GROUPS if count >= 2 * LOAD_GROUPS and np.ptp(np.abs(load)) > 0 else 1
        parts = [
            part[chosen]
            for side in sides
            for part in np.array_split(side[np.argsort(np.abs(load[side]), kind="stable")], loads)
            for chosen in np.array_split(np.argsort(speed[part], kind="stable"), count // loads)
            if chosen.size
        ]
        points = {name: np.array([values[kept][part].mean() for part in parts]) for name, values in rows.items()}
        points["screw_speed"] = np.array([np.exp(np.mean(np.log(speed[part]))) for part in parts])
        there = torque_of_model(calibrated_model.subject, points, FRICTION)
        off = (calibrated_model.rows.residuals * calibrated_model.rows.direction)[kept]
        friction = there - np.array([off[part].mean() for part in parts])
        noise = np.array([math.hypot(*calibrated_model.rows.scatter[kept][part]) / part.size for part in parts])
        error = MODEL_ERROR * math.sqrt(max(len(parts) / MODEL_PARTS, 1.0)) * np.abs(friction)
        return cls(points, friction, np.hypot(noise, error), CONSTANT_TORQUE.name in calibrated_model.problem.names)


class Conditional(NamedTuple):
    """Preload that a log asks for, by sample: logarithm over that of the first fit, variance, and the weight."""

    mean: Vector
    variance: Vector
    #: The logarithm of the probability of the torques.
    evidence: Vector
    #: The least sum of squares of standard scores.
    misfit: Vector


def conditional(
    groups: Groups, subject: Configuration, preload: float, values: Mapping[str, Vector], warmer: Vector
) -> Conditional:
    """Preload that the means of a log ask for, for samples of the numbers of the model and of the temperature."""
    from scipy.interpolate import CubicSpline  # slow to import: for those only who fit

    size, count = warmer.size, groups.friction.size
    nodes = np.linspace(math.log(LEAST), math.log(MOST), NODES)
    shape = (NODES, size, count)
    points = {name: np.broadcast_to(one, shape).ravel() for name, one in groups.points.items()}
    there = {name: np.broadcast_to(one[:, np.newaxis], shape).ravel() for name, one in values.items()}
    there[PRELOAD] = np.broadcast_to(preload * np.exp(nodes)[:, np.newaxis, np.newaxis], shape).ravel()
    oil = np.broadcast_to(warmer[:, np.newaxis], shape).ravel()
    torque = torque_of_model(subject.changed(there), points, FRICTION, oil).reshape(shape)
    fine = np.linspace(nodes[0], nodes[-1], FINE)
    curves = CubicSpline(nodes, np.log(np.where(torque > 0, torque, np.nan)), axis=0)
    scores = np.empty((FINE, size))
    for i, logarithm in enumerate(fine):  # one at a time: all at once are too many numbers
        at = np.exp(curves(logarithm))
        off = (at - groups.friction) / groups.deviation
        if groups.constant:
            one = 1 / groups.deviation
            off = off - np.outer(off @ one / (one @ one), one)
        scores[i] = np.einsum("sb,sb->s", off, off)
    scores = np.where(np.isfinite(scores), scores, np.inf)
    least = scores.min(axis=0)
    usable = np.isfinite(least)
    weights = np.exp(-0.5 * (scores - np.where(usable, least, 0.0)))
    total = weights.sum(axis=0) + ~usable
    mean = fine @ weights / total
    variance = np.maximum((fine**2) @ weights / total - mean**2, 0.0)
    return Conditional(mean, variance, np.where(usable, np.log(total) - 0.5 * least, -np.inf), least)


@dataclasses.dataclass(frozen=True, eq=False)
class Posterior:
    """Samples of the numbers of the model and the temperatures of the logs, with their weights."""

    #: By name, the sampled values of the numbers of the model.
    values: Mapping[str, Vector]
    #: The same in standard deviations from what is known of them, then the temperatures of the logs.
    scores: Vector
    names: Sequence[str]
    weights: Vector
    #: By log: how much warmer it is than logged, K, and the logarithm of the preload over that of the first fit.
    warmer: Sequence[Vector]
    preloads: Sequence[Conditional]
    #: The most probable sample.
    best: int

    @property
    def effective_samples(self) -> float:
        """Number of samples of even weight that tell as much."""
        return float(1 / np.sum(self.weights**2))

    def number_at_best(self) -> dict[str, float]:
        """The numbers of the model in the most probable sample."""
        return {name: float(drawn[self.best]) for name, drawn in self.values.items()}

    def shares(self, logarithm: Vector, variance: Vector) -> dict[str, float]:
        """Share of the variance of a quantity that goes along with each unknown."""
        off = self.scores - self.weights @ self.scores
        centred = logarithm - self.weights @ logarithm
        total = float(self.weights @ (centred**2 + variance))
        own = self.weights @ off**2
        along = (self.weights * centred) @ off
        return {
            name: float(along[i] ** 2 / own[i] / total) if own[i] > 0 and total > 0 else 0.0
            for i, name in enumerate(self.names)
        }

    def mean_scores(self) -> dict[str, float]:
        """Mean of each unknown, in standard deviations from what is known of it."""
        return dict(zip(self.names, (self.weights @ self.scores).tolist(), strict=True))


def posterior(
    subject: Configuration,
    groups: Mapping[str, Groups],
    fits: Sequence[CalibratedModel],
    uncertain: Mapping[str, Distribution],
    joint: JointNormal | None,
    seed: int,
) -> Posterior:
    """Samples of what the logs say, by adaptive importance sampling (see :data:`ROUNDS`)."""
    from scipy.special import logsumexp  # slow to import: for those only who fit

    from ballscrew.engine.uncertainty.monte_carlo import sobol_sequence  # loads xarray

    names, logs = list(uncertain), list(groups)
    count = len(names) + len(logs)
    mixing = _mixing(names, joint)
    deviations = [oil_deviation(one) for one in fits]
    mean, root = np.zeros(count), np.eye(count)
    for i, deviation in enumerate(deviations):
        root[len(names) + i, len(names) + i] = _WIDER_TEMPERATURE if deviation > LOGGED_TEMPERATURE / NORMAL_95 else 1.0
    weights, believed = np.full(SAMPLES, np.nan), np.zeros(SAMPLES)
    proposals: list[tuple[Vector, Vector]] = []
    drawn: list[Vector] = []
    rows: list[list[Conditional]] = []
    for turn in range(ROUNDS):
        shares = sobol_sequence(count + 1, SAMPLES, seed + turn)
        normal = np.asarray(standard_normal_quantile(shares[1:])).T
        scores = np.where((shares[0] < _FROM_PRIOR)[:, np.newaxis], normal, mean + normal @ root.T)
        proposals.append((mean, root))
        drawn.append(scores)
        values = values_of(scores[:, : len(names)] @ mixing.T, uncertain)
        rows.append(
            [
                conditional(
                    one, subject, fits[i].estimates[PRELOAD].value, values, deviations[i] * scores[:, len(names) + i]
                )
                for i, one in enumerate(groups.values())
            ]
        )
        every = np.concatenate(drawn)
        believed = np.concatenate([np.sum([one.evidence for one in each], axis=0) for each in rows]) + _normal(every)
        density = np.asarray(logsumexp([_density(every, *one) for one in proposals], axis=0))
        logarithms = believed - density
        weights = (
            np.exp(logarithms - np.max(logarithms)) if np.isfinite(logarithms).any() else np.full(len(every), np.nan)
        )
        weights /= np.sum(weights)
        if not np.isfinite(weights).all():
            break
        if 1 / np.sum(weights**2) >= ENOUGH:
            break
        # few samples have most of the weight at first: it is flattened for the next round
        flat = _flattened(weights)
        mean = flat @ every
        spread = (every - mean).T @ ((every - mean) * flat[:, np.newaxis])
        spread = np.where(np.eye(count) > 0, spread + 1e-3, _BELIEVED * spread)
        root = _WIDER * np.linalg.cholesky(spread)
    every = np.concatenate(drawn)
    scores = np.hstack([every[:, : len(names)] @ mixing.T, every[:, len(names) :]])
    return Posterior(
        values=values_of(scores[:, : len(names)], uncertain),
        scores=scores,
        names=[*names, *(f"temperature of the {log} log" for log in logs)],
        weights=weights,
        warmer=[deviation * every[:, len(names) + i] for i, deviation in enumerate(deviations)],
        preloads=[
            Conditional(*(np.concatenate(part) for part in zip(*one, strict=True))) for one in zip(*rows, strict=True)
        ],
        best=int(np.argmax(believed)),
    )


def values_of(scores: Vector, uncertain: Mapping[str, Distribution]) -> dict[str, Vector]:
    """The values of numbers that are so many standard deviations from their medians, as if they were normal."""
    return {
        name: np.asarray(distribution.quantile(_shares(scores[:, i])))
        for i, (name, distribution) in enumerate(uncertain.items())
    }


def oil_deviation(calibrated_model: CalibratedModel) -> float:
    """Standard deviation of the oil temperature of a log, K: less where it was logged and can be used."""
    return usual_error(calibrated_model.lubricant, calibrated_model.rows.log) / NORMAL_95


def _shares(scores: Vector) -> Vector:
    shares = np.array([standard_normal_share(float(score)) for score in scores])
    return np.clip(shares, _LAST_SHARE, 1 - _LAST_SHARE)


def _mixing(names: Sequence[str], joint: JointNormal | None) -> Vector:
    """Matrix from independent standard normal numbers to those that a calibration left correlated."""
    correlation = np.eye(len(names))
    if joint is not None:
        kept = [i for i, name in enumerate(joint.names) if name in names]
        places = [names.index(joint.names[i]) for i in kept]
        covariance = joint.covariance[np.ix_(kept, kept)]
        deviations = np.sqrt(np.diagonal(covariance))
        correlation[np.ix_(places, places)] = covariance / np.outer(deviations, deviations)
    return np.asarray(np.linalg.cholesky(correlation + 1e-9 * np.eye(len(names))), dtype=np.float64)


def _normal(scores: Vector) -> Vector:
    return -0.5 * np.sum(scores**2, axis=1)


def _density(scores: Vector, mean: Vector, root: Vector) -> Vector:
    """The logarithm of the density that samples were drawn from, but for a constant."""
    off = np.asarray(np.linalg.solve(root, (scores - mean).T).T, dtype=np.float64)
    other = _normal(off) - np.linalg.slogdet(root)[1]
    return np.logaddexp(math.log(_FROM_PRIOR) + _normal(scores), math.log(1 - _FROM_PRIOR) + other)


def _flattened(weights: Vector) -> Vector:
    """The weights to a power of 1 or less, so that a share of the samples of a round counts."""
    power = 1.0
    flat = weights
    while 1 / np.sum(flat**2) < SAMPLES / 8 and power > 0.05:
        power *= 0.7
        flat = weights**power / np.sum(weights**power)
    return flat


def errors_of_sensor(one: Readings, torque: Vector, factor: Vector) -> Vector:
    """The errors of the sensor that are most probable if the model has these torques, rows weighted by factors."""
    stacked = np.vstack([factor[:, np.newaxis] * one.sensor.columns, one.sensor.known])
    right = np.concatenate([factor * (one.torque - torque), np.zeros(one.sensor.known.shape[0])])
    return np.asarray(np.linalg.lstsq(stacked, right, rcond=None)[0], dtype=np.float64)
