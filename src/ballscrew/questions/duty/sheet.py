"""The sheet of a duty: verdicts, the cycle in numbers, torque and energy by cause, power off, life, checks, charts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from ballscrew.axis.duty_cycle import axis
from ballscrew.axis.duty_cycle.brake import LetGo
from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Bar,
    Bars,
    Block,
    Cell,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Level,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    lines,
    verdict_line,
    warning_lines,
    words,
)
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.schema.duty_schema import MOTIONS
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.friction.validity import FULL_BATH
from ballscrew.questions.duty.compute import CAUSES, IF_ANY, NUMBERS, DutyReport, cause_of, words_of
from ballscrew.questions.duty.parts import PhaseNumbers
from ballscrew.questions.duty.verdicts import verdicts, warnings
from ballscrew.questions.shared.check_lines import check_table, element_lines
from ballscrew.questions.shared.declared import parts_of

if TYPE_CHECKING:  # loads xarray
    from ballscrew.questions.duty.band import DutyBandReport

_MASS, _MOTION = fields_of(axis.Axis), fields_of(Trapezoid)
_STROKE, _SPEED = _MOTION["stroke"], _MOTION["speed"]
_FORCE, _TURNS, _ROTATION = LISTED["dynamic_load_rating"], NUMBERS["life_revolutions"], NUMBERS["mean_speed"]
_TIME, _TORQUE, _ENERGY, _POWER = (NUMBERS[name] for name in ("cycle_time", "torque_rms", "energy_lost", "power_peak"))
_PRESSURE = Quantity("maximum_pressure", "Pa", Info("p_0", "largest contact pressure", "MPa"))
_PLAIN = Quantity("ratio", "1", Info("", "ratio"))
_COLOURS: Mapping[str, Colour] = dict(zip(CAUSES, ("blue", "green", "orange", "red", "purple"), strict=True))
#: Mechanisms of an element that are named.
_MECHANISMS = 3
#: Parts that are less than this share of the largest are rounding.
_LEAST = 1e-9
_CURVE_POINTS = 200
#: More points than this are a blot in a picture, and a large file.
_MOST_POINTS = 5000
_CONDITIONS = ("", "oil", "load", "friction from rest", "least in motion", "ratio", "after the stroke", "axis")
_OFF_NOTE = (
    "Friction from rest is without an oil film. In motion the least friction at any speed of the cycle counts: a "
    "thinner oil moves it to a higher speed, where it is about as large, so that rows may be alike. The speed after "
    "the stroke is reckoned with it all the way, an upper bound."
)
_RULE_NOTE = (
    "The rule divides the load by the efficiency also where the load drives the screw, and moves the mass without any "
    "loss; mechanics does neither."
)
_PARTS_NOTE = "A part that acts against the others is negative. The parts sum to the peak and to the RMS torque."
#: What to give for inputs of checks that are missing.
_GIVE = {"installation": "[installation]", "limits.running_time": '--set limits.running_time="20000 h"'}


def sheet(report: DutyReport, bands: DutyBandReport | None = None) -> Sheet:
    """All that people see of a duty, with the bands of its numbers where they were computed."""
    return Sheet(
        title(report),
        [
            lines(_assumptions(report), "small", detail=True),
            Lines(answers(report)),
            warning_lines(warnings(report)),
            _cycle(report, bands),
            _phases(report),
            _parts(report),
            *_charts(report),
            _states(report),
            *_heat(report),
            *_power_off(report),
            *_life(report),
            _rules(report),
            check_table(report.checks, _GIVE),
        ],
    )


def answers(report: DutyReport) -> list[Line]:
    """Demands of a cycle on the motor and its cost in life, then brake, motor and checks, a sentence each."""
    numbers = report.numbers
    peak, rms = (words(Number(numbers[name], _TORQUE)) for name in ("torque_peak", "torque_rms"))
    life = words(Number(numbers["life_time"], NUMBERS["life_time"]))
    known = f"; the L10 life is {life}" if math.isfinite(numbers["life_time"]) else ""
    first = Line(f"the motor gives {peak} at the peak and {rms} RMS{known}", "verdict")
    return [first, *map(verdict_line, verdicts(report))]


def _phases(report: DutyReport) -> Table:
    """Demands of each phase of the motion on the motor."""
    known = {name: part.quantity for name, part in parts_of(PhaseNumbers).items() if part.quantity is not None}
    rows: list[list[Cell]] = [
        [phase.name, *(Number(getattr(phase, name), quantity) for name, quantity in known.items())]
        for phase in report.phases
    ]
    headings = ("", "from", "for", "largest load", "peak torque", "RMS torque", "energy")
    return Table("phases", "Phases of the motion", headings, rows, detail=True)


def title(report: DutyReport) -> str:
    """``vertical axis, 400 kg, trapezoid over 500 mm at 30 m/min: double nut, preload 5047 N, model reference``."""
    case, axis, states = report.case, report.axis, report.duty.states
    angle = float(axis.inclination)
    tilt = (
        "horizontal axis"
        if angle == 0
        else "vertical axis"
        if math.isclose(abs(angle), math.pi / 2)
        else f"axis at {units.shown(angle, _MASS['inclination'])}"
    )
    kind = next((name for name, cls in MOTIONS.items() if type(report.motion) is cls), "recorded motion")
    fastest = float(max(abs(states.speed)))
    travel = f"{kind} over {units.shown(states.stroke, _STROKE)} at up to {units.shown(fastest, _SPEED)}"
    nut = [] if case.nut is None else [descriptions.nut_text(case.nut)]
    model = descriptions.model_text(case) if case.efficiency is None else f"efficiency {case.efficiency:g}"
    return f"{tilt}, {units.shown(axis.mass, _MASS['mass'])}, {travel}: {', '.join([*nut, model])}"


def _assumptions(report: DutyReport) -> Iterator[str]:
    case = report.case
    yield descriptions.design(case, plain_text=True)
    if case.efficiency is None:
        yield from descriptions.assumptions(case)
        yield descriptions.left_out(case)
    yield from element_lines(case)


def _cycle(report: DutyReport, bands: DutyBandReport | None) -> Table:
    """The numbers of the cycle, without those that are zero in most cycles and in this one."""
    least = _LEAST * report.duty.energy_drawn
    banded = {} if bands is None else bands.bands.numbers
    rows: list[list[Cell]] = []
    for name, quantity in NUMBERS.items():
        value = report.numbers[name]
        if name in IF_ANY and abs(value) <= least:
            continue
        band = banded.get(name)
        row: list[Cell] = [quantity.info.meaning, Number(value, quantity, band=None if band is None else band.band)]
        if bands is not None:
            row.append(None if band is None else Number(band.median, quantity))
        rows.append(row)
    columns = ("", "value") if bands is None else ("", "value", "median")
    return Table("cycle", "Cycle", columns, rows, [*_smoothing(report), *_origin_of(bands)])


def _origin_of(bands: DutyBandReport | None) -> Iterator[str]:
    if bands is not None:
        given = sum(one.given for one in bands.inputs.values())
        supports = ", bearings and guides" if bands.report.case.origins.uncertain_supports else ""
        yield (
            f"Bands: {100 * bands.bands.level:.4g} % of {bands.bands.count} samples of {len(bands.inputs)} uncertain "
            f"inputs of screw, oil and model{supports}, {given} of them given by the case; motion, axis and laws are "
            "taken as exact."
        )


def _smoothing(report: DutyReport) -> Iterator[str]:
    """Smoothing of a recorded motion."""
    smoothing = report.smoothing
    if smoothing is not None:
        torque = units.shown(smoothing.torque_rms_unsmoothed, _TORQUE)
        noise = units.shown(smoothing.acceleration_noise, _MOTION["acceleration"], 2)
        yield (
            f"Recorded: {smoothing.samples} samples, each speed from {2 * smoothing.half_width + 1} of them, which "
            f"leaves a noise of {noise} in the acceleration; without smoothing the RMS torque would be {torque}."
        )


def _parts(report: DutyReport) -> Table:
    """Torque and energy by cause: at the peak, share of the RMS torque, energy; without what is rounding in all."""
    duty = report.duty
    total = duty.torque_rms
    columns = [
        {name: 0.0 if abs(value) <= _LEAST * largest else value for name, value in values.items()}
        for values in (report.torque_peak_by, report.torque_rms_by, report.energy_by)
        for largest in [max(map(abs, values.values()), default=0.0)]
    ]

    def row(name: str, *values: float, bar: bool = True) -> list[Cell]:
        cells = [Number(value, q, 3) for value, q in zip(values, (_TORQUE, _TORQUE, _ENERGY), strict=True)]
        return [words_of(name), *cells, Share(values[1] / total, bar=bar) if total else None]

    rows = [row(name, *values) for name in report.energy_by if any(values := [column[name] for column in columns])]
    sums = (sum(report.torque_peak_by.values()), total, sum(report.energy_by.values()))
    headings = ("", "at the peak", "of the RMS", "energy", "share")
    return Table(
        "torque",
        "Torque and energy by cause",
        headings,
        [*rows, row("sum", *sums, bar=False)],
        [_PARTS_NOTE],
    )


def _heat(report: DutyReport) -> Iterator[Block]:
    """Mean heat of each element over the cycle, and the mechanisms that make most of it."""
    heat, time = report.heat_by_element, report.duty.states.cycle_time
    total = sum(heat.values())
    if not total > 0:
        yield Lines([Line("no heat: nothing is lost to friction")], detail=True)
        return
    rows: list[list[Cell]] = []
    for name, parts in report.energy_lost_in.items():
        largest = sorted(parts.items(), key=lambda part: -part[1])[:_MECHANISMS]
        causes = ", ".join(f"{words_of(part)} {units.shown(energy / time, _POWER, 3)}" for part, energy in largest)
        rows.append([words_of(name), Number(heat[name], _POWER, 3), Share(heat[name] / total, bar=False), causes])
    rows.append(["sum", Number(total, _POWER, 3), Share(1.0, bar=False), ""])
    headings = ("", "mean", "share", "most of it by")
    yield Table("elements", "Heat by element", headings, rows, detail=True)
    lost = [
        (words_of(element), words_of(part), energy)
        for element, parts in report.energy_lost_in.items()
        for part, energy in parts.items()
    ]
    elements, mechanisms, energies = zip(*lost, strict=True) if lost else ((), (), ())
    yield Columns(
        "heat",
        [
            Column("element", elements),
            Column("mechanism", mechanisms),
            Column("energy in a cycle", energies, _ENERGY),
            Column("mean heat", [energy / time for energy in energies], _POWER),
        ],
    )


def _power_off(report: DutyReport) -> Iterator[Block]:
    if not report.brake.load_torque:
        yield Lines([Line("motor off: no load turns the screw")], detail=True)
        return
    rows = [_condition(condition) for condition in report.brake.conditions]
    motor = report.brake.conditions[0].motor_torque
    of_motor = f"The ratio counts {units.shown(motor, _TORQUE)} of the motor without current, at rest only."
    yield Table("motor_off", "Motor off, no brake", _CONDITIONS, rows, [_OFF_NOTE, *([of_motor] if motor else [])])


def _condition(off: LetGo) -> list[Cell]:
    """The axis with its motor off, in the columns of :data:`_CONDITIONS`."""
    return [
        off.condition,
        None if off.temperature is None else Number(off.temperature, TEMPERATURE, 3),
        Number(abs(off.load_torque), _TORQUE, 3),
        Number(off.breakaway_torque, _TORQUE, 3),
        Number(off.running_torque, _TORQUE, 3),
        Number(off.safety, _PLAIN, 3),
        Number(off.speed_after_stroke, _SPEED) if off.goes_on else None,
        "falls" if off.falls else "goes on once started" if off.goes_on else "stays",
    ]


def _life(report: DutyReport) -> Iterator[Block]:
    life = report.life
    rating = life.dynamic_load_rating
    source = f"dynamic load rating {'–' if rating is None else units.shown(rating, _FORCE)}, {report.rating_source}"
    side = "the half" if life.preload else "the flank"
    rows: list[list[Cell]] = [
        *([f"mean load of {side} {words_of(name)}", Number(load, _FORCE)] for name, load in life.mean_loads.items()),
        ["turns of both together", Number(life.revolutions, _TURNS)],
        ["turns by the larger mean load alone, as THK computes", Number(life.revolutions_of_the_worse, _TURNS)],
    ]
    yield Table("life", f"Life by ISO 3408-5 ({source})", ("", "value"), rows, detail=True)


def _rules(report: DutyReport) -> Table:
    rule, duty = report.rule, report.duty
    by_mechanics = "by mechanics" + (": this is physics" if report.by_rule else "")
    rows: list[list[Cell]] = [
        [name, Number(torques.torque_peak, _TORQUE), Number(torques.torque_rms, _TORQUE)]
        for name, torques in (
            (by_mechanics, duty),
            (f"by the rule of catalogues (THK), efficiency {rule.efficiency:g}", rule),
        )
    ]
    notes = [_RULE_NOTE, *(["The case asks for the rule: its torques stand above."] if report.by_rule else [])]
    return Table("rules", "Torque of the motor", ("", "peak", "RMS"), rows, notes, detail=True)


def _charts(report: DutyReport) -> Iterator[Block]:
    duty, states = report.duty, report.duty.states
    time, torque = Axis("time", _TIME), Axis("torque", _TORQUE)
    rms = Level("RMS", duty.torque_rms)
    yield Chart(
        "motion",
        time,
        Axis("speed", _SPEED),
        [
            Curve("speed", states.time, states.speed, "blue"),
            Curve("position", states.time, states.position, "grey", "dashed", second=True),
        ],
        second=Axis("position", _STROKE),
    )
    yield Chart("torque over speed", Axis("speed of the motor", _ROTATION), torque, [*_cloud(report), rms])
    by_cause = [Curve(cause, states.time, part, _COLOURS[cause]) for cause, part in report.torque_by_cause.items()]
    yield Chart(
        "torque of the motor by cause", time, torque, [*by_cause, Curve("motor", states.time, duty.torque), rms]
    )
    yield _bars("share of the RMS torque", _TORQUE, report.torque_rms_by)
    yield Chart(
        "power of the motor",
        time,
        Axis("power", _POWER),
        [
            Curve("drawn", states.time, np.maximum(duty.power, 0.0), "orange", "area"),
            Curve("returned", states.time, np.minimum(duty.power, 0.0), "green", "area"),
            Curve("", states.time, duty.power),
        ],
    )
    yield _bars("energy lost in a cycle", _ENERGY, report.energy_lost_by)


def _cloud(report: DutyReport) -> Iterator[Curve]:
    """Torque over the speed of the motor: the states of the cycle, in a full bath too, and what the motor gives."""
    duty = report.duty
    some = slice(None, None, -(-len(duty.torque) // _MOST_POINTS))
    speed = duty.motor_speed[some]
    yield Curve("cycle", speed, duty.torque[some], style="dots")
    if duty.starved:
        yield Curve(FULL_BATH, speed, duty.flooded.torque[some], "blue", "circles")
    if report.motor_check is not None:
        motor = report.motor_check.motor
        along = np.linspace(-float(motor.largest_speed), float(motor.largest_speed), _CURVE_POINTS)
        peak, rated = motor.peak_at(along), np.full_like(along, float(motor.rated_torque))
        for sign, peak_name, rated_name in ((1, "peak", "rated"), (-1, "", "")):
            yield Curve(peak_name, along, sign * peak, "red")
            yield Curve(rated_name, along, sign * rated, "orange", "dashed")


def _bars(title: str, quantity: Quantity, parts: Mapping[str, float]) -> Bars:
    """Parts from the largest down; parts that are rounding are left out."""
    least = _LEAST * max(map(abs, parts.values()), default=0.0)
    shown = sorted(((words_of(n), v) for n, v in parts.items() if abs(v) > least), key=lambda part: -abs(part[1]))
    bars = [Bar(name, [("", value, _COLOURS[cause_of(name)])]) for name, value in shown]
    return Bars(title, quantity, bars, detail=True)


def _states(report: DutyReport) -> Columns:
    """One row for each state of the cycle, in order of time."""
    duty, at = report.duty, report.duty.states
    parts = {name: np.broadcast_to(part, at.time.shape) for name, part in duty.parts.items() if np.any(part)}
    return Columns(
        "states",
        [
            Column("time", at.time, _TIME),
            Column("phase", [at.phases[number] for number in at.phase]),
            Column("weight", at.weight, _TIME),
            Column("position", at.position, _STROKE),
            Column("speed", at.speed, _SPEED),
            Column("acceleration", at.acceleration, _MOTION["acceleration"]),
            Column("axial load", duty.axial_load, NUMBERS["mean_load"]),
            Column("screw speed", duty.screw_speed, _ROTATION),
            Column("motor speed", duty.motor_speed, _ROTATION),
            Column("motor torque", duty.torque, _TORQUE),
            *(Column(name, part, _TORQUE) for name, part in parts.items()),
            Column("friction that holds at rest", duty.rest_friction, _TORQUE),
            Column("motor torque by the rule of catalogues", report.rule.torque, _TORQUE),
            Column("power", duty.power, _POWER),
            Column("largest contact pressure", duty.screw.maximum_pressure, _PRESSURE),
            Column("film parameter", duty.screw.film_parameter, _PLAIN),
            Column("valid", [int(value) for value in duty.screw.valid]),
        ],
    )
