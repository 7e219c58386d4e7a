"""Calibration: the numbers of a model that a log of torques tells, and which of them it cannot tell.

The constant torque as what a fit without it misses: found by a second fit, with it free.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, accepts_units, nearest, raise_if_any, si_value
from ballscrew.basis.quantities import Force, MomentOfInertia, TemperatureDifference, within_bounds
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.recordings import Engine, engine_faults
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.evidence.calibration import baselines
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.diagnostics import verdict_records, warning_records
from ballscrew.evidence.calibration.fit_result import (
    AS_GIVEN,
    CALIBRATED,
    MINIMUM_DEGREES_OF_FREEDOM,
    Estimate,
    Rows,
    Score,
)
from ballscrew.evidence.calibration.identifiability import (
    MAXIMUM_RELATIVE_ERROR,
    Identifiability,
    Uncertainty,
    jackknife_covariance,
    operating_points,
)
from ballscrew.evidence.calibration.problem import (
    CONSTANT_TORQUE,
    Priors,
    Problem,
    TorqueConvention,
    drift_of,
    escape_insensitive_start,
    identify_convention,
)
from ballscrew.evidence.calibration.response import (
    MOST_TEMPERATURE_ERROR,
    Response,
    TemperatureError,
    resolve_input,
    torque_per_kelvin,
    usual_error,
)
from ballscrew.evidence.calibration.robust import Solution, Vector, loss_of, solve
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.nut_losses import ConstantTorque
from ballscrew.physics.solvers.load_distribution import ball_loads

#: The loss of a nut that a fitted constant torque becomes.
CONSTANT_LOSS = "constant"
#: How often a fit evaluates the whole log, roughly: only the choice of the engine depends on it.
EVALUATIONS = 60
#: With fewer operating points than this, single rows are held out; with fewer rows than this, none are.
MINIMUM_CELLS, MINIMUM_ROWS = 10, 10
#: The errors of fewer rows than this are at least those of the jackknife, which fits once for each operating point.
JACKKNIFE_ROWS = 16
#: An estimate so near a bound, in units of its scale, is at it.
AT_BOUND = 1e-3
#: Where a number moves by two standard errors, the loss rises by four; by less than this share of it, it is flat.
STEP_ERRORS, FLAT_SHARE = 2.0, 0.2
#: A number whose prior keeps more than this share of its variance is known by the prior alone.
PRIOR_ONLY_SHARE = 0.9


@accepts_units("fit")
def fit(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    data: Any,
    free: Sequence[str] = ("boundary_friction_coefficient",),
    *,
    priors: Mapping[str, Distribution] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    kind: Kind = "unknown",
    inertia: MomentOfInertia | None = None,
    holdout: float = 0.2,
    temperature_error: TemperatureDifference | None = None,
    dynamic_load_rating: Force | None = None,
    seed: int = 0,
    engine: Engine | None = None,
    done: Callable[[int, int], None] | None = None,
) -> CalibratedModel:
    """Fit numbers of a model, its screw or its lubricant to a log of torques.

    Returns a :class:`~ballscrew.evidence.calibration.calibrated_model.CalibratedModel`. ``model``, ``screw`` and
    ``lubricant`` have the values from which the fit starts, and those of all numbers that are not free. ``data`` is a
    :class:`~ballscrew.files.torque_logs.torque_log.TorqueLog`, or a mapping or dataset of arrays in SI: ``axial_load``,
    ``screw_speed`` and ``torque``, and where they were logged ``temperature`` (for an oil made from a grade) and
    ``time``. ``free`` names what is fitted, as :func:`~ballscrew.engine.sweeps.sweep.sweep` does or by the last part of
    the name alone; ``"constant_torque"`` stands for friction of seals and bearings, which no model of the balls has.

    ``priors`` are distributions of free numbers, ``bounds`` pairs in SI beside those that the numbers have anyway.
    ``kind`` says whether ``torque`` is ``"friction"`` or ``"drive"`` torque; otherwise the model tells (see
    :mod:`~ballscrew.evidence.calibration.problem`). ``inertia`` (kg m²) takes the acceleration out of a
    drive torque. ``temperature_error`` (K) is half the width of the 95 % interval of the oil temperature, an error that
    all rows share and that no number of rows makes smaller: 2 K where the log has temperatures that the oil follows,
    otherwise 10 K. It does not move the estimates; their covariance has it
    (:mod:`~ballscrew.evidence.calibration.baselines`). The ``dynamic_load_rating`` (N) is what a fitted preload
    is judged by: numbers that no screw has are among the verdicts
    (:mod:`~ballscrew.evidence.calibration.diagnostics`). The share ``holdout`` of the operating points, drawn with the
    ``seed``, is not fitted but predicted. Zero error and drift of the sensor are fitted beside the rest where the log
    can tell them from friction (:mod:`~ballscrew.evidence.calibration.problem`).

    ``engine`` (``"numpy"`` or ``"compiled"``) evaluates the model. ``done(finished, total)`` is told the rounds of the
    fit, of which there may be fewer.

    The loss is robust (:mod:`~ballscrew.evidence.calibration.robust`), the derivatives are exact, the standard errors
    hold for residuals that are not normal and that follow each other
    (:class:`~ballscrew.evidence.calibration.identifiability.Uncertainty`). A number that the data do not tell gets
    none.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, data that cannot be used, and laws that
    cannot be recorded.
    """
    subject = Configuration(model, screw, lubricant)
    if CONSTANT_TORQUE.name in free:  # found anew: that of an earlier fit goes
        subject = with_constant_torque(subject, None)
    raise_if_any(_faults_of_options(free, priors or {}, bounds or {}, holdout, temperature_error, seed, kind, engine))
    asked = _asked(subject, free)
    limits = _limits(subject, asked, bounds or {})
    evaluated = _Evaluated.of(subject, asked, _log_of(data, lubricant, inertia), engine)
    raise_if_any(_faults_of_unloaded_balls(subject, evaluated.log))
    # what the column is can be looked up in all rows: of few, those left to fit do not always tell
    convention, _ = evaluated.convention(evaluated.log.kind if kind == "unknown" else kind)
    evaluated = evaluated.under(convention)
    _, left = evaluated.convention(known=convention)
    log, torques = evaluated.log, evaluated.torques
    held_out = _held_out(log, holdout, seed)
    problem = Problem.of(subject, evaluated.response, asked, log, convention, left, torques, evaluated.slopes, limits)
    fitted = _Fitted.of(problem, log, held_out, priors or {}, left, done)
    solution = fitted.solution
    predicted, _ = problem.torque(solution.values)
    friction = problem.response(solution.values[: len(problem.response.names)])[0][1]
    rows = Rows(log, convention, predicted, friction, held_out, solution.noise.of(predicted))
    told = Identifiability.of(solution, problem.names, fitted.scale)
    uncertainty, degrees_of_freedom = _uncertainty(fitted)
    one_sided = _one_sided(fitted, uncertainty)
    made = _with(subject, problem, solution)
    half_width = usual_error(lubricant, log) if temperature_error is None else float(temperature_error)
    warmth = _temperature_error(half_width, made, problem.response.points, fitted, uncertainty)
    total = uncertainty.plus(warmth.covariance)
    estimates = _estimates(fitted, one_sided, total, uncertainty, degrees_of_freedom)
    calibrated_model = CalibratedModel(
        subject=made,
        estimates={name: estimates[name] for name in problem.names},
        sensor={name: estimate for name, estimate in estimates.items() if name not in problem.names},
        identifiability=told,
        uncertainty=total,
        temperature_error=warmth,
        problem=problem,
        priors=fitted.known,
        solution=solution,
        rows=rows,
        scores=_scores(problem, rows, torques),
        settings={
            "free": list(free),
            "priors": {name: prior.describe(problem.quantity(name).unit) for name, prior in (priors or {}).items()},
            "bounds": {name: list(pair) for name, pair in limits.items()},
            "holdout": holdout,
            "temperature_error": half_width,
            "seed": seed,
            "inertia": inertia,
            "reading": convention.description,
        },
    )
    calibrated_model = dataclasses.replace(
        calibrated_model, verdict_records=tuple(verdict_records(calibrated_model, dynamic_load_rating))
    )
    return dataclasses.replace(calibrated_model, warning_records=warning_records(calibrated_model))


def _asked(subject: Configuration, free: Sequence[str]) -> dict[str, str]:
    """The inputs that are fitted, by the names that they were given."""
    constant = CONSTANT_TORQUE.name
    asked = {name: constant if name == constant else resolve_input(subject, name, beside=(constant,)) for name in free}
    raise_if_any(
        [
            Fault("fit.free", "names one number twice", f"{name} and {other}", "leave one out")
            for place, name in enumerate(asked)
            for other in list(asked)[:place]
            if asked[other] == asked[name]
        ]
    )
    return asked


def _limits(
    subject: Configuration, asked: Mapping[str, str], bounds: Mapping[str, tuple[float, float]]
) -> dict[str, tuple[float, float]]:
    """The bounds of free numbers in SI."""
    units = {name: _unit_of(subject, full) for name, full in asked.items()}
    return {
        name: (
            float(si_value(f"fit.bounds.{name}", low, units[name])),
            float(si_value(f"fit.bounds.{name}", high, units[name])),
        )
        for name, (low, high) in bounds.items()
    }


def _log_of(data: Any, lubricant: Lubricant, inertia: float | None) -> TorqueLog:
    """The rows of steady motion, at temperatures that an oil may have."""
    log = TorqueLog.of(data).cleaned(inertia=inertia)
    if not lubricant.follows_temperature or log.temperature is None:
        return log
    within = np.asarray(within_bounds(lubricant.temperature_quantity.info, log.temperature))
    if not within.any():
        given = f"{np.median(log.temperature):.4g} K"
        raise InputError(Fault("log.temperature", "is beyond any oil in every row", given, "check its unit"))
    return log.select(within, "temperature beyond any oil")


@dataclasses.dataclass(frozen=True, eq=False)
class _Evaluated:
    """The rows of a log in which the model has a torque, with that torque and its slopes before the fit."""

    log: TorqueLog
    response: Response
    torques: Vector
    slopes: Vector

    @classmethod
    def of(cls, subject: Configuration, asked: Mapping[str, str], log: TorqueLog, engine: Engine | None) -> _Evaluated:
        """Those of a log by the inputs asked for."""
        numbers = [name for name in dict.fromkeys(asked.values()) if name != CONSTANT_TORQUE.name]
        points = points_of(log, subject.lubricant)
        return cls._where_finite(log, Response.of(subject, numbers, points, engine=engine, times=EVALUATIONS))

    @classmethod
    def _where_finite(cls, log: TorqueLog, response: Response) -> _Evaluated:
        torques, slopes = response(response.start)
        finite = np.asarray(np.isfinite(torques).all(axis=0))
        if finite.all():
            return cls(log, response, torques, slopes)
        log = log.select(finite, "no torque in the model")
        points = {name: values[finite] for name, values in response.points.items()}
        return cls(log, response.at(points), torques[:, finite], slopes[:, finite])

    def convention(
        self, kind: Kind = "unknown", known: TorqueConvention | None = None
    ) -> tuple[TorqueConvention, float]:
        """The convention of the torques, and the scatter that remains under it."""
        log = self.log
        return identify_convention(
            log.torque, self.torques, log.axial_load, log.screw_speed, drift_of(log), kind, known
        )

    def under(self, convention: TorqueConvention) -> _Evaluated:
        """The same at loads with the signs that a convention gives them."""
        loads = convention.loads(self.log.axial_load, self.log.screw_speed)
        if np.array_equal(loads, self.log.axial_load):
            return self
        return self._where_finite(self.log, self.response.at({**self.response.points, "axial_load": loads}))


@dataclasses.dataclass(frozen=True, eq=False)
class _Fitted:
    """A problem solved on the rows of a log that are not held out."""

    problem: Problem
    log: TorqueLog
    held_out: NDArray[np.bool_]
    start: Vector
    known: Priors
    solution: Solution

    @classmethod
    def of(
        cls,
        problem: Problem,
        log: TorqueLog,
        held_out: NDArray[np.bool_],
        priors: Mapping[str, Distribution],
        scatter: float,
        done: Callable[[int, int], None] | None,
    ) -> _Fitted:
        """The solution; from another start where it came to rest at numbers that the torques do not depend on."""
        torque, measured = problem.on(~held_out), log.torque[~held_out]
        start = escape_insensitive_start(problem, measured, scatter, problem.start, ~held_out)
        given = {problem.names.index(name): prior for name, prior in priors.items()}
        known = Priors(problem.deviations | given, start, problem.scale)
        solution = solve(torque, measured, start, problem.scale, problem.bounds, known.all, done)
        again = escape_insensitive_start(problem, measured, scatter, solution.values, ~held_out)
        if not np.array_equal(again, solution.values):
            solution = solve(torque, measured, again, problem.scale, problem.bounds, known.all, done)
        return cls(problem, log, held_out, start, known, solution)

    @property
    def scale(self) -> Vector:
        """The scales of the numbers found."""
        return self.problem.scale_at(self.solution.values)

    @property
    def slopes_of_priors(self) -> Vector:
        """The slopes of the priors at the numbers found."""
        return self.known.slopes(self.solution.values)


def _uncertainty(fitted: _Fitted) -> tuple[Uncertainty, int]:
    """The uncertainty by the rows, of few rows at least that of the jackknife, and its degrees of freedom."""
    solution, log, held_out = fitted.solution, fitted.log, fitted.held_out
    uncertainty = Uncertainty.of(solution, fitted.scale, fitted.slopes_of_priors)
    degrees_of_freedom = solution.residuals.size - solution.values.size
    if solution.residuals.size < JACKKNIFE_ROWS:
        groups = _groups(log, held_out, solution.values.size)
        degrees_of_freedom = np.unique(groups[~held_out]).size - solution.values.size
        if degrees_of_freedom >= MINIMUM_DEGREES_OF_FREEDOM:
            problem = fitted.problem
            spread = jackknife_covariance(problem, log.torque, groups, fitted.start, problem.scale, fitted.known.all)
            uncertainty = uncertainty.at_least(spread)
    different = _different_rows(log, held_out) - solution.values.size
    if different < MINIMUM_DEGREES_OF_FREEDOM:
        degrees_of_freedom = min(different, degrees_of_freedom)
    return uncertainty, degrees_of_freedom


def points_of(
    log: TorqueLog, lubricant: Lubricant, convention: TorqueConvention | None = None
) -> dict[str, NDArray[np.float64]]:
    """The loads of a log, with the signs that a convention gives them, sizes of the speeds, and the temperature where
    the oil has a grade.
    """
    loads = log.axial_load if convention is None else convention.loads(log.axial_load, log.screw_speed)
    points = {"axial_load": loads, "screw_speed": np.abs(log.screw_speed)}
    if lubricant.follows_temperature:
        held = np.full(len(log), lubricant.temperature) if log.temperature is None else log.temperature
        points[TEMPERATURE.name] = held
    return points


def _temperature_error(
    half_width: float, made: Configuration, points: Mapping[str, Any], fitted: _Fitted, uncertainty: Uncertainty
) -> TemperatureError:
    """Effect of the error of the oil temperature on the estimates."""
    solution, problem = fitted.solution, fitted.problem
    if half_width == 0:
        return TemperatureError(0.0, np.zeros(fitted.held_out.size), np.zeros(solution.values.size))
    each = torque_per_kelvin(made, problem.response.names, points, problem.weights)
    shift = uncertainty.shift_by(solution, fitted.slopes_of_priors, each[~fitted.held_out])
    return TemperatureError(half_width, each, shift)


def _faults_of_options(
    free: Sequence[str],
    priors: Mapping[str, Any],
    bounds: Mapping[str, Any],
    holdout: Any,
    temperature_error: Any,
    seed: Any,
    kind: Any,
    engine: Any,
) -> list[Fault]:
    faults = engine_faults("fit", engine)
    if isinstance(free, str) or not len(free):
        faults.append(Fault("fit.free", "must be a list of names", str(free), 'free=["boundary_friction_coefficient"]'))
        return faults
    if set(free) == {CONSTANT_TORQUE.name}:
        faults.append(Fault("fit.free", "needs a number of the model, too", CONSTANT_TORQUE.name, "add one"))
    if not isinstance(seed, int) or seed < 0:
        faults.append(Fault("fit.seed", "must be a whole number, 0 or more", str(seed)))
    faults += [
        Fault(f"fit.priors.{n}", "is no distribution", str(p), "such as ballscrew.Normal(0.12, 0.02)")
        for n, p in priors.items()
        if not isinstance(p, Distribution)
    ]
    faults += [
        Fault(f"fit.bounds.{n}", "must be a pair of numbers", str(pair), "such as (0.05, 0.2)")
        for n, pair in bounds.items()
        if not isinstance(pair, list | tuple | np.ndarray) or len(pair) != 2
    ]
    for where, named in {"priors": priors, "bounds": bounds}.items():
        faults += [Fault(f"fit.{where}.{n}", "is not free", "", nearest(n, free)) for n in named if n not in free]
    if not isinstance(holdout, int | float) or not 0 <= holdout <= 0.5:
        faults.append(Fault("fit.holdout", "must be a share from 0 to 0.5", str(holdout), "0.2 is usual"))
    if temperature_error is not None and not 0 <= temperature_error <= MOST_TEMPERATURE_ERROR:
        most_temperature_error = units.to_significant(MOST_TEMPERATURE_ERROR, 6)
        problem = f"must be from 0 to {most_temperature_error} K"
        faults.append(
            Fault("fit.temperature_error", problem, str(temperature_error), "2 K is usual where it is logged")
        )
    if kind not in get_args(Kind):
        faults.append(Fault("fit.kind", "unknown kind of torque", str(kind), f"one of {', '.join(get_args(Kind))}"))
    return faults


def _faults_of_unloaded_balls(subject: Configuration, log: TorqueLog) -> list[Fault]:
    """A fault of a log that was given no load if the nut has no preload either."""
    if not log.assumes_no_load or np.any(np.asarray(ball_loads(subject.screw, subject.nut, 0.0).remaining_preload) > 0):
        return []
    remedy = "give the column of the load, or a nut with its preload"
    return [Fault("log", "has no load, and the nut has no preload: no ball carries anything", "", remedy)]


def _unit_of(subject: Configuration, name: str) -> str:
    return CONSTANT_TORQUE.unit if name == CONSTANT_TORQUE.name else subject.inputs[name][1].unit


def _held_out(log: TorqueLog, share: float, seed: int) -> NDArray[np.bool_]:
    """The rows that are held out: whole operating points where there are enough of them, or else single rows."""
    rows = len(log)
    if share == 0 or rows < MINIMUM_ROWS:
        return np.zeros(rows, dtype=bool)
    cell = operating_points(log.axial_load, log.screw_speed)
    cells = int(cell.max()) + 1
    if cells < MINIMUM_CELLS:
        cell, cells = np.arange(rows), rows
    chosen = np.random.default_rng(seed).permutation(cells)[: max(1, round(share * cells))]
    return np.isin(cell, chosen)


def _different_rows(log: TorqueLog, held_out: NDArray[np.bool_]) -> int:
    """The number of fitted rows that differ: one that is repeated tells nothing of the noise."""
    rows = np.stack([log.axial_load, log.screw_speed, log.torque])[:, ~held_out]
    return int(np.unique(rows, axis=1).shape[1])


def _groups(log: TorqueLog, held_out: NDArray[np.bool_], parameters: int) -> NDArray[np.int64]:
    """The groups of the jackknife: operating points where there are enough, or else rows; -1 for rows held out."""
    points = operating_points(log.axial_load, log.screw_speed)
    if np.unique(points[~held_out]).size < parameters + MINIMUM_DEGREES_OF_FREEDOM:
        points = np.arange(len(log))
    return np.where(held_out, -1, points)


def _one_sided(fitted: _Fitted, uncertainty: Uncertainty) -> NDArray[np.bool_]:
    """The numbers whose misses hardly grow two standard errors away, to one side at least.

    There the torques have gone flat, as on a clamp: what derivatives say ends there.
    """
    problem, solution = fitted.problem, fitted.solution
    torque, measured = problem.on(~fitted.held_out), fitted.log.torque[~fitted.held_out]
    psi = solution.influence
    sharpness = solution.curvature * np.count_nonzero(~solution.outlying) / max(float(psi @ psi), 1e-300)
    here = loss_of(solution.residuals, solution.scatter)
    covariance, values = uncertainty.covariance, np.zeros(len(problem.parameters), dtype=bool)
    for i in range(len(problem.response.names)):
        error = math.sqrt(covariance[i, i])
        if error == 0:
            continue
        for sign in (-1, 1):
            step = sign * STEP_ERRORS * covariance[:, i] / error
            there, _ = torque(np.clip(solution.values + step, *problem.bounds))
            rise = sharpness * (loss_of(there - measured, solution.scatter) - here)
            values[i] |= rise < FLAT_SHARE * STEP_ERRORS**2
    return values


def _estimates(
    fitted: _Fitted,
    one_sided: NDArray[np.bool_],
    uncertainty: Uncertainty,
    of_rows: Uncertainty,
    degrees_of_freedom: int,
) -> dict[str, Estimate]:
    problem, solution = fitted.problem, fitted.solution
    low, high = problem.bounds
    near = AT_BOUND * problem.scale
    at_bound = (solution.values - low <= near) | (high - solution.values <= near)
    precise = np.sqrt(np.diagonal(uncertainty.covariance)) <= MAXIMUM_RELATIVE_ERROR * uncertainty.scale
    precise &= degrees_of_freedom >= MINIMUM_DEGREES_OF_FREEDOM
    estimates: dict[str, Estimate] = {}
    for i, parameter in enumerate(problem.parameters):
        value, variance = float(solution.values[i]), float(uncertainty.covariance[i, i])
        prior = fitted.known.deviation(i, value)
        # by the rows alone: what the temperature adds says nothing of what they told
        share = 0.0 if prior is None else min(1.0, float(of_rows.covariance[i, i]) / prior**2)
        sensor_columns = i >= problem.free
        told = (
            uncertainty.directions.identifiable_parameters[i]
            and precise[i]
            and (sensor_columns or share <= PRIOR_ONLY_SHARE)
        )
        # in one direction a zero error of the sensor is the same as it
        told = told and (parameter.name != CONSTANT_TORQUE.name or problem.has_torque_offset)
        identified = bool(told and not at_bound[i] and not one_sided[i])
        estimates[parameter.name] = Estimate(
            name=parameter.name,
            quantity=parameter.quantity,
            value=value,
            std=math.sqrt(variance) if identified else None,
            identified=identified,
            start=parameter.start,
            at_bound=bool(at_bound[i]),
            one_sided=bool(one_sided[i] and told),
            degrees_of_freedom=max(1, degrees_of_freedom),
            prior_share=share,
            temperature_share=0.0 if variance == 0 else 1 - float(of_rows.covariance[i, i]) / variance,
            bounds=(parameter.low, parameter.high),
        )
    return estimates


def _with(subject: Configuration, problem: Problem, solution: Solution) -> Configuration:
    """The subject with the fitted numbers in place."""
    response = problem.response
    values = solution.values[: len(response.names)].tolist()
    made = subject.changed(dict(zip(response.names, values, strict=True)))
    if CONSTANT_TORQUE.name not in problem.names:
        return made
    return with_constant_torque(made, float(solution.values[len(response.names)]))


def with_constant_torque(subject: Configuration, torque: float | None) -> Configuration:
    """The subject whose nut loses this torque besides, at all loads and speeds; None for nothing of the kind."""
    losses = {name: law for name, law in subject.nut.losses.items() if name != CONSTANT_LOSS}
    if torque is not None:
        losses[CONSTANT_LOSS] = ConstantTorque(torque)
    nut = dataclasses.replace(subject.nut, losses=losses)
    return dataclasses.replace(subject, screw=dataclasses.replace(subject.screw, nut=nut))


def _scores(problem: Problem, rows: Rows, torques: Vector) -> list[Score]:
    """Scores of the model before and after the fit, and of the baselines without physics, on the same rows."""
    log, fitted = rows.log, ~rows.held_out
    weights = rows.convention.weights(log.axial_load, log.screw_speed)
    helping = weights[0] * torques[0] * weights[1] < 0
    conditions = baselines.Conditions(
        np.abs(log.axial_load), np.abs(log.screw_speed), torques[0], helping, weights, problem.sensor_columns
    )
    described = {
        AS_GIVEN: (0, np.sum(weights * torques, axis=0)),
        CALIBRATED: (len(problem.parameters), rows.predicted),
    }
    for baseline in baselines.ALL:
        result = baseline(conditions.rows(fitted), log.torque[fitted])
        described[result.description] = (result.parameters, result.torque(conditions))
    return [
        Score(words, count, rows.rms(predicted - log.torque, fitted), rows.rms(predicted - log.torque, rows.held_out))
        for words, (count, predicted) in described.items()
    ]


#: Signs that the model misses more than noise: then it is tried whether the constant torque is what it misses.
_SIGNS = ("fit.baseline_better", "fit.trend")
#: A number that brings the residuals below this share of what they were is worth a word.
_WORTH = 0.7


def constant_torque_missed(model: CalibratedModel, refit: Callable[[Sequence[str]], CalibratedModel]) -> list[Record]:
    """Warn that the constant torque is what the model misses, if a fit with it free shows so.

    Friction of seals and bearings is in nearly every log, and this fit is cheap: no contact is solved anew.
    """
    free = model.settings["free"]
    if CONSTANT_TORQUE.name in free or not any(record.id in _SIGNS for record in model.warning_records):
        return []
    try:
        more = refit([*free, CONSTANT_TORQUE.name])
    except InputError:  # too few rows for one number more
        return []
    before, after = model.residual_rms, more.residual_rms
    if not more.estimates[CONSTANT_TORQUE.name].identified or after > _WORTH * before:
        return []
    message = (
        f"with the constant torque free, too, the rows miss by {units.in_unit(after, 'N m', 2)} instead of "
        f"{units.in_unit(before, 'N m', 2)}: the log has friction of seals or bearings, which the model of the "
        "balls does not; free it"
    )
    return [
        Record.warning("fit.free_more", CONSTANT_TORQUE.name, message, value=after, limit=_WORTH * before, unit="N m")
    ]
