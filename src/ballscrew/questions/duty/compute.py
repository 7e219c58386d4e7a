"""Duty of a case: torque, energy, life, brake and motor over one cycle of its motion."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, Literal

import numpy as np

from ballscrew.axis.duty_cycle import duty as axis_duty
from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.brake import Brake, brake_of
from ballscrew.axis.duty_cycle.drive_sizing import CycleLife, MotorCheck, VendorRule
from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.profiles import Motion
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.motion.trajectory import HALF_WIDTHS, Trajectory
from ballscrew.basis.arrays import lazy
from ballscrew.basis.errors import Fault, InputError, overflow_as_input_error
from ballscrew.basis.quantities import (
    AngularSpeed,
    Duration,
    Energy,
    Force,
    Info,
    Power,
    Pressure,
    Quantity,
    Ratio,
    Torque,
    Unit,
    quantities_of,
)
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.nut_tables import dynamic_rating
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.across_groove import in_motion
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.loaded_balls import loads_of
from ballscrew.physics.sizing.checks import NOT_CHECKED, NOT_JUDGED, UNJUDGED, Check, checks
from ballscrew.physics.sizing.makers_tables import speed_limit_of
from ballscrew.physics.solvers.load_distribution import BallLoads, preload_of
from ballscrew.questions.duty.parts import (
    TORQUE_PEAK,
    TORQUE_RMS,
    Catalogue,
    Cycle,
    FlankChange,
    Life,
    Mechanics,
    MotorCurve,
    MotorUse,
    PhaseNumbers,
    PositionSmoothing,
    Rules,
    ShortReversal,
    SpeedSmoothing,
    WorstState,
    short_reversal,
)
from ballscrew.questions.shared.declared import LEFT_OUT, Declared, from_attributes, part, table_of

DAY = 86400.0
#: States of a cycle in a document; of more, each second, third … one: all of them are in a table in a file.
MOST_STATES = 2000
_SCREW_TORQUE = Info("M_S", "largest friction torque of the screw in the cycle")
#: The efficiency of the rule of catalogues where the case has a model: that of their worked examples (THK514E).
RULE_EFFICIENCY = 0.9
#: The checks of one operating point that are of the whole cycle here; the others are of speeds and largest loads.
_OF_CYCLE = ("life", "running_time")
#: Parts of the energy that are rounding, as a share of what is drawn, and loads, as one of the largest.
_LEAST = 1e-12
#: A load in a recorded motion that is noise, as a share of the largest.
_NOISE = 0.01
_SLUGS = {text: name for name, text in MECHANISMS.items()}
#: Causes of the torque of a motor, for pictures; what is in none of the others is friction outside the balls.
CAUSES = ("acceleration", "gravity", "process", "friction of the balls", "other friction")
_ACCELERATION, _GRAVITY, _PROCESS, _BALLS, _OTHERS = CAUSES
_OF_STORED: Mapping[str, str] = dict(zip(axis_duty.STORED, (_ACCELERATION, _ACCELERATION, _GRAVITY), strict=True))
#: A part of the torque that is rounding, as a share of the largest torque.
_LEAST_TORQUE = 1e-9


def slug_of(name: str) -> str:
    """The key of a part of the torque in documents: ``acceleration_of_the_mass``, ``spin``."""
    return _SLUGS.get(name, name.replace(" ", "_"))


def words_of(slug: str) -> str:
    """A part of the torque, or an element, in words."""
    return MECHANISMS.get(slug, slug.replace("_", " "))


def cause_of(name: str) -> str:
    """The cause, of :data:`CAUSES`, that a part of the torque belongs to."""
    if name in _OF_STORED or name == axis_duty.PROCESS:
        return _OF_STORED.get(name, _PROCESS)
    return _BALLS if name in MECHANISMS.values() or name == "efficiency" else _OTHERS


@dataclasses.dataclass(frozen=True, eq=False)
class CycleNumbers(Declared):
    """The numbers of a cycle, each declared and computed here, in the order in which they are shown.

    Torques, and the life by the larger mean load alone, are by the rule of catalogues where the case asks for it;
    energies are always by mechanics. A new number is one property: terminal, JSON, its schema, tables, report and page
    have it from here.
    """

    case: Case
    axis: Axis
    motion: Motion
    duty: Duty
    cycle_life: CycleLife
    rating_source: str
    rule: VendorRule

    @property
    def by_rule(self) -> bool:
        """True where the case asks for the rule of catalogues, and mechanics stands beside it."""
        return self.case.efficiency is not None

    @property
    def _torques(self) -> VendorRule | Duty:
        return self.rule if self.by_rule else self.duty

    @property
    def _cycles_a_day(self) -> float:
        return DAY / self.duty.states.cycle_time

    @part
    def cycle_time(self) -> Annotated[Duration, Info("t_c", "time of a cycle")]:
        """Time from the start of a cycle to that of the next."""
        return self.duty.states.cycle_time

    @part
    def torque_peak(self) -> Annotated[Torque, TORQUE_PEAK]:
        """Value by the rule of catalogues where the case asks for it."""
        return self._torques.torque_peak

    @part
    def torque_rms(self) -> Annotated[Torque, TORQUE_RMS]:
        """Value by the rule of catalogues where the case asks for it."""
        return self._torques.torque_rms

    @part
    def mean_speed(self) -> Annotated[AngularSpeed, Info("n_m", "mean speed of the screw over the cycle", "rpm")]:
        """Mean of the size of the speed of the screw."""
        return self.duty.mean_speed

    @part
    def largest_speed(self) -> Annotated[AngularSpeed, Info("n_max", "largest speed of the motor", "rpm")]:
        """Largest size of the speed of the motor."""
        return float(np.max(np.abs(self.duty.motor_speed)))

    @part
    def power_peak(self) -> Annotated[Power, Info("P_{max}", "largest power of the motor")]:
        """Largest power that the motor gives; zero where it gives none."""
        return max(float(np.max(self.duty.power)), 0.0)

    @part
    def power_returned_peak(self) -> Annotated[Power, Info("P_{min}", "largest power that drives the motor")]:
        """Largest power that the motor takes back; zero where it takes none."""
        return max(float(-np.min(self.duty.power)), 0.0)

    @part
    def energy_drawn(self) -> Annotated[Energy, Info("E_+", "energy that the motor gives in a cycle")]:
        """Integral of the power of the motor where it is positive."""
        return self.duty.energy_drawn

    @part
    def energy_returned(self) -> Annotated[Energy, Info("E_-", "energy that it takes back")]:
        """Integral of the power of the motor where it is negative, as a positive number."""
        return self.duty.energy_returned

    @part
    def energy_lost(self) -> Annotated[Energy, Info("E_f", "energy lost to friction in a cycle")]:
        """All friction of the axis, over the cycle."""
        return self.duty.energy_lost

    @part
    def energy_of_process(self) -> Annotated[Energy, Info("E_x", "work on the process in a cycle")]:
        """Work of the axis against the force of the process."""
        return self.duty.energy_of_process

    @part
    def energy_stored(self) -> Annotated[Energy, Info(r"\Delta E", "energy stored between start and end of the cycle")]:
        """Not zero where a cycle does not end where it began."""
        return self.duty.energy_stored

    @part
    def energy_per_day(
        self,
    ) -> Annotated[Energy, Info("E_d", "energy a day, if nothing is used that comes back", "kW h")]:
        """Energy drawn, cycle after cycle."""
        return self._cycles_a_day * self.duty.energy_drawn

    @part
    def energy_per_day_with_recovery(
        self,
    ) -> Annotated[Energy, Info("E_r", "energy a day, if all that comes back is used", "kW h")]:
        """Energy drawn less that returned, cycle after cycle."""
        return self._cycles_a_day * (self.duty.energy_drawn - self.duty.energy_returned)

    @part
    def mean_load(self) -> Annotated[Force, Info("F_m", "mean load of the more loaded flank or half")]:
        """Cubic mean over the turns."""
        return self.cycle_life.mean_load

    @part
    def mean_load_of_both(self) -> Annotated[Force, Info("F_a", "mean size of the axial load")]:
        """Cubic mean over the turns, without regard to sign and preload."""
        return self.cycle_life.mean_load_of_both

    @part
    def life_revolutions(self) -> Annotated[Ratio, Info("L", "basic rating life L10 in revolutions")]:
        """Value by the larger mean load alone where the case asks for the rule of catalogues."""
        life = self.cycle_life
        return life.revolutions_of_the_worse if self.by_rule else life.revolutions

    @part
    def life_cycles(self) -> Annotated[Ratio, Info("N_c", "basic rating life L10 in cycles")]:
        """NaN where nothing turns."""
        turns = self.duty.revolutions
        return self.life_revolutions / turns if turns else math.nan

    @part
    def life_time(self) -> Annotated[Duration, Info("L_h", "basic rating life L10h, cycle after cycle", "h")]:
        """Cycles of the life, each as long as the cycle."""
        return self.life_cycles * self.cycle_time

    @part
    def revolutions(self) -> Annotated[Ratio, Info("q", "turns of the screw in a cycle")]:
        """Turns both ways."""
        return self.duty.revolutions


#: The numbers of a cycle, and those that are different in a full bath of oil.
NUMBERS: Mapping[str, Quantity] = quantities_of(CycleNumbers)
OF_BATH: Mapping[str, Quantity] = {
    **{
        name: NUMBERS[name]
        for name in (
            "torque_peak",
            "torque_rms",
            "power_peak",
            "power_returned_peak",
            "energy_drawn",
            "energy_returned",
            "energy_lost",
        )
    },
    "screw_torque": Quantity("screw_torque", "N m", _SCREW_TORQUE),
}


class FullBath(table_of(OF_BATH)):
    """Numbers of the cycle in a full bath of oil."""


@dataclasses.dataclass(frozen=True, eq=False)
class DutyReport(CycleNumbers):
    """The results of a cycle of an axis."""

    @lazy
    def numbers(self) -> Mapping[str, float]:
        """The numbers of the cycle in SI, as :class:`CycleNumbers` declares them."""
        return {name: float(getattr(self, name)) for name in NUMBERS}

    @part
    def torque_by(self) -> Literal["rule", "mechanics"]:
        """Basis of the torques above: mechanics, or the rule of catalogues where the case asks for it."""
        return "rule" if self.by_rule else "mechanics"

    @part
    def torque_peak_by(self) -> Mapping[str, Torque]:
        """Parts of the peak torque.

        They are those where it is largest, with the sign of their sum; by mechanics.
        """
        at = int(np.argmax(np.abs(self.duty.torque)))
        sign = math.copysign(1.0, float(self.duty.torque[at]))
        return {slug_of(name): sign * float(values[at]) for name, values in self.duty.parts.items()}

    @part
    def torque_rms_by(self) -> Mapping[str, Torque]:
        r"""Parts of the RMS torque.

        :math:`\frac{1}{t_c \tau_{rms}} \int \tau_i \tau dt`: they sum to it, and share out the heat of the
        motor. A part that acts against the others is negative.
        """
        states, torque = self.duty.states, self.duty.torque
        scale = states.cycle_time * self.duty.torque_rms
        return {
            slug_of(name): states.integral(values * torque) / scale if scale else 0.0
            for name, values in self.duty.parts.items()
        }

    @part
    def inertia_by(
        self,
    ) -> Annotated[Mapping[str, float], Unit("kg m^2"), Info("J", "moment of inertia at the motor")]:
        """Moment of inertia of each part that turns."""
        return _by_slug(self.axis.inertia_by)

    @part
    def energy_by(self) -> Mapping[str, Energy]:
        """Energy of a cycle by cause."""
        return _by_slug(self.duty.energy_by)

    @part
    def energy_lost_by(self) -> Mapping[str, Energy]:
        """Energy lost in a cycle by mechanism."""
        return _by_slug(self.duty.energy_lost_by)

    @part
    def energy_lost_in(
        self,
    ) -> Annotated[Mapping[str, Mapping[str, float]], Unit("J"), Info("E_f", "energy lost by element and mechanism")]:
        """Without parts that are rounding."""
        least = _LEAST * self.duty.energy_drawn
        lost = {
            slug_of(name): _by_slug({cause: energy for cause, energy in parts.items() if abs(energy) > least})
            for name, parts in self.duty.energy_lost_in.items()
        }
        return {name: parts for name, parts in lost.items() if parts}

    @part
    def heat_by_element(self) -> Mapping[str, Power]:
        """Mean heat of each element over the cycle."""
        return _by_slug(self.duty.heat)

    @part
    def screw_torque(self) -> Annotated[Torque, _SCREW_TORQUE]:
        """Largest friction torque of the screw, which its oil changes the most."""
        return self.duty.screw_torque

    @part
    def flooded_torque(self) -> Torque | None:
        """Largest torque of the motor in a full bath of oil; null for one efficiency."""
        return None if self.by_rule else self.duty.flooded.torque_peak

    @part
    def full_bath(self) -> FullBath | None:
        """Numbers of the cycle in a full bath of oil; null for one efficiency, which knows no oil."""
        return None if self.by_rule else FullBath(**{name: float(getattr(self.bath, name)) for name in OF_BATH})

    @lazy
    def bath(self) -> DutyReport:
        """The same cycle in a full bath of oil."""
        return dataclasses.replace(self, duty=self.duty.flooded)

    @lazy
    def motor_torque(self) -> Mapping[str, Torque]:
        """Largest and RMS torque that a motor is chosen by, N m: ``torque_peak`` and ``torque_rms``.

        Where the screw is starved of oil, each is the larger of that with the inlet as it is given and that in a full
        bath of oil; the rule of catalogues knows no oil.
        """
        torques = {name: abs(self.numbers[name]) for name in ("torque_peak", "torque_rms")}
        if self.by_rule or not self.duty.starved:
            return torques
        return {name: max(torque, self.bath.numbers[name]) for name, torque in torques.items()}

    @part
    def largest_load(self) -> Force:
        """Largest size of the axial load."""
        return float(np.max(np.abs(self.duty.axial_load)))

    @part
    def maximum_pressure(self) -> Pressure:
        """Largest contact pressure."""
        return _extreme(np.fmax.reduce, self._in_motion(self.duty.screw.maximum_pressure))

    @part
    def minimum_film_parameter(self) -> Ratio:
        """Least film parameter in motion."""
        return _extreme(np.fmin.reduce, self._in_motion(self.duty.screw.film_parameter))

    @part
    def valid(self) -> bool:
        """True where the model holds in all states in motion."""
        return bool(np.all(self._in_motion(self.duty.screw.valid)))

    def _in_motion(self, values: Numbers) -> Numbers:
        """Those of the states in motion."""
        return values[self.duty.states.direction != 0]

    @part
    def life(self) -> Life:
        """Mean loads and life over the cycle."""
        life = self.cycle_life
        loads, lives = _by_slug(life.mean_loads), _by_slug(life.lives)
        return from_attributes(Life, life, rating_source=self.rating_source, mean_loads=loads, lives=lives)

    @part
    def brake(self) -> Brake:
        """Behaviour of the axis with its motor off."""
        motor = self.case.motor
        held = 0.0 if motor is None or motor.holding_torque is None else float(motor.holding_torque)
        return brake_of(self.duty, motor_torque=held)

    @lazy
    def motor_check(self) -> MotorCheck | None:
        """The duty against the motor of the case."""
        if self.case.motor is None:
            return None
        return MotorCheck(self.duty, self.case.motor, self.rule.torque if self.by_rule else None)

    @part
    def motor(self) -> Annotated[MotorUse | None, LEFT_OUT]:
        """The cycle against the motor, where there is one."""
        return None if self.motor_check is None else _motor_use(self.motor_check)

    @part
    def rules(self) -> Rules:
        """The torque of the motor by mechanics and by the rule of catalogues."""
        return Rules(from_attributes(Mechanics, self.duty), from_attributes(Catalogue, self.rule))

    @part
    def phases(self) -> Sequence[PhaseNumbers]:
        """Demands of each phase of the motion on the motor."""
        duty, states = self.duty, self.duty.states
        phases: list[PhaseNumbers] = []
        for number, name in enumerate(states.phases):
            own = states.phase == number
            weight, torque = states.weight[own], duty.torque[own]
            duration = float(np.sum(weight))
            phases.append(
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
        return phases

    @part
    def flank_changes(self) -> Sequence[FlankChange]:
        """Changes of the load's sign; the nut loses its play there, and none where it is preloaded.

        What friction winds up in shaft and bearings comes on top: ``ballscrew axis``. In a recorded motion a load below
        a hundredth of the largest is noise.
        """
        least = _NOISE if isinstance(self.motion, Trajectory) else _LEAST
        lost, names = float(getattr(self.case.screw.nut, "axial_play", 0.0)), self.duty.states.phases
        return [
            FlankChange(time, position, names[phase], lost) for time, position, phase in self.duty.load_reversals(least)
        ]

    @part
    def cycle(self) -> Cycle:
        """The states over time."""
        duty, states = self.duty, self.duty.states
        every = -(-len(states.time) // MOST_STATES)

        def some(values: Any) -> list[float]:
            return values[::every].tolist()

        return Cycle(
            every,
            *map(some, (states.time, states.position, states.speed, states.acceleration)),
            *map(some, (duty.axial_load, duty.motor_speed, duty.torque, duty.power)),
            flooded_torque=some(duty.flooded.torque) if duty.starved else None,
            torque_by={slug_of(cause): some(torque) for cause, torque in self.torque_by_cause.items()},
        )

    @part
    def smoothing(self) -> Annotated[PositionSmoothing | SpeedSmoothing | None, LEFT_OUT]:
        """Smoothing of a recorded motion."""
        motion = self.motion
        if not isinstance(motion, Trajectory):
            return None
        width = motion.chosen_half_width
        raw = dataclasses.replace(self.duty, states=motion.smoothed_by(HALF_WIDTHS[0]).states())
        kind = SpeedSmoothing if motion.position is None else PositionSmoothing
        return kind(int(np.size(motion.time)), width, motion.noise, motion.acceleration_noise(width), raw.torque_rms)

    @part
    def operating_points(self) -> int:
        """Operating points of the screw for which the model was evaluated."""
        return self.duty.screw.points

    @lazy
    def torque_by_cause(self) -> Mapping[str, Numbers]:
        """Torque of the motor by cause at each state, N m, by mechanics; causes that are rounding are left out."""
        numbers: dict[str, Numbers] = {}
        for name, torque in self.duty.parts.items():
            cause = cause_of(name)
            numbers[cause] = numbers.get(cause, np.zeros_like(self.duty.torque)) + torque
        least = _LEAST_TORQUE * self.duty.torque_peak
        return {
            cause: numbers[cause] for cause in CAUSES if cause in numbers and np.any(np.abs(numbers[cause]) > least)
        }

    @lazy
    def short_reversal(self) -> ShortReversal | None:
        """The shortest stroke, where the friction of the screw does not come back within it after a reversal.

        Not of a recorded motion, whose noise turns round by itself.
        """
        return None if isinstance(self.motion, Trajectory) else short_reversal(self.case, self.duty)

    @lazy
    def checks(self) -> Sequence[Check]:
        """Checks of the extremes, of the life over the cycle, and of the motor."""
        pressure = self.duty.screw.maximum_pressure
        largest = None if np.isnan(pressure).all() else float(np.nanmax(pressure))
        return (
            *self._of_extremes(largest),
            *self._of_life,
            *(() if self.motor_check is None else self.motor_check.checks),
        )

    @lazy
    def checks_by_loads(self) -> Sequence[Check]:
        """The checks that friction has no part in: they cost next to nothing."""
        speed = () if self.motor_check is None else (self.motor_check.speed_check,)
        return (
            *(check for check in self._of_extremes(None) if check.name != "contact_pressure"),
            *self._of_life,
            *speed,
        )

    @lazy
    def balls_under_largest_load(self) -> BallLoads:
        """The loads of the balls under the largest load of the cycle, with its sign."""
        return loads_of(self.screw_in_motion, self.signed_largest_load)

    @property
    def screw_in_motion(self) -> BallScrew:
        """The screw with the preload that it has at the mean speed of the cycle, where it was set at rest."""
        return _in_motion(self.case, self.duty)

    @property
    def signed_largest_load(self) -> Force:
        """The axial load of the largest size, N, with its sign."""
        load = self.duty.axial_load
        return float(load[np.argmax(np.abs(load))])

    def _of_extremes(self, pressure: Pressure | None) -> Sequence[Check]:
        case, duty = self.case, self.duty
        nut = case.screw.nut
        nut = nut.changed("preload", self.cycle_life.preload) if isinstance(nut, OversizeBallNut) else nut
        mean = self.cycle_life.mean_load_of_both
        result = checks(
            case.screw,
            axial_load=0.0 if math.isnan(mean) else min(mean, self.largest_load),
            largest_load=self.largest_load,
            screw_speed=float(np.max(np.abs(duty.screw_speed))),
            nut=nut,
            static_load_rating=case.origins.listed.get("static_load_rating"),
            maximum_pressure=pressure,
            root_diameter=case.origins.listed.get("root_diameter"),
            installation=case.installation,
            limits=case.limits,
            speed_limit=speed_limit_of(case.origins.row),
        )
        return [check for check in result if check.name not in _OF_CYCLE]

    @property
    def _of_life(self) -> Sequence[Check]:
        """Turns and time against the running time that the limits ask for."""
        required, life = self.case.limits.running_time, self.cycle_life
        if life.dynamic_load_rating is None:
            missing = "dynamic_load_rating"
            give = NOT_CHECKED.format(input=missing)
            return [Check.saying(give, name, None, None, unit, None, None, missing) for name, unit in _LIFE]
        if not self.duty.revolutions:
            idle = "not judged: nothing turns"
            return [Check.saying(idle, name, None, None, unit, None, None) for name, unit in _LIFE]
        result: list[Check] = []
        for (name, unit), value, words in zip(
            _LIFE,
            (float(self.life_revolutions), float(self.life_time)),
            (
                "basic rating life L10 by the mean load over the cycle",
                "time of so many cycles",
            ),
            strict=True,
        ):
            if required is None:
                missing = "limits.running_time"
                message = UNJUDGED.format(life=words, advice=NOT_JUDGED.format(input=missing))
                result.append(Check.saying(message, name, value, None, unit, None, None, missing))
                continue
            cycles = required / self.duty.states.cycle_time
            limit = required if unit == "s" else cycles * self.duty.revolutions
            used = limit / value if value else math.inf
            result.append(Check.saying(words, name, value, limit, unit, used, used <= 1))
        return result


_LIFE = (("life", "1"), ("running_time", "s"))


#: Energies that are zero in most cycles, and shown only where they are not.
IF_ANY = ("energy_of_process", "energy_stored")


def _motor_use(against: MotorCheck) -> MotorUse:
    duty, motor, at, (condition, torque) = against.duty, against.motor, against.worst, against.worst_torque
    largest = float(motor.largest_speed)
    speeds = [0.0, *(speed for speed, _ in motor.curve if 0 < speed < largest), largest]
    return from_attributes(
        MotorUse,
        against,
        suffices=all(check.holds is not False for check in against.checks),
        utilisation=float(against.utilisation[at]),
        worst=WorstState(
            duty.states.phases[int(duty.states.phase[at])], torque, condition or None, float(duty.motor_speed[at])
        ),
        curve=MotorCurve(speeds, motor.peak_at(np.array(speeds)).tolist(), float(motor.rated_torque)),
    )


def _by_slug(parts: Mapping[str, Any]) -> dict[str, float]:
    return {slug_of(name): float(value) for name, value in parts.items()}


def _extreme(end: Any, values: Any) -> float:
    return float(end(values)) if values.size else float("nan")


def planned(case: Case) -> DutyReport:
    """The duty of a case of which everything is computed when it is asked for; see :func:`duty`."""
    return _report(case, axis_duty.cycle, recorded=False)


def _report(case: Case, cycle: Callable[..., axis_duty.Duty], *, recorded: bool) -> DutyReport:
    axis = case.turning_axis
    assert axis is not None
    assert case.motion is not None
    driver = case.model if case.efficiency is None else case.efficiency
    result = cycle(
        driver, case.screw, case.lubricant, axis=axis, motion=case.motion, also=case.bearings_by_name, recorded=recorded
    )
    rating, source = _rating(case)
    screw = _in_motion(case, result)
    life = CycleLife(result, screw.nut, float(preload_of(screw, screw.nut)), rating)
    rule = VendorRule(result, RULE_EFFICIENCY if case.efficiency is None else case.efficiency)
    return DutyReport(case, axis, case.motion, result, life, source, rule)


def _in_motion(case: Case, result: axis_duty.Duty) -> BallScrew:
    """The screw with the preload that it has at the mean speed of the cycle, where it was set at rest."""
    speed = np.abs(result.screw_speed)
    if case.efficiency is not None or not case.screw.nut.set_at_rest or not np.any(speed > 0):
        return case.screw
    mean = float(np.mean(speed[speed > 0]))
    return in_motion(case.model, case.screw, case.lubricant, OperatingState(0.0, mean, None))


@overflow_as_input_error()
def duty(case: Case, *, recorded: bool = False) -> DutyReport:
    """The duty of a case with an axis and a motion; ``recorded`` as for :func:`ballscrew.axis.duty_cycle.duty.duty`."""
    report = _report(case, axis_duty.duty, recorded=recorded)
    result = report.duty
    if not math.isfinite(result.torque_rms):
        at = result.states.phases[int(result.states.phase[int(np.argmin(np.isfinite(result.torque)))])]
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
        report.bath.numbers,
    )
    _ = (report.cycle_life.revolutions, report.smoothing, report.rule.torque_rms, report.rule.torque_peak)
    return report


def _rating(case: Case) -> tuple[float | None, str]:
    try:
        return dynamic_rating(case.screw, case.origins.row, case.origins.listed)
    except InputError:  # of a geometry that no standard has ratings for
        return None, "not known"
