"""What the API says of itself: bodies and answers in JSON Schema, made from what the program is made of."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel

from ballscrew.assembly import NutFriction
from ballscrew.components.contact import RaceState
from ballscrew.interfaces.report import SHOWN
from ballscrew.interfaces.schema import json_schema
from ballscrew.interfaces.web import problems
from ballscrew.quantities import Quantity, quantities_of
from ballscrew.result import FrictionResult

_CASE = "Case"
_HERE, _THERE = "#/$defs/", "#/components/schemas/"
#: What a request may be told besides its answer.
_POST, _GET = (400, 408, 413, 415, 422, 429), (408, 422, 429)
_NUMBER = {"type": ["number", "null"]}
_NUMBERS = {"anyOf": [_NUMBER, {"type": ["array", "boolean"]}]}


def body(kind: type[BaseModel]) -> dict[str, Any]:
    """The body of a request; its case is a case file."""
    schema = kind.model_json_schema()
    schema["properties"]["case"] = {"$ref": f"{_THERE}{_CASE}"}
    return {"requestBody": {"required": True, "content": {"application/json": {"schema": schema}}}}


def answers(name: str, *others: int) -> dict[int | str, dict[str, Any]]:
    """The answers of an address: JSON of that schema, and the problems."""
    found = {"description": "the answer", "content": {"application/json": {"schema": {"$ref": f"{_THERE}{name}"}}}}
    return {200: found, **_problems(*others)}


def text(*media: str) -> dict[int | str, dict[str, Any]]:
    """The answers of an address that sends a file."""
    content = {kind.partition(";")[0]: {"schema": {"type": "string"}} for kind in media}
    return {200: {"description": "the file", "content": content}, **_problems()}


def _problems(*others: int) -> dict[int | str, dict[str, Any]]:
    content = {problems.MEDIA_TYPE: {"schema": {"$ref": f"{_THERE}Problem"}}}
    return {
        status: {"description": problems.TITLES[status], "content": content}
        for status in sorted({*_POST, *_GET, *others})
    }


@functools.cache
def components() -> Mapping[str, Any]:
    """The schemas that the addresses refer to."""
    case = _moved(json_schema())
    parts = case.pop("$defs")
    case.pop("$schema")
    return {
        **parts,
        _CASE: case,
        "Problem": dict(problems.SCHEMA),
        "Run": _run(),
        "Sweep": _sweep(),
        "Object": {"type": "object"},
        "List": {"type": "array", "items": {"type": "object"}},
    }


def _moved(schema: Any) -> Any:
    """A schema whose references lead to where its parts are in an OpenAPI document."""
    if isinstance(schema, dict):
        return {name: _moved(value) for name, value in schema.items()}
    if isinstance(schema, list):
        return [_moved(item) for item in schema]
    return schema.replace(_HERE, _THERE) if isinstance(schema, str) else schema


def _described(quantities: Mapping[str, Quantity]) -> dict[str, Any]:
    return {
        name: {**_NUMBERS, "description": f"{quantity.info.meaning}, SI", "x-si-unit": quantity.unit}
        for name, quantity in quantities.items()
    }


def _run() -> dict[str, Any]:
    side = {"type": "object", "properties": _described(quantities_of(RaceState))}
    always = [name for name in SHOWN if name in quantities_of(NutFriction)]
    results = {
        "type": "object",
        "required": [*always, "contributions", "validity", "screw", "nut"],
        "properties": {
            **_described(dict(quantities_of(NutFriction)) | dict(quantities_of(FrictionResult))),
            "contributions": {"type": "object", "additionalProperties": _NUMBER},
            "validity": {"type": "object", "additionalProperties": {"type": "boolean"}},
            "screw": side,
            "nut": side,
        },
    }
    texts = {"type": "array", "items": {"type": "string"}}
    words = {"title": {"type": "string"}, "verdicts": texts, "assumed": texts}
    return {
        "type": "object",
        "required": ["inputs", "results", "units", "warnings", "provenance", "words"],
        "properties": {
            "inputs": {"type": "object"},
            "results": results,
            "loads": {"type": "object"},
            "units": {"type": "object"},
            "warnings": texts,
            "provenance": {"type": "object", "required": ["version", "model", "references"]},
            "words": {"type": "object", "required": list(words), "properties": words},
        },
    }


def _sweep() -> dict[str, Any]:
    column = {
        "type": "object",
        "required": ["values", "unit", "meaning"],
        "properties": {
            "values": {"type": "array"},
            "unit": {"type": "string", "description": "SI"},
            "meaning": {"type": "string"},
        },
    }
    table = {"type": "object", "additionalProperties": column}
    return {
        "type": "object",
        "required": ["axes", "outputs", "provenance"],
        "properties": {"axes": table, "outputs": table, "provenance": {"type": "object"}},
    }
