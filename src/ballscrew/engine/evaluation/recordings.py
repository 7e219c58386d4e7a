"""Recordings that are kept in this process: what is recorded once is not recorded, nor written as assembly, again.

The key of a recording holds all that it depends on, by value: the numbers and the laws of the parts, the names of the
inputs and the outputs. A law of this package that is a function counts as itself. Of a law from outside it cannot be
known quickly whether it computes what it did (its globals, closures and attributes may change), so a model with one is
recorded anew each time. A number that is the same at all points is a constant of the recording and part of its key:
folded, it costs nothing at any point. Who changes it call by call makes it an input, of an axis or of
:func:`~ballscrew.engine.evaluation.evaluator.evaluator`.

Which engine evaluates: NumPy for little work, a compiled kernel for much.
"""

from __future__ import annotations

import dataclasses
import enum
import functools
import sys
import threading
import types
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping, Sequence
from itertools import chain
from typing import Any, Literal, TypeVar

import numpy as np

from ballscrew.basis.errors import Fault
from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.tracing.grid import Split, split
from ballscrew.compiler.tracing.program import Program, Source

#: Most recordings that are kept, and most steps of all of them together, some 600 bytes each (assembly aside).
MOST_RECORDINGS, MOST_STEPS = 256, 150_000
#: Most recordings by structure.
MOST_STRUCTURES = 16
#: An array with more numbers than this in a part is not compared call by call.
MOST_NUMBERS = 1000

T = TypeVar("T")

_PACKAGE = __name__.partition(".")[0]
#: The rooms whose functions and constants are in a recording.
_ROOMS = tuple(
    f"{_PACKAGE}.{room}"
    for room in ("physics.equations", "physics.components", "physics.solvers", "physics.friction", "compiler.tracing")
)
_PLAIN = frozenset({int, bool, str, bytes, type(None)})


class UnknownPartError(Exception):
    """A part of which it is not known whether it computes the same each time; what it is in is not kept."""


class Recording:
    """A program, and what has been made of it: its cut along a grid, and its assembly."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._cuts: dict[tuple[int, ...], Split] = {}
        self._texts: dict[Hashable, str] = {}
        self._made: dict[str, Any] = {}

    def once(self, name: str, make: Callable[[], T]) -> T:
        """Something else that is made of the program once."""
        if name not in self._made:
            self._made[name] = make()
        return self._made[name]

    def cut(self, groups: Sequence[int]) -> Split:
        """The program cut along rows and columns."""
        key = tuple(groups)
        if key not in self._cuts:
            self._cuts[key] = split(self.program, groups)
        return self._cuts[key]

    def text(
        self, program: Program, sources: Sequence[Source], masks: Mapping[str, bool], *, watched: bool = False
    ) -> str:
        """The assembly of the program, or of its cut."""
        key = program is self.program, tuple(sources), tuple(masks.items()), watched
        if key not in self._texts:
            self._texts[key] = kernel_text(program, sources, masks, watched=watched)
        return self._texts[key]


def recording(key: Callable[[], Any], record: Callable[[], Program]) -> Recording:
    """A recording that was made with an equal key, or a new one.

    ``key`` returns all that the recording depends on; where that cannot be compared, nothing is kept.
    """
    try:
        held = key_of(key())
    except UnknownPartError:
        return Recording(record())
    return _kept.get(held) or _kept.add(held, Recording(record()))


class Structures:
    """Recordings of which all numbers are inputs, by structure: they serve every case of a kind, and are not dropped.

    It is counted how much was asked for of each structure.
    """

    #: How many recordings were made.
    made = 0

    def __init__(self) -> None:
        self._kept = _Kept(most=MOST_STRUCTURES)
        self._lock = threading.Lock()
        self._asked: OrderedDict[Hashable, int] = OrderedDict()

    def get(self, key: Hashable) -> Recording | None:
        """The recording of a structure."""
        return self._kept.get(key)

    def add(self, key: Hashable, program: Program) -> Recording:
        """Keep the recording of a structure."""
        Structures.made += 1
        return self._kept.add(key, Recording(program))

    def asked(self, key: Hashable, work: int) -> int:
        """Count work of a structure that was asked for, and return all of it."""
        with self._lock:
            total = self._asked.pop(key, 0) + work
            self._asked[key] = total
            if len(self._asked) > MOST_RECORDINGS:
                self._asked.popitem(last=False)
            return total


class _Kept:
    """The recordings that were used last, as long as the package stays as it was."""

    def __init__(self, most: int = MOST_RECORDINGS) -> None:
        self._most = most
        self._lock = threading.Lock()
        self._found: OrderedDict[Hashable, Recording] = OrderedDict()
        self._steps = 0
        self._modules: tuple[int, list[types.ModuleType]] = 0, []
        self._identities: tuple[int, ...] = ()
        self._items: list[Any] = []

    def get(self, key: Hashable) -> Recording | None:
        with self._lock:
            self._forget_if_the_package_changed()
            if key in self._found:
                self._found.move_to_end(key)
            return self._found.get(key)

    def add(self, key: Hashable, made: Recording) -> Recording:
        """Keep a recording, and return it, or that of another thread which was sooner."""
        with self._lock:
            if key not in self._found:
                self._found[key] = made
                self._steps += len(made.program.steps)
            while len(self._found) > 1 and (len(self._found) > self._most or self._steps > MOST_STEPS):
                _, oldest = self._found.popitem(last=False)
                self._steps -= len(oldest.program.steps)
            return self._found[key]

    def clear(self) -> None:
        with self._lock:
            self._found.clear()
            self._steps = 0

    def _forget_if_the_package_changed(self) -> None:
        """Drop all where a function or a constant of a module was replaced, as by a test or by ``reload``."""
        count, modules = self._modules
        if count != len(sys.modules):
            modules = [module for name, module in list(sys.modules.items()) if name.startswith(_ROOMS)]
            self._modules = len(sys.modules), modules
        spaces = [vars(module).values() for module in modules]
        identities = tuple(map(id, chain.from_iterable(spaces)))
        if identities != self._identities:
            # what is held here keeps its identity, so that equal identities are the same items
            self._identities, self._items = identities, list(chain.from_iterable(spaces))
            self._found.clear()
            self._steps = 0


_kept = _Kept()


class _AsImported:
    """Test of whether functions and constants that recordings follow from are still those that were imported."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        #: By module and name, what stood there first: kept, so that its identity is not used again.
        self._first: dict[tuple[str, str], Any] = {}
        self._count, self._modules = 0, list[types.ModuleType]()
        self._identities: tuple[int, ...] = ()
        self._holds = True

    def holds(self) -> bool:
        """False where a function or a constant was replaced, as by a test; by its source it is another package."""
        with self._lock:
            if len(sys.modules) != self._count:
                self._count = len(sys.modules)
                self._modules = [module for name, module in list(sys.modules.items()) if name.startswith(_ROOMS)]
            identities = tuple(map(id, chain.from_iterable([vars(module).values() for module in self._modules])))
            if identities != self._identities:
                self._holds = True
                for module in self._modules:
                    for name, value in list(vars(module).items()):  # all of them, as some are new
                        self._holds &= self._is_first(module.__name__, name, value)
                self._identities = identities
            return self._holds

    def _is_first(self, module: str, name: str, value: Any) -> bool:
        if name.startswith("__"):
            return True
        first = self._first.setdefault((module, name), value)
        return first is value


_as_imported = _AsImported()


def is_as_imported() -> bool:
    """True where the package computes what its source says, so that what other processes kept holds here."""
    return _as_imported.holds()


is_as_imported()  # what is imported by now stood there first


def forget() -> None:
    """Drop all recordings that are kept."""
    _kept.clear()


def key_of(value: Any) -> Hashable:
    """A value as a key: equal keys are values of which the same is computed, to the last bit.

    Raises :class:`UnknownPartError` where that cannot be said.
    """
    kind = type(value)
    if kind is float:
        return value.hex()  # zeros by their signs, and NaN as itself
    if kind in _PLAIN:
        return kind, value
    if kind is types.FunctionType and _is_own(value):
        return value
    if kind is np.float64:
        return kind, float(value).hex()
    if isinstance(value, np.generic | np.ndarray):
        return _key_of_numbers(value)
    if kind in (tuple, list):
        return kind, *map(key_of, value)
    if kind in (dict, types.MappingProxyType):
        return kind, *((key_of(name), key_of(held)) for name, held in value.items())
    if isinstance(value, type) and _is_own(value):
        return value
    if _is_own(kind):
        if dataclasses.is_dataclass(value):  # what else it holds is computed from these
            return kind, *[key_of(getattr(value, name)) for name in _names(kind)]
        if isinstance(value, tuple):
            return kind, *map(key_of, value)
        if isinstance(value, enum.Enum):
            return value
    raise UnknownPartError(kind.__qualname__)


def _key_of_numbers(value: Any) -> Hashable:
    if value.dtype.hasobject or value.size > MOST_NUMBERS or type(value).__module__ != "numpy":
        raise UnknownPartError("a large array, or one of objects")
    return type(value), value.dtype.str, value.shape, value.tobytes()


@functools.cache
def _names(kind: Any) -> tuple[str, ...]:
    return tuple(field.name for field in dataclasses.fields(kind))


def _is_own(item: Any) -> bool:
    """True for a function or a class that this package has under its name: not for one made in a call, or replaced."""
    module = item.__module__
    if not isinstance(module, str) or not module.startswith(f"{_PACKAGE}."):
        return False
    if isinstance(item, types.FunctionType) and not item.__globals__["__name__"].startswith(f"{_PACKAGE}."):
        return False  # one from outside that took the name of what it wraps
    result: Any = sys.modules.get(module)
    for name in item.__qualname__.split("."):
        result = getattr(result, name, None)
    return result is item


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
