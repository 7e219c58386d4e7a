"""The results of a service, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Ratio, Temperature, Torque, Unit
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.uncertainty.distributions import Normal
from ballscrew.engine.uncertainty.uncertain_value import parse_uncertain
from ballscrew.evidence.service.diagnostics import PreloadEstimate
from ballscrew.evidence.service.preload_change import PreloadChange
from ballscrew.questions.service import ReadingOptions, ServiceOptions, compute
from ballscrew.questions.service.compute import TORQUE, Reading, ServiceReport, verdicts
from ballscrew.questions.service.sheet import sheet
from ballscrew.questions.shared.declared import LEFT_OUT, envelope, from_attributes
from ballscrew.questions.shared.option_values import read
from ballscrew.questions.shared.question import (
    Answer,
    Done,
    Request,
    Work,
)


class EstimatedPreload(NamedTuple):
    """A preload with its interval of 95 %, and the log that it is from."""

    preload: Annotated[Force, Info("F_{pr}", "preload: the median")]
    low: Annotated[Force, Info("", "lower end of the interval")]
    high: Annotated[Force, Info("", "upper end of the interval")]
    #: Standard deviation of the logarithm of the preload.
    deviation_of_logarithm: Ratio
    #: By unknown, the share of the variance of the logarithm that goes along with it.
    shares: Annotated[Mapping[str, float], Unit("1")]
    #: Mean temperature of the log.
    temperature: Temperature | None
    #: Rows of the log that count; null of a preload that is not from a log.
    rows: int | None
    #: Rows of the log that were read.
    rows_read: int | None
    #: Rows that were left out, by reason.
    left_out: Mapping[str, int]
    #: What is to be said of the log.
    notes: Sequence[str]
    #: Rows whose load takes the preload off one side: they tell nothing of it.
    rows_beyond_lift_off: int
    residual_rms: Annotated[Torque, Info("", "root mean square of the residuals, outliers left out")]


class PreloadLeft(NamedTuple):
    """The preload over what it was, with its interval of 95 %."""

    #: The median.
    value: Ratio
    #: Lower end of the interval.
    low: Ratio
    #: Upper end of the interval.
    high: Ratio
    #: By unknown, the share of the variance that goes along with it.
    shares: Annotated[Mapping[str, float], Unit("1")]


class OtherCause(NamedTuple):
    """A number that would explain the worn log with the preload of the new one."""

    #: Of the number.
    name: str
    #: The value it would need, SI.
    value: float
    #: The value that it has, SI.
    instead_of: float
    #: SI unit of both.
    unit: str
    rms: Annotated[Torque, Info("", "root mean square of the residuals with it")]
    rms_of_preload: Annotated[Torque, Info("", "root mean square of the residuals with another preload")]
    #: True where it explains the log as well as the preload does.
    explains: bool
    #: True where the value is within what is known of the number; null where nothing is known.
    plausible: bool | None


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class ServiceResults:
    """Preloads by two logs, by a log and the nominal preload, or by one torque; what is left, and other causes."""

    #: The preload before.
    new: Annotated[EstimatedPreload | None, LEFT_OUT] = None
    #: The preload after.
    worn: Annotated[EstimatedPreload | None, LEFT_OUT] = None
    #: The preload by one torque.
    preload: Annotated[EstimatedPreload | None, LEFT_OUT] = None
    #: The preload after over that before.
    ratio: Annotated[PreloadLeft | None, Unit("1"), LEFT_OUT] = None
    #: The loss that is put up with, as a share of the preload.
    tolerance: Annotated[Ratio | None, LEFT_OUT] = None
    #: Probability of a larger loss.
    probability_of_loss: Annotated[Ratio | None, LEFT_OUT] = None
    #: Lost or kept with a probability of 95 %, or open.
    verdict: Annotated[Literal["lost", "kept", "open"] | None, LEFT_OUT] = None
    #: Means of the numbers that the logs ask for, in standard deviations from what is known of them.
    scores: Annotated[Mapping[str, float] | None, Unit("1"), LEFT_OUT] = None
    #: Other causes, had the preload stayed as it was.
    alternatives: Annotated[Sequence[OtherCause] | None, LEFT_OUT] = None
    torque: Annotated[Torque | None, TORQUE.info, LEFT_OUT] = None
    #: The speed at which the torque was read.
    screw_speed: Annotated[AngularSpeed | None, LEFT_OUT] = None


def results(report: ServiceReport) -> ServiceResults:
    """The results of a service."""
    values: dict[str, Any] = {name: _estimate(one) for name, one in report.estimates.items()}
    if report.change is not None:
        values |= _change(report.change)
    if report.reading is not None:
        values |= {"torque": report.reading.torque, "screw_speed": report.reading.screw_speed}
    return ServiceResults(**values)


def _estimate(one: PreloadEstimate) -> EstimatedPreload:
    low, high = one.interval()
    rows = None if one.fit is None else one.fit.rows
    return from_attributes(
        EstimatedPreload,
        one,
        low=low,
        high=high,
        deviation_of_logarithm=math.sqrt(one.logarithm.total_variance),
        rows=None if rows is None else len(rows.log),
        rows_read=None if rows is None else rows.log.rows,
        left_out={} if rows is None else rows.log.left_out,
        notes=[] if rows is None else rows.log.notes,
    )


def _change(change: PreloadChange) -> dict[str, Any]:
    return {
        "ratio": PreloadLeft(change.ratio, *change.ratio_interval(), change.ratio_shares),
        "alternatives": [from_attributes(OtherCause, one, unit=one.quantity.unit) for one in change.alternatives],
        **{name: getattr(change, name) for name in ("tolerance", "probability_of_loss", "verdict", "scores")},
    }


def document(case: Case, report: ServiceReport) -> dict[str, Any]:
    """Inputs, preloads, the share that is left, what else could be, warnings and provenance."""
    sources = [estimate.fit.rows.log.source for estimate in report.estimates.values() if estimate.fit is not None]
    return envelope(
        case,
        results(report),
        warnings=report.warnings,
        verdicts=verdicts(case, report),
        sources={"logs": [{"log": source[0], "sha256": source[1]} for source in sources if source is not None]},
    )


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    logs = request.files["logs"]
    check_question(logs, request.case is not None, request.written)
    case = request.load()
    has_torque = request.written["torque"] is not None
    torque = reading(request.written) if has_torque else None
    options = ServiceOptions() if has_torque else request.options(ServiceOptions)

    def answer(done: Done) -> Answer:
        report = compute.of_logs(case, logs, options, done) if torque is None else compute.of_torque(case, torque)
        return Answer(sheet(case, report), lambda: document(case, report), f"{len(report.estimates)} preloads")

    return Work(answer, "service")


def check_question(logs: Sequence[Path], has_case: bool, written: Mapping[str, Any]) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a question that is none, or two."""
    faults: list[Fault] = []
    if not has_case:
        faults.append(Fault("--case", "missing", "", "give the case file of the screw: --case FILE"))
    if written["torque"] is None:
        if not logs:
            remedy = 'give NEW.csv WORN.csv, or WORN.csv alone, or --torque "0.4 N m" --speed "100 rpm"'
            faults.append(Fault("WORN", "missing", "", remedy))
        faults += [
            Fault(f"--{name}", "is for a torque without a log", written[name], "leave it out, or give --torque")
            for name in ("speed", "temperature")
            if written[name] is not None
        ]
    else:
        if logs:
            faults.append(Fault("--torque", "is given beside a log", written["torque"], "leave one of them out"))
        if written["speed"] is None:
            faults.append(Fault("--speed", "missing", "", 'say at which speed: --speed "100 rpm"'))
    if len(logs) > 2:
        faults.append(Fault("WORN", "more than two logs", str(len(logs)), "give the new one and the worn one"))
    raise_if_any(faults)


def reading(written: Mapping[str, Any]) -> Reading:
    """A torque without load. Raises :class:`~ballscrew.basis.errors.InputError` for faults in it."""
    options = read(ReadingOptions, written)
    assert options.torque is not None
    assert options.speed is not None
    faults: list[Fault] = []
    value = deviation = 0.0
    uncertain = parse_uncertain(options.torque, TORQUE)
    if isinstance(uncertain, Fault):
        faults.append(Fault("--torque", uncertain.problem, uncertain.given or options.torque, uncertain.remedy))
    elif uncertain is None:
        result = units.parse("--torque", options.torque, TORQUE)
        if isinstance(result, Fault):
            faults.append(result)
        else:
            value = result
    else:
        value = uncertain.central
        if isinstance(uncertain.distribution, Normal):
            deviation = uncertain.distribution.deviation
        elif uncertain.distribution is not None:
            remedy = '"0.40 ± 0.02 N m"'
            faults.append(Fault("--torque", "must be a value ± its 95 % interval", options.torque, remedy))
    raise_if_any(faults)
    return Reading(value, options.speed, deviation, options.temperature)
