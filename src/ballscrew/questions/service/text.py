"""``ballscrew service``: the preloads on the terminal, and the sentences of its picture."""

from __future__ import annotations

import math

from rich.console import Console
from rich.table import Table

from ballscrew.basis import units
from ballscrew.basis.records import Message, Named, Value
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, model_text, nut_text
from ballscrew.evidence.service.preload_estimate import PreloadEstimate
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.service.compute import TORQUE, ServiceReport
from ballscrew.questions.service.document import preload_quantity, verdicts
from ballscrew.questions.shared.text_tables import table_of

#: Causes of an interval that are no input of the model.
_CAUSES = {
    "nominal preload": Message("nominal preload"),
    "temperature of the new log": Message("temperature of the new log"),
    "temperature of the worn log": Message("temperature of the worn log"),
}
#: Causes of an interval that are named.
_MOST_CAUSES = 3
#: A cause that is less than this share of an interval is not named.
_LEAST_CAUSE = 0.1
#: More than this share of an interval is most of it.
_MOST = 0.5


def print_service(case: Case, report: ServiceReport) -> None:
    """The logs, what became of the preload, the preloads, what else could be, and where the interval comes from."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    say(f"{', '.join(names(report))}: {nut_text(case.screw.nut)}, {model_text(case)}\n", "bold")
    for record in verdicts(case, report)[:1]:
        say(record.text, "bold" if report.change is not None else None)
    if report.change is not None:
        console.print()
        console.print(_preloads(case, report))
    for line in _logs(report):
        say(line, "dim")
    for cause in causes(report):
        say(units.filled(cause), "dim")
    for record in report.warnings:
        say(f"{'beware' if record.severity == 'warning' else 'note'}  {record.text}", "yellow")
    if report.change is not None:
        others = verdicts(case, report)[1:]
        if others:
            before = "case" if report.change.new.fit is None else "new log"
            say(f"\nWith the preload of the {before}:", "bold")
        for record in others:
            say(f"  {record.text}")


def _logs(report: ServiceReport) -> list[str]:
    """Of each log, the rows that are used, why the others are not, and what was done to it."""
    logs = {label: one.fit.rows.log for label, one in report.estimates.items() if one.fit is not None}
    return [f"{label} log: {line}" for label, log in logs.items() for line in (log.usage, *log.notes)]


def names(report: ServiceReport) -> list[str]:
    """The logs by the names of their files, or the reading."""
    if report.reading is not None:
        return [f"drag torque {units.shown(report.reading.torque, TORQUE)}"]
    found: list[str] = []
    for label, one in report.estimates.items():
        if one.fit is not None:
            source = one.fit.rows.log.source
            found.append(label if source is None else source[0])
    return found


def _preloads(case: Case, report: ServiceReport) -> Table:
    quantity = preload_quantity(case)
    table = table_of("Preload", "", "rows", "temperature", "preload", "95 % interval", "residual")
    for label, one in report.estimates.items():
        table.add_row(
            label_of(label, one),
            "–" if one.fit is None else str(len(one.fit.rows.log)),
            "–" if one.temperature is None else units.shown(one.temperature, TEMPERATURE, 3),
            units.shown(one.preload, quantity),
            _interval(one, case),
            "–" if one.fit is None else units.shown(one.residual_rms, TORQUE, 2),
        )
    return table


def label_of(label: str, one: PreloadEstimate) -> str:
    """``new``, ``worn``; a preload that is not from a log is the nominal one."""
    return "nominal" if label == "new" and one.fit is None else label


def _interval(one: PreloadEstimate, case: Case) -> str:
    low, high = one.interval()
    if not math.isfinite(high):
        return "–"
    return " to ".join(units.ends(low, high, preload_quantity(case)))


def causes(report: ServiceReport) -> list[Message]:
    """What the interval comes from, the largest cause first."""
    of = report.change.ratio_shares if report.change is not None else {}
    of = report.preload.shares if report.preload is not None else of
    shares = sorted(((share, name) for name, share in of.items() if math.isfinite(share)), reverse=True)
    largest = [
        Message("{cause} ({percent}%)", {"cause": _cause(name), "percent": units.as_written(f"{100 * share:.0f}")})
        for share, name in shares[:_MOST_CAUSES]
        if share >= _LEAST_CAUSE
    ]
    if not largest:
        return []
    if sum(share for share, _ in shares[:_MOST_CAUSES]) > _MOST:
        return [Message("most of the interval is from: {causes}", {"causes": largest})]
    return [Message("no cause makes most of the interval; the largest: {causes}", {"causes": largest})]


def _cause(name: str) -> Value:
    return _CAUSES.get(name, Named(name))


def caption(case: Case, report: ServiceReport) -> str:
    """The caption of the picture."""
    said = verdicts(case, report)[0].text
    curves = (
        "Lines: the model with the preload found, at the median load and the mean temperature of each log; "
        "dots: what was measured, moved there by the model"
    )
    return f"{design(case)}. {said}. {curves}; bars: 95 % intervals."
