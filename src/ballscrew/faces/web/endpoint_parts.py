"""Parts that the addresses of the API share: how work is queued, cancelled, and answered."""

from __future__ import annotations

import asyncio
import functools
import gzip
import inspect
import json
import math
from collections.abc import Callable, Coroutine, Mapping
from typing import Any, TypeVar

from fastapi import APIRouter, Request
from fastapi.routing import APIRoute
from starlette.datastructures import Headers
from starlette.responses import Response

from ballscrew.basis.errors import Fault, nearest, raise_if_any
from ballscrew.basis.output import sheet as sheets
from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import Sheet
from ballscrew.cases.case_files.case import Case
from ballscrew.faces.web import documents, limits, openapi
from ballscrew.faces.web.bodies import Body, case_of, read
from ballscrew.faces.web.documents import KeptAnswers, Question
from ballscrew.faces.web.jobs import API, Jobs
from ballscrew.faces.web.problems import Refused
from ballscrew.faces.web.request_queue import Deadline, RequestQueue, out_of_time
from ballscrew.questions.run import compute

Answer = TypeVar("Answer")
_JSON = "application/json"


def own_site(request: Request) -> None:
    """Refuse requests that a browser sends for a page of another site: it could not read the answer, only cause work.

    Browsers say so by themselves, and no page can change it, but only to https and to localhost: over plain http from
    another machine, which ``--host`` allows, nothing is said and nothing is refused. Other programs do not say it.
    """
    site = request.headers.get("sec-fetch-site", "none").lower()
    if site not in ("none", "same-origin"):
        raise Refused(403, Fault("Sec-Fetch-Site", "is not this server's", site[:40], "ask from its own page"))


def known_query(request: Request) -> None:
    """Refuse query parameters that are unknown to the address or repeated."""
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


def as_bytes(document: Any) -> bytes:
    """A document as JSON, with null for numbers that are not finite."""
    return json.dumps(plain(document), ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()


def as_json(document: Any) -> Response:
    """An answer with a document."""
    return sent(as_bytes(document))


def with_sheet(document: Mapping[str, Any], sheet: Sheet) -> Response:
    """An answer with a document, and the sheet that people read."""
    return as_json({**document, "sheet": sheets.document(sheet)})


def sent(document: bytes) -> Response:
    """An answer with a document that is JSON already."""
    return Response(document, media_type=_JSON)


def kept(request: Request, document: bytes) -> Response:
    """An answer with a document that is JSON already and always the same; compressed, where the client takes that."""
    packed = takes_gzip(request.headers)
    response = sent(_packed(document) if packed else document)
    response.headers["Vary"] = "Accept-Encoding"
    if packed:
        response.headers["Content-Encoding"] = "gzip"
    return response


@functools.lru_cache(maxsize=16)
def _packed(document: bytes) -> bytes:
    return gzip.compress(document, 9, mtime=0)


def takes_gzip(headers: Headers) -> bool:
    """Test whether a client takes compressed answers; those that weigh them are browsers, which all do."""
    accepted = [one.partition(";") for one in headers.get("accept-encoding", "").lower().split(",")]
    return any(name.strip() == "gzip" and weight.replace(" ", "") != "q=0" for name, _, weight in accepted)


def queue_of(request: Request) -> RequestQueue:
    """The queue of requests of the application."""
    queue: RequestQueue = request.app.state.requests
    return queue


def always(_: object) -> bool:
    """True of any body."""
    return True


def post(
    router: APIRouter,
    path: str,
    kind: type[Body],
    model: Any = None,
    *,
    name: str = "",
    description: str | None = None,
    responses: Mapping[int | str, dict[str, Any]] | None = None,
    is_quick: Callable[[Any], bool] = lambda _: False,
) -> Callable[[Callable[[Any, Deadline], Response]], Callable[[Any, Deadline], Response]]:
    """A decorator for the work of an address: it gets the body, and answers.

    Its name and its description are those of the work, unless they are given. It is heavy work, unless the body is one
    of which ``is_quick`` is true.
    """

    def add(work: Callable[[Any, Deadline], Response]) -> Callable[[Any, Deadline], Response]:
        async def answer(request: Request) -> Response:
            body = await read(request, kind)
            if is_quick(body):
                return await queue_of(request).quick(lambda: work(body, Deadline(math.inf)))
            return await heavy(request, lambda done: work(body, done))

        router.add_api_route(
            path,
            answer,
            methods=["POST"],
            name=name or work.__name__,
            description=description or inspect.getdoc(work),
            response_model=model,
            responses={**(openapi.problems_of() if responses is None else responses)},
            openapi_extra=openapi.body(kind),
        )
        return work

    return add


async def heavy(request: Request, work: Callable[[Deadline], Any]) -> Any:
    """Heavy work, cancelled when the client disconnects; its answer is kept."""
    return await computed_once(request, lambda: processed(request, work))


async def processed(request: Request, work: Callable[[Deadline], Any]) -> Any:
    """Heavy work: in a process of its own, which answers the request as a whole, where there is a guard.

    The process itself has none: it works in a thread.
    """
    guard: Jobs | None = request.app.state.guard
    if guard is None:
        return await queue_of(request).heavy(work if request.app.state.ends_with_work else limits.releasing(work))
    address = request.url.path.removeprefix(API)
    answer = await guard.answer(address, request.url.query, request.state.body)
    return Response(answer.body, answer.status, media_type=answer.media_type)


async def computed_once(request: Request, work: Callable[[], Coroutine[Any, Any, Any]]) -> Any:
    """The answer to a body, cancelled when the client disconnects; where it was asked for before, the one kept."""
    digest: bytes | None = getattr(request.state, "digest", None)
    if digest is None:
        return await cancellable(request, work())
    answers: KeptAnswers = request.app.state.answers
    question = Question(f"{request.url.path}?{request.url.query}", digest)
    known = answers.find(question)
    if known is not None:
        return sent(known)
    response: Response = await cancellable(request, work())
    if response.media_type == _JSON:
        answers.keep(question, bytes(response.body))
    return response


async def cancellable(request: Request, work: Coroutine[Any, Any, Any]) -> Any:
    """Work, cancelled when the client disconnects: the page cancels its requests at the next key."""
    task = asyncio.ensure_future(work)
    disconnected = asyncio.ensure_future(_disconnected(request))
    try:
        await asyncio.wait((task, disconnected), return_when=asyncio.FIRST_COMPLETED)
        if not task.done():
            raise Refused(400, Fault("request", "was interrupted"))  # no client is left to read it
        return task.result()
    finally:
        task.cancel()
        disconnected.cancel()


async def _disconnected(request: Request) -> None:
    """Wait until the client disconnects; the body has been read."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


async def of_run(request: Request, tables: Mapping[str, Any], work: Callable[[compute.Run], Response]) -> Response:
    """Work on the run of a case, cancelled when the client disconnects; that of many balls is done as heavy work."""

    async def answer() -> Response:
        case, answers = await _quick(queue_of(request), tables, work)
        return answers[0] if answers else await processed(request, lambda _: work(documents.run_of(case, tables)))

    return await cancellable(request, answer())


async def of_tables(requests: RequestQueue, tables: Mapping[str, Any], work: Callable[[compute.Run], Answer]) -> Answer:
    """Work on the run of a case in a thread, which is refused where it takes longer than that may be blocked."""
    case, answers = await _quick(requests, tables, work)
    if answers:
        return answers[0]
    if limits.has_long_motion(case):
        raise out_of_time(requests.time_limit)
    return await requests.heavy(limits.releasing(lambda _: work(documents.run_of(case, tables))))


async def _quick(
    requests: RequestQueue, tables: Mapping[str, Any], work: Callable[[compute.Run], Answer]
) -> tuple[Case, tuple[Answer, ...]]:
    """A case and the answer to quick work on its run; none where many balls are computed one by one."""

    def answer() -> tuple[Case, tuple[Answer, ...]]:
        case = case_of(tables)
        is_heavy = limits.balls_of(case) > limits.MANY_BALLS or limits.has_long_motion(case)
        return case, () if is_heavy else (work(documents.run_of(case, tables)),)

    return await requests.quick(answer)
