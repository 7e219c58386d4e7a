"""``ballscrew hand-over``: the files that were written, their range, and their worst error, as text."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import wrapped
from ballscrew.basis.quantities import Quantity
from ballscrew.exports.export import Export
from ballscrew.exports.worst_error import WorstError


def text(export: Export, written: Sequence[Path]) -> str:
    """The files, the range, the worst error of each output, and the warnings."""
    return "\n".join(map(wrapped, [*(f"{path}" for path in written), *lines(export)]))


def lines(export: Export) -> list[str]:
    """The range, the worst error of each output, and the warnings, one line each."""
    lines = ["range, beyond which the nearest value counts and valid is 0:"]
    lines += [f"  {name}: {_ends(ends, export.quantities[name])}" for name, ends in export.valid_range.items()]
    if export.worst_error:
        over = "; ".join(f"{n} {_ends(ends, export.quantities[n])}" for n, ends in export.measured_range.items())
        lines += [f"worst error against the model at random points, {over}:"]
        lines += [f"  {_error(one)}" for one in export.worst_error]
    return [*lines, *(f"warning: {record.text}" for record in export.warnings)]


def _ends(ends: tuple[float, float], quantity: Quantity) -> str:
    least, greatest = (units.shown(end, quantity) for end in ends)
    return least if ends[0] == ends[1] else f"{least} to {greatest}"


def _error(one: WorstError) -> str:
    if one.output == "valid":
        return f"valid: {'the same at all' if one.value == 0 else 'differs at some of'} {one.points} points"
    value = f"{one.value:.2g}" + ("" if one.unit == "1" else f" {one.unit}")
    return f"{one.output}: {value}, relative {one.relative:.2g}, of its largest value {one.of_largest:.2g}"
