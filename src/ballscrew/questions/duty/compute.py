"""Duty of a case: torque, energy, life, brake and motor over one cycle of its motion."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ballscrew._arrays import lazy
from ballscrew.axis import duty as axis_duty
from ballscrew.axis.axis import Axis
from ballscrew.axis.brake import Brake, brake_of
from ballscrew.axis.cycle_life import CycleLife
from ballscrew.axis.drive import MotorCheck
from ballscrew.axis.duty import Duty
from ballscrew.axis.vendor_rule import VendorRule
from ballscrew.cases.case import Case
from ballscrew.cases.nut_tables import dynamic_rating
from ballscrew.components.nut import OversizeBallNut
from ballscrew.errors import Fault, InputError
from ballscrew.friction.element import FrictionElement
from ballscrew.friction.loaded_balls import loads_of
from ballscrew.friction.result import MECHANISMS
from ballscrew.motion.profiles import Motion
from ballscrew.motion.states import Numbers
from ballscrew.motion.trajectory import HALF_WIDTHS, Trajectory
from ballscrew.overflow import overflow_as_input_error
from ballscrew.quantities import Acceleration, Duration, Energy, Force, Info, Pressure, Quantity, Ratio, Torque
from ballscrew.records import Message
from ballscrew.sizing.checks import NOT_CHECKED, NOT_JUDGED, UNJUDGED, Check, checks
from ballscrew.sizing.speed_limits import speed_limit_of
from ballscrew.solvers.load_distribution import BallLoads, preload_of

DAY = 86400.0
#: The efficiency of the rule of catalogues where the case has a model: that of their worked examples (THK514E).
RULE_EFFICIENCY = 0.9
#: The checks of one operating point that are of speeds and largest loads; those of life are of the whole cycle.
_OF_EXTREMES = (
    "static_safety", "contact_pressure", "shaft_stress", "buckling", "critical_speed", "diameter_speed_product",
)  # fmt: skip
#: Parts of the energy that are rounding, as a share of what is drawn.
_LEAST = 1e-12
_SLUGS = {text: name for name, text in MECHANISMS.items()}
#: Causes of the torque of a motor, for pictures; what is in none of the others is friction outside the balls.
CAUSES = ("acceleration", "gravity", "process", "friction of the balls", "other friction")
_ACCELERATION, _GRAVITY, _PROCESS, _BALLS, _OTHERS = CAUSES
_OF_STORED: Mapping[str, str] = dict(zip(axis_duty.STORED, (_ACCELERATION, _ACCELERATION, _GRAVITY), strict=True))
#: A part of the torque that is rounding, as a share of the largest torque.
_LEAST_TORQUE = 1e-9


def _quantity(name: str, unit: str, symbol: str, meaning: str, shown_in: str = "") -> Quantity:
    return Quantity(name, unit, Info(symbol, meaning, shown_in))


#: The numbers of a cycle.
NUMBERS: Mapping[str, Quantity] = {
    quantity.name: quantity
    for quantity in (
        _quantity("cycle_time", "s", "t_c", "time of a cycle"),
        _quantity("torque_peak", "N m", r"\tau_{max}", "largest torque of the motor"),
        _quantity("torque_rms", "N m", r"\tau_{rms}", "RMS torque of the motor, rests included"),
        _quantity("mean_speed", "rad/s", "n_m", "mean speed of the screw over the cycle", "rpm"),
        _quantity("largest_speed", "rad/s", "n_max", "largest speed of the motor", "rpm"),
        _quantity("power_peak", "W", "P_{max}", "largest power of the motor"),
        _quantity("power_returned_peak", "W", "P_{min}", "largest power that drives the motor"),
        _quantity("energy_drawn", "J", "E_+", "energy that the motor gives in a cycle"),
        _quantity("energy_returned", "J", "E_-", "energy that it takes back"),
        _quantity("energy_lost", "J", "E_f", "energy lost to friction in a cycle"),
        _quantity("energy_of_process", "J", "E_x", "work on the process in a cycle"),
        _quantity("energy_stored", "J", r"\Delta E", "energy stored between start and end of the cycle"),
        _quantity("energy_per_day", "J", "E_d", "energy a day, if nothing is used that comes back", "kW h"),
        _quantity("energy_per_day_with_recovery", "J", "E_r", "energy a day, if all that comes back is used", "kW h"),
        _quantity("mean_load", "N", "F_m", "mean load of the more loaded flank or half"),
        _quantity("mean_load_of_both", "N", "F_a", "mean size of the axial load"),
        _quantity("life_revolutions", "1", "L", "turns that nine of ten outlive"),
        _quantity("life_cycles", "1", "N_c", "cycles that nine of ten outlive"),
        _quantity("life_time", "s", "L_h", "time that nine of ten outlive, cycle after cycle", "h"),
        _quantity("revolutions", "1", "q", "turns of the screw in a cycle"),
    )
}


#: Largest friction torque of the screw, which its oil changes the most.
SCREW_TORQUE = _quantity("screw_torque", "N m", "M_S", "largest friction torque of the screw in the cycle")
#: The numbers that are different in a full bath of oil.
OF_BATH: Mapping[str, Quantity] = {
    **{
        name: NUMBERS[name]
        for name in (
            "torque_peak", "torque_rms", "power_peak", "power_returned_peak", "energy_drawn", "energy_returned",
            "energy_lost",
        )
    },
    "screw_torque": SCREW_TORQUE,
}  # fmt: skip


def slug_of(name: str) -> str:
    """The key of a part of the torque in documents: ``acceleration_of_the_mass``, ``spin``."""
    return _SLUGS.get(name, name.replace(" ", "_"))


def cause_of(name: str) -> str:
    """The cause, of :data:`CAUSES`, that a part of the torque belongs to."""
    if name in _OF_STORED or name == axis_duty.PROCESS:
        return _OF_STORED.get(name, _PROCESS)
    return _BALLS if name in MECHANISMS.values() or name == "efficiency" else _OTHERS


class PhaseNumbers(NamedTuple):
    """Numbers of one phase of a motion; the peak torque has its sign."""

    name: str
    start: Duration
    duration: Duration
    largest_load: Force
    torque_peak: Torque
    torque_rms: Torque
    energy: Energy


class Smoothing(NamedTuple):
    """How a recorded motion was smoothed, and what that does to the RMS torque."""

    samples: int
    #: Samples on either side that the smoothing reaches.
    half_width: int
    #: Standard deviation of one recorded position, m, or speed, m/s.
    noise: float
    #: What is left of it in the acceleration, m/s².
    acceleration_noise: Acceleration
    #: RMS torque with the narrowest smoothing, N m.
    torque_rms_unsmoothed: Torque


@dataclasses.dataclass(frozen=True, eq=False)
class DutyReport:
    """A cycle of a case and what follows from it."""

    case: Case
    axis: Axis
    motion: Motion
    duty: Duty
    life: CycleLife
    rating_source: str
    rule: VendorRule

    @property
    def by_rule(self) -> bool:
        """True where the case asks for the rule of catalogues, and mechanics stands beside it."""
        return self.case.efficiency is not None

    @lazy
    def brake(self) -> Brake:
        """What happens with the motor off."""
        return brake_of(self.duty)

    @lazy
    def motor(self) -> MotorCheck | None:
        """The duty against the motor of the case."""
        if self.case.motor is None:
            return None
        return MotorCheck(self.duty, self.case.motor, self.rule.torque if self.by_rule else None)

    @lazy
    def numbers(self) -> Mapping[str, float]:
        """The numbers of the cycle in SI, as :data:`NUMBERS` has them.

        Torques, and the life by the larger mean load alone, are by the rule of catalogues where the case asks for it;
        energies are always by mechanics.
        """
        duty, life = self.duty, self.life
        torques = self.rule if self.by_rule else duty
        cycles = DAY / duty.states.cycle_time
        found = {
            "cycle_time": duty.states.cycle_time,
            "torque_peak": torques.torque_peak,
            "torque_rms": torques.torque_rms,
            "mean_speed": duty.mean_speed,
            "largest_speed": float(np.max(np.abs(duty.motor_speed))),
            "power_peak": max(float(np.max(duty.power)), 0.0),
            "power_returned_peak": max(float(-np.min(duty.power)), 0.0),
            "energy_drawn": duty.energy_drawn,
            "energy_returned": duty.energy_returned,
            "energy_lost": duty.energy_lost,
            "energy_of_process": duty.energy_of_process,
            "energy_stored": duty.energy_stored,
            "energy_per_day": cycles * duty.energy_drawn,
            "energy_per_day_with_recovery": cycles * (duty.energy_drawn - duty.energy_returned),
            "mean_load": life.mean_load,
            "mean_load_of_both": life.mean_load_of_both,
            "life_revolutions": self.life_revolutions,
            "life_cycles": self.life_cycles,
            "life_time": self.life_time,
            "revolutions": duty.revolutions,
        }
        return {name: float(found[name]) for name in NUMBERS}

    @property
    def flooded_torque(self) -> Torque | None:
        """Largest torque of the motor in a full bath of oil, N m; None for one efficiency, which knows no oil."""
        return None if self.by_rule else self.duty.flooded.torque_peak

    @lazy
    def full_bath(self) -> Mapping[str, float]:
        """The numbers of the cycle that friction changes, in a full bath of oil, as :data:`OF_BATH` has them."""
        duty = self.duty.flooded
        found = {
            "torque_peak": duty.torque_peak,
            "torque_rms": duty.torque_rms,
            "screw_torque": duty.screw_torque,
            "power_peak": max(float(np.max(duty.power)), 0.0),
            "power_returned_peak": max(float(-np.min(duty.power)), 0.0),
            "energy_drawn": duty.energy_drawn,
            "energy_returned": duty.energy_returned,
            "energy_lost": duty.energy_lost,
        }
        return {name: float(found[name]) for name in OF_BATH}

    @lazy
    def motor_torque(self) -> Mapping[str, Torque]:
        """Largest and RMS torque that a motor is chosen by, N m: ``torque_peak`` and ``torque_rms``.

        Where the screw is starved of oil, each is the larger of that with the inlet as it is given and that in a full
        bath of oil; the rule of catalogues knows no oil.
        """
        found = {name: abs(self.numbers[name]) for name in ("torque_peak", "torque_rms")}
        if self.by_rule or not self.duty.starved:
            return found
        return {name: max(torque, self.full_bath[name]) for name, torque in found.items()}

    @property
    def life_revolutions(self) -> Ratio:
        """Turns that nine of ten outlive; by the larger mean load alone where the case asks for the rule."""
        return self.life.revolutions_of_the_worse if self.by_rule else self.life.revolutions

    @property
    def life_cycles(self) -> Ratio:
        """Cycles that nine of ten outlive; NaN where nothing turns."""
        return self.life_revolutions / self.duty.revolutions if self.duty.revolutions else math.nan

    @property
    def life_time(self) -> Duration:
        """Time that nine of ten outlive, cycle after cycle, s."""
        return self.life_cycles * self.duty.states.cycle_time

    @lazy
    def torque_peak_by(self) -> Mapping[str, Torque]:
        """Parts of the torque where it is largest, N m, with the sign of their sum; by mechanics."""
        at = int(np.argmax(np.abs(self.duty.torque)))
        sign = math.copysign(1.0, float(self.duty.torque[at]))
        return {name: sign * float(part[at]) for name, part in self.duty.parts.items()}

    @lazy
    def torque_rms_by(self) -> Mapping[str, Torque]:
        r"""Parts of the RMS torque, N m: :math:`\frac{1}{t_c \tau_{rms}} \int \tau_i \tau dt`; they sum to it.

        What the heat of the motor is paid for. A part that acts against the others is negative.
        """
        states, torque = self.duty.states, self.duty.torque
        scale = states.cycle_time * self.duty.torque_rms
        return {
            name: states.integral(part * torque) / scale if scale else 0.0 for name, part in self.duty.parts.items()
        }

    @lazy
    def torque_by_cause(self) -> Mapping[str, Numbers]:
        """Torque of the motor by cause at each state, N m, by mechanics; causes that are rounding are left out."""
        found: dict[str, Numbers] = {}
        for name, part in self.duty.parts.items():
            cause = cause_of(name)
            found[cause] = found.get(cause, np.zeros_like(self.duty.torque)) + part
        least = _LEAST_TORQUE * self.duty.torque_peak
        return {cause: found[cause] for cause in CAUSES if cause in found and np.any(np.abs(found[cause]) > least)}

    @lazy
    def energy_lost_in(self) -> Mapping[str, Mapping[str, Energy]]:
        """Energy lost in a cycle by element and mechanism, J; parts that are rounding are left out."""
        least = _LEAST * self.duty.energy_drawn
        found = {
            name: {part: energy for part, energy in parts.items() if abs(energy) > least}
            for name, parts in self.duty.energy_lost_in.items()
        }
        return {name: parts for name, parts in found.items() if parts}

    @lazy
    def smoothing(self) -> Smoothing | None:
        """The smoothing of a recorded motion; None for a motion in closed form."""
        motion = self.motion
        if not isinstance(motion, Trajectory):
            return None
        width = motion.chosen_half_width
        raw = dataclasses.replace(self.duty, states=motion.smoothed_by(HALF_WIDTHS[0]).states())
        return Smoothing(
            int(np.size(motion.time)), width, motion.noise, motion.acceleration_noise(width), raw.torque_rms
        )

    @lazy
    def phases(self) -> Sequence[PhaseNumbers]:
        """What each phase of the motion asks of the motor, by mechanics."""
        duty, states = self.duty, self.duty.states
        found: list[PhaseNumbers] = []
        for number, name in enumerate(states.phases):
            own = states.phase == number
            weight, torque = states.weight[own], duty.torque[own]
            duration = float(np.sum(weight))
            found.append(
                PhaseNumbers(
                    name,
                    start=float(states.time[own][0]),
                    duration=duration,
                    largest_load=float(np.max(np.abs(duty.axial_load[own]))),
                    torque_peak=float(torque[np.argmax(np.abs(torque))]),
                    torque_rms=math.sqrt(float(np.sum(weight * torque**2)) / duration) if duration else 0.0,
                    energy=float(np.sum(weight * duty.power[own])),
                )
            )
        return found

    @lazy
    def largest_load(self) -> Force:
        """Largest size of the axial load, N."""
        return float(np.max(np.abs(self.duty.axial_load)))

    @lazy
    def checks(self) -> Sequence[Check]:
        """Checks of the extremes, of the life over the cycle, and of the motor."""
        pressure = self.duty.screw.maximum_pressure
        largest = None if np.isnan(pressure).all() else float(np.nanmax(pressure))
        return (*self._of_extremes(largest), *self._of_life, *(() if self.motor is None else self.motor.checks))

    @lazy
    def checks_by_loads(self) -> Sequence[Check]:
        """The checks that friction has no part in: they cost next to nothing."""
        speed = () if self.motor is None else (self.motor.speed_check,)
        return (
            *(check for check in self._of_extremes(None) if check.name != "contact_pressure"),
            *self._of_life,
            *speed,
        )

    @lazy
    def balls_under_largest_load(self) -> BallLoads:
        """The loads of the balls under the largest load of the cycle, with its sign."""
        load = self.duty.axial_load
        return loads_of(self.case.screw, float(load[np.argmax(np.abs(load))]))

    def _of_extremes(self, pressure: Pressure | None) -> Sequence[Check]:
        case, duty = self.case, self.duty
        nut = case.screw.nut
        nut = nut.changed("preload", self.life.preload) if isinstance(nut, OversizeBallNut) else nut
        mean = self.life.mean_load_of_both
        found = checks(
            case.screw,
            axial_load=0.0 if math.isnan(mean) else min(mean, self.largest_load),
            largest_load=self.largest_load,
            screw_speed=float(np.max(np.abs(duty.screw_speed))),
            nut=nut,
            static_load_rating=case.listed.get("static_load_rating"),
            maximum_pressure=pressure,
            root_diameter=case.listed.get("root_diameter"),
            installation=case.installation,
            limits=case.limits,
            speed_limit=speed_limit_of(case.row),
        )
        return [check for check in found if check.name in _OF_EXTREMES]

    @property
    def _of_life(self) -> Sequence[Check]:
        """Turns and time against the running time that the limits ask for."""
        required, life = self.case.limits.running_time, self.life
        if life.dynamic_load_rating is None:
            missing = "dynamic_load_rating"
            give = NOT_CHECKED.of(input=Message(missing))
            return [Check.saying(give, name, None, None, unit, None, None, missing) for name, unit in _LIFE]
        if not self.duty.revolutions:
            idle = Message("not judged: nothing turns")
            return [Check.saying(idle, name, None, None, unit, None, None) for name, unit in _LIFE]
        found: list[Check] = []
        for (name, unit), value, words in zip(
            _LIFE,
            (float(self.life_revolutions), float(self.life_time)),
            (
                Message("turns that nine of ten outlive, by the mean load over the cycle"),
                Message("time of so many cycles"),
            ),
            strict=True,
        ):
            if required is None:
                missing = "limits.running_time"
                message = UNJUDGED.of(life=words, advice=NOT_JUDGED.of(input=Message(missing)))
                found.append(Check.saying(message, name, value, None, unit, None, None, missing))
                continue
            cycles = required / self.duty.states.cycle_time
            limit = required if unit == "s" else cycles * self.duty.revolutions
            used = limit / value if value else math.inf
            found.append(Check.saying(words, name, value, limit, unit, used, used <= 1))
        return found


_LIFE = (("life", "1"), ("running_time", "s"))


def planned(case: Case, *, recorded: bool = False) -> DutyReport:
    """The duty of a case of which everything is computed when it is asked for; see :func:`duty`."""
    assert case.axis is not None
    assert case.motion is not None
    driver = case.model if case.efficiency is None else case.efficiency
    found = axis_duty.duty(
        driver, case.screw, case.lubricant, axis=case.axis, motion=case.motion, also=beside(case), recorded=recorded
    )
    rating, source = _rating(case)
    preload = float(preload_of(case.screw, case.screw.nut))
    life = CycleLife(found, case.screw.nut, preload, rating)
    rule = VendorRule(found, RULE_EFFICIENCY if case.efficiency is None else case.efficiency)
    return DutyReport(case, case.axis, case.motion, found, life, source, rule)


@overflow_as_input_error()
def duty(case: Case, *, recorded: bool = False) -> DutyReport:
    """The duty of a case with an axis and a motion; ``recorded`` as for :func:`ballscrew.axis.duty.duty`."""
    report = planned(case, recorded=recorded)
    found = report.duty
    if not math.isfinite(found.torque_rms):
        at = found.states.phases[int(found.states.phase[int(np.argmin(np.isfinite(found.torque)))])]
        problem, remedy = "is no number with these inputs", "look at mass, acceleration, oil and temperature"
        raise InputError(Fault("duty.torque", problem, f"in “{at}”", remedy))
    # here, where numbers beyond any float become a fault of the input
    _ = (
        report.numbers,
        report.brake,
        report.checks,
        report.phases,
        report.torque_peak_by,
        report.torque_rms_by,
        report.energy_lost_in,
        report.full_bath,
    )
    _ = (report.life.revolutions, report.smoothing, report.rule.torque_rms, report.rule.torque_peak)
    return report


def beside(case: Case) -> Mapping[str, FrictionElement]:
    """The elements of a case on the shaft beside the screw, by name."""
    return {bearing.name: bearing for bearing in case.bearings.values()}


def _rating(case: Case) -> tuple[float | None, str]:
    try:
        return dynamic_rating(case.screw, case.row, case.listed)
    except InputError:  # of a geometry that no standard has ratings for
        return None, "not known"
