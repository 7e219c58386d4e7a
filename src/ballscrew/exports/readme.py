"""The text beside an export: its inputs and outputs, their ranges, its worst error, and where it comes from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ballscrew.exports.subject import HandOver
from ballscrew.exports.worst_error import WorstError
from ballscrew.physics.components.materials import OF_A_GRADE
from ballscrew.physics.friction.validity import NUT_REASONS

_SIGNS = """\
Signs: axial_load > 0 is the load that a positive screw_speed lifts. screw_torque is the size of the friction;
drive_torque = ideal_torque + sign(screw_speed) * screw_torque is the torque on the shaft in motion. At rest friction
holds up to screw_torque either way: drive_torque is then the ideal one, and holding_torque what must hold the load,
for a positive load negative where the screw locks itself.
Beyond the range of an input its nearest value counts, and valid is 0. All numbers are in SI units.
"""


def readme(handed: HandOver, kind: str, notes: str, errors: Sequence[WorstError] = ()) -> str:
    """The text of an export of some kind, with notes of its own."""
    subject, made_of = handed.subject, handed.provenance
    limits = handed.formula_range
    inputs = [
        f"  {one.name} [{one.quantity.unit}]: {handed.meanings[one.name]}; usually {one.value:.9g}, "
        f"{limits[one.name][0]:.9g} to {limits[one.name][1]:.9g}"
        for one in handed.inputs
    ]
    outputs = [f"  {name} [{handed.units[name]}]: {handed.meanings[name]}" for name in handed.output_names]
    found = [f"  {one.output}: {one.value:.2g}, relative {one.relative:.2g}, at {one.points} points" for one in errors]
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
            *(f"Beware: {record.text}.\n" for record in handed.starvation),
            *(["Worst error against the model in Python:", *found, ""] if found else []),
            f"Sources of the model: {', '.join(made_of['references'])}",
            "",
            "All else is fixed at:",
            *_fixed(handed, made_of["inputs"]),
            "",
        ]
    )


def _fixed(handed: HandOver, values: Mapping[str, float]) -> list[str]:
    follows = set(OF_A_GRADE) if handed.subject.lubricant.follows_temperature else set()
    return [
        f"  {name} = {float(value)!r}{' at the usual temperature' if name in follows else ''}"
        for name, value in values.items()
        if name not in handed.input_names
    ]
