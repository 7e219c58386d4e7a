"""Which engine evaluates: NumPy for little work, a compiled kernel for much."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from ballscrew.basis.errors import Fault
from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.tracing.program import Program

#: What can evaluate a plan.
Engine = Literal["numpy", "compiled"]
ENGINES: tuple[Engine, ...] = ("numpy", "compiled")
#: What can evaluate a sweep: also the model itself, which up to :data:`FEW_POINTS` is quicker than recording it first.
SweepEngine = Literal["numpy", "compiled", "model"]
SWEEP_ENGINES: tuple[SweepEngine, ...] = (*ENGINES, "model")
FEW_POINTS = 4096

#: What NumPy needs for one step at one point, on two threads, and the steps of a program whose buffers
#: begin to outgrow the cache; and what a kernel costs before its first point if it has to be compiled.
#: Only the choice of an engine depends on these numbers, so that they need not be exact.
NUMPY_STEP_SECONDS, STEPS_IN_CACHE = 2.5e-10, 5000
COMPILING_SECONDS, COMPILING_STEP_SECONDS = 0.05, 1.2e-4
#: Points of a structure that have to be asked for, in one call or in several, before a kernel is compiled for it; and
#: points of one call beyond which a kernel of just this call pays, whose constants are folded.
ENOUGH_TO_COMPILE, ENOUGH_TO_FOLD = 20_000, 4_000_000
#: What NumPy does in less than this is left to it: as long takes it to load the compiler.
SHORT_SECONDS = 0.1


def engine_faults(section: str, engine: str | None, engines: Sequence[str] = ENGINES) -> list[Fault]:
    """Faults of a requested engine."""
    if engine is not None and engine not in engines:
        return [Fault(f"{section}.engine", "unknown engine", str(engine), f"one of {', '.join(engines)}")]
    if engine == "compiled" and not kernel.available():
        remedy = 'pip install "ballscrew[fast]", or leave the engine out'
        return [Fault(f"{section}.engine", "needs a compiler that is not installed", engine, remedy)]
    return []


#: Why an engine evaluates: see :func:`why_numpy`.
ASKED_FOR = "it was asked for"
PAYS = "that is sooner done than by NumPy, compiling included"
KNOWN = "a kernel for all numbers of such a screw is there"


def why_numpy(engine: Engine | None) -> str:
    """Reason for NumPy where a kernel could be recorded."""
    if engine == "numpy":
        return ASKED_FOR
    if not kernel.available():
        return 'no compiler is installed: pip install "ballscrew[fast]"'
    return "the work is too short for a compiler"


def may_be_compiled(program: Program, points: int, engine: Engine | None) -> bool:
    """True where a kernel is requested or the work is long enough."""
    if engine == "numpy" or not kernel.available():
        return False
    return engine == "compiled" or _numpy_seconds(program, points) > SHORT_SECONDS


def worth_compiling(program: Program, points: int, text: str, *, anew: bool = False) -> bool:
    """True where a kernel is faster than NumPy: already compiled, unless that may not count, or worth its compile time.

    With ``anew`` it is said as where nothing is compiled yet.
    """
    if not anew and kernel.is_cached(text):
        return True
    return _numpy_seconds(program, points) > COMPILING_SECONDS + COMPILING_STEP_SECONDS * len(program.steps)


def _numpy_seconds(program: Program, points: int) -> float:
    steps = len(program.steps)
    return NUMPY_STEP_SECONDS * steps * (1 + steps / STEPS_IN_CACHE) * points
