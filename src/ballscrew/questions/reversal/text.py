"""``ballscrew reversal``: what comes back where, on the terminal; the fitted models; the sentences of the picture."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.engine.sweeps.reversal import PARTS
from ballscrew.physics.moving_balls.friction_states import FitError, LuGre, SlipElement
from ballscrew.questions.reversal.compute import ANGLE, MOST, STIFFNESS, TORQUE, TRAVEL, Place, ReversalReport
from ballscrew.questions.shared.text_tables import shown_or_dash

_ELEMENT, _LUGRE = quantities_of(SlipElement), quantities_of(LuGre)
_DIGITS = 3


def text(report: ReversalReport) -> str:
    """A reversal in full: by mechanism, by share of the swing, the models, and what is to be said of them."""
    lines = [
        title(report),
        "",
        descriptions.design(report.case, plain_text=True),
        "",
        *_mechanisms(report),
        "",
        *_swing(report),
        "",
        *_models(report),
        "",
        *_elements(report),
        "",
        *(record.text for record in report.verdicts),
        *(f"beware  {record.text}" for record in report.warnings if record.severity == "warning"),
        *(f"note  {record.text}" for record in report.warnings if record.severity != "warning"),
    ]
    return "\n".join(line if "\n" in line else wrapped(line) for line in lines)


def title(report: ReversalReport) -> str:
    """What it is, at which load and speed, and of which nut and model."""
    start = "Friction from rest" if report.reversal.from_rest else "Friction after a reversal"
    return f"{start}: {descriptions.title(report.case)}"


def _mechanisms(report: ReversalReport) -> list[str]:
    """Each part of the steady torque, and where most of it is back."""
    rows = [["part", "steady torque", f"{MOST:.0%} back at", "travel"]]
    for name, places in report.places_by_mechanism.items():
        steady = float(report.reversal.steady_contributions[name])
        rows.append([PARTS.get(name, name), _shown(steady, TORQUE), *_where(places)])
    rows.append(["all friction", _shown(float(report.reversal.steady_torque), TORQUE), *_where(report.places)])
    return aligned(rows)


def _where(places: Sequence[Place]) -> list[str]:
    """Angle and travel at which most is back."""
    place = next(one for one in places if one.share == MOST)
    if not place.screw_angle:
        return ["at once", ""]
    return [_shown(place.screw_angle, ANGLE), _shown(place.travel, TRAVEL)]


def _swing(report: ReversalReport) -> list[str]:
    """Where the shares of the swing are back, of all friction."""
    steady = float(report.reversal.steady_torque)
    start = 0.0 if report.reversal.from_rest else -steady
    rows = [["share of the swing", *(f"{one.share:.0%}" for one in report.places)]]
    rows.append(["torque", *(_shown(start + one.share * (steady - start), TORQUE) for one in report.places)])
    rows.append(["angle of the screw", *(_shown(one.screw_angle, ANGLE) for one in report.places)])
    rows.append(["travel of the nut", *(_shown(one.travel, TRAVEL) for one in report.places)])
    return aligned(rows)


def _models(report: ReversalReport) -> list[str]:
    """Dahl in both ranges, and LuGre."""
    lugre = report.lugre.model
    rows = [["model", "σ0", "M_c", "σ1", "σ2", "largest error", "rms error"]]
    if report.first is not None:
        stiffness = _shown(report.first.model.presliding_stiffness, STIFFNESS)
        rows.append(["Dahl, first 0.02°", stiffness, _coulomb(report), "", "", *_errors(report.first.error)])
    stiffness = _shown(report.tracking.model.presliding_stiffness, STIFFNESS)
    rows.append(["Dahl, tracking", stiffness, _coulomb(report), "", "", *_errors(report.tracking.error)])
    damping = _shown(lugre.micro_damping, _LUGRE["micro_damping"]) if lugre.micro_damping else "none chosen"
    viscous = _shown(lugre.viscous_slope, _LUGRE["viscous_slope"])
    rows.append(["LuGre, tracking", stiffness, _coulomb(report), damping, viscous, *_errors(report.lugre.error)])
    at_once = _shown(report.curve.at_once, TORQUE)
    dry = _shown(lugre.dry_torque, _LUGRE["dry_torque"])
    return [
        *aligned(rows),
        f"with the sign of the speed, as it follows at once, add {at_once} to Dahl and to the elements, {dry} to LuGre",
    ]


def _coulomb(report: ReversalReport) -> str:
    return _shown(report.curve.coulomb_torque, TORQUE)


def _elements(report: ReversalReport) -> list[str]:
    """The Maxwell-slip elements, by their number."""
    rows = [["Maxwell-slip (GMS)", "k", "M", "slides from rest at", "largest error", "rms error", "error of work"]]
    for fit in report.elements:
        work = f"{fit.work_error:.0%}" if fit.loops else "–"
        for number, one in enumerate(fit.elements):
            errors = ["", "", ""] if number else [*_errors(fit.error), work]
            cells = [_shown(getattr(one, name), _ELEMENT[name]) for name in ("stiffness", "slip_torque", "slip_angle")]
            rows.append(["" if number else f"{len(fit.elements)} elements", *cells, *errors])
    return aligned(rows)


def _errors(error: FitError) -> list[str]:
    return [f"{one:.1%}" for one in (error.largest, error.rms)]


def _shown(value: float, quantity: Quantity) -> str:
    return units.shown(value, quantity, _DIGITS) if math.isfinite(value) else shown_or_dash(value, quantity)


def caption(report: ReversalReport) -> str:
    """The caption of the picture."""
    said = [descriptions.design(report.case), *(record.text for record in (*report.verdicts, *report.warnings))]
    return " ".join(f"{sentence[:1].upper()}{sentence[1:]}." for sentence in said)
