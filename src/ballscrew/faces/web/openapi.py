"""The OpenAPI document: bodies with examples, refusals, and the case file."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import FastAPI, Path
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel

from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.faces.web import problems
from ballscrew.faces.web.body_examples import examples
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.shared.schemas import Problem

_CASE, _SUMMARY = "Case", "Friction losses of ball screws"
_HERE, _THERE = "#/$defs/", "#/components/schemas/"
#: Refusals: of any address, of those with a body, of those that compute for long.
_ANY, _POST, _HEAVY = (403, 421, 422), (400, 408, 413, 415), (429,)
_TEXT = {"type": "string"}
#: A row of the catalogue by its name, with one to try.
RowName = Annotated[str, Path(description="whatever its capitals", examples=[next(iter(catalogue()))])]


def body(kind: type[BaseModel]) -> dict[str, Any]:
    """The body of a request; its case is a case file."""
    schema = kind.model_json_schema()
    if "case" in schema["properties"]:
        schema["properties"]["case"] = {"$ref": f"{_THERE}{_CASE}"}
    content = {
        "schema": schema,
        "examples": {name: {"value": value} for name, value in examples(kind.__name__).items()},
    }
    return {"requestBody": {"required": True, "content": {"application/json": content}}}


def problems_of(*others: int) -> dict[int | str, dict[str, Any]]:
    """The refusals of an address."""
    content = {problems.MEDIA_TYPE: {"schema": {"$ref": f"{_THERE}{Problem.__name__}"}}}
    return {
        status: {"description": problems.TITLES[status], "content": content}
        for status in sorted({*_ANY, *_POST, *_HEAVY, *others})
    }


def text(*media: str) -> dict[int | str, dict[str, Any]]:
    """The answers of an address that sends a file."""
    content = {kind.partition(";")[0]: {"schema": _TEXT} for kind in media}
    return {200: {"description": "the file", "content": content}, **problems_of()}


def document(app: FastAPI) -> dict[str, Any]:
    """The OpenAPI document: that of the routes, with the case file that they refer to."""
    values = get_openapi(title=app.title, version=app.version, routes=app.routes, summary=_SUMMARY)
    case = _moved(json_schema())
    parts = case.pop("$defs")
    case.pop("$schema")
    schemas = values.setdefault("components", {}).setdefault("schemas", {})
    assert not parts.keys() & schemas.keys()  # two parts of one name
    assert Problem.__name__ in schemas  # it is part of an answer
    schemas.update({**parts, _CASE: case})
    return values


def _moved(schema: Any) -> Any:
    """A schema whose references lead to where its parts are in an OpenAPI document."""
    if isinstance(schema, dict):
        return {name: _moved(value) for name, value in schema.items()}
    if isinstance(schema, list):
        return [_moved(item) for item in schema]
    return schema.replace(_HERE, _THERE) if isinstance(schema, str) else schema
