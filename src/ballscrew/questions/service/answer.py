"""The results of a service, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Quantity, Ratio, Temperature, Torque, Unit
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.evidence.service.alternatives import Alternative
from ballscrew.evidence.service.diagnostics import PreloadEstimate
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.evidence.service.preload_change import VERDICTS, PreloadChange
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.service.compute import TORQUE, ServiceReport
from ballscrew.questions.shared.declared import LEFT_OUT, from_attributes
from ballscrew.questions.shared.envelope import envelope


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


#: By whether the value is within what is known of the number.
_KNOWN = {
    True: "within what is known of it",
    False: "beyond what is known of it",
    None: "nothing is known of it",
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


def preload_quantity(case: Case) -> Quantity:
    """The quantity of a preload, with its display unit."""
    return inputs_of(case.model, case.screw, case.lubricant)[PRELOAD][1]


def verdicts(case: Case, report: ServiceReport) -> list[Record]:
    """What became of the preload, and each cause that would explain the log as well."""
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
