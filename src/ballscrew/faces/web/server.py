"""The server: the API, the page, and the problems that requests are refused with."""

from __future__ import annotations

import asyncio
import functools
import json
import math
from collections.abc import Iterator, Sequence

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.types import ASGIApp

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.version import __version__
from ballscrew.engine.evaluation import recordings
from ballscrew.faces.page import vocabulary
from ballscrew.faces.web import api, bodies, files, limits, openapi, problems, question_api
from ballscrew.faces.web.bodies import case_of
from ballscrew.faces.web.body_examples import examples
from ballscrew.faces.web.documents import KeptAnswers
from ballscrew.faces.web.job_process import MOST_MEMORY, Asked, answered
from ballscrew.faces.web.jobs import API, Jobs
from ballscrew.faces.web.limits import LOOPBACK, Guard
from ballscrew.faces.web.modules import Modules
from ballscrew.faces.web.problems import Refused
from ballscrew.faces.web.request_queue import Deadline, RequestQueue
from ballscrew.questions.records import AXIS, CONDITION, DUTY, SENSITIVITY, WARM_UP
from ballscrew.questions.run.compute import run


class _Application(FastAPI):
    """The routes, and around all of them the guard."""

    #: The names it answers to.
    hosts: Sequence[str] = LOOPBACK

    def build_middleware_stack(self) -> ASGIApp:
        """The middleware of FastAPI inside the guard: the response to a defect goes through it, too."""
        return Guard(super().build_middleware_stack(), self.hosts)


def application(
    hosts: Sequence[str] = LOOPBACK, requests: RequestQueue | None = None, jobs: Jobs | None = None
) -> FastAPI:
    """The application. ``hosts`` are the names it answers to, ``("*",)`` for any.

    With ``jobs``, which start its processes, heavy work is done in them; without, in threads.
    """
    app = _Application(
        title="ballscrew", version=__version__, docs_url=None, redoc_url=None, openapi_url=None, redirect_slashes=False
    )
    app.hosts = hosts
    app.state.requests = requests or RequestQueue()
    app.state.answers = KeptAnswers()
    app.state.modules = Modules()
    app.state.jobs = jobs or Jobs(app.state.requests.time_limit)
    app.state.guard, app.state.ends_with_work = jobs, False
    app.include_router(api.router)
    description = functools.cache(lambda: json.dumps(openapi.document(app)).encode())

    async def send_description() -> Response:
        return Response(description(), media_type="application/json")

    app.add_api_route("/api/v1/openapi.json", send_description, include_in_schema=False)
    files.add_to(app)
    app.add_exception_handler(Refused, _refused)
    app.add_exception_handler(InputError, _input_error)
    app.add_exception_handler(MemoryError, _no_memory)
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(Exception, _defect)
    return app


async def _refused(_: Request, error: Exception) -> Response:
    assert isinstance(error, Refused)
    return problems.response(error.status, error.faults)


async def _input_error(_: Request, error: Exception) -> Response:
    assert isinstance(error, InputError)
    return problems.response(422, error.faults)


async def _no_memory(request: Request, _: Exception) -> Response:
    given = f"{MOST_MEMORY >> 20:,} MiB"
    remedy = f"ask for less at a time, or use ballscrew {request.url.path.removeprefix(API)}"
    return problems.response(422, [Fault("server", "stopped the work, which took too much memory", given, remedy)])


async def _http_error(_: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    http_error = problems.response(error.status_code, [Fault("request", str(error.detail))])
    http_error.headers.update(error.headers or {})
    return http_error


async def _invalid(_: Request, error: Exception) -> Response:
    """Parts of an address that are no numbers, or too large."""
    assert isinstance(error, RequestValidationError)
    faults = [Fault(f"?{one['loc'][-1]}", str(one["msg"]), str(one["input"])[:40]) for one in error.errors()]
    return problems.response(422, faults)


async def _defect(_: Request, __: Exception) -> Response:
    """A problem without details; the server logs them."""
    return problems.response(500, [Fault("server", "has a defect", "", "please report your request")])


def in_process(app: FastAPI, requests: RequestQueue) -> FastAPI:
    """The application of a server in a fork of it, which does the work itself."""
    app.state.requests, app.state.guard, app.state.ends_with_work = requests, None, True
    return app


def rehearsal(app: FastAPI) -> Iterator[None]:
    """Heavy work of each kind on an example, step by step: who is forked afterwards finds it loaded and recorded."""
    nothing = Asked(f"{API}nothing", "", b"", math.inf, "")
    asyncio.run(answered(lambda _: app, nothing, lambda _: None))  # the first request sets up all addresses
    api.band(bodies.BandBody(**examples("BandBody")["paper"]), Deadline(math.inf))
    for question in (AXIS, DUTY, WARM_UP, SENSITIVITY, CONDITION):
        yield
        body = question_api.BODIES[question.name]
        question_api.answer(question, body(**examples(body.__name__)["paper"]), Deadline(math.inf))
    recordings.forget()
    limits.keep_loaded()


def warm_up() -> None:
    """Load and compute what the first request would otherwise wait for."""
    run(case_of(vocabulary.vocabulary()["starts"]["paper"]["case"]))
    limits.keep_loaded()
