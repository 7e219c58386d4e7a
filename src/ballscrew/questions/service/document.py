"""``ballscrew service --json``: the document of a service; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Measured, Message, Named, Record, documents
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.provenance import of_case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.evidence.service.alternatives import Alternative
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.evidence.service.preload_change import VERDICTS
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.service.answer import results
from ballscrew.questions.service.compute import TORQUE, ServiceReport
from ballscrew.questions.shared import declared

_LEFT = Message(
    "{verdict}: {share} of the preload is left ({low} to {high}), less than {least} of it with a probability of "
    "{probability}"
)
_LEFT_OF_NOMINAL = Message(
    "{verdict}: {share} of the nominal preload is left ({low} to {high}), less than {least} of it with a probability "
    "of {probability}"
)
_EXPLAINS = Message(
    "{name} {value} instead of {instead} explains it as well (off by {off}, with another preload {off_of_preload}); "
    "{known}"
)
#: By whether the value is within what is known of the number.
_KNOWN = {
    True: Message("within what is known of it"),
    False: Message("beyond what is known of it"),
    None: Message("nothing is known of it"),
}
_DOES_NOT_EXPLAIN = Message(
    "{name} {value} instead of {instead} does not explain it (off by {off}, with another preload {off_of_preload})"
)
_READING = Message("preload {preload} ({low} to {high})")
_SHARE_OF_NOMINAL = Message(
    "preload {preload} ({low} to {high}), {share} of the {nominal} of the case ({least} to {most})"
)
_AT_SPEED = Message("{preload}; taken at {speed}")
_AT_SPEED_AND_TEMPERATURE = Message("{preload}; taken at {speed} and {temperature}")
_AT_SPEED_AND_OIL = Message("{preload}; taken at {speed} and {temperature}, the oil of the case")


def document(case: Case, report: ServiceReport) -> dict[str, Any]:
    """Inputs, preloads, the share that is left, what else could be, warnings and provenance."""
    found = results(report)
    return {
        "inputs": case_file.inputs(case),
        "results": declared.document(found),
        "units": declared.units(found),
        "warnings": documents(report.warnings),
        "verdicts": documents(verdicts(case, report)),
        "checks": [],
        "provenance": {**of_case(case), "logs": _logs(report)},
    }


def preload_quantity(case: Case) -> Quantity:
    """The quantity of a preload, with its display unit."""
    return inputs_of(case.model, case.screw, case.lubricant)[PRELOAD][1]


def verdicts(case: Case, report: ServiceReport) -> list[Record]:
    """What became of the preload, and each cause that would explain the log as well."""
    if report.change is None:
        return [_of_reading(case, report)]
    change = report.change
    if not change.logarithm.told:
        message = Message("the preload cannot be told from this: see the warnings")
        return [units.record(message, id="service.preload_left", subject=PRELOAD, severity="warning")]
    low, high = change.ratio_interval()
    limit = 1 - change.tolerance
    message = (_LEFT_OF_NOMINAL if change.new.fit is None else _LEFT).of(
        verdict=VERDICTS[change.verdict],
        share=units.percent(change.ratio),
        low=units.percent(low),
        high=units.percent(high),
        least=units.percent(limit),
        probability=probability(change.probability_of_loss),
    )
    holds = {"lost": False, "kept": True, "open": None}[change.verdict]
    severity = "warning" if change.verdict == "lost" else "info"
    records = [
        units.record(
            message, id="service.preload_left", subject=PRELOAD, severity=severity, holds=holds, value=change.ratio,
            limit=limit,
        )
    ]  # fmt: skip
    return [*records, *(_of_alternative(one) for one in change.alternatives)]


def probability(share: float) -> str:
    """``12%``; of what is nearly certain or nearly impossible only that."""
    if share > 0.999:
        return "more than 99.9%"
    if share < 0.001:
        return "less than 0.1%"
    return units.percent(share, 1 if share > 0.99 or share < 0.01 else 0)


def _of_alternative(one: Alternative) -> Record:
    message = (_EXPLAINS if one.explains else _DOES_NOT_EXPLAIN).of(
        name=Named(one.name),
        value=Measured(one.value, one.quantity, 3),
        instead=Measured(one.instead_of, one.quantity, 3),
        off=Measured(one.rms, TORQUE, 3),
        off_of_preload=Measured(one.rms_of_preload, TORQUE, 3),
        known=_KNOWN[one.plausible],
    )
    return units.record(
        message, id="service.alternative", subject=one.name, value=one.value, limit=one.instead_of,
        unit=one.quantity.unit, holds=one.explains,
    )  # fmt: skip


def _of_reading(case: Case, report: ServiceReport) -> Record:
    assert report.preload is not None
    quantity = preload_quantity(case)
    found = (report.preload.preload, *report.preload.interval())
    ends = {name: Measured(x, quantity) for name, x in zip(("preload", "low", "high"), found, strict=True)}
    nominal = getattr(case.screw.nut, "preload", None)
    if nominal:
        share, least, most = (units.percent(x / nominal) for x in found)
        message = _SHARE_OF_NOMINAL.of(
            **ends, share=share, nominal=Measured(float(nominal), quantity), least=least, most=most
        )
    else:
        message = _READING.of(**ends)
    message = _taken_at(case, report, message)
    return units.record(message, id="service.preload", subject=PRELOAD, value=report.preload.preload, unit="N")


def _taken_at(case: Case, report: ServiceReport, message: Message) -> Message:
    """A reading with the speed and the temperature that it is taken at, and whose they are."""
    if report.reading is None:
        return message
    of_speed = inputs_of(case.model, case.screw, case.lubricant)["screw_speed"][1]
    speed = Measured(report.reading.screw_speed, of_speed)
    given = report.reading.temperature
    warm = case.lubricant.temperature if given is None else given
    if warm is None:
        return _AT_SPEED.of(preload=message, speed=speed)
    template = _AT_SPEED_AND_OIL if given is None else _AT_SPEED_AND_TEMPERATURE
    return template.of(preload=message, speed=speed, temperature=Measured(float(warm), TEMPERATURE, 3))


def _logs(report: ServiceReport) -> list[dict[str, Any]]:
    sources = [one.fit.rows.log.source for one in report.estimates.values() if one.fit is not None]
    return [{"log": source[0], "sha256": source[1]} for source in sources if source is not None]
