"""Guard around all responses: the names of the server, and the security headers."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ballscrew.basis.errors import Fault
from ballscrew.faces.page.bundle import policy
from ballscrew.faces.web import problems

#: Names of the machine that the server runs on: it answers to these, unless told otherwise.
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
#: Headers of every response: browsers run and show only files of this server; of code only WebAssembly may be compiled.
HEADERS: Mapping[str, str] = {
    "Content-Security-Policy": f"{policy()}; font-src 'self'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}
_PORT = re.compile(r":\d*$")


class Guard:
    """ASGI middleware around everything, also around the response to a defect of the server.

    It refuses requests for other names, so that no other site can use the server through a browser. Starlette's own
    check of the host answers with plain text, without these headers.
    """

    def __init__(self, inner: ASGIApp, hosts: Sequence[str]) -> None:
        self.inner = inner
        self.hosts = hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Handle one request."""
        method = scope.get("method", "")

        async def send_with_headers(message: Message) -> None:
            if method == "HEAD" and message["type"] == "http.response.body":
                message = {**message, "body": b""}
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers.update(HEADERS)
                headers.setdefault("Cache-Control", "no-store")
            await send(message)

        if scope["type"] != "http":
            await self.inner(scope, receive, send)
            return
        host = Headers(scope=scope).get("host", "")
        if method == "HEAD":  # FastAPI would refuse it where it answers GET; the headers are the same
            scope = {**scope, "method": "GET"}
        if "*" in self.hosts or _PORT.sub("", host).lower() in self.hosts:
            await self.inner(scope, receive, send_with_headers)
        else:
            response = problems.response(421, [Fault("Host", "is not a name of this server", host[:80])])
            await response(scope, receive, send_with_headers)
