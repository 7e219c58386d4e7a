"""Logarithms on a tape: products of powers as weighted sums, with as few new logarithms as they need."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from ballscrew.compiler.tracing.steps import Step, choose


class Recorder(Protocol):
    """The part of a tape (:class:`~ballscrew.compiler.tracing.tape.Tape`) that logarithms are recorded with."""

    steps: list[Step | None]
    nonnegative: list[bool]

    def record(self, function: Any, *operands: Any, is_mask: bool = False) -> int:
        """Record a step, or find an equal one."""
        ...

    def step(self, function: Any, *operands: Any) -> Any:
        """Record a step and return its value; fold it where all operands are constants."""
        ...

    def is_recorded(self, function: Any, *operands: Any) -> bool:
        """Return whether a step is recorded already."""
        ...

    def value(self, index: int) -> Any:
        """Return the value of a step."""
        ...


def folds_into_exponent(tape: Recorder, index: int, power: float) -> bool:
    """Return whether an integer power is cheaper as a term of the exponent: of an exponential, or a divisor."""
    step = tape.steps[index]
    if step is not None and step.function is np.exp:
        return True
    return power < 0 and tape.nonnegative[index] and tape.is_recorded(np.log, tape.value(index))


def sum_of_logarithms(tape: Recorder, powers: Sequence[tuple[int, float]], scale: float = 1.0) -> Any:
    """The logarithm of a product of powers."""
    result: Any = float(np.log(scale)) if scale != 1 else None
    for i, power in powers:
        term = logarithm(tape, i)
        term = term if power == 1 else tape.step(np.multiply, term, power)
        result = term if result is None else tape.step(np.add, result, term)
    return result


def logarithm(tape: Recorder, index: int) -> Any:
    """The logarithm of a step, from logarithms already recorded where that saves one."""
    step = tape.steps[index]
    value = tape.value(index)
    if not tape.nonnegative[index] and tape.is_recorded(np.absolute, value) and not tape.is_recorded(np.log, value):
        size = tape.value(tape.record(np.absolute, value))
        negative = tape.value(tape.record(np.less, value, 0.0, is_mask=True))
        return tape.step(choose, negative, np.nan, tape.value(tape.record(np.log, size)))
    if step is None or tape.is_recorded(np.log, value):
        return tape.value(tape.record(np.log, value))
    if step.function is np.exp:
        return tape.value(int(step.operands[0][1]))
    if step.function is choose and step.operands[1] == ("constant", 0.0) and step.operands[2][0] == "step":
        mask, kept = (tape.value(int(o)) for _, o in (step.operands[0], step.operands[2]))
        return tape.step(choose, mask, -np.inf, logarithm(tape, kept.index))
    if step.function in (np.multiply, np.divide) and _is_sum_of_recorded(tape, index):
        terms = [logarithm(tape, int(o)) if kind == "step" else float(np.log(o)) for kind, o in step.operands]
        return tape.step(np.add if step.function is np.multiply else np.subtract, *terms)
    return tape.value(tape.record(np.log, tape.value(index)))


def _is_sum_of_recorded(tape: Recorder, index: int) -> bool:
    """Return whether the logarithm of a product follows from those of its factors, with at most one new logarithm.

    At most one factor may be negative: a product of two is positive, but has no sum of logarithms.
    """
    factors, pending = set[int](), [index]
    while pending:
        step = tape.steps[i := pending.pop()]
        if (
            step is not None
            and step.function in (np.multiply, np.divide)
            and not tape.is_recorded(np.log, tape.value(i))
        ):
            if any(kind == "constant" and not o > 0 for kind, o in step.operands):
                return False
            pending += step.read
        else:
            factors.add(i)
    if sum(not tape.nonnegative[i] for i in factors) > 1:
        return False
    return sum(not _has_logarithm(tape, i) for i in factors) <= 1


def _has_logarithm(tape: Recorder, index: int) -> bool:
    step = tape.steps[index]
    return (step is not None and step.function is np.exp) or tape.is_recorded(np.log, tape.value(index))
