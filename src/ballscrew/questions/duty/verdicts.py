"""Verdicts and warnings of a duty: brake, motor and checks; motions that do not close, jump, or are too short."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.drive_sizing import MotorCheck
from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.axis.motion.trajectory import Trajectory
from ballscrew.axis.supports.bearing import DIRECTION
from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.basis.records import Record, Severity
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction import validity
from ballscrew.physics.friction.validity import CONDITIONS, NUT_CONDITIONS
from ballscrew.physics.sizing.checks import Check, all_hold, verdict_of
from ballscrew.questions.duty.compute import NUMBERS, OF_BATH, DutyReport
from ballscrew.questions.duty.parts import BACK, TRAVEL
from ballscrew.questions.shared.check_lines import with_unlikely

_LENGTH, _SPEED = fields_of(Trapezoid)["stroke"], fields_of(Trapezoid)["speed"]
_TORQUE, _TURNING = NUMBERS["torque_rms"], NUMBERS["mean_speed"]
_INERTIA = fields_of(Axis)["inertia"]
#: Shares of the stroke and of the largest speed below which a difference is one of rounding.
_CLOSES, _JUMPS = 1e-9, 1e-9
#: The same where the motion was recorded.
_NOISE = 0.01
#: Places of the cycle that one sentence names.
_PLACES = 4
#: Points at which the curve of a motor is looked at for its highest torque.
_CURVE_POINTS = 1000
_PASSES = "passes all checks"


def verdicts(report: DutyReport) -> list[Record]:
    """Starvation; what turns; lost play; whether the axis falls, the motor suffices, and all checks hold."""
    return [
        *starved(report),
        *inertia(report),
        *_flank_changes(report),
        _brake(report),
        *_motor(report),
        _checks(report),
    ]


def starved(report: DutyReport) -> list[Record]:
    """Demands on the motor and losses, as the inlet is given and in a full bath of oil."""
    duty = report.duty
    if not duty.starved:
        return []
    given = {"torque_peak": duty.torque_peak, "screw_torque": duty.screw_torque, "energy_lost": duty.energy_lost}
    numbers = [validity.BothTorques(OF_BATH[name], value, getattr(report.bath, name)) for name, value in given.items()]
    return validity.records(numbers)


def inertia(report: DutyReport) -> list[Record]:
    """The moment of inertia that the motor accelerates, by what was counted, and what is missing in it."""
    axis = report.axis
    parts = axis.inertia_by
    if not parts:
        return []
    whole = units.shown(axis.turning_inertia, _INERTIA)
    if axis.inertia:
        message = f"what turns has {whole} at the motor, as given for motor, coupling and screw: none is added to it"
    else:
        counted = ", ".join(f"{_part(report, name)} {units.shown(value, _INERTIA)}" for name, value in parts.items())
        message = f"what turns has {whole} at the motor: {counted}"
        if missing := _not_given(report):
            message = f"{message}; not given: {missing}"
    return [Record("verdict.inertia", "inertia", message, value=axis.turning_inertia, unit=_INERTIA.unit)]


def _part(report: DutyReport, name: str) -> str:
    """A part of what turns, of the screw with what its inertia is that of, where it was computed."""
    shaft = report.case.turning_shaft
    if name != "screw" or shaft is None or report.case.axis is report.axis:
        return name
    diameter, length = units.shown(shaft.diameter, _LENGTH), units.shown(shaft.length, _LENGTH)
    if shaft.of_stroke:
        return f"screw (a cylinder of {diameter} as long as the stroke of {length}: give its length)"
    return f"screw (a cylinder of {diameter} and {length})"


def _not_given(report: DutyReport) -> str:
    return ", ".join(name for name in ("screw", "motor", "coupling") if name not in report.axis.inertia_by)


def _flank_changes(report: DutyReport) -> list[Record]:
    """Places where the load changes its flank, and what the position loses there, of a nut without preload."""
    changes = report.flank_changes
    if not changes or report.cycle_life.preload:
        return []
    places = [f"{units.shown(change.position, _LENGTH)} (“{change.phase}”)" for change in changes[:_PLACES]]
    more = "" if len(changes) <= _PLACES else f" and {len(changes) - _PLACES} more"
    play = changes[0].lost_motion
    loses = f", where the position loses the play of {units.shown(play, TRAVEL)}" if play else ""
    unknown = "" if play else "; play unknown: give nut.axial_play"
    at = f"at {', '.join(places)}{more}"
    message = f"the load changes its flank {len(changes)} times in a cycle{loses}: {at}{unknown}"
    return [Record("verdict.flank_changes", "lost_motion", message, value=play, unit=TRAVEL.unit)]


def _brake(report: DutyReport) -> Record:
    brake = report.brake
    motor = brake.conditions[0].motor_torque
    by_motor = units.shown(motor, _TORQUE)
    moving = [condition for condition in brake.conditions if condition.falls or condition.goes_on]
    if not brake.load_torque:
        message = "no brake is needed to hold it: no load turns the screw at rest"
    elif not moving:
        least = min(condition.safety for condition in brake.conditions)
        message = (
            f"stays with the motor off: friction from rest{f' and {by_motor} of the motor' * bool(motor)} is at least "
            f"{units.number(least)} times the torque of the load"
        )
        if least < brake.brake_factor:
            message = (
                f"{message}: a margin of {units.number(100 * (least - 1), 2)} % only, less than the factor "
                f"{units.number(brake.brake_factor, 6)} of a brake; do not rely on it"
            )
    else:
        goes = _way(report)
        everywhere = len(moving) == len(brake.conditions)
        by_help = f" by the {by_motor} of the motor without current" * bool(motor)
        falls = goes if brake.starts else f"stays{by_help}, but {goes} once it is started,"
        conditions = "in all conditions" if everywhere else ", ".join(c.condition for c in moving)
        speed = units.shown(max(each.speed_after_stroke for each in moving), _SPEED)
        factor = units.number(brake.brake_factor, 6)
        load = units.shown(brake.load_torque, _TORQUE)
        holding = units.shown(brake.holding_torque, _TORQUE)
        message = (
            f"{falls} with the motor off ({conditions}), after the stroke at up to {speed}; a brake is needed: "
            f"{units.shown(brake.brake_torque, _TORQUE)}, {factor} times the {load} of the load without friction "
            f"({holding} hold it with its help)"
        )
        if motor and brake.starts:
            message = f"{message}; the {by_motor} of the motor without current do not hold it"
    if brake.load_torque and report.duty.starved:
        message = f"{message}; with the smaller friction, that of the track starved of oil"
    return Record(
        "verdict.brake",
        "brake",
        message,
        severity="warning" if brake.falls else "info",
        holds=not brake.falls,
        value=brake.holding_torque,
        unit="N m",
    )


def _way(report: DutyReport) -> str:
    """Verb for what the load does with the axis: falls, rises (by a counterweight), or moves along."""
    load, inclination = report.brake.conditions[0].load_torque, report.axis.inclination
    if not inclination:
        return "moves"
    return "falls" if (load > 0) == (inclination > 0) else "rises"


def _motor(report: DutyReport) -> list[Record]:
    if report.motor_check is None:
        return []
    failed = [check for check in report.motor_check.checks if check.holds is False]
    names = ", ".join(check.name.removeprefix("motor_").replace("_", " ") for check in failed)
    message = f"the motor does not suffice: {names}" if failed else "the motor suffices"
    if validity.FULL_BATH in report.motor_check.torques:
        message = f"{message}; judged by the larger torque: {_conditions(report.motor_check)}"
    severity: Severity = "error" if failed else "info"
    return [Record("verdict.motor", "motor", message, severity=severity, holds=not failed)]


def _conditions(against: MotorCheck) -> str:
    """The condition of the track that each torque is of: ``peak in a full bath of oil, RMS starved of oil``."""
    peak, rms = against.worst_torque[0], against.worst_rms[0]
    return f"peak and RMS {peak}" if peak == rms else f"peak {peak}, RMS {rms}"


def _with_condition(torque: float, condition: str) -> str:
    """A torque, and the condition of the track that it is of."""
    value = units.shown(torque, _TORQUE)
    return f"{value} {condition}" if condition else value


def _checks(report: DutyReport) -> Record:
    holds = all_hold(report.checks)
    words = with_unlikely(verdict_of(report.checks, passes=_PASSES), report.case)
    message = f"over the cycle: {words}"
    severity: Severity = "error" if holds is False else "warning" if report.case.unlikely else "info"
    return Record("verdict.checks", "checks", message, severity=severity, holds=holds)


def warnings(report: DutyReport) -> list[Record]:
    """Warnings of strange inputs and motion, what fails and how to mend it, and where the model ends."""
    return [
        *report.case.implausible(),
        *inertia_warnings(report),
        *_open_cycle(report),
        *_jumps(report),
        *_short_stroke(report),
        *_short_reversal(report),
        *_too_fast(report),
        *_beyond_motor(report),
        *_validity(report),
        *_validity_of_elements(report),
    ]


def _warning(name: str, subject: str, message: str, value: float, limit: float | None, quantity: Quantity) -> Record:
    return Record.warning(f"duty.{name}", subject, message, value=value, limit=limit, unit=quantity.unit)


def inertia_warnings(report: DutyReport) -> list[Record]:
    """Inertia that is not given where something accelerates, and one of all that turns that the screw alone exceeds."""
    axis, shaft = report.axis, report.case.turning_shaft
    if not np.any(report.duty.states.acceleration):
        return []
    if not axis.inertia_by:
        message = (
            "the inertia of motor, coupling and screw is zero: no torque is counted that accelerates them, often "
            'a quarter of the peak; give [axis] inertia = "45 kg cm^2"'
        )
        return [_warning("no_inertia", "axis.inertia", message, 0.0, None, _INERTIA)]
    if not axis.inertia and not axis.motor_inertia:
        message = (
            f'no torque is counted that accelerates: {_not_given(report)}; give [axis] motor_inertia = "20 kg cm^2"'
        )
        return [_warning("no_inertia", "axis.motor_inertia", message, axis.turning_inertia, None, _INERTIA)]
    alone = 0.0 if shaft is None else shaft.inertia / float(axis.transmission_ratio) ** 2
    if not axis.inertia or alone <= axis.inertia:
        return []
    given = units.shown(axis.inertia, _INERTIA)
    message = (
        f"the inertia of motor, coupling and screw is given as {given}, and the screw alone has "
        f"{units.shown(alone, _INERTIA)}: leave it out and give [axis] motor_inertia, and the screw counts as it "
        "is"
    )
    return [_warning("inertia_too_small", "axis.inertia", message, float(axis.inertia), alone, _INERTIA)]


def _open_cycle(report: DutyReport) -> list[Record]:
    states = report.duty.states
    left = float(states.position[-1] - states.position[0])
    least = _CLOSES if not isinstance(report.motion, Trajectory) else _NOISE
    if abs(left) <= least * max(states.stroke, 1e-12):
        return []
    one_way = getattr(report.motion, "returns", True) is False
    remedy = "return = true adds the way back" if one_way else "add a move back"
    message = (
        f"the motion ends {units.shown(abs(left), _LENGTH)} from where it began: the numbers are of this way "
        f"alone, not of a cycle that repeats; {remedy}"
    )
    return [_warning("open_cycle", "motion", message, left, 0.0, _LENGTH)]


def _jumps(report: DutyReport) -> list[Record]:
    """Speeds that differ where one phase ends and the next begins; the last is followed by the first."""
    states = report.duty.states
    if isinstance(report.motion, Trajectory):  # smoothing leaves it a speed at its ends
        return []
    ends, names = states.speeds_of_ends, states.phases
    floor = _JUMPS * float(np.max(np.abs(states.speed)))
    jumps: list[Record] = []
    for number, (_, before) in enumerate(ends):
        after = ends[(number + 1) % len(ends)][0]
        if abs(after - before) <= floor:
            continue
        here, there = names[number], names[(number + 1) % len(ends)]
        message = (
            f"the speed jumps from {units.shown(before, _SPEED)} (“{here}”) to {units.shown(after, _SPEED)} "
            f"(“{there}”): no torque is counted for it; put a move with a distance between them"
        )
        jumps.append(_warning("speed_jump", f"motion.phase {number + 1}", message, abs(after - before), 0.0, _SPEED))
    return jumps


def loaded_circuit(screw: BallScrew) -> float:
    """Advance of the nut over the loaded turns of one ball circuit or more in a row, m."""
    turn = math.pi * screw.pitch_circle_diameter / math.cos(screw.lead_angle)
    return float(screw.loaded_balls * screw.ball_diameter / turn * screw.lead)


def _short_stroke(report: DutyReport) -> list[Record]:
    stroke, needed = report.duty.states.stroke, loaded_circuit(report.case.screw)
    if stroke >= needed or stroke == 0:
        return []
    message = (
        f"the stroke {units.shown(stroke, _LENGTH)} is shorter than the loaded turns of the nut, "
        f"{units.shown(needed, _LENGTH)}: the balls do not change their places, and grease is not spread; put a "
        "longer stroke in between now and then"
    )
    return [_warning("short_stroke", "motion.stroke", message, stroke, needed, _LENGTH)]


def _short_reversal(report: DutyReport) -> list[Record]:
    """A stroke within which the friction that turned round does not come back: it loses less than is counted."""
    short_reversal = report.short_reversal
    if short_reversal is None:
        return []
    stroke = units.shown(short_reversal.stroke, TRAVEL, 3)
    message = (
        f"friction changes its sign at once here, but after a reversal {units.percent(BACK)} of that of the screw "
        f"are back within {units.shown(short_reversal.back, TRAVEL, 3)}, and the shortest stroke is {stroke}: to and "
        f"fro over it the screw loses {units.percent(short_reversal.work_share)} of the work counted, by a hypothesis "
        "(ballscrew reversal)"
    )
    ends = {"value": short_reversal.stroke, "limit": short_reversal.back}
    return [Record("duty.short_reversal", "stroke", message, unit=TRAVEL.unit, **ends)]


def _too_fast(report: DutyReport) -> list[Record]:
    """The way out where the shaft would whirl, or the balls be too fast."""
    too_fast: list[Record] = []
    for name, remedy in (
        ("critical_speed", "hold the ends firmer, shorten the shaft, or take a greater lead"),
        (
            "diameter_speed_product",
            "take a greater lead, or a nut made for such speeds, with its own limit of the DN value",
        ),
    ):
        check = _check(report, name)
        if check is None or check.holds is not False or check.utilisation is None:
            continue
        speed = float(np.max(np.abs(report.duty.states.speed)))
        turning = units.shown(np.max(np.abs(report.duty.screw_speed)), _TURNING)
        largest = units.shown(speed / check.utilisation, _SPEED)
        message = (
            f"{turning} are {units.number(check.utilisation, 3)} times what the {check.title} permits: move at "
            f"{largest} at most, {remedy}"
        )
        too_fast.append(_warning(name, "motion.speed", message, speed, speed / check.utilisation, _SPEED))
    return too_fast


def _check(report: DutyReport, name: str) -> Check | None:
    return next((check for check in report.checks if check.name == name), None)


def _beyond_motor(report: DutyReport) -> list[Record]:
    """The state that asks for the most, where the curve of the motor does not reach it."""
    against = report.motor_check
    if against is None or against.utilisation[against.worst] <= 1:
        return []
    duty, motor, at = report.duty, against.motor, against.worst
    fastest, most = float(np.max(np.abs(duty.motor_speed))), float(motor.largest_speed)
    if fastest > most:
        message = (
            f"the cycle turns the motor at up to {units.shown(fastest, _TURNING)}, above its largest speed "
            f"{units.shown(most, _TURNING)}: take a lower speed, a greater lead, or another ratio"
        )
        return [_warning("motor_speed", "motor.largest_speed", message, fastest, most, _TURNING)]
    condition, largest = against.worst_torque
    torque = abs(largest)
    there = float(motor.peak_at(duty.motor_speed[at : at + 1])[0])
    highest = float(np.max(motor.peak_at(np.linspace(0.0, most, _CURVE_POINTS))))
    phase = duty.states.phases[int(duty.states.phase[at])]
    speed = units.shown(abs(float(duty.motor_speed[at])), _TURNING)
    nowhere = "; its curve reaches that at no speed" if highest < torque else ""
    message = (
        f"“{phase}” asks for {_with_condition(torque, condition)} at {speed}, where the motor has "
        f"{units.shown(there, _TORQUE)}{nowhere}: take a lower acceleration, a larger motor, or another ratio"
    )
    return [_warning("motor_torque", "motor.curve", message, torque, there, _TORQUE)]


def _validity(report: DutyReport) -> list[Record]:
    """Conditions of the model that fail while the axis moves, with the share of that time."""
    known = {**CONDITIONS, **NUT_CONDITIONS}
    return [
        _not_valid(name, known[name].subject, known[name].text, share)
        for name, share in _failing(report, report.duty.screw.validity)
        if name in known
    ]


def _failing(report: DutyReport, validity: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """The conditions that fail while the axis moves, each with its share of that time."""
    states = report.duty.states
    weight = np.where(states.direction != 0, states.weight, 0.0)
    for name, mask in validity.items():
        share = float(np.sum(weight * ~np.asarray(mask))) / max(float(np.sum(weight)), 1e-300)
        if share:
            yield name, share


def _not_valid(name: str, subject: str, condition: str, share: float) -> Record:
    message = f"{condition} (in {units.number(share, 2)} of the time in motion)"
    return Record.warning(f"validity.{name}", subject, message, value=share, limit=0.0)


def _validity_of_elements(report: DutyReport) -> list[Record]:
    """Conditions of bearings and guides that fail while the axis moves, with the share of that time."""
    known = {name: condition.text for name, condition in {**CONDITIONS, **NUT_CONDITIONS}.items()}
    known[DIRECTION] = "one row carries no load in the other direction: it was computed for the size of the load"
    return [
        _not_valid(name, element.replace(" ", "_"), f"{element}: {known[name]}", share)
        for element, validity in report.duty.support_validity.items()
        for name, share in _failing(report, validity)
        if name in known
    ]
