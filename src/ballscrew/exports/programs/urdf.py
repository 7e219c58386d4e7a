"""``--to urdf``: dry friction and damping of a prismatic joint, which knows no load, in URDF, SDF and USD."""

from __future__ import annotations

import math

from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export, Target, filled
from ballscrew.exports.programs.joint_friction import (
    JOINT_OPTIONS,
    JointErrors,
    JointFriction,
    joint_errors,
    joint_export,
    joint_friction,
    joint_range,
    options_of_case,
    provenance_line,
)
from ballscrew.exports.subject import HandOver

#: Edge of the cube that stands for what moves, m: its inertia is nowhere needed and everywhere asked for.
EDGE = 0.2


def export(job: HandOver) -> Export:
    """An axis in URDF, SDF and USD, and its numbers as JSON.

    Raises :class:`~ballscrew.basis.errors.InputError` without a load, and where the model has no friction at it.
    """
    joint = joint_friction(job, 1)
    errors = joint_errors(job, joint)
    values = _values(job, joint, errors)
    files = {name: filled(name, **values) for name in ("axis.urdf", "axis.sdf", "axis.usda")}
    return joint_export(job, "urdf", joint, errors, files, balances=False, valid_range=joint_range(job))


URDF = Target(export, JOINT_OPTIONS, options_of_case)


def _values(job: HandOver, joint: JointFriction, errors: JointErrors) -> dict[str, str | float]:
    low, high = joint.speeds
    note = f"{errors.text}. Fitted from {low:g} to {high:g} rad/s of the shaft."
    # the quaternion that turns the upward direction into that of positive motion, about the second axis
    half = (math.pi / 2 - joint.inclination) / 2
    return {
        "provenance": provenance_line(job),
        "note": " ".join([note, *(f"Beware: {record.text}." for record in joint.warnings(balances=False))]),
        "direction": joint.direction_text,
        "turn": f"{math.cos(half)!r}, 0, {math.sin(half)!r}, 0",
        "mass": float(joint.mass),
        "inertia": float(joint.mass * EDGE**2 / 6),
        "effort": float(max(map(abs, job.working_range[OPERATION[0]])) + joint.dry),
        "velocity": float(high / joint.arm),
        "damping": float(joint.damping[0]),
        "friction": float(joint.dry),
        "static": float(max(joint.at_rest * joint.arm, joint.dry)),
        "armature": float(joint.armature),
        "rotor": float(joint.inertia),
        "arm": float(joint.arm),
    }
