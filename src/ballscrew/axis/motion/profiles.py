"""Motions that repeat: a stroke forth and back, a sine, and segments one after the other."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple, Protocol

import numpy as np

from ballscrew.axis.motion.states import MotionStates, Numbers, Phase, PolynomialPhase, states_of
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import MISSING, Fault, faults_of, raise_if_any, shown
from ballscrew.basis.quantities import Acceleration, Duration, Force, Frequency, Info, Jerk, Length, Speed, Temperature


class Timing(NamedTuple):
    """Durations of the phases of a move from rest to rest; the deceleration mirrors the acceleration."""

    #: Time in which the acceleration grows, and in which it falls again; zero without a limit of jerk.
    ramp: Duration
    #: Time at the full acceleration.
    full: Duration
    #: Time at the full speed.
    cruise: Duration
    acceleration: Acceleration

    @property
    def total(self) -> Duration:
        """Duration of the move."""
        return 2 * (2 * self.ramp + self.full) + self.cruise


def timing(distance: Length, speed: Speed, acceleration: Acceleration, jerk: Jerk = math.inf) -> Timing:
    r"""Fastest move from rest to rest over a distance, within speed, acceleration and jerk.

    .. math:: T = 2 T_a + \frac{D - v T_a}{v}, \quad T_a = \frac{v}{a} + \frac{a}{j} \text{ if } v j \ge a^2,
       \text{ else } 2 \sqrt{v/j}

    where :math:`D \ge v T_a`. Shorter moves do not reach the speed,
    :math:`T = a/j + \sqrt{(a/j)^2 + 4 D/a}` where :math:`D \ge 2 a^3/j^2`, and the shortest not even the acceleration,
    :math:`T = 4 (D/2j)^{1/3}`. Any positive values; without a limit of jerk a trapezoid of speed, or a triangle.
    """
    D, v, a, j = float(distance), float(speed), float(acceleration), float(jerk)
    ramp = min(a / j, math.sqrt(v / j))
    full = max(v / a - ramp, 0.0)
    to_speed = 2 * ramp + full
    if v * to_speed <= D:
        return Timing(ramp, full, D / v - to_speed, a if full else j * ramp)
    if D * j**2 >= 2 * a**3 or math.isinf(j):
        whole = a / j + math.sqrt((a / j) ** 2 + 4 * D / a)
        return Timing(a / j, max(whole / 2 - 2 * a / j, 0.0), 0.0, a)
    ramp = (D / (2 * j)) ** (1 / 3)
    return Timing(ramp, 0.0, 0.0, j * ramp)


def move(
    start: Length,
    distance: Length,
    speed: Speed,
    acceleration: Acceleration,
    jerk: Jerk = math.inf,
    *,
    force: Force = 0.0,
    temperature: Temperature | None = None,
    name: str = "",
) -> Sequence[PolynomialPhase]:
    """The phases of a move from rest to rest; a negative ``distance`` is a move backwards."""
    result = timing(abs(distance), speed, acceleration, jerk)
    sign = math.copysign(1.0, distance)
    peak = sign * result.acceleration
    j = 0.0 if math.isinf(jerk) or not result.ramp else peak / result.ramp
    speeds_up, cruises, slows_down = (
        f"{name}: {what}" if name else what for what in ("accelerates", "cruises", "slows down")
    )
    plan = (
        (speeds_up, result.ramp, 0.0, j),
        (speeds_up, result.full, peak, 0.0),
        (speeds_up, result.ramp, peak, -j),
        (cruises, result.cruise, 0.0, 0.0),
        (slows_down, result.ramp, 0.0, -j),
        (slows_down, result.full, -peak, 0.0),
        (slows_down, result.ramp, -peak, j),
    )
    phases: list[PolynomialPhase] = []
    x, v = float(start), 0.0
    for what, duration, a, jerk_now in plan:
        if duration > 0:
            phase = PolynomialPhase(what, duration, x, v, a, jerk_now, force, temperature)
            phases.append(phase)
            x, v, _ = phase.end
    return phases


def rest(position: Length, duration: Duration, *, force: Force = 0.0, name: str = "rests") -> PolynomialPhase:
    """A phase of rest."""
    return PolynomialPhase(name, duration, position, force=force)


_SPEED = Info("v", "largest speed", "m/min", above=0, hint="rapid feeds have 10 m/min to 120 m/min", usual=(1e-5, 10.0))
_ACCELERATION = Info("a", "largest acceleration", "m/s^2", above=0, hint="1 m/s^2 to 20 m/s^2", usual=(1e-4, 200.0))
_JERK = Info("j", "largest jerk", "m/s^3", above=0, hint="10 m/s^3 to 1000 m/s^3", usual=(1e-3, 1e6))
_STROKE = Info("s", "way from one end to the other", "mm", above=0, hint="lengths are positive", usual=(1e-5, 20.0))
_DWELL = Info("t_d", "rest after each move", "s", at_least=0, hint="0 s for none", usual=(0.0, 1e6))
_FORCE = Info(
    "F_x",
    "force of the process on the way forth, positive against it",
    "N",
    hint="cutting, pressing",
    usual=(-1e7, 1e7),
)
_BACK = Info(
    "F_{xb}",
    "force of the process on the way back, positive towards the start",
    "N",
    hint="as force",
    usual=(-1e7, 1e7),
)


class Motion(Protocol):
    """A motion: its states over one cycle."""

    def states(self) -> MotionStates:
        """States of one cycle."""
        ...


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class _Stroke(ByValue):
    """A stroke from rest to rest, and back."""

    stroke: Annotated[Length, _STROKE]
    speed: Annotated[Speed, _SPEED]
    acceleration: Annotated[Acceleration, _ACCELERATION]
    dwell: Annotated[Duration, _DWELL] = 0.0
    force: Annotated[Force, _FORCE] = 0.0
    return_force: Annotated[Force, _BACK] = 0.0
    #: Whether the cycle has the way back; after it there is a rest as after the way forth.
    returns: bool = True

    def __post_init__(self) -> None:
        raise_if_any(faults_of("motion", self))

    @property
    def limit_of_jerk(self) -> Jerk:
        """The largest jerk, m/s^3; infinite where there is no limit."""
        return math.inf

    def phases(self) -> Sequence[Phase]:
        """The phases of one cycle, each a :class:`~ballscrew.axis.motion.states.Phase`."""
        phases: list[Phase] = []
        forth = (0.0, self.stroke, self.force, "forth")
        back = (self.stroke, -self.stroke, self.return_force, "back")
        for start, distance, force, name in (forth, back)[: 2 if self.returns else 1]:
            phases += move(start, distance, self.speed, self.acceleration, self.limit_of_jerk, force=force, name=name)
            if self.dwell:
                phases.append(rest(start + distance, self.dwell))
        return phases

    def states(self) -> MotionStates:
        """States of one cycle: :class:`~ballscrew.axis.motion.states.MotionStates`."""
        return states_of(self.phases())


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Trapezoid(_Stroke):
    """A stroke with constant acceleration, constant speed and the same deceleration; a triangle where it is short.

    Raises :class:`~ballscrew.basis.errors.InputError` for values that are not positive.
    """


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class SCurve(_Stroke):
    """A stroke with limited jerk: the fastest of seven phases (:func:`~ballscrew.axis.motion.profiles.timing`).

    Raises :class:`~ballscrew.basis.errors.InputError` for values that are not positive.
    """

    jerk: Annotated[Jerk, _JERK]

    @property
    def limit_of_jerk(self) -> Jerk:
        """The largest jerk, m/s^3."""
        return self.jerk


@dataclasses.dataclass(frozen=True)
class _QuarterOfSine:
    """A quarter of a period of a sine, from one end to the middle or from the middle to an end."""

    name: str
    amplitude: Length
    angular_frequency: float
    #: The first quarter, from the lower end, is 0.
    quarter: int
    force: Force = 0.0
    temperature: Temperature | None = None

    @property
    def duration(self) -> Duration:
        """A quarter of the period."""
        return math.pi / 2 / self.angular_frequency

    def at(self, time: Numbers) -> tuple[Numbers, Numbers, Numbers]:
        """Position, speed and acceleration at times since its start."""
        A, w = self.amplitude, self.angular_frequency
        angle = w * time + self.quarter * math.pi / 2
        return A * (1 - np.cos(angle)), A * w * np.sin(angle), A * w**2 * np.cos(angle)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Sine(ByValue):
    """A sine from one end of the stroke to the other and back.

    Raises :class:`~ballscrew.basis.errors.InputError` for values that are not positive.
    """

    stroke: Annotated[Length, _STROKE]
    frequency: Annotated[
        Frequency, Info("f", "cycles per second", "Hz", above=0, hint="0.1 Hz to 20 Hz", usual=(1e-6, 1e3))
    ]
    force: Annotated[Force, _FORCE] = 0.0
    return_force: Annotated[Force, _BACK] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("motion", self))

    def phases(self) -> Sequence[Phase]:
        """The four quarters of a period, each a :class:`~ballscrew.axis.motion.states.Phase`."""
        w, ways = 2 * math.pi * self.frequency, ("forth", "forth", "back", "back")
        forces = (self.force, self.force, self.return_force, self.return_force)
        return [_QuarterOfSine(ways[i], self.stroke / 2, w, i, forces[i]) for i in range(4)]

    def states(self) -> MotionStates:
        """States of one cycle: :class:`~ballscrew.axis.motion.states.MotionStates`."""
        return states_of(self.phases())


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Segment(ByValue):
    """A part of a motion of segments.

    With a ``distance`` a move from rest to rest, a negative one backwards. With a ``duration`` a stretch at a constant
    speed, a rest where the speed is zero. Raises :class:`~ballscrew.basis.errors.InputError` for both or neither of
    them, and for a move without a speed.
    """

    distance: Annotated[
        Length | None, Info("s", "way of a move, negative backwards", "mm", hint="−200 mm", usual=(-20.0, 20.0))
    ] = None
    duration: Annotated[
        Duration | None, Info("t", "time at constant speed, or at rest", "s", above=0, hint="5 s", usual=(1e-6, 1e7))
    ] = None
    speed: Annotated[
        Speed, Info("v", "speed; of a move its size", "m/min", hint="negative backwards", usual=(-10.0, 10.0))
    ] = 0.0
    acceleration: Annotated[Acceleration | None, _ACCELERATION] = None
    force: Annotated[
        Force,
        Info("F_x", "force of the process, positive against positive motion", "N", hint="2 kN", usual=(-1e7, 1e7)),
    ] = 0.0
    temperature: Annotated[
        Temperature | None, Info("T", "temperature of the oil in it", "degC", above=0, hint="40 degC", usual=(200, 450))
    ] = None
    #: The name of its phases; by default ``segment`` with its number.
    name: str = ""

    def __post_init__(self) -> None:
        faults = faults_of("segment", self, optional=("distance", "duration", "acceleration", "temperature"))
        if (self.distance is None) == (self.duration is None):
            problem = MISSING if self.distance is None else "is given beside the duration"
            faults.append(Fault("segment.distance", problem, "", "give a distance, or a duration and a speed"))
        elif self.distance is not None and not abs(self.distance) > 0:
            faults.append(Fault("segment.distance", "must not be zero", "0 m", "give a duration for a rest"))
        elif self.distance is not None and not abs(self.speed) > 0:
            faults.append(Fault("segment.speed", MISSING, "", "a move needs a speed"))
        elif self.distance is not None and self.distance > 0 > self.speed:
            given, remedy = shown(self.speed, "m/s"), "of a move give its size, and the sign to the distance"
            faults.append(Fault("segment.speed", "is against the distance", given, remedy))
        if self.duration is not None and self.acceleration is not None:
            given, remedy = shown(self.acceleration, "m/s^2"), "leave it out, or give a distance, no duration"
            faults.append(Fault("segment.acceleration", "does not count at constant speed", given, remedy))
        raise_if_any(faults)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Segments(ByValue):
    """Segments one after the other: moves from rest to rest, stretches at constant speed, rests.

    Moves without an acceleration of their own have that of the whole. The motion starts at zero and repeats; it should
    end where it started. Raises :class:`~ballscrew.basis.errors.InputError` for a move without any acceleration, and
    for no segments.
    """

    #: The parts of the motion, in order of time.
    segments: tuple[Segment, ...]
    acceleration: Annotated[Acceleration | None, _ACCELERATION] = None
    jerk: Annotated[Jerk | None, _JERK] = None

    def __post_init__(self) -> None:
        faults = faults_of("motion", self, optional=("acceleration", "jerk"))
        if not self.segments:
            faults.append(Fault("motion.segments", MISSING, "", "give at least one"))
        for number, segment in enumerate(self.segments, start=1):
            if segment.distance is not None and segment.acceleration is None and self.acceleration is None:
                where = f"motion.segment {number}.acceleration"
                faults.append(Fault(where, MISSING, "", "a move needs one, its own or that of the motion"))
        raise_if_any(faults)

    def phases(self) -> Sequence[Phase]:
        """The phases of all segments, each a :class:`~ballscrew.axis.motion.states.Phase`."""
        phases: list[PolynomialPhase] = []
        position = 0.0
        for number, segment in enumerate(self.segments, start=1):
            name = segment.name or f"segment {number}"
            if segment.distance is not None:
                own = segment.acceleration
                acceleration: Any = self.acceleration if own is None else own
                phases += move(
                    position,
                    segment.distance,
                    abs(segment.speed),
                    acceleration,
                    math.inf if self.jerk is None else self.jerk,
                    force=segment.force,
                    temperature=segment.temperature,
                    name=name,
                )
                position += float(segment.distance)
            else:
                duration: Any = segment.duration
                phases.append(
                    PolynomialPhase(
                        name, duration, position, segment.speed, force=segment.force, temperature=segment.temperature
                    )
                )
                position += float(segment.speed) * float(duration)
        return phases

    def states(self) -> MotionStates:
        """States of one cycle: :class:`~ballscrew.axis.motion.states.MotionStates`."""
        return states_of(self.phases())
