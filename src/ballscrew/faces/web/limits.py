"""Limits on the size of a request, checked before its work starts; limits on its body are in ``bodies``.

What takes too long or too much memory is refused by the process that computes it, see ``job_process``. Here is what
would be too large to send, what runs in threads of the server, and how many samples a band has that asks for none.
"""

from __future__ import annotations

import ctypes
import gc
import math
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation import recordings
from ballscrew.engine.uncertainty.bands import NUT_SAMPLES, SAMPLES
from ballscrew.faces.page.bundle import policy
from ballscrew.faces.web import problems
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.questions.shared.options import options_of
from ballscrew.questions.sweep import compute
from ballscrew.questions.sweep.band import INNER

Argument = TypeVar("Argument")
Result = TypeVar("Result")


def _trimming() -> Callable[[int], int] | None:
    """``malloc_trim`` of glibc, which keeps what was freed; no other allocator needs it."""
    library: Any = ctypes.CDLL(None) if sys.platform == "linux" else None
    return getattr(library, "malloc_trim", None)


_TRIM = _trimming()


def keep_loaded() -> None:
    """Spare the collector what is loaded by now and stays: each collection is the quicker."""
    gc.collect()
    gc.freeze()


def releasing(work: Callable[[Argument], Result]) -> Callable[[Argument], Result]:
    """The work; after it its cycles (figures, tapes) are collected, and their memory goes back to the system.

    Recordings are dropped, too: each case of a user has its own, which few will ask for again. Those that serve every
    case of a kind stay, and the collector is spared them.
    """

    def released(argument: Argument) -> Result:
        made = recordings.Structures.made
        try:
            return work(argument)
        finally:
            recordings.forget()
            if recordings.Structures.made == made:
                gc.collect()
            else:
                keep_loaded()
            if _TRIM is not None:
                _TRIM(0)

    return released


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


#: Axes and points of a sweep, and the values that it returns.
MOST_AXES, MOST_POINTS, MOST_RETURNED = 8, 20_000, 200_000
#: Samples of a band, or of all inputs of a sensitivity.
MOST_SAMPLES = 65_536
#: Whole numbers that JSON has exactly; larger ones are sizes of no array.
LARGEST_NUMBER = 2**53
#: Samples of all points of a sweep together where none are asked for, and the fewest of a point that make a band.
USUAL_SAMPLES_OF_SWEEP, FEWEST_SAMPLES = 2**20, 32
#: Balls that are computed one by one, in all points of a sweep or samples of a band where none are asked for.
USUAL_BALLS_IN_ALL = 250_000
#: Points of a sweep of a tenth of a second, and balls in all of them that are computed one by one.
SHORT_POINTS, SHORT_POINTS_OF_NUT, SHORT_BALLS = 1_000, 200, 5_000
#: With more balls than this, a single point is heavy work.
MANY_BALLS = 300
#: States of a motion times balls that are computed one by one, which take a thread some seconds.
MOST_BALLS_IN_MOTION = 250_000
#: Columns of a log, and the lines at its top in which they are counted.
MOST_COLUMNS, _FIRST_LINES = 1_000, 5_000
#: Balls with two contacts that take as long as one with four.
_FOUR_CONTACTS = 3
#: Values of an output with the ends of its band and of the intervals within it.
_WITH_ENDS = 3 + 2 * len(INNER)


def check_size(vary: Mapping[str, str], outputs: int, *, banded: bool = False) -> None:
    """Refuse a sweep that is too large for any case, before its axes are made."""
    points = _points(vary)
    values = points * outputs * (_WITH_ENDS if banded else 1)
    faults: list[Fault] = []
    if len(vary) > MOST_AXES:
        faults.append(Fault("sweep", "too many axes", str(len(vary)), f"{MOST_AXES} at most here"))
    elif points > MOST_POINTS:
        remedy = f"{units.grouped(MOST_POINTS)} at most here; the rest by ballscrew sweep"
        faults.append(Fault("sweep", "too many points", f"{points:,}", remedy))
    elif values > MOST_RETURNED:
        faults.append(_too_many_values(values))
    raise_if_any(faults)


def check_values(plan: compute.Plan) -> None:
    """Refuse a sweep that returns too many values, before it is computed."""
    values = _points_of(plan) * len(plan.columns)
    if values > MOST_RETURNED:
        raise InputError(_too_many_values(values))


def check_samples(requested: int | None) -> None:
    """Refuse samples that no memory has room for."""
    if requested is not None and requested > MOST_SAMPLES:
        remedy = f"{units.grouped(MOST_SAMPLES)} at most here"
        raise InputError(Fault("--samples", "too many", f"{requested:,}", remedy))


def check_options(classes: Sequence[type], written: Mapping[str, Any]) -> None:
    """Refuse samples that no memory has room for, and whole numbers that no array has as its size."""
    check_samples(written.get("samples"))
    for name, option in ((name, option) for cls in classes for name, option in options_of(cls).items()):
        if isinstance(written[name], int) and abs(written[name]) > LARGEST_NUMBER:
            remedy = f"{units.grouped(LARGEST_NUMBER)} at most here"
            raise InputError(Fault(option.flag, "too large", f"{written[name]:,}", remedy))


def check_columns(name: str, content: bytes) -> None:
    """Refuse a log of very many columns, each of which would be looked up among the names that are known."""
    widest = max((line.count(mark) for line in content.splitlines()[:_FIRST_LINES] for mark in b";\t,"), default=0)
    if widest >= MOST_COLUMNS:
        remedy = f"{units.grouped(MOST_COLUMNS)} at most here"
        raise InputError(Fault(name, "has too many columns", f"{widest + 1:,}", remedy))


def is_short(case: Case, plan: compute.Plan) -> bool:
    """Test whether a sweep takes about a tenth of a second at most, such as those of the page without bands."""
    if plan.banded:
        return False
    points = _points_of(plan)
    most = SHORT_POINTS if case.nut is None else SHORT_POINTS_OF_NUT
    return points <= most and points * balls_of(case) <= SHORT_BALLS


def has_long_motion(case: Case) -> bool:
    """Test whether the checks of a case take a thread long, which compute the balls at all states of its motion."""
    balls = balls_of(case)
    return case.motion is not None and balls > 0 and len(case.motion.states().time) * balls > MOST_BALLS_IN_MOTION


def samples_of(case: Case, requested: int | None = None) -> int | None:
    """The samples of a band: the requested number, or the default, or fewer where its balls are too many."""
    check_samples(requested)
    if requested is None and case.nut is not None:
        most = USUAL_BALLS_IN_ALL // max(1, balls_of(case))
        return most if most < NUT_SAMPLES else None
    return requested


def samples_of_sweep(case: Case, plan: compute.Plan, requested: int | None = None) -> int:
    """The samples of each point of a sweep with a band: the requested number, or the default, or fewer of many points.

    Fewer are a power of two.
    """
    check_samples(requested)
    total = USUAL_BALLS_IN_ALL // balls_of(case) if balls_of(case) else USUAL_SAMPLES_OF_SWEEP
    most = max(FEWEST_SAMPLES, total // _points_of(plan))
    usual = NUT_SAMPLES if case.screw.nut.one_by_one else SAMPLES
    return requested or min(usual, 2 ** int(math.log2(most)))


def balls_of(case: Case) -> int:
    """The number of balls that are computed one by one, weighted by their time; zero where all balls are equal."""
    nut = case.screw.nut
    if not nut.one_by_one:
        return 0
    each = _FOUR_CONTACTS if isinstance(nut, OversizeBallNut) else nut.halves
    return int(case.screw.carrying_balls) * each


def _points(vary: Mapping[str, str]) -> int:
    """The points of a grid; an axis without values is refused later, with its own message."""
    return math.prod(max(1, compute.length_of(text)) for text in list(vary.values())[: MOST_AXES + 1])


def _points_of(plan: compute.Plan) -> int:
    return math.prod(len(values) for values in plan.axes.values())


def _too_many_values(values: int) -> Fault:
    return Fault("sweep", "too many values", f"{values:,}", f"{units.grouped(MOST_RETURNED)} at most here")
