"""``--to urdf``: dry friction and damping of a prismatic joint, which knows no load, in URDF, SDF and USD."""

from __future__ import annotations

import dataclasses
import json
import math

from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export
from ballscrew.exports.programs.joint_friction import (
    JOINT_OPTIONS,
    JointErrors,
    JointFriction,
    filled,
    joint_errors,
    joint_friction,
    joint_range,
    options_of_case,
    provenance_line,
)
from ballscrew.exports.subject import HandOver

__all__ = ["OPTIONS", "export", "options_of_case"]

OPTIONS = JOINT_OPTIONS
#: Edge of the cube that stands for what moves, m: its inertia is nowhere needed and everywhere asked for.
EDGE = 0.2


def export(handed: HandOver) -> Export:
    """An axis in URDF, SDF and USD, and its numbers as JSON.

    Raises :class:`~ballscrew.basis.errors.InputError` without a load, and where the model has no friction at it.
    """
    joint = joint_friction(handed, 1)
    errors = joint_errors(handed, joint)
    values = _values(handed, joint, errors)
    files = {name: filled(name, values) for name in ("axis.urdf", "axis.sdf", "axis.usda")}
    document = {"made_by": provenance_line(handed), **joint.document(), **errors.document()}
    files["axis.json"] = json.dumps(document, indent=2) + "\n"
    made = Export.of(
        handed,
        "urdf",
        {path: text.encode() for path, text in files.items()},
        valid_range=joint_range(handed),
        worst_error=errors.of_export,
        warnings=[*errors.warnings(joint), *joint.warnings(balances=False)],
    )
    return dataclasses.replace(made, measured_range=joint_range(handed))


def _values(handed: HandOver, joint: JointFriction, errors: JointErrors) -> dict[str, str]:
    low, high = joint.speeds
    largest = max(map(abs, handed.working_range[OPERATION[0]]))
    numbers = {
        "MASS": joint.mass,
        "INERTIA": joint.mass * EDGE**2 / 6,
        "EFFORT": largest + joint.dry,
        "VELOCITY": high / joint.arm,
        "DAMPING": joint.damping[0],
        "FRICTION": joint.dry,
        "STATIC": max(joint.at_rest * joint.arm, joint.dry),
        "ARMATURE": joint.armature,
        "ROTOR": joint.inertia,
        "ARM": joint.arm,
    }
    note = f"{errors.text}. Fitted from {low:g} to {high:g} rad/s of the shaft."
    texts = {
        "PROVENANCE": provenance_line(handed),
        "NOTE": " ".join([note, *(f"Beware: {one.text}." for one in joint.warnings(balances=False))]),
        "DIRECTION": joint.direction_text,
        "TURN": _turn(joint.inclination),
    }
    return texts | {name: repr(float(value)) for name, value in numbers.items()}


def _turn(inclination: float) -> str:
    """The quaternion that turns the upward direction into that of positive motion, about the second axis."""
    half = (math.pi / 2 - inclination) / 2
    return f"{math.cos(half)!r}, 0, {math.sin(half)!r}, 0"
