"""A fit of a moving log, and friction over speed of one at constant speeds: their documents and sheets.

Beside the fit stand what another filter gives, and three models side by side.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import InputError, spoken
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
    Sheet,
    Table,
    Vertical,
    lines,
    warning_lines,
)
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.basis.records import documents
from ballscrew.basis.references import documentation, keys_in
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, model_text
from ballscrew.evidence.moving_logs.motion_fit import (
    LINEAR,
    POWER,
    QUANTITIES,
    SCREW,
    MotionEstimate,
    MotionFit,
    fit_motion,
)
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.evidence.moving_logs.power_law import SteadyFriction, steady_friction
from ballscrew.evidence.moving_logs.screw_model import NAMES
from ballscrew.questions.fit import FitMotionOptions
from ballscrew.questions.shared.declared import attributes
from ballscrew.questions.shared.options import options_of

#: Flags of the command line by the fields in which the fit finds faults.
_FLAGS = {f"fit.{name}": option.flag for name, option in options_of(FitMotionOptions).items()}


def fit(case: Case, log: MovingLog, test: MovingLog | None, options: FitMotionOptions) -> MotionFit:
    """Fit of a case to a moving log. Raises ``InputError`` that names options of the command line."""
    try:
        result = fit_motion(
            case.model,
            case.screw,
            case.lubricant,
            log,
            options.free or None,
            carried_mass=options.carried_mass,
            test=test,
            keep_going=options.keep_going,
            seed=options.seed,
        )
    except InputError as error:
        faults = (dataclasses.replace(one, where=_FLAGS.get(one.where, one.where)) for one in error.faults)
        raise InputError(*faults) from None
    return dataclasses.replace(result, warning_records=(*result.warning_records, *case.implausible()))


def document(case: Case, motion_fit: MotionFit) -> dict[str, Any]:
    """Estimates, errors of the three models, what the filter does, what cannot be identified, provenance."""
    crossed = {} if motion_fit.test is None else {"cross_error": motion_fit.cross_error}
    name, digest = motion_fit.equation.log.source or ("log", "")
    settings = {} if motion_fit.screw is None else {"free": list(motion_fit.screw.friction.asked)}
    own = keys_in(documentation(type(motion_fit))) + keys_in(documentation(fit_motion))
    return {
        "kind": "motion",
        "model": motion_fit.model,
        "estimates": {name: _estimate(estimate) for name, estimate in motion_fit.estimates.items()},
        "relative_error": motion_fit.relative_error,
        **crossed,
        "models": {name: _model(motion_fit, name) for name in motion_fit.relative_errors},
        "speed_exponent": _exponent_document(motion_fit),
        "filter": _filter(motion_fit),
        "verdicts": [],
        "checks": [],
        "warnings": documents(motion_fit.warning_records),
        "rows": _rows_document(motion_fit),
        "inputs": descriptions.inputs(case),
        "provenance": {
            **descriptions.of_case(case),
            "log": name,
            "sha256": digest,
            "settings": settings,
            "references": list(dict.fromkeys([*descriptions.references(case), *own])),
        },
    }


def _estimate(estimate: MotionEstimate) -> dict[str, Any]:
    return {
        **attributes(estimate, "value", "std", "interval", "identified"),
        "unit": estimate.quantity.unit,
        **attributes(estimate, "model", "at_bound", "given"),
    }


def _model(motion_fit: MotionFit, name: str) -> dict[str, Any]:
    """The numbers of one model, its relative error, and that on the other log."""
    crossed = {} if motion_fit.test is None else {"cross_error": motion_fit.cross_errors[name]}
    if name == SCREW and motion_fit.screw is not None:
        crossed |= {"table_error": motion_fit.screw.table_error}
    return {"numbers": _numbers(motion_fit, name), "relative_error": motion_fit.relative_errors[name], **crossed}


def _numbers(motion_fit: MotionFit, name: str) -> dict[str, float]:
    if name == LINEAR:
        return dict(zip(NAMES, motion_fit.linear.values.tolist(), strict=True))
    if name == POWER:
        assert motion_fit.power is not None
        shared = attributes(motion_fit.power, "mass", "offset", "constant_force", "coefficient")
        return {**shared, "speed_exponent": motion_fit.power.exponent}
    screw = motion_fit.screw
    assert name == SCREW
    assert screw is not None
    return {
        **attributes(screw, "mass", "offset", "constant_force"),
        "remaining_viscous_coefficient": screw.viscous_coefficient,
        **dict(zip(screw.friction.asked, screw.numbers.tolist(), strict=True)),
        "carried_mass": screw.carried_mass,
    }


def _exponent_document(motion_fit: MotionFit) -> dict[str, Any] | None:
    power = motion_fit.power
    if power is None:
        return None
    own = {"value": power.exponent, "bootstrap_interval": list(power.bootstrap)}
    return {**own, **attributes(power, "interval", "choices")}


def _filter(motion_fit: MotionFit) -> dict[str, Any]:
    """The filters that the noise asked for, and the linear model under others."""
    equation = motion_fit.equation
    effects = [
        {"name": e.name, **dict(zip(NAMES, e.values.tolist(), strict=True)), "relative_error": e.relative_error}
        for e in motion_fit.filter_effects
    ]
    return {
        "cutoff": equation.cutoff,
        "position_cutoff": equation.kinematics.cutoff,
        "unit": "Hz",
        "noise": equation.kinematics.noise,
        "noise_unit": "m" if equation.log.position is not None else "m/s",
        "dead_time_corrected": motion_fit.dead_time.corrected,
        "effects": effects,
    }


def _rows_document(motion_fit: MotionFit) -> dict[str, Any]:
    equation = motion_fit.equation
    return {
        "read": equation.log.rows,
        "checked": len(equation.log),
        "used": int(equation.used.size),
        "left_out": dict(equation.left_out),
        "block": motion_fit.linear.solution.block,
        "blocks": motion_fit.linear.solution.blocks,
        "notes": list(equation.log.notes),
    }


#: The models as they are shown, and their colours.
SPOKEN = {LINEAR: "constant + viscous", POWER: "power of speed", SCREW: "screw model"}
_COLOURS: Mapping[str, Colour] = {LINEAR: "orange", POWER: "green", SCREW: "blue"}
_TIME = Quantity("time", "s", Info("", "time"))
_SPEED = Quantity("speed", "m/s", Info("", "speed", "mm/s"))
_FORCE = Quantity("force", "N", Info("", "force"))
_EXPONENT = Quantity("speed_exponent", "1", Info("", "exponent of the speed"))
#: Rows that are drawn at most, speeds of a curve, and parts of the residuals with rows at least.
_MOST_ROWS, _SPEEDS, _PARTS, _FEWEST = 4000, 200, 20, 5
#: The share of the friction that is drawn: what is beyond is noise at rest.
_DRAWN = 0.995


def sheet(case: Case, fit: MotionFit) -> Sheet:
    """All that people see of a fit of a moving log."""
    log, equation = fit.equation.log, fit.equation
    name = (log.source or ("log", ""))[0]
    warnings = [record for record in fit.warning_records if record.severity == "warning"]
    notes = [record for record in fit.warning_records if record.severity != "warning"]
    return Sheet(
        f"{name}: {equation.used.size} rows of {log.rows} used, {model_text(case)}",
        [
            lines(_rows(fit), "small", detail=True),
            warning_lines(warnings),
            Lines([Line(f"note: {record.text}") for record in notes]),
            _estimates(fit),
            lines(_exponent(fit)),
            _models(fit),
            _filters(fit),
            *_charts(fit),
            Lines([Line(design(case, plain_text=True), "small")]),
            _columns(fit),
        ],
    )


def _rows(fit: MotionFit) -> Iterator[str]:
    """Rows left out of the log, and the filters that its noise asked for."""
    equation, motion = fit.equation, fit.equation.kinematics
    for reason, count in equation.left_out.items():
        yield f"left out: {count} {'row' if count == 1 else 'rows'}, {reason}"
    yield from equation.log.notes
    of, unit, scale = ("position", "µm", 1e6) if equation.log.position is not None else ("speed", "mm/s", 1e3)
    blocks = fit.linear.solution.blocks
    yield (
        f"noise of the {of} {scale * motion.noise:.3g} {unit}: speed and acceleration filtered at "
        f"{motion.cutoff:.3g} Hz, both sides at {equation.cutoff:.3g} Hz"
    )
    yield (
        f"residuals follow each other: {blocks:.0f} blocks of {equation.duration / blocks:.2g} s count as independent"
    )


def _estimates(fit: MotionFit) -> Table:
    rows = [
        [spoken(estimate.name), SPOKEN[estimate.model], _number(estimate), _error(estimate)]
        for estimate in fit.estimates.values()
    ]
    return Table("estimates", "Fitted", ("", "model", "value (95 % interval)", "standard error"), rows)


def _number(estimate: MotionEstimate) -> Number:
    ends = estimate.interval
    return Number(estimate.value, estimate.quantity, band=None if ends is None else (ends[0], ends[1]))


def _error(estimate: MotionEstimate) -> Cell:
    if estimate.given:
        return "given"
    if estimate.at_bound:
        return "at its bound"
    return "not identified" if estimate.std is None else Number(estimate.std, estimate.quantity, 2)


def _exponent(fit: MotionFit) -> Iterator[str]:
    """The exponent of the speed, its two intervals, and where the wider one is from."""
    if fit.power is None:
        return
    (low, high), (least, most) = fit.power.bootstrap, fit.power.interval
    yield (
        f"speed exponent {fit.power.exponent:.2f}: {low:.2f} to {high:.2f} by resampled blocks, {least:.2f} to "
        f"{most:.2f} over filters, slowest speeds, directions and halves"
    )
    ends = sorted(fit.power.choices.items(), key=lambda choice: choice[1])
    yield f"  lowest {ends[0][1]:.2f} ({ends[0][0]}), highest {ends[-1][1]:.2f} ({ends[-1][0]})"


def _models(fit: MotionFit) -> Table:
    """The errors of the models on this log, and on another one where there is one."""
    other = ["other log"] if fit.test is not None else []
    rows: list[Sequence[Cell]] = []
    for name, error in fit.relative_errors.items():
        crossed = [f"{fit.cross_errors[name]:.2%}"] if other else []
        rows.append([SPOKEN[name], f"{error:.2%}", *crossed])
    note = "Root mean square over that of the force."
    return Table("models", "Error", ("", "this log", *other), rows, [note])


def _filters(fit: MotionFit) -> Table:
    """Results that another filter would have given, by the model of constant and viscous friction."""
    rows: list[Sequence[Cell]] = []
    own = [("as fitted", fit.linear.values, fit.linear.relative_error)]
    for name, values, error in (*own, *fit.filter_effects):
        numbers = [Number(value, QUANTITIES[of]) for of, value in zip(NAMES, values.tolist(), strict=True)]
        rows.append([name, *numbers, f"{error:.2%}"])
    headings = ("", *(QUANTITIES[name].name.replace("_", " ") for name in NAMES), "off")
    return Table("filters", "What another filter would have given (constant + viscous)", headings, rows, detail=True)


# -- charts and files -----------------------------------------------------------------------------


def _charts(fit: MotionFit) -> Iterator[Block]:
    yield _over_time(fit)
    yield _residuals(fit)
    yield _friction(fit)
    if fit.power is not None:
        power = fit.power
        bars = [Bar(name, [("", value - 1.0, "green")]) for name, value in power.choices.items() if np.isfinite(value)]
        marks = [
            Vertical("fitted", power.exponent, "green"),
            *(Vertical("", end, "grey") for end in power.bootstrap),
        ]
        title = "exponent under other choices"
        yield Bars(title, _EXPONENT, bars, marks, origin=1.0)


def _shown(count: int) -> NDArray[np.int64]:
    return np.arange(0, count, max(1, -(-count // _MOST_ROWS)))


def _over_time(fit: MotionFit) -> Chart:
    equation = fit.equation
    shown = _shown(equation.used.size)
    time = (equation.log.time[equation.used] - equation.log.time[0])[shown]
    model = Curve(SPOKEN[fit.model], time, fit.force(fit.model)[shown], _COLOURS[fit.model])
    marks = [Curve("measured", time, equation.force[shown], "grey"), model]
    return Chart("force over time", Axis("time", _TIME), Axis("force at the nut", _FORCE), marks)


def _residuals(fit: MotionFit) -> Chart:
    """Means of residuals over parts of the rows in the order of their speed."""
    equation = fit.equation
    speed = equation.filtered(equation.speed)
    parts = np.array_split(np.argsort(speed, kind="stable"), min(_PARTS, max(1, speed.size // _FEWEST)))
    places = np.array([np.mean(speed[part]) for part in parts])
    marks: list[Curve | Level] = []
    for name in fit.relative_errors:
        off = fit.force(name) - equation.force
        means = np.array([np.mean(off[part]) for part in parts])
        marks.append(Curve(SPOKEN[name], places, means, _COLOURS[name]))
    x, y = Axis("speed", _SPEED), Axis("model − measured", _FORCE)
    return Chart("residuals, means over the speed", x, y, [*marks, Level("", 0.0)])


def _friction(fit: MotionFit) -> Chart:
    """Friction over speed: what is left of the force without mass and offset, and the models."""
    speed, left = _measured_friction(fit)
    equation, constant, viscous = fit.equation, *fit.linear.values.tolist()[2:]
    shown = _shown(speed.size)
    shown = shown[left[shown] <= (np.quantile(left, _DRAWN) if left.size else 0.0)]
    at = np.linspace(equation.rest, float(np.max(np.abs(equation.speed))), _SPEEDS)
    marks = [
        Curve("measured", speed[shown], left[shown], "sky", "dots"),
        Curve(SPOKEN[LINEAR], at, constant + viscous * at, _COLOURS[LINEAR]),
    ]
    if fit.power is not None:
        marks.append(Curve(SPOKEN[POWER], at, fit.power.friction(at), _COLOURS[POWER]))
    if fit.screw is not None:
        balls = fit.screw.screw_force(at)
        whole = fit.screw.constant_force + fit.screw.viscous_coefficient * at + balls
        marks += [Curve("of this the balls", at, balls, "blue", "dashed"), Curve(SPOKEN[SCREW], at, whole, "blue")]
    return Chart("friction over speed", Axis("speed", _SPEED), Axis("friction force", _FORCE), marks)


def _measured_friction(fit: MotionFit) -> tuple[NDArray[Any], NDArray[Any]]:
    """The speed of each row, and what is left of its force without mass and offset."""
    equation = fit.equation
    mass, offset = fit.linear.values.tolist()[:2]
    direction, speed = np.sign(equation.filtered(equation.direction)), np.abs(equation.filtered(equation.speed))
    return speed, direction * (equation.force - mass * equation.filtered(equation.acceleration) - offset)


def _columns(fit: MotionFit) -> Columns:
    """The rows that were used: time, filtered speed, force, and that of the model."""
    equation = fit.equation
    return Columns(
        "rows",
        [
            Column("time", equation.log.time[equation.used], _TIME),
            Column("speed", equation.filtered(equation.speed), _SPEED),
            Column("force", equation.force, _FORCE),
            Column(f"force, {SPOKEN[fit.model]}", fit.force(fit.model), _FORCE),
        ],
    )


_NUMBERS = ("forward", "backward", "friction", "std", "offset")


def friction_over_speed(log: MovingLog, other: MovingLog | None) -> SteadyFriction:
    """Friction of a log, and of another one of the same axis."""
    return steady_friction(*[one for one in (log, other) if one is not None])


def sheet_over_speed(friction: SteadyFriction, log: MovingLog) -> Sheet:
    """The table of the speeds, the exponent, and the chart."""
    drive = Quantity("drive", log.unit, Info("", "drive"))
    rows = [
        [
            units.shown(one.speed, _SPEED, digits=3),
            *(Number(getattr(one, name), drive, 3) for name in _NUMBERS),
            str(one.rows),
            str(one.stretches),
        ]
        for one in friction.speeds
    ]
    headings = ("speed", "forward", "backward", "friction", "standard error", "offset", "rows", "stretches")
    low, high = friction.interval
    exponent = "the speeds do not tell an exponent"
    if not math.isnan(low):
        exponent = f"friction as the speed to the power of {friction.exponent:.2f} ({low:.2f} to {high:.2f})"
    speeds, values = ([getattr(one, name) for one in friction.speeds] for name in ("speed", "friction"))
    remarks = [exponent, f"speeds are written in steps of {1e3 * friction.resolution:.3g} mm/s", *log.notes]
    if any(speed.is_one_way for speed in friction.speeds):
        remarks.insert(0, "where a direction is missing, friction is the drive without the offset of the other speeds")
    return Sheet(
        f"{(log.source or ('log', ''))[0]}: friction at constant speed",
        [
            Table("speeds", "Drive at constant speed", headings, rows),
            lines(remarks, "small"),
            Chart(
                "friction over speed",
                Axis("speed", _SPEED),
                Axis("friction", drive),
                [Curve("friction", speeds, values, "blue", "circles")],
            ),
        ],
    )


def document_over_speed(friction: SteadyFriction, log: MovingLog) -> dict[str, Any]:
    """The same for programs, in SI or amperes."""
    low, high = friction.interval
    return {
        "kind": "steady",
        "unit": log.unit,
        "speeds": [
            {name: getattr(one, name) for name in ("speed", *_NUMBERS, "rows", "stretches")} for one in friction.speeds
        ],
        "speed_exponent": None if math.isnan(low) else {"value": friction.exponent, "interval": [low, high]},
        "resolution": friction.resolution,
        "notes": list(log.notes),
        "provenance": {"version": __version__, "log": (log.source or ("log", ""))[0]},
    }
