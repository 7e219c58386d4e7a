"""A result for people (tables on the terminal) and for programs (one JSON object)."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from ballscrew import __version__
from ballscrew.components.contact import RaceState
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.interfaces import config, units
from ballscrew.quantities import fields_of, quantities_of
from ballscrew.result import MECHANISMS, FrictionResult

#: What the terminal shows, in this order.
SHOWN = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "efficiency", "back_driving_efficiency",
    "friction_power", "contact_load", "entrainment_speed",
)  # fmt: skip
SHOWN_OF_CONTACT = (
    "semi_major_axis", "semi_minor_axis", "maximum_pressure", "minimum_film_thickness", "film_parameter",
    "friction_coefficient", "pure_rolling_offset", "hydrodynamic_rolling_force", "sliding_force", "tangential_force",
    "curvature_friction_moment", "elastic_resistance_moment", "friction_torque",
)  # fmt: skip
_BAR_WIDTH = 24
#: What is varied, not computed.
_OPERATION = fields_of(Operation)


def results(result: FrictionResult) -> dict[str, Any]:
    """All results at one point in SI, as plain numbers and nested tables."""
    found: dict[str, Any] = {n: getattr(result, n) for n in quantities_of(FrictionResult) if n not in _OPERATION}
    found["valid"] = bool(found["valid"])
    found["contributions"] = dict(result.contributions)
    found["validity"] = {reason: bool(mask) for reason, mask in result.validity.items()}
    for side in ("screw", "nut"):
        state = getattr(result, side)
        found[side] = {name: getattr(state, name) for name in quantities_of(RaceState)}
    return found


def result_units() -> dict[str, Any]:
    """The units of :func:`results`, in the same places."""
    side = {name: q.unit for name, q in quantities_of(RaceState).items()}
    own = {name: q.unit for name, q in quantities_of(FrictionResult).items() if name not in _OPERATION}
    own.pop("valid")
    return {**own, "contributions": dict.fromkeys(MECHANISMS, own["screw_torque"]), "screw": side, "nut": side}


def json_text(case: config.Case, result: FrictionResult) -> str:
    """One JSON object: inputs, results and units in SI, warnings, provenance. Non-finite is null."""
    document = {
        "inputs": config.inputs(case),
        "results": results(result),
        "units": result_units(),
        "warnings": result.warnings,
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }
    return json.dumps(_plain(document), indent=2, ensure_ascii=False, allow_nan=False)


def _plain(value: Any) -> Any:
    """Numbers JSON can say: NumPy's as Python's, what is not finite as null."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.item())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value


def print_result(case: config.Case, result: FrictionResult) -> None:
    """Tables on the terminal: torque and efficiency, its parts, both contacts, what to beware of."""
    console = Console(highlight=False)
    operation = quantities_of(FrictionResult)
    load = units.shown(result.axial_load, operation["axial_load"])
    speed = units.shown(result.screw_speed, operation["screw_speed"])
    console.print(f"[bold]{load}, {speed}[/bold], model [bold]{case.model.label}[/bold]\n")
    console.print(_assumed(case, result), highlight=False, style="dim", soft_wrap=True)
    console.print(_quantities(result))
    console.print(_parts(result, "█" if "utf" in console.encoding.lower() else "#"))
    console.print(_contacts(result))
    for warning in result.warnings:
        console.print(f"beware  {warning}", style="yellow", markup=False, soft_wrap=True)


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)
    table.add_column(columns[0])
    for column in columns[1:]:
        table.add_column(column, justify="right")
    return table


def _assumed(case: config.Case, result: FrictionResult) -> str:
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
        f"force between balls {between_balls}\n"
    )


def _quantities(result: FrictionResult) -> Table:
    known = quantities_of(FrictionResult)
    table = _table("Torque and efficiency", "", "", "")
    for name in SHOWN:
        value = getattr(result, name)
        locked = name == "back_driving_efficiency" and value <= 0
        note = "self-locking" if locked else ""
        table.add_row(known[name].info.meaning, units.shown(value, known[name]), note)
    return table


def _parts(result: FrictionResult, block: str) -> Table:
    """The parts of the torque as bars, so that the eye sees what matters."""
    quantity = quantities_of(FrictionResult)["screw_torque"]
    table = _table("\nWhere the friction torque on the screw comes from", "", "", "", "")
    table.columns[-1].justify = "left"
    total = float(result.screw_torque)
    for mechanism, words in MECHANISMS.items():
        part = float(result.contributions[mechanism])
        share = part / total if total else 0.0
        bar = block * round(_BAR_WIDTH * max(0.0, min(share, 1.0)))
        table.add_row(words, units.shown(part, quantity), f"{share:.1%}", bar)
    return table


def _contacts(result: FrictionResult) -> Table:
    known = quantities_of(RaceState)
    table = _table("\nContacts", "", "screw", "nut")
    for name in SHOWN_OF_CONTACT:
        cells = [units.shown(getattr(side, name), known[name]) for side in (result.screw, result.nut)]
        table.add_row(known[name].info.meaning, *cells)
    return table
