"""Parts of the answer of a duty: phases, smoothing, life, motor, rules, short strokes, and the states over time."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import (
    Acceleration,
    AngularSpeed,
    Duration,
    Energy,
    Force,
    Info,
    Length,
    Power,
    Quantity,
    Ratio,
    Speed,
    Torque,
    Unit,
    unit_of,
)
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.moving_balls.reversal import loops, reversal
from ballscrew.questions.shared.declared import FINITE

TORQUE_PEAK = Info(r"\tau_{max}", "largest torque of the motor")
TORQUE_RMS = Info(r"\tau_{rms}", "RMS torque of the motor, rests included")


class PhaseNumbers(NamedTuple):
    """Numbers of one phase of a motion."""

    #: Its name in the motion.
    name: str
    #: Time from the start of the cycle to its own.
    start: Duration
    #: Time that it takes.
    duration: Duration
    #: Largest size of the axial load.
    largest_load: Force
    #: Largest torque of the motor, with its sign.
    torque_peak: Torque
    #: RMS torque of the motor.
    torque_rms: Torque
    #: Energy that the motor gives, less what it takes back.
    energy: Energy


@dataclasses.dataclass(frozen=True)
class Smoothing:
    """Smoothing of a recorded motion, and its effect on the RMS torque."""

    #: Recorded samples.
    samples: int
    #: Samples on either side that the smoothing reaches.
    half_width: int
    #: Standard deviation of one recorded sample.
    noise: float
    #: What is left of it in the acceleration.
    acceleration_noise: Acceleration
    #: RMS torque with the narrowest smoothing, N m.
    torque_rms_unsmoothed: Torque


@dataclasses.dataclass(frozen=True)
class PositionSmoothing(Smoothing):
    """Smoothing of recorded positions, and its effect on the RMS torque."""

    noise: Length


@dataclasses.dataclass(frozen=True)
class SpeedSmoothing(Smoothing):
    """Smoothing of recorded speeds, and its effect on the RMS torque."""

    noise: Speed


class Life(NamedTuple):
    """Life of the screw by ISO 3408-5 over the cycle."""

    #: Dynamic load rating of one nut body or half.
    dynamic_load_rating: Force | None
    #: Where the rating comes from.
    rating_source: str
    #: Axial preload; zero of a nut without.
    preload: Force
    #: Factor on the loads for shocks.
    load_factor: Ratio
    mean_loads: Annotated[Mapping[str, float], Unit("N"), Info("F_m", "mean load of each flank or half")]
    lives: Annotated[Mapping[str, float], Unit("1"), Info("L", "turns of each flank or half")]
    #: Basic rating life L10 by both flanks or halves, revolutions.
    revolutions: Ratio
    #: Turns by the larger mean load alone.
    revolutions_of_the_worse: Ratio


class FlankChange(NamedTuple):
    """A place of the cycle at which the load changes its sign, and the balls the flank."""

    #: Time from the start of the cycle.
    time: Duration
    #: Position of the axis.
    position: Length
    #: The phase of the motion that it is in.
    phase: str
    lost_motion: Annotated[Length, Info("S_a", "travel lost in the play of the nut", "um")]


class WorstState(NamedTuple):
    """The state whose torque comes nearest to the peak torque of the motor at its speed."""

    #: The phase of the motion that it is in.
    phase: str
    #: Torque of the motor.
    torque: Torque
    #: The condition of the track that counts there; None where nothing is starved of oil.
    condition: str | None
    #: Speed of the motor.
    speed: AngularSpeed


class MotorCurve(NamedTuple):
    """Torque that a motor gives, at the corners of its curve."""

    #: Speed of the motor.
    speed: Annotated[Sequence[AngularSpeed], FINITE]
    #: Torque that it gives for a short time.
    peak_torque: Annotated[Sequence[Torque], FINITE]
    #: Torque that it gives for ever.
    rated_torque: Annotated[Torque, FINITE]


class MotorUse(NamedTuple):
    """The cycle against the motor."""

    #: True where no check of the motor fails.
    suffices: bool
    utilisation: Annotated[float, Info("", "torque over the peak torque at its speed, at its largest")]
    #: The state in which it is largest.
    worst: WorstState
    #: Heat of the current in a cycle; null without constant or resistance of the motor.
    copper_loss: Energy | None
    #: The same in a full bath of oil.
    flooded_copper_loss: Energy | None
    #: Curve of the motor.
    curve: MotorCurve


class Mechanics(NamedTuple):
    """Torque of the motor by mechanics."""

    torque_rms: Annotated[Torque, TORQUE_RMS]
    torque_peak: Annotated[Torque, TORQUE_PEAK]


class Catalogue(NamedTuple):
    """Torque of the motor by the rule of catalogues."""

    #: Efficiency of the screw that the rule takes.
    efficiency: Ratio
    torque_rms: Annotated[Torque, TORQUE_RMS]
    torque_peak: Annotated[Torque, TORQUE_PEAK]


class Rules(NamedTuple):
    """Torque of the motor by both rules."""

    #: By mechanics, with the friction of the model.
    mechanics: Mechanics
    #: By the rule of catalogues, with one efficiency.
    catalogue: Catalogue


class Cycle(NamedTuple):
    """The states of a cycle over time, and the torque of the motor by cause."""

    #: 1 where each state of the motion is here, or each second, third … one.
    every: int
    #: Time since the start of the cycle.
    time: Annotated[Sequence[Duration], FINITE]
    #: Position.
    position: Annotated[Sequence[Length], FINITE]
    #: Speed.
    speed: Annotated[Sequence[Speed], FINITE]
    #: Acceleration.
    acceleration: Annotated[Sequence[Acceleration], FINITE]
    #: Load of the nut.
    axial_load: Sequence[Force]
    #: Speed of the motor.
    motor_speed: Sequence[AngularSpeed]
    #: Torque of the motor by mechanics.
    torque: Sequence[Torque]
    #: Power of the motor.
    power: Sequence[Power]
    #: Torque of the motor in a full bath of oil; null where nothing is starved of oil.
    flooded_torque: Sequence[Torque] | None
    #: Torque of the motor by cause.
    torque_by: Mapping[str, Sequence[Torque]]


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
