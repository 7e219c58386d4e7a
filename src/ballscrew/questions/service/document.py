"""``ballscrew service --json``: the document of a service; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record, documents
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.provenance import of_case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.evidence.service.alternatives import Alternative
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.service.answer import results
from ballscrew.questions.service.compute import TORQUE, ServiceReport
from ballscrew.questions.shared import declared

#: Three words for what became of the preload.
VERDICTS = {"lost": "preload lost", "kept": "preload kept", "open": "lost or kept cannot be told"}


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
    before = "the nominal preload" if change.new.fit is None else "the preload"
    if not change.logarithm.told:
        text = "the preload cannot be told from this: see the warnings"
        return [Record(id="service.preload_left", subject=PRELOAD, text=text, severity="warning")]
    low, high = change.ratio_interval()
    limit = 1 - change.tolerance
    text = (
        f"{VERDICTS[change.verdict]}: {change.ratio:.0%} of {before} is left ({low:.0%} to {high:.0%}), less than "
        f"{limit:.4g} of it with a probability of {probability(change.probability_of_loss)}"
    ).replace(f"{limit:.4g} of it", f"{limit:.0%} of it")
    holds = {"lost": False, "kept": True, "open": None}[change.verdict]
    severity = "warning" if change.verdict == "lost" else "info"
    records = [
        Record(
            id="service.preload_left", subject=PRELOAD, text=text, severity=severity, holds=holds,
            value=change.ratio, limit=limit,
        )
    ]  # fmt: skip
    return [*records, *(_of_alternative(one) for one in change.alternatives)]


def probability(share: float) -> str:
    """``12 %``; of what is nearly certain or nearly impossible only that."""
    if share > 0.999:
        return "more than 99.9%"
    if share < 0.001:
        return "less than 0.1%"
    return f"{share:.1%}" if share > 0.99 or share < 0.01 else f"{share:.0%}"


def _of_alternative(one: Alternative) -> Record:
    name = one.name.replace("_", " ")
    value, instead = (units.shown(x, one.quantity, 3) for x in (one.value, one.instead_of))
    fits = "explains it as well" if one.explains else "does not explain it"
    off = f"off by {units.shown(one.rms, TORQUE, 3)}, with another preload {units.shown(one.rms_of_preload, TORQUE, 3)}"
    within = {True: "within", False: "beyond", None: ""}[one.plausible]
    known = f"; {within} what is known of it" if within else "; nothing is known of it"
    text = f"{name} {value} instead of {instead} {fits} ({off}){known if one.explains else ''}"
    return Record(
        id="service.alternative", subject=one.name, text=text, value=one.value, limit=one.instead_of,
        unit=one.quantity.unit, holds=one.explains,
    )  # fmt: skip


def _of_reading(case: Case, report: ServiceReport) -> Record:
    assert report.preload is not None
    quantity = preload_quantity(case)
    found = (report.preload.preload, *report.preload.interval())
    value, low, high = (units.shown(x, quantity) for x in found)
    text = f"preload {value} ({low} to {high})"
    nominal = getattr(case.screw.nut, "preload", None)
    if nominal:
        share, least, most = (f"{x / nominal:.0%}" for x in found)
        text += f", {share} of the {units.shown(nominal, quantity)} of the case ({least} to {most})"
    return Record(
        id="service.preload", subject=PRELOAD, text=f"{text}{_taken_at(case, report)}",
        value=report.preload.preload, unit="N",
    )  # fmt: skip


def _taken_at(case: Case, report: ServiceReport) -> str:
    """The speed and the temperature that a reading is taken at, and whose they are."""
    if report.reading is None:
        return ""
    speed = units.shown(report.reading.screw_speed, inputs_of(case.model, case.screw, case.lubricant)["screw_speed"][1])
    given = report.reading.temperature
    warm = case.lubricant.temperature if given is None else given
    if warm is None:
        return f"; taken at {speed}"
    whose = "" if given is not None else ", the oil of the case"
    return f"; taken at {speed} and {units.shown(warm, TEMPERATURE, 3)}{whose}"


def _logs(report: ServiceReport) -> list[dict[str, Any]]:
    sources = [one.fit.rows.log.source for one in report.estimates.values() if one.fit is not None]
    return [{"log": source[0], "sha256": source[1]} for source in sources if source is not None]
