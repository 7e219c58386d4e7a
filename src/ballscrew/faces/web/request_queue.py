"""Request queue: work in threads, with limits on processor time and on the number of waiting requests."""

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

from ballscrew.basis.errors import Fault
from ballscrew.faces.web.problems import Refused

#: Seconds of processor that one request may take.
TIME_LIMIT = 20.0
#: Seconds between two looks at the processor time of work that does not look itself.
_LOOK = 0.25
#: Requests that compute at the same time. More would only share the same processors.
QUICK, SHORT, HEAVY = 4, 1, 2
#: Heavy requests that may wait, short ones, which take a tenth of a second each, and quick ones, some milliseconds.
MOST_WAITING, MOST_SHORT_WAITING, MOST_QUICK_WAITING = 16, 100, 500

#: The id of the fault of a request whose time was used up.
OUT_OF_TIME = "out_of_time"

Result = TypeVar("Result")


class _OutOfTime(Exception):
    """The computing time of a request is used up."""


def _nothing(*_: Any) -> None:
    """Tell nobody."""


class Deadline:
    """Progress callback ``done(finished, total)`` that stops work when its processor time is used up.

    Other work on the machine does not count, only that of the thread that works.
    """

    def __init__(
        self,
        seconds: float,
        progress: Callable[[int, int], None] = _nothing,
        row: Callable[[bytes], None] = _nothing,
    ) -> None:
        self.limit = seconds
        self._progress, self._row = progress, row
        self._clock: Callable[[], float] | None = None
        self._start = 0.0

    def begin(self) -> None:
        """Count from now on, in the thread that works."""
        if hasattr(time, "pthread_getcpuclockid"):
            clock = time.pthread_getcpuclockid(threading.get_ident())
            self._clock = lambda: time.clock_gettime(clock)
        else:  # macOS and Windows tell it to the thread itself only: for others it is the time that passes
            self._clock = time.monotonic
        self._start = self._clock()

    @property
    def computed(self) -> float:
        """Seconds since the work began."""
        return 0.0 if self._clock is None else self._clock() - self._start

    def __call__(self, finished: int, total: int) -> None:
        """Tell how far the work is, and raise when the time is used up."""
        self._progress(finished, total)
        if self.computed > self.limit and finished < total:
            raise _OutOfTime

    def row(self, document: bytes) -> None:
        """Tell a part of the answer that is there before the rest, as JSON; where nobody asks for it, it is lost."""
        self._row(document)

    def stop(self) -> None:
        """Stop the work at its next call."""
        self.limit = -1.0


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
        self,
        time_limit: float = TIME_LIMIT,
        quick: int = QUICK,
        heavy: int = HEAVY,
        waiting: int = MOST_WAITING,
        *,
        progress: Callable[[int, int], None] = _nothing,
        row: Callable[[bytes], None] = _nothing,
    ) -> None:
        self.time_limit = time_limit
        self._progress, self._row = progress, row
        self.waiting = waiting
        self._quick, self._short, self._heavy = _Workers(quick), _Workers(SHORT), _Workers(heavy)
        self._running: dict[asyncio.Future[Any], Deadline] = {}
        self._closed = False

    async def quick(self, work: Callable[[], Result]) -> Result:
        """Run work that takes some milliseconds."""
        if self._quick.limiter.statistics().tasks_waiting >= MOST_QUICK_WAITING:
            raise busy(MOST_QUICK_WAITING)
        return await self._result(lambda _: work(), self._quick)

    async def short(self, work: Callable[[Deadline], Result]) -> Result:
        """Run work that takes a tenth of a second; it does not wait for heavy work."""
        if self._short.limiter.statistics().tasks_waiting >= MOST_SHORT_WAITING:
            raise busy(MOST_SHORT_WAITING)
        return await self._result(work, self._short)

    async def heavy(self, work: Callable[[Deadline], Result]) -> Result:
        """Run longer work; it is refused where many requests wait, and stopped when its time is used up."""
        if self._heavy.limiter.statistics().tasks_waiting >= self.waiting:
            raise busy(self.waiting)
        return await self._result(work, self._heavy)

    def close(self) -> None:
        """Refuse the requests that run or wait, and stop their work."""
        self._closed = True
        for future, deadline in list(self._running.items()):
            deadline.stop()
            if not future.done():
                future.set_exception(closing())
        for workers in (self._quick, self._short, self._heavy):
            workers.limiter.total_tokens = math.inf  # the waiting requests go on, and are refused

    async def _result(self, work: Callable[[Deadline], Any], workers: _Workers) -> Any:
        borrower, limiter = object(), workers.limiter
        try:
            with fail_after(self.time_limit * (1 + self.waiting)):
                await limiter.acquire_on_behalf_of(borrower)
        except TimeoutError:
            raise busy(limiter.statistics().tasks_waiting) from None
        if self._closed:
            limiter.release_on_behalf_of(borrower)
            raise closing()
        loop = asyncio.get_running_loop()
        future: asyncio.Future[Any] = loop.create_future()
        deadline = self._running[future] = Deadline(self.time_limit, self._progress, self._row)
        outcome: list[tuple[Any, BaseException | None]] = []

        def run() -> None:
            try:
                deadline.begin()
                outcome.append((work(deadline), None))
            except _OutOfTime:
                outcome.append((None, out_of_time(self.time_limit)))
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
            while not future.done():
                await asyncio.wait((future,), timeout=_LOOK)
                if not future.done() and deadline.computed > self.time_limit + 1:
                    raise out_of_time(self.time_limit)
            return future.result()
        finally:
            deadline.stop()
            if not future.cancel() and not future.cancelled():
                future.exception()  # of a client that has disconnected at that moment: nobody asks for it any more


def busy(waiting: int) -> Refused:
    """The refusal where too many requests wait."""
    return Refused(429, Fault("server", "is busy", f"{waiting} requests are waiting", "try again soon"))


def out_of_time(seconds: float, *, is_job: bool = False, command: str = "") -> Refused:
    """The refusal of work that has computed for too long; it would do so again, so no client shall send it again.

    A request has its id, by which a client knows that a job has more time.
    """
    given = f"{seconds:g} s of processor time"
    remedies = ["ask for less at a time", "start the server with a longer time limit"]
    remedies[:0] = [] if is_job else ["start it as a job"]
    remedies += [f"use ballscrew {command}"] if command else []
    remedy = f"{', '.join(remedies[:-1])}, or {remedies[-1]}"
    id = "" if is_job else OUT_OF_TIME
    return Refused(422, Fault("server", "stopped the work, which took too long", given, remedy, id=id))


def closing() -> Refused:
    """The refusal while the server ends."""
    return Refused(503, Fault("server", "is shutting down", "", "start it again"))
