"""Evaluating a plan: by NumPy block by block, or by a compiled kernel where that pays."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.arrays import BLOCK_SIZE, map_blocks, processors
from ballscrew.basis.errors import (
    Fault,
    InputError,
    raise_if_any,
)
from ballscrew.compiler.kernels.chain import LANES
from ballscrew.compiler.kernels.emission import UnknownOperationError, lanes_for
from ballscrew.compiler.kernels.kernel import ALIGNMENT, LARGEST_CACHED, Kernel, WatchedKernel, aligned_array
from ballscrew.compiler.tracing.grid import Split, inner_axes, rectangles
from ballscrew.compiler.tracing.program import Program, Source
from ballscrew.compiler.tracing.tape import COLUMNS, ROWS, CannotRecordError
from ballscrew.engine.evaluation.by_ball import BLOCK_OF_BALLS, ByBall, by_ball
from ballscrew.engine.evaluation.fingerprint import Fingerprint, fingerprint_of, package_digest
from ballscrew.engine.evaluation.outputs import OPERATION, ends
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import (
    ASKED_FOR,
    KNOWN,
    PAYS,
    SWEEP_ENGINES,
    Engine,
    Recording,
    SweepEngine,
    engine_faults,
    may_be_compiled,
    recording,
    why_numpy,
    worth_compiling,
)
from ballscrew.engine.evaluation.structures import BLOCK_OF_POINTS, ENOUGH_TO_FOLD, Structure, StructureKernel

#: Fewest columns of a grid: a short row is mostly its beginning and its end.
FEWEST_COLUMNS = 256
#: A grid is worth cutting where it has this many times as many points as rows and columns.
WORTH_CUTTING = 8
#: Tables with more numbers than this are not worth their memory.
MOST_ENTRIES = 4_000_000
#: A kernel of more steps does not gain by checking its inputs itself, and takes long to compile.
MOST_STEPS_WATCHED = 1000
#: Blocks of a kernel: a few for each thread, not too small and not too large.
BLOCKS_PER_THREAD = 4
SMALLEST_BLOCK, LARGEST_BLOCK = 2**14, 2**19

#: By input that is to be checked, the ends of its values in each block.
_Ends = Mapping[str, list[NDArray[Any] | None]]
#: Evaluates the points of a slice of the flattened grid into arrays that begin at the given place, and notes ends.
_BlockEvaluator = Callable[[slice, Mapping[str, NDArray[Any]], int, _Ends], None]
#: Makes one for a plan; plans that differ only in numbers share the formulas.
_EvaluatorFactory = Callable[[Plan], _BlockEvaluator]


class Evaluation:
    """A plan made ready by one of the engines; the same bits whatever the blocks and the threads."""

    def __init__(
        self,
        plan: Plan,
        engine: Engine,
        reason: str,
        identify: Callable[[], Fingerprint],
        evaluator_of: _EvaluatorFactory,
        block_size: int,
        row_length: int,
    ) -> None:
        self.plan = plan
        self.engine: Engine = engine
        #: Why it is this engine.
        self.reason = reason
        self._identify = identify
        self._evaluator_of = evaluator_of
        self._evaluate = evaluator_of(plan)
        self._block_size = block_size
        self._row_length = row_length

    @classmethod
    def of(
        cls,
        plan: Plan,
        engine: SweepEngine | None = None,
        times: int = 1,
        *,
        recorded: bool = False,
        shared: bool = False,
        section: str = "sweep",
    ) -> Evaluation:
        """Make a plan ready; the engine is chosen by the size of the work and by what is compiled already.

        ``times`` says how often all of it will be evaluated (see :meth:`at`). ``recorded`` records balls that differ
        however little work it is, and no kernel that is there by chance counts. ``shared`` takes the kernel that all
        numbers of such a screw share, where it is known or pays: for what is refined until it converges, as the last
        bits then follow from what this machine has compiled before. Faults stand under ``section``.

        Raises :class:`~ballscrew.basis.errors.InputError` for an engine that cannot be had.
        """
        raise_if_any(engine_faults(section, engine, SWEEP_ENGINES))
        if engine == "model":
            return _by_numpy(plan, None, f"the model itself: {ASKED_FOR}")
        if plan.subject.nut.one_by_one and type(plan) is Plan:
            ready = by_ball(plan, engine, times, always=recorded, shared=shared)
            if isinstance(ready, ByBall):
                return _by_ball(plan, ready)
            if engine == "compiled":
                raise InputError(Fault(f"{section}.engine", f"cannot be had: {ready}", engine, 'take engine="numpy"'))
            return _by_numpy(plan, None, ready)
        if engine is None and shared:
            known = _of_structure(plan, times)
            if known is not None:
                return _by_structure(plan, known)
        program: Program | None = None
        try:
            made_of = recording_of(plan)
            program = made_of.program
            points = plan.total * times
            why = why_numpy(engine)
            if may_be_compiled(program, points, engine):
                made = (_Grid.of(plan) if times == 1 else None) or _Points.of(plan, made_of)
                if engine or worth_compiling(made.program, points, made.text, anew=recorded):
                    chosen = ASKED_FOR if engine else PAYS
                    identify = functools.partial(_fingerprint, plan, "compiled", program, lambda: made.formulas)
                    return cls(plan, "compiled", chosen, identify, made.compiled(), LARGEST_BLOCK, made.row_length)
        except CannotRecordError as error:
            why = f"the model itself, on plain arrays: {error}"
        except UnknownOperationError as unknown:
            why = f"{unknown} is not known to kernels"
        if engine == "compiled":
            raise InputError(Fault(f"{section}.engine", f"cannot be had: {why}", engine, 'take engine="numpy"'))
        return _by_numpy(plan, program, why)

    @functools.cached_property
    def identity(self) -> Fingerprint:
        """The formulas as they are evaluated: on like processors, those that share it give the same bits."""
        return self._identify()

    @property
    def fingerprint(self) -> str:
        """The digest of the formulas as they are evaluated."""
        return self.identity.digest

    @property
    def attributes(self) -> dict[str, str]:
        """Name of the engine that evaluates, and the reason, as attributes of a dataset."""
        return {"engine": self.engine, "engine_reason": self.reason}

    def at(self, values: Mapping[str, Any]) -> Evaluation:
        """The same formulas with other values on the axes; nothing is recorded or compiled again.

        For plans that were made ready for several ``times`` and whose formulas have these axes as inputs: those of one
        dimension, and the numbers that :class:`~ballscrew.engine.evaluation.derivatives.Slopes` differentiates by.
        """
        axes = {**self.plan.axes, **{name: xr.DataArray(value) for name, value in values.items()}}
        sizes = {str(d): size for axis in axes.values() for d, size in zip(axis.dims, axis.shape, strict=True)}
        plan = dataclasses.replace(self.plan, axes=axes, sizes=sizes)
        return Evaluation(
            plan, self.engine, self.reason, self._identify, self._evaluator_of, self._block_size, self._row_length
        )

    def empty(self, count: int) -> dict[str, NDArray[Any]]:
        """Room for the results of so many points."""
        return {name: aligned_array(count, output.dtype) for name, output in self.plan.wanted.items()}

    def fill(
        self,
        results: Mapping[str, NDArray[Any]],
        block: slice,
        *,
        block_size: int | None = None,
        threads: int | None = None,
        done: Callable[[int, int], None] | None = None,
    ) -> None:
        """Evaluate the points of a block of the flattened grid; ``results`` has room for just these.

        Raises :class:`~ballscrew.basis.errors.InputError` for bad values of an axis that is checked where it is read.
        """
        total = block.stop - block.start
        result: _Ends = {name: [] for name in self.plan.unchecked}

        def evaluate(part: slice) -> None:
            self._evaluate(slice(block.start + part.start, block.start + part.stop), results, block.start, result)

        map_blocks(
            evaluate,
            total,
            block_size=block_size or self._usual_block(total, threads),
            threads=threads,
            done=None if done is None else lambda n: done(n, total),
        )
        if result:
            self.plan.check({name: ends(np.array(pairs)) for name, pairs in result.items()})

    def _usual_block(self, total: int, threads: int | None) -> int:
        if self._block_size < SMALLEST_BLOCK and self.engine == "compiled":
            fair = math.ceil(total / (threads or processors()) / LANES) * LANES
            return min(self._block_size, fair)
        if self.engine == "numpy":
            return self._block_size
        fair = math.ceil(total / (BLOCKS_PER_THREAD * (threads or processors())))
        size = min(max(fair, SMALLEST_BLOCK), self._block_size)
        step = self._row_length if 1 < self._row_length <= size else ALIGNMENT
        return math.ceil(size / step) * step


def _by_ball(plan: Plan, ready: ByBall) -> Evaluation:
    # the loads are solved by code of the package, and the numbers of the parts are inputs
    identify = functools.partial(_fingerprint, plan, ready.engine, None, lambda: ready.formulas)
    # whole vectors need no copies with room for the last one
    block = max(1, BLOCK_OF_BALLS // plan.subject.balls // LANES) * LANES
    return Evaluation(plan, ready.engine, ready.reason, identify, ready.evaluator_of, block, 1)


def _of_structure(plan: Plan, times: int) -> StructureKernel | None:
    """The kernel for all numbers of such a screw, where it is there, or so much is asked for that it pays."""
    points = plan.total * times
    if not plan.bounded or points > ENOUGH_TO_FOLD:
        return None
    by: tuple[str, ...] = getattr(plan, "by", ())
    return Structure(plan.subject, plan.outputs, list(plan.axes), by).ready(points)


def _by_structure(plan: Plan, known: StructureKernel) -> Evaluation:
    def evaluator_of(plan: Plan) -> _BlockEvaluator:
        at = known.at(plan)

        def evaluate(part: slice, results: Mapping[str, NDArray[Any]], first: int, result: _Ends) -> None:
            points = plan.points(part)
            for name, noted in result.items():
                noted.append(ends(points[name]))
            at(points, {name: values[part.start - first : part.stop - first] for name, values in results.items()})

        return evaluate

    # the numbers of the parts are inputs
    identify = functools.partial(_fingerprint, plan, "compiled", None, lambda: known.layout.formulas)
    return Evaluation(plan, "compiled", KNOWN, identify, evaluator_of, BLOCK_OF_POINTS, 1)


def _by_numpy(plan: Plan, program: Program | None, reason: str) -> Evaluation:
    # its buffers go with this evaluation, while the program may be kept
    interpreter = None if program is None else program.interpreter.with_own_buffers()

    def evaluator_of(plan: Plan) -> _BlockEvaluator:
        def evaluate(part: slice, results: Mapping[str, NDArray[Any]], first: int, outcome: _Ends) -> None:
            points = plan.points(part)
            for name, noted in outcome.items():
                noted.append(ends(points[name]))
            here = {name: values[part.start - first : part.stop - first] for name, values in results.items()}
            with np.errstate(all="ignore"):
                if interpreter is not None:
                    interpreter.run([points[name] for name in plan.varying], here)
                    return
                result = plan.subject.at(plan.fixed | points)
                for name, output in plan.wanted.items():
                    here[name][...] = output.read(result)

        return evaluate

    identify = functools.partial(_fingerprint, plan, "numpy", program, lambda: program.text if program else "")
    return Evaluation(plan, "numpy", reason, identify, evaluator_of, max(1, BLOCK_SIZE // plan.subject.balls), 1)


def _fingerprint(plan: Plan, engine: Engine, program: Program | None, formulas: Callable[[], str]) -> Fingerprint:
    """Fingerprint of the formulas as they are evaluated: recorded steps, or else the model as code and values."""
    held: dict[str, Any] = {"engine": engine, "formulas": formulas()}
    if program is not None:
        # steps of other libraries are known by more than their names
        functions = [step.function for _, step in program.steps]
        held["functions"] = [f for f in functions if getattr(np, f.__name__, None) is not f]
    else:
        held |= {"package": package_digest(), "evaluated": Configuration.at, "outputs": plan.wanted}
        first = plan.subject.changed({n: v for n, v in plan.points(slice(0, 1)).items() if n not in OPERATION})
        held |= {field.name: getattr(first, field.name) for field in dataclasses.fields(first)}
    return fingerprint_of(held)


def recording_of(plan: Plan, groups: Sequence[int] | None = None) -> Recording:
    """The model as a program of the varying inputs of a plan, in groups where asked for; kept where it can be."""

    def key() -> Any:
        by = getattr(plan, "by", ())
        return type(plan), plan.subject, plan.fixed, plan.varying, plan.outputs, plan.bounded, by, groups

    return recording(key, lambda: plan.recorded(groups))


class _Kernels:
    """A program as assembly, compiled when it is decided to be worth it."""

    row_length = 1

    def __init__(self, plan: Plan, made_of: Recording, program: Program, sources: Sequence[Source]) -> None:
        self.program = program
        self.sources = sources
        self.made_of = made_of
        self.masks = {n: output.dtype is bool for n, output in plan.wanted.items()}
        self.text = made_of.text(program, sources, self.masks)
        self.checks = bool(plan.unchecked) and len(program.steps) <= MOST_STEPS_WATCHED
        self.watched: WatchedKernel | None = None

    @property
    def formulas(self) -> str:
        """All formulas as they are evaluated, as text."""
        return f"{self.text}\n{self.program.text}"

    def compiled(self) -> _EvaluatorFactory:
        """Compile the kernel, and return the evaluator of a part of the grid for a plan."""
        kernel = Kernel.of(self.text, self.sources)
        names, constants = list(self.program.outputs), self.program.constants

        def evaluator_of(plan: Plan) -> _BlockEvaluator:
            def evaluate(part: slice, results: Mapping[str, NDArray[Any]], first: int, result: _Ends) -> None:
                for name, value in constants.items():
                    results[name][part.start - first : part.stop - first] = value
                if names or result:
                    self.evaluate(plan, kernel, part, [results[name] for name in names], first, result)

            return evaluate

        return evaluator_of

    def evaluate(
        self, plan: Plan, kernel: Kernel, part: slice, results: Sequence[NDArray[Any]], first: int, result: _Ends
    ) -> None:
        """Run the kernel over a part of the flattened grid."""
        raise NotImplementedError


class _Points(_Kernels):
    """Every point by itself."""

    @classmethod
    def of(cls, plan: Plan, made_of: Recording) -> _Points:
        """A kernel that reads the inputs of each point."""
        sources: list[Source] = ["points" if plan.axes[name].dims else "rows" for name in plan.varying]
        return cls(plan, made_of, made_of.program, sources)

    def compiled(self) -> _EvaluatorFactory:
        """Compile the kernel, and another one that checks inputs where there are such and it gains."""
        if self.checks:
            text = self.made_of.text(self.program, self.sources, self.masks, watched=True)
            self.watched = WatchedKernel(text, self.sources, lanes_for(self.program))
        return super().compiled()

    def evaluate(
        self, plan: Plan, kernel: Kernel, part: slice, results: Sequence[NDArray[Any]], first: int, result: _Ends
    ) -> None:
        """Run the kernel over a part of the flattened grid."""
        points = plan.points(part)
        inputs = [np.ascontiguousarray(points[name], dtype=float) for name in plan.varying]
        here = [values[part.start - first : part.stop - first] for values in results]
        count = part.stop - part.start
        large = sum(values.nbytes for values in results) > LARGEST_CACHED
        if result and self.watched is not None:
            seen = dict(zip(plan.varying, self.watched(count, inputs, here, past_cache=large), strict=True))
            for name, noted in result.items():
                noted.append(seen[name])
            return
        for name, noted in result.items():
            noted.append(ends(points[name]))
        kernel(slice(0, 1), slice(0, count), count, inputs, here, past_cache=large)


class _Grid(_Kernels):
    """Rows and columns of a grid, with tables of what needs only one of them."""

    def __init__(self, plan: Plan, made_of: Recording, cut: Split, columns: int) -> None:
        super().__init__(plan, made_of, cut.points, [source for source, _ in cut.tables])
        self.plan = plan
        self.row_length = columns
        self.cut = cut
        self.tables = self._tables()

    @classmethod
    def of(cls, plan: Plan) -> _Grid | None:
        """None where the axes do not make a grid that is worth cutting."""
        if len(plan.sizes) < 2:
            return None
        inner = list(plan.sizes)[-inner_axes(plan.shape, FEWEST_COLUMNS) :]
        columns = math.prod(plan.sizes[d] for d in inner)
        groups: list[int] = []
        for name in plan.varying:
            dims = {str(d) in inner for d in plan.axes[name].dims}
            groups.append(sum(COLUMNS if is_inner else ROWS for is_inner in dims) or ROWS)
        if ROWS | COLUMNS in groups or WORTH_CUTTING * (columns + plan.total // columns) > plan.total:
            return None
        made_of = recording_of(plan, groups)
        cut = made_of.cut(groups)
        entries = len(cut.rows.outputs) * (plan.total // columns) + len(cut.columns.outputs) * columns
        return None if entries > MOST_ENTRIES else cls(plan, made_of, cut, columns)

    @property
    def formulas(self) -> str:
        """All formulas as they are evaluated, as text."""
        return "\n".join([super().formulas, self.cut.rows.text, self.cut.columns.text])

    def _tables(self) -> list[NDArray[np.float64]]:
        result: dict[tuple[Source, str], NDArray[np.float64]] = {}
        programs: dict[Source, Program] = {"rows": self.cut.rows, "columns": self.cut.columns}
        for source, program in programs.items():
            names = list(program.outputs)
            row = self.row_length
            places = range(0, self.plan.total, row) if source == "rows" else range(row)
            masks = {i for i, step in program.steps if step.is_mask}
            values = {
                name: np.empty(len(places), dtype=bool if i in masks else float) for name, i in program.outputs.items()
            }
            if names:
                inputs = self.plan.points_at(np.asarray(places))
                with np.errstate(all="ignore"):
                    program.interpreter.with_own_buffers().run([inputs[name] for name in self.plan.varying], values)
            for name in names:
                result[source, name] = values[name].astype(float, copy=False)
        return [result[key] for key in self.cut.tables]

    def evaluate(
        self,
        plan: Plan,  # noqa: ARG002  (tables are made of one plan)
        kernel: Kernel,
        part: slice,
        results: Sequence[NDArray[Any]],
        first: int,
        result: _Ends,  # noqa: ARG002  (axes of a grid are checked before)
    ) -> None:
        """Run the kernel over a part of the flattened grid."""
        for rows, columns in rectangles(part, self.row_length):
            kernel(rows, columns, self.row_length, self.tables, results, first=first)
