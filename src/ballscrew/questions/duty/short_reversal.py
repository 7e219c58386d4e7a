"""Strokes that end before friction has come back after a reversal: what of the friction work they lose."""

from __future__ import annotations

import dataclasses
import math
from typing import Annotated, NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Quantity, Ratio, unit_of
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.moving_balls.reversal import loops, reversal

#: Share of the swing of the friction torque at which it counts as back.
BACK = 0.9
#: Turns of a stroke beyond which no reversal is computed: friction is back within some tens of degrees.
_LONG = 1.0
TRAVEL = Quantity("stroke", unit_of(Length) or "", Info("s", "shortest stroke between two reversals", "um"))


@dataclasses.dataclass(frozen=True)
class ShortReversal:
    """The shortest stroke of a motion, which ends before friction has come back."""

    stroke: Annotated[Length, Info("s", "shortest stroke between two reversals", "um")]
    back: Annotated[Length, Info("s_b", "travel after a reversal in which friction comes back", "um")]
    work_share: Annotated[Ratio, Info("", "friction work of the stroke to and fro over that of steady friction")]


class Stroke(NamedTuple):
    """A way in one direction, with the mean of its load and of its speed over the time in motion."""

    length: Length
    axial_load: Force
    screw_speed: AngularSpeed


def short_reversal(case: Case, duty: Duty) -> ShortReversal | None:
    """The shortest stroke of a cycle, if less than 90 % of the friction of the screw come back within it; else None.

    The friction of the reversal, and the work of the stroke, are those at its mean load and speed. None as well for a
    motion that never turns round, and for friction that knows no such curve.
    """
    lead = float(case.screw.lead)
    result = strokes(duty, lead)
    if case.efficiency is not None or not result:
        return None
    shortest = min(result)
    if shortest.length > _LONG * lead:
        return None
    parts = (case.model, case.screw, case.lubricant)
    operation = {"axial_load": shortest.axial_load, "screw_speed": shortest.screw_speed}
    try:
        after = reversal(*parts, **operation)
    except InputError:  # a model without slip across the path, or nothing that winds up
        return None
    back = after.angle_at(BACK) * lead / (2 * math.pi)
    if not shortest.length < back:
        return None
    (loop,) = loops(*parts, after, [2 * math.pi * shortest.length / lead], **operation)
    return ShortReversal(shortest.length, back, loop.work_share)


def strokes(duty: Duty, lead: Length) -> list[Stroke]:
    """The ways between reversals of a cycle that repeats, rests left out; none where it never turns round."""
    speed, weight = np.asarray(duty.screw_speed), np.asarray(duty.states.weight)
    moving = np.flatnonzero((speed != 0) & (weight > 0))
    direction = np.sign(speed[moving])
    turns = np.flatnonzero(np.diff(direction)) + 1
    if not turns.size:
        return []
    runs = np.split(moving, turns)
    if direction[0] == direction[-1]:  # the last way goes on in the next cycle
        runs = [np.concatenate([runs[-1], runs[0]]), *runs[1:-1]]
    result: list[Stroke] = []
    for run in runs:
        time = float(weight[run].sum())
        turned, load = float(weight[run] @ speed[run]), float(weight[run] @ np.asarray(duty.axial_load)[run])
        result.append(Stroke(abs(turned) * lead / (2 * math.pi), load / time, turned / time))
    return result
