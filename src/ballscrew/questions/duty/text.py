"""Text of a duty on the terminal: the cycle, torque and energy by cause, power off, life, rules and checks."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.brake import LetGo
from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, beside, wrapped
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.duty_schema import MOTIONS
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.duty import verdicts as duty_verdicts
from ballscrew.questions.duty.compute import IF_ANY, NUMBERS, DutyReport
from ballscrew.questions.shared.check_lines import check_lines
from ballscrew.questions.shared.elements_text import element_lines
from ballscrew.questions.shared.text_tables import shown_or_dash

if TYPE_CHECKING:  # loads xarray
    from ballscrew.questions.duty.band import DutyBandReport

_WIDTH, _BAR = 66, 24
_AXIS, _MOTION = fields_of(Axis), fields_of(Trapezoid)
_FORCE, _SPEED = LISTED["dynamic_load_rating"], _MOTION["speed"]
_TORQUE, _ENERGY, _POWER = (NUMBERS[name] for name in ("torque_rms", "energy_lost", "power_peak"))
#: Mechanisms of an element that are named.
_MECHANISMS = 3
#: Columns of the axis with its motor off.
CONDITIONS = ("", "oil", "load", "friction from rest", "least in motion", "ratio", "after the stroke", "")
#: Why the rows of the axis with its motor off are often alike.
OFF_NOTE = (
    "Friction from rest is without an oil film. In motion the least friction at any speed of the cycle counts: a "
    "thinner oil moves it to a higher speed, where it is about as large, so that rows may be alike. The speed after "
    "the stroke is reckoned with it all the way, an upper bound."
)
#: The options for an input of a check that is missing.
_GIVE = {
    "installation": "[installation]",
    "limits.running_time": '--set limits.running_time="20000 h"',
}
#: Parts that are less than this share of the largest are not shown.
_LEAST = 1e-9


def text(report: DutyReport, encoding: str = "utf-8") -> str:
    """A duty in full."""
    lines = [
        title(report),
        "",
        descriptions.design(report.case, plain_text=True),
        *_assumptions(report.case),
        *element_lines(report.case),
        "",
        "Cycle",
        *_numbers(report),
        *_smoothing(report),
        *(f"  {record.text}" for record in duty_verdicts.verdicts(report)),
        *(f"beware  {record.name}: {record.text}" for record in duty_verdicts.warnings(report)),
        "",
        *_parts(report, "█" if "utf" in encoding.lower() else "#"),
        "",
        *_heat(report),
        "",
        *_power_off(report),
        "",
        *_life(report),
        "",
        *_rules(report),
        "",
        *check_lines(report.checks, _GIVE),
    ]
    return "\n".join(line if "\n" in line else wrapped(line) for line in lines)


def band_text(found: DutyBandReport) -> str:
    """The bands of a duty, one number a line, and where they come from."""
    bands = found.bands
    rows = [[f"Band: {100 * bands.level:.4g} % of {bands.count} samples", "case", "median", "from", "to"]]
    for name, one in bands.numbers.items():
        quantity = NUMBERS[name]
        cells = (number(quantity, value) for value in (one.value, one.median))
        low, high = one.band
        rows.append([f"  {quantity.info.meaning}", *cells, number(quantity, low, -1), number(quantity, high, 1)])
    given = sum(one.given for one in found.inputs.values())
    beside = ", bearings and guides" if found.report.case.uncertain_supports else ""
    said = (
        f"  of {len(found.inputs)} uncertain inputs of screw, oil and model{beside}, {given} of them given by the "
        "case; motion, axis and laws are taken as exact"
    )
    return "\n".join(["", *aligned(rows), wrapped(said)])


def title(report: DutyReport) -> str:
    """``vertical axis, 400 kg, trapezoid over 500 mm at 30 m/min: double nut, preload 5047 N, model reference``."""
    case, axis, states = report.case, report.axis, report.duty.states
    angle = float(axis.inclination)
    tilt = (
        "horizontal axis"
        if angle == 0
        else "vertical axis"
        if math.isclose(abs(angle), math.pi / 2)
        else f"axis at {units.shown(angle, _AXIS['inclination'])}"
    )
    kind = next((name for name, cls in MOTIONS.items() if type(report.motion) is cls), "recorded motion")
    fastest = float(max(abs(states.speed)))
    travel = f"{kind} over {units.shown(states.stroke, _MOTION['stroke'])} at up to {units.shown(fastest, _SPEED)}"
    nut = [] if case.nut is None else [descriptions.nut_text(case.nut)]
    model = descriptions.model_text(case) if case.efficiency is None else f"efficiency {case.efficiency:g}"
    return f"{tilt}, {units.shown(axis.mass, _AXIS['mass'])}, {travel}: {', '.join([*nut, model])}"


def _assumptions(case: Case) -> Sequence[str]:
    return [*descriptions.assumptions(case), descriptions.left_out(case)] if case.efficiency is None else []


def _line(what: str, value: str) -> str:
    return f"  {what:<{_WIDTH}} {value}"


def _numbers(report: DutyReport) -> list[str]:
    return [
        _line(quantity.info.meaning, number(quantity, report.numbers[name]))
        for name, quantity in shown_numbers(report).items()
    ]


def _smoothing(report: DutyReport) -> list[str]:
    """How a recorded motion was smoothed."""
    found = report.smoothing
    if found is None:
        return []
    torque = units.shown(found.torque_rms_unsmoothed, _TORQUE)
    acceleration = units.shown(found.acceleration_noise, _MOTION["acceleration"], 2)
    return [
        f"  recorded: {found.samples} samples, each speed from {2 * found.half_width + 1} of them, which leaves a "
        f"noise of {acceleration} in the acceleration; without smoothing the RMS torque would be {torque}"
    ]


def shown_numbers(report: DutyReport) -> Mapping[str, Quantity]:
    """The numbers of a cycle, without those that are zero in most of them."""
    least = _LEAST * report.duty.energy_drawn
    return {n: q for n, q in NUMBERS.items() if n not in IF_ANY or abs(report.numbers[n]) > least}


def number(quantity: Quantity, value: float, toward: int = 0) -> str:
    """A number with its unit; a dash where it is not finite, and large counts without an exponent up to a million."""
    if not math.isfinite(value):
        return "endless" if value > 0 else "–"
    if quantity.unit == "1":
        return f"{float(units.to_digits(value, toward=toward)):.6g}"
    return shown_or_dash(value, quantity, toward)


def _parts(report: DutyReport, block: str) -> list[str]:
    """Torque and energy by cause: torque at its peak, share of the RMS torque, energy."""
    total = report.duty.torque_rms
    rows, bars = [["Torque and energy by cause", "at the peak", "of the RMS", "energy", "share"]], [""]
    sums = (sum(report.torque_peak_by.values()), total, sum(report.duty.energy_by.values()))
    for name, values in {**shown_parts(report), "sum": sums}.items():
        cells = (units.shown(v, q, 3) for v, q in zip(values, (_TORQUE, _TORQUE, _ENERGY), strict=True))
        share = values[1] / total if total else 0.0
        rows.append([f"  {name}", *cells, f"{share:.1%}" if total else "–"])
        bars.append("" if name == "sum" else block * round(_BAR * max(0.0, min(share, 1.0))))
    return [f"{line}  {bar}".rstrip() for line, bar in zip(aligned(rows), bars, strict=True)]


def shown_parts(report: DutyReport) -> Mapping[str, tuple[float, float, float]]:
    """Parts at the peak, of the RMS torque and of the energy; zero where it is rounding, and left out where all are."""
    columns = (report.torque_peak_by, report.torque_rms_by, report.duty.energy_by)
    scales = [max(map(abs, values.values()), default=0.0) for values in columns]
    found: dict[str, tuple[float, float, float]] = {}
    for name in report.duty.energy_by:
        peak, rms, energy = (
            values[name] if abs(values[name]) > _LEAST * scale else 0.0
            for values, scale in zip(columns, scales, strict=True)
        )
        if peak or rms or energy:
            found[name] = (peak, rms, energy)
    return found


def _heat(report: DutyReport) -> list[str]:
    """Mean heat of each element over the cycle, and the mechanisms that make most of it."""
    heat, time = report.duty.heat, report.duty.states.cycle_time
    total = sum(heat.values())
    if not total > 0:
        return ["Heat by element: none"]
    rows, by = [["Heat by element", "mean", "share"]], ["  most of it by"]
    for name, parts in report.energy_lost_in.items():
        largest = sorted(parts.items(), key=lambda part: -part[1])[:_MECHANISMS]
        by.append("  " + ", ".join(f"{part} {units.shown(energy / time, _POWER, 3)}" for part, energy in largest))
        rows.append([f"  {name}", units.shown(heat[name], _POWER, 3), f"{heat[name] / total:.1%}"])
    rows.append(["  sum", units.shown(total, _POWER, 3), "100.0%"])
    return [beside(line, most) for line, most in zip(aligned(rows), [*by, ""], strict=True)]


def _power_off(report: DutyReport) -> list[str]:
    if not report.brake.load_torque:
        return ["Motor off: no load turns the screw"]
    rows = [["Motor off", *CONDITIONS[1:]]]
    rows += [[f"  {first}", *others] for first, *others in map(condition_cells, report.brake.conditions)]
    return [*aligned(rows), f"  {OFF_NOTE}"]


def condition_cells(found: LetGo) -> list[str]:
    """The axis let go in one condition, in the columns of :data:`CONDITIONS`."""
    says = "falls" if found.falls else "goes on once started" if found.goes_on else "stays"
    return [
        found.condition,
        "–" if found.temperature is None else units.shown(found.temperature, TEMPERATURE, 3),
        units.shown(abs(found.load_torque), _TORQUE, 3),
        units.shown(found.breakaway_torque, _TORQUE, 3),
        units.shown(found.running_torque, _TORQUE, 3),
        f"{found.safety:.3g}",
        shown_or_dash(found.speed_after_stroke, _SPEED) if found.goes_on else "–",
        says,
    ]


def _life(report: DutyReport) -> list[str]:
    life = report.life
    rating = life.dynamic_load_rating
    source = f"dynamic load rating {'–' if rating is None else units.shown(rating, _FORCE)}, {report.rating_source}"
    loads = [
        _line(f"mean load of {'the half' if life.preload else 'the flank'} {name}", shown_or_dash(load, _FORCE))
        for name, load in life.mean_loads.items()
    ]
    turns = NUMBERS["life_revolutions"]
    return [
        f"Life by ISO 3408-5 ({source})",
        *loads,
        _line("turns of both together", number(turns, life.revolutions)),
        _line("turns by the larger mean load alone, as THK computes", number(turns, life.revolutions_of_the_worse)),
    ]


def _rules(report: DutyReport) -> list[str]:
    rule, duty = report.rule, report.duty
    rows = [["Torque of the motor", "peak", "RMS"]]
    for name, found in (
        ("  by mechanics" + (": this is physics" if report.by_rule else ""), duty),
        (f"  by the rule of catalogues (THK), efficiency {rule.efficiency:g}", rule),
    ):
        rows.append([name, *(units.shown(value, _TORQUE) for value in (found.torque_peak, found.torque_rms))])
    note = (
        "  The rule divides the load by the efficiency also where the load drives the screw, and moves the mass "
        "without any loss; mechanics does neither."
    )
    asked = "  The case asks for the rule: its torques stand above." if report.by_rule else ""
    return [*aligned(rows), note, *filter(None, [asked])]
