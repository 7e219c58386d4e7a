"""The sheet of a reversal: where friction is back, by mechanism and by share, the models fitted to it, and curves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.output.sheet import (
    Axis,
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
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.output.sheet import words as words_of
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.engine.sweeps.reversal import PARTS
from ballscrew.physics.moving_balls.friction_states import FitError, LuGre, SlipElement, of_elements
from ballscrew.questions.reversal.compute import ANGLE, MOST, STIFFNESS, TORQUE, TRAVEL, Place, ReversalReport

_ELEMENT, _LUGRE = quantities_of(SlipElement), quantities_of(LuGre)
_DIGITS = 3
_COLOURS: Mapping[str, Colour] = {
    "rolling": "sky",
    "spin_and_curvature": "red",
    "helix": "blue",
    "ball_to_ball": "purple",
    "losses": "green",
}


def sheet(report: ReversalReport) -> Sheet:
    """All that people see of a reversal."""
    warnings = [record for record in report.warnings if record.severity == "warning"]
    notes = [record for record in report.warnings if record.severity != "warning"]
    return Sheet(
        _title(report),
        [
            verdict_lines(report.verdicts),
            warning_lines(warnings),
            _mechanisms(report),
            _swing(report),
            _models(report),
            _elements(report),
            *_charts(report),
            Lines([Line(f"note: {record.text}", "small") for record in notes]),
            Lines([Line(descriptions.design(report.case, plain_text=True), "small")]),
            _columns(report),
        ],
    )


def _title(report: ReversalReport) -> str:
    """``Friction after a reversal: 7000 N, 600 rpm, double nut, preload 5047 N, model reference``."""
    start = "Friction from rest" if report.reversal.from_rest else "Friction after a reversal"
    return f"{start}: {descriptions.title(report.case)}"


def _mechanisms(report: ReversalReport) -> Table:
    """Each part of the steady torque, and where most of it is back."""
    rows: list[Sequence[Cell]] = []
    for name, places in report.swing_by_mechanism.items():
        steady = float(report.reversal.steady_contributions[name])
        rows.append([PARTS.get(name, name), Number(steady, TORQUE, _DIGITS), *_where(places)])
    steady = float(report.reversal.steady_torque)
    rows.append(["all friction", Number(steady, TORQUE, _DIGITS), *_where(report.swing)])
    return Table("parts", "part", ("", "steady torque", f"{MOST:.0%} back at", "travel"), rows)


def _where(places: Sequence[Place]) -> list[Cell]:
    """Angle and travel at which most is back."""
    place = next(place for place in places if place.share == MOST)
    if not place.screw_angle:
        return ["at once", ""]
    return [Number(place.screw_angle, ANGLE, _DIGITS), Number(place.travel, TRAVEL, _DIGITS)]


def _swing(report: ReversalReport) -> Table:
    """Where the shares of the swing are back, of all friction."""
    steady = float(report.reversal.steady_torque)
    start = 0.0 if report.reversal.from_rest else -steady
    rows: list[Sequence[Cell]] = [
        ["torque", *(Number(start + place.share * (steady - start), TORQUE, _DIGITS) for place in report.swing)],
        ["angle of the screw", *(Number(place.screw_angle, ANGLE, _DIGITS) for place in report.swing)],
        ["travel of the nut", *(Number(place.travel, TRAVEL, _DIGITS) for place in report.swing)],
    ]
    return Table("swing", "share of the swing", ("", *(f"{place.share:.0%}" for place in report.swing)), rows)


def _models(report: ReversalReport) -> Table:
    """Dahl in both ranges, and LuGre."""
    lugre, coulomb = report.lugre.model, Number(report.curve.coulomb_torque, TORQUE, _DIGITS)
    stiffness = Number(report.dahl.model.presliding_stiffness, STIFFNESS, _DIGITS)
    rows: list[Sequence[Cell]] = []
    if report.dahl_first is not None:
        first = Number(report.dahl_first.model.presliding_stiffness, STIFFNESS, _DIGITS)
        rows.append(["Dahl, first 0.02°", first, coulomb, "", "", *_errors(report.dahl_first.error)])
    rows.append(["Dahl, tracking", stiffness, coulomb, "", "", *_errors(report.dahl.error)])
    damping = Number(lugre.micro_damping, _LUGRE["micro_damping"], _DIGITS) if lugre.micro_damping else "none chosen"
    viscous = Number(lugre.viscous_slope, _LUGRE["viscous_slope"], _DIGITS)
    rows.append(["LuGre, tracking", stiffness, coulomb, damping, viscous, *_errors(report.lugre.error)])
    at_once = words_of(Number(report.curve.at_once, TORQUE, _DIGITS))
    dry = words_of(Number(lugre.dry_torque, _LUGRE["dry_torque"], _DIGITS))
    note = (
        f"With the sign of the speed, as it follows at once, add {at_once} to Dahl and to the elements, {dry} to LuGre."
    )
    return Table("models", "model", ("", "σ0", "M_c", "σ1", "σ2", "largest error", "rms error"), rows, [note])


def _elements(report: ReversalReport) -> Table:
    """The Maxwell-slip elements, by their number."""
    rows: list[Sequence[Cell]] = []
    for fit in report.slip_elements:
        work = Share(fit.work_error, bar=False) if fit.loops else None
        for number, element in enumerate(fit.elements):
            names = ("stiffness", "slip_torque", "slip_angle")
            numbers = [Number(getattr(element, name), _ELEMENT[name], _DIGITS) for name in names]
            errors: list[Cell] = ["", "", ""] if number else [*_errors(fit.error), work]
            rows.append(["" if number else f"{len(fit.elements)} elements", *numbers, *errors])
    headings = ("", "k", "M", "slides from rest at", "largest error", "rms error", "error of work")
    return Table("elements", "Maxwell-slip (GMS)", headings, rows)


def _errors(error: FitError) -> list[Cell]:
    return [Share(error.largest, bar=False), Share(error.rms, bar=False)]


# -- curves ---------------------------------------------------------------------------------------


def _charts(report: ReversalReport) -> Iterator[Chart]:
    """The parts and the models over the angle, which is logarithmic."""
    x, y = Axis("angle of the screw", ANGLE, log=True), Axis("friction torque", TORQUE)
    yield Chart("by mechanism", x, y, [*_parts(report), Level("", 0.0)])
    yield Chart("models fitted to it", x, y, [*_fitted(report), Level("", 0.0)])


def _shown(report: ReversalReport) -> NDArray[np.bool_]:
    """The places of the curve that a logarithmic axis has."""
    return np.asarray(report.reversal.screw_angle, dtype=float) > 0


def _parts(report: ReversalReport) -> Iterator[Curve]:
    shown = _shown(report)
    angle = np.asarray(report.reversal.screw_angle, dtype=float)[shown]
    for name, values in report.reversal.contributions.items():
        torque = np.asarray(values, dtype=float)[shown]
        if np.any(torque):
            yield Curve(PARTS.get(name, name).partition(",")[0], angle, torque, _COLOURS.get(name, "grey"))
    yield Curve("all friction", angle, np.asarray(report.reversal.screw_torque)[shown])


def _fitted(report: ReversalReport) -> Iterator[Curve]:
    shown, curve = _shown(report), report.curve
    angle = np.asarray(curve.screw_angle, dtype=float)[shown]
    yield Curve("computed", angle, np.asarray(report.reversal.screw_torque)[shown])
    if report.dahl_first is not None:
        first = report.dahl_first.model.torque(angle, curve.initial_torque)
        yield Curve("Dahl, first 0.02°", angle, first + curve.at_once, "orange", "dashed")
    tracking = report.dahl.model.torque(angle, curve.initial_torque)
    yield Curve("Dahl and LuGre, tracking", angle, tracking + curve.at_once, "red", "dashed")
    fewest_and_most = {len(fit.elements): fit for fit in (report.slip_elements[0], report.slip_elements[-1])}
    colours: Sequence[Colour] = ("green", "sky")
    for (count, fit), colour in zip(fewest_and_most.items(), colours, strict=False):
        torque = of_elements(fit.elements, curve)[shown] + curve.at_once
        yield Curve(f"{count} Maxwell-slip elements", angle, torque, colour, "dotted")


def _columns(report: ReversalReport) -> Columns:
    """The curve: angle, travel, and the torque with its parts."""
    reversal = report.reversal
    parts = [Column(PARTS.get(name, name), values, TORQUE) for name, values in reversal.contributions.items()]
    return Columns(
        "curve",
        [
            Column("angle of the screw", reversal.screw_angle, ANGLE),
            Column("travel of the nut", reversal.travel, TRAVEL),
            Column("friction torque", reversal.screw_torque, TORQUE),
            *parts,
        ],
    )
