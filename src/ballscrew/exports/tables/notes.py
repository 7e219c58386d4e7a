"""Lines about an export for the head of its files: what it is of, its range, its error, rest and beyond."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ballscrew.basis import units
from ballscrew.exports.subject import HandOver
from ballscrew.exports.worst_error import WorstError

#: What happens beyond the range, and at rest.
BEYOND = "Beyond the range the nearest value counts, and valid is 0."
AT_REST = (
    "At rest friction is a set: it holds any torque up to screw_torque either way. The torque on the shaft in motion "
    "is ideal_torque + sign(screw_speed) * screw_torque."
)
SIGNS = "A positive axial_load is one that a positive screw_speed lifts; screw_torque is the size of the friction."


def made_of(handed: HandOver) -> list[str]:
    """Model, nut, version and sources."""
    found = handed.provenance
    sources = ", ".join(found["references"])
    return [
        f"Friction of a ball screw: model {found['model']}, {found['nut']}, made by ballscrew {found['version']}.",
        f"Sources of the model: {sources}.",
    ]


def ranges(handed: HandOver, ends: Mapping[str, tuple[float, float]]) -> list[str]:
    """The range of each input, in SI and as people write it."""
    quantities = {one.name: one.quantity for one in handed.inputs}
    lines: list[str] = []
    for name, (least, greatest) in ends.items():
        quantity = quantities[name]
        both = [units.shown(end, quantity, 6) for end in (least, greatest)]
        shown = both[0] if least == greatest else f"{both[0]} to {both[1]}"
        si = f"{least:.6g}" if least == greatest else f"{least:.6g} to {greatest:.6g}"
        lines.append(f"{name} [{quantity.unit}]: {si} ({shown})" + (", fixed" if least == greatest else ""))
    return lines


def errors(found: Sequence[WorstError]) -> list[str]:
    """The worst error of each output that is a number."""
    return [
        f"{one.output} [{one.unit}]: {one.value:.3g}, {100 * one.of_largest:.2g} % of its largest {one.largest:.4g}"
        for one in found
        if one.output != "valid"
    ]


def lines(handed: HandOver, ends: Mapping[str, tuple[float, float]], found: Sequence[WorstError]) -> list[str]:
    """All of it."""
    return [
        *made_of(handed),
        SIGNS,
        AT_REST,
        "Range:",
        *(f"  {line}" for line in ranges(handed, ends)),
        BEYOND,
        f"Worst error against the model over this range, at {found[0].points} points, measured when it was made:",
        *(f"  {line}" for line in errors(found)),
        *(f"Beware: {record.text}." for record in handed.starvation),
    ]


def text(
    handed: HandOver, ends: Mapping[str, tuple[float, float]], found: Sequence[WorstError], of_files: str
) -> bytes:
    """A README: what the files are, what is to be known of them, and all numbers that they are made of."""
    fixed = handed.provenance["inputs"].items()
    unit = {
        name: "" if quantity.unit == "1" else quantity.unit for name, (_, quantity) in handed.subject.inputs.items()
    }
    values = [f"  {name} = {value:.9g} {unit[name]}".rstrip() for name, value in fixed]
    return "\n".join([of_files, *lines(handed, ends, found), "Made of:", *values, ""]).encode()
