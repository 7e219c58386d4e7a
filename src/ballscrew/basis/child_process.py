"""Work in a process of its own, with limits on its memory and time: code that may crash, or keep memory for good.

The process starts from nothing, imports the module of the function and ends with it. The module should import little.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

Result = TypeVar("Result")

#: Bytes of memory that a process may have, and seconds that it may take.
MEMORY, SECONDS = 2 << 30, 300.0
_PROGRAM = "from ballscrew.basis.child_process import main; main()"
#: What the allocator of Rust and that of C++ write before they abort the process.
_OUT_OF_MEMORY = (b"memory allocation of", b"bad_alloc")


class ChildError(Exception):
    """The reason why work in a process of its own gave no result, in words."""


class OutOfMemory(ChildError):
    """The limit of memory was reached."""

    def __init__(self, memory: int) -> None:
        super().__init__(memory)
        self.memory = memory

    def __str__(self) -> str:
        return f"needs more than {self.memory / 2**30:g} GiB of memory"


def call(function: Callable[..., Result], *arguments: object, memory: int = MEMORY, seconds: float = SECONDS) -> Result:
    """The result of a function of a module, called in a process of its own.

    ``memory`` is the limit of its address space in bytes, where the system has such limits, and ``seconds`` that of its
    time. Raises :class:`ChildError` if the function raises, the process crashes, or a limit is reached.
    """
    # it finds the same modules; one thread of BLAS, because each reserves address space
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(path or str(Path.cwd()) for path in sys.path),
        "OPENBLAS_NUM_THREADS": "1",
    }
    try:
        process = subprocess.run(
            [sys.executable, "-P", "-c", _PROGRAM],
            input=pickle.dumps((memory, function, arguments)),
            capture_output=True,
            check=False,
            timeout=seconds,
            env=environment,
        )
    except subprocess.TimeoutExpired:
        raise ChildError(f"takes longer than {seconds:g} s") from None
    if process.returncode == 0:
        result, error = pickle.loads(process.stdout)
        if error is None:
            return result
        raise error
    if any(text in process.stderr for text in _OUT_OF_MEMORY):
        raise OutOfMemory(memory)
    raise ChildError(f"crashes its reader: {_ending(process.returncode)}")


def _ending(code: int) -> str:
    names = {int(number): number.name for number in signal.Signals}
    return names.get(-code, f"exit code {code}")


def main() -> None:
    """The program of the process: read a call from standard input, write its result to standard output."""
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever libraries print
    memory, function, arguments = pickle.load(sys.stdin.buffer)
    _limit(memory)
    try:
        written = pickle.dumps((function(*arguments), None), pickle.HIGHEST_PROTOCOL)
    except MemoryError:
        written = pickle.dumps((None, OutOfMemory(memory)))
    except BaseException as error:  # a panic of Rust is no Exception
        written = pickle.dumps((None, ChildError(str(error) or type(error).__name__)))
    output.write(written)
    output.flush()
    os._exit(0)  # what is left to be freed may be damaged


def _limit(memory: int) -> None:
    try:
        import resource
    except ImportError:  # Windows
        return
    for name, limit in ((resource.RLIMIT_AS, memory), (resource.RLIMIT_CORE, 0)):
        _, most = resource.getrlimit(name)
        with contextlib.suppress(ValueError, OSError):  # some systems name limits that cannot be set
            resource.setrlimit(name, (limit if most == resource.RLIM_INFINITY else min(limit, most), most))
