"""The axis and its motor: what moves, what it rubs on, how the motor drives the screw, and its torques."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple, Protocol

import numpy as np

from ballscrew.axis.motion.states import MotionStates, Numbers
from ballscrew.axis.supports.guide import GUIDES, SEALS, GuidedTable
from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue, compact
from ballscrew.basis.errors import Fault, faults_of, raise_if_any
from ballscrew.basis.quantities import (
    Acceleration,
    Angle,
    AngularSpeed,
    Array,
    Force,
    Info,
    Mass,
    MomentOfInertia,
    Ratio,
    Speed,
    Temperature,
    Torque,
    Unit,
    fields_of,
)
from ballscrew.physics.components.materials import GRAVITY
from ballscrew.physics.components.operating_state import ElementFriction


class Guides(Protocol):
    """The carriages of a table, as the elements of :mod:`ballscrew.axis.supports` are."""

    carriages: int

    def under(self, loads: Force, speed: Speed, temperature: Temperature | None = None) -> ElementFriction:
        """Friction along the rails, N, under the load of each carriage, the carriages along the last axis."""
        ...


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
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
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
            hint="all that turns; or left out, and that of the motor alone: a case adds its screw's",
            usual=(0, 100.0),
        ),
    ] = 0.0
    motor_inertia: Annotated[
        MomentOfInertia,
        Info(
            "J_m",
            "moment of inertia of the motor with its brake, in place of that of all that turns",
            "kg cm^2",
            at_least=0,
            hint="a data sheet has it",
            usual=(0, 100.0),
        ),
    ] = 0.0
    coupling_inertia: Annotated[
        MomentOfInertia,
        Info(
            "J_c",
            "moment of inertia of coupling or pulleys, at the motor, in place of that of all that turns",
            "kg cm^2",
            at_least=0,
            hint="a data sheet has it",
            usual=(0, 100.0),
        ),
    ] = 0.0
    screw_inertia: Annotated[
        MomentOfInertia | None,
        Info(
            "J_s",
            "moment of inertia of the screw about its axis, in place of that of all that turns",
            "kg cm^2",
            at_least=0,
            hint="left out: that of a cylinder of its nominal diameter and length",
            usual=(0, 100.0),
        ),
    ] = None
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
    #: The guides as an element, in place of a coefficient and a force of seals.
    guides: Guides | None = None
    #: Where the carriages are and the mass is on them; without it they share the weight evenly.
    table: GuidedTable | None = None

    def __post_init__(self) -> None:
        faults = faults_of("axis", self, optional=("screw_inertia",))
        if not faults and self.inertia:
            faults += [
                Fault(
                    f"axis.{name}",
                    "is given beside the inertia of all that turns",
                    f"{getattr(self, name):g} kg m^2",
                    "leave one of the two out",
                )
                for name in ("motor_inertia", "coupling_inertia", "screw_inertia")
                if getattr(self, name)
            ]
        if not faults and self.guides is not None:
            faults += [
                Fault(f"axis.{name}", "is given beside the guides", f"{getattr(self, name):g}", "give one of the two")
                for name in ("guide_friction_coefficient", "guide_seal_force")
                if np.any(getattr(self, name))
            ]
        if self.table is not None and self.guides is None:
            faults.append(Fault("axis.table", "has no guides", "", "give guides, too"))
        if not faults and self.table is not None:
            for name in ("mass", "inclination"):
                of_table, own = float(getattr(self.table, name)), float(getattr(self, name))
                if not math.isclose(of_table, own, rel_tol=1e-9, abs_tol=1e-12):
                    given = f"{of_table:g} and {own:g}"
                    faults.append(Fault(f"axis.{name}", "is another one than that of the table", given, "give one"))
        raise_if_any(faults)

    @property
    def gravity_force(self) -> Force:
        r"""Force of the weight against positive motion, N.

        .. math:: F = m g \sin\theta \mp \left(m_c g + F_c\right)

        What balances it lifts: minus where positive motion is upwards, or level, plus where it is downwards.
        """
        weight = self.mass * GRAVITY * math.sin(self.inclination)
        lifts = self.counterweight * GRAVITY + self.counterforce
        return weight - (lifts if self.inclination >= 0 else -lifts)

    def guide_friction(
        self, speed: Speed, acceleration: Acceleration = 0.0, temperature: Temperature | None = None
    ) -> Mapping[str, Numbers]:
        r"""Friction of the guides by mechanism at speeds and accelerations, magnitudes, N; at rest what they hold.

        ``speed`` (m/s) and ``acceleration`` (m/s²) broadcast; guides that are an element also take the ``temperature``
        (K) of their oil. Without an element :math:`\mu_g m g \cos\theta` and the force of the seals.
        """
        every = np.ones(np.broadcast_shapes(np.shape(speed), np.shape(acceleration)))
        if self.guides is None:
            weight = self.mass * GRAVITY * math.cos(self.inclination)
            return {
                GUIDES: self.guide_friction_coefficient * weight * every,
                SEALS: self.guide_seal_force * every,
            }
        contributions = self.guides.under(self.carriage_loads(acceleration), speed, temperature).contributions
        return {name: part * every for name, part in contributions.items()}

    def carriage_loads(self, acceleration: Acceleration = 0.0) -> Force:
        """Load of each carriage, N, at each ``acceleration`` (m/s²), the carriages along the last axis."""
        assert self.guides is not None
        if self.table is not None:
            return self.table.loads(acceleration).equivalent
        weight = self.mass * GRAVITY * math.cos(self.inclination)
        number = int(self.guides.carriages)
        return np.full((*np.shape(acceleration), number), weight / number)

    @property
    def resting_guide_friction(self) -> Force:
        """Force that the guides hold at rest, N."""
        return float(sum(self.guide_friction(0.0).values()))

    @property
    def inertia_by(self) -> Mapping[str, MomentOfInertia]:
        """Moments of inertia of what turns, at the motor, kg m^2: in one, as given, or those of its parts.

        That of the screw over the square of the transmission ratio.
        """
        if self.inertia:
            return {"motor, coupling and screw": self.inertia}
        of_screw = (self.screw_inertia or 0.0) / self.transmission_ratio**2
        parts = {"screw": of_screw, "motor": self.motor_inertia, "coupling": self.coupling_inertia}
        return {name: part for name, part in parts.items() if part}

    @property
    def turning_inertia(self) -> MomentOfInertia:
        """Moment of inertia of all that turns, at the motor, kg m^2."""
        return float(sum(self.inertia_by.values()))

    @property
    def moving_mass(self) -> Mass:
        """Mass that is accelerated, that of the counterweight too, kg."""
        return self.mass + self.counterweight

    def loads(self, states: MotionStates) -> Loads:
        """Forces at the ``states`` of a motion, N; guides do not rub at rest, where they hold."""
        every = np.ones_like(states.time)
        rubs: dict[str, Any] = {**self.guide_friction(states.speed, states.acceleration)}
        seals = rubs.pop(SEALS, 0.0)
        return Loads(
            acceleration=self.moving_mass * states.acceleration,
            gravity=compact(self.gravity_force * every),
            process=compact(states.force),
            guides=compact(states.direction * sum(rubs.values(), 0.0 * every)),
            guide_seals=compact(states.direction * seals),
        )


TorqueConstant = Annotated[Array, Unit("N m/A")]
Resistance = Annotated[Array, Unit("ohm")]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Motor(ByValue):
    """A motor with its drive, by its data sheet.

    The peak torque holds up to the largest speed, or falls along a ``curve`` of points (speed in rad/s, torque in N m)
    with straight lines.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, and for a curve whose speeds do not
    rise.
    """

    rated_torque: Annotated[
        Torque, Info("T_N", "torque that it gives for ever", "N m", above=0, hint="2.4 N m", usual=(0.01, 1000.0))
    ]
    peak_torque: Annotated[
        Torque,
        Info("T_max", "torque that it gives for a short time", "N m", above=0, hint="7 N m", usual=(0.01, 3000.0)),
    ]
    largest_speed: Annotated[
        AngularSpeed, Info("n_max", "largest speed", "rpm", above=0, hint="3000 rpm", usual=(1.0, 5000.0))
    ]
    curve: tuple[tuple[float, float], ...] = ()
    torque_constant: Annotated[
        TorqueConstant | None, Info("K_t", "torque over current", "N m/A", above=0, hint="0.5 N m/A")
    ] = None
    resistance: Annotated[
        Resistance | None, Info("R", "resistance that makes heat, of K_t² and i²R", "ohm", above=0, hint="1 ohm")
    ] = None
    holding_torque: Annotated[
        Torque | None,
        Info(
            "M_h",
            "torque without current at rest: detent, friction; shorted windings have none there",
            "N m",
            at_least=0,
            hint="0.1 N m",
            usual=(0.0, 100.0),
        ),
    ] = None

    def __post_init__(self) -> None:
        faults = faults_of("motor", self, optional=("torque_constant", "resistance", "holding_torque"))
        if not faults and self.peak_torque < self.rated_torque:
            given = f"{float(self.peak_torque):g} N m"
            faults.append(Fault("motor.peak_torque", "is below the rated torque", given, "give the peak of the sheet"))
        speeds = [speed for speed, _ in self.curve]
        if any(after <= before for before, after in itertools.pairwise(speeds)):
            faults.append(Fault("motor.curve", "the speeds do not rise", "", "give points (speed, torque) by speed"))
        if len(self.curve) == 1:
            faults.append(Fault("motor.curve", "has one point only", "", "give two at least, or leave it out"))
        faults += self._misfits()
        if any(not (speed >= 0 and torque >= 0) for speed, torque in self.curve):
            faults.append(Fault("motor.curve", "must not be negative", "", "give sizes of speeds and torques"))
        raise_if_any(faults)

    def _misfits(self) -> list[Fault]:
        """Faults of a curve against the numbers of the data sheet beside it."""
        if len(self.curve) < 2:
            return []
        misfits: list[Fault] = []
        highest, last = max(torque for _, torque in self.curve), self.curve[-1][0]
        if highest > self.peak_torque * (1 + 1e-9):
            given, remedy = f"{highest:g} N m", "check the unit of the points, or give the peak torque of the curve"
            misfits.append(Fault("motor.curve", "lies above the peak torque", given, remedy))
        if last < self.largest_speed * (1 - 1e-9):
            remedy = "add a point at the largest speed"
            given = units.shown(last, fields_of(Motor)["largest_speed"])
            misfits.append(Fault("motor.curve", "ends below the largest speed", given, remedy))
        return misfits

    def peak_at(self, speed: Numbers) -> Numbers:
        """Largest torque at each ``speed`` (rad/s) of either sign, N m; zero beyond the largest speed."""
        size = np.abs(speed)
        if self.curve:
            speeds, torques = np.array(self.curve).T
            peak = np.interp(size, speeds, torques, right=0.0)
        else:
            peak = np.full_like(size, self.peak_torque)
        return np.where(size <= self.largest_speed, peak, 0.0)
