"""The fit of a case to a log of torques, or of each screw of a table to its own, and the test that would teach most."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.duty import to_and_fro
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.friction_map import COLDEST, HOTTEST, FrictionMap
from ballscrew.axis.thermal.network import network_of, steady
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any, spoken
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.nut_tables import dynamic_rating
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.uncertain_value import default_distributions
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.diagnostics import shown_with_interval
from ballscrew.evidence.calibration.fit import constant_torque_missed
from ballscrew.evidence.calibration.fit import fit as fitted
from ballscrew.evidence.calibration.next_test import NextTest
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.response import resolve_input, uses_temperatures
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.fit import DEFAULT_FREE, FitOptions
from ballscrew.questions.shared import every_row
from ballscrew.questions.shared.every_row import OfRows, RowCase
from ballscrew.questions.shared.option_values import faults_named, flags_of, with_flag
from ballscrew.questions.shared.question import Done
from ballscrew.questions.warm_up.compute import assumed_of, check_oil, length_of, stroke_of

#: Options of the command line by the fields in which the fit finds faults.
_FLAGS: Mapping[str, str] = {"fit.limits.": "--limits ", **flags_of("fit", FitOptions)}
#: Warnings that the log and the model do not belong together.
_MISFITS = frozenset({"fit.not_converged", "fit.scatter", "fit.outliers", "fit.baseline_better"})


@dataclasses.dataclass(frozen=True, eq=False)
class FitReport:
    """A calibration, its log, and the test that would teach most."""

    model: CalibratedModel
    #: None where no point within the limits is valid.
    next_test: NextTest | None
    log: TorqueLog
    #: What the temperatures assume where rows have those of their own heat.
    assumed: Sequence[str] = ()

    @property
    def objection(self) -> str:
        """The gravest reason not to go on with the fitted numbers; empty where there is none.

        Numbers that no screw has, a log that does not belong to the model, or numbers that the log does not determine.
        """
        for record in self.model.verdict_records:
            if record.holds is False:
                number = shown_with_interval(self.model.estimates[record.subject])
                return f"implausible: {spoken(record.subject)} {number}"
        for record in self.model.warning_records:
            if record.id in _MISFITS:
                return record.text
        names = [spoken(name) for name, estimate in self.model.estimates.items() if not estimate.identified]
        return f"the log does not determine: {' and '.join(names)}" if names else ""


def fit(case: Case, log: TorqueLog, options: FitOptions, done: Callable[[int, int], None] | None = None) -> FitReport:
    """Fit of a case to a log. Raises ``InputError`` that names options of the command line.

    A distribution that the case gives a free number is its prior. :mod:`~ballscrew.questions.fit.log` reads the log.
    """
    subject = Configuration(case.model, case.screw, case.lubricant)
    known = free_quantities(case, options.free)

    def refit(free: Sequence[str]) -> CalibratedModel:
        return fitted(
            case.model,
            case.screw,
            case.lubricant,
            log,
            free,
            priors=priors,
            bounds=options.bounds,
            kind=options.kind,
            inertia=options.inertia,
            holdout=options.holdout,
            temperature_error=_temperature_error(case, log, options),
            dynamic_load_rating=_rating(case),
            seed=options.seed,
            done=done,
        )

    priors = {
        name: case.origins.uncertain[full]
        for name in options.free
        if name in known and (full := _full_name(subject, name)) is not None and full in case.origins.uncertain
    }
    again = bool(priors) and log.source is not None and case.origins.fit.get("sha256") == log.source[1]
    if again:  # an estimate from this log is no further evidence beside the log
        priors = {}
    with faults_named(_FLAGS):
        model = refit(options.free)
    of_model = model.warning_records
    warnings = [*constant_torque_missed(model, refit), *of_model, *case.doubts]
    if again:
        message = "the case was fitted to this very log before: its errors are not taken as priors"
        warnings.append(Record.warning("fit.same_log", "priors", message))
    test: NextTest | None = None
    try:
        test = model.next_test({**_limits_of_log(model), **options.limits})
    except InputError as error:  # the fit is valid without a next test
        warnings += [
            Record.warning("fit.no_next_test", "next_test", f"no next test: {with_flag(fault, _FLAGS)}")
            for fault in error.faults
        ]
    verdicts = model.verdict_records
    judged = dataclasses.replace(model, verdict_records=tuple(verdicts), warning_records=tuple(warnings))
    return FitReport(judged, test, log)


def _rating(case: Case) -> float | None:
    """The dynamic load rating, N; None of a geometry that no standard has ratings for."""
    try:
        return dynamic_rating(case.screw, case.origins.row, case.origins.listed)[0]
    except InputError:
        return None


def _temperature_error(case: Case, log: TorqueLog, options: FitOptions) -> float | None:
    """Half the width of the 95 % interval of the oil temperature, K; None for the usual one.

    Where the log has no temperatures, it is that of the case, and so is its distribution if the case gives one.
    """
    given = case.origins.uncertain.get(TEMPERATURE.name)
    if options.temperature_error is not None or given is None or uses_temperatures(case.lubricant, log):
        return options.temperature_error
    low, high = (float(given.quantile(share)) for share in (0.025, 0.975))
    return (high - low) / 2


def _limits_of_log(model: CalibratedModel) -> dict[str, tuple[float, float]]:
    """Loads, speeds and temperatures of a log: the rig gives these, and nobody knows whether it gives more."""
    log = model.rows.log
    conditions = {"axial_load": log.axial_load, "screw_speed": np.abs(log.screw_speed)}
    if model.lubricant.follows_temperature and log.temperature is not None:
        conditions[TEMPERATURE.name] = log.temperature
    return {name: (float(values.min()), float(values.max())) for name, values in conditions.items()}


def _full_name(subject: Configuration, name: str) -> str | None:
    """The full name of a free number; None for one that no model has."""
    try:
        return resolve_input(subject, name)
    except InputError:
        return None


class Candidate(NamedTuple):
    """A number that can be fitted: its name, its quantity and its value in the case, SI; NaN where a law gives it."""

    name: str
    quantity: Quantity
    value: float


def candidates(case: Case) -> list[Candidate]:
    """The numbers of a case that are usually uncertain, and so worth a fit; those fitted most often come first."""
    subject = Configuration(case.model, case.screw, case.lubricant)
    usual = default_distributions(case.model, case.screw, case.lubricant)
    names = sorted(
        (name for name in usual if name != TEMPERATURE.name), key=lambda name: not name.endswith(DEFAULT_FREE)
    )
    values = {name: subject.value_of(name) for name in names}
    result = [Candidate(n, subject.inputs[n][1], math.nan if x is None else float(x)) for n, x in values.items()]
    return [*result[:1], Candidate(CONSTANT_TORQUE.name, CONSTANT_TORQUE, 0.0), *result[1:]]


def free_quantities(case: Case, free: Sequence[str]) -> dict[str, Quantity]:
    """Quantities of the free numbers that are known; the fit refuses the others."""
    subject = Configuration(case.model, case.screw, case.lubricant)
    full = {name: _full_name(subject, name) for name in free}
    known = {name: subject.inputs[each][1] for name, each in full.items() if each is not None}
    return known | ({CONSTANT_TORQUE.name: CONSTANT_TORQUE} if CONSTANT_TORQUE.name in free else {})


OPTION = "--self-heating"
#: Speeds between which the heat balance is interpolated.
_SPEEDS = 12


def warm_log(case: Case, log: TorqueLog, kind: Kind = "unknown") -> tuple[TorqueLog, Sequence[str]]:
    """The log with steady temperatures of the oil, and what they assume.

    The heat of a row is its measured torque times its speed, so that no model of friction is needed, and the balance is
    linear in it. That holds for a torque of friction only: of a torque that drives, the share of friction is not known
    before the fit. Raises :class:`~ballscrew.basis.errors.InputError` for such logs, for those that have temperatures,
    for an oil without one, and where a row would be warmer than the oil is known.
    """
    check_oil(case)
    if log.temperature is not None:
        raise InputError(Fault(OPTION, "is given beside a log with temperatures", "", "leave it out"))
    result = log.kind if kind == "unknown" else kind
    if result != "friction":
        problem = f"needs a log of friction torque: of a torque that is {_named(result)} the heat is not known yet"
        remedy = "log the temperature of the nut, or give a log of friction torque with --kind friction"
        raise InputError(Fault(OPTION, problem, "", remedy))
    surroundings = case.surroundings or Surroundings()
    point = dataclasses.replace(case, axis=None, motion=None)
    stroke, length = stroke_of(point, surroundings), length_of(case, surroundings)
    speed, power = np.abs(log.screw_speed), np.abs(log.torque * log.screw_speed)
    fastest = float(np.max(speed))
    speeds = np.unique(np.geomspace(max(float(np.min(speed)), 1e-3 * fastest), fastest, _SPEEDS))
    load = float(np.median(np.abs(log.axial_load)))
    nothing = FrictionMap(np.array([COLDEST, HOTTEST]), np.zeros(1), np.zeros((2, 1)))
    networks = [
        network_of(
            to_and_fro(
                case.model,
                case.screw,
                case.lubricant,
                axial_load=load,
                screw_speed=float(one),
                stroke=stroke,
                also=case.bearings_by_name,
            ),
            surroundings,
            shaft_length=length,
            friction=nothing,
        )
        for one in speeds
    ]
    idle: Numbers = np.array([one.of_oil @ steady(one, 0.0) for one in networks])
    rise: Numbers = np.array([one.of_oil @ (steady(one, 1.0) - steady(one, 0.0)) for one in networks])
    oil = np.interp(speed, speeds, idle) + np.interp(speed, speeds, rise) * power
    if np.max(oil) > HOTTEST:
        given = units.shown(float(np.max(oil)), TEMPERATURE)
        remedy = "log the temperature, or give [surroundings] as they are: nut_conductance, ball_conductance"
        raise InputError(Fault(OPTION, "makes a row warmer than the oil is known", given, remedy))
    ends = " to ".join(units.shown(float(end), TEMPERATURE) for end in (np.min(oil), np.max(oil)))
    assumed = [
        f"oil at {ends}, in the steady state of the measured torque of each row; the preload stays as it was set",
        *assumed_of(case, surroundings, networks[-1], stroke),
    ]
    return dataclasses.replace(log, temperature=oil), assumed


def _named(kind: Kind) -> str:
    return "not said to be one of friction" if kind == "unknown" else "that of the drive"


#: What file names have not.
_ODD = re.compile(r"[^\w.+-]+")


def fits_of_rows(
    rows: Mapping[str, RowCase],
    logs: Mapping[str, TorqueLog],
    options: Callable[[Case], FitOptions],
    *,
    keep_going: bool = False,
    each: Callable[[RowCase, FitReport], None] | None = None,
    done: Done | None = None,
) -> OfRows[FitReport]:
    """The fit of each row that has a log, by its place; ``each`` is told of every one as soon as it is done."""
    work = {row.place: row for row in rows.values() if row.place in logs}

    def fitted(row: RowCase) -> FitReport:
        report = fit(row.case, logs[row.place], options(row.case))
        if each is not None:
            each(row, report)
        return report

    return every_row.each(work, fitted, keep_going=keep_going, done=done)


def files_of_rows(rows: Mapping[str, RowCase], folder: Path) -> dict[str, Path]:
    """The case file of each row in a folder, by the name of the row without what file names have not.

    Raises :class:`~ballscrew.basis.errors.InputError` for two rows with the same file.
    """
    paths = {name: folder / f"{_ODD.sub('_', name).strip('._') or '_'}.toml" for name in rows}
    taken: dict[str, str] = {}
    faults: list[Fault] = []
    for name, path in paths.items():
        other = taken.setdefault(path.name.casefold(), name)
        if other != name:
            problem = "would have the same file as another row"
            faults.append(Fault("--to", problem, f"{name} and {other}", "give the rows other names"))
    raise_if_any(faults)
    return paths
