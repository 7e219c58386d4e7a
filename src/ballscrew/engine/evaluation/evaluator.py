"""Evaluators: a model as a function on arrays that is recorded and compiled once, to be called many times."""

from __future__ import annotations

import dataclasses
import functools
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.arrays import BLOCK_SIZE, map_blocks
from ballscrew.basis.errors import MISSING, Fault, InputError, nearest, raise_if_any, without_unit
from ballscrew.basis.quantities import Quantity, ends_within, within_bounds
from ballscrew.compiler.kernels import kernel as kernels
from ballscrew.compiler.kernels.emission import UnknownOperationError
from ballscrew.compiler.kernels.kernel import Kernel, aligned_array
from ballscrew.compiler.tracing.gradient import UnknownDerivativeError, partials
from ballscrew.compiler.tracing.program import Program, Source
from ballscrew.compiler.tracing.tape import CannotRecordError, Tape
from ballscrew.engine.evaluation.by_ball import BLOCK_OF_BALLS, ByBall, by_ball
from ballscrew.engine.evaluation.derivatives import JAX_INSTEAD
from ballscrew.engine.evaluation.outputs import OPERATION, Output, slope_name
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import (
    ASKED_FOR,
    KNOWN,
    Engine,
    Recording,
    engine_faults,
    recording,
    why_numpy,
)
from ballscrew.engine.evaluation.structures import BLOCK_OF_POINTS, Structure, StructureKernel
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

#: Points of a block, of few points and of many: results of many are stored past the cache.
KERNEL_BLOCK, LARGE_KERNEL_BLOCK = 2**14, 2**17
#: What is one number; anything else may have axes, a unit or a mask.
_NUMBERS = frozenset({float, int, np.float64})

#: Evaluates arrays of one length into arrays of results, and makes the function of one point for a thread.
_OnArrays = Callable[[Sequence[NDArray[np.float64]], Mapping[str, NDArray[Any]]], None]
_OnPoint = Callable[[Sequence[float]], dict[str, Any]]


def evaluator(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    inputs: Sequence[str] = OPERATION,
    outputs: Sequence[str] | None = None,
    by: Sequence[str] = (),
    engine: Engine | None = None,
    threads: int | None = None,
    **fixed: float,
) -> Evaluator:
    """A function on arrays: outputs at values of the inputs, for optimisers, ODEs and control loops.

    Returns an :class:`Evaluator` of ``model`` on ``screw`` with ``lubricant``. ``inputs`` and ``outputs`` are named as
    those of :func:`~ballscrew.engine.sweeps.sweep.sweep`. All other inputs keep the values of the parts, or those given
    as ``fixed`` numbers; ``axial_load`` and ``screw_speed`` are inputs or fixed. ``by`` names inputs by which all
    outputs are differentiated as well: the derivative of ``y`` by ``x`` is ``d_y_d_x``.

    The model is recorded here, and compiled where the compiler is installed (the extra ``fast``); arrays are evaluated
    on so many ``threads``. One kernel, kept on disk, serves all screws of a kind: the first one on a machine takes
    seconds, others milliseconds; compiling that takes more than a second is logged before it starts, as information of
    the logger ``ballscrew``. ``engine`` selects another: ``"compiled"`` compiles a kernel of just these inputs, whose
    other numbers are constants, which takes seconds for each case and half the time at each point, and pays from some
    ten million points on; ``"numpy"`` compiles nothing. What a model holds is read now: an object that a law from
    outside changes later has no effect. Copies and pickles record anew.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, missing and bad fixed values, an engine that
    cannot be had, and derivatives of truth values or of a law that cannot be recorded.
    """
    return Evaluator(Configuration(model, screw, lubricant), tuple(inputs), outputs, tuple(by), engine, threads, fixed)


class Evaluator:
    """The function that :func:`evaluator` returns; calls from several threads do not disturb each other."""

    def __init__(
        self,
        subject: Configuration,
        inputs: tuple[str, ...],
        outputs: Sequence[str] | None,
        by: tuple[str, ...],
        engine: Engine | None,
        threads: int | None,
        fixed: Mapping[str, float],
    ) -> None:
        self._arguments = subject, inputs, outputs, by, engine, threads, dict(fixed)
        raise_if_any([*engine_faults("evaluator", engine), *_faults(subject, inputs, by, fixed)])
        # the operating point is checked where it is fixed; as an input it has any value here
        anywhere = {name: 1.0 for name in OPERATION if name in inputs}
        plan = Plan.of(subject, outputs, {**fixed, **anywhere}, "evaluator")
        numbers = {name: value for name, value in plan.fixed.items() if name not in inputs}
        raise_if_any(
            [
                Fault("evaluator.outputs", "is true or false, and has no derivative", name, "choose numbers")
                for name, output in plan.wanted.items()
                if by and output.dtype is bool
            ]
        )
        #: The names of the inputs, in the order of values without a name.
        self.inputs = inputs
        #: The names of the results.
        self.outputs = tuple(_results(plan, by))
        self._masks = {name: name in plan.wanted and plan.wanted[name].dtype is bool for name in self.outputs}
        self._quantities = {name: subject.inputs[name][1] for name in inputs}
        self._threads = threads
        self._here = threading.local()
        self._prepare(plan, numbers, by, engine)

    def _prepare(self, plan: Plan, fixed: Mapping[str, Any], by: tuple[str, ...], engine: Engine | None) -> None:
        """Record and compile."""
        if plan.subject.nut.one_by_one and not by:
            self._prepare_by_ball(plan, fixed, engine)
            return
        known = None if by or engine else self._structure_kernel(plan)
        if known is not None:
            self._use("compiled", KNOWN, BLOCK_OF_POINTS)
            self._largest_block = BLOCK_OF_POINTS
            self._on_arrays = _strided(plan, known, fixed, self._quantities)
            self._new_on_point = functools.partial(_at_strided_point, plan, known, fixed, self._quantities)
            return
        made_of: Recording | None = None
        try:
            made_of = recording(
                lambda: ("evaluator", plan.subject, self.inputs, plan.outputs, by, fixed),
                lambda: _recorded(plan, self._quantities, fixed, by),
            )
            why = why_numpy(engine)
            if engine != "numpy" and kernels.available():
                sources: list[Source] = ["points"] * len(self.inputs)
                kernel = Kernel.of(made_of.text(made_of.program, sources, self._masks), sources)
                self._use("compiled", ASKED_FOR if engine else "the compiler is installed", KERNEL_BLOCK)
                self._on_arrays, self._new_on_point = _compiled(kernel), functools.partial(_at_point, kernel)
                return
        except UnknownOperationError as unknown:
            why = f"{unknown} is not known to kernels"
        except CannotRecordError as error:
            why = f"the model itself, on plain arrays: {error}"
        if by and made_of is None:
            raise InputError(Fault("evaluator.by", f"has no derivatives: {why}", "", f"bs.derivatives: {JAX_INSTEAD}"))
        if engine == "compiled":
            raise InputError(Fault("evaluator.engine", f"cannot be had: {why}", engine, 'take engine="numpy"'))
        self._use("numpy", why, max(1, BLOCK_SIZE // plan.subject.balls))
        self._on_arrays = _played(made_of.program) if made_of else _called(plan, self._quantities, fixed)
        self._new_on_point = self._point_as_arrays

    def _structure_kernel(self, plan: Plan) -> StructureKernel | None:
        """The kernel for all numbers of such a screw, where the inputs are among them; compiled now if it is new."""
        structure = Structure(plan.subject, plan.outputs, list(dict.fromkeys((*plan.axes, *self.inputs))))
        return structure.kernel()

    def _prepare_by_ball(self, plan: Plan, fixed: Mapping[str, Any], engine: Engine | None) -> None:
        """Record and compile the friction of balls that differ."""
        best: Engine = engine or ("compiled" if kernels.available() else "numpy")
        ready = by_ball(plan, best, varying=self.inputs)
        if isinstance(ready, str) and engine is None:
            ready = by_ball(plan, "numpy", varying=self.inputs)
        if isinstance(ready, str):
            if engine == "compiled":
                raise InputError(Fault("evaluator.engine", f"cannot be had: {ready}", engine, 'take engine="numpy"'))
            self._use("numpy", ready, max(1, BLOCK_SIZE // plan.subject.balls))
            self._on_arrays = _called(plan, self._quantities, fixed)
        else:
            why = ASKED_FOR if engine else why_numpy(None) if ready.engine == "numpy" else "the compiler is installed"
            self._use(ready.engine, why, max(1, BLOCK_OF_BALLS // plan.subject.balls))
            self._on_arrays = _by_ball(plan, ready, self._quantities, fixed)
        self._new_on_point = self._point_as_arrays

    def _use(self, engine: Engine, reason: str, block_size: int) -> None:
        #: The engine, and the reason for it.
        self.engine: Engine = engine
        self.engine_reason = reason
        self._block_size = block_size
        self._largest_block = LARGE_KERNEL_BLOCK

    def __reduce__(self) -> tuple[Any, ...]:
        """The arguments: it is recorded anew elsewhere."""
        return Evaluator, self._arguments

    def __repr__(self) -> str:
        """The names of inputs and results."""
        return f"<evaluator ({', '.join(self.inputs)}) -> {', '.join(self.outputs)}; {self.engine}>"

    def __call__(self, *values: Any, **named: Any) -> dict[str, Any]:
        """The results by name, at values of the inputs by name or in their order, in SI; arrays broadcast.

        Numbers give numbers, arrays arrays. No value is refused: where an input is not finite or beyond its bounds, the
        results are NaN and truth values false; whether the model holds is the output ``valid``. Raises
        :class:`~ballscrew.basis.errors.InputError` for missing and unknown names, and for what is no number.
        """
        if named or len(values) != len(self.inputs):
            values = self._in_order(values, named)
        if _NUMBERS.issuperset(map(type, values)):
            try:
                on_point: _OnPoint = self._here.on_point
            except AttributeError:  # the first call in this thread
                on_point = self._here.on_point = self._new_on_point(self._masks, len(values))
            return on_point(values)
        return self._over_arrays(values)

    def _in_order(self, values: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        try:
            if not values and len(named) == len(self.inputs):
                return tuple([named[name] for name in self.inputs])
        except KeyError:
            pass
        given = dict(zip(self.inputs, values, strict=False))
        faults = [Fault("evaluator", "too many values", str(len(values)), f"inputs: {', '.join(self.inputs)}")]
        faults = faults if len(values) > len(self.inputs) else []
        faults += [Fault(f"evaluator.{n}", "is given twice", "", "once is enough") for n in named if n in given]
        faults += [Fault(f"evaluator.{n}", "no input", "", nearest(n, self.inputs)) for n in named.keys() - self.inputs]
        given |= named
        faults += [Fault(f"evaluator.{n}", MISSING, "", f"give {n}=…") for n in self.inputs if n not in given]
        raise_if_any(faults)
        return tuple([given[name] for name in self.inputs])

    def _over_arrays(self, values: Sequence[Any]) -> dict[str, Any]:
        named = zip(self._quantities.items(), values, strict=True)
        checked = [_numbers(f"evaluator.{name}", quantity.unit, value) for (name, quantity), value in named]
        raise_if_any([fault for fault in checked if isinstance(fault, Fault)])
        arrays = [array for array in checked if not isinstance(array, Fault)]
        try:
            shape = np.broadcast_shapes(*(array.shape for array in arrays))
        except ValueError:
            given = ", ".join(f"{name} {array.shape}" for name, array in zip(self.inputs, arrays, strict=True))
            raise InputError(Fault("evaluator", "the shapes do not broadcast", given, "make them fit")) from None
        size = int(np.prod(shape))
        outcome = {name: aligned_array(size, bool if mask else float) for name, mask in self._masks.items()}
        block_size = (
            self._largest_block if self.engine == "compiled" and size > 8 * LARGE_KERNEL_BLOCK else self._block_size
        )
        block_size = min(block_size, max(size, 1))
        # a number is the same in every block, and so is its array
        flat = [np.full(block_size, array.item()) if array.size == 1 else _whole(array, shape) for array in arrays]

        def evaluate(part: slice) -> None:
            count = part.stop - part.start
            here = [
                values[:count] if array.size == 1 else values[part] for values, array in zip(flat, arrays, strict=True)
            ]
            self._on_arrays(here, {name: result[part] for name, result in outcome.items()})

        map_blocks(evaluate, size, block_size=block_size, threads=self._threads)
        return {name: result.reshape(shape)[()] for name, result in outcome.items()}

    def _point_as_arrays(self, masks: Mapping[str, bool], inputs: int) -> _OnPoint:
        """One point without a kernel."""
        held = np.empty((inputs, 1))
        results = {name: np.empty(1, dtype=bool if mask else float) for name, mask in masks.items()}

        def at(values: Sequence[float]) -> dict[str, Any]:
            held[:, 0] = values
            self._on_arrays(list(held), results)
            return {name: result[0] for name, result in results.items()}

        return at


def _faults(
    subject: Configuration, inputs: Sequence[str], by: Sequence[str], fixed: Mapping[str, float]
) -> list[Fault]:
    known = subject.inputs
    faults = [Fault("evaluator.inputs", "unknown input", n, nearest(n, known)) for n in inputs if n not in known]
    faults += [Fault("evaluator.inputs", "is named twice", n, "") for n in dict.fromkeys(inputs) if inputs.count(n) > 1]
    faults += [] if inputs else [Fault("evaluator.inputs", MISSING, "", 'name them: inputs=["axial_load"]')]
    faults += [Fault("evaluator.by", "is no input", n, nearest(n, inputs)) for n in by if n not in inputs]
    remedy = "name it among the inputs, or give it a value"
    faults += [Fault(f"evaluator.{n}", MISSING, "", remedy) for n in OPERATION if n not in inputs and n not in fixed]
    faults += [Fault(f"evaluator.{n}", "is an input and fixed", "", "leave one out") for n in fixed if n in inputs]
    faults += [
        Fault(f"evaluator.{n}", "must be one number", "", "make it an input") for n, v in fixed.items() if np.ndim(v)
    ]
    return faults


def _results(plan: Plan, by: Sequence[str]) -> list[str]:
    return [name for output in plan.outputs for name in (output, *(slope_name(output, x) for x in by))]


def _recorded(plan: Plan, quantities: Mapping[str, Quantity], fixed: Mapping[str, Any], by: Sequence[str]) -> Program:
    """The outputs and their derivatives as a program of the inputs; nothing where an input is beyond its bounds."""
    names = list(quantities)
    tape = Tape(len(names), None, [plan.subject.is_nonnegative(name) for name in names])
    points = {name: tape.value(i) for i, name in enumerate(names)}
    inside = functools.reduce(
        lambda one, other: one & other, [within_bounds(q.info, points[n]) for n, q in quantities.items()]
    )
    slopes: dict[str, Any] = {}

    def value(output: Output, result: Any) -> Any:
        values = output.read(result)
        if by:
            found_by = zip(by, partials(tape, values, [names.index(x) for x in by]), strict=True)
            slopes.update({slope_name(output.name, x): slope for x, slope in found_by})
        return _within(inside, output, values)

    def slope(output: Output, _: Any) -> Any:
        return _within(inside, output, slopes[output.name])

    wanted: dict[str, Output] = {}
    for name, output in plan.wanted.items():  # read in this order: a value, then its derivatives
        wanted[name] = Output(name, output.quantity, functools.partial(value, output))
        for of in (slope_name(name, x) for x in by):
            at = Output(of, output.quantity, output.read)
            wanted[of] = dataclasses.replace(at, read=functools.partial(slope, at))
    try:
        return plan.subject.recorded(tape, {**fixed, **points}, wanted)
    except UnknownDerivativeError as unknown:
        raise InputError(Fault("evaluator.by", f"{unknown} has no derivative here", "", JAX_INSTEAD)) from None


def _within(inside: Any, output: Output, value: Any) -> Any:
    """A result where the inputs are within their bounds."""
    return inside & value if output.dtype is bool else np.where(inside, value, np.nan)


def _whole(array: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    return np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)


def _numbers(where: str, unit: str, value: Any) -> NDArray[np.float64] | Fault:
    """Values as an array in SI."""
    numbers = without_unit(where, value, unit)
    if isinstance(numbers, Fault):
        return numbers
    try:
        array = np.asarray(numbers)
    except (TypeError, ValueError):  # nested lists of several lengths
        array = np.array(None)
    if array.dtype.kind not in "fiu" or np.ma.isMaskedArray(numbers):
        return Fault(where, "must be numbers in SI", str(value), "give a number or an array of numbers")
    return np.asarray(array, dtype=float)


def _compiled(kernel: Kernel) -> _OnArrays:
    def evaluate(inputs: Sequence[NDArray[np.float64]], results: Mapping[str, NDArray[Any]]) -> None:
        count = len(inputs[0])
        kernel(slice(0, 1), slice(0, count), count, inputs, list(results.values()))

    return evaluate


def _at_point(kernel: Kernel, masks: Mapping[str, bool], inputs: int) -> _OnPoint:
    """One point in arrays that stay where they are."""
    held = np.zeros(inputs)
    results = [np.zeros(1, dtype=bool if mask else float) for mask in masks.values()]
    call = kernel.at_one_point(held, results)
    named = list(zip(masks, results, strict=True))

    def at(values: Sequence[float]) -> dict[str, Any]:
        held[:] = values
        call()
        return {name: result[0] for name, result in named}

    return at


def _strided(
    plan: Plan, known: StructureKernel, fixed: Mapping[str, float], quantities: Mapping[str, Quantity]
) -> _OnArrays:
    """The kernel of a structure; nothing where an input is beyond its bounds."""
    at = known.over(plan.subject, fixed, list(quantities))

    def evaluate(inputs: Sequence[NDArray[np.float64]], results: Mapping[str, NDArray[Any]]) -> None:
        points = dict(zip(quantities, inputs, strict=True))
        at(points, results)
        with np.errstate(all="ignore"):
            inside = np.logical_and.reduce([within_bounds(q.info, points[n]) for n, q in quantities.items()])
        if not inside.all():
            for name, output in plan.wanted.items():
                results[name][~inside] = False if output.dtype is bool else np.nan

    return evaluate


def _at_strided_point(
    plan: Plan,
    known: StructureKernel,
    fixed: Mapping[str, float],
    quantities: Mapping[str, Quantity],
    masks: Mapping[str, bool],
    inputs: int,
) -> _OnPoint:
    """One point by the kernel of a structure, in arrays that stay where they are."""
    results = {name: np.zeros(1, dtype=bool if mask else float) for name, mask in masks.items()}
    call = known.at_one_point(plan.subject, fixed, list(quantities), results)
    named = list(results.items())
    nothing = {name: np.False_ if mask else np.float64(np.nan) for name, mask in masks.items()}
    bounds = [ends_within(quantity.info) for quantity in quantities.values()]
    whole = [i for i, quantity in enumerate(quantities.values()) if quantity.info.whole]
    assert len(bounds) == inputs, "one value for each"

    def at(values: Sequence[float]) -> dict[str, Any]:
        for value, (least, greatest) in zip(values, bounds, strict=True):
            if not least <= value <= greatest:
                return dict(nothing)
        if whole and any(values[i] % 1 for i in whole):
            return dict(nothing)
        call(values)
        return {name: result[0] for name, result in named}

    return at


def _played(program: Program) -> _OnArrays:
    interpreter = program.interpreter.with_own_buffers()

    def evaluate(inputs: Sequence[NDArray[np.float64]], results: Mapping[str, NDArray[Any]]) -> None:
        with np.errstate(all="ignore"):
            interpreter.run(inputs, results)

    return evaluate


def _by_ball(plan: Plan, ready: ByBall, quantities: Mapping[str, Quantity], fixed: Mapping[str, Any]) -> _OnArrays:
    """The loads of balls that differ, solved, and the friction under them."""

    def evaluate(inputs: Sequence[NDArray[np.float64]], results: Mapping[str, NDArray[Any]]) -> None:
        with np.errstate(all="ignore"):
            points = dict(zip(quantities, inputs, strict=True))
            inside = np.logical_and.reduce([within_bounds(q.info, points[n]) for n, q in quantities.items()])
            ready.evaluate(plan.subject, {**fixed, **points}, results)
            for name, output in plan.wanted.items():
                results[name][...] = _within(inside, output, results[name])

    return evaluate


def _called(plan: Plan, quantities: Mapping[str, Quantity], fixed: Mapping[str, Any]) -> _OnArrays:
    """The model itself."""

    def evaluate(inputs: Sequence[NDArray[np.float64]], results: Mapping[str, NDArray[Any]]) -> None:
        with np.errstate(all="ignore"):
            points = dict(zip(quantities, inputs, strict=True))
            inside = np.logical_and.reduce([within_bounds(q.info, points[n]) for n, q in quantities.items()])
            result = plan.subject.at({**fixed, **points})
            for name, output in plan.wanted.items():
                results[name][...] = _within(inside, output, output.read(result))

    return evaluate
