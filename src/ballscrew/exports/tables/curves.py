"""The friction over speed at one load, with a few nodes: what controls and drives take as a feed-forward.

``--to beckhoff`` writes entries of a compensation list of TwinCAT CNC (TF5200) and ISG-kernel. The form is that of the
example of the manual (infosys.beckhoff.com, tf5200_friction_comp, "Parameterisation"): at most 20 entries of a speed in
µm/s, at least zero and ascending, and of a torque in the units of the drive. It was checked against that example, and
never read by a control. ``--to linuxcnc`` writes a HAL file for the component ``lincurve``, ``--to drive`` a few points
for the friction characteristic of a drive.
"""

from __future__ import annotations

import csv
import dataclasses
import io
import math
from collections.abc import Mapping, Sequence

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.quantities import Force, Info, Quantity, unit_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export, Option, Target, WorstError, made_of, refusal, warning, worst_errors
from ballscrew.exports.subject import POINTS, HandOver
from ballscrew.exports.tables.friction_table import (
    INTERPOLATED,
    Floats,
    best_nodes,
    chord_errors,
    model_over,
    speed_candidates,
)

_LOAD = Quantity("load", unit_of(Force) or "", Info("F", "axial load of the curve", "N"))
#: Choices of every target that is a curve.
OPTIONS: Mapping[str, Option] = {
    "load": Option(0.0, 'axial load at which the friction is taken, if not that of the case: "1 kN"', _LOAD),
}
#: Lowest speed of a curve as a share of its range: controls know no lower one.
_SLOWEST = 1e-4


@dataclasses.dataclass(frozen=True, eq=False)
class FrictionCurve:
    """Friction torque over the size of the speed, at one load, with straight lines between the nodes."""

    speeds: Floats
    torques: Floats
    #: The inputs that are fixed, the load among them.
    fixed: Mapping[str, float]
    worst_error: WorstError
    #: The most by which the friction differs from the curve at another load of the range.
    at_other_loads: float

    @property
    def valid_range(self) -> dict[str, tuple[float, float]]:
        """Speeds in both directions, and the value of each other input twice."""
        fastest = float(self.speeds[-1])
        ends = {name: (value, value) for name, value in self.fixed.items()}
        return {OPERATION[0]: ends[OPERATION[0]], OPERATION[1]: (-fastest, fastest), **ends}

    def export(self, job: HandOver, target: str, files: Mapping[str, str], warnings: Sequence[Record] = ()) -> Export:
        """The export of a target that is a curve."""
        ends = self.valid_range
        own = [_one_load(self), *_widened(job, ends[OPERATION[1]]), *warnings]
        return Export.of(job, target, files, [self.worst_error], valid_range=ends, measured_range=ends, warnings=own)


def options_of_case(case: Case) -> dict[str, float]:
    """The choice that follows from a case: the load of its operating point."""
    return {"load": float(case.operation.axial_load)}


def friction_curve(job: HandOver, count: int) -> FrictionCurve:
    """The curve of at most ``count`` nodes with the least worst error, as a share of the friction.

    The curve is that of the greater friction of both directions, which most nuts have alike; the error counts both.
    The first node is a ten-thousandth of the range; below it the friction of it counts. Raises
    :class:`~ballscrew.basis.errors.InputError` for a load beyond the range, and where there is no friction.
    """
    load, limits = float(job.options["load"]), job.working_range
    least, greatest = limits[OPERATION[0]]
    if not least <= load <= greatest:
        ends = f"from {units.to_significant(least, 6)} N to {units.to_significant(greatest, 6)} N"
        raise refusal("load", "is beyond the range", f"{load:g} N", f"give a load {ends}, or a larger range")
    fixed = {entry.name: entry.value for entry in job.inputs if entry.name != OPERATION[1]} | {OPERATION[0]: load}
    fastest = max(map(abs, limits[OPERATION[1]]))
    job = _both_ways(job, fastest)
    first = _SLOWEST * fastest
    speeds = speed_candidates(first, fastest)
    friction = model_over(job, OPERATION[1:2], fixed)
    both = np.column_stack([friction(sign * speeds)[INTERPOLATED[0]] for sign in (1.0, -1.0)])
    torques = both.max(axis=1)
    if not np.all(torques > 0):
        problem = "there is no friction at this load and some speed"
        raise refusal("load", problem, f"{load:g} N", "give the load that the axis carries")
    nodes = best_nodes(chord_errors(speeds, torques, torques), count)
    curve = speeds[nodes], torques[nodes]
    points = _points(job, fixed, first, fastest)

    def approximate(at: Mapping[str, Floats]) -> dict[str, Floats]:
        return {INTERPOLATED[0]: np.interp(np.abs(at[OPERATION[1]]), *curve)}

    (error,) = worst_errors(job, approximate, points=points, outputs=INTERPOLATED[:1])
    loads = np.linspace(*limits[OPERATION[0]], 21)
    others = {**points, OPERATION[0]: np.resize(loads, len(points[OPERATION[1]]))}
    (elsewhere,) = worst_errors(job, approximate, points=others, outputs=INTERPOLATED[:1])
    return FrictionCurve(*curve, fixed, error, elsewhere.value)


def _both_ways(job: HandOver, fastest: float) -> HandOver:
    """The same model with all speeds that the curve is of: beyond its range the nearest speed would count."""
    if job.working_range[OPERATION[1]] == (-fastest, fastest):
        return job
    inputs = [
        dataclasses.replace(entry, range=(-fastest, fastest)) if entry.name == OPERATION[1] else entry
        for entry in job.inputs
    ]
    return dataclasses.replace(job, inputs=tuple(inputs))


def _widened(job: HandOver, ends: tuple[float, float]) -> list[Record]:
    """A warning where the range that was asked for has not all speeds of the curve."""
    asked = job.working_range[OPERATION[1]]
    if asked == ends:
        return []
    quantity = next(entry.quantity for entry in job.inputs if entry.name == OPERATION[1])
    least, greatest, slow, fast = (units.shown(end, quantity) for end in (*asked, *ends))
    text = f"the curve is of both directions from rest: {slow} to {fast}, not {least} to {greatest} only"
    return [warning("both_directions", OPERATION[1], text)]


def _points(job: HandOver, fixed: Mapping[str, float], first: float, fastest: float) -> dict[str, Floats]:
    """Speeds in both directions, spread by ratios from the slowest to the fastest."""
    count = POINTS if job.is_recordable else POINTS // 10
    random = np.random.default_rng(21)
    speeds = np.geomspace(first, fastest, count) * random.choice([-1.0, 1.0], count)
    return {**{name: np.full(count, value) for name, value in fixed.items()}, OPERATION[1]: speeds}


def _one_load(curve: FrictionCurve) -> Record:
    load = curve.fixed[OPERATION[0]]
    difference = units.in_unit(curve.at_other_loads, "N m", 2)
    text = (
        f"the curve knows one load, {units.in_unit(load, 'N', 6)}, and one temperature; at another load of the "
        f"range the friction differs by up to {difference}"
    )
    return warning("one_load", INTERPOLATED[0], text, value=curve.at_other_loads, unit="N m")


def about(job: HandOver, curve: FrictionCurve) -> Sequence[str]:
    """Lines for the head of a file: what it is of, its error, other loads, and rest."""
    fixed = ", ".join(f"{name} {value:.6g} {job.units[name]}" for name, value in curve.fixed.items())
    return [
        made_of(job)[0],
        f"At {fixed}; up to {curve.speeds[-1]:.6g} rad/s of the screw either way, beyond which the last value holds.",
        f"Worst error against the model: {curve.worst_error.value:.3g} N m, "
        f"{100 * curve.worst_error.relative:.2g} % of the friction, at {curve.worst_error.points} speeds.",
        f"At another load of the range the friction differs by up to {curve.at_other_loads:.3g} N m.",
        *(f"Beware: {record.text}." for record in job.starvation),
    ]


#: Entries of the list of Beckhoff at most, if the control is not told otherwise (P-COMP-00042, P-COMP-00062).
ENTRIES = 20
#: All of the compensation, in 0.1 % (P-COMP-00045).
_WHOLE = 1000
_WIDTH = 40


def beckhoff(job: HandOver) -> Export:
    """The entries of the list, and its text beside it: the manual has no comments in lists."""
    scale = float(job.options["units_per_newton_metre"])
    curve = friction_curve(job, ENTRIES - 1)  # rest takes one entry
    notes = [
        *about(job, curve),
        f"in: µm/s of the axis; out: units of the drive, {scale:g} for one N m at the screw shaft; at rest none.",
        "Format checked against the example of the manual, not on a control. Switch it on with lr_param.frict_comp 1.",
        "",
    ]
    files = {"friction_comp.lis": _list(job, curve, scale), "README.txt": "\n".join(notes)}
    share = 0.5 / scale / float(curve.torques.min())
    percent = units.to_significant(100 * share, 2)
    text = f"torques are whole numbers of the drive: rounding adds up to {percent} % of the friction"
    severity = "warning" if share > 0.01 else "info"
    numbers = {"severity": severity, "holds": share <= 0.01, "value": share, "limit": 0.01}
    rounding = warning("rounding", INTERPOLATED[0], text, **numbers)
    return curve.export(job, "beckhoff", files, [] if share <= 1e-3 else [rounding])


def _list(job: HandOver, curve: FrictionCurve, scale: float) -> str:
    per_speed = 1e6 * float(job.subject.screw.lead) / (2 * math.pi)
    speeds = np.unique(np.round(curve.speeds * per_speed)).astype(int)
    speeds = speeds[speeds > 0]
    torques = np.interp(speeds / per_speed, curve.speeds, curve.torques)
    pairs = [(0, 0), *zip(speeds.tolist(), np.round(torques * scale).astype(int).tolist(), strict=True)]
    entries: dict[str, int] = {
        "mode": 3,
        "table_entries": len(pairs),
        "position_delay": 0,
        "reversal_lookahead": 0,
        "scaling_factor": _WHOLE,
        "delay_cycles": 0,
    }
    for k, (speed, torque) in enumerate(pairs):
        entries |= {f"table[{k}].in": speed, f"table[{k}].out": torque}
    return "\n".join([*(f"{'frict_comp.' + name:<{_WIDTH}}{value}" for name, value in entries.items()), ""])


#: Points of a lincurve (its manual page), half of them for each direction.
LINCURVE_POINTS = 16
#: Metres of the units of length that a machine may have.
_LENGTHS: Mapping[str, float] = {"mm": 1e-3, "inch": 25.4e-3}
_NAME = "ballscrew-friction"


def linuxcnc(job: HandOver) -> Export:
    """The HAL file."""
    length, unit = str(job.options["length"]), float(job.options["torque_unit"])
    if length not in _LENGTHS:
        raise refusal("length", "must be mm or inch", length, "give that of the machine")
    curve = friction_curve(job, LINCURVE_POINTS // 2)
    return curve.export(job, "linuxcnc", {"ballscrew.hal": _hal(job, curve, length, unit)})


def _hal(job: HandOver, curve: FrictionCurve, length: str, unit: float) -> str:
    per_speed = float(job.subject.screw.lead) / (2 * math.pi) / _LENGTHS[length]
    x = np.concatenate([-curve.speeds[::-1], curve.speeds]) * per_speed
    y = np.concatenate([-curve.torques[::-1], curve.torques]) / unit
    points = [
        f"setp {_NAME}.{axis}-val-{k:02d} {value!r}"
        for k, pair in enumerate(zip(x.tolist(), y.tolist(), strict=True))
        for axis, value in zip("xy", pair, strict=True)
    ]
    slowest, joint = float(curve.speeds[0]) * per_speed, job.options["joint"]
    return "\n".join(
        [
            *(f"# {line}" for line in about(job, curve)),
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


_README = """\
friction_curve.csv has the size of the friction over the size of the speed, at the motor shaft, for a drive that takes
such a characteristic: type the points in. The drive gives them their sign, and at rest nothing. Festo's drives CMMT-ST
take 16 points in rad/s and N m (parameters 976 to 978 of their manual). Others were not checked.
"""


def drive(job: HandOver) -> Export:
    """The points as CSV, and a text."""
    points, ratio = int(job.options["points"]), float(job.options["ratio"])
    if points < 2:
        raise refusal("points", "must be two at least", str(points), "give the number of the drive")
    curve = friction_curve(job, points)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["speed [rad/s]", "speed [rpm]", "torque [N m]"])
    for speed, torque in zip((curve.speeds * ratio).tolist(), (curve.torques / ratio).tolist(), strict=True):
        writer.writerow([f"{speed:.9g}", f"{speed * 30 / math.pi:.9g}", f"{torque:.9g}"])
    readme = "\n".join([_README, *about(job, curve), ""])
    return curve.export(job, "drive", {"friction_curve.csv": stream.getvalue(), "README.txt": readme})


_UNITS = "units of the drive for one N m at the screw: 1000 for mN m"
_RATIO = "turns of the motor for one of the screw; the friction is that at the motor"
_TORQUE_UNIT = "N m of one unit of the output: 1 for N m, 0.001 for mN m"
BECKHOFF = Target(
    beckhoff,
    {
        **OPTIONS,
        "units_per_newton_metre": Option(1000.0, _UNITS, positive="give the units of the drive for one N m"),
    },
    options_of_case,
)
LINUXCNC = Target(
    linuxcnc,
    {
        **OPTIONS,
        "length": Option("mm", "unit of length of the machine: mm or inch"),
        "torque_unit": Option(1.0, _TORQUE_UNIT, positive="give 1 for N m"),
        "joint": Option(0, "number of the joint, in the lines of connection"),
    },
    options_of_case,
)
DRIVE = Target(
    drive,
    {
        **OPTIONS,
        "points": Option(10, "number of points that the drive takes: 10, or 16"),
        "ratio": Option(1.0, _RATIO, positive="give 1 for a motor on the screw"),
    },
    options_of_case,
)
