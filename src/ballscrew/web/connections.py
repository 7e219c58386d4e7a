"""Listening: uvicorn, with patience that ends, and an end that nobody waits for."""

from __future__ import annotations

import asyncio
import logging
import socket
from typing import Any

import h11
import uvicorn
from fastapi import FastAPI
from uvicorn.protocols.http.h11_impl import H11Protocol

from ballscrew.faults import Fault
from ballscrew.interfaces.web import problems
from ballscrew.interfaces.web.bodies import PATIENCE
from ballscrew.interfaces.web.server import HEADERS
from ballscrew.interfaces.web.work import Desk

#: Bytes of the head of a request.
LONGEST_HEAD = 65_536
#: Seconds for what is sent to be taken, each time the line is full.
_PATIENCE_TO_SEND = 60.0
#: Seconds that answers have to go out when the server ends.
_FAREWELL = 2


class _Patient(H11Protocol):
    """A connection that is closed where the head of a request, or a body nobody reads, does not come to its end.

    It is broken off where the answer is not taken.
    """

    _waiting: asyncio.TimerHandle | None = None
    _full: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Somebody has called."""
        super().connection_made(transport)
        self._wait()

    def connection_lost(self, exc: Exception | None) -> None:
        """Somebody has left."""
        self._stop_waiting()
        self._empty()
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        """The line is full: closing it would wait for who does not read."""
        super().pause_writing()
        self._empty()
        self._full = self.loop.call_later(_PATIENCE_TO_SEND, self.transport.abort)

    def resume_writing(self) -> None:
        """What was sent is being taken."""
        super().resume_writing()
        self._empty()

    def data_received(self, data: bytes) -> None:
        """Some bytes have come."""
        super().data_received(data)
        answered = self.conn.our_state is h11.DONE
        if not (self.conn.their_state is h11.IDLE or (answered and self.reads_body)):
            self._stop_waiting()
        elif self._waiting is None:
            self._wait()

    def on_response_complete(self) -> None:
        """The answer is out, perhaps before all of the request was in."""
        super().on_response_complete()
        if self.reads_body and self._waiting is None:
            self._wait()

    @property
    def reads_body(self) -> bool:
        """Whether a request has begun and has not all come."""
        return self.conn.their_state is h11.SEND_BODY

    def send_400_response(self, msg: str) -> None:  # noqa: ARG002  (it only says that it is invalid)
        """Refuse what is no HTTP, in our words."""
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            fault = Fault("request", "is not HTTP, or its head is too long", "", f"{LONGEST_HEAD} bytes at most")
            found = problems.response(400, [fault])
            found.headers.update({**HEADERS, "Cache-Control": "no-store", "Connection": "close"})
            for event in (
                h11.Response(status_code=400, headers=found.raw_headers, reason="Bad Request"),
                h11.Data(data=bytes(found.body)),
                h11.EndOfMessage(),
            ):
                self.transport.write(self.conn.send(event) or b"")
        self.transport.close()

    def _empty(self) -> None:
        if self._full is not None:
            self._full.cancel()
            self._full = None

    def _wait(self) -> None:
        self._waiting = self.loop.call_later(PATIENCE, self.transport.close)

    def _stop_waiting(self) -> None:
        if self._waiting is not None:
            self._waiting.cancel()
            self._waiting = None


class _Server(uvicorn.Server):
    """A server that tells its desk when it ends."""

    def __init__(self, config: uvicorn.Config, desk: Desk) -> None:
        super().__init__(config)
        self._desk = desk

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Take no more requests, and answer those that wait; what comes to no end is broken off."""
        self._desk.close()
        for connection in list(self.server_state.connections):
            if isinstance(connection, _Patient) and connection.reads_body:
                connection.transport.close()
        logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)  # it would show where each was broken off
        await super().shutdown(sockets)


def run(application: FastAPI, listening: socket.socket) -> None:
    """Serve until a signal ends it."""
    settings = uvicorn.Config(
        application, http=_Patient, ws="none", lifespan="off", log_level="error", access_log=False,
        proxy_headers=False, server_header=False, timeout_keep_alive=75, timeout_graceful_shutdown=_FAREWELL,
        h11_max_incomplete_event_size=LONGEST_HEAD,
    )  # fmt: skip
    _Server(settings, application.state.desk).run([listening])
