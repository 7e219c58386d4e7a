"""The server: the API, the page, and what goes round them."""

from __future__ import annotations

import functools
import importlib.util
import json
import re
from collections.abc import Awaitable, Callable, Mapping, Sequence
from importlib import resources
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.openapi.utils import get_openapi
from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.responses import FileResponse, Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ballscrew import __version__
from ballscrew.faults import Fault, InputError
from ballscrew.interfaces.answer import answer
from ballscrew.interfaces.web import api, openapi, plotly_js, problems, vocabulary
from ballscrew.interfaces.web.bodies import case_of
from ballscrew.interfaces.web.policy import policy
from ballscrew.interfaces.web.problems import Refused
from ballscrew.interfaces.web.work import Desk

#: Where the server may be asked at, unless told otherwise: names of the machine it runs on.
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
#: What every answer is sent with, besides the policy.
HEADERS: Mapping[str, str] = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}
#: Answers are kept by nobody; files are asked for again each time, and sent only if they have changed.
_ANSWER, _FILE = "no-store", "no-cache"
_PAGE = resources.files("ballscrew.interfaces.web").joinpath("page")
_PORT = re.compile(r":\d*$")


class _Application(FastAPI):
    """The routes, and round all of them what every answer goes through, also that of a defect."""

    #: The names it answers to, and what each answer is sent with.
    hosts: Sequence[str] = LOOPBACK
    headers: Mapping[str, str] = HEADERS

    def build_middleware_stack(self) -> ASGIApp:
        """What is called for each request."""
        return _Guard(super().build_middleware_stack(), self.hosts, self.headers)


class _Guard:
    """Answers under our own names only (no other site can pose as us), and sends what keeps a browser strict."""

    def __init__(self, inner: ASGIApp, hosts: Sequence[str], headers: Mapping[str, str]) -> None:
        self.inner = inner
        self.hosts = hosts
        self.headers = headers

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request."""

        async def strict(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers.update(self.headers)
                headers.setdefault("Cache-Control", _ANSWER)
            await send(message)

        if scope["type"] != "http":
            await self.inner(scope, receive, send)
            return
        host = Headers(scope=scope).get("host", "")
        if "*" in self.hosts or _PORT.sub("", host).lower() in self.hosts:
            await self.inner(scope, receive, strict)
        else:
            found = problems.response(421, [Fault("Host", "is not a name of this server", host[:80])])
            await found(scope, receive, strict)


def application(hosts: Sequence[str] = LOOPBACK, desk: Desk | None = None) -> FastAPI:
    """The application. ``hosts`` are the names it answers to, ``("*",)`` for any."""
    app = _Application(
        title="ballscrew", version=__version__, docs_url=None, redoc_url=None, openapi_url=None, redirect_slashes=False
    )
    plotly = _folder_of("plotly", "package_data") / "plotly.min.js"
    app.hosts, app.headers = hosts, {**HEADERS, "Content-Security-Policy": policy(plotly)}
    app.state.desk = desk or Desk()
    app.include_router(api.router)
    described = functools.cache(lambda: json.dumps(_openapi(app)).encode())

    async def own_description() -> Response:
        return Response(described(), media_type="application/json")

    app.add_api_route("/api/v1/openapi.json", own_description, include_in_schema=False)
    _files(app, plotly)
    app.add_exception_handler(Refused, _refused)
    app.add_exception_handler(InputError, _at_fault)
    app.add_exception_handler(HTTPException, _not_found)
    app.add_exception_handler(Exception, _defect)
    return app


class _Folder(StaticFiles):
    """Files of a folder."""

    def file_response(self, *args: object, **options: object) -> Response:
        """A file, or that it is the one that the browser has."""
        found = super().file_response(*args, **options)  # type: ignore[arg-type]  (passed on as they come)
        found.headers["Cache-Control"] = _FILE
        return found


def _files(app: FastAPI, plotly: Path) -> None:
    """The page and the libraries that it needs, from where they are installed."""
    folders = {"/page": Path(str(_PAGE)), "/viewer": _folder_of("fastapi_offline", "static")}
    for address, folder in folders.items():
        app.mount(address, _Folder(directory=folder))
    pages = {"/": "index.html", "/api": "api.html"}
    for address, name in pages.items():
        app.add_api_route(address, _sender(Path(str(_PAGE)) / name), include_in_schema=False)
    app.add_api_route("/plotly.js", plotly_js.sender(plotly), include_in_schema=False)


def _sender(path: Path) -> Callable[[Request], Awaitable[Response]]:
    async def send(request: Request) -> Response:
        found = FileResponse(path, headers={"Cache-Control": _FILE}, stat_result=path.stat())
        known = [tag.strip().removeprefix("W/") for tag in request.headers.get("if-none-match", "").split(",")]
        return NotModifiedResponse(found.headers) if found.headers["etag"] in known else found

    return send


def _folder_of(package: str, folder: str) -> Path:
    """A folder of an installed package, without importing it."""
    found = importlib.util.find_spec(package)
    assert found is not None, package
    assert found.origin is not None, package
    return Path(found.origin).parent / folder


def _openapi(app: FastAPI) -> dict[str, object]:
    """What the API says of itself: made when it is first asked for."""
    described = get_openapi(
        title="ballscrew", version=__version__, routes=app.routes, summary="What a ball screw loses to friction"
    )
    described.setdefault("components", {})["schemas"] = dict(openapi.components())
    return described


async def _refused(_: Request, error: Exception) -> Response:
    assert isinstance(error, Refused)
    return problems.response(error.status, error.faults)


async def _at_fault(_: Request, error: Exception) -> Response:
    assert isinstance(error, InputError)
    return problems.response(422, error.faults)


async def _not_found(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    found = problems.response(error.status_code, [Fault(request.url.path, str(error.detail))])
    found.headers.update(error.headers or {})
    return found


async def _defect(_: Request, __: Exception) -> Response:
    """What is our fault is said to be so; the server writes where it was."""
    return problems.response(500, [Fault("server", "has a defect", "", "please report what you sent")])


def warm_up() -> None:
    """Load and compute what the first visitor would otherwise wait for."""
    start = vocabulary.vocabulary()["starts"]["paper"]["case"]
    answer(case_of(start))
