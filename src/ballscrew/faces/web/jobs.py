"""Requests in processes of their own: those that are waited for, and jobs, which take longer.

A process has limits on processor time and memory. A job is started, asked for, and cancelled by a secret name; its
answer is kept for a while, so that a page that was loaded again finds it.
"""

from __future__ import annotations

import asyncio
import contextlib
import math
import secrets
import tempfile
import threading
import time
from collections.abc import Callable
from typing import Literal

from anyio import CapacityLimiter

from ballscrew.basis.errors import Fault
from ballscrew.faces.web import problems
from ballscrew.faces.web.job_process import Answer, Asked, Computed, Message, OutOfTime, Process, Progress, Row, spawned
from ballscrew.faces.web.problems import Refused
from ballscrew.faces.web.request_queue import HEAVY, MOST_WAITING, TIME_LIMIT, busy, closing, out_of_time

#: The addresses of the API begin so.
API = "/api/v1/"
#: A job may compute as many times as long as a request that is waited for.
LONGER = 30
#: Seconds for which an answer is kept, and after which a job ends that nobody has asked about.
KEPT, LEFT_ALONE = 1800.0, 300.0
#: Bytes of all answers that are kept, and of the rows that one job may show before its answer.
MOST_KEPT, MOST_ROWS = 64 << 20, 8 << 20
#: Jobs that are kept, whatever their answers.
MOST_JOBS = 200

State = Literal["waiting", "running", "finished", "failed", "cancelled"]


class Job:
    """One request: how far it is, and what it has found."""

    def __init__(self, address: str, query: str, body: bytes, *, is_waited_for: bool = False) -> None:
        self.id = secrets.token_urlsafe(18)
        self.address, self.query, self.is_waited_for = address, query, is_waited_for
        self.state: State = "waiting"
        self.finished = self.total = 0
        #: Seconds of processor.
        self.computed = 0.0
        self.rows: list[bytes] = []
        self.answer: Answer | None = None
        self.asked = time.monotonic()
        self._body = body
        self._changed = asyncio.Event()
        self._process: Process | None = None
        self._size = 0
        #: What waits for its turn and runs it.
        self.task: asyncio.Task[None] | None = None

    @property
    def has_ended(self) -> bool:
        """Test whether nothing more will come of it."""
        return self.state in ("finished", "failed", "cancelled")

    @property
    def size(self) -> int:
        """Bytes of its answer and of its rows."""
        return self._size + (0 if self.answer is None else len(self.answer.body))

    async def changed(self, seconds: float) -> None:
        """Wait for so many seconds at most until it has ended, or has more rows."""
        if self.has_ended:
            return
        with contextlib.suppress(TimeoutError):  # nothing new: that is an answer, too
            await asyncio.wait_for(self._changed.wait(), seconds)

    async def run(self, start: Callable[[], Process], limit: float) -> None:
        """Run the process to its end."""
        if self.has_ended:
            return
        self.state, begun = "running", time.monotonic()
        loop = asyncio.get_running_loop()
        messages: asyncio.Queue[Message | None] = asyncio.Queue()
        with tempfile.TemporaryDirectory(prefix="ballscrew-", ignore_cleanup_errors=True) as folder:
            try:
                process = self._process = _process(start)
            except OSError as error:
                self.end("failed", _no_process(str(error.strerror)))
                return

            def listen() -> None:
                with contextlib.suppress(RuntimeError, OSError):  # the loop is closed, or the process was killed
                    process.ask(Asked(f"{API}{self.address}", self.query, self._body, limit, folder))
                    self._body = b""
                message: Message | None = Computed(0.0)
                while message is not None:
                    message = process.message()
                    with contextlib.suppress(RuntimeError):  # the loop is closed: the server has ended meanwhile
                        loop.call_soon_threadsafe(messages.put_nowait, message)
                process.close()

            threading.Thread(target=listen, name="ballscrew job", daemon=True).start()
            while (message := await messages.get()) is not None:
                self._take(message, limit)
        if not self.has_ended and not process.has_begun:
            self.end("failed", _no_process(""))
        elif not self.has_ended and time.monotonic() > begun + limit:  # the system has ended it, as it said nothing
            self._take(OutOfTime(), limit)
        elif not self.has_ended:
            fault = Fault("server", "has a defect", "", "please report your request")
            self.end("failed", _problem(500, fault))

    def _take(self, message: Message, limit: float) -> None:
        match message:
            case Progress():
                self.finished, self.total = message.finished, message.total
            case Computed():
                self.computed = message.seconds
            case Row():
                if not (self.has_ended or self.is_waited_for) and self._size + len(message.document) <= MOST_ROWS:
                    self._size += len(message.document)
                    self.rows.append(message.document)
                    self._wake()
            case OutOfTime():
                refused = out_of_time(limit, is_job=not self.is_waited_for, command=self.address)
                self.end("failed", _refused(refused))
            case Answer():
                self.end("finished" if message.status == 200 else "failed", message)

    def end(self, state: State, answer: Answer) -> None:
        """Kill the process, and keep an answer in place of what it would have found."""
        if self._process is not None:
            self._process.end()
        if not self.has_ended:
            self.state, self.answer, self._body = state, answer, b""
            self.asked = time.monotonic()  # it is kept from now on
            self._wake()

    def cancel(self) -> None:
        """Kill the work and forget what it has found; one that waits leaves its place at once."""
        if self.state == "waiting" and self.task is not None:
            self.task.cancel()
        self.end("cancelled", _problem(404, Fault("job", "was cancelled", "", "start it again")))
        self.rows, self._size = [], 0

    def _wake(self) -> None:
        self._changed.set()
        self._changed = asyncio.Event()


class Jobs:
    """The jobs of one server."""

    def __init__(self, time_limit: float = TIME_LIMIT, start: Callable[[], Process] = spawned) -> None:
        #: Seconds of processor that one request and one job may take.
        self.time_limit, self.limit = time_limit, LONGER * time_limit
        self.start = start
        self._limiter, self._waited_for = CapacityLimiter(HEAVY), CapacityLimiter(HEAVY)
        self._requests: set[Job] = set()
        self._jobs: dict[str, Job] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._closed = False
        self._forget_next: asyncio.TimerHandle | None = None

    async def answer(self, address: str, query: str, body: bytes) -> Answer:
        """The answer to a request that is waited for; its work is killed where nobody waits any more."""
        waiting = self._waited_for.statistics().tasks_waiting
        if waiting >= MOST_WAITING:
            raise busy(waiting)
        job = Job(address, query, body, is_waited_for=True)
        self._requests.add(job)
        try:
            async with self._waited_for:
                if self._closed:
                    raise closing()
                await job.run(self.start, self.time_limit)
        finally:
            self._requests.discard(job)
            job.cancel()
        assert job.answer is not None
        return job.answer

    def begin(self, address: str, query: str, body: bytes) -> Job:
        """A new job; it runs when those before it have. Raises :class:`Refused` where too many wait."""
        self._forget_old()
        if self._closed:
            raise closing()
        waiting = sum(job.state == "waiting" for job in self._jobs.values())
        if waiting >= MOST_WAITING:
            raise busy(waiting)
        job = Job(address, query, body)
        self._jobs[job.id] = job
        task = job.task = asyncio.ensure_future(self._run(job))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return job

    def named(self, name: str) -> Job:
        """The job of this name, which its client asks about now. Raises :class:`Refused` where there is none."""
        if name in self._jobs:
            self._jobs[name].asked = time.monotonic()
        self._forget_old()
        if name not in self._jobs:
            raise Refused(404, Fault("job", "is not known", "", "answers are kept for a while only: start it again"))
        return self._jobs[name]

    def before(self, job: Job) -> int:
        """Jobs that wait before this one."""
        if job.state != "waiting":
            return 0
        waiting = [one for one in self._jobs.values() if one.state == "waiting"]
        return waiting.index(job)

    def close(self) -> None:
        """End all jobs."""
        self._closed = True
        if self._forget_next is not None:
            self._forget_next.cancel()
        for job in (*self._jobs.values(), *self._requests):
            job.end("failed", _refused(closing()))
        self._limiter.total_tokens = self._waited_for.total_tokens = math.inf

    async def _run(self, job: Job) -> None:
        watch = asyncio.ensure_future(self._watch(job))
        try:
            async with self._limiter:
                await job.run(self.start, self.limit)
        finally:
            watch.cancel()
            self._forget_old()

    async def _watch(self, job: Job) -> None:
        """Cancel a job that nobody asks about."""
        while not job.has_ended:
            await asyncio.sleep(LEFT_ALONE / 10)
            if time.monotonic() > job.asked + LEFT_ALONE:
                job.cancel()

    def _forget_old(self) -> None:
        """Forget the answers that are old, and the oldest where they are too many or too large, but for the newest.

        It is done again by itself when the next one will be old.
        """
        ended = sorted((job for job in self._jobs.values() if job.has_ended), key=lambda job: job.asked)
        size, number = sum(job.size for job in ended), len(ended)
        for job in ended:
            is_too_much = job is not ended[-1] and (size > MOST_KEPT or number > MOST_JOBS)
            if time.monotonic() > job.asked + KEPT or is_too_much:
                del self._jobs[job.id]
                size, number = size - job.size, number - 1
        if self._forget_next is not None:
            self._forget_next.cancel()
            self._forget_next = None
        if number and not self._closed:
            until = max(0.0, ended[-number].asked + KEPT - time.monotonic())
            self._forget_next = asyncio.get_running_loop().call_later(until + 1.0, self._forget_old)


def _process(start: Callable[[], Process]) -> Process:
    """A process; where it cannot be started in the usual way it starts from nothing. Raises ``OSError``."""
    try:
        return start()
    except OSError:  # the process of which others are forked has ended, or takes no more
        return spawned()


def _no_process(given: str) -> Answer:
    return _problem(500, Fault("server", "cannot start a process", given, "try again when the machine has room for it"))


def _refused(refused: Refused) -> Answer:
    return _problem(refused.status, *refused.faults)


def _problem(status: int, *faults: Fault) -> Answer:
    response = problems.response(status, faults)
    return Answer(status, problems.MEDIA_TYPE, bytes(response.body))
