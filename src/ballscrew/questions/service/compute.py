"""The service of a nut: the preload left, from two logs, from one against the case, or from a torque without load."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.quantities import (
    Quantity,
    quantities_of,
)
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.engine.uncertainty.uncertain_value import default_distributions
from ballscrew.evidence.calibration.fit import points_of
from ballscrew.evidence.calibration.fit_result import Rows
from ballscrew.evidence.calibration.response import torque_of_model
from ballscrew.evidence.service.alternatives import Alternative
from ballscrew.evidence.service.diagnostics import PreloadEstimate
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.evidence.service.preload_change import VERDICTS, PreloadChange, preload_change, preload_of_torque
from ballscrew.files.torque_logs import reading
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.service import ReadingOptions, ServiceOptions
from ballscrew.questions.shared.charts import Numbers, some
from ballscrew.questions.shared.option_values import faults_named, flags_of

TORQUE: Quantity = quantities_of(FrictionResult)["screw_torque"]
_OF_PRELOAD = "so with the preload found; in a full bath the same torque asks for a smaller one"
#: Flags of the command line by the fields in which a service finds faults.
_FLAGS: Mapping[str, str] = {
    **flags_of("service", ServiceOptions, ReadingOptions),
    "service.screw_speed": "--speed",
    "lubricant.temperature": "--temperature",
}


@dataclasses.dataclass(frozen=True)
class Reading:
    """A torque without load, SI."""

    torque: float
    screw_speed: float
    #: Standard deviation of the torque.
    torque_deviation: float = 0.0
    temperature: float | None = None


@dataclasses.dataclass(frozen=True, eq=False)
class ServiceReport:
    """The answer of a service: a change of the preload, or the preload of a single reading."""

    change: PreloadChange | None = None
    preload: PreloadEstimate | None = None
    reading: Reading | None = None
    #: Warnings of the inputs of the case, and of a reading.
    of_case: Sequence[Record] = ()

    @property
    def warnings(self) -> list[Record]:
        """Warnings of the change, and of the inputs of the case."""
        return [*(() if self.change is None else self.change.warning_records), *self.of_case]

    @property
    def estimates(self) -> dict[str, PreloadEstimate]:
        """The preloads by the names they have in the document."""
        if self.change is not None:
            return {"new": self.change.new, "worn": self.change.worn}
        return {} if self.preload is None else {"preload": self.preload}


def of_logs(
    case: Case,
    paths: Sequence[Path],
    options: ServiceOptions,
    done: Callable[[int, int], None] | None = None,
) -> ServiceReport:
    """The change between the logs of two files, or from the case to that of one."""
    logs: list[TorqueLog | None] = [
        reading.read(
            path,
            options.columns,
            torque_constant=options.torque_constant,
            lead=float(case.screw.lead),
            keep_going=options.keep_going,
            done=done,
        )
        for path in paths
    ]
    if len(logs) == 1:
        logs.insert(0, None)
    new, worn = logs
    uncertain = distributions(case)
    with faults_named(_FLAGS):
        change = preload_change(
            case.model,
            case.screw,
            case.lubricant,
            new,
            worn,
            free=[PRELOAD, *(name for name in options.free if name not in (PRELOAD, "preload"))],
            distributions=uncertain,
            joint=joint_of(case, all_of(case)),
            tolerance=options.tolerance,
            kind=options.kind,
            inertia=options.inertia,
            dynamic_load_rating=case.origins.listed.get("dynamic_load_rating"),
            done=done,
        )
    records = tuple(change.warning_records)
    return ServiceReport(dataclasses.replace(change, warning_records=records), of_case=case.implausible())


def of_torque(case: Case, measured: Reading) -> ServiceReport:
    """The preload of a torque without load."""
    with faults_named(_FLAGS):
        preload = preload_of_torque(
            case.model,
            case.screw,
            case.lubricant,
            torque=measured.torque,
            screw_speed=measured.screw_speed,
            temperature=measured.temperature,
            torque_deviation=measured.torque_deviation,
            distributions=distributions(case),
            joint=joint_of(case, all_of(case)),
        )
    return ServiceReport(
        preload=preload, reading=measured, of_case=[*_starved(case, preload, measured), *case.implausible()]
    )


def _starved(case: Case, preload_estimate: PreloadEstimate, measured: Reading) -> list[Record]:
    """Warn that the nut with the preload found is starved of oil at the reading."""
    oil = case.lubricant if measured.temperature is None else case.lubricant.at(measured.temperature)
    subject = Configuration(case.model, case.screw, oil).changed({PRELOAD: preload_estimate.preload})
    points = {"axial_load": 0.0, "screw_speed": measured.screw_speed}
    return subject.starvation(points, _OF_PRELOAD)


def distributions(case: Case) -> dict[str, Distribution]:
    """The uncertain numbers of a case, the temperature left to the logs, and what a grade then leaves open instead."""
    values = {name: one.distribution for name, one in all_of(case).items() if name != TEMPERATURE.name}
    if not case.origins.fit and case.lubricant.follows_temperature:
        exact = {*case.origins.exact, TEMPERATURE.name}
        usual = default_distributions(case.model, case.screw, case.lubricant, given=values, exact=exact)
        values |= {name: distribution for name, (distribution, _) in usual.items()}
    return values


#: Points of a curve.
CURVE_POINTS = 80


class Curve(NamedTuple):
    """A log of a service over the speed: the model with its preload, and the rows moved to its load and temperature."""

    speed: Numbers
    torque: Numbers
    measured_speed: Numbers
    measured: Numbers


def curves(report: ServiceReport, most: int) -> dict[str, Curve]:
    """The curve of each log, with at most so many of its rows that are no outliers.

    Rows of other loads and temperatures are shown by what they are off the curve.
    """
    result: dict[str, Curve] = {}
    for label, one in report.estimates.items():
        if one.fit is None:
            continue
        rows = one.fit.rows
        x = np.abs(rows.log.screw_speed)
        along = np.geomspace(float(x.min()), float(x.max()), CURVE_POINTS) if np.ptp(x) > 0 else x[:1]
        curve = _friction(one, {**_usual(rows), "screw_speed": along})
        own = points_of(rows.log, one.fit.lubricant, rows.convention)
        measured = rows.friction + one.fit.constant_torque - rows.residuals * rows.direction
        measured = measured + _friction(one, {**_usual(rows), "screw_speed": x}) - _friction(one, own)
        places = some(np.flatnonzero(~rows.outlying), most)
        result[label] = Curve(along, curve, x[places], measured[places])
    return result


def _usual(rows: Rows) -> dict[str, Any]:
    """The median size of the load, with the sign that more of it has, and the mean temperature of a log."""
    load = rows.convention.loads(rows.log.axial_load, rows.log.screw_speed)
    usual: dict[str, Any] = {"axial_load": float(np.copysign(np.median(np.abs(load)), np.sum(load)))}
    if rows.log.temperature is not None:
        usual["temperature"] = float(np.mean(rows.log.temperature))
    return usual


def _friction(one: PreloadEstimate, points: Mapping[str, Any]) -> Numbers:
    """The friction torque with the preload and the numbers that were found."""
    assert one.subject is not None
    graded = one.subject.lubricant.follows_temperature
    there: dict[str, Any] = {"temperature": one.subject.lubricant.temperature, **points} if graded else dict(points)
    if not graded:
        there.pop("temperature", None)
    size = np.broadcast_arrays(*there.values())
    return torque_of_model(one.subject, dict(zip(there, size, strict=True)), np.array([[0.0], [1.0]]), one.warmer)


#: By whether the value is within what is known of the number.
_KNOWN = {
    True: "within what is known of it",
    False: "beyond what is known of it",
    None: "nothing is known of it",
}


def preload_quantity(case: Case) -> Quantity:
    """The quantity of a preload, with its display unit."""
    return inputs_of(case.model, case.screw, case.lubricant)[PRELOAD][1]


def verdicts(case: Case, report: ServiceReport) -> list[Record]:
    """Fate of the preload, and each cause that would explain the log as well."""
    if report.change is None:
        return [_of_reading(case, report)]
    change = report.change
    if not change.logarithm.told:
        text = "the preload cannot be told from this: see the warnings"
        return [Record("service.preload_left", PRELOAD, text, severity="warning")]
    low, high = (units.percent(end) for end in change.ratio_interval())
    limit = 1 - change.tolerance
    preload = "nominal preload" if change.new.fit is None else "preload"
    text = (
        f"{VERDICTS[change.verdict]}: {units.percent(change.ratio)} of the {preload} is left ({low} to {high}), less "
        f"than {units.percent(limit)} of it with a probability of {probability(change.probability_of_loss)}"
    )
    holds = {"lost": False, "kept": True, "open": None}[change.verdict]
    severity = "warning" if change.verdict == "lost" else "info"
    records = [
        Record("service.preload_left", PRELOAD, text, severity=severity, holds=holds, value=change.ratio, limit=limit)
    ]
    return [*records, *(_of_alternative(one) for one in change.alternatives)]


def probability(share: float) -> str:
    """``12%``; of what is nearly certain or nearly impossible only that."""
    if share > 0.999:
        return "more than 99.9%"
    if share < 0.001:
        return "less than 0.1%"
    return units.percent(share, 1 if share > 0.99 or share < 0.01 else 0)


def _of_alternative(one: Alternative) -> Record:
    value, instead = (units.shown(number, one.quantity, 3) for number in (one.value, one.instead_of))
    off, off_of_preload = (units.shown(torque, TORQUE, 3) for torque in (one.rms, one.rms_of_preload))
    explains = "explains it as well" if one.explains else "does not explain it"
    text = (
        f"{one.name.rpartition('.')[2].replace('_', ' ')} {value} instead of {instead} {explains} (off by {off}, with "
        f"another preload {off_of_preload})"
    )
    if one.explains:
        text += f"; {_KNOWN[one.plausible]}"
    return Record(
        "service.alternative",
        one.name,
        text,
        value=one.value,
        limit=one.instead_of,
        unit=one.quantity.unit,
        holds=one.explains,
    )


def _of_reading(case: Case, report: ServiceReport) -> Record:
    assert report.preload is not None
    quantity = preload_quantity(case)
    pair = (report.preload.preload, *report.preload.interval())
    preload, low, high = (units.shown(force, quantity) for force in pair)
    text = f"preload {preload} ({low} to {high})"
    nominal = getattr(case.screw.nut, "preload", None)
    if nominal:
        share, least, most = (units.percent(force / nominal) for force in pair)
        text += f", {share} of the {units.shown(float(nominal), quantity)} of the case ({least} to {most})"
    text += _taken_at(case, report)
    return Record("service.preload", PRELOAD, text, value=report.preload.preload, unit="N")


def _taken_at(case: Case, report: ServiceReport) -> str:
    """The speed and the temperature that a reading is taken at, and whose they are."""
    if report.reading is None:
        return ""
    of_speed = inputs_of(case.model, case.screw, case.lubricant)["screw_speed"][1]
    taken = f"; taken at {units.shown(report.reading.screw_speed, of_speed)}"
    given = report.reading.temperature
    warm = case.lubricant.temperature if given is None else given
    if warm is None:
        return taken
    temperature = units.shown(float(warm), TEMPERATURE, 3)
    return f"{taken} and {temperature}" if given is not None else f"{taken} and {temperature}, the oil of the case"
