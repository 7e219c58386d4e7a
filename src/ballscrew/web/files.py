"""Files of the page and of the libraries that it needs, from where they are installed."""

from __future__ import annotations

import functools
import hashlib
import importlib.util
from collections.abc import Mapping
from importlib import resources
from pathlib import Path

from fastapi import FastAPI, Request
from starlette.responses import Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles

from ballscrew.web.plotly_js import eager

#: Browsers keep files, and ask each time whether they have changed.
_CACHE = "no-cache"
_PAGES: Mapping[str, str] = {"/": "index.html", "/api": "api.html"}


class _Folder(StaticFiles):
    """Files of a folder, with their header for caches."""

    def file_response(self, *args: object, **options: object) -> Response:
        """The file, or status 304 where the browser has it."""
        found = super().file_response(*args, **options)  # type: ignore[arg-type]  (passed on as they come)
        found.headers["Cache-Control"] = _CACHE
        return found


def add_to(app: FastAPI) -> None:
    """Add the addresses of all files."""
    page = _Folder(directory=Path(str(resources.files("ballscrew.web").joinpath("page"))))
    viewer = _Folder(directory=_folder_of("fastapi_offline", "static"))
    app.mount("/page", page)
    app.mount("/viewer", viewer)

    async def send_page(request: Request) -> Response:
        return await page.get_response(_PAGES[request.url.path], request.scope)

    for address in _PAGES:
        app.add_api_route(address, send_page, methods=["GET", "HEAD"], include_in_schema=False)

    script, tag = _plotly()

    async def send_plotly(request: Request) -> Response:
        found = Response(script, headers={"ETag": tag, "Cache-Control": _CACHE}, media_type="text/javascript")
        unchanged = viewer.is_not_modified(found.headers, request.headers)
        return NotModifiedResponse(found.headers) if unchanged else found

    app.add_api_route("/plotly.js", send_plotly, methods=["GET", "HEAD"], include_in_schema=False)


def plotly_path() -> Path:
    """The installed plotly.js."""
    return _folder_of("plotly", "package_data") / "plotly.min.js"


@functools.cache
def _plotly() -> tuple[bytes, str]:
    """The script as it is sent, and its tag."""
    content = eager(plotly_path().read_text(encoding="utf-8")).encode()
    return content, f'"{hashlib.sha256(content).hexdigest()[:32]}"'


def _folder_of(package: str, folder: str) -> Path:
    """A folder of an installed package, without importing it."""
    found = importlib.util.find_spec(package)
    assert found is not None, package
    assert found.origin is not None, package
    return Path(found.origin).parent / folder
