"""The case file as pydantic models, made from the annotations of the parts.

One section is one model: a field for every quantity of the part, text with a unit in, SI out. The
JSON Schema of the whole (``ballscrew schema``) comes from the same models.
"""

from __future__ import annotations

import dataclasses
import functools
import re
import reprlib
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, WithJsonSchema, create_model
from pydantic_core import PydanticCustomError

from ballscrew.components import frame, laws
from ballscrew.components.materials import TEMPERATURE, Lubricant, Material, grades
from ballscrew.components.screw import MATERIALS, BallScrew, Operation
from ballscrew.equations import film
from ballscrew.faults import Fault, fault_of, nearest
from ballscrew.interfaces import units
from ballscrew.model import FrictionModel, presets
from ballscrew.quantities import Quantity, fields_of

MODELS = presets()
DEFAULT_MODEL = "corrected"

#: Laws without coefficients, by slot of the model and name.
LAWS: Mapping[str, Mapping[str, Any]] = {
    "frame": {"bearing": frame.bearing_frame, "helix": frame.helix_frame},
    "hertz": {"houpert": laws.houpert_hertz, "exact": laws.exact_hertz},
    "film_parameter": {"root-sum-square": film.film_parameter, "literal": film.literal_film_parameter},
    "ball_chain": {"one-neighbour": laws.one_neighbour, "two-neighbours": laws.two_neighbours},
    "race_torques": {"printed": laws.printed_race_torques, "balanced": laws.balanced_race_torques},
    "ideal_torque": {"printed": laws.printed_ideal_torque, "virtual-work": laws.virtual_work_torque},
}
#: Laws with coefficients, by slot.
COEFFICIENT_LAWS: Mapping[str, type] = {"film": laws.HamrockDowson, "friction": laws.ZhouHoeprich}


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


def _json_schema(quantity: Quantity) -> dict[str, Any]:
    """What a field looks like in the file: text with a unit, or a plain number within its bounds."""
    info = quantity.info
    description = {"description": info.meaning, "x-symbol": info.symbol}
    if quantity.unit != "1":
        return {**description, "type": "string", "examples": [f"1 {quantity.shown_in}"], "x-si-unit": quantity.unit}
    bounds = {
        "exclusiveMinimum": info.above,
        "minimum": info.at_least,
        "exclusiveMaximum": info.below,
        "maximum": info.at_most,
    }
    kind = "integer" if info.whole else "number"
    return {**description, "type": kind, **{name: bound for name, bound in bounds.items() if bound is not None}}


def _field(quantity: Quantity, default: Any) -> tuple[Any, Any]:
    read = BeforeValidator(functools.partial(_si, quantity=quantity))
    kind = int if quantity.info.whole else float
    return Annotated[kind, read, WithJsonSchema(_json_schema(quantity))], Field(default=default)


def _section(
    title: str, quantities: Mapping[str, Quantity], cls: type, /, required: bool, **others: Any
) -> type[BaseModel]:
    """A model with a field for each quantity; unset fields keep the default of the part."""
    needed = {
        field.name
        for field in dataclasses.fields(cls)
        if field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    }
    fields = {n: _field(q, ... if required and n in needed else None) for n, q in quantities.items()}
    return create_model(title, __config__=ConfigDict(extra="forbid"), **fields, **others)


@functools.cache
def sections() -> Mapping[str, type[BaseModel]]:
    """The models of the sections of a case file."""
    material = _section("Material", fields_of(Material), Material, required=False)
    oil = {**fields_of(Lubricant), "temperature": TEMPERATURE}
    grade = Annotated[
        str, WithJsonSchema({"type": "string", "enum": grades(), "description": "instead of a viscosity"})
    ]
    law_names = {
        slot: (Literal[tuple(known)], Field(default=None, description=f"law of the slot {slot}"))
        for slot, known in LAWS.items()
    }
    coefficients = {
        slot: (_section(cls.__name__, fields_of(cls), cls, required=False), Field(default=None))
        for slot, cls in COEFFICIENT_LAWS.items()
    }
    model_name = Annotated[str, WithJsonSchema({"type": "string", "enum": list(MODELS), "default": DEFAULT_MODEL})]
    return {
        "screw": _section(
            "Screw", fields_of(BallScrew), BallScrew, required=True, **dict.fromkeys(MATERIALS, (material, None))
        ),
        "lubricant": _section("Lubricant", oil, Lubricant, required=False, grade=(grade, None)),
        "operation": _section("Operation", fields_of(Operation), Operation, required=True),
        "model": _section(
            "Model", fields_of(FrictionModel), FrictionModel, required=False,
            name=(model_name, None), **law_names, **coefficients,
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
    schema = case_file().model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def validated(section: str, table: Any, faults: list[Fault]) -> dict[str, Any]:
    """The values of a section that are set, in SI; what is wrong goes to the list of faults."""
    model = sections()[section]
    try:
        return model.model_validate(table).model_dump(exclude_unset=True)
    except ValidationError as error:
        found = [_fault(section, model, dict(problem)) for problem in error.errors(include_url=False)]
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
            return Fault(where, "unknown key", "", nearest(path[-1], _known(model, path[:-1])))
        case "literal_error":
            return Fault(where, "unknown law", given, nearest(given, LAWS[path[-1]]))
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
