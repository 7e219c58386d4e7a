"""``ballscrew service --json``: the document of a service; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.evidence.service.alternatives import Alternative
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.evidence.service.preload_change import VERDICTS
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.service.answer import results
from ballscrew.questions.service.compute import TORQUE, ServiceReport
from ballscrew.questions.shared.envelope import envelope

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
        return [units.record(text, id="service.preload_left", subject=PRELOAD, severity="warning")]
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
        units.record(
            text, id="service.preload_left", subject=PRELOAD, severity=severity, holds=holds, value=change.ratio,
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
    value, instead = (units.shown(number, one.quantity, 3) for number in (one.value, one.instead_of))
    off, off_of_preload = (units.shown(torque, TORQUE, 3) for torque in (one.rms, one.rms_of_preload))
    explains = "explains it as well" if one.explains else "does not explain it"
    text = (
        f"{one.name.rpartition('.')[2].replace('_', ' ')} {value} instead of {instead} {explains} (off by {off}, with "
        f"another preload {off_of_preload})"
    )
    if one.explains:
        text += f"; {_KNOWN[one.plausible]}"
    return units.record(
        text, id="service.alternative", subject=one.name, value=one.value, limit=one.instead_of,
        unit=one.quantity.unit, holds=one.explains,
    )  # fmt: skip


def _of_reading(case: Case, report: ServiceReport) -> Record:
    assert report.preload is not None
    quantity = preload_quantity(case)
    found = (report.preload.preload, *report.preload.interval())
    preload, low, high = (units.shown(force, quantity) for force in found)
    text = f"preload {preload} ({low} to {high})"
    nominal = getattr(case.screw.nut, "preload", None)
    if nominal:
        share, least, most = (units.percent(force / nominal) for force in found)
        text += f", {share} of the {units.shown(float(nominal), quantity)} of the case ({least} to {most})"
    text += _taken_at(case, report)
    return units.record(text, id="service.preload", subject=PRELOAD, value=report.preload.preload, unit="N")


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
