"""``--to drive``: the friction over speed as a few points for the friction characteristic of a drive."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping

from ballscrew.basis.errors import Fault, InputError
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables.friction_curve import OPTIONS as OF_CURVES
from ballscrew.exports.tables.friction_curve import about, friction_curve, options_of_case
from ballscrew.exports.targets import Option

__all__ = ["OPTIONS", "export", "options_of_case"]

OPTIONS: Mapping[str, Option] = {
    **OF_CURVES,
    "points": Option(10, "number of points that the drive takes: 10, or 16"),
    "ratio": Option(1.0, "turns of the motor for one of the screw; the friction is that at the motor"),
}
_README = """\
friction_curve.csv has the size of the friction over the size of the speed, at the motor shaft, for a drive that takes
such a characteristic: type the points in. The drive gives them their sign, and at rest nothing. Festo's drives CMMT-ST
take 16 points in rad/s and N m (parameters 976 to 978 of their manual). Others were not checked.
"""


def export(handed: HandOver) -> Export:
    """The points as CSV, and a text."""
    points, ratio = int(handed.options["points"]), float(handed.options["ratio"])
    if points < 2:
        raise InputError(Fault("hand_over.points", "must be two at least", str(points), "give the number of the drive"))
    if not ratio > 0:
        raise InputError(Fault("hand_over.ratio", "must be positive", f"{ratio:g}", "give 1 for a motor on the screw"))
    curve = friction_curve(handed, points)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["speed [rad/s]", "speed [rpm]", "torque [N m]"])
    for speed, torque in zip((curve.speeds * ratio).tolist(), (curve.torques / ratio).tolist(), strict=True):
        writer.writerow([f"{speed:.9g}", f"{speed * 30 / math.pi:.9g}", f"{torque:.9g}"])
    readme = "\n".join([_README, *about(handed, curve), ""])
    return curve.export(
        handed, "drive", {"friction_curve.csv": stream.getvalue().encode(), "README.txt": readme.encode()}
    )
