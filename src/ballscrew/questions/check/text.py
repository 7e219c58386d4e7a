"""Text of the checks of a screw: one screw in full, or one line for each."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned_beside, wrapped
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.check.compute import Checked, Rated
from ballscrew.questions.run.nut_state import NutState
from ballscrew.questions.run.text import rigidity_rows, rules_contradict, stiffness_fields, unloaded_rows
from ballscrew.questions.shared.check_lines import check_lines, shown
from ballscrew.questions.shared.text_tables import shown_or_dash

_RESULT, _LOADS = quantities_of(FrictionResult), quantities_of(BallLoads)
_HEADINGS = ("name", "load", "torque", "eff.", "eff. back", "rigidity", "life", "verdict")
_WIDTH = 66
#: Ratings further apart than this are not of one criterion: rows that ISO 3408-5 meets are within 0.05.
_OTHER_CRITERION = 0.1
_STATIC_CRITERION = "a maker may have another criterion than the dent of 1e-4 of the ball diameter of ISO 3408-5"


def _line(what: str, value: str) -> str:
    return f"  {what:<{_WIDTH}} {value}"


def text(found: Checked) -> str:
    """One screw in full."""
    case, friction = found.case, found.run.friction
    source = "" if case.row is None else f" ({case.row.source})"
    lines = [
        f"{found.name}{source}: {descriptions.title(found.run.case)}",
        "",
        *_geometry(found),
        "",
        "Torque and efficiency",
        *(
            _line(_RESULT[name].info.meaning, shown_or_dash(getattr(friction, name), _RESULT[name]))
            for name in ("screw_torque", "drive_torque", "efficiency", "back_driving_efficiency", "friction_power")
        ),
        *(_line(label, shown_or_dash(torque, _RESULT["screw_torque"])) for label, torque in unloaded_rows(found.run)),
        *(f"  {text}" for text in rules_contradict(found.run)),
        *(f"  {record.text}" for record in ([] if found.heating is None else found.heating.records)),
        *(f"  {record.text}" for record in found.run.verdicts),
        "",
        "Stiffness",
        *_stiffness(found.nut),
        "",
        *_ratings(found),
        "",
        *check_lines(found.checks),
        "",
        f"verdict: {found.verdict}",
        *(f"beware  {record.name}: {record.text}" for record in found.run.conditions),
        "",
        "assumed",
        *(f"  {line}" for line in found.assumed),
    ]
    return "\n".join(line if "\n" in line else wrapped(line) for line in lines)


def _geometry(found: Checked) -> list[str]:
    screw, known = found.case.screw, quantities_of(BallScrew)
    lines = [
        _line(known[name].info.meaning, units.shown(getattr(screw, name), known[name]))
        for name in ("pitch_circle_diameter", "lead", "lead_angle", "ball_diameter", "loaded_balls", "contact_angle")
    ]
    root = LISTED["root_diameter"]
    return ["Geometry", *lines, _line(root.info.meaning, units.shown(found.geometry.root_diameter, root))]


def _stiffness(nut: NutState) -> list[str]:
    lines = [
        _line(_LOADS[n].info.meaning, shown_or_dash(float(getattr(nut.loads, n)), _LOADS[n]))
        for n in stiffness_fields(nut)
    ]
    pressure = _RESULT["maximum_pressure"]
    lines.append(_line(pressure.info.meaning, shown_or_dash(nut.maximum_pressure, pressure)))
    return [*lines, *(_line(meaning, value) for meaning, value in rigidity_rows(nut.rigidity))]


def _ratings(found: Checked) -> list[str]:
    lines = [f"{'Ratings':<{_WIDTH + 2}} {'listed':>12} {'ISO 3408-5':>12}"]
    ratings = found.ratings
    for name in Rated._fields:
        quantity, listed, computed = LISTED[name], getattr(ratings.listed, name), getattr(ratings.computed, name, None)
        cells = ("–" if value is None else units.shown(value, quantity) for value in (listed, computed))
        lines.append(f"  {quantity.info.meaning:<{_WIDTH}} " + " ".join(f"{cell:>12}" for cell in cells))
        if name != "static_load_rating" or listed is None or computed is None:
            continue
        if abs(computed / listed - 1) > _OTHER_CRITERION:
            lines.append(f"    the listed one counts: {_STATIC_CRITERION}")
    return lines


def list_text(found: Sequence[Checked]) -> str:
    """One line a screw; a long verdict goes on below itself."""
    return "\n".join(aligned_beside([_HEADINGS, *map(_cells, found)]))


def _cells(found: Checked) -> list[str]:
    result = found.run.friction
    numbers = [
        units.shown(result.axial_load, LISTED["dynamic_load_rating"]),
        *(
            shown_or_dash(getattr(result, name), _RESULT[name])
            for name in ("screw_torque", "efficiency", "back_driving_efficiency")
        ),
    ]
    # at the same speed as all others: the revolutions would say no more
    life = shown(found.check("running_time"), found.check("running_time").value)
    rigidity = shown_or_dash(float(found.nut.loads.rigidity), _LOADS["rigidity"])
    return [found.name, *numbers, rigidity, life, found.verdict]
