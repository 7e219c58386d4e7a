"""The JSON API: each address answers like the command of the same name."""

from __future__ import annotations

import dataclasses
import functools
import threading
from collections.abc import Mapping
from typing import Annotated

import tomlkit
from fastapi import APIRouter, Depends, Query, Request
from starlette.responses import Response

from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any
from ballscrew.cases.case_files import case_file
from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.cases.screw_tables import catalogue as rows
from ballscrew.faces.report.heading import Heading
from ballscrew.faces.report.options import ReportOptions
from ballscrew.faces.web import (
    answers_api,
    documents,
    file_api,
    job_api,
    limits,
    log_api,
    memory,
    module_api,
    moving_api,
    openapi,
    own_nut_api,
    study_api,
    vocabulary,
)
from ballscrew.faces.web.bodies import (
    AxisBody,
    BandBody,
    CaseBody,
    CasesBody,
    DutyBody,
    MovingBody,
    NeedBody,
    NeedOfTable,
    ReportBody,
    SweepBody,
    WarmUpBody,
    case_of,
    read,
    refuse_paths,
)
from ballscrew.faces.web.endpoint_parts import (
    as_bytes,
    as_json,
    cancellable,
    computed_once,
    heavy,
    kept,
    known_query,
    of_body,
    of_run,
    own_site,
    queue_of,
    sent,
    with_sheet,
)
from ballscrew.faces.web.problems import Refused
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.faces.web.sent_files import written
from ballscrew.physics.sizing.catalogue import catalogue as shipped
from ballscrew.questions.axis import answer as axis_documents
from ballscrew.questions.axis import compute as chains
from ballscrew.questions.axis.answer import ChainResults
from ballscrew.questions.axis.options import AxisOptions
from ballscrew.questions.axis.sheet import sheet as axis_sheet
from ballscrew.questions.band import compute as bands
from ballscrew.questions.band import response as band_answers
from ballscrew.questions.band.options import BandOptions
from ballscrew.questions.catalogue import answer as catalogue_answers
from ballscrew.questions.check import answer as check_answers
from ballscrew.questions.check.compute import with_nut_named
from ballscrew.questions.compare import answer as comparison_documents
from ballscrew.questions.compare.compute import comparison
from ballscrew.questions.compare.response import Compare
from ballscrew.questions.duty import answer as duty_documents
from ballscrew.questions.duty import compute as duties
from ballscrew.questions.duty.answer import DutyResults
from ballscrew.questions.duty.sheet import sheet as duty_sheet
from ballscrew.questions.optimise.need_schema import json_schema as schema_of_needs
from ballscrew.questions.run import response as run_answers
from ballscrew.questions.select import answer as selection_documents
from ballscrew.questions.select import response as select_answers
from ballscrew.questions.select.compute import plan as planned_selection
from ballscrew.questions.select.compute import select as selected
from ballscrew.questions.select.need import need_of
from ballscrew.questions.select.options import SelectOptions
from ballscrew.questions.shared import answer_parts, option_values, schema_answer
from ballscrew.questions.shared.declared import response
from ballscrew.questions.sweep import answer as sweep_documents
from ballscrew.questions.sweep import compute as sweeps
from ballscrew.questions.sweep import response as sweep_answers
from ballscrew.questions.sweep.band import INNER, with_band
from ballscrew.questions.sweep.options import SweepOptions
from ballscrew.questions.validate import answer as validate_answers
from ballscrew.questions.validate import compute as validation
from ballscrew.questions.validate import document as validation_documents
from ballscrew.questions.warm_up import answer as warm_up_documents
from ballscrew.questions.warm_up import band as warm_up_bands
from ballscrew.questions.warm_up import compute as warm_ups
from ballscrew.questions.warm_up.answer import WarmUpResults
from ballscrew.questions.warm_up.band_answer import BesideWarmUp
from ballscrew.questions.warm_up.options import WarmUpOptions
from ballscrew.questions.warm_up.sheet import sheet as warm_up_sheet

#: Media types of a report, by its ``kind``.
KINDS: Mapping[str, str] = {"pdf": "application/pdf", "html": "text/html; charset=utf-8"}


_VALIDATION_LOCK = threading.Lock()
router = APIRouter(prefix="/api/v1", dependencies=[Depends(own_site), Depends(known_query)])
router.include_router(answers_api.router)
router.include_router(file_api.router)
router.include_router(log_api.router)
router.include_router(moving_api.router)
router.include_router(study_api.router)
router.include_router(own_nut_api.router)
router.include_router(module_api.router)
router.include_router(job_api.router)


@router.post(
    "/run", openapi_extra=openapi.body(CaseBody), response_model=run_answers.Run, responses=openapi.problems_of()
)
async def run(request: Request) -> Response:
    """Friction at the operating point of a case: the document of ``ballscrew run --json``, with sentences."""
    return await of_body(request, lambda found: as_json(documents.run(found)))


@router.post(
    "/check",
    openapi_extra=openapi.body(CaseBody),
    response_model=check_answers.Checks,
    responses=openapi.problems_of(),
)
async def check(request: Request) -> Response:
    """Life, strength and speed against their limits: the document of ``ballscrew check --json`` but its name."""
    body: CaseBody = await read(request, CaseBody)
    tables, notes = with_nut_named(body.case)
    return await of_run(request, tables, lambda found: as_json(documents.check(found, notes)))


@router.post(
    "/sweep", openapi_extra=openapi.body(SweepBody), response_model=sweep_answers.Sweep, responses=openapi.problems_of()
)
async def sweep(request: Request) -> Response:
    """Friction over ranges of load, speed or any other field: the document of ``ballscrew sweep --json``."""
    body: CaseBody = await read(request, SweepBody)
    options = option_values.read(SweepOptions, dict(body))
    limits.check_size(dict(each.split("=", 1) for each in options.vary), len(options.outputs), banded=options.band)

    def planned() -> tuple[case_file.Case, sweeps.Plan, int | None]:
        case = case_of(body.case)
        if not options.vary:
            limits.check_size(case.sweep, len(options.outputs), banded=options.band)
        plan = sweeps.plan(case, options.vary, options.outputs, None, banded=options.band)
        plan = sweeps.with_flooded_torque(case, plan)
        limits.check_sweep(case, plan)
        return case, plan, limits.samples_of_sweep(case, plan, options.samples) if plan.banded else None

    queue = queue_of(request)
    case, plan, samples = await queue.quick(planned)

    def work(done: Deadline) -> Response:
        found = sweeps.sweep(case, plan, done)
        if plan.banded:
            of_bands = dataclasses.replace(options.of_bands, samples=samples)
            found = with_band(case, plan, found, of_bands, done, inner=INNER)
        return as_json(sweep_documents.document(case, plan, found))

    if limits.is_short(case, plan):
        return await computed_once(request, lambda: queue.short(work))
    return await heavy(request, work)


@router.post(
    "/compare",
    openapi_extra=openapi.body(CaseBody),
    response_model=Compare,
    responses=openapi.problems_of(),
)
async def compare(request: Request) -> Response:
    """All models and all laws side by side: the document of ``ballscrew compare --json``."""
    body: CaseBody = await read(request, CaseBody)

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        return as_json(comparison_documents.document(case, comparison(case, done)))

    return await heavy(request, work)


@router.post(
    "/band", openapi_extra=openapi.body(BandBody), response_model=band_answers.Band, responses=openapi.problems_of()
)
async def band(request: Request) -> Response:
    """The band of a case and its causes: the document of ``ballscrew run --band --json``, with sentences."""
    body: CaseBody = await read(request, BandBody)
    options = option_values.read(BandOptions, dict(body))

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        limited = dataclasses.replace(options, samples=limits.samples_of(case, options.samples))
        found = bands.band(case, limited, done)
        return as_json(documents.band(case, found))

    return await heavy(request, work)


@router.post(
    "/duty",
    openapi_extra=openapi.body(DutyBody),
    response_model=response(DutyResults, "Duty", judged=True),
    responses=openapi.problems_of(),
)
async def duty(request: Request) -> Response:
    """A cycle of the axis of a case: the document of ``ballscrew duty --json``."""
    body: DutyBody = await read(request, DutyBody)

    def work(_: Deadline) -> Response:
        with written({} if body.trace is None else {"trace": body.trace}) as paths:
            case = case_of(body.case, moves=True, trace=paths.get("trace"))
        report = duties.duty(case)
        return with_sheet(duty_documents.document(report), duty_sheet(report))

    return await heavy(request, work)


@router.post(
    "/warm-up",
    openapi_extra=openapi.body(WarmUpBody),
    response_model=response(WarmUpResults, "WarmUp", beside=BesideWarmUp),
    responses=openapi.problems_of(),
)
async def warm_up(request: Request) -> Response:
    """How a case warms up, and where that ends: the document of ``ballscrew warm-up --json``."""
    body: CaseBody = await read(request, WarmUpBody)
    options = option_values.read(WarmUpOptions, dict(body))
    raise_if_any(warm_ups.option_faults(options.band, options.samples, options.level, options.only_given))
    warm_ups.check_hours(options.hours, options.cool_down)

    def work(done: Deadline) -> Response:
        case = case_of(body.case, moves=warm_ups.moves(body.case))
        limits.check_warm_up(case, options.samples)
        if not options.band:
            warmed = warm_ups.warmed_up(case, options.hours, options.cool_down)
            return with_sheet(warm_up_documents.document(warmed), warm_up_sheet(warmed))
        found = warm_up_bands.band(
            case,
            options.hours,
            options.cool_down,
            samples=options.samples,
            level=options.level,
            only_given=options.only_given,
            done=done,
        )
        return with_sheet(warm_up_documents.with_band(found), warm_up_sheet(found.report, found))

    return await heavy(request, work)


@router.post(
    "/select",
    openapi_extra=openapi.body(NeedBody),
    response_model=select_answers.Select,
    responses=openapi.problems_of(),
)
async def select(request: Request) -> Response:
    """Screws of the catalogue for a need, ranked: the document of ``ballscrew select --json``.

    As a job it may take longer than a request that is waited for, tells how far it is, and shows candidates meanwhile.
    """
    body: NeedOfTable = await read(request, NeedBody)
    options = option_values.read(SelectOptions, dict(body))

    def work(done: Deadline) -> Response:
        refuse_paths(body.need)
        need = limits.check_need(need_of(body.need))
        with written({} if body.table is None else {"table": body.table}) as paths:
            found = selected(
                need,
                rows=paths.get("table"),
                words=options.words or None,
                keep_going=bool(paths),
                complete=options.complete,
                done=done,
                found_one=lambda one: done.row(as_bytes(selection_documents.row_document(one))),
            )
        return as_json(selection_documents.document(found))

    return await heavy(request, work)


@router.post(
    "/select/plan",
    openapi_extra=openapi.body(NeedBody),
    response_model=select_answers.Plan,
    responses=openapi.problems_of(),
)
async def select_plan(request: Request) -> Response:
    """What a selection would do: its candidates, its time, and the inputs without which checks are not judged."""
    body: NeedOfTable = await read(request, NeedBody)
    options = option_values.read(SelectOptions, dict(body))

    def work() -> Response:
        refuse_paths(body.need)
        need = limits.check_need(need_of(body.need))
        with written({} if body.table is None else {"table": body.table}) as paths:
            found = planned_selection(
                need, rows=paths.get("table"), words=options.words or None, keep_going=bool(paths)
            )
        return as_json(selection_documents.plan_document(found))

    if body.table is None:
        return await queue_of(request).quick(work)
    return await heavy(request, lambda _: work())  # a large table takes longer to be read


@router.post(
    "/axis",
    openapi_extra=openapi.body(AxisBody),
    response_model=response(ChainResults, "Chain", beside=answer_parts.Assumed),
    responses=openapi.problems_of(),
)
async def axis(request: Request) -> Response:
    """What gives way between motor and table: the document of ``ballscrew axis --json``."""
    body: MovingBody = await read(request, AxisBody)
    options = option_values.read(AxisOptions, dict(body))

    def work(_: Deadline) -> Response:
        moves = "motion" in body.case and "axis" in body.case
        report = chains.chain_of(case_of(body.case, moves=moves), options.at)
        return with_sheet(axis_documents.document(report), axis_sheet(report))

    return await heavy(request, work)


@router.get("/catalogue", response_model=catalogue_answers.Catalogue, responses=openapi.problems_of())
async def catalogue(
    words: Annotated[str, Query(description="all of them must be in a row")] = "",
) -> Response:
    """Rows of the catalogue with these words: the document of ``ballscrew catalogue list --json``."""
    return as_json(rows.list_document(rows.chosen(shipped(), words)))


@router.get("/catalogue/{name}", response_model=catalogue_answers.Row, responses=openapi.problems_of(404))
async def row(name: openapi.RowName) -> Response:
    """One row: the document of ``ballscrew catalogue show --json``, and the case that ``--case`` writes, as tables."""
    try:
        found = rows.named(shipped(), name)
    except InputError as error:
        raise Refused(404, *error.faults) from None
    return as_json({**rows.show_document(found), "case": tomlkit.parse(rows.case_text(found)).unwrap()})


@router.get("/validate", response_model=list[validate_answers.ValidationEntry], responses=openapi.problems_of())
async def validate(
    request: Request,
    set: Annotated[str, Query(json_schema_extra={"enum": ["", *validation.SETS]}, description="one set alone")] = "",
) -> Response:
    """The model against data of vendors and laboratories: the document of ``ballscrew validate --json``."""
    requested = validation.request([set] if set else [])
    return await heavy(request, lambda _: sent(_validated(tuple(data.name for data in requested.sets))))


@functools.cache
def _validation(names: tuple[str, ...]) -> bytes:
    """The document of some sets; their data are shipped, so it is computed once."""
    found = validation.evaluate(validation.request(names))
    return as_bytes(validation_documents.documents([entry for entries, _ in found for entry in entries]))


def _validated(names: tuple[str, ...]) -> bytes:
    """The document of some sets; a second request waits for the first one and finds it computed."""
    with _VALIDATION_LOCK:
        return _validation(names)


@router.get("/schema", response_model=schema_answer.CaseSchema, responses=openapi.problems_of())
async def schema(request: Request) -> Response:
    """JSON Schema of a case file, as ``ballscrew schema`` prints it."""
    return kept(request, _schema())


@functools.cache
def _schema() -> bytes:
    return as_bytes(json_schema())


@router.get("/need-schema", response_model=schema_answer.NeedSchema, responses=openapi.problems_of())
async def need_schema(request: Request) -> Response:
    """JSON Schema of a need, as ``ballscrew schema --need`` prints it."""
    return kept(request, _need_schema())


@functools.cache
def _need_schema() -> bytes:
    return as_bytes(schema_of_needs())


@router.get("/vocabulary", response_model=vocabulary.Vocabulary, responses=openapi.problems_of())
async def get_vocabulary(request: Request) -> Response:
    """Units and their factors, results and mechanisms by name, models, and cases to start from."""
    return kept(request, _vocabulary())


@functools.cache
def _vocabulary() -> bytes:
    return as_bytes(vocabulary.vocabulary())


@router.post("/drawing", openapi_extra=openapi.body(CaseBody), responses=openapi.text("image/svg+xml"))
async def drawing(request: Request) -> Response:
    """The ball between its grooves and the slip in its contact, to scale, as SVG."""
    from ballscrew.faces.report.drawing import drawing as drawn

    return await of_body(request, lambda found: Response(drawn(found), media_type="image/svg+xml"))


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
        from ballscrew.faces.report.files import Kind, report_bytes  # slow to import

        case, *beside = map(case_of, (body.case, *body.beside))
        written: Kind = "pdf" if kind == "pdf" else "html"
        # none has more samples than the largest of them may have
        fewest = [count for each in (case, *beside) if (count := limits.samples_of(each, options.samples)) is not None]
        found = report_bytes(case, written, done, min(fewest) if fewest else None, heading, beside)
        return Response(found, media_type=KINDS[kind])

    # not kept: it may have the date of today
    return await cancellable(request, queue_of(request).heavy(memory.releasing(work)))
