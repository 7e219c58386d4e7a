"""The preload that a log of torques tells, with its error: what the rows leave open, and what the model leaves open."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.special import stdtrit

from ballscrew.calibration.calibrated_model import CalibratedModel
from ballscrew.calibration.fit import points_of
from ballscrew.calibration.identifiability import weighted_derivatives
from ballscrew.calibration.robust import Vector
from ballscrew.components.materials import TEMPERATURE
from ballscrew.evaluation.outputs import OPERATION
from ballscrew.evaluation.plan import Configuration
from ballscrew.quantities import Force
from ballscrew.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.uncertainty.distributions import Distribution, normal_half_width

if TYPE_CHECKING:
    from ballscrew.uncertainty.sampling import JointNormal

#: The input that a service finds.
PRELOAD = "nut.preload"
#: Half the width of the 95 % interval of an oil temperature, K: that of a sensor near the nut, and without any.
LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE = 2.0, 10.0
#: Φ(−1) and Φ(1): values of an input one standard deviation to either side of its median.
ONE_DEVIATION = 0.15865525393145707, 0.8413447460685429
#: Effects of inputs are found over so many rows at most, evenly over the log.
MOST_ROWS = 4000


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class PreloadEstimate:
    """A preload in N, log-normal; the errors are standard deviations of its logarithm."""

    preload: Force
    #: What the rows leave open (the tolerance of a nominal preload); NaN where the log does not tell the preload.
    statistical: float
    #: By input, the effect of one standard deviation: errors of this log alone, such as that of its temperature.
    own: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    #: The same of numbers of the model, which are off alike in every log of this screw.
    common: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    #: Standard deviation of the logarithm by all numbers of the model together.
    common_deviation: float = 0.0
    #: The fit; None for a preload that is not from a log.
    fit: CalibratedModel | None = None
    #: Mean temperature of the log, K.
    temperature: float | None = None
    #: Rows whose load braces one side only: they tell nothing of the preload.
    rows_beyond_lift_off: int = 0

    @property
    def own_deviation(self) -> float:
        """Standard deviation of the logarithm that this log has for itself."""
        return math.hypot(self.statistical, *self.own.values())

    @property
    def deviation(self) -> float:
        """Standard deviation of the logarithm of the preload."""
        return math.hypot(self.own_deviation, self.common_deviation)

    def interval(self, level: float = 0.95) -> tuple[float, float]:
        """The interval of the preload, N; NaN where the log does not tell it."""
        factor = math.exp(normal_half_width(level) * self.deviation)
        return self.preload / factor, self.preload * factor


def torque_of_model(subject: Configuration, points: Mapping[str, Any], weights: Vector, warmer: float = 0.0) -> Vector:
    """The torque as it would be measured at the rows of a log, with an oil that is ``warmer`` by so many kelvin.

    What was changed of an oil keeps its ratio to that of the grade at all temperatures of the log.
    """
    oil = subject.lubricant
    if TEMPERATURE.name in points:
        oil = oil.at(points[TEMPERATURE.name] + warmer)
    found = subject.model(subject.screw, oil, **{name: points[name] for name in OPERATION})
    return weights[0] * found.ideal_torque + weights[1] * found.screw_torque


def chosen_rows(rows: int) -> Vector:
    """Places of the rows over which effects of inputs are found."""
    return np.unique(np.linspace(0, rows - 1, min(rows, MOST_ROWS)).astype(np.int64))


def of_log(
    found: CalibratedModel,
    uncertain: Mapping[str, Distribution],
    joint: JointNormal | None,
    temperature_used: bool,
) -> PreloadEstimate:
    """The preload of a fit, and what errors of the model and of the temperature do to it.

    An error that moves the torques of the model by Δ moves the parameters by −(JᵀWJ)⁻¹JᵀWΔ, in which J has the exact
    derivatives of the fit. Δ is half of what the input does between one standard deviation below and above its
    median: of wide distributions the tangent would tell less.
    """
    log = found.rows.log
    estimate = found.estimates[PRELOAD]
    if estimate.std is None or not estimate.value > 0:
        return PreloadEstimate(
            preload=estimate.value, statistical=math.nan, fit=found, temperature=_mean_temperature(found)
        )
    freedom = estimate.degrees_of_freedom
    student = float(stdtrit(freedom, 0.975)) / NORMAL_95
    chosen = chosen_rows(len(log))
    points = {name: values[chosen] for name, values in points_of(log, found.lubricant).items()}
    weights = found.rows.convention.weights(log.axial_load, log.screw_speed)[:, chosen]
    shift_of = _shift(found, chosen)

    def effect(low: Vector, high: Vector) -> float:
        return shift_of((high - low) / 2) / estimate.value

    own: dict[str, float] = {}
    if temperature_used:
        deviation = LOGGED_TEMPERATURE / NORMAL_95
        ends = (torque_of_model(found.subject, points, weights, sign * deviation) for sign in (-1, 1))
        own[TEMPERATURE.name] = effect(*ends)
    common: dict[str, float] = {}
    for name, distribution in uncertain.items():
        if name not in found.response.names:
            ends = (
                torque_of_model(found.subject.changed({name: float(distribution.quantile(share))}), points, weights)
                for share in ONE_DEVIATION
            )
            common[name] = effect(*ends)
    return PreloadEstimate(
        preload=estimate.value,
        statistical=student * estimate.std / estimate.value,
        own=own,
        common=common,
        common_deviation=combined(common, uncertain, joint),
        fit=found,
        temperature=_mean_temperature(found),
        rows_beyond_lift_off=_rows_beyond_lift_off(found),
    )


def combined(
    effects: Mapping[str, float], uncertain: Mapping[str, Distribution], joint: JointNormal | None = None
) -> float:
    """The effect of all inputs together, those of ``joint`` correlated; each of the effects is of one deviation."""
    total = math.fsum(effect**2 for effect in effects.values())
    if joint is not None:
        together = np.array([effects.get(name, 0.0) for name in joint.names])
        size = np.array([_half_width(uncertain[name]) if name in uncertain else math.inf for name in joint.names])
        total += float((together / size) @ joint.covariance @ (together / size) - together @ together)
    return math.sqrt(max(total, 0.0))


def _half_width(distribution: Distribution) -> float:
    low, high = (float(distribution.quantile(share)) for share in ONE_DEVIATION)
    return (high - low) / 2


def _shift(found: CalibratedModel, chosen: Vector) -> Any:
    """The change of the preload, N, that torques of the model too large by so much at the chosen rows bring."""
    solution, problem = found.solution, found.problem
    fitted = ~found.rows.held_out
    weight = np.zeros(len(found.rows.log))
    weight[fitted] = np.sqrt(solution.curvature) / solution.scatter * ~solution.outlying
    slopes = np.zeros((weight.size, solution.values.size))
    slopes[fitted] = weighted_derivatives(solution)
    thinning = math.sqrt(weight.size / chosen.size)
    scale = problem.scale_at(solution.values)
    stacked = np.vstack([thinning * slopes[chosen], found.priors.slopes(solution.values)]) * scale
    inverse = np.linalg.pinv(stacked)[problem.names.index(PRELOAD)] * scale[problem.names.index(PRELOAD)]

    def shift(torques: Vector) -> float:
        return -float(inverse[: chosen.size] @ (thinning * weight[chosen] * torques))

    return shift


def _mean_temperature(found: CalibratedModel) -> float | None:
    temperature = found.rows.log.temperature
    return None if temperature is None else float(np.mean(temperature))


def _rows_beyond_lift_off(found: CalibratedModel) -> int:
    """Rows whose load takes the preload off one side."""
    load = np.abs(found.rows.log.axial_load)
    loads = found.model(found.screw, found.lubricant, axial_load=0.0, screw_speed=1.0).loads
    return int(np.count_nonzero(load >= float(loads.lift_off_load)))
