"""``--to linuxcnc``: the friction over speed as a HAL file for the component ``lincurve``."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ballscrew.basis.errors import Fault, InputError
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables.friction_curve import OPTIONS as OF_CURVES
from ballscrew.exports.tables.friction_curve import FrictionCurve, about, friction_curve, options_of_case
from ballscrew.exports.targets import Option

__all__ = ["OPTIONS", "export", "options_of_case"]

#: Points of a lincurve (its manual page), half of them for each direction.
POINTS = 16
#: Metres of the units of length that a machine may have.
_LENGTHS: Mapping[str, float] = {"mm": 1e-3, "inch": 25.4e-3}
OPTIONS: Mapping[str, Option] = {
    **OF_CURVES,
    "length": Option("mm", "unit of length of the machine: mm or inch"),
    "torque_unit": Option(1.0, "N m of one unit of the output: 1 for N m, 0.001 for mN m"),
    "joint": Option(0, "number of the joint, in the lines of connection"),
}
_NAME = "ballscrew-friction"


def export(handed: HandOver) -> Export:
    """The HAL file."""
    length, unit = str(handed.options["length"]), float(handed.options["torque_unit"])
    if length not in _LENGTHS:
        raise InputError(Fault("hand_over.length", "must be mm or inch", length, "give that of the machine"))
    if not unit > 0:
        raise InputError(Fault("hand_over.torque_unit", "must be positive", f"{unit:g}", "give 1 for N m"))
    curve = friction_curve(handed, POINTS // 2)
    return curve.export(handed, "linuxcnc", {"ballscrew.hal": _text(handed, curve, length, unit).encode()})


def _text(handed: HandOver, curve: FrictionCurve, length: str, unit: float) -> str:
    per_speed = float(handed.subject.screw.lead) / (2 * math.pi) / _LENGTHS[length]
    x = np.concatenate([-curve.speeds[::-1], curve.speeds]) * per_speed
    y = np.concatenate([-curve.torques[::-1], curve.torques]) / unit
    points = [
        f"setp {_NAME}.{axis}-val-{k:02d} {value!r}"
        for k, pair in enumerate(zip(x.tolist(), y.tolist(), strict=True))
        for axis, value in zip("xy", pair, strict=True)
    ]
    slowest, joint = float(curve.speeds[0]) * per_speed, handed.options["joint"]
    return "\n".join(
        [
            *(f"# {line}" for line in about(handed, curve)),
            f"# In: speed of the axis, {length}/s. Out: torque on the shaft, unit {unit:g} N m, with its sign.",
            f"# Between {-slowest:.3g} and {slowest:.3g} {length}/s it is a line through zero: "
            "at rest it is 0, and holds nothing.",
            "# It is a feed-forward of the speed that is commanded, never of the one that is measured.",
            f"loadrt lincurve names={_NAME} personality={len(x)}",
            f"addf {_NAME} servo-thread",
            *points,
            "# Connect it where the drive takes a torque:",
            f"# net joint-{joint}-speed joint.{joint}.vel-cmd => {_NAME}.in",
            f"# net joint-{joint}-friction {_NAME}.out => pid.{joint}.bias",
            "",
        ]
    )
