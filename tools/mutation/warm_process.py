"""Tests in forks of a process that has loaded the libraries they need, but nothing of ballscrew and of the tests.

pytest and the libraries take most of the time in which a change is tried: a fork has them at once.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

LIBRARIES = [
    "fastapi", "httpx", "hypothesis.extra.numpy", "llvmlite.binding", "matplotlib.figure", "matplotlib.pyplot", "pint",
    "pydantic", "pytest", "schemathesis.pytest.plugin", "scipy.integrate", "scipy.interpolate", "scipy.optimize",
    "scipy.signal", "scipy.sparse", "scipy.special", "scipy.stats", "sympy", "typer.testing", "xarray", "zarr",
]  # fmt: skip
_PROCESSES = multiprocessing.get_context("forkserver")
_PROCESSES.set_forkserver_preload(LIBRARIES)
# set before BLAS is loaded, as the tests do
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


class Ended(NamedTuple):
    """A run of tests: its exit code, None where it took longer than it may, and what it printed."""

    code: int | None
    printed: str


def run_pytest(arguments: Sequence[str], source: Path, limit: float) -> Ended:
    """Run pytest with this ``source`` of the package, for as many seconds as ``limit`` at most."""
    with tempfile.NamedTemporaryFile("w+", encoding="utf-8") as printed:
        process = _PROCESSES.Process(target=_run, args=(list(arguments), str(source), printed.name))
        process.start()
        process.join(limit)
        code = process.exitcode
        if code is None and process.pid is not None:
            os.killpg(process.pid, signal.SIGKILL)  # with what the tests have started
            process.join()
        printed.seek(0)
        return Ended(code, printed.read())


def _run(arguments: list[str], source: str, printed: str) -> None:
    os.setsid()
    with Path(printed).open("w", encoding="utf-8") as file, Path(os.devnull).open(encoding="utf-8") as nothing:
        os.dup2(nothing.fileno(), 0)
        for stream in (1, 2):
            os.dup2(file.fileno(), stream)
    # Python finds this copy before the one that is installed, in the processes that tests start, too
    sys.path.insert(0, source)
    os.environ["PYTHONPATH"] = source
    import pytest

    code = pytest.main(arguments)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
