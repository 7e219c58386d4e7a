"""Refusals as ``application/problem+json`` (RFC 9457), in the words of the command line."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from starlette.responses import Response

from ballscrew.basis.errors import LINES_AT_MOST, Fault, InputError

MEDIA_TYPE = "application/problem+json"
#: Titles of the problems, by status.
TITLES: Mapping[int, str] = {
    400: "The request is not JSON",
    403: "Asked by a page of another site",
    404: "Not found",
    405: "Method not allowed",
    408: "The request did not arrive",
    409: "The job has not ended",
    413: "The request is too large",
    415: "The content type is not JSON",
    421: "Not a name of this server",
    422: "Invalid input",
    429: "Too many requests are waiting",
    500: "Defect of ballscrew",
    503: "The server is shutting down",
}
#: Headers of the problems, by status. At shutdown no client shall send another request on its connection.
_HEADERS: Mapping[int, Mapping[str, str]] = {429: {"Retry-After": "1"}, 503: {"Connection": "close"}}


class Refused(Exception):
    """A refused request: the status and the faults."""

    def __init__(self, status: int, *faults: Fault) -> None:
        super().__init__(status)
        self.status = status
        self.faults = faults


def document(status: int, faults: Sequence[Fault] = ()) -> dict[str, Any]:
    """The problem as JSON: the lines that the command line prints, and each fault by its parts."""
    return {
        "type": "about:blank",
        "title": TITLES.get(status, "The request is refused"),
        "status": status,
        "lines": InputError(*faults).lines(),
        "faults": [fault.document() for fault in faults[: 10 * LINES_AT_MOST]],
    }


def response(status: int, faults: Sequence[Fault] = ()) -> Response:
    """The problem as a response."""
    return Response(json.dumps(document(status, faults)), status, _HEADERS.get(status), MEDIA_TYPE)
