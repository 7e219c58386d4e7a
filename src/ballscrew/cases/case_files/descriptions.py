"""Descriptions of a case: operating point, screw, nut, model, assumptions and omissions, as text."""

from __future__ import annotations

from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.lubricants import described, shown_temperature
from ballscrew.cases.case_files.named_calibration import vendor_rows_like
from ballscrew.cases.schema.case_schema import LAWS, MODELS, name_of_law
from ballscrew.cases.screw_tables.nut_kinds import kind_of
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Bodies, Nut
from ballscrew.physics.components.nut_losses import Seals
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.components.traits import traits_of
from ballscrew.physics.friction.law_names import coefficients
from ballscrew.physics.friction.result import FrictionResult

#: What is assumed of a grease.
_OF_GREASE = "grease: the film of its base oil, no thickener in it, no churning of a fresh filling"
#: Temperature of an oil of a grade where none is given, K.
DEFAULT_TEMPERATURE = 313.15
LEFT_OUT, NOT_COMPARED = "left out: seals, preload, return path, churning", "not compared with measurements"
_OPERATION = fields_of(OperatingState)
_BALL_FORCE = quantities_of(FrictionResult)["ball_to_ball_force"]
_LOSSES = {"seals": "seals", "churning": "churning", "recirculation": "return path"}


def title(case: Case) -> str:
    """Load, speed, nut and model."""
    return ", ".join([*_load_speed_and_nut(case), model_text(case)])


def operating_point_and_nut(case: Case) -> str:
    """Load, speed and nut."""
    return ", ".join(_load_speed_and_nut(case))


def _load_speed_and_nut(case: Case) -> list[str]:
    return [operating_point(case), *([] if case.nut is None else [nut_text(case.nut)])]


def operating_point(case: Case) -> str:
    """``4000 N, 600 rpm``."""
    return ", ".join(units.shown(getattr(case.operation, name), q) for name, q in _OPERATION.items())


def nut_text(nut: Nut) -> str:
    """``double nut, preload 5047 N``."""
    known = fields_of(nut)
    numbers = [
        f", {name.replace('_', ' ')} {units.shown(value, known[name])}"
        for name in known
        if (value := getattr(nut, name)) is not None and (name == "preload" or value)
    ]
    return f"{kind_of(nut)} nut{''.join(numbers)}{', spacer balls' * nut.spacer_balls}"


def model_text(case: Case) -> str:
    """The model, and the laws and numbers that differ from its preset."""
    changes = ", ".join(_change(case, name) for name in case.model.changes)
    return f"model {case.model.name}" + (f", changed: {changes}" if changes else "")


def _change(case: Case, name: str) -> str:
    """A law with the coefficients that differ from the preset, or a number."""
    value, label = getattr(case.model, name), name.replace("_", " ")
    if name not in LAWS:
        number = fields_of(case.model).get(name)
        return label if number is None or value is None else f"{label} {units.shown(value, number)}"
    law, preset = name_of_law(name, value), getattr(MODELS[case.model.name], name)
    usual: Any = preset if type(preset) is type(value) else type(value)
    numbers = [
        f"{coefficient.replace('_', ' ')} {units.shown(getattr(value, coefficient), quantity)}"
        for coefficient, quantity in coefficients(value).items()
        if getattr(value, coefficient) != getattr(usual, coefficient, None)
    ]
    return f"{label} = {law}" + (f" ({', '.join(numbers)})" if numbers else "")


def design(case: Case, plain_text: bool = False) -> str:
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


# -- assumptions and omissions --------------------------------------------------------------------


def assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Inputs that are seldom given and on which the result depends."""
    common = common_assumptions(case, ball_to_ball_force)
    if case.nut is None:
        return [*common, *without_preload(case)]
    bodies = (
        "screw and nut rigid between the balls"
        if case.nut.bodies is None
        else "screw and nut elastic" + (", of a usual size" if _of_usual_size(case.nut.bodies) else "")
    )
    return [*common, bodies, *_spacers(case), *_seals_of_row(case), *map(str, case.notes), *_against_vendors(case)]


def _seals_of_row(case: Case) -> list[str]:
    """The source of the torque of the seals, where it is not that of the row they stand in."""
    row, seals = case.row, case.screw.nut.losses.get("seals")
    if row is None or not row.seal_torque_source or getattr(seals, "seal_torque", None) != row.seal_torque:
        return []
    torque = units.shown(row.seal_torque, fields_of(Seals)["seal_torque"])
    return [f"seals {torque}: {row.seal_torque_source}; give the torque of your seals if you know it"]


def _spacers(case: Case) -> list[str]:
    screw = case.screw
    if not screw.nut.spacer_balls:
        return []
    return [
        f"every second ball is a spacer: {screw.carrying_balls:g} of {screw.loaded_balls:g} carry; ratings as listed"
    ]


def common_assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Oil, materials, roughness and the force between balls: that of a result, or else that of the model."""
    known = {**fields_of(Lubricant), **fields_of(BallScrew)}
    modulus_of = quantities_of(RaceState)["equivalent_modulus"]

    def shown(part: Any, name: str) -> str:
        return units.shown(getattr(part, name), known[name])

    made_from = f"{described(case.oil)} at {shown_temperature(case.oil, DEFAULT_TEMPERATURE)}: " if case.oil else ""
    modulus = units.shown(case.screw.equivalent_modulus(case.screw.screw_raceway), modulus_of)
    return [
        f"oil {made_from}viscosity {shown(case.lubricant, 'viscosity')}, "
        f"pressure–viscosity coefficient {shown(case.lubricant, 'pressure_viscosity_coefficient')}",
        *([_OF_GREASE] if case.lubricant.sheet is not None and case.lubricant.sheet.is_grease else []),
        f"equivalent modulus {modulus}",
        "roughness of balls, screw, nut "
        + ", ".join(shown(case.screw, f"{part}_roughness") for part in ("ball", "screw", "nut")),
        f"force between balls {_between_balls(case, ball_to_ball_force)}",
    ]


def _between_balls(case: Case, force: float | None) -> str:
    """The force between balls; without that of a result, balls may have loads of their own, and a share of each."""
    model = case.model
    if case.screw.nut.spacer_balls:
        return "none: spacer balls part them"
    law: Any = model.ball_force
    if force is None and not traits_of(law).uses_imposed_force:
        share = getattr(law, "share_of_load", None)
        return f"{share:.4g} of the load of each" if share is not None else f"by {name_of_law('ball_force', law)}"
    return units.shown(model.imposed_ball_force(case.screw) if force is None else force, _BALL_FORCE)


def without_preload(case: Case) -> list[str]:
    """The nut that is missing where the row of a preloaded nut is computed without one."""
    kind = "" if case.row is None else case.row.nut
    if case.nut is not None or kind in ("", "single"):
        return []
    return [f'without preload: the row is a {kind} nut, and none is given; add type = "{kind}" and a preload to [nut]']


def _of_usual_size(bodies: Bodies) -> bool:
    return all(getattr(bodies, name) is None for name in fields_of(bodies))


def _against_vendors(case: Case) -> list[str]:
    """What ``ballscrew validate`` says of nuts like this one, where the model is the one it was run with."""
    near = vendor_rows_like(case)
    if near is None:
        return []
    how = "without calibration" if case.calibration is None else f"which {case.calibration.name} was fitted to"
    return [
        f"no-load torque at 100 rpm, ISO VG 100 at 25 degC, model / vendor: {near.mean:.2f} ± {near.scatter:.2f} for "
        f"the {len(near.rows)} rows of {near.data} most like this nut, {how} (ballscrew validate)"
    ]


def left_out(case: Case) -> str:
    """Losses that are not in the torque; of a case without a fit also that it was not compared with measurements."""
    losses = LEFT_OUT
    if case.nut is not None:
        missing = [words for slot, words in _LOSSES.items() if slot not in case.nut.losses]
        losses = f"left out: {', '.join(missing)}" if missing else ""
    return "; ".join(filter(None, [losses, "" if case.fit.get("log") else NOT_COMPARED]))


def of_fit(case: Case) -> list[str]:
    """The log of a fitted case."""
    return [f"calibrated to {case.fit['log']}"] if case.fit.get("log") else []


def assumed(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Assumptions, omissions and the origin of a fit, one text each."""
    return [*filter(None, [*assumptions(case, ball_to_ball_force), left_out(case)]), *of_fit(case)]
