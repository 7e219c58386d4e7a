"""The process of one job: it answers one request as the server would, tells how far it is, and ends.

A process can be killed at any time, its processor time is its own, and its memory goes back with it. On Linux it is a
fork of a process that was itself forked from the server before that had threads, so it finds everything loaded;
elsewhere it starts from nothing.
"""

from __future__ import annotations

import asyncio
import contextlib
import math
import os
import pickle
import select
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, NoReturn

from starlette.types import ASGIApp

from ballscrew.faces.web.request_queue import RequestQueue

#: Seconds between two messages on how much has been computed.
EVERY = 0.2
#: Bytes that a process may write to, without its stack and shared memory; and seconds after which the system ends one
#: that does not end itself at its limit.
MOST_MEMORY, GRACE = 2 << 30, 2
#: A lower priority than that of the server, which answers quick requests meanwhile.
_NICE = 5
#: The program of a process that starts from nothing.
_PROGRAM = ("-m", "ballscrew.faces.web.job_program")


@dataclass(frozen=True)
class Asked:
    """A request to an address of the API, with the limit of its processor time in seconds."""

    path: str
    query: str
    body: bytes
    limit: float
    #: The folder for what it writes meanwhile; whoever starts the process removes it.
    folder: str


@dataclass(frozen=True)
class Progress:
    """Amount done and total amount, as the work itself counts them."""

    finished: int
    total: int


@dataclass(frozen=True)
class Row:
    """A part of the answer that is there before the rest, as JSON."""

    document: bytes


@dataclass(frozen=True)
class Computed:
    """Seconds of processor that the job has taken."""

    seconds: float


@dataclass(frozen=True)
class OutOfTime:
    """The limit of processor time was reached."""


@dataclass(frozen=True)
class Answer:
    """The answer of the address."""

    status: int
    media_type: str
    body: bytes


#: The application of the server with these requests. It is given: the server knows the jobs, and not they the server.
Application = Callable[[RequestQueue], ASGIApp]
Message = Progress | Row | Computed | OutOfTime | Answer


class Process:
    """A process that waits for its request: its two pipes, and the way to end it."""

    def __init__(self, requests: IO[bytes], messages: IO[bytes], kill: Callable[[int], None]) -> None:
        self._requests, self._messages, self._kill = requests, messages, kill
        self._lock, self._pid, self._ended = threading.Lock(), 0, False

    def ask(self, asked: Asked) -> None:
        """Send the request; the process begins."""
        pickle.dump(asked, self._requests)
        self._requests.flush()

    def message(self) -> Message | None:
        """The next message; None once the process has ended. It waits, in a thread of its own."""
        try:
            message: Message | int = pickle.load(self._messages)
            while isinstance(message, int):  # the process says first who it is
                with self._lock:
                    self._pid = message
                    if self._ended:
                        self._kill(message)
                message = pickle.load(self._messages)
        except (EOFError, OSError, pickle.UnpicklingError):  # killed meanwhile, perhaps within a message
            return None
        return message

    @property
    def has_begun(self) -> bool:
        """Test whether the process has said who it is: one that could not be forked has not."""
        return self._pid != 0

    def end(self) -> None:
        """Kill the process and those that it has started."""
        with self._lock:
            if not self._ended and self._pid:
                self._kill(self._pid)
            self._ended = True

    def close(self) -> None:
        """Close the pipes, once no message is waited for; a process that still runs ends by itself."""
        for stream in (self._requests, self._messages):
            with contextlib.suppress(OSError):  # what was not sent has no reader any more
                stream.close()


# -- how processes are started ----------------------------------------------------------------------


def spawned() -> Process:
    """A process that starts from nothing."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path or str(Path.cwd()) for path in sys.path)}
    made = subprocess.Popen(
        [sys.executable, "-P", *_PROGRAM],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=environment,
        start_new_session=os.name != "nt",
    )
    assert made.stdin is not None
    assert made.stdout is not None

    def kill(pid: int) -> None:
        if os.name == "nt":
            made.kill()
        else:
            _kill_group(pid)

    threading.Thread(target=made.wait, name="ballscrew job ends", daemon=True).start()
    return Process(made.stdin, made.stdout, kill)


class Forks:
    """Processes that are forks of one process, which is itself a fork of this one as it is now, without threads."""

    def __init__(
        self,
        application: Application,
        *closed: socket.socket,
        rehearsal: Callable[[], Iterator[None]] = lambda: iter(()),
    ) -> None:
        """Fork the process of which others are forked, which answer by the application.

        It closes the sockets, which are for the server alone. While nothing is asked of it it does the steps of the
        rehearsal, so that forks find loaded and recorded what they need.
        """
        here, there = socket.socketpair()
        with warnings.catch_warnings(action="ignore"):  # BLAS has threads; it is made for forks
            pid = os.fork()
        if pid == 0:
            for one in (here, *closed):
                one.close()
            _fork_for_each(there, application, rehearsal)
        there.close()
        self._control, self._lock = here, threading.Lock()

    def __call__(self) -> Process:
        """A new process. Raises ``OSError`` where there can be none.

        Where it cannot be forked its pipes are closed, and it never begins.
        """
        with contextlib.ExitStack() as ours, contextlib.ExitStack() as theirs:
            reading, requests = os.pipe()
            theirs.callback(os.close, reading)
            ours.callback(os.close, requests)
            messages, writing = os.pipe()
            theirs.callback(os.close, writing)
            ours.callback(os.close, messages)
            with self._lock:
                socket.send_fds(self._control, [b"1"], [reading, writing])
            ours.pop_all()
        return Process(os.fdopen(requests, "wb"), os.fdopen(messages, "rb"), _kill_group)


def _fork_for_each(
    control: socket.socket, application: Application, rehearsal: Callable[[], Iterator[None]]
) -> NoReturn:
    """Fork a process for each pair of pipes that comes, until the server ends.

    It never returns into what the server was doing when it forked this, whatever happens.
    """
    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C ends the server, and that ends this
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody asks how they ended
        for _ in rehearsal():
            while select.select([control], [], [], 0)[0]:
                _fork_next(control, application)
        while True:
            _fork_next(control, application)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
    finally:
        os._exit(1)


def _fork_next(control: socket.socket, application: Application) -> None:
    """Fork a process for the next pair of pipes; end with the server."""
    signal_byte, pipes, _, _ = socket.recv_fds(control, 1, 2)
    if not signal_byte:
        os._exit(0)
    if len(pipes) == 2:  # fewer come where this has too many files open
        _fork_one(control, application, pipes)
    for pipe in pipes:
        os.close(pipe)


def _fork_one(control: socket.socket, application: Application, pipes: Sequence[int]) -> None:
    """Fork a process with these pipes; where the system has no room for it the server learns so as they are closed."""
    try:
        with warnings.catch_warnings(action="ignore"):  # as above
            pid = os.fork()
    except OSError as error:
        sys.stderr.write(f"ballscrew: cannot fork a process for a job: {error.strerror}\n")
        sys.stderr.flush()
        return
    if pid == 0:
        control.close()
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        os.setsid()
        answer_one(application, *(os.fdopen(pipe, mode) for pipe, mode in zip(pipes, ("rb", "wb"), strict=True)))


def _kill_group(pid: int) -> None:
    with contextlib.suppress(ProcessLookupError):  # it has ended by itself meanwhile
        os.killpg(pid, signal.SIGKILL)


# -- the process itself -----------------------------------------------------------------------------


def answer_one(application: Application, requests: IO[bytes], messages: IO[bytes]) -> NoReturn:
    """Answer the request that comes by the application, and end."""
    lock = threading.Lock()

    def tell(message: Message | int) -> None:
        with lock:
            try:
                pickle.dump(message, messages)
                messages.flush()
            except OSError:  # the server has ended
                os._exit(1)

    tell(os.getpid())
    try:
        asked: Asked = pickle.load(requests)
    except EOFError:  # the server has ended, or needs it no more
        os._exit(1)
    with contextlib.suppress(AttributeError, OSError):  # not on every system
        os.nice(_NICE)
    start = computed()
    _limit(asked.limit)
    for watch in (lambda: _end_with(requests), lambda: _count(asked.limit, start, tell)):
        threading.Thread(target=watch, daemon=True).start()
    try:
        tempfile.tempdir = asked.folder
        answer = asyncio.run(answered(application, asked, tell))
        tell(Computed(computed() - start))
        tell(answer)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
    os._exit(0)  # nothing that libraries left is waited for


def _limit(seconds: float) -> None:
    """Let the system limit memory and processor time, also of work that never looks at the clock."""
    if sys.platform == "win32":  # it has no such limits; the watch of the time is there
        return
    import resource

    with contextlib.suppress(ValueError, OSError):  # a lower limit holds already
        resource.setrlimit(resource.RLIMIT_DATA, (MOST_MEMORY, MOST_MEMORY))
    if seconds < sys.maxsize:
        most = math.ceil(computed() + seconds) + GRACE
        with contextlib.suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_CPU, (most, most))


def computed() -> float:
    """Seconds of processor of this process, on all processors, and of those that it has started and that ended."""
    times = os.times()
    return time.process_time() + times.children_user + times.children_system


def _end_with(requests: IO[bytes]) -> None:
    """End as soon as the server closes the pipe, or ends."""
    requests.read(1)
    os._exit(1)


def _count(limit: float, start: float, tell: Callable[[Message], None]) -> None:
    """Tell how much was computed, and end at the limit."""
    while True:
        time.sleep(EVERY)
        seconds = computed() - start
        tell(Computed(seconds))
        if seconds > limit:
            tell(OutOfTime())
            os._exit(1)


async def answered(application: Application, asked: Asked, tell: Callable[[Message], None]) -> Answer:
    """The answer of the application, called as by a server."""
    queue = RequestQueue(
        time_limit=float("inf"),
        progress=lambda finished, total: tell(Progress(finished, total)),
        row=lambda document: tell(Row(document)),
    )
    bodies = [asked.body]
    started: dict[str, Any] = {}
    parts: list[bytes] = []

    async def receive() -> dict[str, Any]:
        if bodies:
            return {"type": "http.request", "body": bodies.pop(), "more_body": False}
        await asyncio.Event().wait()  # the process is killed where nobody waits for the answer
        raise AssertionError

    async def send(message: Any) -> None:
        if message["type"] == "http.response.start":
            started.update(message)
        else:
            parts.append(message.get("body", b""))

    scope = {
        "type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "method": "POST", "scheme": "http",
        "path": asked.path, "raw_path": asked.path.encode(), "query_string": asked.query.encode(), "root_path": "",
        "headers": [(b"host", b"localhost"), (b"content-type", b"application/json")],
    }  # fmt: skip
    try:
        await application(queue)(scope, receive, send)
    except Exception:
        if not started:
            raise
        traceback.print_exc()  # a defect, which the application has answered for
        sys.stderr.flush()
    headers = {name.decode().lower(): value.decode() for name, value in started["headers"]}
    return Answer(started["status"], headers["content-type"], b"".join(parts))
