"""Grids: steps that depend on one axis only are evaluated once for each of its values.

A grid is cut into rows (the leading axes) and columns (the trailing ones). A program recorded with its
inputs in these two groups falls into three: one over the rows, one over the columns, and the steps
that need both, which are left for every point and read the results of the other two as tables.
Powers of products are factors of one group each (:mod:`ballscrew.tracing.tape`), so none is left.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ballscrew.tracing.program import Program, Source, required_steps
from ballscrew.tracing.steps import Step

#: The groups of inputs.
ROWS, COLUMNS = 1, 2


class Split(NamedTuple):
    """A program cut along rows and columns; tables are outputs of the first two, by the number of their step."""

    rows: Program
    columns: Program
    points: Program
    #: For each input of ``points``: its source among the first two programs, and the name of the output there.
    tables: tuple[tuple[Source, str], ...]


def split(program: Program, groups: Sequence[int]) -> Split:
    """Cut a program whose inputs are in the groups given; an input in both groups cannot be cut."""
    group = dict(enumerate(groups))
    for i, step in program.steps:
        group[i] = 0
        for kind, operand in step.operands:
            group[i] |= group[int(operand)] if kind == "step" else 0
    inner = [(i, step) for i, step in program.steps if group[i] in (0, ROWS | COLUMNS)]
    read = {int(o) for _, step in inner for kind, o in step.operands if kind == "step"} | {*program.outputs.values()}
    tabled = sorted(i for i in read if group[i] in (ROWS, COLUMNS))
    steps = dict(program.steps)
    masks = {i for i in tabled if i in steps and steps[i].is_mask}

    def tables(of: int) -> Program:
        chosen = {str(i): i for i in tabled if group[i] == of}
        return Program(program.inputs, required_steps(steps, chosen.values()), chosen, {}, program.nonnegative)

    number = {i: k for k, i in enumerate(tabled)}
    renumbered: list[tuple[int, Step]] = []

    def write(step: Step) -> int:
        renumbered.append((len(tabled) + len(renumbered), step))
        return renumbered[-1][0]

    for i in masks:  # tables hold numbers
        number[i] = write(Step(np.not_equal, (("step", number[i]), ("constant", 0.0)), True))
    for i, step in inner:
        operands = tuple((kind, number[int(o)] if kind == "step" else o) for kind, o in step.operands)
        number[i] = write(step._replace(operands=operands))
    outputs = {name: number[i] for name, i in program.outputs.items()}
    nonnegative = frozenset(number[i] for i in program.nonnegative if i in number)
    points = Program(len(tabled), tuple(renumbered), outputs, program.constants, nonnegative)
    sources: list[tuple[Source, str]] = [("rows" if group[i] == ROWS else "columns", str(i)) for i in tabled]
    return Split(tables(ROWS), tables(COLUMNS), points, tuple(sources))


def inner_axes(shape: Sequence[int], fewest_columns: int) -> int:
    """The number of trailing axes that make up at least ``fewest_columns`` columns."""
    count, columns = 1, shape[-1]
    while columns < fewest_columns and count < len(shape) - 1:
        count += 1
        columns *= shape[-count]
    return count
