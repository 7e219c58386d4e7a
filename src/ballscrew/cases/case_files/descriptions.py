"""Operating point, nut, model, assumptions and omissions of a case in words, with numbers in display units.

The inputs of a case in SI, by section.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.basis.references import citations_of, documentation, keys_in
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import duty_tables, support_tables
from ballscrew.cases.case_files.case import USUAL_LIMITS, Case
from ballscrew.cases.case_files.lubricants import described
from ballscrew.cases.case_files.named_calibration import by_rules, make_of, vendor_rows_like
from ballscrew.cases.case_files.nut_tables import seal_torque_source
from ballscrew.cases.schema.case_schema import MODELS, name_of_law
from ballscrew.cases.schema.duty_schema import CONSTANT_EFFICIENCY
from ballscrew.cases.screw_tables.nut_kinds import ENDS, kind_of
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Bodies, Nut
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import MATERIALS, BallScrew
from ballscrew.physics.friction.model import LAWS, coefficients
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.laws.nut_losses import Seals
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.sizing.installation import Installation
from ballscrew.physics.sizing.rules import rule_of

#: Temperature of an oil of a grade where none is given, K.
_DEFAULT_TEMPERATURE = 313.15
#: Losses that are left out where the case has none of them, by their slot; without a nut, the preload as well.
_LOSSES: Mapping[str, str] = {"seals": "seals", "churning": "churning", "recirculation": "return path"}
_WITHOUT_NUT = ("seals", "preload", "return path", "churning")
_OPERATION = fields_of(OperatingState)
_BALL_FORCE = quantities_of(FrictionResult)["ball_to_ball_force"]
_PARTS = {**fields_of(Lubricant), **fields_of(BallScrew)}


def title(case: Case) -> str:
    """Load, speed, nut and model."""
    return f"{operating_point_and_nut(case)}, {model_text(case)}"


def operating_point_and_nut(case: Case) -> str:
    """Load, speed and nut."""
    return ", ".join([operating_point(case), *([] if case.nut is None else [nut_text(case.nut)])])


def operating_point(case: Case) -> str:
    """``4000 N, 600 rpm``."""
    return ", ".join(units.shown(getattr(case.operation, name), quantity) for name, quantity in _OPERATION.items())


def nut_text(nut: Nut) -> str:
    """``double nut, preload 5047 N``."""
    numbers = [
        f"{_words(name)} {units.shown(value, quantity)}"
        for name, quantity in fields_of(nut).items()
        if (value := getattr(nut, name)) is not None and (name == "preload" or value)
    ]
    others = [*["set at rest"] * nut.set_at_rest, *["spacer balls"] * nut.spacer_balls]
    return ", ".join([f"{kind_of(nut)} nut", *numbers, *others])


def _words(name: str) -> str:
    return name.replace("_", " ")


def model_text(case: Case) -> str:
    """The model, and the laws and numbers that differ from its preset."""
    changes = ", ".join(_change(case, name) for name in case.model.changes)
    return f"model {case.model.name}" + (f", changed: {changes}" if changes else "")


def _change(case: Case, name: str) -> str:
    """A law with the coefficients that differ from the preset, or a number."""
    value, label = getattr(case.model, name), _words(name)
    if name not in LAWS:
        number = fields_of(case.model).get(name)
        return label if number is None or value is None else f"{label} {units.shown(value, number)}"
    law, preset = name_of_law(name, value), getattr(MODELS[case.model.name], name)
    usual: Any = preset if type(preset) is type(value) else type(value)
    numbers = [
        f"{_words(coefficient)} {units.shown(getattr(value, coefficient), quantity)}"
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


def assumed(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Assumptions, omissions and the origin of a fit, one text each."""
    omissions = left_out(case)
    beside = [*([omissions] if omissions else []), *of_weight(case), *of_fit(case)]
    return [*assumptions(case, ball_to_ball_force), *beside]


def assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Inputs that are seldom given and on which the result depends."""
    common = common_assumptions(case, ball_to_ball_force)
    if case.nut is None:
        return [*common, *_without_preload(case)]
    notes = [note.text for note in case.origins.notes]
    return [*common, _bodies(case.nut), *_spacers(case), *_seals_of_row(case), *notes, *_against_vendors(case)]


def _bodies(nut: Nut) -> str:
    """The stiffness of the bodies of screw and nut."""
    if nut.bodies is None:
        return "screw and nut rigid between the balls"
    of_usual_size = all(getattr(nut.bodies, name) is None for name in fields_of(Bodies))
    return "screw and nut elastic" + ", of a usual size" * of_usual_size


def _seals_of_row(case: Case) -> list[str]:
    """The source of the torque of the seals, where it is not that of the row they stand in."""
    row = case.origins.row
    if row is None or not seal_torque_source(row, case.screw.nut):
        return []
    torque = units.shown(row.seal_torque, fields_of(Seals)["seal_torque"])
    return [f"seals {torque}: {row.seal_torque_source}; give the torque of your seals if you know it"]


def _spacers(case: Case) -> list[str]:
    screw = case.screw
    if not screw.nut.spacer_balls:
        return []
    carrying, balls = (f"{number:g}" for number in (screw.carrying_balls, screw.loaded_balls))
    return [f"every second ball is a spacer: {carrying} of {balls} carry; ratings as listed"]


def common_assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Oil, materials, roughness and the force between balls: that of a result, or else that of the model."""
    modulus = case.screw.equivalent_modulus(case.screw.screw_raceway)
    roughness = ", ".join(_part(case.screw, f"{part}_roughness") for part in ("ball", "screw", "nut"))
    sheet = case.lubricant.sheet
    grease = "grease: the film of its base oil, no thickener in it, no churning of a fresh filling"
    return [
        _oil(case),
        *([grease] if sheet is not None and sheet.is_grease else []),
        f"equivalent modulus {units.shown(modulus, quantities_of(RaceState)['equivalent_modulus'])}",
        f"roughness of balls, screw, nut {roughness}",
        f"force between balls {_between_balls(case, ball_to_ball_force)}",
    ]


def _part(part: Any, name: str) -> str:
    return units.shown(getattr(part, name), _PARTS[name])


def _oil(case: Case) -> str:
    """The viscosity of the oil, and what the oil was made from."""
    viscosity = f"viscosity {_part(case.lubricant, 'viscosity')}"
    coefficient = f"pressure–viscosity coefficient {_part(case.lubricant, 'pressure_viscosity_coefficient')}"
    if not case.origins.oil:
        return f"oil {viscosity}, {coefficient}"
    temperature = units.shown(case.origins.oil.get("temperature", _DEFAULT_TEMPERATURE), TEMPERATURE)
    return f"oil {described(case.origins.oil)} at {temperature}: {viscosity}, {coefficient}"


def _between_balls(case: Case, force: float | None) -> str:
    """The force between balls; without that of a result, balls may have loads of their own, and a share of each."""
    if case.screw.nut.spacer_balls:
        return "none: spacer balls part them"
    law: Any = case.model.ball_force
    if force is None and not traits_of(law).uses_imposed_force:
        share = getattr(law, "share_of_load", None)
        return f"by {name_of_law('ball_force', law)}" if share is None else f"{share:.4g} of the load of each"
    known = case.model.imposed_ball_force(case.screw) if force is None else force
    return units.shown(known, _BALL_FORCE)


def _without_preload(case: Case) -> list[str]:
    """The nut that is missing where the row of a preloaded nut is computed without one."""
    kind = "" if case.origins.row is None else case.origins.row.nut
    if case.nut is not None or kind in ("", "single"):
        return []
    return [f'without preload: the row is a {kind} nut, and none is given; add type = "{kind}" and a preload to [nut]']


def _against_vendors(case: Case) -> list[str]:
    """Results of ``ballscrew validate`` for nuts like this one, where the model is the one it was run with."""
    near = vendor_rows_like(case)
    if near is None:
        return []
    how = (
        "without calibration"
        if case.origins.calibration is None
        else f"which {case.origins.calibration.name} was fitted to"
    )
    ratio = (
        "drag torque without seals at 100 rpm, ISO VG 100 at 25 degC, model / vendor: "
        f"{near.mean:.2f} ± {near.scatter:.2f} for the {len(near.rows)} rows of {near.data} most like this nut, {how} "
        "(ballscrew validate)"
    )
    whose = whose_rows(case, near.data)
    return [f"{ratio}; {whose}" if whose else ratio]


def whose_rows(case: Case, data: str) -> str:
    """Whose rows a set of data has, beside a nut of another make, with what all makers' rules give for it.

    Empty for a nut of that maker.
    """
    make, of_rows = make_of(case), rule_of(data)
    if of_rows is None or rule_of(make) is of_rows:
        return ""
    nut = f"this nut is of {make}" if make else "the make of this nut is not known"
    rules = ", ".join(rule.text for rule in by_rules(case))
    drag = "its drag torque without seals is, by the rules of makers,"
    return f"these are rows of {of_rows.maker}, and {nut}: {drag} {rules}"


def left_out(case: Case) -> str:
    """Losses that are not in the torque; of a case without a fit also that it was not compared with measurements."""
    missing = _WITHOUT_NUT
    if case.nut is not None:
        missing = tuple(words for slot, words in _LOSSES.items() if slot not in case.nut.losses)
    losses = [f"left out: {', '.join(missing)}"] if missing else []
    comparison = [] if case.origins.fit.get("log") else ["not compared with measurements"]
    return "; ".join([*losses, *comparison])


def of_weight(case: Case) -> list[str]:
    """A load of the operating point that is far from the weight of an axis that is not level."""
    if case.axis is None or case.origins.travels or not case.axis.inclination:
        return []
    load, weight = abs(float(case.operation.axial_load)), abs(float(case.axis.gravity_force))
    if not weight or abs(load - weight) <= max(load, weight) / 2:
        return []
    given, own = (units.shown(force, _OPERATION["axial_load"]) for force in (load, weight))
    return [f"operation.axial_load {given}, where the weight of the axis is {own} along the screw"]


def of_fit(case: Case) -> list[str]:
    """The log of a fitted case."""
    return [f"calibrated to {case.origins.fit['log']}"] if case.origins.fit.get("log") else []


def inputs(case: Case) -> dict[str, Any]:
    """All inputs of a case in SI, by section: what ``--json`` prints."""
    model = case.model
    of_row = {} if case.origins.row is None else {"catalogue": case.origins.row.name, "source": case.origins.row.source}
    materials = {name: _numbers(getattr(case.screw, name)) for name in MATERIALS}
    return {
        "screw": {**of_row, **_numbers(case.screw), **case.origins.listed, **materials},
        "lubricant": {**case.origins.oil, **_numbers(case.lubricant)},
        **({} if case.origins.travels else {"operation": _numbers(case.operation)}),
        "model": {
            "name": model.name,
            **_numbers(model),
            **{slot: _law(slot, getattr(model, slot)) for slot in LAWS},
        }
        if case.efficiency is None
        else {"name": CONSTANT_EFFICIENCY, "efficiency": case.efficiency},
        **({} if case.nut is None else _inputs_of_nut(case, case.nut)),
        **({} if case.installation is None else {"installation": _mounting(case.installation)}),
        **({} if case.limits is USUAL_LIMITS else {"limits": _numbers(case.limits)}),
        **duty_tables.inputs(case.axis, case.motion, case.motor, case.surroundings),
        **support_tables.inputs(case.bearings, case.axis),
    }


def _inputs_of_nut(case: Case, nut: Nut) -> dict[str, Any]:
    bodies = None if nut.bodies is None else nut.bodies.sized(case.screw)
    scatter = nut.parts.get("deviations")
    own = {name: value for name, value in _numbers(nut).items() if value is not None}
    return {
        "nut": {
            "type": kind_of(nut),
            **own,
            **{name: True for name in ("spacer_balls", "set_at_rest") if getattr(nut, name)},
        },
        **(
            {}
            if bodies is None
            else {"bodies": {**_numbers(bodies), "same_side": bodies.same_side, "swelling": bodies.swelling}}
        ),
        **({} if scatter is None else {"deviations": _numbers(scatter)}),
        **({"losses": _losses(case, nut)} if nut.losses else {}),
    }


def _losses(case: Case, nut: Nut) -> dict[str, Any]:
    """The laws of the losses, of seals with the source of their torque where the row of the screw has one."""
    values = {slot: _law(slot, law) for slot, law in nut.losses.items()}
    seals, source = values.get("seals"), seal_torque_source(case.origins.row, nut)
    return {**values, "seals": {**seals, "source": source}} if source and isinstance(seals, dict) else values


def _mounting(mounted: Installation) -> dict[str, Any]:
    numbers = {name: value for name, value in _numbers(mounted).items() if value is not None}
    return {**numbers, "ends": next(name for name, known in ENDS.items() if known is mounted.ends)}


def _law(slot: str, law: Any) -> str | dict[str, Any]:
    """A law as a file names it: by name alone, or with its coefficients."""
    name = name_of_law(slot, law)
    if not dataclasses.is_dataclass(law):
        return name
    return {"law": name, **{field.name: getattr(law, field.name) for field in dataclasses.fields(law)}}


def _numbers(part: Any) -> dict[str, Any]:
    return {name: getattr(part, name) for name in fields_of(type(part))}


def of_case(case: Case) -> dict[str, Any]:
    """Version, model and sources of a case."""
    label = case.model.label if case.efficiency is None else CONSTANT_EFFICIENCY
    return {"version": __version__, "model": label, "references": references(case)}


def references(case: Case) -> list[str]:
    """Keys of the sources of the model, and of the oil where it was made from a grade."""
    made_by = Lubricant.from_grade if "grade" in case.origins.oil else Lubricant.from_data_sheet
    of_oil = keys_in(documentation(made_by)) if case.origins.oil else ()
    losses = {} if case.nut is None else case.nut.losses
    of_nut = [key for law in losses.values() for key in keys_in(documentation(type(law)))]
    of_model = citations_of(case.model) if case.efficiency is None else ()
    return list(dict.fromkeys([*of_model, *of_oil, *of_nut]))
