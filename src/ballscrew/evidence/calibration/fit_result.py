"""The value of a fit: estimates, scores, the rows used, and all that its diagnostics are computed from."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.displayed import LINES_OF_REPR, Displayed, shortened
from ballscrew.basis.quantities import Info, Quantity, Torque, Unit
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.monte_carlo import JointNormal
from ballscrew.evidence.calibration.identifiability import Identifiability, Uncertainty
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE, Priors, Problem, TorqueConvention
from ballscrew.evidence.calibration.response import Response, TemperatureError
from ballscrew.evidence.calibration.robust import BIWEIGHT_CUTOFF, MAD_TO_STANDARD_DEVIATION, Solution
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

#: Bins of rows over which the means of residuals are taken.
TREND_BINS = 5
#: With fewer operating points beyond the number of parameters than this, no estimate gets an error.
MINIMUM_DEGREES_OF_FREEDOM = 2
#: Descriptions of the scores of the model itself, before and after the fit.
AS_GIVEN, CALIBRATED = "the model as given", "the model calibrated"


@dataclasses.dataclass(frozen=True)
class Estimate:
    """The estimate of a parameter, in SI; without a standard error where it is not identified."""

    name: str
    quantity: Quantity
    value: float
    std: float | None
    identified: bool
    start: float
    at_bound: bool = False
    #: Whether the log bounds it on one side only.
    one_sided: bool = False
    #: Posterior variance over that of the prior: 1 where the data add nothing; 0 without a prior.
    prior_share: float = 0.0
    #: Share of the variance that is of the error of the oil temperature.
    temperature_share: float = 0.0
    #: Degrees of freedom of what the rows tell of the standard error: rows fitted less parameters.
    degrees_of_freedom: float = np.inf
    bounds: tuple[float, float] = (-np.inf, np.inf)

    def interval(self, level: float = 0.95) -> tuple[float, float] | None:
        """The interval by Student's distribution, within the bounds; None where there is no standard error.

        The part of the variance that is of the temperature is known and not estimated: with it the degrees of freedom
        are more (Satterthwaite1946), ``ν / (1 − share)²``.
        """
        if self.std is None:
            return None
        from scipy.special import stdtrit

        freedom = self.degrees_of_freedom / max(1 - self.temperature_share, 1e-6) ** 2
        half = float(stdtrit(freedom, 0.5 + level / 2)) * self.std
        return max(self.value - half, self.bounds[0]), min(self.value + half, self.bounds[1])


class Score(NamedTuple):
    """Root mean square of the residuals of a model over the rows fitted and the rows held out, without outliers."""

    description: str
    parameters: int
    fitted: float
    held_out: float


class Band(NamedTuple):
    """Friction torque with its confidence interval, N m; NaN where the log does not identify it."""

    low: Torque
    value: Torque
    high: Torque


class Trend(NamedTuple):
    """Means of a column and of the residuals of friction over fifths of the rows in its order, with standard errors."""

    #: Means of the column, SI.
    values: NDArray[np.float64]
    means: Annotated[
        NDArray[np.float64], Unit("N m"), Info("", "means of the residuals, positive where predicted too large")
    ]
    errors: Annotated[NDArray[np.float64], Unit("N m"), Info("", "standard errors of these means")]


@dataclasses.dataclass(frozen=True, eq=False)
class Rows:
    """The rows of the log that were used, with the predictions of the calibrated model."""

    log: TorqueLog
    convention: TorqueConvention
    predicted: NDArray[np.float64]
    #: The friction torque in it.
    friction: NDArray[np.float64]
    held_out: NDArray[np.bool_]
    #: Standard deviation of the noise at each row, from the rows fitted.
    scatter: NDArray[np.float64]

    @functools.cached_property
    def outlying(self) -> NDArray[np.bool_]:
        """The rows that are outliers: among those fitted, or among those held out, by the scatter of each."""
        off = np.abs(self.residuals) / self.scatter
        held = self.held_out
        # a model that is wrong for all rows held out must not lose them all
        wide = max(1.0, MAD_TO_STANDARD_DEVIATION * float(np.median(off[held]))) if held.any() else 1.0
        return off > BIWEIGHT_CUTOFF * np.where(held, wide, 1.0)

    @property
    def direction(self) -> NDArray[np.float64]:
        """The sign of friction in the measured torque."""
        return self.convention.weights(self.log.axial_load, self.log.screw_speed)[1]

    @property
    def residuals(self) -> NDArray[np.float64]:
        """Predicted less measured torque, N m."""
        return self.predicted - self.log.torque

    @functools.cached_property
    def trends(self) -> Mapping[str, Trend]:
        """Residuals of friction against each logged column, without outliers; positive: predicted too large."""
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
            if values is not None and np.count_nonzero(kept) >= TREND_BINS and np.ptp(values[kept]) > 0
        }

    def rms(self, residuals: NDArray[np.float64], chosen: NDArray[np.bool_]) -> float:
        """Root mean square of residuals of some rows, those left out that are outliers of the calibrated model."""
        counted = residuals[chosen & ~self.outlying]
        return float(np.sqrt(np.mean(counted**2))) if counted.size else float("nan")


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class FitResult(Displayed):
    """The data of a fit: estimates, their identifiability and covariance, the rows, and the scores."""

    #: Model, screw and lubricant with the fitted numbers in place.
    subject: Configuration
    #: By the names of the free parameters.
    estimates: Mapping[str, Estimate]
    #: Zero error and drift of the sensor, where they were fitted.
    sensor: Mapping[str, Estimate]
    #: Which numbers and products of numbers the log tells.
    identifiability: Identifiability
    #: Covariance of the parameters, within what data and priors measure.
    uncertainty: Uncertainty
    #: The error of the oil temperature, which is in the covariance.
    temperature_error: TemperatureError
    #: The parameters of the fit and their torques.
    problem: Problem
    #: Distributions of some of the parameters.
    priors: Priors
    #: Parameters, torques, residuals and noise of the fit.
    solution: Solution
    #: The rows of the log that were used, with the predictions.
    rows: Rows
    #: The model before and after, and descriptions without physics.
    scores: Sequence[Score]
    #: The options of the fit.
    settings: Mapping[str, Any]
    #: Numbers that no screw has: to be read before all others.
    verdict_records: Sequence[Record] = ()
    #: Warnings as records, the gravest first.
    warning_records: Sequence[Record] = ()

    def __repr__(self) -> str:
        """The estimates, in ten lines at most."""
        held_out = "" if self.holdout_rms is None else f", held out {self.holdout_rms:.4g} N m"
        heading = f"{type(self).__name__}: {self.rows.log.usage}; rms {self.residual_rms:.4g} N m{held_out}"
        remarks = len(self.verdicts) + len(self.warnings)
        end = [f"{remarks} warnings: see verdicts and warnings, or report()"] if remarks else []
        return "\n".join([heading, *shortened(self.estimate_lines, LINES_OF_REPR - 1 - len(end)), *end])

    @property
    def estimate_lines(self) -> list[str]:
        """A line for each estimate, in SI: ``boundary_friction_coefficient: 0.105, ± 0.0004``."""
        lines: list[str] = []
        for estimate in (*self.estimates.values(), *self.sensor.values()):
            unit = "" if estimate.quantity.unit == "1" else f" {estimate.quantity.unit}"
            error = "not identified" if estimate.std is None else f"± {estimate.std:.2g}{unit}"
            lines.append(f"{estimate.name}: {estimate.value:.6g}{unit}, {error}")
        return lines

    @property
    def verdicts(self) -> list[str]:
        """The texts of the verdicts: what makes the fit one that is not to be used."""
        return [record.text for record in self.verdict_records]

    @property
    def warnings(self) -> list[str]:
        """The texts of the warnings, the gravest first."""
        return [record.text for record in self.warning_records]

    @property
    def has_few_rows(self) -> bool:
        """True where the rows are too few for any estimate to have an error."""
        return min(e.degrees_of_freedom for e in self.estimates.values()) < MINIMUM_DEGREES_OF_FREEDOM

    @property
    def residual_rms(self) -> float:
        """Root mean square of the residuals of the rows fitted, N m, outliers left out."""
        return self.rows.rms(self.rows.residuals, ~self.rows.held_out)

    @property
    def holdout_rms(self) -> float | None:
        """The same of the rows held out; None where there are none."""
        rms = self.rows.rms(self.rows.residuals, self.rows.held_out)
        return None if np.isnan(rms) else rms

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
        result = self.estimates.get(CONSTANT_TORQUE.name)
        return 0.0 if result is None else result.value

    @property
    def joint(self) -> JointNormal:
        """The fitted numbers of the model as correlated inputs, for bands; those that are not identified stay put."""
        names = self.response.names
        count = len(names)
        identified = np.array([estimate.identified for estimate in self.estimates.values()][:count])
        covariance = self.uncertainty.covariance[:count, :count] * np.outer(identified, identified)
        return JointNormal(names, self.solution.values[:count], covariance)


def _trend(values: NDArray[np.float64], residuals: NDArray[np.float64]) -> Trend:
    parts = np.array_split(np.argsort(values, kind="stable"), TREND_BINS)
    means = np.array([[values[part].mean(), residuals[part].mean()] for part in parts])
    errors = np.array([residuals[part].std() / np.sqrt(part.size) for part in parts])
    return Trend(means[:, 0], means[:, 1], errors)
