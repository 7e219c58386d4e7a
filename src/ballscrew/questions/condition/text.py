"""``ballscrew condition``: the states on the terminal, and the sentences of its picture."""

from __future__ import annotations

import math

from rich.console import Console
from rich.table import Table

from ballscrew.basis import units
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, model_text, nut_text
from ballscrew.evidence.service.condition_values import Condition
from ballscrew.files.torque_logs.torque_series import quantities
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.shared.text_tables import table_of

#: More tests than these are not all listed: the baseline, those about the alarm and the last ones are.
MOST_ROWS = 40
#: Tests about the alarm that are listed.
_ABOUT = 5


def print_condition(case: Case, found: Condition) -> None:
    """What is wrong with the series first, then the alarm, the preload, the trend, and the states."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    say(f"{names(found)}: {nut_text(case.screw.nut)}, {model_text(case)}\n", "bold")
    for record in found.warning_records:
        if record.severity == "warning":
            say(f"beware  {record.text}", "yellow")
    first, *others = found.verdict_records
    say(first.text, "bold")
    for record in others:
        say(record.text)
    console.print()
    console.print(_states(found))
    for record in found.warning_records:
        if record.severity != "warning":
            say(f"note  {record.text}", "dim")
    for note in found.notes:
        say(f"note  {note}", "dim")


def names(found: Condition) -> str:
    """The files of the tests."""
    files = [name for name, _ in found.sources]
    return ", ".join(files) if 0 < len(files) <= 3 else f"{len(found.states)} tests"


def at_reference(found: Condition) -> str:
    """``at 40 °C and 100 rpm``: where the torques are reduced to."""
    speed = units.shown(found.reference_speed, quantities()["screw_speed"], 3)
    if not math.isfinite(found.reference_temperature):
        return f"at {speed}"
    return f"at {units.shown(found.reference_temperature, TEMPERATURE, 3)} and {speed}"


def _states(found: Condition) -> Table:
    torque = quantities()["torque"]
    title = f"Torque {at_reference(found)}, preload over that of the first {found.baseline} tests"
    table = table_of(title, "test", "logged", "torque", "95 %", "preload", "95 %", "CUSUM", "limit")
    shown = _shown_rows(found)
    for before, i in zip([-1, *shown], shown, strict=False):
        if i > before + 1:
            table.add_row("…")
        one = found.states[i]
        worst = max(found.chart.fall[i], found.chart.rise[i])
        table.add_row(
            f"{one.label}{' alarm' if i == found.alarm else ''}",
            "–" if one.temperature is None else units.shown(one.temperature, TEMPERATURE, 3),
            units.shown(one.torque, torque, 3),
            f"{one.torque_low:.3g} to {one.torque_high:.3g}",
            _percent(one.preload),
            f"{_percent(one.preload_low)} to {_percent(one.preload_high)}" if math.isfinite(one.preload) else "–",
            f"{worst:.1f}" if math.isfinite(worst) else "baseline",
            f"{found.chart.limit[i]:.1f}" if math.isfinite(worst) else "",
        )
    return table


def _shown_rows(found: Condition) -> list[int]:
    count = len(found.states)
    if count <= MOST_ROWS:
        return list(range(count))
    about = range(0) if found.alarm is None else range(found.alarm - _ABOUT, found.alarm + _ABOUT + 1)
    rows = {*range(found.baseline), *about, *range(count - 2 * _ABOUT, count)}
    return sorted(i for i in rows if 0 <= i < count)


def _percent(share: float) -> str:
    return f"{share:.0%}" if math.isfinite(share) else "–"


def caption(case: Case, found: Condition) -> str:
    """The caption of the picture."""
    beware = "".join(f"{record.text}. " for record in found.warning_records if record.id == "condition.no_temperature")
    first = found.verdict_records[0].text
    return (
        f"{design(case)}. {beware}{first[:1].upper()}{first[1:]}. Torques {at_reference(found)}; bars and shade: 95 %; "
        "right: sums of the changes (CUSUM) in standard deviations, with their limit."
    )
