"""What the API says of itself: bodies and answers in JSON Schema, made from what the program is made of."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from fastapi import Path
from pydantic import BaseModel

from ballscrew.analyses.band_work import BANDED
from ballscrew.analyses.uncertainty import Interval, OutputBand
from ballscrew.assembly import NutFriction
from ballscrew.components.catalogue import CatalogueRow, catalogue
from ballscrew.components.contact import RaceState
from ballscrew.interfaces.report import SHOWN
from ballscrew.interfaces.schema import LAWS, json_schema
from ballscrew.interfaces.web import problems
from ballscrew.interfaces.web.bodies import BandBody, SweepBody
from ballscrew.interfaces.web.vocabulary import vocabulary
from ballscrew.quantities import Quantity, fields_of, quantities_of
from ballscrew.result import FrictionResult

_CASE = "Case"
_HERE, _THERE = "#/$defs/", "#/components/schemas/"
#: What a request may be told besides its answer: of any address, of those with a body, of those that take their time.
_ANY, _POST, _HEAVY = (421, 422), (400, 408, 413, 415), (408, 429)
_TEXT = {"type": "string"}
_NUMBER = {"type": ["number", "null"]}
_NUMBERS = {"anyOf": [_NUMBER, {"type": ["array", "boolean"]}]}
_TRUTH = {"type": "boolean"}
_OBJECT = {"type": "object"}
#: A row of the catalogue by its name, with one to try.
RowName = Annotated[str, Path(description="whatever its capitals", examples=[next(iter(catalogue()))])]

Schema = dict[str, Any]


def body(kind: type[BaseModel]) -> dict[str, Any]:
    """The body of a request; its case is a case file."""
    schema = kind.model_json_schema()
    schema["properties"]["case"] = {"$ref": f"{_THERE}{_CASE}"}
    content = {"schema": schema, "examples": {name: {"value": value} for name, value in _bodies(kind).items()}}
    return {"requestBody": {"required": True, "content": {"application/json": content}}}


def _bodies(kind: type[BaseModel]) -> dict[str, Any]:
    """Bodies to try: the paper's screw, and one with an elastic nut."""
    paper = vocabulary()["starts"]["paper"]["case"]
    nut = {
        "screw": {"catalogue": next(name for name, row in catalogue().items() if row.nut == "double")},
        "nut": {"preload": "7 %"},
        "bodies": {},
        "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"},
        "operation": {"axial_load": "2 kN", "screw_speed": "300 rpm"},
    }
    more: dict[str, Any] = {}
    if kind is SweepBody:
        more = {"vary": {"axial_load": "100:4000:5 N", "screw_speed": "10, 100 rpm"}, "outputs": ["efficiency"]}
    if kind is BandBody:
        more = {"samples": 64, "level": 0.9}
    return {"paper": {"case": paper, **more}, "nut": {"case": nut, **more}}


def answers(name: str, *others: int) -> dict[int | str, dict[str, Any]]:
    """The answers of an address: JSON of that schema, and the problems."""
    found = {"description": "the answer", "content": {"application/json": {"schema": {"$ref": f"{_THERE}{name}"}}}}
    return {200: found, **_problems(*others)}


def text(*media: str) -> dict[int | str, dict[str, Any]]:
    """The answers of an address that sends a file."""
    content = {kind.partition(";")[0]: {"schema": _TEXT} for kind in media}
    return {200: {"description": "the file", "content": content}, **_problems()}


def _problems(*others: int) -> dict[int | str, dict[str, Any]]:
    content = {problems.MEDIA_TYPE: {"schema": {"$ref": f"{_THERE}Problem"}}}
    return {
        status: {"description": problems.TITLES[status], "content": content}
        for status in sorted({*_ANY, *_POST, *_HEAVY, *others})
    }


@functools.cache
def components() -> Mapping[str, Any]:
    """The schemas that the addresses refer to."""
    case = _moved(json_schema())
    parts = case.pop("$defs")
    case.pop("$schema")
    run = _run()
    return {
        **parts,
        _CASE: case,
        "Problem": dict(problems.SCHEMA),
        "Run": run,
        "Sweep": _sweep(),
        "Compare": _compare(),
        "Band": _band(run),
        "Catalogue": _object({"rows": {"type": "array", "items": _entry()}, **_of_entries()}),
        "Row": _row(),
        "Validation": _validation(),
        "Schema": _object({"$schema": _TEXT, "properties": _OBJECT}, closed=False),
        "Vocabulary": shape(vocabulary()),
    }


def _moved(schema: Any) -> Any:
    """A schema whose references lead to where its parts are in an OpenAPI document."""
    if isinstance(schema, dict):
        return {name: _moved(value) for name, value in schema.items()}
    if isinstance(schema, list):
        return [_moved(item) for item in schema]
    return schema.replace(_HERE, _THERE) if isinstance(schema, str) else schema


def _object(properties: Mapping[str, Any], *, optional: Sequence[str] = (), closed: bool = True) -> Schema:
    """An object with these names, and no others."""
    required = [name for name in properties if name not in optional]
    found = {"type": "object", "required": required, "properties": dict(properties)}
    return {**found, "additionalProperties": False} if closed else found


def _map(values: Any) -> Schema:
    return {"type": "object", "additionalProperties": values}


def _list(items: Any) -> Schema:
    return {"type": "array", "items": items}


def shape(value: Any) -> Schema:
    """The schema of a document that is always the same; of a table with many names, that of their values."""
    if isinstance(value, dict):
        inner = [shape(item) for item in value.values()]
        if len(inner) > 1 and all(one == inner[0] for one in inner):
            return _map(inner[0])
        return _object({name: shape(item) for name, item in value.items()})
    if isinstance(value, list):
        kinds = [shape(item) for item in value]
        unlike = [one for place, one in enumerate(kinds) if one not in kinds[:place]]
        return _list(unlike[0] if len(unlike) == 1 else {"anyOf": unlike} if unlike else {})
    if isinstance(value, bool):
        return _TRUTH
    return _NUMBER if isinstance(value, int | float) else _TEXT if isinstance(value, str) else {"type": "null"}


def _described(quantities: Mapping[str, Quantity], schema: Schema = _NUMBERS) -> dict[str, Any]:
    return {
        name: {**schema, "description": f"{quantity.info.meaning}, SI", "x-si-unit": quantity.unit}
        for name, quantity in quantities.items()
    }


def _provenance() -> Schema:
    return _object({"version": _TEXT, "model": _TEXT, "references": _list(_TEXT)})


def _run() -> Schema:
    side = {"type": "object", "properties": _described(quantities_of(RaceState))}
    always = [name for name in SHOWN if name in quantities_of(NutFriction)]
    results = {
        "type": "object",
        "required": [*always, "contributions", "validity", "screw", "nut"],
        "properties": {
            **_described(dict(quantities_of(NutFriction)) | dict(quantities_of(FrictionResult))),
            "contributions": _map(_NUMBER),
            "validity": _map(_TRUTH),
            "screw": side,
            "nut": side,
        },
    }
    words = _object({"title": _TEXT, "verdicts": _list(_TEXT), "assumed": _list(_TEXT)})
    return _object(
        {
            "inputs": _OBJECT, "results": results, "loads": _OBJECT, "units": _OBJECT, "warnings": _list(_TEXT),
            "provenance": _provenance(), "words": words,
        },
        optional=["loads"],
    )  # fmt: skip


def _sweep() -> Schema:
    values = {"type": "array", "description": "along the axes, in their order, one array in the other"}
    table = _map(_object({"values": values, "unit": {**_TEXT, "description": "SI"}, "meaning": _TEXT}))
    return _object({"axes": table, "outputs": table, "provenance": _provenance()})


def _compare() -> Schema:
    numbers = ("screw_torque", "efficiency", "back_driving_efficiency", "holding_torque")
    known = quantities_of(FrictionResult)
    row = {
        "name": _TEXT,
        "change": {**_NUMBER, "description": "friction torque over that of the case, less one"},
        **_described({name: known[name] for name in numbers}, _NUMBER),
        "contributions": _map(_NUMBER),
        "self_locking": _TRUTH,
        "valid": _TRUTH,
        "not_valid_because": _list(_TEXT),
    }
    slot = {"enum": list(LAWS)}
    end = _object({"slot": {"enum": [*LAWS, None]}, "name": _TEXT, "screw_torque": _NUMBER})
    ends = {"anyOf": [{"type": "null"}, _object({"least": end, "greatest": end})]}
    spread = _object({"models": ends, "valid_laws": ends, "change_by_slot": _map(_list(_NUMBER))})
    return _object(
        {
            "inputs": _OBJECT, "case": _object(row), "models": _list(_object(row)),
            "laws": _list(_object({"slot": slot, **row, "counts": _TRUTH})), "spread": spread,
            "units": _map(_TEXT), "reasons": _map(_TEXT), "provenance": _provenance(),
        }
    )  # fmt: skip


def _band(run: Schema) -> Schema:
    """What a run says, and the band beside it."""
    ends: dict[str, Any] = dict.fromkeys(Interval._fields, _NUMBER)
    intervals = [name for name, kind in OutputBand.__annotations__.items() if kind == Interval.__name__]
    own = {name: _NUMBER for name in OutputBand.__annotations__ if name not in intervals}
    # the band by both causes stands beside the value, the others by their names
    output = _object(own | ends | {name: _object(ends) for name in intervals if name != "both"})
    distribution = _object({"distribution": _TEXT, "source": _TEXT, "reason": _TEXT}, optional=["reason"])
    band = {
        "level": _NUMBER,
        "samples": {"type": "integer"},
        "seed": {"type": "integer"},
        **dict.fromkeys(BANDED, output),
        "self_locking_share": _NUMBER,
        "invalid_share": _NUMBER,
        "reasons": _map(_NUMBER),
        "laws": _map(_list(_object({"name": _TEXT, "factor": _NUMBER}))),
        "inputs": _map(distribution),
    }
    properties = {name: value for name, value in run["properties"].items() if name != "words"}
    words = _object({"sentences": _list(_TEXT), "inputs": _TEXT})
    return _object({**properties, "band": _object(band), "words": words}, optional=["loads"])


def _entry() -> Schema:
    """A row of the catalogue."""
    own, all_of_it = fields_of(CatalogueRow), quantities_of(CatalogueRow)
    derived = {name: quantity for name, quantity in all_of_it.items() if name not in own}
    numbers = {"row": _object(_described(own, _NUMBER)), "derived": _object(_described(derived, _NUMBER))}
    return _object({"name": _TEXT, "nut": {"type": ["string", "null"]}, "source": _TEXT, **numbers})


def _of_entries() -> dict[str, Any]:
    return {"units": _object({"row": _map(_TEXT), "derived": _map(_TEXT)}), "provenance": _object({"version": _TEXT})}


def _row() -> Schema:
    more = {"assumed": _map(_TEXT), **_of_entries(), "case": _OBJECT}
    return _object({**_entry()["properties"], **more})


def _validation() -> Schema:
    """A set, a model, and its rows."""
    row = {
        "name": _TEXT,
        "unit": _TEXT,
        "value": _NUMBER,
        "ratio": _NUMBER,
        "in_band": _TRUTH,
        "warnings": _list(_TEXT),
    }
    entry = {
        "set": _TEXT, "model": _TEXT, "calibration": {"type": ["string", "null"]}, "n": {"type": "integer"},
        "mean_ratio": _NUMBER, "std_ratio": _NUMBER, "share_in_band": _NUMBER,
        "rows": _list(_object(row, closed=False)),
    }  # fmt: skip
    return _list(_object(entry, closed=False))
