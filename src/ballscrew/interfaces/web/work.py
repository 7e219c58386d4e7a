"""Work in threads, with a limit on time and on how many wait."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, TypeVar

import anyio
from anyio import CapacityLimiter, to_thread

from ballscrew.faults import Fault
from ballscrew.interfaces.web.problems import Refused

#: Seconds that one request may compute.
LONGEST = 20.0
#: Requests that compute at the same time. More would only share the same processors.
QUICK, HEAVY = 4, 2
#: Heavy requests that may wait; a quick one waits for a few milliseconds, whatever comes.
MOST_WAITING = 16

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


class Desk:
    """Where requests wait for their turn, of one server."""

    def __init__(self, longest: float = LONGEST) -> None:
        self.longest = longest
        self._quick, self._heavy = CapacityLimiter(QUICK), CapacityLimiter(HEAVY)

    async def quick(self, work: Callable[[], Found]) -> Found:
        """What takes some milliseconds."""
        return await self._done(work, self._quick)

    async def heavy(self, work: Callable[[Deadline], Found]) -> Found:
        """What takes longer: refused where many wait already, and stopped when its time is up."""
        if self._heavy.statistics().tasks_waiting >= MOST_WAITING:
            raise Refused(429, Fault("server", "is busy", f"{MOST_WAITING} requests are waiting", "try again soon"))
        return await self._done(lambda: work(Deadline(self.longest)), self._heavy)

    async def _done(self, work: Callable[[], Any], limiter: CapacityLimiter) -> Any:
        try:
            # a thread cannot be stopped from outside: it is left alone, and ends at its next word to the deadline
            with anyio.fail_after(self.longest * (1 + MOST_WAITING)):
                async with limiter:
                    with anyio.fail_after(self.longest + 1):
                        return await to_thread.run_sync(work, abandon_on_cancel=True)
        except (TimeoutError, _OutOfTime):
            fault = Fault("server", f"stopped after {self.longest:g} s", "", "ask for fewer points or samples")
            raise Refused(408, fault) from None
