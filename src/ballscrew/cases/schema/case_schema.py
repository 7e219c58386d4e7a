"""The case file as pydantic models, made from the annotations of the parts.

One section is one model: a field for every quantity of the part, text with a unit in, SI out. The
JSON Schema of the whole (``ballscrew schema``) comes from the same models.

Laws from outside in a case: ``module:name``, imported from beside the case or from the current folder.

Importing a module runs its code. So it happens only where the person at the command line allows it, and never on a
server.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import importlib
import re
import reprlib
import sys
from collections.abc import Generator, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, WithJsonSchema, create_model

from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.basis.errors import MISSING, UNKNOWN, Fault, InputError, closest, nearest, to_set
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.schema.duty_schema import (
    CONSTANT_EFFICIENCY,
    DUTY_TABLES,
    SUPPORT_TABLES,
    duty_sections,
    efficiency_field,
    one_of,
    support_sections,
)
from ballscrew.cases.schema.fields import (
    NUT_SPEED,
    defaults_of,
    json_of,
    read_preload,
    read_speed,
    section_of,
)
from ballscrew.cases.screw_tables.nut_kinds import ENDS, LISTED, LOSSES, NUT_FIELDS
from ballscrew.physics.components.materials import INPUTS_OF_SHEET, Lubricant, Material
from ballscrew.physics.components.nut import NUTS, Bodies, DoubleNut, Scatter
from ballscrew.physics.components.oil_grades import SHEET_TEMPERATURE, DataSheet, grades
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import MATERIALS, BallScrew
from ballscrew.physics.friction.calibrations import BY_MAKE, calibrations
from ballscrew.physics.friction.model import LAWS, FrictionModel, coefficients, presets
from ballscrew.physics.laws.protocols import name_of
from ballscrew.physics.sizing.installation import Installation, Limits

#: A law of a module, as it is written.
OUTSIDE = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_][\w.]*")
NOT_ALLOWED = "add --allow-code on the command line, if you trust it; a server never runs code"

#: Modules with laws that this process has imported.
_imported: set[str] = set()


def law_from_outside(where: str, written: str, folder: Path | None) -> Any:
    """The function or the class that is written as ``module:name``; None for the folder forbids it.

    Raises :class:`~ballscrew.basis.errors.InputError` in one line.
    """
    if not OUTSIDE.fullmatch(written):
        raise InputError(Fault(where, "is no law of a module", written, 'write "module:name", as in "mine:my_law"'))
    if folder is None:
        raise InputError(Fault(where, "is code from outside, which is not allowed", written, NOT_ALLOWED))
    module_name, _, name = written.partition(":")
    result: Any = _module(where, written, module_name, folder)
    for part in name.split("."):
        if not hasattr(result, part):
            laws = [n for n, law in vars(result).items() if callable(law) and law.__module__ == module_name]
            raise InputError(Fault(where, f"{module_name} has no {name}", written, nearest(name, laws)))
        result = getattr(result, part)
    if isinstance(result, type):
        if not dataclasses.is_dataclass(result) or not callable(getattr(result, "__call__", None)):  # noqa: B004  (the class, not the instance)
            problem, remedy = "is a class, but no law", "make it a frozen dataclass with __call__, or name a function"
            raise InputError(Fault(where, problem, written, remedy))
    elif not callable(result):
        remedy = "name a function, or a frozen dataclass with __call__"
        raise InputError(Fault(where, "is no law: it cannot be called", written, remedy))
    return result


def with_plain_numbers(where: str, kind: Any, table: Mapping[str, Any], faults: list[Fault]) -> dict[str, Any]:
    """The coefficients in a table that have no unit declared, as they are; what is wrong goes to the list of faults."""
    if not isinstance(kind, type) or not dataclasses.is_dataclass(kind):
        faults += [
            Fault(f"{where}.{name}", "no coefficient of the law", "", "a function has none: make it a frozen dataclass")
            for name in table
        ]
        return {}
    fields = {field.name: field for field in dataclasses.fields(kind) if field.init}
    plain = {name: value for name, value in table.items() if name not in coefficients(kind)}
    for name, value in plain.items():
        if name not in fields:
            faults.append(Fault(f"{where}.{name}", "no coefficient of the law", "", nearest(name, fields)))
        elif not isinstance(value, int | float) or isinstance(value, bool):
            faults.append(Fault(f"{where}.{name}", "must be a number", reprlib.repr(value), "give it without quotes"))
    missing = [
        name
        for name, field in fields.items()
        if name not in table and field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    ]
    faults += [Fault(f"{where}.{name}", MISSING, "", f"add {name} = a number") for name in missing]
    return plain


def _module(where: str, written: str, name: str, folder: Path) -> Any:
    try:
        beside = folder.joinpath(*name.split(".")).with_suffix(".py").resolve()
        with _importable(folder):
            module = importlib.import_module(name)
            if name in _imported and beside.is_file() and _file_of(module) != beside:
                # another case had a module of this name in a folder of its own
                del sys.modules[name]
                module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is not None and (name == error.name or name.startswith(f"{error.name}.")):
            remedy = f"put {name.partition('.')[0]}.py beside the case or into the current folder"
            raise InputError(Fault(where, f"there is no module {error.name}", written, remedy)) from None
        remedy = "install it, or change the module"
        raise InputError(Fault(where, f"its module needs {error.name}, which is not there", written, remedy)) from None
    except Exception as error:  # the code of a user may raise anything
        problem = f"its module cannot be imported: {type(error).__name__}: {error}"
        raise InputError(Fault(where, problem, written, f"try: python -c 'import {name}'")) from error
    if beside.is_file() and _file_of(module) != beside:
        value = module.__file__ or "a built-in one"
        problem = f"another module {name} is loaded already: {value}"
        raise InputError(Fault(where, problem, written, f"rename {beside.name}"))
    _imported.add(name)
    return module


def _file_of(module: Any) -> Path:
    return Path(module.__file__ or "").resolve()


@contextlib.contextmanager
def _importable(folder: Path) -> Generator[None]:
    """Look into the folder of the case and into the current one first, as ``python -m`` looks into the latter."""
    places = list(dict.fromkeys([str(folder.resolve()), str(Path.cwd())]))
    sys.path[:0] = places
    importlib.invalidate_caches()
    try:
        yield
    finally:
        for place in places:
            sys.path.remove(place)


MODELS = presets()
DEFAULT_MODEL = "reference"

_SLOTS = {**LAWS, **LOSSES}

#: The tables on the nut and on how the screw is mounted; all may be left out.
NUT_TABLES = ("nut", "bodies", "deviations", "losses", "installation", "limits")


#: A law from outside in the JSON Schema.
_OUTSIDE = {
    "type": "string",
    "pattern": f"^{OUTSIDE.pattern}$",
    "description": "a law of your own, module:name; only with --allow-code",
}


def coefficients_of(slot: str, name: str) -> Mapping[str, Quantity]:
    """The coefficients of a law by name; none for a law that is a function."""
    law = _SLOTS[slot][name]
    return fields_of(law) if isinstance(law, type) else {}


def places_of(field: str) -> list[str]:
    """The places of a case file in which a field may stand: ``model.inlet.inlet_film_ratio``."""
    of_sections = [f"{name}.{field}" for name, model in sections().items() if field in model.model_fields]
    of_laws = [f"{_place(s)}.{field}" for s in _SLOTS if any(field in coefficients_of(s, name) for name in _SLOTS[s])]
    return [place for place in [*of_sections, *of_laws] if not place.startswith("screw_of_row")]


def name_of_law(slot: str, law: Any) -> str:
    """Name of a law in the case file: one from outside ``module:name``."""
    named = (name for name, known in _SLOTS[slot].items() if known is law or known is type(law))
    return next(named, None) or name_of(law)


@functools.cache
def _coefficients(slot: str, name: str) -> type[BaseModel]:
    """The model of a table that sets coefficients of a law."""
    known = coefficients_of(slot, name)
    return section_of(name, known, _SLOTS[slot][name], required=False, uncertain=known)


def _slot(slot: str) -> tuple[Any, Any]:
    """The field of a slot: the name of a law, or a table with its coefficients; see :func:`law_of` for the check."""
    plain = [name for name in _SLOTS[slot] if not coefficients_of(slot, name)]
    tables = [{"law": {"enum": plain}}] if plain else []
    tables += [
        {
            "law": {"const": name},
            **{
                field: json_of(q, defaults_of(_SLOTS[slot][name]).get(field), slot in LAWS) for field, q in each.items()
            },
        }
        for name in _SLOTS[slot]
        if (each := coefficients_of(slot, name))
    ]
    schema = {
        "description": f"law of {_place(slot)}: its name, or a table with coefficients",
        "anyOf": [
            {"type": "string", "enum": list(_SLOTS[slot])},
            *([_OUTSIDE] if slot in LAWS else []),
            *({"type": "object", "properties": table, "additionalProperties": False} for table in tables),
        ],
    }
    return Annotated[Any, WithJsonSchema(schema)], Field(default=None)


@functools.cache
def sections() -> Mapping[str, type[BaseModel]]:
    """The models of the sections of a case file."""
    material = section_of("Material", fields_of(Material), Material, required=False)
    oil = {**fields_of(Lubricant), **fields_of(DataSheet), "temperature": SHEET_TEMPERATURE}
    stated = Annotated[str, Field(description="name of an oil or a grease of the library; other fields override it")]
    oil_file = Annotated[str, Field(description="table with the oil, beside the case file, in place of the library")]
    grade = Annotated[
        str, WithJsonSchema({"type": "string", "enum": grades(), "description": "instead of a viscosity"})
    ]
    model_name = Annotated[str, WithJsonSchema({"type": "string", "enum": [*MODELS, CONSTANT_EFFICIENCY]})]
    screw = {**fields_of(BallScrew), **LISTED}
    materials = dict.fromkeys(MATERIALS, (material, None))
    row = Annotated[str, Field(description="name of a catalogue row; the other fields then override it")]
    file = Annotated[str, Field(description="table with the row, beside the case file, in place of the rows shipped")]
    preload = json_of(NUT_FIELDS["preload"], None) | {"examples": ["3 kN", "7 %"]}
    turning = fields_of(OperatingState)["screw_speed"]
    speed = json_of(turning, None) | {"examples": ["600 rpm", "6 m/min"], "x-through-lead": NUT_SPEED.unit}
    same_side = Annotated[bool, Field(strict=True, description="whether screw and nut are held on the same side")]
    swelling = Annotated[bool, Field(strict=True, description="whether the balls widen the nut and shrink the screw")]
    spacers = Annotated[
        bool, Field(strict=True, description="whether every second ball is a spacer, smaller and without load")
    ]
    at_rest = Annotated[
        bool, Field(strict=True, description="whether the preload is that at rest; in motion the balls press harder")
    ]
    return {
        "screw": section_of(
            "Screw",
            screw,
            BallScrew,
            required=True,
            uncertain=fields_of(BallScrew),
            catalogue=(row, None),
            catalogue_file=(file, None),
            **materials,
        ),
        "screw_of_row": section_of(
            "ScrewOfRow",
            screw,
            BallScrew,
            required=False,
            uncertain=fields_of(BallScrew),
            catalogue=(row, ...),
            catalogue_file=(file, None),
            **materials,
        ),
        "lubricant": section_of(
            "Lubricant",
            oil,
            Lubricant,
            required=False,
            uncertain={*fields_of(Lubricant), *INPUTS_OF_SHEET, "temperature"},
            grade=(grade, None),
            oil=(stated, None),
            oil_file=(oil_file, None),
        ),
        "operation": section_of(
            "Operation",
            {name: q for name, q in fields_of(OperatingState).items() if q is not turning},
            OperatingState,
            required=True,
            uncertain=fields_of(OperatingState),
            screw_speed=(Annotated[Any, BeforeValidator(read_speed), WithJsonSchema(speed), turning], ...),
        ),
        "model": section_of(
            "Model",
            fields_of(FrictionModel),
            FrictionModel,
            required=False,
            uncertain=fields_of(FrictionModel),
            name=(model_name, Field(default=None, json_schema_extra={"default": DEFAULT_MODEL})),
            calibration=(one_of((*calibrations(), BY_MAKE), "named calibration, or that of the row's make"), None),
            efficiency=efficiency_field(),
            **{slot: _slot(slot) for slot in LAWS},
        ),
        "nut": section_of(
            "Nut",
            {name: q for name, q in NUT_FIELDS.items() if name != "preload"},
            DoubleNut,
            required=False,
            uncertain=NUT_FIELDS,
            type=(one_of(NUTS, "kind of nut"), None),
            spacer_balls=(spacers, None),
            set_at_rest=(at_rest, None),
            preload=(
                Annotated[Any, BeforeValidator(read_preload), WithJsonSchema(preload), NUT_FIELDS["preload"]],
                None,
            ),
        ),
        "bodies": section_of(
            "Bodies",
            fields_of(Bodies),
            Bodies,
            required=False,
            same_side=(same_side, None),
            swelling=(swelling, None),
        ),
        "deviations": section_of("Deviations", fields_of(Scatter), Scatter, required=False),
        "losses": section_of("Losses", {}, Scatter, required=False, **{slot: _slot(slot) for slot in LOSSES}),
        "installation": section_of(
            "Installation",
            fields_of(Installation),
            Installation,
            required=False,
            ends=(one_of(ENDS, "how the ends of the shaft are held"), None),
        ),
        "limits": section_of("Limits", fields_of(Limits), Limits, required=False),
        **duty_sections(),
        **support_sections(),
    }


#: A motion stands in for an operating point, and the rule of one efficiency knows no oil.
_ALTERNATIVES: dict[str, Any] = {
    "allOf": [
        {"anyOf": [{"required": ["operation"]}, {"required": ["axis", "motion"]}]},
        {
            "anyOf": [
                {"required": ["lubricant"]},
                {
                    "properties": {"model": {"properties": {"name": {"const": CONSTANT_EFFICIENCY}}}},
                    "required": ["model"],
                },
            ]
        },
    ]
}


@functools.cache
def case_file() -> type[BaseModel]:
    """The model of a whole case file."""
    parts = sections()
    screw: Any = parts["screw"] | parts["screw_of_row"]
    others: dict[str, Any] = {
        name: (parts[name], Field(default=None))
        for name in ("lubricant", "operation", *NUT_TABLES, *DUTY_TABLES, *SUPPORT_TABLES)
    }
    axes = Annotated[
        dict[str, str],
        Field(description='axes of a sweep by field, "100:4000:14 N" (start:stop:count) or "100, 200, 500 N"'),
    ]
    fit = Annotated[dict[str, Any], Field(description="what ballscrew fit left beside the numbers that it found")]
    estimates = Annotated[
        dict[str, dict[str, Any]],
        Field(description="values that ballscrew select estimated, by section: estimates as long as the case has them"),
    ]
    aside = Annotated[dict[str, Any], Field(description="what somebody keeps with a case; no command reads it")]
    return create_model(
        "BallscrewCase",
        __config__=ConfigDict(extra="forbid", title="ballscrew case file", json_schema_extra=_ALTERNATIVES),
        screw=(screw, ...),
        **others,
        model=(parts["model"], Field(default=None)),
        sweep=(axes, Field(default=None)),
        calibration=(fit, Field(default=None)),
        estimates=(estimates, Field(default=None)),
        aside=(aside, Field(default=None)),
    )


def json_schema() -> dict[str, Any]:
    """JSON Schema of a case file."""
    schema = without_null(case_file().model_json_schema())
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def without_null(schema: Any) -> Any:
    """A schema without defaults of null, which no case file can hold."""
    if isinstance(schema, dict):
        return {k: without_null(v) for k, v in schema.items() if not (k == "default" and v is None)}
    return [without_null(item) for item in schema] if isinstance(schema, list) else schema


def validated(section: str, table: Any, faults: list[Fault]) -> dict[str, Any]:
    """The values of a section that are set, in SI; what is wrong goes to the list of faults.

    Laws are left as they are written: what they may be depends on the model (:func:`law_of`).
    """
    of_row = section == "screw" and isinstance(table, dict) and ("catalogue" in table or "catalogue_file" in table)
    return read_table(section, sections()["screw_of_row" if of_row else section], table, faults)


def law_of(slot: str, written: Any, present: Any, faults: list[Fault], folder: Path | None = None) -> Any:
    """The law that is written for a slot; what is wrong with it goes to the list of faults.

    A name stands for the law with its own coefficients. A table sets coefficients: of the law that it
    names with ``law``, or else of the law at present in the slot. ``module:name`` is a law from outside, which may be
    imported from a ``folder``, or not at all where there is none.
    """
    where = _place(slot)
    if not isinstance(written, str | dict):
        remedy = f"write {slot} = {_either(_SLOTS[slot])}"
        faults.append(Fault(where, "must be the name of a law, or a table", reprlib.repr(written), remedy))
        return present
    table = {"law": written} if isinstance(written, str) else dict(written)
    place = where if isinstance(written, str) else f"{where}.law"
    named = table.pop("law", None)
    name = name_of_law(slot, present) if named is None else named
    if isinstance(name, str) and ":" in name and slot in LAWS:  # losses take no law from outside
        return _from_outside(where, place, name, table, folder, faults)
    if not isinstance(name, str) or name not in _SLOTS[slot]:
        given = name if isinstance(name, str) else reprlib.repr(name)
        faults.append(Fault(place, "unknown law", given, nearest(given, _SLOTS[slot])))
        return present
    before = len(faults)
    faults += [_no_coefficient(slot, name, field) for field in table if field not in coefficients_of(slot, name)]
    if len(faults) > before or not coefficients_of(slot, name):
        return _SLOTS[slot][name]
    values = read_table(where, _coefficients(slot, name), table, faults)
    return dataclasses.replace(present, **values) if named is None else _SLOTS[slot][name](**values)


def _from_outside(
    where: str, place: str, written: str, table: Mapping[str, Any], folder: Path | None, faults: list[Fault]
) -> Any:
    """A law from outside, with the coefficients of a table where it is a dataclass."""
    before = len(faults)
    try:
        law = law_from_outside(place, written, folder)
        plain = with_plain_numbers(where, law, table, faults)
        if len(faults) > before or not isinstance(law, type):
            return law
        known = coefficients(law)
        section = section_of(law.__name__, known, law, required=False, uncertain=known)
        values = read_table(where, section, {n: v for n, v in table.items() if n in known}, faults)
        return law if len(faults) > before else law(**values, **plain)
    except InputError as error:
        faults += error.faults
        return None


def _no_coefficient(slot: str, name: str, field: str) -> Fault:
    known = coefficients_of(slot, name)
    elsewhere = [other for other in _SLOTS[slot] if field in coefficients_of(slot, other)]
    remedy = f"{name} has {', '.join(known) or 'no coefficients'}"
    if elsewhere:
        remedy = f"it belongs to {slot}.law = {_either(elsewhere)}; {remedy}"
    elif meant := closest(field, known):
        remedy = f'did you mean "{meant}"? {remedy}'
    problem = f'no coefficient of the law "{name}"'
    return Fault(f"{_place(slot)}.{field}", problem, "", remedy)


def _place(slot: str) -> str:
    """Key of a slot in the file."""
    return f"{'losses' if slot in LOSSES else 'model'}.{slot}"


def _either(names: Iterable[str]) -> str:
    return " or ".join(f'"{name}"' for name in names)


def read_table(where: str, model: type[BaseModel], table: Any, faults: list[Fault]) -> dict[str, Any]:
    """The values of a table that are set; what is wrong goes to the list of faults, in our words."""
    try:
        return model.model_validate(table).model_dump(exclude_unset=True)
    except ValidationError as error:
        values = [_fault(where, model, dict(problem)) for problem in error.errors(include_url=False)]
    # a misspelt key is one fault, not also a missing one
    meant = {f"{fault.where.rpartition('.')[0]}.{fault.meant}" for fault in values if fault.meant}
    if "screw.catalogue" in meant:
        meant |= {f"screw.{name}" for name in fields_of(BallScrew)}
    faults += [fault for fault in values if not (fault.problem == MISSING and fault.where in meant)]
    return {}


def _fault(section: str, model: type[BaseModel], problem: dict[str, Any]) -> Fault:
    """A fault in our words from an error in pydantic's."""
    path = [str(part) for part in problem["loc"]]
    where = ".".join([section, *path])
    given = problem["input"] if isinstance(problem["input"], str) else reprlib.repr(problem["input"])
    match problem["type"]:
        case "fault":
            return dataclasses.replace(problem["ctx"]["fault"], where=where)
        case "missing":
            return _missing_key(where, path[-1])
        case "extra_forbidden":
            return _unknown_key(where, path[-1], _known(model, path[:-1]))
        case "model_type" | "dict_type" | "model_attributes_type":
            return Fault(where, "must be a table", given, f"write [{where}]")
        case "list_type":
            sample = f"[[{where}]]" if path[-1] == "segment" else f'{path[-1]} = [["0 rpm", "7 N m"]]'
            return Fault(where, "must be a list", given, f"write {sample}")
        case "bool_type":
            return Fault(where, "must be true or false", given, "without quotes")
        case "string_type":
            return Fault(where, "must be text", given, "put it in quotes")
        case _:
            return Fault(where, problem["msg"], given)


def _missing_key(where: str, key: str) -> Fault:
    """The fault of a key that is not there, with a sample of its unit."""
    parts = (BallScrew, OperatingState, DataSheet, Axis, Motor)
    quantity = {n: q for part in parts for n, q in fields_of(part).items()}.get(key)
    unit = "" if quantity is None else f" {quantity.shown_in}"
    sample = "a number" if quantity is not None and quantity.unit == "1" else f'"…{unit}"'
    return Fault(where, MISSING, "", f"add {to_set(where)}{sample}")


def _unknown_key(where: str, key: str, known: Sequence[str]) -> Fault:
    """The fault of a key that is not known; a coefficient may be written without the slot of its law."""
    slots = [slot for slot in LAWS if any(key in coefficients_of(slot, name) for name in LAWS[slot])]
    if where == f"model.{key}" and slots:
        remedy = f'did you mean "{slots[0]}.{key}"?'
        return Fault(where, "unknown key", "", remedy, id=UNKNOWN)
    return Fault(where, "unknown key", "", nearest(key, known), meant=closest(key, known), id=UNKNOWN)


def _known(model: type[BaseModel], path: list[str]) -> list[str]:
    """Names of the keys at a place in the file."""
    for part in path:
        inner = model.model_fields[part].annotation
        assert isinstance(inner, type)
        model = inner
    return list(model.model_fields)
