"""A result for people (tables on the terminal) and for programs (one JSON object)."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from ballscrew import __version__
from ballscrew.components.contact import RaceState
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.interfaces import config, units
from ballscrew.quantities import Quantity, fields_of, quantities_of
from ballscrew.result import MECHANISMS, QUADRANTS, FrictionResult

#: What the terminal shows, in this order.
SHOWN = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "efficiency", "back_driving_efficiency",
    "friction_power", "contact_load", "entrainment_speed",
)  # fmt: skip
_FILM = (
    "semi_major_axis", "semi_minor_axis", "maximum_pressure", "minimum_film_thickness", "film_parameter",
    "friction_coefficient",
)  # fmt: skip
_FORCES = (
    "hydrodynamic_rolling_force", "sliding_force", "traction_limit", "tangential_force", "curvature_friction_moment",
    "elastic_resistance_moment", "friction_torque",
)  # fmt: skip
#: What the terminal shows of the contacts, where curvature is the only slip and elsewhere.
SHOWN_OF_CONTACT: Mapping[bool, Sequence[str]] = {
    True: (*_FILM, "pure_rolling_offset", *_FORCES),
    False: (*_FILM, "spin_parameter", "creep_speed", "lateral_slip_speed", *_FORCES),
}
_BAR_WIDTH = 24
#: What is varied, not computed.
_OPERATION = fields_of(Operation)
#: The results that the numbers of a quadrant are like.
_OF_QUADRANT = {"shaft_torque": "drive_torque", "shaft_power": "friction_power", "efficiency": "efficiency"}
#: What is true or false, and has no unit.
_MASKS = ("valid", "self_locking")


def results(result: FrictionResult) -> dict[str, Any]:
    """All results at one point in SI, as plain numbers and nested tables."""
    found: dict[str, Any] = {n: getattr(result, n) for n in quantities_of(FrictionResult) if n not in _OPERATION}
    found["contributions"] = dict(result.contributions)
    found["quadrants"] = {name: quadrant._asdict() for name, quadrant in result.quadrants.items()}
    found["validity"] = {reason: bool(mask) for reason, mask in result.validity.items()}
    for side in ("screw", "nut"):
        state = getattr(result, side)
        found[side] = {name: getattr(state, name) for name in quantities_of(RaceState)}
    return found


def result_units() -> dict[str, Any]:
    """The units of :func:`results`, in the same places."""
    side = {name: q.unit for name, q in quantities_of(RaceState).items()}
    left_out = (*_OPERATION, *_MASKS)
    own = {name: q.unit for name, q in quantities_of(FrictionResult).items() if name not in left_out}
    quadrant = {name: own[alike] for name, alike in _OF_QUADRANT.items()}
    return {
        **own,
        "contributions": dict.fromkeys(MECHANISMS, own["screw_torque"]),
        "quadrants": dict.fromkeys(QUADRANTS, quadrant),
        "screw": side,
        "nut": side,
    }


def json_text(case: config.Case, result: FrictionResult) -> str:
    """One JSON object: inputs, results and units in SI, warnings, provenance. Non-finite is null."""
    document = {
        "inputs": config.inputs(case),
        "results": results(result),
        "units": result_units(),
        "warnings": result.warnings,
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }
    return json.dumps(plain(document), indent=2, ensure_ascii=False, allow_nan=False)


def plain(value: Any) -> Any:
    """Numbers JSON can say: NumPy's as Python's, what is not finite as null."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.item())
    if isinstance(value, float):
        return value + 0.0 if math.isfinite(value) else None
    return value


def operating_point(case: config.Case) -> str:
    """``4000 N, 600 rpm``."""
    return ", ".join(units.shown(getattr(case.operation, name), q) for name, q in _OPERATION.items())


def print_result(case: config.Case, result: FrictionResult) -> None:
    """Tables on the terminal: torque and efficiency, its parts, both directions, both contacts, what to beware of."""
    console = Console(highlight=False)
    console.print(f"[bold]{operating_point(case)}[/bold], model [bold]{case.model.label}[/bold]\n")
    console.print(assumed(case, result) + "\n", highlight=False, style="dim", soft_wrap=True)
    console.print(_quantities(result))
    for line in verdicts(result):
        console.print(line, style="bold", markup=False, soft_wrap=True)
    if any(float(part) for part in result.contributions.values()):
        console.print(_parts(result, "█" if "utf" in console.encoding.lower() else "#"))
    console.print(_quadrants(result))
    console.print(_contacts(result))
    for warning in result.warnings:
        console.print(f"beware  {warning}", style="yellow", markup=False, soft_wrap=True)


def verdicts(result: FrictionResult) -> list[str]:
    """What drives what, and whether the balls roll, in words."""
    if float(result.axial_load) == 0:
        return ["no load drives the screw"]
    held, share = float(result.holding_torque), float(result.rolling_share)
    torque = units.shown(abs(held), quantities_of(FrictionResult)["holding_torque"])
    when = "at this speed" if float(result.screw_speed) else "at rest"
    lines: list[str] = []
    if held > 0:
        lines.append(f"back-drives: the load turns the screw; {torque} on the shaft hold it {when}")
    elif held <= 0:
        lines.append(f"self-locking: the load alone does not turn the screw {when}; {torque} on the shaft lower it")
    if share < 1:
        lines.append(f"skids: friction carries only {share:.1%} of what resists the rolling of a ball")
    return lines


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)
    table.add_column(columns[0])
    for column in columns[1:]:
        table.add_column(column, justify="right")
    return table


def assumed(case: config.Case, result: FrictionResult) -> str:
    """What people seldom write down and the result depends on."""
    known = {
        **quantities_of(RaceState),
        **quantities_of(FrictionResult),
        **fields_of(Lubricant),
        **fields_of(BallScrew),
    }

    def shown(part: Any, name: str) -> str:
        return units.shown(getattr(part, name), known[name])

    roughness = ", ".join(shown(case.screw, f"{part}_roughness") for part in ("ball", "screw", "nut"))
    made_from = f"{case.oil['grade']}: " if "grade" in case.oil else ""
    oil = f"{shown(case.lubricant, 'viscosity')}, {shown(case.lubricant, 'pressure_viscosity_coefficient')}"
    modulus, between_balls = shown(result.screw, "equivalent_modulus"), shown(result, "ball_to_ball_force")
    return (
        f"oil {made_from}{oil}; equivalent modulus {modulus}; roughness of balls, screw, nut {roughness}; "
        f"force between balls {between_balls}"
    )


def design(case: config.Case) -> str:
    """The screw in one line, for a caption."""
    known = fields_of(BallScrew)
    fields = {"d$_m$": "pitch_circle_diameter", "lead": "lead", "d$_w$": "ball_diameter", "α": "contact_angle"}
    sizes = [f"{symbol} {units.shown(getattr(case.screw, name), known[name])}" for symbol, name in fields.items()]
    conformities = f"conformity {case.screw.screw_conformity:g} and {case.screw.nut_conformity:g}"
    return f"screw {', '.join(sizes)}, {case.screw.loaded_balls:g} balls, {conformities}"


def _shown(value: Any, quantity: Quantity) -> str:
    """A value with its unit; a dash where there is none."""
    return units.shown(value + 0.0, quantity) if math.isfinite(value) else "–"  # adding zero: no "-0"


def _quantities(result: FrictionResult) -> Table:
    known = quantities_of(FrictionResult)
    table = _table("Torque and efficiency", "", "")
    for name in SHOWN:
        table.add_row(known[name].info.meaning, _shown(getattr(result, name), known[name]))
    return table


def _parts(result: FrictionResult, block: str) -> Table:
    """The parts of the torque as bars, so that the eye sees what matters; what is zero is left out."""
    quantity = quantities_of(FrictionResult)["screw_torque"]
    table = _table("\nWhere the friction torque on the screw comes from", "", "", "", "")
    table.columns[-1].justify = "left"
    total = float(result.screw_torque)
    for mechanism, words in MECHANISMS.items():
        part = float(result.contributions[mechanism])
        if part == 0:
            continue
        share = part / total if total else 0.0
        bar = block * round(_BAR_WIDTH * max(0.0, min(share, 1.0))) if math.isfinite(share) else ""
        table.add_row(words, _shown(part, quantity), f"{share:.1%}" if math.isfinite(share) else "–", bar)
    return table


def _quadrants(result: FrictionResult) -> Table:
    """All four quadrants of load and rotation; the signs are those of the first."""
    known = quantities_of(FrictionResult)
    table = _table("\nThe screw, by direction of load and rotation", "", "load", "rotation", "torque", "power", "η")
    for name, quadrant in result.quadrants.items():
        signs = ["+" if sign > 0 else "-" for sign in (quadrant.load_sign, quadrant.speed_sign)]
        efficiency = float(quadrant.efficiency)
        drives = efficiency > 0 or quadrant.load_sign == quadrant.speed_sign or math.isnan(efficiency)
        table.add_row(
            name,
            *signs,
            *(_shown(getattr(quadrant, name), known[_OF_QUADRANT[name]]) for name in ("shaft_torque", "shaft_power")),
            _shown(efficiency, known["efficiency"]) if drives else "locks",
        )
    return table


def _contacts(result: FrictionResult) -> Table:
    known = quantities_of(RaceState)
    table = _table("\nContacts", "", "screw", "nut")
    for name in SHOWN_OF_CONTACT[result.slip_is_curvature_alone]:
        cells = [_shown(getattr(side, name), known[name]) for side in (result.screw, result.nut)]
        table.add_row(known[name].info.meaning, *cells)
    return table
