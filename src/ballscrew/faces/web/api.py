"""The JSON API: each address answers like the command of the same name.

Those of questions that have a record are made of it, see :mod:`ballscrew.faces.web.question_api`.
"""

from __future__ import annotations

import dataclasses
import functools
import threading
from collections.abc import Callable, Mapping
from typing import Annotated, Any

import tomlkit
from fastapi import APIRouter, Depends, Query, Request
from starlette.responses import Response

from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.cases.screw_tables.catalogue import case_text, chosen, list_document, named, show_document
from ballscrew.cases.screw_tables.own_nut import own_nut_of
from ballscrew.faces.page import starts, vocabulary
from ballscrew.faces.report.contents import Heading
from ballscrew.faces.report.options import ReportOptions
from ballscrew.faces.web import (
    answers_api,
    documents,
    file_api,
    job_api,
    limits,
    module_api,
    openapi,
    question_api,
)
from ballscrew.faces.web.bodies import (
    BandBody,
    CaseBody,
    CasesBody,
    OwnNutBody,
    ReportBody,
    SweepBody,
    case_of,
    read,
)
from ballscrew.faces.web.endpoint_parts import (
    always,
    as_bytes,
    as_json,
    cancellable,
    computed_once,
    heavy,
    kept,
    known_query,
    of_run,
    own_site,
    post,
    processed,
    queue_of,
    sent,
)
from ballscrew.faces.web.problems import Refused
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.physics.sizing import catalogue as shipped
from ballscrew.questions import responses
from ballscrew.questions.band import BandOptions, compute
from ballscrew.questions.catalogue import own_nut_document
from ballscrew.questions.check.answer import with_nut_named
from ballscrew.questions.hand_over.answer import Targets, targets
from ballscrew.questions.optimise import need_schema
from ballscrew.questions.shared import option_values, schemas
from ballscrew.questions.sweep import SweepOptions
from ballscrew.questions.sweep import answer as sweep_documents
from ballscrew.questions.sweep import compute as sweeps
from ballscrew.questions.sweep.band import INNER, with_band
from ballscrew.questions.validate import answer as validation_documents
from ballscrew.questions.validate import compute as validation

#: Media types of a report, by its ``kind``.
KINDS: Mapping[str, str] = {"pdf": "application/pdf", "html": "text/html; charset=utf-8"}


_VALIDATION_LOCK = threading.Lock()
router = APIRouter(prefix="/api/v1", dependencies=[Depends(own_site), Depends(known_query)])
for _part in (answers_api, file_api, question_api, module_api, job_api):
    router.include_router(_part.router)


# -- of a case --------------------------------------------------------------------------------------


@router.post(
    "/run", openapi_extra=openapi.body(CaseBody), response_model=responses.Run, responses=openapi.problems_of()
)
async def run(request: Request) -> Response:
    """Friction at the operating point of a case: the document of ``ballscrew run --json``, with sentences."""
    body: CaseBody = await read(request, CaseBody)
    return await of_run(request, body.case, lambda result: as_json(documents.run(result)))


@router.post(
    "/check", openapi_extra=openapi.body(CaseBody), response_model=responses.Checks, responses=openapi.problems_of()
)
async def check(request: Request) -> Response:
    """Life, strength and speed against their limits: the document of ``ballscrew check --json`` but its name."""
    body: CaseBody = await read(request, CaseBody)
    tables, notes = with_nut_named(body.case)
    return await of_run(request, tables, lambda result: as_json(documents.check(result, notes)))


@router.post("/drawing", openapi_extra=openapi.body(CaseBody), responses=openapi.text("image/svg+xml"))
async def drawing(request: Request) -> Response:
    """The ball between its grooves and the slip in its contact, to scale, as SVG."""
    from ballscrew.faces.report.drawing import drawing

    body: CaseBody = await read(request, CaseBody)
    return await of_run(request, body.case, lambda result: Response(drawing(result), media_type="image/svg+xml"))


@router.post(
    "/sweep", openapi_extra=openapi.body(SweepBody), response_model=responses.Sweep, responses=openapi.problems_of()
)
async def sweep(request: Request) -> Response:
    """Friction over ranges of load, speed or any other field: the document of ``ballscrew sweep --json``."""
    body: CaseBody = await read(request, SweepBody)
    options = option_values.read(SweepOptions, dict(body))
    limits.check_size(dict(each.split("=", 1) for each in options.vary), len(options.outputs), banded=options.band)

    def planned() -> tuple[Case, sweeps.Plan, int | None]:
        case = case_of(body.case)
        if not options.vary:
            limits.check_size(case.sweep, len(options.outputs), banded=options.band)
        plan = sweeps.plan(case, options.vary, options.outputs, None, banded=options.band)
        plan = sweeps.with_flooded_torque(case, plan)
        limits.check_values(plan)
        return case, plan, limits.samples_of_sweep(case, plan, options.samples) if plan.banded else None

    queue = queue_of(request)
    case, plan, samples = await queue.quick(planned)

    def work(done: Deadline) -> Response:
        result = sweeps.sweep(case, plan, done)
        if plan.banded:
            of_bands = dataclasses.replace(options.of_bands, samples=samples)
            result = with_band(case, plan, result, of_bands, done, inner=INNER)
        return as_json(sweep_documents.document(case, plan, result))

    if limits.is_short(case, plan):
        return await computed_once(request, lambda: queue.short(work))
    return await heavy(request, work)


@post(router, "/band", BandBody, responses.Band)
def band(body: CaseBody, done: Deadline) -> Response:
    """The band of a case and its causes: the document of ``ballscrew run --band --json``, with sentences."""
    options, case = option_values.read(BandOptions, dict(body)), case_of(body.case)
    limited = dataclasses.replace(options, samples=limits.samples_of(case, options.samples))
    return as_json(documents.band(case, compute.band(case, limited, done)))


@router.post("/report", openapi_extra=openapi.body(ReportBody), responses=openapi.text(*KINDS.values()))
async def report(
    request: Request,
    kind: Annotated[str, Query(json_schema_extra={"enum": [*KINDS]}, description="the kind of file")] = "pdf",
) -> Response:
    """The report of a case, as ``ballscrew report`` writes it."""
    body: CasesBody = await read(request, ReportBody)
    options = option_values.read(ReportOptions, dict(body))
    if kind not in KINDS:
        raise InputError(Fault("?kind", "unknown kind of file", kind, nearest(kind, KINDS)))
    heading = Heading.of(options.project, options.date)

    def work(done: Deadline) -> Response:
        from ballscrew.faces.report.pdf import Kind, report_bytes  # slow to import

        cases = [case_of(tables) for tables in (body.case, *body.beside)]
        file: Kind = "pdf" if kind == "pdf" else "html"
        # none has more samples than the largest of them has
        fewest = [count for each in cases if (count := limits.samples_of(each, options.samples)) is not None]
        content = report_bytes(cases[0], file, done, min(fewest) if fewest else None, heading, cases[1:])
        return Response(content, media_type=KINDS[kind])

    # not kept: it may have the date of today
    return await cancellable(request, processed(request, work))


# -- of a catalogue, and of the program -------------------------------------------------------------


@post(router, "/own-nut", OwnNutBody, responses.OwnNut, is_quick=always)
def own_nut(body: OwnNutBody, _: object) -> Response:
    """A case of few numbers, what was estimated in it: the document of ``ballscrew catalogue own --json``."""
    return as_json(own_nut_document(own_nut_of(body.numbers)))


@router.get("/catalogue", response_model=responses.Catalogue, responses=openapi.problems_of())
async def catalogue(
    words: Annotated[str, Query(description="all of them must be in a row")] = "",
) -> Response:
    """Rows of the catalogue with these words: the document of ``ballscrew catalogue list --json``."""
    return as_json(list_document(chosen(shipped.catalogue(), words)))


@router.get("/catalogue/{name}", response_model=responses.Row, responses=openapi.problems_of(404))
async def row(name: openapi.RowName) -> Response:
    """One row: the document of ``ballscrew catalogue show --json``, and the case that ``--case`` writes, as tables."""
    try:
        listed = named(shipped.catalogue(), name)
    except InputError as error:
        raise Refused(404, *error.faults) from None
    return as_json({**show_document(listed), "case": tomlkit.parse(case_text(listed)).unwrap()})


@router.get("/validate", response_model=list[responses.ValidationEntry], responses=openapi.problems_of())
async def validate(
    request: Request,
    set: Annotated[str, Query(json_schema_extra={"enum": ["", *validation.SETS]}, description="one set alone")] = "",
) -> Response:
    """The model against data of vendors and laboratories: the document of ``ballscrew validate --json``."""
    requested = validation.request([set] if set else [])
    names = tuple(data.name for data in requested.sets)
    # in a thread: it is computed once and kept, as all data are shipped
    return await cancellable(request, queue_of(request).heavy(lambda _: sent(_validated(names))))


@functools.cache
def _validation(names: tuple[str, ...]) -> bytes:
    """The document of some sets."""
    entries = [entry for entries, _ in validation.evaluate(validation.request(names)) for entry in entries]
    return as_bytes(validation_documents.documents(entries))


def _validated(names: tuple[str, ...]) -> bytes:
    """The document of some sets; a second request waits for the first one and finds it computed."""
    with _VALIDATION_LOCK:
        return _validation(names)


def _constant(path: str, document: Callable[[], Any], model: type, words: str) -> None:
    """Add the address of a document that is always the same."""
    content = functools.cache(lambda: as_bytes(document()))

    async def answer(request: Request) -> Response:
        return kept(request, content())

    name = path.strip("/").replace("-", "_")
    responses = openapi.problems_of()
    router.get(path, name=name, description=words, response_model=model, responses=responses)(answer)


_constant("/schema", json_schema, schemas.CaseSchema, "JSON Schema of a case file, as ``ballscrew schema`` prints it.")
_constant(
    "/need-schema",
    need_schema.json_schema,
    schemas.NeedSchema,
    "JSON Schema of a need, as ``ballscrew schema --need`` prints it.",
)
_constant(
    "/vocabulary",
    vocabulary.vocabulary,
    vocabulary.Vocabulary,
    "Units and their factors, results and mechanisms by name, models, and cases to start from.",
)
_constant(
    "/targets",
    targets,
    schemas.schema(Targets),
    "The targets of a hand-over, and the choices that each has.",
)
_constant(
    "/examples",
    starts.logs,
    responses.Examples,
    "Logs to try, each with its case: those of the folder ``examples`` of the repository.",
)
