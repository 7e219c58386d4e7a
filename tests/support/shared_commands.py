"""One process for all workers of a run, whose forks run their commands: to load what it has takes seven seconds."""

import os
import shutil
import sys
import tempfile
from pathlib import Path

import pytest

from .commands import FORK_SERVER, ROOT, Commands

#: The variable that tells workers the folder of their run.
FOLDER = "BALLSCREW_TESTS"


def hold(config: pytest.Config) -> None:
    """Make the folder of a run, and hold the input of the process until the run ends: it ends with its input."""
    if not hasattr(os, "mkfifo"):  # Windows, which has no forks either
        return
    folder = Path(tempfile.mkdtemp(prefix="ballscrew-tests-"))
    os.mkfifo(folder / "input")
    held = os.open(folder / "input", os.O_RDWR)
    os.environ[FOLDER] = str(folder)
    config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))
    config.add_cleanup(lambda: os.close(held))


class SharedCommands(Commands):
    """Commands of the process of a run; the first worker that asks starts it."""

    def __init__(self) -> None:
        import fcntl

        folder = Path(os.environ[FOLDER])
        self._address = str(folder / "socket")
        with (folder / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not Path(self._address).exists():
                _start(folder, self._address)


def _start(folder: Path, address: str) -> None:
    """Start the process and wait until it listens. It may outlive this worker, which so keeps no ``Popen`` of it."""
    said, output = os.pipe()
    streams = os.open(folder / "input", os.O_RDONLY), output
    os.posix_spawn(
        sys.executable,
        [sys.executable, str(FORK_SERVER), address, str(ROOT / "examples"), str(folder)],
        os.environ,
        file_actions=[(os.POSIX_SPAWN_DUP2, stream, place) for place, stream in enumerate(streams)],
    )
    for stream in streams:
        os.close(stream)
    with os.fdopen(said, encoding="utf-8") as words:
        assert words.readline() == "ready\n"
