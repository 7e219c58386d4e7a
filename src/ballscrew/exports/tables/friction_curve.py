"""The friction over speed at one load, with a few nodes: what controls and drives take as a feed-forward."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Force, Info, Quantity, unit_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export
from ballscrew.exports.subject import POINTS, HandOver
from ballscrew.exports.tables.friction_table import INTERPOLATED, Floats, model_over, speed_candidates
from ballscrew.exports.tables.nodes import best_nodes, chord_errors
from ballscrew.exports.targets import Option
from ballscrew.exports.worst_error import WorstError, worst_errors

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

    def export(self, handed: HandOver, target: str, files: Mapping[str, bytes]) -> Export:
        """The export of a target that is a curve."""
        ends = self.valid_range
        found = Export.of(
            handed,
            target,
            files,
            valid_range=ends,
            worst_error=[self.worst_error],
            warnings=[_one_load(self), *_widened(handed, ends[OPERATION[1]])],
        )
        return dataclasses.replace(found, measured_range=ends)


def options_of_case(case: Case) -> dict[str, float]:
    """The choice that follows from a case: the load of its operating point."""
    return {"load": float(case.operation.axial_load)}


def friction_curve(handed: HandOver, count: int, slowest: float | None = None) -> FrictionCurve:
    """The curve of at most ``count`` nodes with the least worst error, as a share of the friction.

    The curve is that of the greater friction of both directions, which most nuts have alike; the error counts both. The
    first node is the ``slowest`` speed; below it the friction of it counts. Without one it is a ten-thousandth of the
    range. Raises :class:`~ballscrew.basis.errors.InputError` for a load beyond the range, and where there is no
    friction.
    """
    load, limits = float(handed.options["load"]), handed.working_range
    if not limits[OPERATION[0]][0] <= load <= limits[OPERATION[0]][1]:
        least, greatest = limits[OPERATION[0]]
        remedy = (
            f"give a load from {units.to_significant(least, 6)} N to {units.to_significant(greatest, 6)} N, or a "
            "larger range"
        )
        raise InputError(Fault("hand_over.load", "is beyond the range", f"{load:g} N", remedy))
    fixed = {one.name: one.value for one in handed.inputs if one.name != OPERATION[1]} | {OPERATION[0]: load}
    fastest = max(map(abs, limits[OPERATION[1]]))
    handed = _both_ways(handed, fastest)
    first = _SLOWEST * fastest if slowest is None else slowest
    if not 0 < first < fastest:
        problem = "must be positive and below the range of speeds"
        raise InputError(Fault("hand_over.slowest", problem, f"{first:g} rad/s", "give a smaller one"))
    speeds = speed_candidates(first, fastest)
    friction = model_over(handed, OPERATION[1:2], fixed)
    both = np.column_stack([friction(sign * speeds)[INTERPOLATED[0]] for sign in (1.0, -1.0)])
    torques = both.max(axis=1)
    if not np.all(torques > 0):
        problem = "there is no friction at this load and some speed"
        raise InputError(Fault("hand_over.load", problem, f"{load:g} N", "give the load that the axis carries"))
    nodes = best_nodes(chord_errors(speeds, torques, torques), count)
    curve = speeds[nodes], torques[nodes]
    points = _points(handed, fixed, first, fastest)

    def approximate(at: Mapping[str, Floats]) -> dict[str, Floats]:
        return {INTERPOLATED[0]: np.interp(np.abs(at[OPERATION[1]]), *curve)}

    (error,) = worst_errors(handed, approximate, points=points, outputs=INTERPOLATED[:1])
    loads = np.linspace(*limits[OPERATION[0]], 21)
    others = {**points, OPERATION[0]: np.resize(loads, len(points[OPERATION[1]]))}
    (elsewhere,) = worst_errors(handed, approximate, points=others, outputs=INTERPOLATED[:1])
    return FrictionCurve(*curve, fixed, error, elsewhere.value)


def _both_ways(handed: HandOver, fastest: float) -> HandOver:
    """The same model with all speeds that the curve is of: beyond its range the nearest speed would count."""
    if handed.working_range[OPERATION[1]] == (-fastest, fastest):
        return handed
    inputs = [
        dataclasses.replace(one, range=(-fastest, fastest)) if one.name == OPERATION[1] else one
        for one in handed.inputs
    ]
    return dataclasses.replace(handed, inputs=tuple(inputs))


def _widened(handed: HandOver, ends: tuple[float, float]) -> list[Record]:
    """A warning where the range that was asked for has not all speeds of the curve."""
    asked = handed.working_range[OPERATION[1]]
    if asked == ends:
        return []
    quantity = next(one.quantity for one in handed.inputs if one.name == OPERATION[1])
    least, greatest, slow, fast = (units.shown(end, quantity) for end in (*asked, *ends))
    message = f"the curve is of both directions from rest: {slow} to {fast}, not {least} to {greatest} only"
    return [Record(text=message, id="hand_over.both_directions", subject=OPERATION[1], severity="warning", holds=False)]


def _points(handed: HandOver, fixed: Mapping[str, float], first: float, fastest: float) -> dict[str, Floats]:
    """Speeds in both directions, spread by ratios from the slowest to the fastest."""
    count = POINTS if handed.is_recordable else POINTS // 10
    random = np.random.default_rng(21)
    speeds = np.geomspace(first, fastest, count) * random.choice([-1.0, 1.0], count)
    return {**{name: np.full(count, value) for name, value in fixed.items()}, OPERATION[1]: speeds}


def _one_load(curve: FrictionCurve) -> Record:
    load = curve.fixed[OPERATION[0]]
    difference = units.in_unit(curve.at_other_loads, "N m", 2)
    message = (
        f"the curve knows one load, {units.in_unit(load, 'N', 6)}, and one temperature; at another load of the "
        f"range the friction differs by up to {difference}"
    )
    return Record(
        text=message,
        id="hand_over.one_load",
        subject=INTERPOLATED[0],
        severity="warning",
        holds=False,
        value=curve.at_other_loads,
        unit="N m",
    )


def about(handed: HandOver, curve: FrictionCurve) -> Sequence[str]:
    """Lines for the head of a file: what it is of, its error, other loads, and rest."""
    fixed = ", ".join(f"{name} {value:.6g} {handed.units[name]}" for name, value in curve.fixed.items())
    found = handed.provenance
    return [
        f"Friction of a ball screw: model {found['model']}, {found['nut']}, made by ballscrew {found['version']}.",
        f"At {fixed}; up to {curve.speeds[-1]:.6g} rad/s of the screw either way, beyond which the last value holds.",
        f"Worst error against the model: {curve.worst_error.value:.3g} N m, "
        f"{100 * curve.worst_error.relative:.2g} % of the friction, at {curve.worst_error.points} speeds.",
        f"At another load of the range the friction differs by up to {curve.at_other_loads:.3g} N m.",
        *(f"Beware: {record.text}." for record in handed.starvation),
    ]
