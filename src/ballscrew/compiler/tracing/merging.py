"""Merging of logarithms: bases with the same weight in every sum become one logarithm of their product.

A recorded model splits powers into sums of logarithms. Some bases occur in every sum with the same or
the opposite weight: load, number of balls and contact angle only as the load of a ball, speed and
viscosity only as their product. One logarithm of a product then replaces those of its factors.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.compiler.tracing.program import Program, Renumbering, required_steps
from ballscrew.compiler.tracing.tape import REDUCTIONS, ROWS, CannotRecordError, Step, Tape, Traced


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


class _LogarithmSum(NamedTuple):
    """A sum of weighted logarithms (by the step whose logarithm it is), of other weighted steps, and a constant."""

    weights: Mapping[int, float]
    others: Mapping[int, float]
    constant: float

    def times(self, factor: float) -> _LogarithmSum:
        """The sum times a number."""
        weights, others = ({i: factor * w for i, w in part.items()} for part in self[:2])
        return _LogarithmSum(weights, others, factor * self.constant)

    def plus(self, other: _LogarithmSum) -> _LogarithmSum:
        """The sum of two sums."""
        weights, others = (
            {i: one.get(i, 0.0) + two.get(i, 0.0) for i in {**one, **two}}
            for one, two in ((self.weights, other.weights), (self.others, other.others))
        )
        return _LogarithmSum(weights, others, self.constant + other.constant)


def merged_program(tape: Tape, outputs: Mapping[str, Any]) -> Program:
    """The part of a tape that the outputs need, with logarithms merged.

    Logarithms that depend on different groups of inputs are not merged.
    """
    traced = {name: value.index for name, value in outputs.items() if isinstance(value, Traced)}
    steps = required_steps({i: step for i, step in enumerate(tape.steps) if step is not None}, traced.values())
    sums = _sums(steps)
    roots = _roots(steps, set(traced.values()), sums)
    members_of = _bases_by_weights({root: sums[root] for root in roots}, tape.groups)
    copy = Tape(tape.inputs, tape.groups[: tape.inputs], tape.nonnegative[: tape.inputs])
    place = {i: i for i in range(tape.inputs)}
    for i, step in steps:
        if i in roots:
            place[i] = _record_sum(copy, sums[i], members_of, place).index
        elif i not in sums:
            operands = [copy.value(place[int(o)]) if kind == "step" else o for kind, o in step.operands]
            place[i] = copy.record(step.function, *operands, is_mask=step.is_mask)
    moved = {name: copy.value(place[traced[name]]) if name in traced else value for name, value in outputs.items()}
    return Program.of(copy, moved)


def _sums(steps: Sequence[tuple[int, Step]]) -> dict[int, _LogarithmSum]:
    """The steps that are weighted sums with a logarithm in them."""
    sums: dict[int, _LogarithmSum] = {}

    def of(kind: str, operand: Any) -> _LogarithmSum:
        if kind == "constant":
            return _LogarithmSum({}, {}, float(operand))
        return sums.get(int(operand), _LogarithmSum({}, {int(operand): 1.0}, 0.0))

    for i, step in steps:
        one: _LogarithmSum | None = None
        if step.function is np.log and step.operands[0][0] == "step":
            one = _LogarithmSum({int(step.operands[0][1]): 1.0}, {}, 0.0)
        elif step.function in (np.add, np.subtract):
            left, right = (of(*operand) for operand in step.operands)
            one = left.plus(right if step.function is np.add else right.times(-1.0))
        elif step.function is np.multiply:
            for (kind, factor), other in (step.operands, step.operands[::-1]):
                if kind == "constant":
                    one = of(*other).times(float(factor))
        if one is not None and one.weights and all(one.weights.values()):
            sums[i] = one
    return sums


def _roots(steps: Sequence[tuple[int, Step]], outputs: set[int], sums: Mapping[int, _LogarithmSum]) -> set[int]:
    """The sums that are used by anything but another sum, or whose logarithm is taken."""
    used = {o for i, step in steps if i not in sums for o in step.read}
    used |= {i for one in sums.values() for part in (one.others, one.weights) for i in part}
    return {i for i in sums if i in used or i in outputs}


def _bases_by_weights(
    roots: Mapping[int, _LogarithmSum], groups: Sequence[int]
) -> dict[int, tuple[tuple[int, float], ...]]:
    """Bases with proportional weights in every sum, for each base, as factors (1) or divisors (−1)."""
    column: dict[int, list[tuple[int, float]]] = {}
    for root, one in roots.items():
        for base, weight in one.weights.items():
            column.setdefault(base, []).append((root, weight))
    alike: dict[Any, list[tuple[int, float]]] = {}
    for base, entries in column.items():
        sign = 1.0 if entries[0][1] > 0 else -1.0
        key = groups[base], tuple((root, sign * weight) for root, weight in entries)
        alike.setdefault(key, []).append((base, sign))
    return {base: tuple(members) for members in alike.values() for base, _ in members}


def _record_sum(tape: Tape, one: _LogarithmSum, members_of: Mapping[int, Any], place: Mapping[int, int]) -> Traced:
    """Record a sum of logarithms, each of a product of merged bases."""
    result: Any = None
    for members in dict.fromkeys(members_of[base] for base in sorted(one.weights)):
        first, sign = members[0]
        weight = sign * one.weights[first]
        factors = [tape.value(place[base]) for base, sign in members if sign > 0]
        divisors = [tape.value(place[base]) for base, sign in members if sign < 0]
        if not factors:
            factors, divisors, weight = divisors, [], -weight
        product = _reduce(tape, np.multiply, factors)
        if divisors:
            product = tape.value(tape.record(np.divide, product, _reduce(tape, np.multiply, divisors)))
        term = tape.value(tape.record(np.log, product))
        term = term if weight == 1 else tape.value(tape.record(np.multiply, term, weight))
        result = term if result is None else tape.value(tape.record(np.add, result, term))
    for other, weight in one.others.items():
        term = tape.value(place[other])
        term = term if weight == 1 else tape.value(tape.record(np.multiply, term, weight))
        result = tape.value(tape.record(np.add, result, term))
    return result if one.constant == 0 else tape.value(tape.record(np.add, result, one.constant))


def _reduce(tape: Tape, function: Any, values: Sequence[Traced]) -> Traced:
    """Values combined from left to right."""
    return functools.reduce(lambda left, right: tape.value(tape.record(function, left, right)), values)
