"""The JSON API: each address does what the command of that name does, and says the same."""

from __future__ import annotations

import asyncio
import functools
import json
import threading
from collections.abc import Callable, Mapping
from typing import Annotated, Any

import tomlkit
import xarray as xr
from fastapi import APIRouter, Depends, Query, Request
from fastapi.routing import APIRoute
from starlette.responses import Response

from ballscrew import __version__
from ballscrew.components.catalogue import catalogue as shipped
from ballscrew.faults import Fault, InputError, nearest, raise_if_any
from ballscrew.interfaces import band as bands
from ballscrew.interfaces import catalogue as rows
from ballscrew.interfaces import comparison, config, export, validation
from ballscrew.interfaces.answer import Answer, answer
from ballscrew.interfaces.documents import plain
from ballscrew.interfaces.schema import json_schema
from ballscrew.interfaces.web import limits, openapi, vocabulary
from ballscrew.interfaces.web.bodies import BandBody, CaseBody, SweepBody, case_of, read
from ballscrew.interfaces.web.problems import Refused
from ballscrew.interfaces.web.work import Deadline, Desk

#: The files that a report can be, by what ``kind`` calls them.
KINDS: Mapping[str, str] = {"pdf": "application/pdf", "html": "text/html; charset=utf-8"}


def _known_query(request: Request) -> None:
    """Refuse words behind the ``?`` that the address does not know; nothing is left out in silence."""
    route = request.scope["route"]
    assert isinstance(route, APIRoute)
    known = [field.alias for field in route.dependant.query_params]
    given = list(request.query_params.multi_items())
    twice = sorted({name for name, _ in given if len(request.query_params.getlist(name)) > 1})
    raise_if_any(
        [
            Fault(f"?{n}", "unknown", "", nearest(n, known) if known else "")
            for n in request.query_params
            if n not in known
        ]
        + [Fault(f"?{name}", "is given twice", "", "give it once") for name in twice if name in known]
    )


_ONE_VALIDATES = threading.Lock()
router = APIRouter(prefix="/api/v1", dependencies=[Depends(_known_query)])


def _bytes(document: Any) -> bytes:
    """A document as JSON, without numbers that JSON cannot say."""
    return json.dumps(plain(document), ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()


def _json(document: Any) -> Response:
    return _sent(_bytes(document))


def _sent(document: bytes) -> Response:
    return Response(document, media_type="application/json")


def _desk(request: Request) -> Desk:
    desk: Desk = request.app.state.desk
    return desk


async def _heavy(request: Request, work: Callable[[Deadline], Any]) -> Any:
    """Work at the desk, for as long as somebody waits for it: a page drops what was asked before the next key."""
    task = asyncio.ensure_future(_desk(request).heavy(work))
    left = asyncio.ensure_future(_left(request))
    try:
        await asyncio.wait((task, left), return_when=asyncio.FIRST_COMPLETED)
        if not task.done():
            raise Refused(400, Fault("request", "broke off"))  # read by nobody
        return task.result()
    finally:
        task.cancel()
        left.cancel()


async def _left(request: Request) -> None:
    """Comes to its end when the connection does; the body has been read."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


async def _of_case(request: Request, work: Callable[[config.Case], Any]) -> Any:
    """Quick work, but where very many balls are computed one by one."""
    body: CaseBody = await read(request, CaseBody)
    desk = _desk(request)
    case = await desk.quick(lambda: case_of(body.case))
    if limits.balls_of(case) > limits.MANY_BALLS:
        return await _heavy(request, lambda _: work(case))
    return await desk.quick(lambda: work(case))


@router.post("/run", openapi_extra=openapi.body(CaseBody), responses=openapi.answers("Run"))
async def run(request: Request) -> Response:
    """Friction at the operating point of a case: what ``ballscrew run --json`` prints, and the words beside it."""

    def work(case: config.Case) -> Response:
        found = answer(case)
        return _json({**found.document, "words": _words(found)})

    return await _of_case(request, work)


def _words(found: Answer) -> dict[str, Any]:
    return {"title": found.title, "verdicts": found.verdicts, "assumed": found.assumed}


@router.post("/sweep", openapi_extra=openapi.body(SweepBody), responses=openapi.answers("Sweep"))
async def sweep(request: Request) -> Response:
    """Friction over ranges of load, speed or anything else, as ``ballscrew sweep`` computes it."""
    body: SweepBody = await read(request, SweepBody)
    limits.check_size(body.vary, len(body.outputs))

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        if not body.vary:
            limits.check_size(case.sweep, len(body.outputs))
        plan = export.plan(case, [f"{name}={text}" for name, text in body.vary.items()], body.outputs, None)
        limits.check_sweep(case, plan)
        return _json(_swept(case, plan, export.evaluate(case, plan, done)))

    return await _heavy(request, work)


def _swept(case: config.Case, plan: export.Plan, dataset: xr.Dataset) -> dict[str, Any]:
    def table(name: str, values: Any) -> dict[str, Any]:
        quantity = plan.quantities[name]
        return {"values": values, "unit": quantity.unit, "meaning": quantity.info.meaning}

    return {
        "axes": {name: table(name, values) for name, values in plan.axes.items()},
        "outputs": {name: table(name, dataset[name].to_numpy()) for name in plan.columns},
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }


@router.post("/compare", openapi_extra=openapi.body(CaseBody), responses=openapi.answers("Compare"))
async def compare(request: Request) -> Response:
    """All models and all laws side by side: what ``ballscrew compare --json`` prints."""
    body: CaseBody = await read(request, CaseBody)

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        return _json(comparison.document(case, comparison.compared(case, done)))

    return await _heavy(request, work)


@router.post("/band", openapi_extra=openapi.body(BandBody), responses=openapi.answers("Band"))
async def band(request: Request) -> Response:
    """The band of a case and its causes: what ``ballscrew run --band --json`` prints, and the words beside it."""
    body: BandBody = await read(request, BandBody)

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        samples = limits.samples_of(case, body.samples)
        found = bands.computed(case, bands.Options(samples, body.level, body.only_given), done)
        words = {"sentences": bands.sentences(case, found), "inputs": bands.assumed_in_words(found)}
        return _json({**bands.document(answer(case), found), "words": words})

    return await _heavy(request, work)


@router.get("/catalogue", responses=openapi.answers("Catalogue"))
async def catalogue(
    words: Annotated[str, Query(description="all of them must be in a row")] = "",
) -> Response:
    """Rows of the catalogue with these words: what ``ballscrew catalogue list --json`` prints."""
    return _json(rows.list_document(rows.chosen(shipped(), words)))


@router.get("/catalogue/{name}", responses=openapi.answers("Row", 404))
async def row(name: openapi.RowName) -> Response:
    """One row: what ``ballscrew catalogue show --json`` prints, and the case that ``--case`` writes, as tables."""
    try:
        found = rows.named(shipped(), name)
    except InputError as error:
        raise Refused(404, *error.faults) from None
    return _json({**rows.show_document(found), "case": tomlkit.parse(rows.case_text(found)).unwrap()})


@router.get("/validate", responses=openapi.answers("Validation"))
async def validate(
    request: Request,
    set: Annotated[str, Query(json_schema_extra={"enum": ["", *validation.SETS]}, description="one set alone")] = "",
) -> Response:
    """The model against what vendors and laboratories state: what ``ballscrew validate --json`` prints."""
    asked = validation.request([set] if set else [])
    return await _heavy(request, lambda _: _sent(_validated(tuple(data.name for data in asked.sets))))


@functools.cache
def _kept(names: tuple[str, ...]) -> bytes:
    """The rows are shipped and do not change: computed once for each of the sets."""
    found = validation.evaluate(validation.request(names))
    return _bytes(validation.documents([entry for entries, _ in found for entry in entries]))


def _validated(names: tuple[str, ...]) -> bytes:
    """One at a time: those who come meanwhile find it computed."""
    with _ONE_VALIDATES:
        return _kept(names)


@router.get("/schema", responses=openapi.answers("Schema"))
async def schema() -> Response:
    """JSON Schema of a case file: what ``ballscrew schema`` prints."""
    return _sent(_schema())


@functools.cache
def _schema() -> bytes:
    return _bytes(json_schema())


@router.get("/vocabulary", responses=openapi.answers("Vocabulary"))
async def words() -> Response:
    """Units and their factors, results and mechanisms by name, models, and cases to start from."""
    return _sent(_vocabulary())


@functools.cache
def _vocabulary() -> bytes:
    return _bytes(vocabulary.vocabulary())


@router.post("/toml", openapi_extra=openapi.body(CaseBody), responses=openapi.text("application/toml"))
async def toml(request: Request) -> Response:
    """The case as a file, ready for ``ballscrew run``."""
    body: CaseBody = await read(request, CaseBody)
    await _desk(request).quick(lambda: case_of(body.case))
    return Response(tomlkit.dumps(body.case), media_type="application/toml")


@router.post("/drawing", openapi_extra=openapi.body(CaseBody), responses=openapi.text("image/svg+xml"))
async def drawing(request: Request) -> Response:
    """The ball between its grooves and the slip in its contact, to scale, as SVG."""
    from ballscrew.interfaces.drawing import drawing as drawn

    return await _of_case(request, lambda case: Response(drawn(answer(case)), media_type="image/svg+xml"))


@router.post("/report", openapi_extra=openapi.body(CaseBody), responses=openapi.text(*KINDS.values()))
async def report(
    request: Request,
    kind: Annotated[str, Query(json_schema_extra={"enum": [*KINDS]}, description="the file that it is to be")] = "pdf",
) -> Response:
    """The report of a case to file: what ``ballscrew report`` writes."""
    body: CaseBody = await read(request, CaseBody)
    if kind not in KINDS:
        raise InputError(Fault("?kind", "unknown kind of file", kind, nearest(kind, KINDS)))

    def work(done: Deadline) -> Response:
        from ballscrew.interfaces.report_content import report_bytes  # with its writers: only for those who ask

        case = case_of(body.case)
        found = report_bytes(case, "pdf" if kind == "pdf" else "html", done, samples=limits.samples_of(case))
        return Response(found, media_type=KINDS[kind])

    return await _heavy(request, work)
