"""Work in threads, with a limit on time and on how many wait."""

from __future__ import annotations

import asyncio
import contextlib
import math
import queue
import threading
import time
from collections.abc import Callable
from typing import Any, TypeVar

from anyio import CapacityLimiter, fail_after

from ballscrew.faults import Fault
from ballscrew.interfaces.web.problems import Refused

#: Seconds that one request may compute.
LONGEST = 20.0
#: Requests that compute at the same time. More would only share the same processors.
QUICK, HEAVY = 4, 2
#: Heavy requests that may wait, and quick ones: these take some milliseconds each.
MOST_WAITING, MOST_QUICK_WAITING = 16, 500

Found = TypeVar("Found")


class _OutOfTime(Exception):
    """The time of a request is up."""


class Deadline:
    """Told how far the work is, it stops it when its time is up: a ``done(finished, total)``."""

    def __init__(self, seconds: float) -> None:
        self.end = time.monotonic() + seconds

    def __call__(self, finished: int, total: int) -> None:
        """Raise when the time is up."""
        if time.monotonic() > self.end and finished < total:
            raise _OutOfTime

    def stop(self) -> None:
        """The time is up now."""
        self.end = -1.0


class _Places:
    """Places to work at, with a thread each: the same ones again and again, as each has memory of its own."""

    def __init__(self, count: int) -> None:
        self.limiter = CapacityLimiter(count)
        self._idle: list[queue.SimpleQueue[Callable[[], None]]] = []

    def begin(self, work: Callable[[], None], settled: Callable[[], None]) -> None:
        """Do some work where a place is free, and say from there when the place is free again."""

        def task() -> None:
            work()
            self._idle.append(own)
            settled()

        if self._idle:
            own = self._idle.pop()
        else:
            own = queue.SimpleQueue[Callable[[], None]]()
            threading.Thread(target=_work_on, args=(own,), name="ballscrew request", daemon=True).start()
        own.put(task)


def _work_on(tasks: queue.SimpleQueue[Callable[[], None]]) -> None:
    while True:
        tasks.get()()


def _busy(waiting: int) -> Refused:
    return Refused(429, Fault("server", "is busy", f"{waiting} requests are waiting", "try again soon"))


class Desk:
    """Where requests wait for their turn, of one server.

    A thread cannot be stopped from outside: it ends at its next word to the deadline, and keeps its place until then,
    even if nobody waits for it any more. None of them keeps the program from ending.
    """

    def __init__(
        self, longest: float = LONGEST, quick: int = QUICK, heavy: int = HEAVY, waiting: int = MOST_WAITING
    ) -> None:
        self.longest = longest
        self.waiting = waiting
        self._quick, self._heavy = _Places(quick), _Places(heavy)
        self._at_work: dict[asyncio.Future[Any], Deadline] = {}
        self._closed = False

    async def quick(self, work: Callable[[], Found]) -> Found:
        """What takes some milliseconds."""
        if self._quick.limiter.statistics().tasks_waiting >= MOST_QUICK_WAITING:
            raise _busy(MOST_QUICK_WAITING)
        return await self._done(lambda _: work(), self._quick)

    async def heavy(self, work: Callable[[Deadline], Found]) -> Found:
        """What takes longer: refused where many wait already, and stopped when its time is up."""
        if self._heavy.limiter.statistics().tasks_waiting >= self.waiting:
            raise _busy(self.waiting)
        return await self._done(work, self._heavy)

    def close(self) -> None:
        """Stop what can be stopped, and let nobody wait for the rest."""
        self._closed = True
        for future, deadline in list(self._at_work.items()):
            deadline.stop()
            if not future.done():
                future.set_exception(_ends())
        for places in (self._quick, self._heavy):
            places.limiter.total_tokens = math.inf  # those who wait come to the desk, and find it closed

    async def _done(self, work: Callable[[Deadline], Any], places: _Places) -> Any:
        place, limiter = object(), places.limiter
        try:
            with fail_after(self.longest * (1 + self.waiting)):
                await limiter.acquire_on_behalf_of(place)
        except TimeoutError:
            raise _stopped(self.longest) from None
        if self._closed:
            limiter.release_on_behalf_of(place)
            raise _ends()
        loop = asyncio.get_running_loop()
        future: asyncio.Future[Any] = loop.create_future()
        deadline = self._at_work[future] = Deadline(self.longest)

        outcome: list[tuple[Any, BaseException | None]] = []

        def run() -> None:
            try:
                outcome.append((work(deadline), None))
            except _OutOfTime:
                outcome.append((None, _stopped(self.longest)))
            except BaseException as error:  # whatever it is, it is the answer to who waits
                outcome.append((None, error))

        def settle() -> None:
            limiter.release_on_behalf_of(place)
            del self._at_work[future]
            found, error = outcome.pop()
            if future.done():  # nobody waits any more
                return
            if error is None:
                future.set_result(found)
            else:
                future.set_exception(error)

        def settled() -> None:
            with contextlib.suppress(RuntimeError):  # the server has ended in the meantime
                loop.call_soon_threadsafe(settle)

        places.begin(run, settled)
        try:
            with fail_after(self.longest + 1):
                return await future
        except TimeoutError:
            raise _stopped(self.longest) from None
        finally:
            deadline.stop()


def _stopped(seconds: float) -> Refused:
    return Refused(408, Fault("server", f"stopped after {seconds:g} s", "", "ask for fewer points or samples"))


def _ends() -> Refused:
    return Refused(503, Fault("server", "ends", "", "start it again"))
