"""Power off: whether the axis stays or falls, how fast, and what a brake must hold."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence

import numpy as np
from scipy.optimize import root_scalar

from ballscrew._arrays import ByValue
from ballscrew.axis.axis import Axis
from ballscrew.axis.duty import Duty
from ballscrew.axis.screw_friction import ModelledScrew, Screw
from ballscrew.friction.breakaway import breakaway
from ballscrew.quantities import Acceleration, AngularSpeed, Force, Length, Ratio, Speed, Temperature, Torque

#: Factor on the holding torque by which brakes of vertical axes are chosen where nothing else is known: an assumption.
BRAKE_FACTOR = 2.0
#: Temperatures of the oil at which the axis is let go, besides that of the case, K.
COLD, HOT = 278.15, 333.15
#: Speed of the screw at which motion begins, rad/s: a thousandth of a turn per second.
CREEP = 2 * math.pi * 1e-3
#: Speeds of the screw up to which a steady fall is looked for, rad/s.
FASTEST = 2 * math.pi * 200


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class LetGo(ByValue):
    """The axis with the motor off, without a brake, in one condition."""

    condition: str
    temperature: Temperature | None
    #: Torque of the load about the motor, without friction, N m, positive where it would turn it backwards.
    load_torque: Torque
    #: Friction about the motor from rest, and in slow motion, N m.
    breakaway_torque: Torque
    running_torque: Torque
    #: True where the load alone starts the axis.
    falls: bool
    #: True where the axis goes on once something has started it.
    goes_on: bool
    #: Acceleration as it starts, m/s²; zero where it stays.
    acceleration: Acceleration
    #: Speed after the stroke, m/s, and the steady speed at which friction holds the load; infinite if there is none.
    speed_after_stroke: Speed
    steady_speed: Speed

    @property
    def holding_torque(self) -> Torque:
        """Torque that keeps the axis at rest, with the friction of slow motion to help, N m; zero where it stays."""
        return max(abs(self.load_torque) - self.running_torque, 0.0)

    @property
    def safety(self) -> Ratio:
        """Friction from rest over the torque of the load: below one it falls. Infinite without a load."""
        return self.breakaway_torque / abs(self.load_torque) if self.load_torque else math.inf


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Brake(ByValue):
    """What happens with the motor off, in several conditions, and the brake that is needed.

    Friction of a motor, its magnets' detent and a set grease hold more; none of them is counted on.
    """

    conditions: Sequence[LetGo]
    brake_factor: Ratio = BRAKE_FACTOR

    @property
    def falls(self) -> bool:
        """True where the axis starts to move by itself, or goes on once started, in any condition."""
        return any(found.falls or found.goes_on for found in self.conditions)

    @property
    def starts(self) -> bool:
        """True where the axis starts to move by itself in any condition."""
        return any(found.falls for found in self.conditions)

    @property
    def holding_torque(self) -> Torque:
        """Largest torque that keeps the axis at rest, N m."""
        return max(found.holding_torque for found in self.conditions)

    @property
    def load_torque(self) -> Torque:
        """Torque of the load without any friction, N m: what a brake holds whose friction is not counted on."""
        return max(abs(found.load_torque) for found in self.conditions)

    @property
    def brake_torque(self) -> Torque:
        """Rated torque of a brake, with its factor and without any help of friction, N m; zero where none is needed."""
        return self.brake_factor * self.load_torque if self.falls else 0.0


def brake_of(duty: Duty, *, brake_factor: Ratio = BRAKE_FACTOR, process_force: Force = 0.0) -> Brake:
    """The axis of a duty with its motor off.

    As the case has it, with the oil at 5 °C and at 60 °C, and dry: all contacts at the boundary, none of the rolling
    that oil makes. An oil without a grade has one temperature only.
    """
    axis, driven = duty.axis, duty.driven
    load = axis.gravity_force + process_force
    found = [_let_go(axis, driven, load, duty.states.stroke, "as in the case", None)]
    if isinstance(driven, ModelledScrew):
        if driven.lubricant.temperature is not None:
            found += [
                _let_go(axis, driven, load, duty.states.stroke, name, at) for name, at in (("cold", COLD), ("hot", HOT))
            ]
        found.append(_dry(axis, driven, load, duty.states.stroke))
    return Brake(conditions=found, brake_factor=brake_factor)


def _arm(axis: Axis, driven: Screw) -> Length:
    """Force along the axis to torque at the motor."""
    return float(driven.lead) / (2 * math.pi) / axis.transmission_ratio


def _friction(axis: Axis, driven: Screw, load: Force, speed: AngularSpeed, temperature: Temperature | None) -> Torque:
    """Friction about the motor at a load and a speed of the screw, guides and bearings with it."""
    warm = np.array([np.nan if temperature is None else temperature])
    falling = math.copysign(speed, -load)
    screw = float(driven.along(np.array([load]), np.array([falling]), warm).torque[0])
    along = (axis.guide_force + axis.guide_seal_force) * _arm(axis, driven)
    return (screw + axis.bearing_torque) / axis.transmission_ratio + along


def _let_go(
    axis: Axis, driven: Screw, load: Force, stroke: Length, condition: str, temperature: Temperature | None
) -> LetGo:
    arm = _arm(axis, driven)
    pull = abs(load) * arm
    running = _friction(axis, driven, load, CREEP, temperature)
    started = running if not isinstance(driven, ModelledScrew) else _from_rest(axis, driven, load, temperature)

    def left(speed: AngularSpeed) -> Torque:
        """Torque that is left to accelerate at a speed of the screw."""
        return pull - _friction(axis, driven, load, speed, temperature)

    steady = math.inf
    goes_on = load != 0 and running < pull
    if goes_on and left(FASTEST) < 0:
        steady = root_scalar(left, bracket=(CREEP, FASTEST), rtol=1e-6).root * float(driven.lead) / (2 * math.pi)
    return _record(axis, driven, load, stroke, condition, temperature, started, running, steady)


def _dry(axis: Axis, driven: ModelledScrew, load: Force, stroke: Length) -> LetGo:
    from_rest = _from_rest(axis, driven, load, None)
    return _record(axis, driven, load, stroke, "dry", None, from_rest, from_rest, math.inf)


def _from_rest(axis: Axis, driven: ModelledScrew, load: Force, temperature: Temperature | None) -> Torque:
    """Friction about the motor from rest, guides and bearings with it."""
    oil = driven.lubricant if temperature is None else driven.lubricant.at(temperature)
    screw = float(breakaway(driven.model, driven.screw, oil, axial_load=load).torque)
    along = (axis.guide_force + axis.guide_seal_force) * _arm(axis, driven)
    return (screw + axis.bearing_torque) / axis.transmission_ratio + along


def _record(
    axis: Axis,
    driven: Screw,
    load: Force,
    stroke: Length,
    condition: str,
    temperature: Temperature | None,
    started: Torque,
    running: Torque,
    steady: Speed,
) -> LetGo:
    arm = _arm(axis, driven)
    pull = abs(load) * arm
    goes_on = load != 0 and running < pull
    inertia = axis.inertia + axis.moving_mass * arm**2
    acceleration = (pull - running) / inertia * arm if goes_on and inertia else 0.0
    return LetGo(
        condition=condition,
        temperature=temperature,
        load_torque=load * arm,
        breakaway_torque=started,
        running_torque=running,
        falls=load != 0 and started < pull,
        goes_on=goes_on,
        acceleration=acceleration,
        speed_after_stroke=min(math.sqrt(2 * acceleration * stroke), steady),
        steady_speed=steady if goes_on else 0.0,
    )


def conditions_by_name(brake: Brake) -> Mapping[str, LetGo]:
    """The conditions of a brake by name."""
    return {found.condition: found for found in brake.conditions}
