"""The server: the API, the page, and what goes round them."""

from __future__ import annotations

import importlib.util
from collections.abc import Awaitable, Callable, Sequence
from importlib import resources
from pathlib import Path
from typing import Any

from fastapi import FastAPI, Request
from fastapi.openapi.utils import get_openapi
from starlette.exceptions import HTTPException
from starlette.responses import FileResponse, Response
from starlette.staticfiles import StaticFiles

from ballscrew import __version__
from ballscrew.faults import Fault, InputError
from ballscrew.interfaces.answer import answer
from ballscrew.interfaces.web import api, openapi, problems, vocabulary
from ballscrew.interfaces.web.bodies import case_of
from ballscrew.interfaces.web.policy import policy
from ballscrew.interfaces.web.problems import Refused
from ballscrew.interfaces.web.work import Desk

#: Where the server may be asked at, unless told otherwise: names of the machine it runs on.
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}
_PAGE = resources.files("ballscrew.interfaces.web").joinpath("page")


def application(hosts: Sequence[str] = LOOPBACK, desk: Desk | None = None) -> FastAPI:
    """The application. ``hosts`` are the names it answers to, ``("*",)`` for any."""
    app = FastAPI(title="ballscrew", version=__version__, docs_url=None, redoc_url=None, openapi_url=None)
    app.state.desk = desk or Desk()
    plotly = _folder_of("plotly", "package_data") / "plotly.min.js"
    headers = {**_HEADERS, "Content-Security-Policy": policy(plotly)}
    app.include_router(api.router)
    app.add_api_route("/api/v1/openapi.json", lambda: _openapi(app), include_in_schema=False)
    _files(app, plotly)
    app.add_exception_handler(Refused, _refused)
    app.add_exception_handler(InputError, _at_fault)
    app.add_exception_handler(HTTPException, _not_found)

    @app.middleware("http")
    async def guarded(request: Request, go_on: Callable[[Request], Awaitable[Response]]) -> Response:
        """Answer under our own names only (no other site can pose as us), and send what keeps a browser strict."""
        host = request.headers.get("host", "").rpartition(":")[0] or request.headers.get("host", "")
        if "*" not in hosts and host not in hosts:
            found = problems.response(421, [Fault("Host", "is not a name of this server", host[:80])])
        else:
            found = await go_on(request)
        found.headers.update(headers)
        return found

    return app


def _files(app: FastAPI, plotly: Path) -> None:
    """The page and the libraries that it needs, from where they are installed."""
    folders = {"/page": Path(str(_PAGE)), "/viewer": _folder_of("fastapi_offline", "static")}
    for address, folder in folders.items():
        app.mount(address, StaticFiles(directory=folder))
    pages = {"/": "index.html", "/api": "api.html"}
    for address, name in pages.items():
        app.add_api_route(address, _sender(Path(str(_PAGE)) / name), include_in_schema=False)
    app.add_api_route("/plotly.js", _sender(plotly), include_in_schema=False)


def _sender(path: Path) -> Callable[[], Awaitable[Response]]:
    async def send() -> Response:
        return FileResponse(path)

    return send


def _folder_of(package: str, folder: str) -> Path:
    """A folder of an installed package, without importing it."""
    found = importlib.util.find_spec(package)
    assert found is not None, package
    assert found.origin is not None, package
    return Path(found.origin).parent / folder


def _openapi(app: FastAPI) -> dict[str, Any]:
    if app.openapi_schema is None:
        described = get_openapi(
            title="ballscrew", version=__version__, routes=app.routes, summary="What a ball screw loses to friction"
        )
        described.setdefault("components", {}).setdefault("schemas", {}).update(openapi.components())
        app.openapi_schema = described
    return app.openapi_schema


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


def warm_up() -> None:
    """Load and compute what the first visitor would otherwise wait for."""
    start = vocabulary.vocabulary()["starts"]["paper"]["case"]
    answer(case_of(start))
