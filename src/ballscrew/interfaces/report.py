"""A result for people (tables on the terminal) and for programs (one JSON object)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table

from ballscrew import __version__
from ballscrew.assembly import NutFriction
from ballscrew.components.contact import RaceState
from ballscrew.components.laws import ProportionalBallForce
from ballscrew.components.materials import TEMPERATURE, Lubricant
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.interfaces import config, units
from ballscrew.interfaces.schema import LAWS, MODELS, coefficients_of, name_of_law
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
#: Names of a contact's results where there is little room.
SHORT: Mapping[str, str] = {
    "semi_major_axis": "semi-axis across the rolling direction",
    "semi_minor_axis": "semi-axis along the rolling direction",
    "spin_parameter": "spin parameter E_s",
    "creep_speed": "creep of the race",
    "lateral_slip_speed": "lateral slip",
    "traction_limit": "traction limit",
}
#: What an oil of a grade has where no temperature is given, K.
DEFAULT_TEMPERATURE = 313.15
LEFT_OUT, NOT_COMPARED = "left out: seals, preload, return path, churning", "not compared with measurements"
_OUTSIDE = " (outside the model's validity)"
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


def document(case: config.Case, result: FrictionResult) -> dict[str, Any]:
    """Inputs, results and units in SI, warnings, provenance."""
    return {
        "inputs": config.inputs(case),
        "results": results(result),
        "units": result_units(),
        "warnings": result.warnings,
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }


def operating_point(case: config.Case) -> str:
    """``4000 N, 600 rpm``."""
    return ", ".join(units.shown(getattr(case.operation, name), q) for name, q in _OPERATION.items())


def print_result(case: config.Case, result: FrictionResult) -> None:
    """Tables on the terminal: torque and efficiency, its parts, both directions, both contacts, what to beware of."""
    console = Console(highlight=False)
    console.print(f"[bold]{operating_point(case)}, {model_in_words(case)}[/bold]\n", soft_wrap=True)
    for line in (design(case, plain_text=True), *assumed(case, result).split("; "), *no_nut(case)):
        console.print(line, style="dim", markup=False, soft_wrap=True)
    console.print()
    console.print(_quantities(result))
    for line in verdicts(result, at_rest(case)):
        console.print(line, style="bold", markup=False, soft_wrap=True)
    # without load nothing can skid, and at rest the verdict has said it
    said = float(result.axial_load) == 0 or (float(result.screw_speed) == 0 and float(result.rolling_share) < 1)
    for warning in result.warnings:
        if said and warning.startswith("skid: "):
            continue
        console.print(f"beware  {warning}", style="yellow", markup=False, soft_wrap=True)
    for line in (left_out(case), *of_fit(case)):
        console.print(line, markup=False, soft_wrap=True)
    if any(float(part) for part in result.contributions.values()):
        console.print(parts_table(result.contributions, float(result.screw_torque), console.encoding))
    console.print(_quadrants(result))
    console.print(_contacts(result))


def left_out(case: config.Case, words: str = LEFT_OUT) -> str:
    """What is not in the torque, and whether anybody measured it; a case from a fit names its log instead."""
    return "; ".join(filter(None, [words, "" if case.fit.get("log") else NOT_COMPARED]))


def no_nut(case: config.Case) -> list[str]:
    """What is missing where the row of a preloaded nut is computed without one."""
    kind = "" if case.row is None else case.row.nut
    if case.parts is not None or kind in ("", "single"):
        return []
    return [f'without preload: the row is a {kind} nut, and none is given; add type = "{kind}" and a preload to [nut]']


def of_fit(case: config.Case) -> list[str]:
    """What a fit left beside the numbers of the case: its log, and torque that no model of the balls has."""
    return [*([f"calibrated to {case.fit['log']}"] if case.fit.get("log") else []), *constant_torque(case)]


def constant_torque(case: config.Case) -> list[str]:
    """Friction that a fit found and that no model of the balls has."""
    constant = case.fit.get("constant_torque")
    return (
        [f"not in it: {constant} that the log has at all loads and speeds, of seals and bearings"] if constant else []
    )


def at_rest(case: config.Case) -> FrictionResult:
    """The case at rest: what a brake is sized for."""
    return case.model(case.screw, case.lubricant, axial_load=case.operation.axial_load, screw_speed=0.0)


def verdicts(result: FrictionResult, rest: FrictionResult) -> list[str]:
    """What drives what, in motion and at rest, and whether the balls roll, in words."""
    if float(result.axial_load) == 0:
        return ["no load: nothing to hold"]
    moving, share = bool(result.screw_speed), float(result.rolling_share)
    lines = [line for line in (holding(result, "at this speed") if moving else "", holding(rest, "at rest")) if line]
    if share < 1 and moving:
        lines.append(f"skids: friction carries only {share:.1%} of what resists the rolling of a ball")
    elif share < 1:
        lines.append(f"at rest: friction carries only {share:.1%} of what resists rolling")
    return lines


def holding(result: FrictionResult | NutFriction, when: str) -> str:
    """Whether the load turns the screw, and the torque that holds or lowers it; nothing where there is no number."""
    held = float(result.holding_torque)
    torque = units.shown(abs(held), quantities_of(FrictionResult)["holding_torque"])
    beware = "" if result.valid else _OUTSIDE
    if held > 0:
        return f"back-drives: the load turns the screw; {torque} on the shaft hold it {when}{beware}"
    if held <= 0:
        return f"self-locking: the load alone does not turn the screw {when}; {torque} on the shaft lower it{beware}"
    return ""


def table_of(title: str, *columns: str) -> Table:
    """A table of the house: a bold title, the first column to the left and the others to the right."""
    table = Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)
    table.add_column(columns[0])
    for column in columns[1:]:
        table.add_column(column, justify="right")
    return table


def assumed(case: config.Case, result: FrictionResult | None = None) -> str:
    """What people seldom write down and the result depends on. Without a ``result`` the balls are those of a nut."""
    known = {
        **quantities_of(RaceState),
        **quantities_of(FrictionResult),
        **fields_of(Lubricant),
        **fields_of(BallScrew),
    }

    def shown(part: Any, name: str) -> str:
        return units.shown(getattr(part, name), known[name])

    roughness = ", ".join(shown(case.screw, f"{part}_roughness") for part in ("ball", "screw", "nut"))
    made_from = f"{case.oil['grade']} at {_temperature(case)}: " if "grade" in case.oil else ""
    oil = (
        f"viscosity {shown(case.lubricant, 'viscosity')}, "
        f"pressure–viscosity coefficient {shown(case.lubricant, 'pressure_viscosity_coefficient')}"
    )
    modulus = units.shown(case.screw.equivalent_modulus(case.screw.screw_raceway), known["equivalent_modulus"])
    return (
        f"oil {made_from}{oil}; equivalent modulus {modulus}; roughness of balls, screw, nut {roughness}; "
        f"force between balls {_between_balls(case, result)}"
    )


def _between_balls(case: config.Case, result: FrictionResult | None) -> str:
    """The force between balls; on a nut each ball may have its own load, and a share of it."""
    model = case.model
    if result is None and isinstance(model.ball_force, ProportionalBallForce):
        return f"{model.ball_force.share_of_load:.4g} of the load of each"
    force = model.imposed_ball_force(case.screw) if result is None else result.ball_to_ball_force
    return units.shown(force, quantities_of(FrictionResult)["ball_to_ball_force"])


def _temperature(case: config.Case) -> str:
    return units.shown(case.oil.get("temperature", DEFAULT_TEMPERATURE), TEMPERATURE)


def model_in_words(case: config.Case) -> str:
    """The model, and the laws and numbers that are not as in its preset."""
    changed = case.model.label.partition(", changed: ")[2]
    words = [_changed(case, name) for name in changed.split(", ") if name]
    return f"model {case.model.name}" + (f", changed: {', '.join(words)}" if words else "")


def _changed(case: config.Case, name: str) -> str:
    """A law by its name and with the coefficients that are not as in the preset, or a number."""
    value, label = getattr(case.model, name), name.replace("_", " ")
    if name not in LAWS:
        number = fields_of(case.model).get(name)
        return label if number is None or value is None else f"{label} {units.shown(value, number)}"
    law, preset = name_of_law(name, value), getattr(MODELS[case.model.name], name)
    usual: Any = preset if type(preset) is type(value) else type(value)
    numbers = [
        f"{coefficient.replace('_', ' ')} {units.shown(getattr(value, coefficient), quantity)}"
        for coefficient, quantity in coefficients_of(name, law).items()
        if getattr(value, coefficient) != getattr(usual, coefficient)
    ]
    return f"{label} {law}" + (f" ({', '.join(numbers)})" if numbers else "")


def design(case: config.Case, plain_text: bool = False) -> str:
    """The screw in one line, for a caption or as plain text for the terminal."""
    known = fields_of(BallScrew)
    names = ("pitch_circle_diameter", "lead", "ball_diameter", "contact_angle")
    symbols = ("pitch circle", "lead", "balls", "contact angle") if plain_text else ("d$_m$", "lead", "d$_w$", "α")
    fields = dict(zip(symbols, names, strict=True))
    sizes = [f"{symbol} {units.shown(getattr(case.screw, name), known[name])}" for symbol, name in fields.items()]
    starts = f", {case.screw.starts:g} starts" if case.screw.starts > 1 else ""
    conformities = f"conformity {case.screw.screw_conformity:g} and {case.screw.nut_conformity:g}"
    return (
        f"screw {', '.join(sizes)}, {case.screw.loaded_balls:g} {'loaded ' * plain_text}balls{starts}, {conformities}"
    )


def shown_or_dash(value: Any, quantity: Quantity) -> str:
    """A value with its unit; a dash where there is none."""
    return units.shown(value + 0.0, quantity) if math.isfinite(value) else "–"  # adding zero: no "-0"


def _quantities(result: FrictionResult) -> Table:
    known = quantities_of(FrictionResult)
    table = table_of("Torque and efficiency", "", "")
    for name in SHOWN:
        table.add_row(known[name].info.meaning, shown_or_dash(getattr(result, name), known[name]))
    return table


def parts_table(contributions: Mapping[str, Any], total: float, encoding: str) -> Table:
    """The parts of the torque as bars, so that the eye sees what matters; what is zero is left out."""
    quantity = quantities_of(FrictionResult)["screw_torque"]
    block = "█" if "utf" in encoding.lower() else "#"
    table = table_of("\nWhere the friction torque on the screw comes from", "", "", "", "")
    table.columns[-1].justify = "left"
    for mechanism, value in contributions.items():
        part = float(value)
        if part == 0:
            continue
        share = part / total if total else 0.0
        bar = block * round(_BAR_WIDTH * max(0.0, min(share, 1.0))) if math.isfinite(share) else ""
        words = MECHANISMS.get(mechanism, mechanism)
        table.add_row(words, shown_or_dash(part, quantity), f"{share:.1%}" if math.isfinite(share) else "–", bar)
    return table


def _quadrants(result: FrictionResult) -> Table:
    """All four quadrants of load and rotation; the signs are those of the first."""
    loaded = float(result.axial_load) != 0
    known = quantities_of(FrictionResult)
    table = table_of("\nThe screw, by direction of load and rotation", "", "load", "rotation", "torque", "power", "η")
    for name, quadrant in result.quadrants.items():
        signs = ["+" if sign > 0 else "-" for sign in (quadrant.load_sign, quadrant.speed_sign)]
        efficiency = float(quadrant.efficiency)
        drives = efficiency > 0 or quadrant.load_sign == quadrant.speed_sign or math.isnan(efficiency)
        table.add_row(
            name,
            *signs,
            *(shown_or_dash(getattr(quadrant, n), known[_OF_QUADRANT[n]]) for n in ("shaft_torque", "shaft_power")),
            shown_or_dash(efficiency, known["efficiency"]) if drives else "locks" if loaded else "–",
        )
    return table


def _contacts(result: FrictionResult) -> Table:
    known = quantities_of(RaceState)
    table = table_of("\nContacts", "", "screw", "nut")
    for name in SHOWN_OF_CONTACT[result.slip_is_curvature_alone]:
        cells = [shown_or_dash(getattr(side, name), known[name]) for side in (result.screw, result.nut)]
        table.add_row(SHORT.get(name, known[name].info.meaning), *cells)
    return table
