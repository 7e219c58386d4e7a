"""Power off: whether the axis stays or falls, how fast, and what a brake must hold."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.duty_cycle.screw_friction import ModelledScrew
from ballscrew.axis.motion.states import Numbers
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.quantities import Acceleration, AngularSpeed, Force, Length, Ratio, Speed, Temperature, Torque
from ballscrew.physics.friction.breakaway import breakaway

#: Factor on the holding torque by which brakes of vertical axes are chosen where nothing else is known: an assumption.
BRAKE_FACTOR = 2.0
#: Temperatures of the oil at which the axis is let go, besides that of the case, K.
COLD, HOT = 278.15, 333.15
#: Speed of the screw at which motion begins, rad/s: a thousandth of a turn per second.
CREEP = 2 * math.pi * 1e-3
#: Speeds of the screw up to which a steady fall is looked for, rad/s.
FASTEST = 2 * math.pi * 200
#: Speeds from creep to the fastest of the duty at which friction is asked for.
SPEEDS = 25


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class LetGo(ByValue):
    """The axis with the motor off, without a brake, in one condition."""

    #: What it is: as in the case, cold, hot or dry.
    condition: str
    #: Temperature of the oil; None where it is that of the case, or dry.
    temperature: Temperature | None
    #: Torque of the load about the motor, without friction, N m, positive where it would turn it backwards.
    load_torque: Torque
    #: Friction about the motor from rest, N m.
    breakaway_torque: Torque
    #: Torque that the motor holds at rest without current, N m: its detent, none in motion.
    motor_torque: Torque
    #: The least of the friction about the motor at the speeds of the duty, N m.
    running_torque: Torque
    #: True where the load alone starts the axis.
    falls: bool
    #: True where the axis goes on at any of these speeds, once something has started it.
    goes_on: bool
    #: Largest acceleration, with the least friction; zero where it stays.
    acceleration: Acceleration
    #: Speed after the stroke at most, m/s.
    speed_after_stroke: Speed
    #: Speed at which friction holds the load, m/s; infinite if there is none.
    steady_speed: Speed

    @property
    def holding_torque(self) -> Torque:
        """Torque that stops the axis, with its least friction to help, N m; zero where it stays."""
        return max(abs(self.load_torque) - self.running_torque, 0.0)

    @property
    def safety(self) -> Ratio:
        """Friction from rest and what the motor holds, over the torque of the load: below one it falls.

        Infinite without a load.
        """
        held = self.breakaway_torque + self.motor_torque
        return held / abs(self.load_torque) if self.load_torque else math.inf


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Brake(ByValue):
    """Behaviour with the motor off, in several conditions, and the brake that is needed.

    A motor holds what its holding torque says, at rest; a set grease holds more, and is not counted on.
    """

    #: The axis with the motor off, in each condition.
    conditions: Sequence[LetGo]
    #: Torque of the brake over that of the load.
    brake_factor: Ratio = BRAKE_FACTOR

    @property
    def falls(self) -> bool:
        """True where the axis starts to move by itself, or goes on once started, in any condition."""
        return any(condition.falls or condition.goes_on for condition in self.conditions)

    @property
    def starts(self) -> bool:
        """True where the axis starts to move by itself in any condition."""
        return any(condition.falls for condition in self.conditions)

    @property
    def holding_torque(self) -> Torque:
        """Largest torque that keeps the axis at rest, N m."""
        return max(condition.holding_torque for condition in self.conditions)

    @property
    def load_torque(self) -> Torque:
        """Torque of the load without any friction, N m: what a brake holds whose friction is not counted on."""
        return max(abs(condition.load_torque) for condition in self.conditions)

    @property
    def brake_torque(self) -> Torque:
        """Rated torque of a brake, with its factor and without any help of friction, N m; zero where none is needed."""
        return self.brake_factor * self.load_torque if self.falls else 0.0


def brake_of(
    duty: Duty, *, brake_factor: Ratio = BRAKE_FACTOR, process_force: Force = 0.0, motor_torque: Torque = 0.0
) -> Brake:
    """The axis of a duty with its motor off.

    As the case has it, with the oil at 5 °C and at 60 °C, and dry: all contacts at the boundary, none of the rolling
    that oil makes. An oil without a grade has one temperature only. What belt or gears lose is not counted on.
    The least friction follows the product of speed and viscosity: another temperature moves it to another speed and
    leaves it about as large, so that the conditions differ little unless it lies beyond the speeds of the duty.
    ``motor_torque`` is what the motor holds at rest without current, N m.
    """
    off = _Off(duty, duty.axis.gravity_force + process_force, motor_torque)
    result = off.let_go({"as in the case": None})
    if isinstance(duty.driven, ModelledScrew):
        if duty.driven.lubricant.temperature is not None:
            result += off.let_go({"cold": COLD, "hot": HOT})
        result.append(off.dry(result[0]))
    return Brake(conditions=result, brake_factor=brake_factor)


@dataclasses.dataclass(frozen=True, eq=False)
class _Off:
    """A duty with its motor off, under a load."""

    duty: Duty
    load: Force
    motor_torque: Torque

    @property
    def arm(self) -> Length:
        """Force along the axis to torque at the motor."""
        return float(self.duty.driven.lead) / (2 * math.pi) / self.duty.axis.transmission_ratio

    @property
    def pull(self) -> Torque:
        """Size of the torque of the load about the motor."""
        return abs(self.load) * self.arm

    def with_supports(self, screw_torque: Numbers, speed: Numbers, temperature: Temperature | None) -> Numbers:
        """Friction about the motor: of the screw, of guides, and of what holds the shaft."""
        axis = self.duty.axis
        warm = None if temperature is None else np.full_like(speed, temperature)
        beside = self.duty.supports_at(np.full_like(speed, self.load), speed, warm)
        rubs = axis.guide_friction(speed * float(self.duty.driven.lead) / (2 * math.pi), 0.0, temperature)
        along = sum(rubs.values(), np.zeros_like(speed)) * self.arm
        held = sum((part for parts in beside.values() for part in parts.values()), np.zeros_like(speed))
        return (screw_torque + held) / axis.transmission_ratio + along

    def friction(self, speeds: Numbers, temperatures: Sequence[Temperature | None]) -> list[Numbers]:
        """Friction about the motor at sizes of the speed of the screw, in the direction of the fall, by temperature."""
        falling = np.copysign(speeds, -self.load)
        every = np.tile(falling, len(temperatures))
        warm = np.repeat([np.nan if temperature is None else temperature for temperature in temperatures], len(speeds))
        torques = self.duty.driven.along(np.full_like(every, self.load), every, warm).torque
        return [
            self.with_supports(torque, falling, temperature)
            for torque, temperature in zip(torques.reshape(len(temperatures), -1), temperatures, strict=True)
        ]

    def from_rest(self, driven: ModelledScrew, temperatures: Sequence[Temperature | None]) -> list[Torque]:
        """Friction about the motor from rest, by temperature."""
        own = driven.lubricant
        loads = driven.loads_at(np.array([self.load]))
        screw = driven.screw
        if screw.nut.set_at_rest:  # the balls may be back on their line: the lower friction counts
            screw = dataclasses.replace(screw, nut=dataclasses.replace(screw.nut, set_at_rest=False))
        torques: list[Torque] = []
        for temperature in temperatures:
            oil = own if temperature is None else own.at(temperature)
            rest = breakaway(driven.model, screw, oil, axial_load=np.array([self.load]), loads=loads)
            torques.append(float(self.with_supports(rest.torque, np.zeros(1), temperature)[0]))
        return torques

    def let_go(self, conditions: Mapping[str, Temperature | None]) -> list[LetGo]:
        """The axis in conditions of its oil, by name; power may fail at any speed of the duty."""
        driven, temperatures = self.duty.driven, [*conditions.values()]
        lead = float(driven.lead)
        fastest = max(float(np.max(np.abs(self.duty.screw_speed))), 10 * CREEP)
        speeds = np.geomspace(CREEP, fastest, SPEEDS)
        # and at the speed up to which a steady fall is looked for
        every = self.friction(np.append(speeds, FASTEST), temperatures)
        rest = self.from_rest(driven, temperatures) if isinstance(driven, ModelledScrew) else None
        result: list[LetGo] = []
        for number, (condition, temperature) in enumerate(conditions.items()):
            friction, at_fastest = every[number][:-1], float(every[number][-1])
            least = int(np.argmin(friction))  # a NaN is taken as the least
            steady, slowest = math.inf, float(speeds[least])

            def left(speed: AngularSpeed, temperature: Temperature | None = temperature) -> Torque:
                """Torque that is left to accelerate at a speed of the screw."""
                return self.pull - float(self.friction(np.array([speed]), [temperature])[0][0])

            if self.pull - float(friction[least]) > 0 > self.pull - at_fastest:
                from scipy.optimize import root_scalar  # slow to import: for axes that fall at a steady speed

                steady = root_scalar(left, bracket=(slowest, FASTEST), rtol=1e-6).root * lead / (2 * math.pi)
            started = float(friction[0]) if rest is None else rest[number]
            result.append(self._record(condition, temperature, started, float(friction[least]), steady))
        return result

    def dry(self, oiled: LetGo) -> LetGo:
        """The axis without oil: friction from rest at all speeds."""
        return self._record("dry", None, oiled.breakaway_torque, oiled.breakaway_torque, math.inf)

    def _record(
        self, condition: str, temperature: Temperature | None, started: Torque, running: Torque, steady: Speed
    ) -> LetGo:
        # a friction that is no number holds nothing
        goes_on = self.load != 0 and not running >= self.pull
        inertia = self.duty.axis.turning_inertia + self.duty.axis.moving_mass * self.arm**2
        acceleration = 0.0
        if goes_on:
            acceleration = (self.pull - running) / inertia * self.arm if inertia else math.inf
        return LetGo(
            condition=condition,
            temperature=temperature,
            load_torque=self.load * self.arm,
            breakaway_torque=started,
            motor_torque=self.motor_torque,
            running_torque=running,
            falls=self.load != 0 and not started + self.motor_torque >= self.pull,
            goes_on=goes_on,
            acceleration=acceleration,
            speed_after_stroke=min(math.sqrt(2 * acceleration * self.duty.states.stroke), steady)
            if self.duty.states.stroke
            else 0.0,
            steady_speed=steady if goes_on else 0.0,
        )
