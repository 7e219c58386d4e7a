"""The JSON API: each address does what the command of that name does, and says the same."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Callable, Mapping
from typing import Any

import tomlkit
import xarray as xr
from fastapi import APIRouter, Request
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
from ballscrew.interfaces.web import openapi, vocabulary
from ballscrew.interfaces.web.bodies import BandBody, CaseBody, SweepBody, case_of, read
from ballscrew.interfaces.web.problems import Refused
from ballscrew.interfaces.web.work import Deadline, Desk

#: Points of a sweep, and values that it returns; a whole nut takes a hundred times as long as a ball.
MOST_POINTS, MOST_POINTS_OF_NUT, MOST_RETURNED = 20_000, 2_000, 200_000
#: Samples of a band.
MOST_SAMPLES, MOST_SAMPLES_OF_NUT = 65_536, 1_024
#: A report is computed with fewer points of everything, but its pictures take their time.
KINDS: Mapping[str, str] = {"pdf": "application/pdf", "html": "text/html; charset=utf-8"}

router = APIRouter(prefix="/api/v1")


def _json(document: Any) -> Response:
    """A document without numbers that JSON cannot say."""
    text = json.dumps(plain(document), ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Response(text, media_type="application/json")


def _desk(request: Request) -> Desk:
    desk: Desk = request.app.state.desk
    return desk


async def _of_case(request: Request, work: Callable[[config.Case], Any]) -> Any:
    body: CaseBody = await read(request, CaseBody)
    return await _desk(request).quick(lambda: work(case_of(body.case)))


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
    raise_if_any(_too_many(body.vary, 1, MOST_POINTS))

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        of_file = {} if body.vary else case.sweep
        most = MOST_POINTS if case.parts is None else MOST_POINTS_OF_NUT
        raise_if_any(_too_many(body.vary or of_file, len(body.outputs), most))
        plan = export.plan(case, [f"{name}={text}" for name, text in body.vary.items()], body.outputs, None)
        return _json(_swept(case, plan, export.evaluate(case, plan, done)))

    return await _desk(request).heavy(work)


def _too_many(vary: Mapping[str, str], outputs: int, most: int) -> list[Fault]:
    """What is too large of a sweep, before its axes are made."""
    points = math.prod(map(export.length_of, vary.values()))
    faults: list[Fault] = []
    if points > most:
        faults.append(Fault("sweep", "too many points", f"{points:,}", f"{most:,} at most here; the rest by ballscrew"))
    elif points * outputs > MOST_RETURNED:
        faults.append(Fault("sweep", "too many values", f"{points * outputs:,}", f"{MOST_RETURNED:,} at most here"))
    return faults


def _swept(case: config.Case, plan: export.Plan, dataset: xr.Dataset) -> dict[str, Any]:
    def table(name: str, values: Any) -> dict[str, Any]:
        quantity = plan.quantities[name]
        return {"values": values, "unit": quantity.unit, "meaning": quantity.info.meaning}

    return {
        "axes": {name: table(name, values) for name, values in plan.axes.items()},
        "outputs": {name: table(name, dataset[name].to_numpy()) for name in plan.columns},
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }


@router.post("/compare", openapi_extra=openapi.body(CaseBody), responses=openapi.answers("Object"))
async def compare(request: Request) -> Response:
    """All models and all laws side by side: what ``ballscrew compare --json`` prints."""
    body: CaseBody = await read(request, CaseBody)

    def work(_: Deadline) -> Response:
        case = case_of(body.case)
        return _json(comparison.document(case, comparison.compared(case)))

    return await _desk(request).heavy(work)


@router.post("/band", openapi_extra=openapi.body(BandBody), responses=openapi.answers("Object"))
async def band(request: Request) -> Response:
    """The band of a case and its causes: what ``ballscrew run --band --json`` prints, and the words beside it."""
    body: BandBody = await read(request, BandBody)

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        most = MOST_SAMPLES if case.parts is None else MOST_SAMPLES_OF_NUT
        if body.samples is not None and body.samples > most:
            raise InputError(Fault("--samples", "too many", str(body.samples), f"{most:,} at most here"))
        found = bands.computed(case, bands.Options(body.samples, body.level, body.only_given), done)
        words = {"sentences": bands.sentences(case, found), "inputs": bands.assumed_in_words(found)}
        return _json({**bands.document(answer(case), found), "words": words})

    return await _desk(request).heavy(work)


@router.get("/catalogue", responses=openapi.answers("Object"))
async def catalogue(words: str = "") -> Response:
    """Rows of the catalogue with these words: what ``ballscrew catalogue list --json`` prints."""
    return _json(rows.list_document(rows.chosen(shipped(), words)))


@router.get("/catalogue/{name}", responses=openapi.answers("Object", 404))
async def row(name: str) -> Response:
    """One row: what ``ballscrew catalogue show --json`` prints, and the case that ``--case`` writes, as tables."""
    try:
        found = rows.named(shipped(), name)
    except InputError as error:
        raise Refused(404, *error.faults) from None
    return _json({**rows.show_document(found), "case": tomlkit.parse(rows.case_text(found)).unwrap()})


@router.get("/validate", responses=openapi.answers("List"))
async def validate(request: Request, set: str = "") -> Response:
    """The model against what vendors and laboratories state: what ``ballscrew validate --json`` prints."""
    if set and set not in validation.SETS:
        raise InputError(Fault("validate", "unknown set", set, nearest(set, validation.SETS)))
    return await _desk(request).heavy(lambda _: _validated(set))


@functools.lru_cache
def _validated(name: str) -> Response:
    """The rows are shipped and do not change: computed once."""
    found = validation.evaluate(validation.request([name] if name else []))
    return _json(validation.documents([entry for entries, _ in found for entry in entries]))


@router.get("/schema", responses=openapi.answers("Object"))
async def schema() -> Response:
    """JSON Schema of a case file: what ``ballscrew schema`` prints."""
    return _json(json_schema())


@router.get("/vocabulary", responses=openapi.answers("Object"))
async def words() -> Response:
    """Units and their factors, results and mechanisms by name, models, and cases to start from."""
    return _json(vocabulary.vocabulary())


@router.post("/toml", openapi_extra=openapi.body(CaseBody), responses=openapi.text("application/toml"))
async def toml(request: Request) -> Response:
    """The case as a file, ready for ``ballscrew run``."""
    body: CaseBody = await read(request, CaseBody)
    case_of(body.case)
    return Response(tomlkit.dumps(_without_nothing(body.case)), media_type="application/toml")


def _without_nothing(tables: Any) -> Any:
    """Tables without nulls, which TOML does not have."""
    if isinstance(tables, dict):
        return {name: _without_nothing(value) for name, value in tables.items() if value is not None}
    return tables


@router.post("/drawing", openapi_extra=openapi.body(CaseBody), responses=openapi.text("image/svg+xml"))
async def drawing(request: Request) -> Response:
    """The ball between its grooves and the slip in its contact, to scale, as SVG."""
    from ballscrew.interfaces.drawing import drawing as drawn

    return await _of_case(request, lambda case: Response(drawn(answer(case)), media_type="image/svg+xml"))


@router.post("/report", openapi_extra=openapi.body(CaseBody), responses=openapi.text(*KINDS.values()))
async def report(request: Request, kind: str = "pdf") -> Response:
    """The report of a case to file, ``kind`` pdf or html: what ``ballscrew report`` writes."""
    from ballscrew.interfaces.report_content import report_bytes  # with its pictures: only for those who ask

    body: CaseBody = await read(request, CaseBody)
    if kind not in KINDS:
        raise InputError(Fault("report.kind", "unknown kind of file", kind, nearest(kind, KINDS)))

    def work(done: Deadline) -> Response:
        return Response(report_bytes(case_of(body.case), kind, done), media_type=KINDS[kind])

    return await _desk(request).heavy(work)
