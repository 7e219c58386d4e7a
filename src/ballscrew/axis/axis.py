"""The axis: what moves, what it rubs on, and how the motor drives the screw."""

from __future__ import annotations

import dataclasses
import math
from typing import Annotated, NamedTuple

import numpy as np

from ballscrew._arrays import ByValue
from ballscrew.errors import faults_of, raise_if_any
from ballscrew.motion.states import MotionStates, Numbers
from ballscrew.quantities import Angle, Force, Info, Mass, MomentOfInertia, Ratio, Torque

#: Standard acceleration of free fall, m/s².
GRAVITY = 9.80665


class Loads(NamedTuple):
    """Forces along the axis at states of motion, positive against positive motion; they sum to the load of the nut."""

    #: Of the mass that is accelerated.
    acceleration: Numbers
    #: Of the weight, less what balances it.
    gravity: Numbers
    #: Of the process.
    process: Numbers
    #: Of guides that rub in proportion to their load, and of their seals.
    guides: Numbers
    guide_seals: Numbers

    @property
    def total(self) -> Numbers:
        """Load of the nut."""
        return self.acceleration + self.gravity + self.process + self.guides + self.guide_seals


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Axis(ByValue):
    """A mass on guides, driven by a ball screw whose shaft a motor turns.

    Positive motion is upwards where the axis is inclined; a positive load on the nut is one against positive motion.
    Raises :class:`~ballscrew.errors.InputError` for values out of bounds.
    """

    mass: Annotated[Mass, Info("m", "moved mass, with the load on it", "kg", at_least=0, hint="400 kg", usual=(0, 1e5))]
    inclination: Annotated[
        Angle,
        Info(
            r"\theta",
            "angle of positive motion above the horizontal",
            "deg",
            at_least=-math.pi / 2,
            at_most=math.pi / 2,
            hint="0 deg for a horizontal axis, 90 deg for a vertical one",
        ),
    ] = 0.0
    counterweight: Annotated[
        Mass,
        Info("m_c", "mass of a counterweight, which moves too", "kg", at_least=0, hint="0 kg for none", usual=(0, 1e5)),
    ] = 0.0
    counterforce: Annotated[
        Force,
        Info(
            "F_c",
            "constant force that lifts, of a gas spring or a cylinder",
            "N",
            at_least=0,
            hint="0 N for none",
            usual=(0, 1e6),
        ),
    ] = 0.0
    guide_friction_coefficient: Annotated[
        Ratio,
        Info(
            r"\mu_g",
            "friction of the guides over their load",
            at_least=0,
            hint="rolling guides have 0.002 to 0.005, sliding ones 0.05 to 0.2",
            usual=(0, 0.5),
        ),
    ] = 0.0
    guide_seal_force: Annotated[
        Force,
        Info("F_g", "force of all seals of the guides", "N", at_least=0, hint="2 N to 5 N a carriage", usual=(0, 1e4)),
    ] = 0.0
    inertia: Annotated[
        MomentOfInertia,
        Info(
            "J",
            "moment of inertia of motor, coupling and screw, at the motor",
            "kg cm^2",
            at_least=0,
            hint="a data sheet has that of the motor",
            usual=(0, 100.0),
        ),
    ] = 0.0
    bearing_torque: Annotated[
        Torque,
        Info(
            "M_L",
            "friction torque of the support bearings",
            "N m",
            at_least=0,
            hint="0.02 N m to 0.6 N m",
            usual=(0, 100),
        ),
    ] = 0.0
    transmission_ratio: Annotated[
        Ratio, Info("i", "turns of the motor for one of the screw", above=0, hint="1 for a coupling", usual=(0.05, 100))
    ] = 1.0
    transmission_efficiency: Annotated[
        Ratio,
        Info(
            r"\eta_t",
            "efficiency of belt or spur gears, the same both ways",
            at_least=0.7,
            at_most=1,
            hint="belts have 0.95 to 0.98; a worm gear is no such thing: add its friction to bearing_torque",
        ),
    ] = 1.0
    #: Whether a brake holds the axis in rests, and the motor gives no torque there.
    brake_holds: bool = False

    def __post_init__(self) -> None:
        raise_if_any(faults_of("axis", self))

    @property
    def gravity_force(self) -> Force:
        r"""Force of the weight against positive motion, N.

        .. math:: F = m g \sin\theta \mp \left(m_c g + F_c\right)

        What balances it lifts: minus where positive motion is upwards, or level, plus where it is downwards.
        """
        weight = self.mass * GRAVITY * math.sin(self.inclination)
        lifts = self.counterweight * GRAVITY + self.counterforce
        return weight - (lifts if self.inclination >= 0 else -lifts)

    @property
    def guide_force(self) -> Force:
        r"""Friction of the guides by their load, :math:`\mu_g m g \cos\theta`, N."""
        return self.guide_friction_coefficient * self.mass * GRAVITY * math.cos(self.inclination)

    @property
    def moving_mass(self) -> Mass:
        """Mass that is accelerated, that of the counterweight too."""
        return self.mass + self.counterweight

    def loads(self, states: MotionStates) -> Loads:
        """Forces at states of motion; guides do not rub at rest, where they hold."""
        every = np.ones_like(states.time)
        return Loads(
            acceleration=self.moving_mass * states.acceleration,
            gravity=self.gravity_force * every,
            process=states.force,
            guides=states.direction * self.guide_force,
            guide_seals=states.direction * self.guide_seal_force,
        )
