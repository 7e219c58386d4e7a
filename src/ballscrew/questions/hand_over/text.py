"""``ballscrew hand-over``: the files that were written, their range, and their worst error, as text."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import wrapped
from ballscrew.exports.export import Export, WorstError


def text(export: Export, written: Sequence[Path]) -> str:
    """The files, the range, the worst error of each output, and the warnings."""
    return "\n".join(map(wrapped, [*(f"{path}" for path in written), *lines(export)]))


def lines(export: Export) -> list[str]:
    """The range, the worst error of each output, and the warnings, one line each."""
    names: list[str] = []
    for heading, entries in blocks(export):
        names += [heading, *(f"  {entry}" for entry in entries)]
    return [*names, *(f"warning: {record.text}" for record in export.warnings)]


def blocks(export: Export) -> list[tuple[str, list[str]]]:
    """Headings and what stands below them: the range of each input, and the worst error of each output."""
    ranges = [_ends(name, ends, export) for name, ends in export.valid_range.items()]
    pairs = [("range, beyond which the nearest value counts and valid is 0:", ranges)]
    if export.worst_error:
        over = "; ".join(_of_range(name, ends, export) for name, ends in export.measured_range.items())
        heading = f"worst error against the model at random points, {over}:"
        pairs.append((heading, [_error(one) for one in export.worst_error]))
    return pairs


def _ends(name: str, ends: tuple[float, float], export: Export) -> str:
    least, greatest = (units.shown(end, export.quantities[name]) for end in ends)
    if ends[0] == ends[1]:
        return f"{name}: {least}"
    return f"{name}: {least} to {greatest}"


def _of_range(name: str, ends: tuple[float, float], export: Export) -> str:
    least, greatest = (units.shown(end, export.quantities[name]) for end in ends)
    if ends[0] == ends[1]:
        return f"{name} {least}"
    return f"{name} {least} to {greatest}"


def _error(one: WorstError) -> str:
    if one.output == "valid":
        differs = "the same at all" if one.value == 0 else "differs at some of"
        return f"valid: {differs} {one.points} points"
    written = f"{one.value:.2g}" + ("" if one.unit == "1" else f" {one.unit}")
    return f"{one.output}: {written}, relative {one.relative:.2g}, of its largest value {one.of_largest:.2g}"
