"""The OpenAPI document: bodies with examples, refusals, and the case file."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import FastAPI, Path
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel

from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.faces.web import problems
from ballscrew.faces.web.bodies import (
    BandBody,
    CaseBody,
    MovingBody,
    NeedBody,
    OpenBody,
    OptimiseBody,
    OwnNutBody,
    ProjectBody,
    SensitivityBody,
    SweepBody,
    WarmUpBody,
)
from ballscrew.faces.web.log_bodies import examples_with_logs
from ballscrew.faces.web.vocabulary import vocabulary
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.shared.answer_parts import Problem

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
    if kind is NeedBody:
        need = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "life": "20000 h"}
        return {"few": {"need": {**need, "preload": "2 %"}, "words": "rexroth 32x"}}
    if kind is OwnNutBody:
        return {"few": {"numbers": {"d0": "40 mm", "lead": "10 mm", "turns": "2x2.5", "Ca": "52.7 kN"}}}
    if kind is OptimiseBody:
        need = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "life": "20000 h"}
        few = {"population": 8, "generations": 2, "members": 2}
        return {"few": {"need": {**need, "optimise": {"elastic_generations": 0}}, **few}}
    if kind is OpenBody:
        text = 'lubricant.grade = "ISO VG 68"\nscrew.catalogue = "hiwin-40-20k4"\n'
        return {"case": {"file": {"name": "case.toml", "text": text}}}
    if kind is ProjectBody:
        return {"two": {"designs": [{"name": name, "case": case} for name, case in (("paper", paper), ("nut", nut))]}}
    if issubclass(kind, MovingBody):
        moving: dict[str, Any] = {
            "axis": {"mass": "400 kg", "inclination": "90 deg"},
            "motion": {"kind": "trapezoid", "stroke": "0.5 m", "speed": "10 m/min", "acceleration": "0.5 g"},
            "installation": {"unsupported_length": "1 m", "ends": "fixed-supported"},
        }
        return {name: {"case": {**case, **moving}} for name, case in (("paper", paper), ("nut", nut))}
    if issubclass(kind, CaseBody) and (found := examples_with_logs(kind, paper)):
        return found
    more: dict[str, Any] = {}
    if kind is SweepBody:
        more = {"vary": {"axial_load": "100:4000:5 N", "screw_speed": "10, 100 rpm"}, "outputs": ["efficiency"]}
    if kind is WarmUpBody:
        more = {"hours": 1.0, "band": True, "samples": 16}
        paper = {**paper, "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"}}
    if kind is SensitivityBody:
        more = {"samples": 16}
    if kind is BandBody:
        more = {"samples": 64, "level": 0.9}
    return {"paper": {"case": paper, **more}, "nut": {"case": nut, **more}}


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
    found = get_openapi(title=app.title, version=app.version, routes=app.routes, summary=_SUMMARY)
    case = _moved(json_schema())
    parts = case.pop("$defs")
    case.pop("$schema")
    schemas = found.setdefault("components", {}).setdefault("schemas", {})
    assert not parts.keys() & schemas.keys()  # two parts of one name
    assert Problem.__name__ in schemas  # it is part of an answer
    schemas.update({**parts, _CASE: case})
    return found


def _moved(schema: Any) -> Any:
    """A schema whose references lead to where its parts are in an OpenAPI document."""
    if isinstance(schema, dict):
        return {name: _moved(value) for name, value in schema.items()}
    if isinstance(schema, list):
        return [_moved(item) for item in schema]
    return schema.replace(_HERE, _THERE) if isinstance(schema, str) else schema
