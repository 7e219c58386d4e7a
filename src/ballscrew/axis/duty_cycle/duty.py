"""A duty: what a cycle of motion asks of the motor, what it costs in energy, and what wears.

One operating point makes a duty, too: the nut goes to and fro at one speed, under one load.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np

from ballscrew.axis.duty_cycle.axis import Axis, Loads
from ballscrew.axis.duty_cycle.screw_friction import (
    ConstantEfficiency,
    ModelledScrew,
    Screw,
    ScrewFriction,
    distinct_states,
)
from ballscrew.axis.motion.profiles import Motion, Segment, Segments
from ballscrew.axis.motion.states import MotionStates, Numbers, largest_within, sign_changes
from ballscrew.axis.supports.guide import GUIDES, SEALS
from ballscrew.basis.arrays import ByValue, compact, lazy, total
from ballscrew.basis.errors import MISSING, Fault, accepts_units, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Duration, Energy, Force, Length, Power, Ratio
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import FrictionElement, OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.validity import NEARLY_ALL, differs

#: Parts of the torque that store energy and give it back.
STORED = ("acceleration of the mass", "acceleration of what turns", "gravity")
PROCESS, BEARINGS, IMBALANCE = "process", "support bearings", "imbalance of the model"
#: The nut, the shaft and the balls between them, as an element of the axis.
NUT = "nut"
#: Mechanisms of the guides by the names of their contributions.
_OF_GUIDES: Mapping[str, str] = {**MECHANISMS, GUIDES: "by load"}
#: A share of the energy drawn that is rounding.
_ROUNDING = 1e-12
#: Names of the parts of the torque that are not friction of the screw, with their meanings.
PARTS: Mapping[str, str] = {
    "acceleration of the mass": "inertia of what moves along",
    "acceleration of what turns": "inertia of motor, coupling and screw",
    "gravity": "weight, less what balances it",
    PROCESS: "force of the process",
    GUIDES: "friction of the guides by their load",
    SEALS: "seals of the guides",
    BEARINGS: "friction of the support bearings",
    "transmission": "loss of belt or gears",
    "brake": "torque that the brake holds in rests",
    IMBALANCE: "torque without friction of a model that breaks virtual work",
}


@accepts_units("duty")
def duty(
    model: FrictionModel | Ratio,
    screw: BallScrew,
    lubricant: Lubricant | None = None,
    *,
    axis: Axis,
    motion: Motion | MotionStates,
    also: Mapping[str, FrictionElement] | None = None,
    recorded: bool = False,
) -> Duty:
    """Torques, powers and energies of one cycle of an axis: a :class:`Duty`.

    ``model`` is a model of the friction of the ``screw`` with its ``lubricant``, or one efficiency for all of its
    states, which needs no lubricant. ``axis`` is what the screw moves and what turns it; ``motion`` is its motion, or
    the states of one that are known, to which none is added; those of a motion get more where a torque or a power is
    the largest, or changes its sign, within a phase. ``also`` has further elements on the shaft of the screw,
    such as support bearings, by name: they get its load and its speed. ``recorded`` evaluates the model by the
    recording that all screws of a kind share: for who asks for many of them.

    Raises :class:`~ballscrew.basis.errors.InputError` as the model does, for a model without a lubricant, and for
    elements with the name of another part of the torque.
    """
    result = cycle(model, screw, lubricant, axis=axis, motion=motion, also=also, recorded=recorded)
    return result if isinstance(motion, MotionStates) else with_turns(result)


def cycle(
    model: FrictionModel | Ratio,
    screw: BallScrew,
    lubricant: Lubricant | None = None,
    *,
    axis: Axis,
    motion: Motion | MotionStates,
    also: Mapping[str, FrictionElement] | None = None,
    recorded: bool = False,
) -> Duty:
    """Return the same as :func:`duty`, without asking for any friction yet.

    A torque that is the largest, or changes its sign, within a phase is then met by the nearest state only
    (:func:`with_turns`).
    """
    taken = {NUT, *PARTS, *MECHANISMS.values(), *screw.nut.losses} if also else set[str]()
    faults = [
        Fault("duty.also", "has the name of another part of the torque", name, "call it otherwise")
        for name in also or {}
        if name in taken
    ]
    if isinstance(model, FrictionModel) and lubricant is None:
        faults.append(Fault("duty.lubricant", MISSING, "", 'give bs.Lubricant.from_grade("ISO VG 100", 313.15)'))
    raise_if_any(faults)
    states = motion if isinstance(motion, MotionStates) else motion.states()
    driven: Screw
    if isinstance(model, FrictionModel) and lubricant is not None:
        driven = ModelledScrew(model, screw, lubricant, recorded)
    else:
        driven = ConstantEfficiency(screw.lead, cast("Any", model))
    if states is not motion:  # friction bends where the load changes its sign
        at = sign_changes(states, axis.loads(states).total)
        states = states.cut_at(at) if at else states
    return Duty(axis, driven, states, also or {})


def with_turns(cycle: Duty) -> Duty:
    """A cycle with states where its torques are the largest and where they change their sign, within phases too.

    Nodes alone miss a largest torque between them, and the kink of the energy that is drawn, where it begins to return.
    """
    states = cycle.states
    if not any(np.ptp(values[part]) > 0 for part in states.parts for values in (states.speed, states.acceleration)):
        return cycle
    # the loss of belt or gears bends where what they pass on changes its sign
    signs = [sign_changes(states, values) for one in _conditions(cycle) for values in (one.torque, one.passed_on)]
    result = _with_states(cycle, [*itertools.chain(*signs)])
    largest = [
        largest_within(result.states, values)
        for one in _conditions(result)
        for values in (one.torque, -one.torque, one.power, -one.power, one.screw.torque)
    ]
    return _with_states(result, [*itertools.chain(*largest)])


def _conditions(cycle: Duty) -> list[Duty]:
    """The cycle as its inlet is given, and in a full bath of oil where that is another one, at the same states."""
    return [cycle] if cycle.flooded is cycle else [cycle, cycle.flooded]


def _with_states(cycle: Duty, at: Sequence[float]) -> Duty:
    """A cycle with states at more instants, s: the model is asked there, and nowhere again."""
    if not at:
        return cycle
    states, result = cycle.states, dataclasses.replace(cycle, states=cycle.states.cut_at(at))
    place = states.places_of(result.states)
    new = place < 0
    place[new] = states.time.size + np.arange(np.sum(new))
    more = result.driven.along(result.axial_load[new], result.screw_speed[new], result.states.temperature[new])
    vars(result)["screw"] = cycle.screw.joined(more, place)
    vars(result)["flooded"] = result if cycle.flooded is cycle else _with_states(cycle.flooded, at)
    return result


@dataclasses.dataclass(frozen=True, eq=False)
class Duty(ByValue):
    """One cycle of an axis, at its states of motion; everything is computed when it is asked for, and kept.

    Torques are those of the motor, positive forwards. Where the axis rests, friction holds up to :attr:`rest_friction`
    either way, and the torque is the middle of what is possible; where a brake holds, it is zero.
    """

    #: Mass, drive and guides.
    axis: Axis
    #: The screw with its friction: by a model, or by one efficiency.
    driven: Screw
    #: States of motion of one cycle.
    states: MotionStates
    #: Further elements on the shaft of the screw, by name.
    also: Mapping[str, FrictionElement]

    @lazy
    def loads(self) -> Loads:
        """Forces along the axis."""
        return self.axis.loads(self.states)

    @lazy
    def axial_load(self) -> Numbers:
        """Load of the nut, N."""
        return self.loads.total

    @lazy
    def screw_speed(self) -> Numbers:
        r"""Speed of the screw, :math:`\omega = 2 \pi v / P_h`, rad/s."""
        return 2 * math.pi * self.states.speed / float(self.driven.lead)

    @lazy
    def motor_speed(self) -> Numbers:
        """Speed of the motor, rad/s."""
        return self.axis.transmission_ratio * self.screw_speed

    @lazy
    def screw(self) -> ScrewFriction:
        """Friction of the screw; at the ends of phases its limit where the speed is zero."""
        return self.driven.along(self.axial_load, self.screw_speed, self.states.temperature)

    @lazy
    def flooded(self) -> Duty:
        """The same cycle with the balls of the screw in a full bath of oil; itself where nothing of theirs comes late.

        Bearings beside the screw keep what they have: that oil comes back late was found on bearings.
        """
        driven = self.driven
        if not isinstance(driven, ModelledScrew) or driven.in_full_bath is driven:
            return self
        result = dataclasses.replace(self, driven=driven.in_full_bath)
        vars(result).update(loads=self.loads, _supports=self._supports)  # which have nothing of the screw's oil
        return result

    @lazy
    def starved(self) -> bool:
        """True where, anywhere in motion, the friction torque of the screw differs from that of a full bath."""
        moving = self.states.direction != 0
        if self.flooded is self or not np.any(moving):
            return False
        driven, warm = self.driven, self.states.temperature
        assert isinstance(driven, ModelledScrew)
        if driven.least_replenished(self.screw_speed[moving], warm[moving]) >= NEARLY_ALL:
            return False
        return bool(np.any(differs(self.screw.torque[moving], self.flooded.screw.torque[moving])))

    @lazy
    def shaft_friction(self) -> Mapping[str, Numbers]:
        """Friction torques about the shaft of the screw by mechanism and element, their magnitudes, N m."""
        values = {MECHANISMS.get(name, name): torque for name, torque in self.screw.contributions.items()}
        return {**values, **self.support_friction}

    @lazy
    def support_friction(self) -> Mapping[str, Numbers]:
        """Friction torques about the shaft beside the screw, by element, their magnitudes, N m."""
        still = np.zeros_like(self.screw_speed)
        return {name: np.sum([still, *parts.values()], axis=0) for name, parts in self._supports.items()}

    @lazy
    def _supports(self) -> Mapping[str, Mapping[str, Numbers]]:
        """Friction torques about the shaft beside the screw, by element and mechanism, N m."""
        return self.supports_at(self.axial_load, self.screw_speed, self._temperature)

    @property
    def _temperature(self) -> Numbers | None:
        """Temperature of the oil at the states, K; None where it is that of each oil."""
        warm = self.states.temperature
        own = getattr(getattr(self.driven, "lubricant", None), "temperature", None)
        warm = warm if own is None else np.where(np.isnan(warm), own, warm)
        return None if np.isnan(warm).all() else warm

    @lazy
    def support_validity(self) -> Mapping[str, Mapping[str, Numbers]]:
        """Masks of the conditions of the elements beside the screw and of the guides, by element and condition."""
        support_validity: dict[str, Mapping[str, Numbers]] = {}
        state, back = _distinct(self.axial_load, self.screw_speed, self._temperature)
        every = np.ones(np.shape(state.screw_speed), dtype=bool)
        for name, element in self.also.items():
            support_validity[name] = {reason: (mask & every)[back] for reason, mask in element(state).validity.items()}
        if self.axis.guides is not None:
            loads = self.axis.carriage_loads(self.states.acceleration)
            support_validity[GUIDES] = self.axis.guides.under(loads, self.states.speed).validity
        return support_validity

    def supports_at(
        self, axial_load: Numbers, screw_speed: Numbers, temperature: Numbers | None
    ) -> Mapping[str, Mapping[str, Numbers]]:
        """Friction torques beside the screw at loads and speeds of it, by element and mechanism, magnitudes, N m.

        ``axial_load`` (N), ``screw_speed`` (rad/s) and ``temperature`` (K; None for that of each oil) are arrays of one
        length. Each distinct state is computed once.
        """
        supports: dict[str, Mapping[str, Numbers]] = {}
        if self.axis.bearing_torque:
            supports[BEARINGS] = {"known": np.full_like(screw_speed, self.axis.bearing_torque)}
        if not self.also:
            return supports
        state, back = _distinct(axial_load, screw_speed, temperature)
        speed = state.screw_speed
        for name, element in self.also.items():
            parts = element(state).contributions
            supports[name] = {
                MECHANISMS.get(part, part): np.broadcast_to(torque, speed.shape)[back] for part, torque in parts.items()
            }
        return supports

    @lazy
    def parts(self) -> Mapping[str, Numbers]:
        """Torque of the motor by cause, N m; the parts sum to :attr:`torque`."""
        ratio, arm = self.axis.transmission_ratio, float(self.driven.lead) / (2 * math.pi)
        to_motor, direction = arm / ratio, self.states.direction
        own = {
            "acceleration of the mass": self.loads.acceleration * to_motor,
            "gravity": compact(self.loads.gravity * to_motor),
            PROCESS: compact(self.loads.process * to_motor),
            GUIDES: compact(self.loads.guides * to_motor),
            SEALS: compact(self.loads.guide_seals * to_motor),
            **{name: compact(direction * torque / ratio) for name, torque in self.shaft_friction.items()},
            IMBALANCE: compact((self.screw.ideal_torque - self.axial_load * arm) / ratio),
        }
        turned = total(own.values())
        lost = compact(self.transmission_loss(turned))
        alpha = self.states.acceleration / to_motor
        own |= {"transmission": lost, "acceleration of what turns": self.axis.turning_inertia * alpha}
        if self.axis.brake_holds:
            own["brake"] = -np.where(direction == 0, turned, 0.0)
        return own

    def transmission_loss(self, turned: Numbers) -> Numbers:
        """Torque that belt or gears add to one that they pass on, N m: more where the motor drives, less where it is.

        ``turned`` is the torque without them at the motor, N m, at each state.
        """
        eta, direction = self.axis.transmission_efficiency, self.states.direction
        return np.where(turned * direction > 0, turned * (1 / eta - 1), turned * (eta - 1)) * np.abs(direction)

    @property
    def passed_on(self) -> Numbers:
        """Torque that belt or gears pass on, at the motor and without their loss, N m."""
        besides = ("transmission", "acceleration of what turns", "brake")
        return total(part for name, part in self.parts.items() if name not in besides)

    @lazy
    def torque(self) -> Numbers:
        """Torque of the motor, N m."""
        return total(self.parts.values())

    @lazy
    def power(self) -> Numbers:
        """Power of the motor, W; negative where it is driven."""
        return self.torque * self.motor_speed

    def load_reversals(self, least: Ratio = _ROUNDING) -> list[tuple[Duration, Length, int]]:
        """Changes of the load's sign in a cycle that repeats: time, s, position, m, and number of the phase.

        A load below the share ``least`` of the largest has no sign: the first state with the new one counts.
        """
        load, states = self.axial_load, self.states
        seen = np.flatnonzero(np.abs(load) > least * np.max(np.abs(load)))
        turns = seen[np.sign(load[seen]) != np.sign(load[np.roll(seen, 1)])]
        return [(float(states.time[at]), float(states.position[at]), int(states.phase[at])) for at in turns]

    @lazy
    def rest_friction(self) -> Numbers:
        """Torque at the motor that friction holds either way where the axis rests, N m; NaN in motion."""
        along = self.axis.resting_guide_friction * float(self.driven.lead) / (2 * math.pi)
        held = (sum(self.shaft_friction.values()) + along) / self.axis.transmission_ratio
        return np.where(self.states.direction == 0, held, np.nan)

    # -- numbers of the cycle ---------------------------------------------------------------------

    @lazy
    def torque_rms(self) -> float:
        r"""Root mean square of the torque, rests included, :math:`\sqrt{\frac{1}{t_c} \int \tau^2 dt}`, N m."""
        return math.sqrt(self.states.integral(self.torque**2) / self.states.cycle_time)

    @lazy
    def torque_peak(self) -> float:
        """Largest size of the torque, N m."""
        return float(np.max(np.abs(self.torque)))

    @lazy
    def screw_torque(self) -> float:
        """Largest friction torque of the screw in motion, N m; NaN where nothing moves."""
        result = self.screw.torque[self.states.direction != 0]
        return float(np.max(result)) if result.size else math.nan

    @lazy
    def mean_speed(self) -> float:
        """Mean size of the speed of the screw over the cycle, rad/s."""
        return self.states.integral(np.abs(self.screw_speed)) / self.states.cycle_time

    @lazy
    def revolutions(self) -> float:
        """Turns of the screw in a cycle, forth and back."""
        return self.states.travel / float(self.driven.lead)

    @lazy
    def energy_drawn(self) -> Energy:
        """Energy that the motor gives, J."""
        return self.states.integral(np.maximum(self.power, 0.0))

    @lazy
    def energy_returned(self) -> Energy:
        """Energy that the motor takes back, J: to the supply, or to a resistor."""
        return self.states.integral(np.maximum(-self.power, 0.0))

    @lazy
    def energy_by(self) -> Mapping[str, Energy]:
        """Energy of a cycle by cause, J; the parts sum to what is drawn less what is returned."""
        return {name: self.states.integral(part * self.motor_speed) for name, part in self.parts.items()}

    @lazy
    def energy_lost_by(self) -> Mapping[str, Energy]:
        """Energy lost in a cycle by mechanism, J."""
        return {name: energy for name, energy in self.energy_by.items() if name not in (*STORED, PROCESS)}

    @lazy
    def energy_lost_in(self) -> Mapping[str, Mapping[str, Energy]]:
        """Energy lost in a cycle by element and mechanism, J; the parts sum to :attr:`energy_lost`.

        The nut with all that it loses, each bearing, the guides, and belt or gears. What a model gains or loses that
        breaks virtual work counts to the nut.
        """
        states, lost = self.states, self.energy_lost_by
        own = [MECHANISMS.get(name, name) for name in self.screw.contributions]
        broken = [IMBALANCE] if abs(lost[IMBALANCE]) > _ROUNDING * self.energy_drawn else []
        travelled = np.abs(states.speed)
        rubs = self.axis.guide_friction(states.speed, states.acceleration)
        turned = np.abs(self.screw_speed)
        values = {
            NUT: {name: lost[name] for name in (*own, *broken)},
            **{
                name: {part: states.integral(torque * turned) for part, torque in parts.items()}
                for name, parts in self._supports.items()
            },
            GUIDES: {_OF_GUIDES.get(part, part): states.integral(force * travelled) for part, force in rubs.items()},
            "transmission": {"transmission": lost["transmission"]},
        }
        return {name: parts for name, parts in values.items() if name == NUT or any(parts.values())}

    @lazy
    def heat(self) -> Mapping[str, Power]:
        """Mean heat of each element over the cycle, W."""
        return {name: sum(parts.values()) / self.states.cycle_time for name, parts in self.energy_lost_in.items()}

    @property
    def energy_lost(self) -> Energy:
        """Energy lost in a cycle, J."""
        return float(sum(self.energy_lost_by.values()))

    @property
    def energy_of_process(self) -> Energy:
        """Work done on the process in a cycle, J."""
        return self.energy_by[PROCESS]

    @property
    def energy_stored(self) -> Energy:
        """Change of kinetic and potential energy over the cycle by the parts of the torque, J; zero where it closes."""
        return float(sum(self.energy_by[name] for name in STORED))

    @property
    def summary(self) -> Mapping[str, Any]:
        """The numbers of the cycle by name, SI."""
        names = (
            "torque_rms", "torque_peak", "energy_drawn", "energy_returned", "energy_lost", "energy_of_process",
            "energy_stored", "mean_speed", "revolutions",
        )  # fmt: skip
        return {"cycle_time": self.states.cycle_time, **{name: getattr(self, name) for name in names}}


def _distinct(axial_load: Numbers, screw_speed: Numbers, temperature: Numbers | None) -> tuple[OperatingState, Any]:
    """The distinct states among these, and the place of each among them."""
    warm = np.full_like(screw_speed, np.nan) if temperature is None else temperature
    (load, speed, degrees), back = distinct_states(axial_load, screw_speed, warm)
    return OperatingState(load, speed, None if temperature is None else degrees), back


@accepts_units("operation")
def to_and_fro(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant | None = None,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    stroke: Length,
    also: Mapping[str, FrictionElement] | None = None,
) -> Duty:
    """The duty of a screw that turns at one speed over a stroke and back, with no mass and no rest.

    Returns a :class:`~ballscrew.axis.duty_cycle.duty.Duty`. ``model``, ``screw``, ``lubricant`` and ``also``, further
    elements on the shaft, are those of :func:`~ballscrew.axis.duty_cycle.duty.duty`. ``axial_load`` (N),
    ``screw_speed`` (rad/s; its sign is that of the first way) and ``stroke`` (m) are one number each. The load keeps
    its direction, as a weight does: one way the screw lifts it, the other way it drives the screw.

    Raises :class:`~ballscrew.basis.errors.InputError` for a speed of zero, and for a stroke that is not positive.
    """
    faults: list[Fault] = []
    if not abs(screw_speed) > 0:
        faults.append(Fault("operation.screw_speed", "is zero: nothing warms up", "0 rpm", "give a speed"))
    if not stroke > 0:
        faults.append(Fault("surroundings.stroke", "must be positive", f"{stroke:g} m", "give half the shaft"))
    raise_if_any(faults)
    speed = abs(float(screw_speed)) * float(screw.lead) / (2 * math.pi)
    first = math.copysign(1.0, screw_speed)
    ways = tuple(
        Segment(name=name, duration=stroke / speed, speed=sign * speed, force=float(axial_load))
        for name, sign in (("forth", first), ("back", -first))
    )
    return duty(model, screw, lubricant, axis=Axis(mass=0.0), motion=Segments(segments=ways), also=also)
