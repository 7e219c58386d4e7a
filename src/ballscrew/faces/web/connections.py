"""Connections: uvicorn with timeouts for slow clients, and a shutdown that waits for nobody."""

from __future__ import annotations

import asyncio
import logging
import socket
from typing import Any

import h11
import uvicorn
from fastapi import FastAPI
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle

from ballscrew.basis.errors import Fault
from ballscrew.faces.web import problems
from ballscrew.faces.web.bodies import READ_TIMEOUT
from ballscrew.faces.web.jobs import Jobs
from ballscrew.faces.web.limits import HEADERS
from ballscrew.faces.web.request_queue import RequestQueue

#: Bytes of the head of a request.
LONGEST_HEAD = 65_536
#: Seconds for a client to read what was sent, each time the buffer is full.
_WRITE_TIMEOUT = 60.0
#: Seconds that responses have to be sent at shutdown.
_SHUTDOWN_TIMEOUT = 2
#: Turns of the event loop from a request that waits in the kernel to its handler: the connection is accepted, made,
#: registered and read, one turn each. As many again in reserve.
_TURNS_TO_READ = 8


class _TimeoutProtocol(H11Protocol):
    """A connection with timeouts: for the head of a request, for a body that is not read, and for unread responses."""

    _read_timer: asyncio.TimerHandle | None = None
    _write_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Start the timeout of the first request."""
        super().connection_made(transport)
        self._start_reading()

    def connection_lost(self, exc: Exception | None) -> None:
        """Stop all timeouts."""
        self._stop_reading()
        self._stop_writing()
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        """Start the timeout of a full buffer: closing the connection would wait for the client to read."""
        super().pause_writing()
        self._stop_writing()
        self._write_timer = self.loop.call_later(_WRITE_TIMEOUT, self.transport.abort)

    def resume_writing(self) -> None:
        """Stop the timeout: the client reads again."""
        super().resume_writing()
        self._stop_writing()

    def data_received(self, data: bytes) -> None:
        """Stop or start the timeout of reading, by what is still expected."""
        super().data_received(data)
        responded = self.conn.our_state is h11.DONE
        if not (self.conn.their_state is h11.IDLE or (responded and self.expects_body)):
            self._stop_reading()
        elif self._read_timer is None:
            self._start_reading()

    def on_response_complete(self) -> None:
        """Start the timeout of a body that is still expected after its response."""
        super().on_response_complete()
        if self.expects_body and self._read_timer is None:
            self._start_reading()

    @property
    def expects_body(self) -> bool:
        """True while the body of a request is incomplete."""
        return self.conn.their_state is h11.SEND_BODY

    @property
    def _cycle(self) -> RequestResponseCycle | None:
        """The latest request and its response; None before the first, which the annotation of uvicorn leaves out."""
        return self.cycle

    def send_400_response(self, msg: str) -> None:  # noqa: ARG002  (it only says that it is invalid)
        """Refuse what is not HTTP by a problem document."""
        if cycle := self._cycle:  # the head of its request is valid and its body is not: it must not respond too
            cycle.disconnected = True
            cycle.message_event.set()
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            is_head = self.conn.our_state is h11.SEND_RESPONSE and self.scope["method"] == "HEAD"
            fault = Fault(
                "request",
                "is not HTTP, or its head is too long",
                "",
                f"{LONGEST_HEAD} bytes at most",
            )
            response = problems.response(400, [fault])
            # no middleware sees this response
            response.headers.update({**HEADERS, "Cache-Control": "no-store", "Connection": "close"})
            for event in (
                h11.Response(status_code=400, headers=response.raw_headers, reason="Bad Request"),
                h11.Data(data=b"" if is_head else bytes(response.body)),
                h11.EndOfMessage(),
            ):
                self.transport.write(self.conn.send(event) or b"")
        self.transport.close()

    def _start_reading(self) -> None:
        self._read_timer = self.loop.call_later(READ_TIMEOUT, self.transport.close)

    def _stop_reading(self) -> None:
        if self._read_timer is not None:
            self._read_timer.cancel()
            self._read_timer = None

    def _stop_writing(self) -> None:
        if self._write_timer is not None:
            self._write_timer.cancel()
            self._write_timer = None


class _Server(uvicorn.Server):
    """A server that closes its request queue and ends its jobs at shutdown."""

    def __init__(self, config: uvicorn.Config, requests: RequestQueue, jobs: Jobs) -> None:
        super().__init__(config)
        self._requests, self._jobs = requests, jobs

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Refuse the requests that wait, and close the connections whose requests are incomplete.

        Requests that were sent but not read are read first: a connection closed with unread bytes is reset, and its
        client would get no response.
        """
        self._requests.close()
        self._jobs.close()
        for _ in range(_TURNS_TO_READ):
            await asyncio.sleep(0)
        for connection in list(self.server_state.connections):
            if isinstance(connection, _TimeoutProtocol) and connection.expects_body:
                connection.transport.close()
        logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)  # it would log a traceback for each of them
        await super().shutdown(sockets)


def serve(application: FastAPI, listening: socket.socket) -> None:
    """Serve until a signal ends it."""
    settings = uvicorn.Config(
        application,
        http=_TimeoutProtocol,
        ws="none",
        lifespan="off",
        log_level="error",
        access_log=False,
        proxy_headers=False,
        server_header=False,
        timeout_keep_alive=75,
        timeout_graceful_shutdown=_SHUTDOWN_TIMEOUT,
        h11_max_incomplete_event_size=LONGEST_HEAD,
    )
    _Server(settings, application.state.requests, application.state.jobs).run([listening])
