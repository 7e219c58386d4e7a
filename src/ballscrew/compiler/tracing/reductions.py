"""Programs with reductions over the rows of a grid, cut there: what each point needs, and what each column needs.

The steps before a reduction have a value at each point (row and column), those behind it one for each column. Nothing
is reduced twice (:mod:`ballscrew.tracing.tape` refuses that), so that a program is cut once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.tracing.program import Program, required_steps
from ballscrew.tracing.steps import REDUCTIONS, ROWS, Step
from ballscrew.tracing.tape import CannotRecordError


class Reduction(NamedTuple):
    """A reduction over the rows: of an output of the first program, with the place that an earlier one has found."""

    function: Any
    values: str
    place: int | None


class Stages(NamedTuple):
    """A program cut at its reductions. The second part has the results of the reductions as further inputs, last."""

    before: Program
    reductions: tuple[Reduction, ...]
    behind: Program

    @property
    def sums(self) -> dict[str, Any]:
        """The outputs of the first program of which only the sum or the greatest value is needed, and which."""
        return {one.values: one.function for one in self.reductions if one.function in (np.sum, np.max)}


def cut_at_reductions(program: Program, groups: Sequence[int]) -> Stages:
    """Cut a program, whose inputs are in the groups given.

    Raises :class:`~ballscrew.tracing.tape.CannotRecordError` where an output has a value at each row.
    """
    steps = dict(program.steps)
    rank = {i: k for k, i in enumerate(i for i, step in program.steps if step.function in REDUCTIONS)}
    reductions: list[Reduction] = []
    wanted: dict[str, int] = {}
    for i, k in rank.items():
        (_, values), *places = steps[i].operands
        name = f"{k}" if steps[i].function in (np.sum, np.max) else f"of {values}"
        wanted[name] = int(values)
        reductions.append(Reduction(steps[i].function, name, rank[int(places[0][1])] if places else None))
    before = Program(program.inputs, required_steps(steps, wanted.values()), wanted, {}, program.nonnegative)
    inputs = program.inputs + len(rank)
    number = {i: i for i in range(program.inputs)} | {i: program.inputs + k for i, k in rank.items()}
    left = {i: step for i, step in program.steps if i not in rank}
    renumbered: list[tuple[int, Step]] = []
    for i, step in required_steps(left, program.outputs.values()):
        operands = tuple((kind, number[int(o)] if kind == "step" else o) for kind, o in step.operands)
        number[i] = inputs + len(renumbered)
        renumbered.append((number[i], step._replace(operands=operands)))
    outputs = {name: number[i] for name, i in program.outputs.items()}
    read = {int(o) for _, step in renumbered for kind, o in step.operands if kind == "step"} | {*outputs.values()}
    if any(i in read and group & ROWS for i, group in enumerate(groups)):
        raise CannotRecordError("a result has a value in each row")
    nonnegative = frozenset(number[i] for i in program.nonnegative if i in number)
    behind = Program(inputs, tuple(renumbered), outputs, program.constants, nonnegative)
    return Stages(before, tuple(reductions), behind)


def reduced(reductions: Sequence[Reduction], values: Mapping[str, Any], done: Mapping[str, Any]) -> list[Any]:
    """The results of reductions of arrays by name, whose first axis has the rows; some of them are done."""
    found: list[Any] = []
    for one in reductions:
        if one.values in done:
            found.append(done[one.values])
        elif one.place is None:
            found.append(one.function(values[one.values], axis=0))
        else:
            found.append(np.take_along_axis(values[one.values], found[one.place][None], axis=0)[0])
    return found
