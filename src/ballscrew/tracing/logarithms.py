"""Logarithms on a tape: products of powers as weighted sums, with as few new logarithms as they need."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ballscrew.engine.steps import choose

if TYPE_CHECKING:
    from ballscrew.engine.tape import Tape


def goes_along(tape: Tape, index: int, power: float) -> bool:
    """Whether a whole power is cheaper in an exponent that is there anyway: an exponential, or a divisor."""
    step = tape.steps[index]
    if step is not None and step.function is np.exp:
        return True
    return power < 0 and tape.nonnegative[index] and tape.is_known(np.log, tape.value(index))


def sum_of_logarithms(tape: Tape, powers: Sequence[tuple[int, float]], scale: float = 1.0) -> Any:
    """The logarithm of a product of powers."""
    result: Any = float(np.log(scale)) if scale != 1 else None
    for i, power in powers:
        term = logarithm(tape, i)
        term = term if power == 1 else tape.step(np.multiply, term, power)
        result = term if result is None else tape.step(np.add, result, term)
    return result


def logarithm(tape: Tape, index: int) -> Any:
    """The logarithm of a step, from logarithms that are there already where that spares one."""
    step = tape.steps[index]
    value = tape.value(index)
    if not tape.nonnegative[index] and tape.is_known(np.absolute, value) and not tape.is_known(np.log, value):
        size = tape.value(tape.record(np.absolute, value))
        negative = tape.value(tape.record(np.less, value, 0.0, is_mask=True))
        return tape.step(choose, negative, np.nan, tape.value(tape.record(np.log, size)))
    if step is None or tape.is_known(np.log, value):
        return tape.value(tape.record(np.log, value))
    if step.function is np.exp:
        return tape.value(int(step.operands[0][1]))
    if step.function is choose and step.operands[1] == ("constant", 0.0) and step.operands[2][0] == "step":
        mask, kept = (tape.value(int(o)) for _, o in (step.operands[0], step.operands[2]))
        return tape.step(choose, mask, -np.inf, logarithm(tape, kept.index))
    if step.function in (np.multiply, np.divide) and _is_spared(tape, index):
        terms = [logarithm(tape, int(o)) if kind == "step" else float(np.log(o)) for kind, o in step.operands]
        return tape.step(np.add if step.function is np.multiply else np.subtract, *terms)
    return tape.value(tape.record(np.log, tape.value(index)))


def _is_spared(tape: Tape, index: int) -> bool:
    """Whether the logarithm of a product is to be had from those of its factors, with one new logarithm at most.

    At most one factor may be negative: a product of two is positive, but has no sum of logarithms.
    """
    factors, waiting = set[int](), [index]
    while waiting:
        step = tape.steps[i := waiting.pop()]
        if step is not None and step.function in (np.multiply, np.divide) and not tape.is_known(np.log, tape.value(i)):
            if any(kind == "constant" and not o > 0 for kind, o in step.operands):
                return False
            waiting += [int(o) for kind, o in step.operands if kind == "step"]
        else:
            factors.add(i)
    if sum(not tape.nonnegative[i] for i in factors) > 1:
        return False
    return sum(not _has_logarithm(tape, i) for i in factors) <= 1


def _has_logarithm(tape: Tape, index: int) -> bool:
    step = tape.steps[index]
    return (step is not None and step.function is np.exp) or tape.is_known(np.log, tape.value(index))
