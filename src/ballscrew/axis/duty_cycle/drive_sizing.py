"""A drive against its duty: the life of the screw, the torques and the speed of the motor, and what catalogues compute.

Mean loads and life are of each flank of the screw, or of each half of a preloaded nut, by itself. A motor has a torque
for ever and one for a short time. Torques of the worked examples of catalogues are held against those by mechanics.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from ballscrew.axis.duty_cycle.axis import Motor
from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.quantities import Energy, Force, Ratio, Torque, fields_of
from ballscrew.physics.components.nut import Nut, SingleNut
from ballscrew.physics.equations import life
from ballscrew.physics.friction.validity import FULL_BATH
from ballscrew.physics.sizing.checks import Check

HOUR = 3600.0


def cubic_mean(loads: Numbers, turns: Numbers) -> Force:
    r"""The steady load that tires as much as these, :math:`F_m = \sqrt[3]{\sum q_i F_i^3 / \sum q_i}`, N.

    ISO3408-5 as recalled; the weights are turns and not times. NaN without any turn.
    """
    total = float(np.sum(turns))
    return float(np.sum(turns * np.abs(loads) ** 3) / total) ** (1 / 3) if total else math.nan


@dataclasses.dataclass(frozen=True, eq=False)
class CycleLife(ByValue):
    """Mean loads and life of a cycle.

    Without preload a load of one sign presses one flank of the thread, and the flank rests while the load has the other
    sign. With preload both halves are loaded all the time, by the formula of ISO3408-5
    (:func:`~ballscrew.physics.sizing.checks.loads_of_halves`). Turns count for all, loaded or not.
    """

    duty: Duty
    nut: Nut
    #: The axial preload, N; zero of a nut without.
    preload: Force
    #: That of one nut body or half, N; None where it is not known.
    dynamic_load_rating: Force | None = None
    #: Factor on the loads for shocks; THK514E has 1 to 1.2 for smooth motion, up to 3.5 for strong vibrations.
    load_factor: Ratio = 1.0

    @lazy
    def turns(self) -> Numbers:
        """Turns of the screw for which each state stands."""
        return self.duty.states.weight * np.abs(self.duty.screw_speed) / (2 * math.pi)

    @lazy
    def flank_loads(self) -> Mapping[str, Numbers]:
        """Axial force on each flank, or half, at the states, N."""
        load = self.duty.axial_load
        pressed = {"against positive motion": np.maximum(load, 0.0), "with positive motion": np.maximum(-load, 0.0)}
        if isinstance(self.nut, SingleNut) or not self.preload:
            return pressed
        size = np.abs(load)
        relieved = life.relieved_half_load(self.preload, life.preload_release(size, self.preload))
        return {name: np.where(part > 0, size + relieved, relieved) for name, part in pressed.items()}

    @lazy
    def mean_loads(self) -> Mapping[str, Force]:
        """Mean load of each flank, or half, over all turns of the cycle, N."""
        return {name: cubic_mean(loads, self.turns) for name, loads in self.flank_loads.items()}

    @property
    def mean_load(self) -> Force:
        """The larger of the two mean loads, N: what catalogues compute (THKGeneral)."""
        return max(self.mean_loads.values())

    @lazy
    def mean_load_of_both(self) -> Force:
        """Mean of the sizes of the axial load over all turns, N, without regard to its sign and to the preload."""
        return cubic_mean(self.duty.axial_load, self.turns)

    @lazy
    def lives(self) -> Mapping[str, Ratio]:
        """Basic rating life L10 of each flank or half, revolutions; infinite for one that is never loaded."""
        if self.dynamic_load_rating is None:
            return {}
        rated = self.dynamic_load_rating
        loads = {name: self.load_factor * load for name, load in self.mean_loads.items()}
        return {name: math.inf if load == 0 else life.basic_life(rated, load) for name, load in loads.items()}

    @property
    def revolutions(self) -> Ratio:
        """Basic rating life L10 by both flanks or halves, revolutions (ISO3408-5); NaN without a rating."""
        if not self.lives or any(math.isnan(each) for each in self.lives.values()):
            return math.nan
        worst = min(self.lives.values())
        return worst if math.isinf(worst) else float(life.combined_life(*self.lives.values()))

    @property
    def revolutions_of_the_worse(self) -> Ratio:
        """Turns by the larger mean load alone (THKGeneral); NaN without a rating."""
        values = [*self.lives.values()]
        return math.nan if any(map(math.isnan, values)) else min(values, default=math.nan)

    @property
    def cycles(self) -> Ratio:
        """Basic rating life L10 in cycles."""
        return self.revolutions / self.duty.revolutions if self.duty.revolutions else math.nan

    @property
    def time(self) -> Ratio:
        """Basic rating life L10h with one cycle after the other, s."""
        return self.cycles * self.duty.states.cycle_time


_LARGEST_SPEED = fields_of(Motor)["largest_speed"]


#: The condition of the track of balls that a torque is of, where both are judged.
AS_GIVEN = "starved of oil"


@dataclasses.dataclass(frozen=True, eq=False)
class MotorCheck(ByValue):
    """A duty against a motor.

    Where the screw is starved of oil (:attr:`~ballscrew.axis.duty_cycle.duty.Duty.starved`), its torque in a full bath
    is judged as well, and the larger counts.
    """

    duty: Duty
    motor: Motor
    #: The torque that is checked, N m; None for that of the duty.
    by_rule: Numbers | None = None

    @property
    def torque(self) -> Numbers:
        """Torque of the motor, N m, with the inlet as it is given."""
        return self.duty.torque if self.by_rule is None else self.by_rule

    @lazy
    def torques(self) -> Mapping[str, Numbers]:
        """The torques that are judged, N m, by the condition of the track; one without a name where nothing starves."""
        if self.by_rule is not None or not self.duty.starved:
            return {"": self.torque}
        return {AS_GIVEN: self.torque, FULL_BATH: self.duty.flooded.torque}

    @lazy
    def utilisation(self) -> Numbers:
        """Largest torque over the peak torque at the speed of each state; infinite beyond the largest speed."""
        peak = self.motor.peak_at(self.duty.motor_speed)
        size = np.max(np.abs(list(self.torques.values())), axis=0)
        return np.where(peak > 0, size / np.where(peak > 0, peak, 1.0), np.where(size > 0, math.inf, 0.0))

    @lazy
    def worst(self) -> int:
        """The state whose torque comes nearest to the peak torque at its speed."""
        return int(np.argmax(self.utilisation))

    @lazy
    def worst_torque(self) -> tuple[str, float]:
        """The condition of the track that counts in that state, and the torque there, N m."""
        values = {condition: float(torque[self.worst]) for condition, torque in self.torques.items()}
        condition = max(values, key=lambda name: abs(values[name]))
        return condition, values[condition]

    @lazy
    def worst_rms(self) -> tuple[str, float]:
        """The condition of the track that has the larger RMS torque, and that torque, N m."""
        states = self.duty.states
        values = {
            condition: math.sqrt(states.integral(torque**2) / states.cycle_time)
            for condition, torque in self.torques.items()
        }
        condition = max(values, key=lambda name: values[name])
        return condition, values[condition]

    @lazy
    def copper_loss(self) -> Energy | None:
        r"""Heat of the current in a cycle, :math:`R \int (\tau/K_t)^2 dt`, J; None without constant or resistance."""
        return self._copper_loss(self.torque)

    @lazy
    def flooded_copper_loss(self) -> Energy | None:
        """The same in a full bath of oil."""
        return self._copper_loss(self.torque if self.by_rule is not None else self.duty.flooded.torque)

    def _copper_loss(self, torque: Numbers) -> Energy | None:
        K_t, R = self.motor.torque_constant, self.motor.resistance
        if K_t is None or R is None:
            return None
        return self.duty.states.integral(R * (torque / K_t) ** 2)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Torque for ever, torque for a short time and speed, each against what the motor gives."""
        at, motor = self.worst, self.motor
        speed = self.speed_check.value
        assert speed is not None
        name = self.duty.states.phases[int(self.duty.states.phase[at])]
        peak = float(motor.peak_at(self.duty.motor_speed[at : at + 1])[0])
        rms_where, rms = self.worst_rms
        where, largest = self.worst_torque
        of_rms = _of(rms_where, "RMS torque, rests included, against the rated torque")
        of_peak = _of(where, f"torque against the curve of the motor, worst in “{name}”")
        if speed > motor.largest_speed:
            of_peak = (
                f"the motor has no torque above {units.shown(motor.largest_speed, _LARGEST_SPEED)}, where its "
                f"curve ends; the cycle needs {units.shown(speed, _LARGEST_SPEED)}"
            )
        return (
            Check.at_most(of_rms, "motor_rms_torque", rms, motor.rated_torque, "N m"),
            Check.at_most(of_peak, "motor_peak_torque", abs(largest), peak, "N m"),
            self.speed_check,
        )

    @property
    def speed_check(self) -> Check:
        """Speed against the largest of the motor: it knows no torque."""
        speed = float(np.max(np.abs(self.duty.motor_speed)))
        message = "speed of the motor against its largest"
        return Check.at_most(message, "motor_speed", speed, self.motor.largest_speed, "rad/s")


def _of(condition: str, message: str) -> str:
    """A message, and the condition of the track that it is of."""
    return f"{message}, {condition}" if condition else message


@dataclasses.dataclass(frozen=True, eq=False)
class VendorRule(ByValue):
    r"""The rule of THK514E (selection of the motor) for the torque of a duty.

    .. math:: \tau = \frac{F P_h}{2 \pi \eta} + \left(J + m \left(\frac{P_h}{2 \pi}\right)^2\right) \alpha

    F has weight, process and friction of the guides, but no inertia: the mass is an inertia of its own, for which the
    efficiency does not count. The force is divided by the efficiency also where it drives the screw, so that a load
    which is lowered asks for more torque than it can give: mechanics has :math:`F P_h/2\pi (2 - 1/\eta)`. At rest
    the friction of the guides helps to hold.
    """

    duty: Duty
    efficiency: Ratio

    @lazy
    def force(self) -> Numbers:
        """Force along the axis without inertia, N."""
        loads = self.duty.loads
        steady = loads.gravity + loads.process
        held = self.duty.axis.resting_guide_friction
        rests = self.duty.states.direction == 0
        left = np.sign(steady) * np.maximum(np.abs(steady) - held, 0.0)
        return np.where(rests, left, steady + loads.guides + loads.guide_seals)

    @lazy
    def torque(self) -> Numbers:
        """Torque of the motor, N m."""
        axis, lead = self.duty.axis, float(self.duty.driven.lead)
        arm = lead / (2 * math.pi) / axis.transmission_ratio
        inertia = axis.turning_inertia + axis.moving_mass * arm**2
        rubs = sum(self.duty.support_friction.values(), np.zeros_like(self.force))
        friction = self.duty.states.direction * rubs / axis.transmission_ratio
        turned = self.force * arm / self.efficiency + friction
        held = np.where((self.duty.states.direction == 0) & axis.brake_holds, 0.0, turned)
        return held / axis.transmission_efficiency + inertia * self.duty.states.acceleration / arm

    @lazy
    def torque_rms(self) -> Torque:
        """Root mean square of the torque, N m."""
        return math.sqrt(self.duty.states.integral(self.torque**2) / self.duty.states.cycle_time)

    @property
    def torque_peak(self) -> Torque:
        """Largest size of the torque, N m."""
        return float(np.max(np.abs(self.torque)))
