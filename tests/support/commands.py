"""The command line for tests: processes that have their libraries at once, or start from nothing."""

from __future__ import annotations

import array
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]
FORK_SERVER = Path(__file__).with_name("fork_server.py")

#: Warnings of libraries that end any command: where they are due, an answer says in words what has no value.
ERRORS = ("Warning",)

_SMALL_FILES = """
import os, resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))
os.environ["PYTHONDONTWRITEBYTECODE"] = "1"  # else bytecode of libraries is cut, too, and stays
os.execv(sys.argv[1], sys.argv[1:])
"""


def with_small_files(program: Sequence[object]) -> list[str]:
    """The program in a process whose files end at 10 kB, which stands for a full disk."""
    return [sys.executable, "-c", _SMALL_FILES, *map(str, program)]


class Process:
    """A running fork; the part of ``subprocess.Popen`` that tests need."""

    def __init__(self, pid: int, connection: socket.socket) -> None:
        self.pid = pid
        self.returncode: int | None = None
        self._connection = connection

    def poll(self) -> int | None:
        """The exit code, or nothing while it runs."""
        return self._ended(0)

    def wait(self, timeout: float | None = None) -> int:
        """The exit code, as soon as there is one."""
        code = self._ended(timeout)
        if code is None:
            raise subprocess.TimeoutExpired(f"process {self.pid}", timeout or 0)
        return code

    def send_signal(self, number: int) -> None:
        if self.poll() is None:
            os.kill(self.pid, number)

    def kill(self) -> None:
        self.send_signal(signal.SIGKILL)

    def terminate(self) -> None:
        self.send_signal(signal.SIGTERM)

    def _ended(self, timeout: float | None) -> int | None:
        if self.returncode is None:
            self._connection.settimeout(timeout)
            try:
                said = self._connection.recv(16)
            except (TimeoutError, BlockingIOError):
                return None
            self._connection.close()
            self.returncode = int(said)
        return self.returncode


class Commands:
    """Runs commands of the program as forks of a process that has loaded it; `shared_commands` has that of a run."""

    def __init__(self, server: Path = FORK_SERVER, path: Sequence[Path] = ()) -> None:
        """``server``: the program that loads libraries and forks; ``path``: where else it finds modules."""
        self._folder = Path(tempfile.mkdtemp(prefix="ballscrew-tests-"))
        self._address = str(self._folder / "socket")
        found = [*map(str, path), *filter(None, [os.environ.get("PYTHONPATH")])]
        self._server = subprocess.Popen(
            [sys.executable, str(server), self._address, str(ROOT / "examples"), str(self._folder)],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(found)} if path else None,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            encoding="utf-8",
        )
        assert self._server.stdout is not None
        assert self._server.stdout.readline() == "ready\n"

    def start(
        self,
        arguments: Sequence[object],
        *,
        folder: Path,
        streams: Sequence[int],
        environment: Mapping[str, str] | None = None,
        module: str = "ballscrew.faces.cli",
        errors: Sequence[str] = ERRORS,
        lines: bool = False,
    ) -> Process:
        """A command that runs with these three streams; with ``errors``, categories of warnings that end it.

        ``lines``: it prints line by line, as on a terminal.
        """
        asked = {
            "module": module,
            "arguments": [str(argument) for argument in arguments],
            "folder": str(folder),
            "environment": {**os.environ, **(environment or {})},
            "errors": list(errors),
            "lines": lines,
        }
        text = json.dumps(asked).encode()
        connection = socket.socket(socket.AF_UNIX)
        connection.connect(self._address)
        rights = [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", streams))]
        connection.sendmsg([b"%08d" % len(text)], rights)
        connection.sendall(text)
        pid = b""
        while not pid.endswith(b"\n"):
            pid += connection.recv(1)
        return Process(int(pid), connection)

    def run(
        self,
        arguments: Sequence[object],
        *,
        folder: Path,
        environment: Mapping[str, str] | None = None,
        module: str = "ballscrew.faces.cli",
        errors: Sequence[str] = ERRORS,
        timeout: float | None = 300,
    ) -> subprocess.CompletedProcess[str]:
        """Run a command to its end: what it printed, and its exit code."""
        with (
            Path(os.devnull).open("rb") as nothing,
            tempfile.TemporaryFile() as output,
            tempfile.TemporaryFile() as complaints,
        ):
            process = self.start(
                arguments,
                folder=folder,
                streams=[nothing.fileno(), output.fileno(), complaints.fileno()],
                environment=environment,
                module=module,
                errors=errors,
            )
            try:
                code = process.wait(timeout)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                raise
            texts = []
            for stream in (output, complaints):
                stream.seek(0)
                texts.append(stream.read().decode("utf-8", "replace").replace("\r\n", "\n"))
        return subprocess.CompletedProcess(list(arguments), code, *texts)

    def together(
        self,
        arguments: Sequence[object],
        folder: Path,
        environment: Mapping[str, str],
        module: str = "ballscrew.faces.cli",
    ) -> tuple[int, str]:
        """Exit code of a command, and all that it printed, as on a terminal."""
        with Path(os.devnull).open("rb") as nothing, tempfile.TemporaryFile() as output:
            streams = [nothing.fileno(), output.fileno(), output.fileno()]
            process = self.start(
                arguments, folder=folder, streams=streams, environment=environment, module=module, lines=True
            )
            code = process.wait()
            output.seek(0)
            return code, output.read().decode()

    def close(self) -> None:
        """End the process that the commands are forks of."""
        self._server.communicate()
        shutil.rmtree(self._folder, ignore_errors=True)


def new_process(
    arguments: Sequence[object], *, folder: Path, environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run a command in a process that starts from nothing: where encodings, imports or the interpreter matter."""
    return subprocess.run(
        [sys.executable, "-m", "ballscrew.faces.cli", *map(str, arguments)],
        capture_output=True,
        check=False,
        cwd=folder,
        encoding=(environment or {}).get("PYTHONIOENCODING", "utf-8"),
        errors="replace",
        env={**os.environ, **(environment or {})},
    )
