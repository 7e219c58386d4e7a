"""Processes that try inputs: one that dies, hangs or takes all memory is a wrong outcome, not the end of the run."""

from __future__ import annotations

import multiprocessing
import os
import resource
import tempfile
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path

from benchmarks.hostile.tally import Outcome, Tally

from ballscrew import ImplausibleInput, InputError

#: This process has threads, which a fork would not.
_PROCESSES = multiprocessing.get_context("forkserver")
AT_ONCE = 2
#: Seconds for one attempt; it takes some at most.
MOST_SECONDS = 30.0
#: Bytes of address space of a process.
MOST_MEMORY = 6 << 30
#: Attempts that are given out at a time.
AT_A_TIME = 20

#: ``(seed, number of the attempt, inputs)`` to its outcome.
Attempt = Callable[[int, int, int], Outcome]

_folder = Path()


def folder() -> Path:
    """The folder for files of this process."""
    found = _folder / str(os.getpid())
    found.mkdir(exist_ok=True)
    return found


def last_line(error: BaseException) -> str:
    """An exception and the line of code that raised it, in one line."""
    frame = traceback.extract_tb(error.__traceback__)[-1]
    words = " ".join(str(error).split())
    return f"{type(error).__name__}: {words[:200]} ({Path(frame.filename).name}:{frame.lineno})"


def judged(words: str, work: Callable[[], str]) -> Outcome:
    """The outcome of work that says what is wrong, or raises ``InputError`` to refuse its input, and nothing else."""
    try:
        wrong = work()
    except InputError:
        return Outcome(refused=1)
    except Exception as error:
        wrong = last_line(error)
    return Outcome(wrong=[f"{words}: {wrong}"]) if wrong else Outcome(answered=1)


def faults_of_command(code: int, said: str) -> list[str]:
    """What is wrong with the end of a command: a traceback, an exit code of its own, a refusal without a word."""
    last = (said.strip().splitlines() or [""])[-1][:200]
    if code not in (0, 2) or "Traceback" in said:
        return [f"ended with {code}: {last}"]
    return [] if code == 0 or last else ["refused without a word"]


def use(place: str) -> None:
    """Take a folder for the files of this process and of those that it starts."""
    global _folder
    _folder = Path(place)


def prepare(place: str) -> None:
    """Set up a process: warnings of NumPy are errors, those of implausible input are not said, memory has a limit."""
    use(place)
    warnings.simplefilter("error", RuntimeWarning)
    warnings.simplefilter("ignore", ImplausibleInput)  # what is hostile is implausible, too
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, hard))


def _guarded(attempt: Attempt, seed: int, number: int, size: int) -> Outcome:
    try:
        return attempt(seed, number, size)
    except Exception as error:
        return Outcome(wrong=[f"attempt {number}: {last_line(error)}"] * size)


def run(attempt: Attempt, tally: Tally, seed: int, size: int = 1) -> None:
    """Make attempts of ``size`` inputs each until all are tried or the time is up."""
    number = 0
    with tempfile.TemporaryDirectory() as place:
        while tally.left:
            with _PROCESSES.Pool(AT_ONCE, initializer=prepare, initargs=(place,)) as pool:
                lost = False
                while tally.left and not lost:
                    sizes = _sizes(tally.left, size)
                    asked = [
                        (number + i, n, pool.apply_async(_guarded, (attempt, seed, number + i, n)))
                        for i, n in enumerate(sizes)
                    ]
                    number += len(sizes)
                    for each, n, promised in asked:
                        try:
                            tally.add(promised.get(MOST_SECONDS))
                        except multiprocessing.TimeoutError:
                            lost = True
                            tally.add(Outcome(wrong=[f"attempt {each}: dead or silent for {MOST_SECONDS:g} s"] * n))


def _sizes(left: int, size: int) -> list[int]:
    """Inputs of the next attempts."""
    given = min(left, AT_A_TIME * size)
    return [min(size, given - first) for first in range(0, given, size)]
