"""``--to mujoco``: joint parameters that know no load, an engine plugin that knows it, and an axis to try both."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from collections.abc import Mapping

from ballscrew.basis.errors import Fault, InputError
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export
from ballscrew.exports.programs import c99
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
from ballscrew.exports.programs.two_levels import two_levels
from ballscrew.exports.readme import readme
from ballscrew.exports.subject import HandOver
from ballscrew.exports.targets import Option

__all__ = ["OPTIONS", "export", "options_of_case"]

OPTIONS: Mapping[str, Option] = {
    **JOINT_OPTIONS,
    "polynomial": Option(True, "damping with powers of the speed (MuJoCo 3.7 or newer); no: linear, for any version"),
    "plugin": Option("ballscrew.friction", "name of the plugin: give each screw of a simulation its own"),
}
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


def export(handed: HandOver) -> Export:
    """Sources of the plugin with their Makefile, two axes in MJCF, their numbers as JSON, and a script that runs them.

    Raises :class:`~ballscrew.basis.errors.InputError` without a load, where the model has no friction at it, and for a
    plugin name that MuJoCo would not find.
    """
    name = handed.options["plugin"]
    if not re.fullmatch(r"\w+(\.\w+)*", name):
        raise InputError(Fault("hand_over.plugin", "must be words with dots between", name, "such as machine.z_axis"))
    if handed.has_elastic_bodies:
        two_levels(handed)  # what has no source is refused before its friction is computed
    joint = joint_friction(handed, 3 if handed.options["polynomial"] else 1)
    errors = joint_errors(handed, joint)
    document = {"made_by": provenance_line(handed), **joint.document(), **errors.document()}
    files = {
        "ballscrew.c": c99.source(handed),
        "ballscrew.h": c99.header(handed),
        "ballscrew_plugin.c": filled("mujoco_plugin.c", _plugin_values(handed, joint)),
        "Makefile": filled("mujoco_makefile", {}),
        "axis_parameters.xml": filled("mujoco_axis.xml", _parameter_axis(handed, joint, errors)),
        "axis_plugin.xml": filled("mujoco_axis.xml", _plugin_axis(handed, joint)),
        "axis.json": json.dumps(document, indent=2) + "\n",
        "run.py": filled("mujoco_run.txt", {}),
    }
    files["README.txt"] = readme(handed, "MuJoCo plugin and joint parameters", _notes(joint, errors))
    made = Export.of(
        handed,
        "mujoco",
        {path: text.encode() for path, text in files.items()},
        valid_range=handed.formula_range,
        worst_error=errors.of_export,
        warnings=[*errors.warnings(joint), *joint.warnings(balances=_is_balanced(joint))],
    )
    return dataclasses.replace(made, measured_range=joint_range(handed))


def _notes(joint: JointFriction, errors: JointErrors) -> str:
    low, high = joint.speeds
    return _NOTES.format(errors=errors.text, axis=_said(joint), arm=joint.arm, low=low, high=high)


def _said(joint: JointFriction) -> str:
    """What moves, in words, with what is assumed of it."""
    angle = math.degrees(joint.inclination)
    balance = f", balanced by {joint.counterforce:.4g} N" if joint.counterforce else ""
    moves = f"The axis moves {joint.mass:.4g} kg at {angle:.4g} deg above the horizontal{balance}."
    return " ".join([moves, *(f"Beware: {one.text}." for one in joint.warnings(balances=_is_balanced(joint)))])


def _plugin_values(handed: HandOver, joint: JointFriction) -> dict[str, str]:
    return {
        "PROVENANCE": provenance_line(handed),
        "LEAD": repr(joint.lead),
        "ARM": repr(joint.arm),
        "INERTIA": repr(joint.inertia),
        "PLUGIN": handed.options["plugin"],
    }


def _axis(handed: HandOver, joint: JointFriction) -> dict[str, str]:
    share = joint.counterforce / joint.weight if _is_balanced(joint) else 0.0
    return {
        "PROVENANCE": provenance_line(handed),
        "MASS": repr(joint.mass),
        "DIRECTION": joint.direction_text,
        "BALANCE": f' gravcomp="{share!r}"' if share else "",
    }


def _is_balanced(joint: JointFriction) -> bool:
    """Whether the force that balances the weight can be a share of it, as it is in MJCF."""
    return joint.weight != 0


def _parameter_axis(handed: HandOver, joint: JointFriction, errors: JointErrors) -> dict[str, str]:
    damping = " ".join(map(repr, joint.damping))
    low, high = joint.speeds
    return {
        **_axis(handed, joint),
        "MODEL": "ballscrew_parameters",
        "NOTE": (
            f"{errors.text}.\n  Fitted from {low:g} to {high:g} rad/s of the shaft. At rest it creeps a little.\n"
            f"  {_said(joint)}"
        ),
        "EXTENSION": "",
        "JOINT": (
            f'armature="{joint.armature!r}" frictionloss="{joint.dry!r}" damping="{damping}"\n             '
            f'solimpfriction="{HARD}"'
        ),
        "ACTUATOR": f'<motor name="screw" joint="axis" gear="{joint.arm!r}"/>',
        "SENSOR": "",
    }


def _plugin_axis(handed: HandOver, joint: JointFriction) -> dict[str, str]:
    name = handed.options["plugin"]
    known = [one for one in handed.inputs if one.name not in OPERATION]
    settings = {"inertia": joint.inertia, **{one.name: one.value for one in known}}
    keys = "".join(f'        <config key="{key}" value="{value!r}"/>\n' for key, value in settings.items())
    return {
        **_axis(handed, joint),
        "MODEL": "ballscrew_plugin",
        "NOTE": (
            "Build the plugin with make and load it first: mujoco.mj_loadPluginLibrary. Values in SI.\n"
            f"  {_said(joint)}"
        ),
        "EXTENSION": (
            f'  <extension>\n    <plugin plugin="{name}">\n      <instance name="screw">\n{keys}      </instance>\n'
            "    </plugin>\n  </extension>\n"
        ),
        "JOINT": f'armature="{joint.armature!r}"',
        "ACTUATOR": f'<plugin name="screw" instance="screw" joint="axis" gear="{joint.arm!r}"/>',
        "SENSOR": (
            "  <sensor>\n    <!-- axial load, friction, accelerating torque, 1 where the model holds -->\n"
            '    <plugin name="screw" instance="screw"/>\n  </sensor>\n'
        ),
    }
