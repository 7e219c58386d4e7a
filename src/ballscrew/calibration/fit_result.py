"""A model calibrated to a log: what was found, how well it is known, and what it predicts."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.analyses.calibration_words import product
from ballscrew.analyses.fit_problem import CONSTANT_TORQUE, Problem
from ballscrew.analyses.identifiability import Identifiability, Uncertainty
from ballscrew.analyses.next_test import NextTest, next_test
from ballscrew.analyses.plan import Subject
from ballscrew.analyses.posterior import Posterior, posterior
from ballscrew.analyses.priors import Priors
from ballscrew.analyses.readings import Reading
from ballscrew.analyses.response import Response
from ballscrew.analyses.robust import END, MEDIAN_TO_DEVIATION, Solution
from ballscrew.analyses.sampling import JointNormal
from ballscrew.analyses.torque_log import TorqueLog
from ballscrew.components.materials import TEMPERATURE, Lubricant
from ballscrew.components.screw import BallScrew
from ballscrew.faults import Fault, InputError
from ballscrew.model import FrictionModel
from ballscrew.quantities import AngularSpeed, Force, Quantity, Temperature, Torque

#: Residuals are looked at over so many parts of the rows.
PARTS = 5


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A fitted number in SI. Without identification there is no standard error."""

    name: str
    quantity: Quantity
    value: float
    std: float | None
    identified: bool
    start: float
    at_bound: bool = False
    #: Whether the log bounds it on one side only.
    one_sided: bool = False
    #: How much of the variance that a prior left is still there: 1 where the data add nothing; 0 without a prior.
    prior_share: float = 0.0
    #: Degrees of freedom of the standard error: rows fitted less numbers.
    freedom: float = np.inf
    bounds: tuple[float, float] = (-np.inf, np.inf)

    def interval(self, level: float = 0.95) -> tuple[float, float] | None:
        """The interval by Student's distribution, within the bounds; None where there is no standard error."""
        if self.std is None:
            return None
        from scipy.special import stdtrit

        half = float(stdtrit(self.freedom, 0.5 + level / 2)) * self.std
        return max(self.value - half, self.bounds[0]), min(self.value + half, self.bounds[1])


class Score(NamedTuple):
    """How far a description is off: root mean square over the rows fitted and the rows held out, outliers left out."""

    words: str
    numbers: int
    fitted: float
    held_out: float


class Band(NamedTuple):
    """Friction torque with an interval, N m; NaN where the log does not tell it."""

    low: Torque
    value: Torque
    high: Torque


class Trend(NamedTuple):
    """Residuals of friction over fifths of the rows in the order of something: its means, theirs, and the errors."""

    values: NDArray[np.float64]
    means: NDArray[np.float64]
    errors: NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class Rows:
    """The rows of the log that were used, with what the calibrated model says of them."""

    log: TorqueLog
    reading: Reading
    predicted: NDArray[np.float64]
    #: The friction torque in it.
    friction: NDArray[np.float64]
    held_out: NDArray[np.bool_]
    #: The scatter about the model at each row, as the rows fitted have it.
    scatter: NDArray[np.float64]

    @functools.cached_property
    def outlying(self) -> NDArray[np.bool_]:
        """The rows that are outliers: among those fitted, or among those held out, by the scatter of each."""
        off = np.abs(self.residuals) / self.scatter
        held = self.held_out
        # a model that is wrong for all rows held out must not lose them all
        wide = max(1.0, MEDIAN_TO_DEVIATION * float(np.median(off[held]))) if held.any() else 1.0
        return off > END * np.where(held, wide, 1.0)

    @property
    def direction(self) -> NDArray[np.float64]:
        """The sign of friction in what was measured."""
        return self.reading.weights(self.log.axial_load, self.log.screw_speed)[1]

    @property
    def residuals(self) -> NDArray[np.float64]:
        """Predicted less measured torque, N m."""
        return self.predicted - self.log.torque

    @functools.cached_property
    def trends(self) -> Mapping[str, Trend]:
        """How the residuals of friction depend on what was logged, outliers left out; positive: predicted too large."""
        log, kept = self.log, ~self.outlying
        against = {
            "screw_speed": np.abs(log.screw_speed),
            "axial_load": np.abs(log.axial_load),
            "temperature": log.temperature,
            "time": log.time,
        }
        off = self.residuals * self.direction
        return {
            name: _trend(values[kept], off[kept])
            for name, values in against.items()
            if values is not None and np.count_nonzero(kept) >= PARTS and np.ptp(values[kept]) > 0
        }

    def rms(self, residuals: NDArray[np.float64], chosen: NDArray[np.bool_]) -> float:
        """Root mean square of residuals of some rows, those left out that are outliers of the calibrated model."""
        counted = residuals[chosen & ~self.outlying]
        return float(np.sqrt(np.mean(counted**2))) if counted.size else float("nan")


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class CalibratedModel:
    """What :func:`~ballscrew.analyses.calibration.fit` returns."""

    #: Model, screw and lubricant with the fitted numbers in place.
    subject: Subject
    #: By the names that were asked for.
    estimates: Mapping[str, Estimate]
    #: Zero error and drift of the sensor, where they were fitted.
    sensor: Mapping[str, Estimate]
    identifiability: Identifiability
    uncertainty: Uncertainty
    problem: Problem
    priors: Priors
    solution: Solution
    rows: Rows
    #: The model before and after, and descriptions without physics.
    scores: Sequence[Score]
    settings: Mapping[str, Any]
    warnings: Sequence[str] = ()

    @property
    def residual_rms(self) -> float:
        """Root mean square of the residuals of the rows fitted, N m, outliers left out."""
        return self.rows.rms(self.rows.residuals, ~self.rows.held_out)

    @property
    def holdout_rms(self) -> float | None:
        """The same of the rows held out; None where there are none."""
        found = self.rows.rms(self.rows.residuals, self.rows.held_out)
        return None if np.isnan(found) else found

    @property
    def response(self) -> Response:
        """Both torques and their derivatives by the fitted numbers of the model."""
        return self.problem.response

    @property
    def model(self) -> FrictionModel:
        """The friction model with the fitted numbers."""
        return self.subject.model

    @property
    def screw(self) -> BallScrew:
        """The screw with the fitted numbers."""
        return self.subject.screw

    @property
    def lubricant(self) -> Lubricant:
        """The lubricant with the fitted numbers."""
        return self.subject.lubricant

    @property
    def constant_torque(self) -> float:
        """Friction torque beside the model's, N m; zero unless it was fitted."""
        found = self.estimates.get(CONSTANT_TORQUE.name)
        return 0.0 if found is None else found.value

    @property
    def joint(self) -> JointNormal:
        """The fitted numbers of the model as correlated inputs, for bands; those that are not identified stay put."""
        names = self.response.names
        count = len(names)
        told = np.array([estimate.identified for estimate in self.estimates.values()][:count])
        covariance = self.uncertainty.covariance[:count, :count] * np.outer(told, told)
        return JointNormal(names, self.solution.values[:count], covariance)

    def predict(self, axial_load: Force, screw_speed: AngularSpeed, temperature: Temperature | None = None) -> Torque:
        """Friction torque on the screw, N m, at loads (N), speeds (rad/s) and temperatures (K); arrays broadcast.

        Without a temperature the oil is as it was given. Raises :class:`~ballscrew.faults.InputError` for a
        temperature of an oil that was not made from a grade.
        """
        oil = self.lubricant if temperature is None else self.lubricant.at(temperature)
        load, speed = np.abs(np.asarray(axial_load, dtype=float)), np.abs(np.asarray(screw_speed, dtype=float))
        found = self.model(self.screw, oil, axial_load=load, screw_speed=speed)
        return found.screw_torque + self.constant_torque

    def band(
        self,
        axial_load: Force,
        screw_speed: AngularSpeed,
        temperature: Temperature | None = None,
        *,
        level: float = 0.95,
        scatter: bool = False,
    ) -> Band:
        """The friction torque with the interval that the calibration leaves, N m; with ``scatter``, of one reading.

        From the exact derivatives and the covariance: ``M ± z √(g C gᵀ)``, within what data and priors tell.
        Where the torque depends on what they do not tell, the interval is NaN.
        """
        if not 0 < level < 1:
            raise InputError(Fault("band.level", "must lie between 0 and 1", str(level), "0.95 is usual"))
        oil_temperature = self.lubricant.temperature if temperature is None else temperature
        given = [axial_load, screw_speed, *([] if oil_temperature is None else [oil_temperature])]
        arrays = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in given))
        names = ("axial_load", "screw_speed", TEMPERATURE.name)
        points = {name: np.abs(array).ravel() for name, array in zip(names, arrays, strict=False)}
        values = self.solution.values
        torques, slopes = self.response.at(points)(values[: len(self.response.names)])
        friction = torques[1] + self.constant_torque
        gradient = np.zeros((friction.size, values.size))
        gradient[:, : slopes.shape[2]] = slopes[1]
        if CONSTANT_TORQUE.name in self.estimates:
            gradient[:, slopes.shape[2]] = 1.0
        variance = self.uncertainty.variance_of(gradient) + (self.solution.noise.of(friction) ** 2 if scatter else 0.0)
        half = normal_half_width(level) * np.sqrt(variance)
        shape = arrays[0].shape
        return Band(*(np.reshape(torque, shape)[()] for torque in (friction - half, friction, friction + half)))

    def next_test(
        self, limits: Mapping[str, tuple[float, float]] | None = None, readings: int | None = None
    ) -> NextTest:
        """The test that would teach most; see :func:`ballscrew.analyses.next_test.next_test`."""
        return next_test(self, limits, readings)

    def posterior(self, steps: int = 2000, seed: int = 0, done: Callable[[int, int], None] | None = None) -> Posterior:
        """Samples of the fitted numbers; see :func:`ballscrew.analyses.posterior.posterior`."""
        return posterior(self, steps, seed, done)

    def report(self) -> str:
        """What was found, in plain text and SI units."""
        lines = ["number, value, standard error"]
        for estimate in (*self.estimates.values(), *self.sensor.values()):
            unit = "" if estimate.quantity.unit == "1" else f" {estimate.quantity.unit}"
            error = "not identified" if estimate.std is None else f"± {estimate.std:.2g}{unit}"
            lines.append(f"{estimate.name}: {estimate.value:.6g}{unit}, {error}")
        lines += [f"known: {product(c.powers)} to {c.relative_error:.2g}" for c in self.identifiability.combinations
                  if c.identified]  # fmt: skip
        lines += [f"not known: {product(c.powers)}" for c in self.identifiability.combinations if not c.identified]
        lines += [f"{s.words}: rms {s.fitted:.4g} N m, held out {s.held_out:.4g} N m" for s in self.scores]
        return "\n".join([*lines, *(f"beware: {warning}" for warning in self.warnings)])


def _trend(values: NDArray[np.float64], residuals: NDArray[np.float64]) -> Trend:
    parts = np.array_split(np.argsort(values, kind="stable"), PARTS)
    means = np.array([[values[part].mean(), residuals[part].mean()] for part in parts])
    errors = np.array([residuals[part].std() / np.sqrt(part.size) for part in parts])
    return Trend(means[:, 0], means[:, 1], errors)


def normal_half_width(level: float) -> float:
    """Half the width of the interval that holds a share of a standard normal distribution."""
    from ballscrew.analyses.distributions import standard_normal_quantile

    return float(standard_normal_quantile(np.float64(0.5 + level / 2)))
