"""``ballscrew run --band``: the band of a case as text on the terminal, and the sentences of its picture and report."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from rich.console import Console
from rich.table import Table

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Message
from ballscrew.cases.case_files.case_file import Case
from ballscrew.cases.case_files.descriptions import design, title
from ballscrew.cases.case_files.uncertain_inputs import GIVEN, Uncertain
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.engine.uncertainty.bands import BandCurve, Interval, OutputBand
from ballscrew.questions.band.compute import BandReport
from ballscrew.questions.band.document import verdicts, warnings
from ballscrew.questions.shared.text_tables import ends_or_dashes, shown_or_dash, table_of

_TORQUE = "screw_torque"
#: Outputs on the terminal besides the friction torque.
SHOWN = ("drive_torque", "holding_torque", "efficiency", "back_driving_efficiency", "friction_power")
#: Meanings where there is little room.
_SHORT = {"holding_torque": "torque that holds the load", "back_driving_efficiency": "efficiency, load drives"}
CAUSES: Sequence[str] = ("inputs and laws", "inputs alone", "laws alone")
_BAR_WIDTH = 24


class Listing(NamedTuple):
    """A heading and the lines below it."""

    heading: str
    entries: Sequence[str] = ()


def print_band(case: Case, report: BandReport) -> None:
    """The friction torque and its two causes, what follows from it, and what was taken as uncertain."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    say(f"{title(case)}\n", "bold")
    for verdict in verdicts(case, report):
        say(verdict.text)
    console.print(_causes(case, report, console.encoding))
    console.print(_others(case, report))
    for listing, style in ((exchanged_laws(case, report), None), *((one, "dim") for one in uncertain_inputs(report))):
        if listing.heading:
            say(f"\n{listing.heading}", style)
        for entry in listing.entries:
            say(f"  {entry}", style)
    for warning in [*case.implausible(), *warnings(report)]:
        say(f"beware  {warning.text}", "yellow")


def _quantities(case: Case) -> Mapping[str, Quantity]:
    return {name: known_outputs(case.screw.nut)[name].quantity for name in BAND_OUTPUTS}


def intervals(output: OutputBand) -> Sequence[Interval]:
    """The intervals of an output, one for each of :data:`CAUSES`."""
    return output.both, output.parameters, output.model_form


def _causes(case: Case, report: BandReport, encoding: str) -> Table:
    """The friction torque because of inputs and laws together, and of each alone, as bars on one axis."""
    torque, quantity = report.band[_TORQUE], _quantities(case)[_TORQUE]
    table = table_of("\nFriction torque on the screw, and the share of its variance", "", "from", "to", "share", "")
    table.columns[-1].justify = "left"
    shares = ("", _percent(torque.share_of_parameters), _percent(1 - torque.share_of_parameters))
    ends = [end for interval in intervals(torque) for end in interval if math.isfinite(end)]
    for words, interval, share in zip(CAUSES, intervals(torque), shares, strict=True):
        cells = ends_or_dashes(*interval, quantity)
        table.add_row(words, *cells, share, _bar(interval, torque.value, ends, encoding))
    return table


def _bar(interval: Interval, value: float, ends: Sequence[float], encoding: str) -> str:
    """An interval on the axis of all, with a stroke at the value of the case."""
    if not ends or not all(map(math.isfinite, (*interval, value))):
        return ""
    low, high = min(*ends, value), max(*ends, value)
    if high == low:
        return ""
    block, stroke = ("█", "│") if "utf" in encoding.lower() else ("#", "|")

    def place(x: float) -> int:
        return round((x - low) / (high - low) * (_BAR_WIDTH - 1))

    cells = [" "] * _BAR_WIDTH
    first, last = (place(end) for end in interval)
    cells[first : last + 1] = block * (last + 1 - first)
    cells[place(value)] = stroke
    return "".join(cells).rstrip()


def _others(case: Case, report: BandReport) -> Table:
    table = table_of("\nWhat follows from it", "", "case", "median", "from", "to")
    for name in SHOWN:
        if name == "holding_torque" and not case.operation.axial_load:
            continue  # nothing to hold
        quantity, one = _quantities(case)[name], report.band[name]
        table.add_row(
            _SHORT.get(name, quantity.info.meaning),
            *(shown_or_dash(x, quantity) for x in (one.value, one.median)),
            *ends_or_dashes(*one.both, quantity),
        )
    return table


def exchanged_laws(case: Case, report: BandReport) -> Listing:
    """The laws that were drawn instead of the model's, slot by slot; nothing for a fit, which exchanges none."""
    if case.fit:
        return Listing("")
    if not report.band.alternatives:
        return Listing("no other law is valid here: the band is that of the inputs alone")
    return Listing(
        "laws that are valid here and could stand in place of the model's, and the torque with each",
        [
            f"{slot.replace('_', ' ')}: " + ", ".join(f"{law.name} {math.expm1(law.shift):+.1%}" for law in laws)
            for slot, laws in report.band.alternatives.items()
        ],
    )


def uncertain_inputs(report: BandReport) -> list[Listing]:
    """The uncertain inputs: those of the case file, then those assumed, with their source."""
    given = [f"{spoken(name)} {u.description}{_by(u)}" for name, u in report.inputs.items() if u.given]
    assumed = [
        f"{spoken(name)} {u.description} ({u.source}: {u.reason})" for name, u in report.inputs.items() if not u.given
    ]
    headings = {
        "uncertain, as the case says": given,
        "assumed to be uncertain; write them with ± in the case file if you know better": assumed,
    }
    listings = [Listing(heading, entries) for heading, entries in headings.items() if entries]
    return listings or [Listing("no input is uncertain")]


def _by(one: Uncertain) -> str:
    return "" if one.source == GIVEN else f" ({one.source})"


def spoken(name: str) -> str:
    """The name of an input without underscores and dots."""
    return name.replace("_", " ").replace(".", " ")


def _percent(share: float) -> str:
    return f"{share:.0%}" if math.isfinite(share) else "–"


def input_counts(report: BandReport) -> Message:
    """The number of samples, of uncertain inputs, and of those assumed."""
    count = len(report.inputs)
    counts = {
        "samples": report.band.count, "inputs": count, "given": report.given, "assumed": count - report.given,
        "judged": report.judged,
    }  # fmt: skip
    return Message(
        "{samples} samples of {inputs} uncertain inputs: {given} by the case, {assumed} assumed, "
        "{judged} of these by judgement",
        {name: str(number) for name, number in counts.items()},
    )


def caption(case: Case, report: BandReport, curve: BandCurve) -> str:
    """The caption of the picture."""
    exact = f"On the left {curve.count} samples"
    if curve.along in report.inputs:
        exact += f", and the {spoken(curve.along)} is exact"
    parts = [design(case), units.filled(input_counts(report)), *(warning.text for warning in warnings(report)), exact]
    return ". ".join(filter(None, parts)) + "."
