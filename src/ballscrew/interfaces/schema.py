"""The case file as pydantic models, made from the annotations of the parts.

One section is one model: a field for every quantity of the part, text with a unit in, SI out. The
JSON Schema of the whole (``ballscrew schema``) comes from the same models. The names of models and
laws stand here and nowhere else.
"""

from __future__ import annotations

import dataclasses
import functools
import re
import reprlib
from collections.abc import Iterable, Mapping
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, WithJsonSchema, create_model
from pydantic_core import PydanticCustomError

from ballscrew.components import frame, laws, lubrication, mixed_friction
from ballscrew.components.materials import TEMPERATURE, Lubricant, Material, grades
from ballscrew.components.screw import MATERIALS, BallScrew, Operation
from ballscrew.equations import film
from ballscrew.faults import Fault, fault_of, nearest
from ballscrew.interfaces import units
from ballscrew.model import FrictionModel, presets
from ballscrew.quantities import Quantity, fields_of
from ballscrew.solvers.ellipse_slip import ellipse_slip
from ballscrew.solvers.line_slip import line_slip
from ballscrew.solvers.pure_rolling import curvature_slip

MODELS = presets()
DEFAULT_MODEL = "reference"

#: The laws of each slot by name: functions, and classes where a law has coefficients.
LAWS: Mapping[str, Mapping[str, Any]] = {
    "frame": {"bearing": frame.bearing_frame, "helix": frame.helix_frame},
    "hertz": {"houpert": laws.houpert_hertz, "exact": laws.exact_hertz, "brewe-hamrock": laws.brewe_hamrock_hertz},
    "film": {
        "hamrock-dowson": lubrication.HamrockDowson,
        "hamrock-dowson-central": lubrication.hamrock_dowson_central,
    },
    "film_parameter": {"root-sum-square": film.film_parameter, "literal": film.literal_film_parameter},
    "inlet": {"ideal": lubrication.ideal_inlet, "heated": lubrication.Inlet},
    "friction": {
        "zhou-hoeprich": mixed_friction.ZhouHoeprich,
        "load-sharing": mixed_friction.LoadSharing,
        "balan": mixed_friction.BalanSharing,
        "greenwood-tripp": mixed_friction.GreenwoodTrippSharing,
    },
    "full_film": {
        "none": None,
        "eyring": mixed_friction.EyringTraction,
        "limiting-shear": mixed_friction.LimitingShearTraction,
    },
    "rolling": {
        "olaru": lubrication.olaru_rolling,
        "biboulet-houpert": lubrication.biboulet_houpert_rolling,
        "houpert": lubrication.houpert_rolling,
        "aihara": lubrication.aihara_rolling,
    },
    "elastic_resistance": {"snare": laws.snare_resistance, "hysteresis": laws.Hysteresis},
    "slip": {"curvature": curvature_slip, "line": line_slip, "ellipse": ellipse_slip},
    "ball_chain": {"one-neighbour": laws.one_neighbour, "two-neighbours": laws.two_neighbours},
    "ball_force": {"imposed": laws.imposed_ball_force, "proportional": laws.ProportionalBallForce},
    "race_torques": {"printed": laws.printed_race_torques, "balanced": laws.balanced_race_torques},
    "ideal_torque": {"printed": laws.printed_ideal_torque, "virtual-work": laws.virtual_work_torque},
}
#: Laws that only the paper as printed has: in another model they break a balance.
PRINTED_FORMS = frozenset({("film_parameter", "literal"), ("race_torques", "printed"), ("ideal_torque", "printed")})

#: What stands in the schema as an example: examples/feed_drive.toml, and what has no default.
EXAMPLES: Mapping[str, str | float] = {
    "pitch_circle_diameter": "41.4 mm",
    "lead": "10 mm",
    "ball_diameter": "6.35 mm",
    "loaded_balls": 75,
    "contact_angle": "45 deg",
    "screw_conformity": 0.54,
    "nut_conformity": 0.54,
    "temperature": "40 degC",
    "axial_load": "5 kN",
    "screw_speed": "600 rpm",
    "viscosity": "88 mPa s",
    "ball_to_ball_force": "0.0167 N",
    "pure_rolling_offset": 0.34,
}

_MEANT = re.compile(r'did you mean "(\w+)"')


def _si(raw: object, quantity: Quantity) -> float:
    """A raw value in SI and within its bounds, or the fault in it as pydantic wants to hear it."""
    value = units.parse("", raw, quantity)
    fault = value if isinstance(value, Fault) else fault_of("", quantity, value)
    if fault is not None:
        fault = units.in_people_units(fault, quantity, fault.given if fault is value else str(raw))
        words = {"problem": fault.problem, "given": fault.given, "remedy": fault.remedy}
        raise PydanticCustomError("fault", "{problem}", words)
    assert isinstance(value, float)
    return int(value) if quantity.info.whole else value


def _example(quantity: Quantity, default: Any) -> str | float:
    """What a field may hold: that of the feed drive in the examples, or else the default."""
    if quantity.name in EXAMPLES:
        return EXAMPLES[quantity.name]
    assert default is not None, quantity.name
    number = units.from_si(default, quantity)
    return default if quantity.unit == "1" else f"{number:.6g} {quantity.shown_in}"


def _json_schema(quantity: Quantity, default: Any) -> dict[str, Any]:
    """What a field looks like in the file: text with a unit, or a plain number within its bounds."""
    info = quantity.info
    examples = [_example(quantity, default)]
    description = {"description": info.meaning, "x-symbol": info.symbol}
    if quantity.unit != "1":
        return {**description, "type": "string", "examples": examples, "x-si-unit": quantity.unit}
    bounds = {
        "exclusiveMinimum": info.above,
        "minimum": info.at_least,
        "exclusiveMaximum": info.below,
        "maximum": info.at_most,
    }
    kind = "integer" if info.whole else "number"
    given = {name: bound for name, bound in bounds.items() if bound is not None}
    return {**description, "type": kind, "examples": examples, **given}


def _field(quantity: Quantity, default: Any, shown: Any) -> tuple[Any, Any]:
    read = BeforeValidator(functools.partial(_si, quantity=quantity))
    kind = int if quantity.info.whole else float
    return Annotated[kind, read, WithJsonSchema(_json_schema(quantity, shown))], Field(default=default)


def _section(
    title: str, quantities: Mapping[str, Quantity], cls: type, /, required: bool, **others: Any
) -> type[BaseModel]:
    """A model with a field for each quantity; unset fields keep the default of the part."""
    needed = {
        field.name
        for field in dataclasses.fields(cls)
        if field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    }
    own = _defaults(cls)
    fields = {n: _field(q, ... if required and n in needed else None, own.get(n)) for n, q in quantities.items()}
    return create_model(title, __config__=ConfigDict(extra="forbid"), **fields, **others)


def _defaults(cls: type) -> dict[str, Any]:
    """The defaults of a dataclass by field, where it has any."""
    fields = dataclasses.fields(cls)
    return {field.name: field.default for field in fields if field.default is not dataclasses.MISSING}


def coefficients_of(slot: str, name: str) -> Mapping[str, Quantity]:
    """The coefficients of a law by name; none for a law that is a function."""
    law = LAWS[slot][name]
    return fields_of(law) if isinstance(law, type) else {}


def name_of_law(slot: str, law: Any) -> str:
    """What a law is called in the case file."""
    return next(name for name, known in LAWS[slot].items() if known is law or known is type(law))


@functools.cache
def _coefficients(slot: str, name: str) -> type[BaseModel]:
    """The model of a table that sets coefficients of a law."""
    return _section(name, coefficients_of(slot, name), LAWS[slot][name], required=False)


def _slot(slot: str) -> tuple[Any, Any]:
    """The field of a slot: the name of a law, or a table with its coefficients; see :func:`law_of` for the check."""
    plain = [name for name in LAWS[slot] if not coefficients_of(slot, name)]
    tables = [{"law": {"enum": plain}}] if plain else []
    tables += [
        {
            "law": {"const": name},
            **{field: _json_schema(q, _defaults(LAWS[slot][name]).get(field)) for field, q in found.items()},
        }
        for name in LAWS[slot]
        if (found := coefficients_of(slot, name))
    ]
    schema = {
        "description": f"law of the slot {slot}: its name, or a table with coefficients",
        "anyOf": [
            {"type": "string", "enum": list(LAWS[slot])},
            *({"type": "object", "properties": table, "additionalProperties": False} for table in tables),
        ],
    }
    return Annotated[Any, WithJsonSchema(schema)], Field(default=None)


@functools.cache
def sections() -> Mapping[str, type[BaseModel]]:
    """The models of the sections of a case file."""
    material = _section("Material", fields_of(Material), Material, required=False)
    oil = {**fields_of(Lubricant), "temperature": TEMPERATURE}
    grade = Annotated[
        str, WithJsonSchema({"type": "string", "enum": grades(), "description": "instead of a viscosity"})
    ]
    model_name = Annotated[str, WithJsonSchema({"type": "string", "enum": list(MODELS)})]
    return {
        "screw": _section(
            "Screw", fields_of(BallScrew), BallScrew, required=True, **dict.fromkeys(MATERIALS, (material, None))
        ),
        "lubricant": _section("Lubricant", oil, Lubricant, required=False, grade=(grade, None)),
        "operation": _section("Operation", fields_of(Operation), Operation, required=True),
        "model": _section(
            "Model", fields_of(FrictionModel), FrictionModel, required=False,
            name=(model_name, Field(default=None, json_schema_extra={"default": DEFAULT_MODEL})),
            **{slot: _slot(slot) for slot in LAWS},
        ),
    }  # fmt: skip


@functools.cache
def case_file() -> type[BaseModel]:
    """The model of a whole case file."""
    parts = sections()
    needed: dict[str, Any] = {name: (parts[name], ...) for name in ("screw", "lubricant", "operation")}
    axes = Annotated[
        dict[str, str],
        Field(description='axes of a sweep by field, "100:4000:14 N" (start:stop:count) or "100, 200, 500 N"'),
    ]
    return create_model(
        "BallscrewCase",
        __config__=ConfigDict(extra="forbid", title="ballscrew case file"),
        **needed,
        model=(parts["model"], Field(default=None)),
        sweep=(axes, Field(default=None)),
    )


def json_schema() -> dict[str, Any]:
    """JSON Schema of a case file."""
    schema = _without_null(case_file().model_json_schema())
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def _without_null(schema: Any) -> Any:
    """A schema without defaults of null, which no case file can hold."""
    if isinstance(schema, dict):
        return {k: _without_null(v) for k, v in schema.items() if not (k == "default" and v is None)}
    return [_without_null(item) for item in schema] if isinstance(schema, list) else schema


def validated(section: str, table: Any, faults: list[Fault]) -> dict[str, Any]:
    """The values of a section that are set, in SI; what is wrong goes to the list of faults.

    Laws are left as they are written: what they may be depends on the model (:func:`law_of`).
    """
    return _validated(section, sections()[section], table, faults)


def law_of(slot: str, written: Any, present: Any, faults: list[Fault]) -> Any:
    """The law that is written for a slot; what is wrong with it goes to the list of faults.

    A name stands for the law with its own coefficients. A table sets coefficients: of the law that it
    names with ``law``, or else of the law at present in the slot.
    """
    where = f"model.{slot}"
    if not isinstance(written, str | dict):
        remedy = f"write {slot} = {_either(LAWS[slot])}"
        faults.append(Fault(where, "must be the name of a law, or a table", reprlib.repr(written), remedy))
        return present
    table = {"law": written} if isinstance(written, str) else dict(written)
    place = where if isinstance(written, str) else f"{where}.law"
    named = table.pop("law", None)
    name = name_of_law(slot, present) if named is None else named
    if not isinstance(name, str) or name not in LAWS[slot]:
        given = name if isinstance(name, str) else reprlib.repr(name)
        faults.append(Fault(place, "unknown law", given, nearest(given, LAWS[slot])))
        return present
    before = len(faults)
    faults += [_no_coefficient(slot, name, field) for field in table if field not in coefficients_of(slot, name)]
    if len(faults) > before or not coefficients_of(slot, name):
        return LAWS[slot][name]
    values = _validated(where, _coefficients(slot, name), table, faults)
    return dataclasses.replace(present, **values) if named is None else LAWS[slot][name](**values)


def _no_coefficient(slot: str, name: str, field: str) -> Fault:
    known = coefficients_of(slot, name)
    elsewhere = [other for other in LAWS[slot] if field in coefficients_of(slot, other)]
    guess = nearest(field, known) if known else ""
    if elsewhere:
        remedy = f"it belongs to {slot}.law = {_either(elsewhere)}; "
    else:
        remedy = f"{guess} " if guess.startswith("did") else ""
    has = ", ".join(known) or "no coefficients"
    return Fault(f"model.{slot}.{field}", f'no coefficient of the law "{name}"', "", f"{remedy}{name} has {has}")


def _either(names: Iterable[str]) -> str:
    return " or ".join(f'"{name}"' for name in names)


def _validated(where: str, model: type[BaseModel], table: Any, faults: list[Fault]) -> dict[str, Any]:
    try:
        return model.model_validate(table).model_dump(exclude_unset=True)
    except ValidationError as error:
        found = [_fault(where, model, dict(problem)) for problem in error.errors(include_url=False)]
    # a misspelt key is one fault, not also a missing one
    meant = {
        fault.where.rpartition(".")[0] + "." + match[1] for fault in found if (match := _MEANT.match(fault.remedy))
    }
    faults += [fault for fault in found if not (fault.problem == "missing" and fault.where in meant)]
    return {}


def _fault(section: str, model: type[BaseModel], problem: dict[str, Any]) -> Fault:
    """A fault in our words from an error in pydantic's."""
    path = [str(part) for part in problem["loc"]]
    where = ".".join([section, *path])
    given = problem["input"] if isinstance(problem["input"], str) else reprlib.repr(problem["input"])
    match problem["type"]:
        case "fault":
            return Fault(where, problem["ctx"]["problem"], problem["ctx"]["given"], problem["ctx"]["remedy"])
        case "missing":
            quantity = fields_of({"screw": BallScrew, "operation": Operation}[section])[path[-1]]
            sample = "a number" if quantity.unit == "1" else f'"… {quantity.shown_in}"'
            return Fault(where, "missing", "", f"add {path[-1]} = {sample}")
        case "extra_forbidden":
            # a coefficient of a law, written without the slot of its law
            slots = [slot for slot in LAWS if any(path[-1] in coefficients_of(slot, name) for name in LAWS[slot])]
            if where == f"model.{path[-1]}" and slots:
                return Fault(where, "unknown key", "", f'did you mean "{slots[0]}.{path[-1]}"?')
            return Fault(where, "unknown key", "", nearest(path[-1], _known(model, path[:-1])))
        case "model_type" | "dict_type" | "model_attributes_type":
            return Fault(where, "must be a table", given, f"write [{where}]")
        case "string_type":
            return Fault(where, "must be text", given, "put it in quotes")
        case _:
            return Fault(where, problem["msg"], given)


def _known(model: type[BaseModel], path: list[str]) -> list[str]:
    """Names of the keys at a place in the file."""
    for part in path:
        inner = model.model_fields[part].annotation
        assert isinstance(inner, type)
        model = inner
    return list(model.model_fields)
