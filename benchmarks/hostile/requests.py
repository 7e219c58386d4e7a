"""Mutated requests to a server: bodies, headers, paths, methods, bytes that are no request, and slow clients.

Requests to `ballscrew serve` from 8 clients: bodies with mutated cases, options and bytes, other paths, methods,
headers and queries, bytes that are no request, clients that leave, and 20 that send half a request and wait; one in 20
is a usual request.

*Wrong*: a status of 500 or more; no answer within 60 s; an answer without the security headers; a usual request that is
not answered with 200; a server that has written to standard error.
"""

from __future__ import annotations

import base64
import concurrent.futures
import contextlib
import http.client
import io
import itertools
import json
import socket
import threading
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import numpy as np
from benchmarks.hostile.mutations import OF_TEXT_BYTES, Random, chosen, mutated_tables
from benchmarks.hostile.server import MOST_SECONDS, started, wrong_answer
from benchmarks.hostile.tally import Outcome, Tally
from benchmarks.serve import CASE, NUT, requests

from faces.web.test_hostile import BODIES, HEAD, LOGS, SWEEPS, VALUES

COUNT, SECONDS = 10_000, 200.0

CLIENTS, SLOW = 8, 20
USUAL = 20
#: Addresses that take logs, and the field of each.
WITH_FILES = {"log": "log", "fit": "log", "service": "worn"}
ADDRESSES = ("run", "sweep", "compare", "band", "toml", "drawing", *WITH_FILES, "hand-over")
PATHS = (
    "/", "/api", "/api/v1", "/api/v1/", "/api/v1/run", "/api/v1/run/", "/api/v1/catalogue", "/api/v1/catalogue/%2e%2e",
    "/api/v1/schema",
    "/api/v1/catalogue/rexroth-40x10x6-6-double", "/api/v1/catalogue?words=40x&words=2", "/api/v1/catalogue?words=%00",
    "//", "/%",
    "/page/../../pyproject.toml", "/page/%2e%2e/%2e%2e/api.py", "/page/main.js", "/page/main.js/..",
    "/api/v1/validate?set=none",
    "/api/v1/openapi.json", "/docs", "/favicon.ico", "/api/v1/report?kind=exe", "/%F0%9F%98%80", "/" + "x" * 3000,
    "/?" + "a=1&" * 900,
)  # fmt: skip
GOOD_LOG = b"speed [rpm],axial load [N],torque [N m]\n" + b"".join(
    b"%d,%d,%.3f\n" % (50 * n, 500 * f, 0.42 * f) for n in (1, 2, 4) for f in (2, 4, 6)
)
METHODS = ("GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "BREW", "get")
HEADERS = (
    ("Host", "example.org"), ("Host", ""), ("Content-Type", "text/plain"),
    ("Content-Type", "application/json; charset=utf-16"),
    ("Accept", "nothing/at-all"), ("Accept-Encoding", "br;q=nan"), ("Content-Encoding", "gzip"),
    ("Expect", "100-continue"),
    ("Origin", "http://example.org"), ("Range", "bytes=5-1"), ("Range", "bytes=0-0,0-0,0-0"),
    ("If-Modified-Since", "never"), ("If-None-Match", "*"),
    ("Cookie", "x" * 4000), ("X-Forwarded-For", "' or 1=1"), ("Upgrade", "websocket"), ("Connection", "upgrade"),
    ("Authorization", "Basic \xff"),
)  # fmt: skip
RAW = (
    b"nonsense\r\n\r\n", b"\r\n" * 50, b"\0" * 300, b"\x16\x03\x01\x02\x00\x01\x00\x01",
    b"GET / HTTP/9.9\r\nHost: localhost\r\n\r\n",
    b"GET / HTTP/1.1\r\n\r\n", b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
    b"GET  /  HTTP/1.1\r\nHost: localhost\r\n\r\n",
    b"POST /api/v1/run HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\n",
    b"POST /api/v1/run HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n",
    b"POST /api/v1/run HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\nContent-Length: 5\r\n\r\n0\r\n\r\n",
    b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"x" * 100_000 + b"\r\n\r\n",
    b"GET /" + b"x" * 100_000 + b" HTTP/1.1\r\n\r\n",
)  # fmt: skip


class Client:
    """One connection after the other to a server."""

    def __init__(self, tally: Tally, address: str) -> None:
        found = urlsplit(address)
        self.tally, self.place = tally, (found.hostname or "", found.port or 0)
        self.connection = self._connection()

    def _connection(self) -> http.client.HTTPConnection:
        return http.client.HTTPConnection(*self.place, timeout=MOST_SECONDS)

    def ask(
        self, words: str, method: str, path: str, body: bytes | None, *headers: tuple[str, str], wanted: int = 0
    ) -> None:
        """Send a request and count the answer."""
        try:
            for again in (False, True):
                try:
                    status, wrong = self._answer(method, path, body, headers)
                    break
                except (ConnectionError, http.client.RemoteDisconnected):  # the server may close between two requests
                    self.connection.close()
                    if again:
                        raise
        except Exception as error:
            self.connection.close()
            self.tally.add(Outcome(wrong=[f"{words}: no answer ({type(error).__name__}: {error})"]))
            return
        if wanted and status != wanted:
            wrong = f"status {status}, not {wanted}"
        self.count(words, status, wrong)

    def count(self, words: str, status: int, wrong: str) -> None:
        """Count one answer."""
        if wrong:
            self.tally.add(Outcome(wrong=[f"{words}: {wrong}"]))
        else:
            self.tally.add(Outcome(answered=int(status < 400), refused=int(status >= 400)))

    def _answer(self, method: str, path: str, body: bytes | None, headers: Any) -> tuple[int, str]:
        given = {name.lower() for name, _ in headers}
        self.connection.putrequest(method, path, skip_host="host" in given, skip_accept_encoding=True)
        for name, value in headers:
            self.connection.putheader(name, value.encode("latin-1"))
        if body is not None:
            if "content-type" not in given:
                self.connection.putheader("Content-Type", "application/json")
            self.connection.putheader("Content-Length", str(len(body)))
        self.connection.endheaders(body)
        answer = self.connection.getresponse()
        answer.read()
        return answer.status, wrong_answer(answer.status, {name.lower(): value for name, value in answer.getheaders()})

    def send_raw(self, words: str, text: bytes, *, leave: bool) -> None:
        """Send bytes; leave at once, or count what comes back."""
        with socket.create_connection(self.place, timeout=MOST_SECONDS) as connection:
            found = b""
            with contextlib.suppress(ConnectionError):  # refused before all was sent
                connection.sendall(text)
                if not leave:
                    connection.shutdown(socket.SHUT_WR)
                    found = b"".join(iter(lambda: connection.recv(65_536), b""))
        if not found:
            self.count(words, 400, "")
            return
        head = found.partition(b"\r\n\r\n")[0].split(b"\r\n", 1)
        headers = http.client.parse_headers(io.BytesIO((head[1] if len(head) > 1 else b"") + b"\r\n\r\n"))
        status = int(head[0].split()[1])
        wrong = wrong_answer(status, {name.lower(): value for name, value in headers.items()})
        self.count(words, status, wrong)


def bodies(rng: Random) -> tuple[str, bytes]:
    """An address and a body for it."""
    kind = int(rng.integers(5))
    if kind == 0:
        return chosen(rng, ADDRESSES), BODIES[chosen(rng, list(BODIES))][0]
    case = chosen(rng, (CASE, NUT))
    if kind == 1:
        return "sweep", json.dumps({"case": case, "vary": SWEEPS[chosen(rng, list(SWEEPS))][0]}).encode()
    if kind == 2:
        section, field, value, _ = VALUES[chosen(rng, list(VALUES))]
        case = {**case, section: {**case.get(section, {}), field: value}}
    else:
        case = mutated_tables(case, rng)
    address = chosen(rng, ADDRESSES)
    more: dict[str, Any] = {"samples": 64} if address == "band" else {}
    if address in WITH_FILES:
        content = LOGS[chosen(rng, list(LOGS))][0]
        if rng.random() < 0.5:
            content = OF_TEXT_BYTES[chosen(rng, list(OF_TEXT_BYTES))](GOOD_LOG, rng)
        more = {WITH_FILES[address]: {"name": "log.csv", "base64": base64.b64encode(content).decode()}}
    if address == "hand-over":
        more = {"to": chosen(rng, ("c", "linuxcnc", "urdf", "nothing")), "options": {"load": "1 kN"}}
    if rng.random() < 0.1:
        more = mutated_tables({"more": {"samples": 64, "level": 0.9, "vary": {"axial_load": "1:2:3 kN"}}}, rng)
    body = json.dumps({"case": case, **more}).encode()
    if kind == 4:
        body = OF_TEXT_BYTES[chosen(rng, list(OF_TEXT_BYTES))](body, rng)
    return address, body


def one(client: Client, seed: int, number: int, usual: Iterator[tuple[str, Any, int]]) -> None:
    """Send one request."""
    rng = np.random.default_rng([seed, number])
    kind = rng.random()
    if number % USUAL == 0:
        address, body, wanted = next(usual)
        client.ask(f"usual request {number}", "POST", f"/api/v1/{address}", json.dumps(body).encode(), wanted=wanted)
    elif kind < 0.6:
        address, body = bodies(rng)
        client.ask(f"request {number} ({address}, {body[:300]!r})", "POST", f"/api/v1/{address}", body)
    elif kind < 0.85:
        method, path = chosen(rng, METHODS), chosen(rng, PATHS)
        headers = tuple({name: (name, value) for name, value in (chosen(rng, HEADERS) for _ in range(2))}.values())
        body = None if method in {"GET", "HEAD"} else chosen(rng, (None, b"{}", json.dumps({"case": CASE}).encode()))
        client.ask(f"request {number} ({method} {path[:80]} {headers})", method, path, body, *headers)
    else:
        text = chosen(rng, (*RAW, HEAD[:50], HEAD, HEAD + b"{", HEAD.replace(b"run", b"band") + b"{}" + b" " * 498))
        if rng.random() < 0.3:
            text = OF_TEXT_BYTES["flipped bits"](text, rng)
        client.send_raw(f"bytes {number} ({text[:80]!r})", text, leave=bool(rng.random() < 0.3))


def run(tally: Tally, seed: int) -> None:
    """Send requests from some clients at once, with slow ones beside them."""
    numbers, lock = itertools.count(), threading.Lock()

    def client(which: int) -> None:
        mine, usual = Client(tally, address), requests(which)
        while tally.left:
            with lock:
                number = next(numbers)
            one(mine, seed, number, usual)

    with started(tally) as (_, address), contextlib.ExitStack() as open_ones:
        place = Client(tally, address).place
        for i in range(SLOW):
            slow = open_ones.enter_context(socket.create_connection(place, timeout=MOST_SECONDS))
            slow.sendall((b"G", HEAD[:40], HEAD, HEAD + b'{"case": ')[i % 4])
        with concurrent.futures.ThreadPoolExecutor(CLIENTS) as pool:
            list(pool.map(client, range(CLIENTS)))
