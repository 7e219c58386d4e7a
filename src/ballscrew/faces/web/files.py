"""Files of the page and of the libraries that it needs, from where they are installed; compressed once each."""

from __future__ import annotations

import functools
import gzip
import hashlib
import importlib.util
import os
from collections.abc import Mapping
from pathlib import Path

from fastapi import FastAPI, HTTPException, Request
from starlette.datastructures import Headers
from starlette.responses import Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles
from starlette.types import Scope

from ballscrew.faces.page import bundle, site
from ballscrew.faces.web.endpoint_parts import takes_gzip

#: Browsers keep files, and ask each time whether they have changed.
_CACHE = "no-cache"
#: They keep a file for good whose address has the digest of its content.
FOR_GOOD = "public, max-age=31536000, immutable"
#: What files are, by the ends of their names.
_MEDIA: Mapping[str, str] = {
    ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml",
    ".webmanifest": "application/manifest+json",
}  # fmt: skip
#: Files beside those of the page, by their names: the viewer of the API.
_OF_VIEWER: Mapping[str, str] = {"api": "api.html", "api.js": "api.js"}
#: Plain, compressed, and the tag for the caches of browsers.
_Sent = tuple[bytes, bytes, str]
#: Endings of files that are text, which is much shorter when it is compressed.
_TEXTS = (".js", ".css", ".html", ".svg", ".json")


class _Folder(StaticFiles):
    """Files of a folder, with their header for caches, and compressed where they are text."""

    def file_response(
        self, full_path: str | os.PathLike[str], stat_result: os.stat_result, scope: Scope, status_code: int = 200
    ) -> Response:
        """The file, or status 304 where the browser has it."""
        file_response = super().file_response(full_path, stat_result, scope, status_code)
        file_response.headers["Cache-Control"] = _CACHE
        is_text = str(full_path).endswith(_TEXTS)
        if is_text:
            file_response.headers["Vary"] = "Accept-Encoding"
        if not is_text or isinstance(file_response, NotModifiedResponse) or not takes_gzip(Headers(scope=scope)):
            return file_response
        headers = {name: file_response.headers[name] for name in ("etag", "last-modified", "cache-control", "vary")}
        packed = _packed_file(str(full_path), stat_result.st_mtime_ns)
        return Response(
            packed,
            status_code,
            {**headers, "Content-Encoding": "gzip", "ETag": f"W/{headers['etag']}"},
            media_type=file_response.media_type,
        )


def add_to(app: FastAPI) -> None:
    """Add the addresses of all files."""
    viewer = _Folder(directory=_folder_of("fastapi_offline", "static"))
    app.mount("/viewer", viewer)

    def sent(
        request: Request, content: bytes, packed: bytes, tag: str, headers: dict[str, str], media: str
    ) -> Response:
        takes = takes_gzip(request.headers)
        sent = Response(packed if takes else content, media_type=media)
        sent.headers.update({**headers, "ETag": f'"{tag}"'})
        if viewer.is_not_modified(sent.headers, request.headers):
            return NotModifiedResponse(sent.headers)
        if takes:
            sent.headers.update({"Content-Encoding": "gzip", "ETag": f'W/"{tag}"'})
        return sent

    async def send_file(request: Request, name: str = "") -> Response:
        files = _files()
        if name not in files:  # also those of another version, which have its digest in their names
            raise HTTPException(404)
        media = _MEDIA[".html" if name in ("", "api") else Path(name).suffix]
        return sent(request, *files[name], {"Cache-Control": _CACHE, "Vary": "Accept-Encoding"}, media)

    for address in ("/", "/{name}"):
        app.add_api_route(address, send_file, methods=["GET", "HEAD"], include_in_schema=False)


@functools.cache
def _files() -> Mapping[str, _Sent]:
    """The files of the page and of the viewer as they are sent, by their names."""
    viewer = {name: bundle.text_of(file).encode() for name, file in _OF_VIEWER.items()}
    return {name: _tagged(content) for name, content in {**site.served(), **viewer}.items()}


def _tagged(content: bytes) -> _Sent:
    """A text as it is sent, plain and compressed, and its tag for the caches of browsers."""
    return content, gzip.compress(content, 9, mtime=0), hashlib.sha256(content).hexdigest()[:32]


@functools.lru_cache(maxsize=256)
def _packed_file(path: str, changed: int) -> bytes:  # noqa: ARG001  (of a file that changes it is made again)
    return gzip.compress(Path(path).read_bytes(), 9, mtime=0)


def _folder_of(package: str, folder: str) -> Path:
    """A folder of an installed package, without importing it."""
    result = importlib.util.find_spec(package)
    assert result is not None, package
    assert result.origin is not None, package
    return Path(result.origin).parent / folder
