"""Joints of simulators: ``--to mujoco`` and ``--to urdf``.

MuJoCo gets joint parameters that know no load, an engine plugin that knows it, and an axis to try both; URDF, SDF and
USD dry friction and damping of a prismatic joint.
"""

from __future__ import annotations

import math
import re

from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export, Option, Target, filled, readme, refusal
from ballscrew.exports.programs import c99
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
from ballscrew.exports.programs.two_levels import two_levels
from ballscrew.exports.subject import HandOver

_NOTES = """\
axis_plugin.xml has the model as an actuator: inputs as above, but the load, which each step finds by itself.
Build it with make (make PYTHON=path/to/python), and try it with python run.py.
axis_parameters.xml has joint parameters instead, fitted from {low:g} to {high:g} rad/s.
{errors}.
{axis}
axis.json has the numbers of both. The gear is 2 pi / lead = {arm!r} 1/m.
"""
#: Impedance of dry friction: with the usual one of MuJoCo a joint creeps a thousand times as fast at rest.
HARD = "0.9999 0.9999 0.001"
#: Edge of the cube that stands for what moves, m: its inertia is nowhere needed and everywhere asked for.
EDGE = 0.2


def mujoco(job: HandOver) -> Export:
    """Sources of the plugin with their Makefile, two axes in MJCF, their numbers as JSON, and a script that runs them.

    Raises :class:`~ballscrew.basis.errors.InputError` without a load, where the model has no friction at it, and for a
    plugin name that MuJoCo would not find.
    """
    name = job.options["plugin"]
    if not re.fullmatch(r"\w+(\.\w+)*", name):
        raise refusal("plugin", "must be words with dots between", name, "such as machine.z_axis")
    if job.has_elastic_bodies:
        two_levels(job)  # what has no source is refused before its friction is computed
    joint = joint_friction(job, 3 if job.options["polynomial"] else 1)
    errors, (low, high) = joint_errors(job, joint), joint.speeds
    notes = _NOTES.format(errors=errors.text, axis=_axis_words(joint), arm=joint.arm, low=low, high=high)
    numbers = {"lead": joint.lead, "arm": joint.arm, "inertia": joint.inertia}
    files = {
        "ballscrew.c": c99.source(job),
        "ballscrew.h": c99.header(job),
        "ballscrew_plugin.c": filled("mujoco_plugin.c", provenance=provenance_line(job), plugin=name, **numbers),
        "Makefile": filled("mujoco_makefile"),
        "axis_parameters.xml": filled("mujoco_axis.xml", **_axis(job, joint), **_parameter_axis(joint, errors)),
        "axis_plugin.xml": filled("mujoco_axis.xml", **_axis(job, joint), **_plugin_axis(job, joint)),
        "run.py": filled("mujoco_run.txt"),
        "README.txt": readme(job, "MuJoCo plugin and joint parameters", notes),
    }
    return joint_export(job, "mujoco", joint, errors, files, balances=_is_balanced(joint))


_POLYNOMIAL = Option(True, "damping with powers of the speed (MuJoCo 3.7 or newer); no: linear, for any version")
_PLUGIN = Option("ballscrew.friction", "name of the plugin: give each screw of a simulation its own")
MUJOCO = Target(mujoco, {**JOINT_OPTIONS, "polynomial": _POLYNOMIAL, "plugin": _PLUGIN}, options_of_case)


def _axis_words(joint: JointFriction) -> str:
    """The axis in words: what moves, and what is assumed of it."""
    angle = math.degrees(joint.inclination)
    balance = f", balanced by {joint.counterforce:.4g} N" if joint.counterforce else ""
    moves = f"The axis moves {joint.mass:.4g} kg at {angle:.4g} deg above the horizontal{balance}."
    return " ".join([moves, *(f"Beware: {entry.text}." for entry in joint.warnings(balances=_is_balanced(joint)))])


def _axis(job: HandOver, joint: JointFriction) -> dict[str, str]:
    share = joint.counterforce / joint.weight if _is_balanced(joint) else 0.0
    return {
        "provenance": provenance_line(job),
        "mass": repr(joint.mass),
        "direction": joint.direction_text,
        "balance": f' gravcomp="{share!r}"' if share else "",
    }


def _is_balanced(joint: JointFriction) -> bool:
    """Return whether the force that balances the weight can be a share of it, as it is in MJCF."""
    return joint.weight != 0


def _parameter_axis(joint: JointFriction, errors: JointErrors) -> dict[str, str]:
    damping = " ".join(map(repr, joint.damping))
    low, high = joint.speeds
    return {
        "model": "ballscrew_parameters",
        "note": (
            f"{errors.text}.\n  Fitted from {low:g} to {high:g} rad/s of the shaft. At rest it creeps a little.\n"
            f"  {_axis_words(joint)}"
        ),
        "extension": "",
        "joint": (
            f'armature="{joint.armature!r}" frictionloss="{joint.dry!r}" damping="{damping}"\n             '
            f'solimpfriction="{HARD}"'
        ),
        "actuator": f'<motor name="screw" joint="axis" gear="{joint.arm!r}"/>',
        "sensor": "",
    }


def _plugin_axis(job: HandOver, joint: JointFriction) -> dict[str, str]:
    name = job.options["plugin"]
    known = [entry for entry in job.inputs if entry.name not in OPERATION]
    settings = {"inertia": joint.inertia, **{entry.name: entry.value for entry in known}}
    keys = "".join(f'        <config key="{key}" value="{value!r}"/>\n' for key, value in settings.items())
    return {
        "model": "ballscrew_plugin",
        "note": (
            "Build the plugin with make and load it first: mujoco.mj_loadPluginLibrary. Values in SI.\n"
            f"  {_axis_words(joint)}"
        ),
        "extension": (
            f'  <extension>\n    <plugin plugin="{name}">\n      <instance name="screw">\n{keys}      </instance>\n'
            "    </plugin>\n  </extension>\n"
        ),
        "joint": f'armature="{joint.armature!r}"',
        "actuator": f'<plugin name="screw" instance="screw" joint="axis" gear="{joint.arm!r}"/>',
        "sensor": (
            "  <sensor>\n    <!-- axial load, friction, accelerating torque, 1 where the model holds -->\n"
            '    <plugin name="screw" instance="screw"/>\n  </sensor>\n'
        ),
    }


def urdf(job: HandOver) -> Export:
    """An axis in URDF, SDF and USD, and its numbers as JSON.

    Raises :class:`~ballscrew.basis.errors.InputError` without a load, and where the model has no friction at it.
    """
    joint = joint_friction(job, 1)
    errors = joint_errors(job, joint)
    values = _urdf_values(job, joint, errors)
    files = {name: filled(name, **values) for name in ("axis.urdf", "axis.sdf", "axis.usda")}
    return joint_export(job, "urdf", joint, errors, files, balances=False, valid_range=joint_range(job))


URDF = Target(urdf, JOINT_OPTIONS, options_of_case)


def _urdf_values(job: HandOver, joint: JointFriction, errors: JointErrors) -> dict[str, str | float]:
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
