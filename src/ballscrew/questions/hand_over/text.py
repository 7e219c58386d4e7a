"""``ballscrew hand-over``: the files that were written, their range, and their worst error, as text."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ballscrew.basis import units
from ballscrew.basis.errors import chained
from ballscrew.basis.output.wrapping import wrapped
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.basis.records import Measured, Message
from ballscrew.exports.export import Export
from ballscrew.exports.worst_error import WorstError


def text(export: Export, written: Sequence[Path]) -> str:
    """The files, the range, the worst error of each output, and the warnings."""
    return "\n".join(map(wrapped, [*(f"{path}" for path in written), *lines(export)]))


def lines(export: Export) -> list[str]:
    """The range, the worst error of each output, and the warnings, one line each."""
    found: list[str] = []
    for heading, entries in blocks(export):
        found += [units.filled(heading), *(f"  {units.filled(entry)}" for entry in entries)]
    return [*found, *(f"warning: {record.text}" for record in export.warnings)]


def blocks(export: Export) -> list[tuple[Message, list[Message]]]:
    """Headings and what stands below them: the range of each input, and the worst error of each output."""
    ranges = [_ends(name, ends, export) for name, ends in export.valid_range.items()]
    found = [(Message("range, beyond which the nearest value counts and valid is 0:"), ranges)]
    if export.worst_error:
        measured = [_of_range(name, ends, export) for name, ends in export.measured_range.items()]
        over = chained(Message("{others}; {last}"), measured)
        heading = Message("worst error against the model at random points, {ranges}:", {"ranges": over})
        found.append((heading, [_error(one) for one in export.worst_error]))
    return found


def _ends(name: str, ends: tuple[float, float], export: Export) -> Message:
    least, greatest = (units.shown(end, export.quantities[name]) for end in ends)
    if ends[0] == ends[1]:
        return Message("{name}: {value}", {"name": name, "value": least})
    return Message("{name}: {least} to {greatest}", {"name": name, "least": least, "greatest": greatest})


def _of_range(name: str, ends: tuple[float, float], export: Export) -> Message:
    least, greatest = (units.shown(end, export.quantities[name]) for end in ends)
    if ends[0] == ends[1]:
        return Message("{name} {value}", {"name": name, "value": least})
    return Message("{name} {least} to {greatest}", {"name": name, "least": least, "greatest": greatest})


def _error(one: WorstError) -> Message:
    if one.output == "valid":
        same = Message("valid: the same at all {points} points")
        message = same if one.value == 0 else Message("valid: differs at some of {points} points")
        return message.of(points=str(one.points))
    written = f"{one.value:.2g}" + ("" if one.unit == "1" else f" {one.unit}")
    return Message(
        "{output}: {value}, relative {relative}, of its largest value {share}",
        {
            "output": one.output,
            "value": Measured(one.value, Quantity("", one.unit, Info("", "")), 2, written=written),
            "relative": f"{one.relative:.2g}",
            "share": f"{one.of_largest:.2g}",
        },
    )
