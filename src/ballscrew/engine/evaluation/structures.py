"""The structure of a configuration: what is left of it when all its numbers are inputs.

One recording of a structure serves every case of its kind: nothing is recorded again when a number changes. What is
not a number stays in the key: the laws, the kind of the nut, what is given and what is None; and exponents of laws,
which are folded into the powers. Rows and rigid nuts are recorded whole, point by point; nuts whose balls differ by
ball, with the results of the solver of the loads as further inputs (:mod:`ballscrew.engine.evaluation.by_ball`).

Kernels of structures: compiled once on a machine, for every case of a kind, whichever of its inputs vary.

Each input is one number or an array, as a call says, so that no text depends on which of them vary
(:mod:`ballscrew.engine.evaluation.structures` has what is recorded). A kernel is kept on disk beside all others, with a
header that says what it reads and writes: another process finds it without recording the model. It goes by a digest of
the structure, of the source of this package that it follows from, of the processor and of the compiler.
"""

from __future__ import annotations

import contextlib
import dataclasses
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
from ballscrew.compiler.tracing.gradient import UnknownDerivativeError, partials
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Interpreter, Program, Source
from ballscrew.compiler.tracing.tape import COLUMNS, ROWS, CannotRecordError, Tape
from ballscrew.engine.evaluation.fingerprint import recorder_digest, stands_as_imported
from ballscrew.engine.evaluation.outputs import (
    DEFAULT_OUTPUTS,
    NUT_OUTPUTS,
    OF_LOADS,
    OPERATION,
    Output,
    known_outputs,
    slope_name,
)
from ballscrew.engine.evaluation.plan import Configuration, Plan, read_input
from ballscrew.engine.evaluation.recordings import Structures, UnknownPartError, is_as_imported, key_of
from ballscrew.physics.components.materials import INPUTS_OF_SHEET
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import MATERIALS
from ballscrew.physics.solvers.load_distribution import BallLoads, KindLoads

#: What each ball has of the solved loads.
OF_BALLS = ("forward_load", "backward_load", "forward_angle", "backward_angle")
#: What sets numbers of the oil, which are inputs themselves.
OF_STATE = frozenset({TEMPERATURE.name, *INPUTS_OF_SHEET})
#: What no recording depends on: only the solver of the loads does, or only what has set numbers that are inputs.
_ASIDE = frozenset({"bodies", "deviations", "grade", "sheet", "temperature", "made_as"})
#: Outputs that are recorded together.
_USUAL = frozenset({*NUT_OUTPUTS, "drive_torque", "holding_torque", "self_locking", "minimum_film_parameter"})
_USUAL_OF_ROWS = frozenset({*DEFAULT_OUTPUTS, "screw_maximum_pressure", "nut_maximum_pressure"})
_USUAL_PARTS = ("contribution_", "validity_")


def inputs_of_structure(subject: Configuration, varying: Sequence[str] = ()) -> tuple[str, ...]:
    """The names of all numbers of a configuration that are inputs of its recording, the operating point first.

    An exponent of a law is a constant, unless it varies: folded into the powers, it costs nothing. A number that
    is None is left out, unless it varies.
    """
    varied = set(map(own_name, varying))
    seen: set[str] = set()
    names: list[str] = []
    parts = subject.by_section
    for name, (part, _) in subject.inputs.items():
        own = own_name(name)
        is_exponent = part == "model" and name.rpartition(".")[2].endswith("exponent") and name not in varied
        if part == "operation" or name in OF_STATE or own in seen or is_exponent:
            continue
        seen.add(own)
        if own in varied or read_input(parts[part], name) is not None:
            names.append(own)
    return (*OPERATION, *names)


def own_name(name: str) -> str:
    """The name of an input without the section of the nut, which may be left out."""
    return name.removeprefix("nut.")


def outputs_of_structure(subject: Configuration, outputs: Sequence[str]) -> Mapping[str, Output]:
    """The outputs that are recorded for those asked for: the usual ones, where these are among them, or just these.

    What a few outputs more cost is saved by having one recording and one kernel for most purposes.
    """
    known = known_outputs(subject.nut)
    of_kind = _USUAL | _USUAL_OF_ROWS if subject.nut.is_row else _USUAL
    usual = {n: output for n, output in known.items() if n in of_kind or n.startswith(_USUAL_PARTS)}
    return usual if usual.keys() >= set(outputs) else {name: known[name] for name in outputs}


def structure_key(subject: Configuration, outputs: Sequence[str], names: Sequence[str]) -> Hashable | None:
    """All that the recording of some outputs depends on, whose inputs have these names.

    None where a law from outside may compute something else each time.
    """
    try:
        return _structure(subject, names), tuple(outputs), tuple(names)
    except UnknownPartError:
        return None


def _structure(subject: Configuration, names: Sequence[str]) -> Hashable:
    """A configuration as a key, without the numbers that are inputs and without what only the loads depend on."""
    asides = {*names, *_ASIDE}

    def of(part: Any, prefix: str = "") -> Hashable:
        laws = [f for f in dataclasses.fields(part) if f"{prefix}{f.name}" not in asides]
        return type(part), *((f.name, of_field(getattr(part, f.name), f.name)) for f in laws)

    def of_field(value: Any, name: str) -> Hashable:
        if name == "nut":
            return of(value)
        if name == "losses":
            return tuple((n, of_law(law, f"losses.{n}.")) for n, law in value.items())
        is_part = name in subject.model.laws_with_coefficients or name in MATERIALS
        return of_law(value, f"{name}.") if is_part else key_of(value)

    def of_law(law: Any, prefix: str) -> Hashable:
        key_of(law)  # raises for one from outside
        return of(law, prefix) if dataclasses.is_dataclass(law) else key_of(law)

    return of(subject.model), of(subject.screw), of(subject.lubricant), subject.nut.one_by_one


def numbers_alone(subject: Configuration) -> Configuration:
    """The same with an oil that is its numbers alone; a law from outside may ask for the grade of the oil."""
    oil = dataclasses.replace(subject.lubricant, grade=None, sheet=None, temperature=None)
    return Configuration(subject.model, subject.screw, oil)


def recorded_structure(
    subject: Configuration, wanted: Mapping[str, Output], names: Sequence[str], by: Sequence[str] = ()
) -> Program:
    """The outputs wanted as a program of the inputs of these names, in their order.

    Each output is followed by its derivatives ``by`` inputs, where balls are alike.

    That of a nut whose balls differ has the results of the solver as further inputs, for the nut (``OF_LOADS``) and for
    each ball (:data:`OF_BALLS`), and reductions over the balls. Raises
    :class:`~ballscrew.compiler.tracing.tape.CannotRecordError` for laws that cannot be recorded, and for a nut whose
    balls differ and that was set at rest; :class:`~ballscrew.compiler.tracing.gradient.UnknownDerivativeError` for
    functions whose derivative is not known.
    """
    if subject.nut.one_by_one:
        return _recorded_by_ball(subject, wanted, names)
    tape = Tape(len(names), None, [subject.is_nonnegative(name) for name in names])
    points = {name: tape.value(i) for i, name in enumerate(names)}
    if not by:
        return subject.recorded(tape, points, wanted)
    values: dict[str, Any] = {}
    with subject.recording():
        result = subject.at(points)
        for name, output in wanted.items():
            values[name] = output.read(result)
            slopes = partials(tape, values[name], [names.index(own_name(x)) for x in by])
            values |= {slope_name(name, x): slope for x, slope in zip(by, slopes, strict=True)}
    return merged_program(tape, values)


def _recorded_by_ball(subject: Configuration, wanted: Mapping[str, Output], names: Sequence[str]) -> Program:
    """The program of all inputs, the results of the solver for the nut, and those for each ball."""
    if subject.nut.set_at_rest:
        raise CannotRecordError("the preload of a nut that was set at rest follows the friction of its balls")
    groups = groups_by_ball(names)
    nonnegative = [subject.is_nonnegative(name) for name in names] + [False] * len(OF_LOADS) + [True] * len(OF_BALLS)
    tape = Tape(len(groups), groups, nonnegative, reduces=True)
    traced = [tape.value(i) for i in range(tape.inputs)]
    points = dict(zip(names, traced, strict=False))
    of_nut = dict(zip(OF_LOADS, traced[len(names) :], strict=False))
    of_balls = dict(zip(OF_BALLS, traced[-len(OF_BALLS) :], strict=True))
    with subject.recording(by_ball=True):
        lift_off = of_nut.pop("lift_off_load")
        kinds = (KindLoads(balls=1.0, **of_balls),)
        loads = BallLoads(kinds=kinds, one_by_one=True, lift_off=lift_off, **of_nut)
        result = subject.under(loads, points)
        return merged_program(tape, {name: output.read(result) for name, output in wanted.items()})


def groups_by_ball(names: Sequence[str]) -> list[int]:
    """The groups of the inputs of a recording by ball: points are columns, balls are rows."""
    return [COLUMNS] * (len(names) + len(OF_LOADS)) + [ROWS | COLUMNS] * len(OF_BALLS)


#: What NumPy needs for one step at one point, on two threads, and the steps of a program whose buffers
#: begin to outgrow the cache; and what a kernel costs before its first point if it has to be compiled.
#: Only the choice of an engine depends on these numbers, so that they need not be exact.
NUMPY_STEP_SECONDS, STEPS_IN_CACHE = 2.5e-10, 5000
COMPILING_SECONDS, COMPILING_STEP_SECONDS = 0.05, 1.2e-4
#: Points of a structure that have to be asked for, in one call or in several, before a kernel is compiled for it; and
#: points of one call beyond which a kernel of just this call pays, whose constants are folded.
ENOUGH_TO_COMPILE, ENOUGH_TO_FOLD = 20_000, 4_000_000


#: Points of a vector: more take four times as long to compile, and are no faster where all numbers are inputs.
LANES = FEWEST_LANES
#: Beyond so many steps the code is not optimised: that takes a seventh of the time, and runs 1.6 times as long.
MOST_STEPS_OPTIMISED = 30_000
#: Points of a block: what is computed beside what was asked for stays in the cache.
BLOCK_OF_POINTS = 2**13
#: Most kernels of structures in memory.
MOST_IN_MEMORY = 64


class Layout(NamedTuple):
    """Arrays that a kernel reads and writes."""

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
    """Objects kept of structures: in memory, on disk, or made now."""

    def __init__(self) -> None:
        #: Held while something is made: one after another, as others may want the same.
        self.making = threading.RLock()
        self._lock = threading.RLock()
        #: Names of what cannot be recorded or compiled.
        self.impossible: set[str] = set()
        self._found: OrderedDict[str, Any] = OrderedDict()
        self._asked: OrderedDict[str, int] = OrderedDict()

    def get(self, name: str, read: Callable[[bytes, bytes], Any]) -> Any | None:
        """Return the object of a name; None where there is none."""
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
