"""Files of the page and of the libraries that it needs, from where they are installed."""

from __future__ import annotations

import functools
import hashlib
import importlib.util
from importlib import resources
from pathlib import Path
from typing import Any

from fastapi import FastAPI, Request
from starlette.responses import Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles

from ballscrew.web import languages
from ballscrew.web.plotly_js import eager

#: Browsers keep files, and ask each time whether they have changed.
_CACHE = "no-cache"
_VIEWER = "api.html"


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

    async def send_viewer(request: Request) -> Response:
        return await page.get_response(_VIEWER, request.scope)

    app.add_api_route("/api", send_viewer, methods=["GET", "HEAD"], include_in_schema=False)

    def sent(request: Request, content: bytes, tag: str, **options: Any) -> Response:
        found = Response(content, **options)
        found.headers.update({"ETag": tag, "Cache-Control": _CACHE})
        unchanged = viewer.is_not_modified(found.headers, request.headers)
        return NotModifiedResponse(found.headers) if unchanged else found

    async def send_page(request: Request) -> Response:
        chosen = request.cookies.get(languages.COOKIE)
        language = languages.language_of(chosen, request.headers.get("accept-language", ""))
        headers = {"Content-Language": language, "Vary": "Accept-Language, Cookie"}
        return sent(request, *_page(language), headers=headers, media_type="text/html")

    app.add_api_route("/", send_page, methods=["GET", "HEAD"], include_in_schema=False)
    script, tag = _plotly()

    async def send_plotly(request: Request) -> Response:
        return sent(request, script, tag, media_type="text/javascript")

    app.add_api_route("/plotly.js", send_plotly, methods=["GET", "HEAD"], include_in_schema=False)


def plotly_path() -> Path:
    """The installed plotly.js."""
    return _folder_of("plotly", "package_data") / "plotly.min.js"


@functools.cache
def _page(language: str) -> tuple[bytes, str]:
    """The page in a language as it is sent, and its tag."""
    text = resources.files("ballscrew.web").joinpath("page", "index.html").read_text(encoding="utf-8")
    return _tagged(languages.filled(text, language))


@functools.cache
def _plotly() -> tuple[bytes, str]:
    """The script as it is sent, and its tag."""
    return _tagged(eager(plotly_path().read_text(encoding="utf-8")))


def _tagged(text: str) -> tuple[bytes, str]:
    """A text as it is sent, and its tag for the caches of browsers."""
    content = text.encode()
    return content, f'"{hashlib.sha256(content).hexdigest()[:32]}"'


def _folder_of(package: str, folder: str) -> Path:
    """A folder of an installed package, without importing it."""
    found = importlib.util.find_spec(package)
    assert found is not None, package
    assert found.origin is not None, package
    return Path(found.origin).parent / folder
