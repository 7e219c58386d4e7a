"""Operating point, nut, model, assumptions and omissions of a case as messages, which faces fill."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.basis.records import Message, Named, Value, listed
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.lubricants import described
from ballscrew.cases.case_files.makers_rules import by_rules, make_of
from ballscrew.cases.case_files.named_calibration import vendor_rows_like
from ballscrew.cases.case_files.nut_tables import seal_torque_source
from ballscrew.cases.schema.case_schema import LAWS, MODELS, name_of_law
from ballscrew.cases.screw_tables.catalogue import seal_source
from ballscrew.cases.screw_tables.nut_kinds import kind_of
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.components.materials import TEMPERATURE, Lubricant
from ballscrew.physics.components.nut import Bodies, Nut
from ballscrew.physics.components.nut_losses import Seals
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.components.traits import traits_of
from ballscrew.physics.friction.law_names import coefficients
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.sizing.rules import rule_of

#: Kinds of nuts by their names in files.
NUTS: Mapping[str, Message] = {
    "single": Message("single nut"),
    "double": Message("double nut"),
    "oversize-balls": Message("oversize-balls nut"),
    "offset-lead": Message("offset-lead nut"),
}
#: What is assumed of a grease.
_OF_GREASE = Message("grease: the film of its base oil, no thickener in it, no churning of a fresh filling")
#: Temperature of an oil of a grade where none is given, K.
_DEFAULT_TEMPERATURE = 313.15
#: Losses that are left out where the case has none of them, by their slot; without a nut, the preload as well.
_LOSSES = {"seals": Message("seals"), "churning": Message("churning"), "recirculation": Message("return path")}
_WITHOUT_NUT = [Message("seals"), Message("preload"), Message("return path"), Message("churning")]
_LEFT_OUT, _NOT_COMPARED = Message("left out: {losses}"), Message("not compared with measurements")
#: What ``ballscrew validate`` says of nuts like the one of a case.
_WITHOUT_CALIBRATION = Message(
    "drag torque without seals at 100 rpm, ISO VG 100 at 25 degC, model / vendor: {mean} ± {scatter} for the {rows} "
    "rows of {data} most like this nut, without calibration (ballscrew validate)"
)
_CALIBRATED = Message(
    "drag torque without seals at 100 rpm, ISO VG 100 at 25 degC, model / vendor: {mean} ± {scatter} for the {rows} "
    "rows of {data} most like this nut, which {calibration} was fitted to (ballscrew validate)"
)
#: Whose rows these are, beside a nut of another maker, or of none that is known.
_OF_ANOTHER_MAKE = Message(
    "these are rows of {maker}, and this nut is of {make}: its drag torque without seals is, by the rules of "
    "makers, {rules}"
)
_OF_NO_MAKE = Message(
    "these are rows of {maker}, and the make of this nut is not known: its drag torque without seals is, "
    "by the rules of makers, {rules}"
)
_OPERATION = fields_of(OperatingState)
_BALL_FORCE = quantities_of(FrictionResult)["ball_to_ball_force"]
_PARTS = {**fields_of(Lubricant), **fields_of(BallScrew)}


def title(case: Case) -> Message:
    """Load, speed, nut and model."""
    return listed([*_load_speed_and_nut(case), model(case)])


def operating_point_and_nut(case: Case) -> Message:
    """Load, speed and nut."""
    return listed(_load_speed_and_nut(case))


def _load_speed_and_nut(case: Case) -> list[Message]:
    return [operating_point(case), *([] if case.nut is None else [nut_with_preload(case.nut)])]


def operating_point(case: Case) -> Message:
    """``4000 N, 600 rpm``."""
    values = (units.shown(getattr(case.operation, name), quantity) for name, quantity in _OPERATION.items())
    return listed(Message("{value}", {"value": value}) for value in values)


def nut_with_preload(nut: Nut) -> Message:
    """``double nut, preload 5047 N``."""
    numbers = [
        _named(f"nut.{name}", units.shown(value, quantity))
        for name, quantity in fields_of(nut).items()
        if (value := getattr(nut, name)) is not None and (name == "preload" or value)
    ]
    at_rest = [Message("set at rest")] * nut.set_at_rest
    return listed([NUTS[kind_of(nut)], *numbers, *at_rest, *[Message("spacer balls")] * nut.spacer_balls])


def _named(path: str, value: Value) -> Message:
    return Message("{name} {value}", {"name": Named(path), "value": value})


def model(case: Case) -> Message:
    """The model, and the laws and numbers that differ from its preset."""
    name, changes = case.model.name, [_change(case, one) for one in case.model.changes]
    if not changes:
        return Message("model {model}", {"model": name})
    return Message("model {model}, changed: {changes}", {"model": name, "changes": changes})


def _change(case: Case, name: str) -> Message:
    """A law with the coefficients that differ from the preset, or a number."""
    value, label = getattr(case.model, name), Named(f"model.{name}")
    if name not in LAWS:
        number = fields_of(case.model).get(name)
        if number is None or value is None:
            return Message("{name}", {"name": label})
        return _named(label.path, units.shown(value, number))
    law, preset = name_of_law(name, value), getattr(MODELS[case.model.name], name)
    usual: Any = preset if type(preset) is type(value) else type(value)
    numbers = [
        _named(coefficient, units.shown(getattr(value, coefficient), quantity))
        for coefficient, quantity in coefficients(value).items()
        if getattr(value, coefficient) != getattr(usual, coefficient, None)
    ]
    if not numbers:
        return Message("{name} = {law}", {"name": label, "law": law})
    return Message("{name} = {law} ({numbers})", {"name": label, "law": law, "numbers": numbers})


# -- assumptions and omissions --------------------------------------------------------------------


def assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[Message]:
    """Inputs that are seldom given and on which the result depends."""
    common = common_assumptions(case, ball_to_ball_force)
    if case.nut is None:
        return [*common, *_without_preload(case)]
    notes = [note.message for note in case.notes]
    return [*common, _bodies(case.nut), *_spacers(case), *_seals_of_row(case), *notes, *_against_vendors(case)]


def _bodies(nut: Nut) -> Message:
    """The stiffness of the bodies of screw and nut."""
    if nut.bodies is None:
        return Message("screw and nut rigid between the balls")
    of_usual_size = all(getattr(nut.bodies, name) is None for name in fields_of(Bodies))
    return Message("screw and nut elastic, of a usual size") if of_usual_size else Message("screw and nut elastic")


def _seals_of_row(case: Case) -> list[Message]:
    """The source of the torque of the seals, where it is not that of the row they stand in."""
    row = case.row
    if row is None or not seal_torque_source(row, case.screw.nut):
        return []
    of_maker = seal_source(row.make)
    source = of_maker if units.filled(of_maker) == row.seal_torque_source else row.seal_torque_source
    torque = units.shown(row.seal_torque, fields_of(Seals)["seal_torque"])
    message = Message("seals {torque}: {source}; give the torque of your seals if you know it")
    return [message.of(torque=torque, source=source)]


def _spacers(case: Case) -> list[Message]:
    screw = case.screw
    if not screw.nut.spacer_balls:
        return []
    message = Message("every second ball is a spacer: {carrying} of {balls} carry; ratings as listed")
    balls = (f"{number:g}" for number in (screw.carrying_balls, screw.loaded_balls))
    return [message.of(**dict(zip(("carrying", "balls"), balls, strict=True)))]


def common_assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[Message]:
    """Oil, materials, roughness and the force between balls: that of a result, or else that of the model."""
    modulus = case.screw.equivalent_modulus(case.screw.screw_raceway)
    roughness = {part: _part(case.screw, f"{part}_roughness") for part in ("ball", "screw", "nut")}
    sheet = case.lubricant.sheet
    return [
        _oil(case),
        *([_OF_GREASE] if sheet is not None and sheet.is_grease else []),
        Message(
            "equivalent modulus {modulus}",
            {"modulus": units.shown(modulus, quantities_of(RaceState)["equivalent_modulus"])},
        ),
        Message("roughness of balls, screw, nut {ball}, {screw}, {nut}", roughness),
        _between_balls(case, ball_to_ball_force),
    ]


def _part(part: Any, name: str) -> str:
    return units.shown(getattr(part, name), _PARTS[name])


def _oil(case: Case) -> Message:
    """The viscosity of the oil, and what the oil was made from."""
    values = {
        "viscosity": _part(case.lubricant, "viscosity"),
        "coefficient": _part(case.lubricant, "pressure_viscosity_coefficient"),
    }
    if not case.oil:
        return Message("oil viscosity {viscosity}, pressure–viscosity coefficient {coefficient}", values)
    temperature = units.shown(case.oil.get("temperature", _DEFAULT_TEMPERATURE), TEMPERATURE)
    return Message(
        "oil {oil} at {temperature}: viscosity {viscosity}, pressure–viscosity coefficient {coefficient}",
        {**values, "oil": described(case.oil), "temperature": temperature},
    )


def _between_balls(case: Case, force: float | None) -> Message:
    """The force between balls; without that of a result, balls may have loads of their own, and a share of each."""
    if case.screw.nut.spacer_balls:
        return Message("force between balls none: spacer balls part them")
    law: Any = case.model.ball_force
    if force is None and not traits_of(law).uses_imposed_force:
        share = getattr(law, "share_of_load", None)
        if share is None:
            return Message("force between balls by {law}", {"law": name_of_law("ball_force", law)})
        return Message("force between balls {share} of the load of each", {"share": f"{share:.4g}"})
    known = case.model.imposed_ball_force(case.screw) if force is None else force
    return Message("force between balls {force}", {"force": units.shown(known, _BALL_FORCE)})


def _without_preload(case: Case) -> list[Message]:
    """The nut that is missing where the row of a preloaded nut is computed without one."""
    kind = "" if case.row is None else case.row.nut
    if case.nut is not None or kind in ("", "single"):
        return []
    message = Message(
        'without preload: the row is a {kind} nut, and none is given; add type = "{kind}" and a preload to [nut]'
    )
    return [message.of(kind=kind)]


def _against_vendors(case: Case) -> list[Message]:
    """What ``ballscrew validate`` says of nuts like this one, where the model is the one it was run with."""
    near = vendor_rows_like(case)
    if near is None:
        return []
    mean, scatter = (f"{number:.2f}" for number in (near.mean, near.scatter))
    values: dict[str, Value] = {"mean": mean, "scatter": scatter, "rows": str(len(near.rows)), "data": near.data}
    if case.calibration is None:
        found = _WITHOUT_CALIBRATION.of(**values)
    else:
        found = _CALIBRATED.of(**values, calibration=case.calibration.name)
    whose = whose_rows(case, near.data)
    return [found if whose is None else Message("{ratio}; {whose}", {"ratio": found, "whose": whose})]


def whose_rows(case: Case, data: str) -> Message | None:
    """Whose rows a set of data has, beside a nut of another make, with what all makers' rules give for it.

    None for a nut of that maker.
    """
    make, of_rows = make_of(case), rule_of(data)
    if of_rows is None or rule_of(make) is of_rows:
        return None
    values: dict[str, Value] = {"maker": of_rows.maker, "rules": [one.message for one in by_rules(case)]}
    return _OF_ANOTHER_MAKE.of(**values, make=make) if make else _OF_NO_MAKE.of(**values)


def left_out(case: Case) -> Message | None:
    """Losses that are not in the torque; of a case without a fit also that it was not compared with measurements."""
    missing = _WITHOUT_NUT
    if case.nut is not None:
        missing = [words for slot, words in _LOSSES.items() if slot not in case.nut.losses]
    losses = _LEFT_OUT.of(losses=missing) if missing else None
    if case.fit.get("log"):
        return losses
    if losses is None:
        return _NOT_COMPARED
    return Message("{losses}; {comparison}", {"losses": losses, "comparison": _NOT_COMPARED})


def of_fit(case: Case) -> list[Message]:
    """The log of a fitted case."""
    return [Message("calibrated to {log}", {"log": case.fit["log"]})] if case.fit.get("log") else []


def assumed(case: Case, ball_to_ball_force: float | None = None) -> list[Message]:
    """Assumptions, omissions and the origin of a fit, one message each."""
    omissions = left_out(case)
    return [*assumptions(case, ball_to_ball_force), *([] if omissions is None else [omissions]), *of_fit(case)]
