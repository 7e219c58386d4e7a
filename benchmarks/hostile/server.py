"""A server of its own in a process, and what it may not do."""

from __future__ import annotations

import contextlib
import subprocess
import tempfile
from collections.abc import Iterator, Mapping

from benchmarks import serve
from benchmarks.hostile.tally import Outcome, Tally

#: Headers of every answer.
REQUIRED = ("content-security-policy", "x-content-type-options", "referrer-policy")
#: Seconds for an answer; the server stops work after 20.
MOST_SECONDS = 60.0


@contextlib.contextmanager
def started(tally: Tally) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A server and its address; that it dies, does not end or writes to standard error is wrong."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as errors:
        with serve.server("-W", "error::RuntimeWarning", errors=errors) as (process, address):
            yield process, address
            if process.poll() is not None:
                tally.add(Outcome(wrong=[f"the server is dead: {process.returncode}"]))
        code = process.returncode
        errors.seek(0)
        if code or (said := errors.read().strip()):
            lines = "" if code else said.splitlines()[-1]
            tally.add(Outcome(wrong=[f"the server ended with {code}, and wrote to standard error: {lines}"]))


def wrong_answer(status: int, headers: Mapping[str, str]) -> str:
    """Words on an answer that no request may get; empty for the others."""
    missing = [name for name in REQUIRED if name not in headers]
    if status >= 500:
        return f"status {status}"
    return f"status {status} without {', '.join(missing)}" if missing else ""
