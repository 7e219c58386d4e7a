"""What goes wrong, as ``application/problem+json`` (RFC 9457), in the words of the command line."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from starlette.responses import Response

from ballscrew.faults import LINES_AT_MOST, Fault, InputError

MEDIA_TYPE = "application/problem+json"
#: What each status is called.
TITLES: Mapping[int, str] = {
    400: "The request is not JSON",
    404: "There is nothing here",
    405: "This address knows no such method",
    408: "It took too long",
    413: "The request is too large",
    415: "The request is not said to be JSON",
    421: "This server is not called so",
    422: "The case is at fault",
    429: "Too many others are being served",
    500: "A defect of ballscrew",
    503: "The server ends",
}


class Refused(Exception):
    """A request that is not answered, and why."""

    def __init__(self, status: int, *faults: Fault) -> None:
        super().__init__(status)
        self.status = status
        self.faults = faults


def response(status: int, faults: Sequence[Fault] = ()) -> Response:
    """The problem as an answer: the lines that the command line prints, and the faults taken apart."""
    content: dict[str, Any] = {
        "type": "about:blank",
        "title": TITLES.get(status, "The request is refused"),
        "status": status,
        "lines": InputError(*faults).lines(),
        "faults": [_parts(fault) for fault in faults[: 10 * LINES_AT_MOST]],
    }
    headers = {"Retry-After": "1"} if status == 429 else None
    return Response(json.dumps(content), status, headers, MEDIA_TYPE)


def _parts(fault: Fault) -> dict[str, str]:
    """The place, and the whole line: its other parts are in there, cut to what a person reads."""
    line = str(fault)
    where = line.partition(": ")[0]
    return {"where": where, "line": line}


#: JSON Schema of a problem.
SCHEMA: Mapping[str, Any] = {
    "type": "object",
    "description": "What is wrong with a request (RFC 9457).",
    "required": ["type", "title", "status", "lines", "faults"],
    "properties": {
        "type": {"const": "about:blank"},
        "title": {"type": "string"},
        "status": {"type": "integer", "minimum": 400, "maximum": 599},
        "lines": {
            "type": "array",
            "items": {"type": "string"},
            "maxItems": LINES_AT_MOST,
            "description": "what the command line prints on its error stream",
        },
        "faults": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["where", "line"],
                "properties": {
                    "where": {"type": "string", "description": "section.field"},
                    "line": {"type": "string", "description": "the field, what is wrong, the value, the remedy"},
                },
            },
        },
    },
}
