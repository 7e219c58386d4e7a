"""Logarithms that always go together are one: that of a product.

A recorded model takes powers apart into sums of logarithms. Some of these come in every sum with the
same weight, or the opposite one: load, number of balls and contact angle only as the load of a ball,
speed and viscosity only as their product. One logarithm of a product then does the work of all.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.engine.program import Program, needed
from ballscrew.engine.steps import Step
from ballscrew.engine.tape import Tape, Traced


class _Sum(NamedTuple):
    """A sum of weighted logarithms (by the step whose logarithm it is), of other weighted steps, and a constant."""

    weights: Mapping[int, float]
    others: Mapping[int, float]
    constant: float

    def times(self, factor: float) -> _Sum:
        """The sum times a number."""
        weights, others = ({i: factor * w for i, w in part.items()} for part in self[:2])
        return _Sum(weights, others, factor * self.constant)

    def plus(self, other: _Sum) -> _Sum:
        """Two sums together."""
        weights, others = (
            {i: one.get(i, 0.0) + two.get(i, 0.0) for i in {**one, **two}}
            for one, two in ((self.weights, other.weights), (self.others, other.others))
        )
        return _Sum(weights, others, self.constant + other.constant)


def merged_program(tape: Tape, outputs: Mapping[str, Any]) -> Program:
    """What of a tape the outputs need, with as few logarithms as that takes.

    What belongs to different groups of inputs is kept apart.
    """
    traced = {name: value.index for name, value in outputs.items() if isinstance(value, Traced)}
    steps = needed({i: step for i, step in enumerate(tape.steps) if step is not None}, traced.values())
    sums = _sums(steps)
    roots = _roots(steps, set(traced.values()), sums)
    together = _together({root: sums[root] for root in roots}, tape.groups)
    copy = Tape(tape.inputs, tape.groups[: tape.inputs], tape.nonnegative[: tape.inputs])
    place = {i: i for i in range(tape.inputs)}
    for i, step in steps:
        if i in roots:
            place[i] = _written(copy, sums[i], together, place).index
        elif i not in sums:
            operands = [copy.value(place[int(o)]) if kind == "step" else o for kind, o in step.operands]
            place[i] = copy.record(step.function, *operands, is_mask=step.is_mask)
    moved = {name: copy.value(place[traced[name]]) if name in traced else value for name, value in outputs.items()}
    return Program.of(copy, moved)


def _sums(steps: Sequence[tuple[int, Step]]) -> dict[int, _Sum]:
    """The steps that are weighted sums with a logarithm in them."""
    found: dict[int, _Sum] = {}

    def of(kind: str, operand: Any) -> _Sum:
        if kind == "constant":
            return _Sum({}, {}, float(operand))
        return found.get(int(operand), _Sum({}, {int(operand): 1.0}, 0.0))

    for i, step in steps:
        one: _Sum | None = None
        if step.function is np.log and step.operands[0][0] == "step":
            one = _Sum({int(step.operands[0][1]): 1.0}, {}, 0.0)
        elif step.function in (np.add, np.subtract):
            left, right = (of(*operand) for operand in step.operands)
            one = left.plus(right if step.function is np.add else right.times(-1.0))
        elif step.function is np.multiply:
            for (kind, factor), other in (step.operands, step.operands[::-1]):
                if kind == "constant":
                    one = of(*other).times(float(factor))
        if one is not None and one.weights and all(one.weights.values()):
            found[i] = one
    return found


def _roots(steps: Sequence[tuple[int, Step]], outputs: set[int], sums: Mapping[int, _Sum]) -> set[int]:
    """The sums that something else than a sum makes use of."""
    used = {int(o) for i, step in steps if i not in sums for kind, o in step.operands if kind == "step"}
    used |= {i for one in sums.values() for i in one.others}
    return {i for i in sums if i in used or i in outputs}


def _together(roots: Mapping[int, _Sum], groups: Sequence[int]) -> dict[int, tuple[tuple[int, float], ...]]:
    """For each base, those that go with it wherever it goes, and whether as factors (1) or as divisors (−1)."""
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


def _written(tape: Tape, one: _Sum, together: Mapping[int, Any], place: Mapping[int, int]) -> Traced:
    """A sum of logarithms, each of a product of those that go together."""
    result: Any = None
    for members in dict.fromkeys(together[base] for base in sorted(one.weights)):
        first, sign = members[0]
        weight = sign * one.weights[first]
        factors = [tape.value(place[base]) for base, sign in members if sign > 0]
        divisors = [tape.value(place[base]) for base, sign in members if sign < 0]
        if not factors:
            factors, divisors, weight = divisors, [], -weight
        product = _chain(tape, np.multiply, factors)
        if divisors:
            product = tape.value(tape.record(np.divide, product, _chain(tape, np.multiply, divisors)))
        term = tape.value(tape.record(np.log, product))
        term = term if weight == 1 else tape.value(tape.record(np.multiply, term, weight))
        result = term if result is None else tape.value(tape.record(np.add, result, term))
    for other, weight in one.others.items():
        term = tape.value(place[other])
        term = term if weight == 1 else tape.value(tape.record(np.multiply, term, weight))
        result = tape.value(tape.record(np.add, result, term))
    return result if one.constant == 0 else tape.value(tape.record(np.add, result, one.constant))


def _chain(tape: Tape, function: Any, values: Sequence[Traced]) -> Traced:
    """Values taken together one after the other."""
    return functools.reduce(lambda left, right: tape.value(tape.record(function, left, right)), values)
