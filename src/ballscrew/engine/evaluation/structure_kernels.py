"""Kernels of structures: compiled once on a machine, for every case of a kind, whichever of its inputs vary.

Each input is one number or an array, as a call says, so that no text depends on which of them vary
(:mod:`ballscrew.engine.evaluation.structures` has what is recorded). A kernel is kept on disk beside all others, with a
header that says what it reads and writes: another process finds it without recording the model. It goes by a digest of
the structure, of the source of this package that it follows from, of the processor and of the compiler.
"""

from __future__ import annotations

import contextlib
import enum
import hashlib
import json
import math
import threading
import types
from collections import OrderedDict
from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.kernels.emission import FEWEST_LANES, UnknownOperationError, kernel_text
from ballscrew.compiler.kernels.kernel import Kernel
from ballscrew.compiler.tracing.gradient import UnknownDerivativeError
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Interpreter, Program, Source
from ballscrew.compiler.tracing.tape import CannotRecordError, Tape
from ballscrew.engine.evaluation.fingerprint import recorder_digest, stands_as_imported
from ballscrew.engine.evaluation.outputs import OPERATION, known_outputs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import Structures, is_as_imported
from ballscrew.engine.evaluation.structures import (
    ENOUGH_TO_COMPILE,
    OF_STATE,
    inputs_of_structure,
    numbers_alone,
    outputs_of_structure,
    own_name,
    recorded_structure,
    structure_key,
)

#: Points of a vector: more take four times as long to compile, and are no faster where all numbers are inputs.
LANES = FEWEST_LANES
#: Beyond so many steps the code is not optimised: that takes a seventh of the time, and runs 1.6 times as long.
MOST_STEPS_OPTIMISED = 30_000
#: Points of a block: what is computed beside what was asked for stays in the cache.
BLOCK_OF_POINTS = 2**13
#: Most kernels of structures in memory.
MOST_IN_MEMORY = 64


class Layout(NamedTuple):
    """What a kernel reads and writes."""

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    #: Whether each output is a truth value.
    masks: tuple[bool, ...]
    constants: Mapping[str, Any]
    lanes: int
    #: A digest of all formulas as they are evaluated.
    formulas: str


class StructureKernel:
    """The compiled kernel of a structure; calls from several threads do not disturb each other."""

    def __init__(self, layout: Layout, machine_code: bytes) -> None:
        self.layout = layout
        self.place = {name: i for i, name in enumerate(layout.inputs)}
        sources: list[Source] = ["strided"] * len(layout.inputs)
        self.kernel = Kernel(machine_code, sources)

    def table(self, values: Mapping[str, float]) -> NDArray[np.float64]:
        """The numbers of the inputs, each as a vector; what ``values`` does not name is NaN."""
        numbers = [values.get(name, math.nan) for name in self.layout.inputs]
        return np.repeat(np.array(numbers, dtype=float)[:, None], self.layout.lanes, axis=1)

    def fill(
        self, table: NDArray[np.float64], arrays: Mapping[str, NDArray[np.float64]], results: Mapping[str, NDArray[Any]]
    ) -> None:
        """Evaluate points into arrays of some of the outputs: inputs are numbers of a table, or arrays by name."""
        count = len(next(iter(results.values())))
        inputs, strides = list(table), [0] * len(table)
        for name, values in arrays.items():
            place = self.place[name]
            inputs[place], strides[place] = np.ascontiguousarray(values, dtype=float), 1
        layout = self.layout
        spare: dict[bool, NDArray[Any]] = {}  # what nobody asked for goes where nobody looks
        result: list[NDArray[Any]] = []
        for name, mask in zip(layout.outputs, layout.masks, strict=True):
            if name not in results and mask not in spare:
                spare[mask] = np.empty(count, dtype=bool if mask else float)
            result.append(results[name] if name in results else spare[mask])
        self.kernel.strided(count, inputs, strides, result)
        for name, value in layout.constants.items():
            if name in results:
                results[name][...] = value

    def at_one_point(
        self,
        subject: Configuration,
        fixed: Mapping[str, float],
        inputs: Sequence[str],
        results: Mapping[str, NDArray[Any]],
    ) -> Callable[[Sequence[float]], None]:
        """A function that evaluates one point, at values of inputs in their order, into the same arrays always."""
        layout = self.layout
        there = subject.changed({name: value for name, value in fixed.items() if name not in OPERATION})
        oil = OilFollows.of(there, inputs, self.place)
        varying = set(map(own_name, inputs))
        known = {n: fixed[n] if n in OPERATION else there.value_of(n) for n in self.place if n not in varying}
        held = np.array([known.get(name, math.nan) for name in layout.inputs], dtype=float)
        direct = [self.place.get(own_name(name), -1) for name in inputs]
        places = [place for place in direct if place >= 0]
        result = [
            results.get(name, np.zeros(1, dtype=bool if mask else float))
            for name, mask in zip(layout.outputs, layout.masks, strict=True)
        ]
        for name in layout.constants.keys() & results.keys():
            results[name][...] = layout.constants[name]
        call = self.kernel.at_one_point(held, result)

        def at(values: Sequence[float], _: Sequence[Any] = result) -> None:  # the arrays live as long as the function
            for place, value in zip(places, values, strict=True):  # sooner done than by an array of places
                held[place] = value
            call()

        if oil is None:
            return at

        def with_oil(values: Sequence[float]) -> None:
            numbers = oil.numbers(dict(zip(names, values, strict=True)))
            for name, number in numbers.items():
                held[self.place[name]] = number
            at([held[place] for place in places])

        names = list(map(own_name, inputs))
        return with_oil

    def at(self, plan: Plan) -> Callable[[Mapping[str, Any], Mapping[str, NDArray[Any]]], None]:
        """A function that evaluates points of a plan, by the names of its varying inputs, into arrays of results.

        Raises :class:`~ballscrew.basis.errors.InputError` for fixed values that do not fit together.
        """
        return self.over(plan.subject, plan.fixed, plan.varying)

    def over(
        self, subject: Configuration, fixed: Mapping[str, float], varying: Sequence[str]
    ) -> Callable[[Mapping[str, Any], Mapping[str, NDArray[Any]]], None]:
        """The same for a subject, with some inputs fixed and others that vary."""
        there = subject.changed({name: value for name, value in fixed.items() if name not in OPERATION})
        given = set(self.place) - set(map(own_name, varying))
        table = self.table({n: fixed[n] if n in OPERATION else there.value_of(n) for n in given})
        oil = OilFollows.of(there, varying, self.place)

        def evaluate(points: Mapping[str, Any], results: Mapping[str, NDArray[Any]]) -> None:
            values = {own_name(name): held for name, held in points.items()}
            if oil is not None:
                values = oil.numbers(values)
            numbers = {name: held for name, held in values.items() if np.ndim(held) == 0}
            here = table.copy() if numbers else table
            for name, number in numbers.items():
                here[self.place[name]] = number
            self.fill(here, {name: held for name, held in values.items() if name not in numbers}, results)

        return evaluate


class OilFollows:
    """Numbers of an oil that follow from inputs which are no inputs of a recording: its temperature, its data sheet."""

    def __init__(self, subject: Configuration, inputs: Sequence[str], places: Collection[str]) -> None:
        self.subject = subject
        self.inputs = tuple(inputs)
        self.places = [name for name in places if name in subject.inputs and subject.inputs[name][0] == "lubricant"]
        self._programs = threading.local()
        self.program = self._recorded()

    @classmethod
    def of(cls, subject: Configuration, varying: Sequence[str], places: Collection[str]) -> OilFollows | None:
        """Those of inputs that vary; None where all of these are inputs of the recording.

        Raises ValueError for an input that neither the recording nor the oil follows.
        """
        missing = [name for name in varying if own_name(name) not in places]
        if not missing:
            return None
        if unknown := [name for name in missing if name not in OF_STATE]:
            raise ValueError(f"no inputs of the recording: {', '.join(unknown)}")
        of_oil = [name for name in varying if subject.inputs[name][0] == "lubricant"]
        return cls(subject, of_oil, places)

    def _recorded(self) -> Program | None:
        """The numbers as a program of the inputs; None for an oil that wants plain arrays."""
        tape = Tape(len(self.inputs), None, [self.subject.is_nonnegative(name) for name in self.inputs])
        try:
            with self.subject.recording():
                changed = self.subject.lubricant.changed({n: tape.value(i) for i, n in enumerate(self.inputs)})
                values = {name: changed.value_of(name) for name in self.places}
                return merged_program(tape, values)
        except CannotRecordError:
            return None

    def numbers(self, points: Mapping[str, Any]) -> dict[str, Any]:
        """The values of points with the numbers of the oil in place of what sets them."""
        arrays = np.broadcast_arrays(*[np.atleast_1d(points[name]) for name in self.inputs])
        others = {name: values for name, values in points.items() if name not in self.inputs}
        if self.program is None:
            changed = self.subject.lubricant.changed({n: points[n] for n in self.inputs})
            return others | {name: changed.value_of(name) for name in self.places}
        result = {name: np.empty(arrays[0].size) for name in self.places}
        try:
            interpreter: Interpreter = self._programs.interpreter
        except AttributeError:  # the first call in this thread
            interpreter = self._programs.interpreter = self.program.interpreter.with_own_buffers()
        with np.errstate(all="ignore"):
            interpreter.run(arrays, result)
        is_one = all(np.ndim(points[name]) == 0 for name in self.inputs)
        return others | {name: values[0] if is_one else values for name, values in result.items()}


class _Kept:
    """What was kept of structures: in memory, on disk, or made now."""

    def __init__(self) -> None:
        #: Held while something is made: one after another, as others may want the same.
        self.making = threading.RLock()
        self._lock = threading.RLock()
        #: Names of what cannot be recorded or compiled.
        self.impossible: set[str] = set()
        self._found: OrderedDict[str, Any] = OrderedDict()
        self._asked: OrderedDict[str, int] = OrderedDict()

    def get(self, name: str, read: Callable[[bytes, bytes], Any]) -> Any | None:
        """That of a name; None where there is none."""
        with self._lock:
            if name in self._found:
                self._found.move_to_end(name)
                return self._found[name]
            held = kernel.kept(name)
            if held is None:
                return None
            try:
                made = read(*held)
            except (ValueError, KeyError, TypeError):  # written by hand
                return None
            return self.add(name, made)

    def add(self, name: str, made: Any) -> Any:
        with self._lock:
            self._found[name] = made
            if len(self._found) > MOST_IN_MEMORY:
                self._found.popitem(last=False)
            return made

    def asked(self, name: str, work: int) -> int:
        """Count work that was asked for, and return all of it."""
        with self._lock:
            total = self._asked.pop(name, 0) + work
            self._asked[name] = total
            if len(self._asked) > 16 * MOST_IN_MEMORY:
                self._asked.popitem(last=False)
            return total


kept = _Kept()


def name_of(kind: str, subject: Configuration, outputs: Sequence[str], names: Sequence[str]) -> str | None:
    """The name of what is kept of a structure, equal in all processes; None where nothing may be kept.

    So it is without a compiler, for laws from outside, and where a function of the package was replaced.
    """
    if not kernel.available() or not is_as_imported():
        return None
    key = structure_key(subject, outputs, names)
    if key is None:
        return None
    text = f"{kind}\n{_text_of(key)}\n{recorder_digest()}\n{LANES} {MOST_STEPS_OPTIMISED}"
    return f"structure {hashlib.sha256(text.encode()).hexdigest()}"


def _text_of(key: Hashable) -> str:
    """A key as text that is the same in all processes."""
    if isinstance(key, tuple):
        return f"({','.join(map(_text_of, key))})"
    if isinstance(key, type | types.FunctionType):
        return f"{key.__module__}.{key.__qualname__}"
    if isinstance(key, enum.Enum):
        return f"{_text_of(type(key))}.{key.name}"
    return repr(key)


class Structure:
    """The structure of a configuration with the outputs asked for, or these with their derivatives, and its kernel."""

    def __init__(
        self, subject: Configuration, outputs: Sequence[str], varying: Sequence[str] = (), by: Sequence[str] = ()
    ) -> None:
        self.subject = subject
        self.names = inputs_of_structure(subject, varying)
        self.by = tuple(by)
        known = known_outputs(subject.nut)
        self.wanted = {n: known[n] for n in outputs} if by else outputs_of_structure(subject, outputs)
        kind = f"whole, by {self.by}"
        self.name = None if subject.nut.one_by_one else name_of(kind, subject, tuple(self.wanted), self.names)

    def known(self) -> StructureKernel | None:
        """Its kernel, where this process or an earlier one has compiled it."""
        return None if self.name is None else kept.get(self.name, _read)

    def ready(self, points: int) -> StructureKernel | None:
        """Its kernel where it is known, or compiled now where so many points have been asked for that this pays."""
        if self.name is None:
            return None
        return self.known() or (self.kernel() if kept.asked(self.name, points) >= ENOUGH_TO_COMPILE else None)

    def kernel(self) -> StructureKernel | None:
        """Its kernel, compiled now where it is not known; None where it cannot be had."""
        if self.name is None:
            return None
        with kept.making:
            kernel = self.known()
            if kernel is not None or self.name in kept.impossible:
                return kernel
            try:
                layout, machine_code = self._compiled()
            except (CannotRecordError, UnknownDerivativeError, UnknownOperationError):
                kept.impossible.add(self.name)
                return None
            keep(self.name, layout._asdict(), machine_code)
            return kept.add(self.name, StructureKernel(layout, machine_code))

    def _compiled(self) -> tuple[Layout, bytes]:
        program = recorded_structure(numbers_alone(self.subject), self.wanted, self.names, by=self.by)
        Structures.made += 1
        masks = {name: name in self.wanted and self.wanted[name].dtype is bool for name in program.outputs}
        sources: list[Source] = ["strided"] * len(self.names)
        text = kernel_text(program, sources, masks, lanes=LANES)
        layout = Layout(
            self.names,
            tuple(program.outputs),
            tuple(masks.values()),
            program.constants,
            LANES,
            hashlib.sha256(f"{text}\n{program.text}".encode()).hexdigest(),
        )
        level = 0 if len(program.steps) > MOST_STEPS_OPTIMISED else None
        return layout, kernel.code_of(text, level)


def keep(name: str, header: Mapping[str, Any], machine_code: bytes) -> None:
    """Keep machine code on disk, with a header of names and numbers; what JSON does not know stays in this process.

    So does all of it where the source has changed since it was imported.
    """
    if not stands_as_imported():
        return
    with contextlib.suppress(TypeError):  # what JSON does not know, of a law's own making
        kernel.keep(name, json.dumps(header, default=_plain).encode(), machine_code)


def _plain(value: Any) -> Any:
    """A number or a table as JSON knows it."""
    if isinstance(value, Mapping):
        return dict(cast("Mapping[str, Any]", value))
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.ndim == 0):
        return value.item()
    raise TypeError(type(value).__name__)


def _read(header: bytes, machine_code: bytes) -> StructureKernel:
    held = json.loads(header)
    layout = Layout(
        tuple(held["inputs"]),
        tuple(held["outputs"]),
        tuple(held["masks"]),
        held["constants"],
        held["lanes"],
        held["formulas"],
    )
    return StructureKernel(layout, machine_code)
