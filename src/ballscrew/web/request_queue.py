"""Request queue: work in threads, with limits on computing time and on the number of waiting requests."""

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

from ballscrew.errors import Fault
from ballscrew.web.problems import Refused

#: Seconds that one request may compute.
TIME_LIMIT = 20.0
#: Requests that compute at the same time. More would only share the same processors.
QUICK, SHORT, HEAVY = 4, 1, 2
#: Heavy requests that may wait, short ones, which take a tenth of a second each, and quick ones, some milliseconds.
MOST_WAITING, MOST_SHORT_WAITING, MOST_QUICK_WAITING = 16, 100, 500

Result = TypeVar("Result")


class _OutOfTime(Exception):
    """The computing time of a request is used up."""


class Deadline:
    """Progress callback ``done(finished, total)`` that stops work when its time is used up."""

    def __init__(self, seconds: float) -> None:
        self.end = time.monotonic() + seconds

    def __call__(self, finished: int, total: int) -> None:
        """Raise when the time is used up."""
        if time.monotonic() > self.end and finished < total:
            raise _OutOfTime

    def stop(self) -> None:
        """Stop the work at its next call."""
        self.end = -1.0


class _Workers:
    """A fixed number of worker threads, reused because each one keeps memory of its own.

    anyio's threads would do, but they keep the program from ending, and give up their place when a request times out
    although they still compute.
    """

    def __init__(self, count: int) -> None:
        self.limiter = CapacityLimiter(count)
        self._idle: list[queue.SimpleQueue[Callable[[], None]]] = []

    def start(self, work: Callable[[], None], finished: Callable[[], None]) -> None:
        """Run work in an idle thread, and call ``finished`` there when the thread is idle again."""

        def task() -> None:
            work()
            self._idle.append(tasks)
            finished()

        if self._idle:
            tasks = self._idle.pop()
        else:
            tasks = queue.SimpleQueue[Callable[[], None]]()
            threading.Thread(target=_run_tasks, args=(tasks,), name="ballscrew request", daemon=True).start()
        tasks.put(task)


def _run_tasks(tasks: queue.SimpleQueue[Callable[[], None]]) -> None:
    while True:
        tasks.get()()


class RequestQueue:
    """The queue of one server: quick requests, short ones and heavy ones wait apart.

    A thread cannot be stopped from outside: it ends at its next call of the deadline, and keeps its place until then,
    also if its client has disconnected. No thread keeps the program from ending.
    """

    def __init__(
        self, time_limit: float = TIME_LIMIT, quick: int = QUICK, heavy: int = HEAVY, waiting: int = MOST_WAITING
    ) -> None:
        self.time_limit = time_limit
        self.waiting = waiting
        self._quick, self._short, self._heavy = _Workers(quick), _Workers(SHORT), _Workers(heavy)
        self._running: dict[asyncio.Future[Any], Deadline] = {}
        self._closed = False

    async def quick(self, work: Callable[[], Result]) -> Result:
        """Run work that takes some milliseconds."""
        if self._quick.limiter.statistics().tasks_waiting >= MOST_QUICK_WAITING:
            raise _busy(MOST_QUICK_WAITING)
        return await self._result(lambda _: work(), self._quick)

    async def short(self, work: Callable[[Deadline], Result]) -> Result:
        """Run work that takes a tenth of a second; it does not wait for heavy work."""
        if self._short.limiter.statistics().tasks_waiting >= MOST_SHORT_WAITING:
            raise _busy(MOST_SHORT_WAITING)
        return await self._result(work, self._short)

    async def heavy(self, work: Callable[[Deadline], Result]) -> Result:
        """Run longer work; it is refused where many requests wait, and stopped when its time is used up."""
        if self._heavy.limiter.statistics().tasks_waiting >= self.waiting:
            raise _busy(self.waiting)
        return await self._result(work, self._heavy)

    def close(self) -> None:
        """Refuse the requests that run or wait, and stop their work."""
        self._closed = True
        for future, deadline in list(self._running.items()):
            deadline.stop()
            if not future.done():
                future.set_exception(_closing())
        for workers in (self._quick, self._short, self._heavy):
            workers.limiter.total_tokens = math.inf  # the waiting requests go on, and are refused

    async def _result(self, work: Callable[[Deadline], Any], workers: _Workers) -> Any:
        borrower, limiter = object(), workers.limiter
        try:
            with fail_after(self.time_limit * (1 + self.waiting)):
                await limiter.acquire_on_behalf_of(borrower)
        except TimeoutError:
            raise _out_of_time(self.time_limit) from None
        if self._closed:
            limiter.release_on_behalf_of(borrower)
            raise _closing()
        loop = asyncio.get_running_loop()
        future: asyncio.Future[Any] = loop.create_future()
        deadline = self._running[future] = Deadline(self.time_limit)
        outcome: list[tuple[Any, BaseException | None]] = []

        def run() -> None:
            try:
                outcome.append((work(deadline), None))
            except _OutOfTime:
                outcome.append((None, _out_of_time(self.time_limit)))
            except BaseException as error:  # it is raised where the result is awaited
                outcome.append((None, error))

        def settle() -> None:
            limiter.release_on_behalf_of(borrower)
            del self._running[future]
            result, error = outcome.pop()
            if future.done():  # timed out, or the client has disconnected
                return
            if error is None:
                future.set_result(result)
            else:
                future.set_exception(error)

        def finished() -> None:
            with contextlib.suppress(RuntimeError):  # the loop is closed: the server has ended in the meantime
                loop.call_soon_threadsafe(settle)

        workers.start(run, finished)
        try:
            with fail_after(self.time_limit + 1):
                return await future
        except TimeoutError:
            raise _out_of_time(self.time_limit) from None
        finally:
            deadline.stop()


def _busy(waiting: int) -> Refused:
    return Refused(429, Fault("server", "is busy", f"{waiting} requests are waiting", "try again soon"))


def _out_of_time(seconds: float) -> Refused:
    remedy = "request fewer points or samples, or start the server with a longer --time-limit"
    return Refused(408, Fault("server", f"stopped after {seconds:g} s", "", remedy))


def _closing() -> Refused:
    return Refused(503, Fault("server", "is shutting down", "", "start it again"))
