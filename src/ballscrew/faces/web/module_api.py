"""Addresses of the API for the modules with which the page computes by itself while something is moved."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Path, Request
from pydantic import Field
from starlette.responses import Response

from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import inputs_of_structure, numbers_alone
from ballscrew.exports.wasm_modules import NUT_DIAMETER, KeptModule, module_of_solver, oils
from ballscrew.faces.web import openapi
from ballscrew.faces.web.bodies import CaseBody, Tables, case_of, read
from ballscrew.faces.web.endpoint_parts import as_json, cancellable, queue_of
from ballscrew.faces.web.files import FOR_GOOD
from ballscrew.faces.web.modules import Modules, NotMadeError
from ballscrew.faces.web.problems import Refused
from ballscrew.physics.components.materials import OF_A_GRADE
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.curves import axes_around
from ballscrew.questions.shared.schemas import Closed, Number
from ballscrew.questions.shared.schemas import Tables as AnyTables

#: A quantity as a case has it, with its unit or as a plain number.
_WRITTEN = str | int | float
#: A module that there is always.
_SOLVER = module_of_solver().file

router = APIRouter()


class InputPlace(Closed):
    """A number of the case that follows from the text in its field alone: its input, its unit and its bounds."""

    input: str
    unit: str
    above: Number
    at_least: Number
    below: Number
    at_most: Number
    whole: bool


class CurveAxis(Closed):
    """Rule by which the values of an axis follow from the operating point: to twice its value, from a share of that."""

    share: float = Field(description="the far end over the first value")
    points: int
    points_of_sign: int = Field(description="points of either sign, where the value is negative")
    far: float = Field(description="the far end where the value is none, SI")


class OilModule(Closed):
    """The numbers of the oil by its temperature."""

    file: str
    function: str
    inputs: list[str]
    outputs: list[str]
    constants: dict[str, Number]


class CaseModule(Closed):
    """The module of the structure of a case."""

    state: Literal["ready", "pending", "none"] = Field(description="pending: it is made now, ask again")
    reason: str | None = Field(description="why there is none")
    structure: AnyTables | None = Field(description="its file, and what its functions read and give")
    solver: str | None = Field(description="the file of the solver of the balls, where they are solved one by one")
    oil: OilModule | None
    values: dict[str, Number] = Field(description="all numbers of the case by their inputs, SI")
    places: dict[str, InputPlace] = Field(description="by their paths in the case")
    axes: dict[str, dict[str, CurveAxis]] = Field(description="of the curves")


@router.post(
    "/module", openapi_extra=openapi.body(CaseBody), response_model=CaseModule, responses=openapi.problems_of()
)
async def module(request: Request) -> Response:
    """The module of the structure of a case, with which a browser computes by itself, and the numbers of this case."""
    body: CaseBody = await read(request, CaseBody)
    modules = _modules_of(request)
    return await cancellable(request, queue_of(request).quick(lambda: as_json(_answer(modules, body.case))))


@router.get(
    "/modules/{file}",
    response_class=Response,
    responses={
        200: {"description": "a module", "content": {"application/wasm": {"schema": {"type": "string"}}}},
        **openapi.problems_of(404),
    },
)
async def code(
    request: Request, file: Annotated[str, Path(description="of the answer", examples=[_SOLVER])]
) -> Response:
    """A module as WebAssembly; its name follows from its bytes."""
    result = _modules_of(request).code(file)
    if result is None:
        raise Refused(404, Fault("/modules/", "no such module", file[:80], "ask for the module of the case again"))
    return Response(result, media_type="application/wasm", headers={"Cache-Control": FOR_GOOD})


def _modules_of(request: Request) -> Modules:
    modules: Modules = request.app.state.modules
    return modules


def _answer(modules: Modules, tables: Tables) -> dict[str, Any]:
    case = case_of(tables)
    subject = numbers_alone(Configuration(case.model, case.screw, case.lubricant))
    empty: dict[str, Any] = {
        "reason": None, "structure": None, "solver": None, "oil": None, "values": {}, "places": {}, "axes": {},
    }  # fmt: skip
    try:
        if case.efficiency is not None:
            raise NotMadeError("the case has an efficiency in place of a model")
        grade = case.lubricant.grade if case.lubricant.grade in oils() and case.lubricant.sheet is None else None
        kept, of_oils = modules.of(subject), modules.of_oils() if grade is not None else None
    except NotMadeError as error:
        return {**empty, "state": "none", "reason": str(error)}
    if kept is None or (grade is not None and of_oils is None):
        return {**empty, "state": "pending"}
    return {
        **empty,
        "state": "ready",
        "structure": kept.document,
        "solver": modules.solver() if "by_ball" in kept.document else None,
        "oil": None if grade is None or of_oils is None else _oil(of_oils, grade),
        "values": _values(case, subject),
        "places": dict(_places(case, subject, tables, grade)),
        "axes": axes_around(is_nut=case.nut is not None),
    }


def _oil(of_oils: KeptModule, grade: str) -> dict[str, Any]:
    """The function of a grade."""
    return {"file": of_oils.document["file"], **of_oils.document["grades"][grade]}


def _values(case: Case, subject: Configuration) -> dict[str, Any]:
    """All numbers of a case by the inputs of its module; the usual size of a nut is none."""
    values = {name: getattr(case.operation, name) for name in OPERATION}
    values |= {name: subject.value_of(name) for name in inputs_of_structure(subject) if name not in OPERATION}
    if subject.nut.bodies is not None:
        values[NUT_DIAMETER] = subject.nut.bodies.nut_outer_diameter
    return {name: None if value is None or math.isnan(value) else float(value) for name, value in values.items()}


def _places(
    case: Case, subject: Configuration, tables: Tables, grade: str | None
) -> Iterator[tuple[str, dict[str, Any]]]:
    """The fields given in the case that an input follows from, each alone, and that nothing else follows from.

    A row of a catalogue, a speed of the nut and a preload as a share of the rating follow from several ones.
    """
    known = {name: subject.inputs[name] for name in inputs_of_structure(subject)}
    is_share = "%" in str(_at(tables, "nut.preload"))
    of_row = _at(tables, "screw.catalogue") is not None
    # what follows from several fields, by the part, and by the name.
    parts = {"screw": of_row or is_share or case.origins.speed_of_nut, "model": case.origins.calibration is not None}
    names = {"screw_speed": case.origins.speed_of_nut, "preload": is_share}
    names |= dict.fromkeys(OF_A_GRADE, bool(case.origins.oil) or grade is not None)
    for name, (part, quantity) in known.items():
        if parts.get(part, False) or names.get(name, False):
            continue
        path = name if name.startswith("losses.") else f"{part}.{name}"
        if isinstance(_at(tables, path), _WRITTEN):
            yield path, _place(name, quantity)
    if subject.nut.bodies is not None and isinstance(_at(tables, NUT_DIAMETER), str):
        yield NUT_DIAMETER, _place(NUT_DIAMETER, fields_of(Bodies)["nut_outer_diameter"])
    of_grade = [name for name in OF_A_GRADE if _at(tables, f"lubricant.{name}") is not None]
    if grade is not None and not of_grade and isinstance(_at(tables, f"lubricant.{TEMPERATURE.name}"), str):
        yield f"lubricant.{TEMPERATURE.name}", _place(TEMPERATURE.name, TEMPERATURE)


def _place(name: str, quantity: Quantity) -> dict[str, Any]:
    info = quantity.info
    return {
        "input": name,
        "unit": quantity.unit,
        **{name: getattr(info, name) for name in ("above", "at_least", "below", "at_most", "whole")},
    }


def _at(tables: Mapping[str, Any], path: str) -> Any:
    """Value at a path in tables; None where nothing does."""
    result: Any = tables
    for key in path.split("."):
        result = result.get(key) if isinstance(result, dict) else None
    return result
