"""Programs with reductions over the rows of a grid, cut there: what each point needs, and what each column needs.

The steps before a reduction have a value at each point (row and column), those behind it one for each column. Nothing
is reduced twice (:mod:`ballscrew.compiler.tracing.tape` refuses that), so that a program is cut once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.compiler.tracing.program import Program, Renumbering, required_steps
from ballscrew.compiler.tracing.steps import REDUCTIONS, ROWS, Step
from ballscrew.compiler.tracing.tape import CannotRecordError


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
        return sums_of(self.reductions)


def sums_of(reductions: Sequence[Reduction]) -> dict[str, Any]:
    """The values of which reductions need only the sum or the greatest value, and which."""
    return {one.values: one.function for one in reductions if one.function in (np.sum, np.max)}


def cut_at_reductions(program: Program, groups: Sequence[int]) -> Stages:
    """Cut a program, whose inputs are in the groups given.

    Raises :class:`~ballscrew.compiler.tracing.tape.CannotRecordError` where an output has a value at each row.
    """
    cut = [(i, step) for i, step in program.steps if step.function in REDUCTIONS]
    rank = {i: k for k, (i, _) in enumerate(cut)}
    reductions = [_reduction(step, rank[i], rank) for i, step in cut]
    wanted = {one.values: step.read[0] for one, (_, step) in zip(reductions, cut, strict=True)}
    needed = required_steps(dict(program.steps), wanted.values())
    before = Program(program.inputs, needed, wanted, {}, program.nonnegative)
    behind = _behind(program, rank)
    read = {o for _, step in behind.steps for o in step.read} | {*behind.outputs.values()}
    if any(i in read and group & ROWS for i, group in enumerate(groups)):
        raise CannotRecordError("a result has a value in each row")
    return Stages(before, tuple(reductions), behind)


def _reduction(step: Step, number: int, rank: Mapping[int, int]) -> Reduction:
    """A step as a reduction; an array is kept once, whatever places are looked for in it."""
    values, *places = step.read
    name = f"{number}" if step.function in (np.sum, np.max) else f"of {values}"
    return Reduction(step.function, name, rank[places[0]] if places else None)


def _behind(program: Program, rank: Mapping[int, int]) -> Program:
    """The program behind the reductions, of which each is an input, in their order."""
    inputs = {i: i for i in range(program.inputs)} | {i: program.inputs + k for i, k in rank.items()}
    part = Renumbering(program.inputs + len(rank), inputs)
    left = {i: step for i, step in program.steps if i not in rank}
    for i, step in required_steps(left, program.outputs.values()):
        part.move(i, step)
    return part.part_of(program)


def reduced(reductions: Sequence[Reduction], values: Mapping[str, Any], done: Mapping[str, Any]) -> list[Any]:
    """The results of reductions of arrays by name, whose first axis has the rows; some of them are done."""
    result: list[Any] = []
    for one in reductions:
        if one.values in done:
            result.append(done[one.values])
        elif one.place is None:
            result.append(one.function(values[one.values], axis=0))
        else:
            result.append(np.take_along_axis(values[one.values], result[one.place][None], axis=0)[0])
    return result
