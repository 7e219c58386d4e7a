"""Text about an export, beside its files and at their head: inputs and outputs, ranges, worst error, sources."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ballscrew.basis import units
from ballscrew.exports.export import WorstError
from ballscrew.exports.subject import HandOver
from ballscrew.physics.components.materials import OF_A_GRADE
from ballscrew.physics.friction.validity import NUT_REASONS

_SIGNS = """\
Signs: axial_load > 0 is the load that a positive screw_speed lifts. screw_torque is the size of the friction;
drive_torque = ideal_torque + sign(screw_speed) * screw_torque is the torque on the shaft in motion. At rest friction
holds up to screw_torque either way: drive_torque is then the ideal one, and holding_torque what must hold the load,
for a positive load negative where the screw locks itself.
Beyond the range of an input its nearest value counts, and valid is 0. All numbers are in SI units.
"""


def readme(job: HandOver, kind: str, notes: str, errors: Sequence[WorstError] = ()) -> str:
    """The text of an export of some kind, with notes of its own."""
    subject, made_of = job.subject, job.provenance
    limits = job.formula_range
    inputs = [
        f"  {entry.name} [{entry.quantity.unit}]: {job.meanings[entry.name]}; usually {entry.value:.9g}, "
        f"{limits[entry.name][0]:.9g} to {limits[entry.name][1]:.9g}"
        for entry in job.inputs
    ]
    outputs = [f"  {name} [{job.units[name]}]: {job.meanings[name]}" for name in job.output_names]
    rows = [
        f"  {entry.output}: {entry.value:.2g}, relative {entry.relative:.2g}, at {entry.points} points"
        for entry in errors
    ]
    return "\n".join(
        [
            f"{kind} of the friction of a ball screw, model {subject.model.label}, {type(subject.nut).__name__}",
            f"Made by ballscrew {made_of['version']} (MIT licence).",
            "",
            "Inputs:",
            *inputs,
            "",
            "Outputs:",
            *outputs,
            "",
            _SIGNS,
            "valid is 0 beyond the range of an input, and where one of these is so:",
            *(f"  {reason}" for name, reason in NUT_REASONS.items() if name != "inputs"),
            "",
            notes,
            *(f"Beware: {record.text}.\n" for record in job.starvation),
            *(["Worst error against the model in Python:", *rows, ""] if rows else []),
            f"Sources of the model: {', '.join(made_of['references'])}",
            "",
            "All else is fixed at:",
            *_fixed(job, made_of["inputs"]),
            "",
        ]
    )


def _fixed(job: HandOver, values: Mapping[str, float]) -> list[str]:
    follows = set(OF_A_GRADE) if job.subject.lubricant.follows_temperature else set()
    return [
        f"  {name} = {float(value)!r}{' at the usual temperature' if name in follows else ''}"
        for name, value in values.items()
        if name not in job.input_names
    ]


#: What happens beyond the range, and at rest.
BEYOND = "Beyond the range the nearest value counts, and valid is 0."
AT_REST = (
    "At rest friction is a set: it holds any torque up to screw_torque either way. The torque on the shaft in motion "
    "is ideal_torque + sign(screw_speed) * screw_torque."
)
SIGNS = "A positive axial_load is one that a positive screw_speed lifts; screw_torque is the size of the friction."


def made_of(job: HandOver) -> list[str]:
    """Model, nut, version and sources."""
    made = job.provenance
    return [
        f"Friction of a ball screw: model {made['model']}, {made['nut']}, made by ballscrew {made['version']}.",
        f"Sources of the model: {', '.join(made['references'])}.",
    ]


def ranges(job: HandOver, ends: Mapping[str, tuple[float, float]]) -> list[str]:
    """The range of each input, in SI and as people write it."""
    quantities = {entry.name: entry.quantity for entry in job.inputs}
    lines: list[str] = []
    for name, (least, greatest) in ends.items():
        quantity = quantities[name]
        both = [units.shown(end, quantity, 6) for end in (least, greatest)]
        shown = both[0] if least == greatest else f"{both[0]} to {both[1]}"
        si = f"{least:.6g}" if least == greatest else f"{least:.6g} to {greatest:.6g}"
        lines.append(f"{name} [{quantity.unit}]: {si} ({shown})" + (", fixed" if least == greatest else ""))
    return lines


def table_lines(job: HandOver, ends: Mapping[str, tuple[float, float]], worst: Sequence[WorstError]) -> list[str]:
    """Lines about a table: what it is of, its range, its error, rest and beyond."""
    of_each = [
        f"  {error.output} [{error.unit}]: {error.value:.3g}, {100 * error.of_largest:.2g} % of its largest "
        f"{error.largest:.4g}"
        for error in worst
        if error.output != "valid"
    ]
    return [
        *made_of(job),
        SIGNS,
        AT_REST,
        "Range:",
        *(f"  {line}" for line in ranges(job, ends)),
        BEYOND,
        f"Worst error against the model over this range, at {worst[0].points} points, measured when it was made:",
        *of_each,
        *(f"Beware: {record.text}." for record in job.starvation),
    ]


def table_readme(job: HandOver, about: Sequence[str], of_files: str) -> str:
    """A README: what the files are, what is to be known of them, and all numbers that they are made of."""
    unit = {name: "" if quantity.unit == "1" else quantity.unit for name, (_, quantity) in job.subject.inputs.items()}
    values = [f"  {name} = {value:.9g} {unit[name]}".rstrip() for name, value in job.provenance["inputs"].items()]
    return "\n".join([of_files, *about, "Made of:", *values, ""])
