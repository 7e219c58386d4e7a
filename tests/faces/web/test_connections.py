"""Bytes that are no request, given to a connection without a socket."""

import asyncio
import unittest.mock

import pytest

pytest.importorskip("fastapi", reason="fastapi is not installed (the extra web)")
import uvicorn

from ballscrew.faces.web import connections, server
from ballscrew.faces.web.limits import HEADERS

from .conftest import run_scene

HEAD = b"%s /api/v1/run HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
#: Headers that every response has.
SECURITY = [name.lower() for name in (*HEADERS, "Content-Security-Policy", "Cache-Control")]


def responses(*pieces):
    """What a connection writes after each piece, and the errors in the log."""
    written = bytearray()
    transport = unittest.mock.Mock()
    transport.get_extra_info.return_value = None
    transport.is_closing.side_effect = lambda: transport.close.called
    transport.write.side_effect = written.extend
    application = server.application()

    async def scene():
        config = uvicorn.Config(
            application, http=connections._TimeoutProtocol, ws="none", lifespan="off", log_config=None
        )
        config.load()
        state = uvicorn.server.ServerState()
        protocol = connections._TimeoutProtocol(config, state, {})
        protocol.logger = unittest.mock.Mock(level=100)
        protocol.connection_made(transport)
        for piece in pieces:
            protocol.data_received(piece)
            await asyncio.sleep(0)
        await asyncio.wait_for(asyncio.gather(*state.tasks), 60)
        protocol.connection_lost(None)
        return protocol.logger.error.mock_calls

    errors = run_scene(scene())
    assert transport.close.called
    return bytes(written), errors


@pytest.mark.parametrize("method", [b"POST", b"pOST", b"GET", b"HEAD", b"TRACE"])
@pytest.mark.parametrize("at_once", [True, False])
def test_a_request_with_an_invalid_body_gets_one_response(method, at_once):
    """Its head is valid, so that it is handled already: a handler that responds at once must not be heard too."""
    head = HEAD % method
    written, errors = responses(head + b"zz\r\n") if at_once else responses(head, b"zz\r\n")
    assert errors == []
    assert written.count(b"HTTP/1.1 ") == 1
    if at_once:
        assert written.startswith(b"HTTP/1.1 400 ")
        assert written.endswith(b"\r\n\r\n") == (method == b"HEAD")  # its response has no body


@pytest.mark.parametrize(
    "text",
    [
        b"nonsense\r\n\r\n",
        b"GET / HTTP/1.1\r\n\r\n",
        b"\x16\x03\x01",
        HEAD % b"PUT" + b"zz\r\n",
        b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"x" * connections.LONGEST_HEAD,
        b"GET /" + b"x" * connections.LONGEST_HEAD,
        b"GET / HTTP/1.1\r\nHost: localhost\r\nHost: other\r\n\r\n",
        b"POST /api/v1/run HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n",
        b"POST /api/v1/run HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n",
    ],
    ids=["nonsense", "no host", "TLS", "body", "long header", "long address", "two hosts", "bad length", "two lengths"],
)
def test_what_is_no_request_is_refused_with_the_headers_of_all_responses(text):
    written, errors = responses(text, b"\r\n\r\n") if text[:1] == b"\x16" else responses(text)
    assert errors == []
    assert written.startswith(b"HTTP/1.1 400 ")
    assert b"application/problem+json" in written
    lines = written.partition(b"\r\n\r\n")[0].decode().splitlines()[1:]
    names = [line.partition(":")[0].lower() for line in lines]
    assert [name for name in SECURITY if names.count(name) != 1] == []
    assert names.count("connection") == 1
