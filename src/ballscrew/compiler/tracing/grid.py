"""Grids: steps that depend on one axis only are evaluated once for each of its values.

A grid is cut into rows (the leading axes) and columns (the trailing ones). A program recorded with its
inputs in these two groups falls into three: one over the rows, one over the columns, and the steps
that need both, which are left for every point and read the results of the other two as tables.
Powers of products are factors of one group each (:mod:`ballscrew.compiler.tracing.tape`), so none is left.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.compiler.tracing.program import Program, Renumbering, Source, required_steps
from ballscrew.compiler.tracing.tape import COLUMNS, MASKS, ROWS, CannotRecordError, Step, Tape, choose


class Split(NamedTuple):
    """A program cut along rows and columns; tables are outputs of the first two, by the number of their step."""

    rows: Program
    columns: Program
    points: Program
    #: For each input of ``points``: its source among the first two programs, and the name of the output there; or
    #: else the points themselves, and the number of the input.
    tables: tuple[tuple[Source, str], ...]


def split(program: Program, groups: Sequence[int]) -> Split:
    """Cut a program whose inputs are in the groups given; an input in both groups has a value at each point."""
    group, steps = _group_of_each(program, groups), dict(program.steps)
    inner = [i for i in steps if group[i] in (0, ROWS | COLUMNS)]
    read = {o for i in inner for o in steps[i].read} | {*program.outputs.values()}
    tabled = sorted(i for i in read if group[i] in (ROWS, COLUMNS) or i < program.inputs)
    kinds: dict[int, Source] = {ROWS: "rows", COLUMNS: "columns", ROWS | COLUMNS: "points"}
    sources: list[tuple[Source, str]] = [(kinds[group[i]], str(i)) for i in tabled]
    rows, columns = (_tables(program, steps, [i for i in tabled if group[i] == one]) for one in (ROWS, COLUMNS))
    return Split(rows, columns, _points(program, steps, inner, tabled), tuple(sources))


def _group_of_each(program: Program, groups: Sequence[int]) -> dict[int, int]:
    """The groups of inputs that each input and each step depends on, a bit for each."""
    group = dict(enumerate(groups))
    for i, step in program.steps:
        group[i] = 0
        for kind, operand in step.operands:
            group[i] |= group[int(operand)] if kind == "step" else 0
    return group


def _tables(program: Program, steps: Mapping[int, Step], tabled: Sequence[int]) -> Program:
    """The program of one axis: its outputs are the steps that the points read, by their number."""
    chosen = {str(i): i for i in tabled}
    needed = required_steps(steps, chosen.values())
    return Program(program.inputs, needed, chosen, {}, program.nonnegative)


def _points(program: Program, steps: Mapping[int, Step], inner: Sequence[int], tabled: Sequence[int]) -> Program:
    """The program of what is left for every point, whose inputs are the tables."""
    part = Renumbering(len(tabled), {i: k for k, i in enumerate(tabled)})
    for i in {i for i in tabled if i in steps and steps[i].is_mask}:  # tables hold numbers
        part.number[i] = part.add(Step(np.not_equal, (("step", part.number[i]), ("constant", 0.0)), True))
    for i in inner:
        part.move(i, steps[i])
    return part.part_of(program)


def inner_axes(shape: Sequence[int], fewest_columns: int) -> int:
    """The number of trailing axes that make up at least ``fewest_columns`` columns."""
    count, columns = 1, shape[-1]
    while columns < fewest_columns and count < len(shape) - 1:
        count += 1
        columns *= shape[-count]
    return count


def rectangles(part: slice, row_length: int) -> Iterator[tuple[slice, slice]]:
    """A part of a flattened grid as rectangles of rows and columns: an end, whole rows, a beginning."""
    start, stop = part.start, part.stop
    if start % row_length or stop - start < row_length:
        row = start // row_length
        end = min(stop, (row + 1) * row_length)
        yield slice(row, row + 1), slice(start - row * row_length, end - row * row_length)
        start = end
    if whole := (stop - start) // row_length:
        row = start // row_length
        yield slice(row, row + whole), slice(0, row_length)
        start += whole * row_length
    if start < stop:
        row = start // row_length
        yield slice(row, row + 1), slice(0, stop - start)


class Verbatim(np.lib.mixins.NDArrayOperatorsMixin):
    """The value of a step of a tape."""

    def __init__(self, tape: Tape, index: int) -> None:
        self.tape = tape
        self.index = index

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **kwargs: Any) -> Any:
        """A function of NumPy as a step."""
        if method != "__call__" or kwargs or ufunc.nout != 1:
            raise CannotRecordError(f"numpy.{ufunc.__name__} cannot be recorded as it is called here")
        if ufunc is np.negative:
            return self._step(np.multiply, -1.0, *inputs)
        return self._step(ufunc, *inputs, is_mask=ufunc in MASKS)

    def __array_function__(
        self, function: Callable[..., Any], types: Any, args: Sequence[Any], kwargs: Mapping[str, Any]
    ) -> Any:  # fmt: skip
        """``where`` as a step."""
        if function is not np.where or len(args) != 3 or kwargs:
            raise CannotRecordError(f"numpy.{function.__name__} cannot be recorded")
        return self._step(choose, *args)

    def _step(self, function: Any, *operands: Any, is_mask: bool = False) -> Verbatim:
        traced = (self.tape.value(o.index) if isinstance(o, Verbatim) else o for o in operands)
        return Verbatim(self.tape, self.tape.record(function, *traced, is_mask=is_mask))


def verbatim_program(inputs: int, formula: Callable[..., Mapping[str, Any]]) -> Program:
    """A formula of so many inputs as a program of the results that it names."""
    tape = Tape(inputs)
    result = formula(*(Verbatim(tape, i) for i in range(inputs)))
    return Program.of(tape, {n: tape.value(v.index) if isinstance(v, Verbatim) else v for n, v in result.items()})
