"""plotly.js as it is installed, sent so that the first chart comes soon."""

from __future__ import annotations

import hashlib
from collections.abc import Awaitable, Callable
from pathlib import Path

from starlette.requests import Request
from starlette.responses import Response

#: How the script begins and ends the function with all of it, and the same in parentheses.
_BEGIN, _END = 'this, () => {\n"use strict"', "return Plotly;\n}));"
_BEGIN_NOW, _END_NOW = 'this, (() => {\n"use strict"', "return Plotly;\n})));"


def eager(script: str) -> str:
    """The script with its one large function in parentheses, if it is built like that; else as it is.

    Browsers parse a function twice, once to skip it and once to run it, but not one in parentheses: they take it that
    it runs at once. That is a third of the time until there is a chart.
    """
    if script.count(_BEGIN) != 1 or not script.rstrip().endswith(_END):
        return script
    return script.rstrip().removesuffix(_END).replace(_BEGIN, _BEGIN_NOW) + _END_NOW + "\n"


def sender(path: Path) -> Callable[[Request], Awaitable[Response]]:
    """What sends the script from memory, and only to browsers that do not have it."""
    content = eager(path.read_text(encoding="utf-8")).encode()
    tag = f'"{hashlib.sha256(content).hexdigest()[:32]}"'
    headers = {"ETag": tag, "Cache-Control": "no-cache"}

    async def send(request: Request) -> Response:
        known = [one.strip().removeprefix("W/") for one in request.headers.get("if-none-match", "").split(",")]
        if tag in known:
            return Response(status_code=304, headers=headers)
        return Response(content, media_type="text/javascript; charset=utf-8", headers=headers)

    return send
