"""Exact derivatives of what is recorded: reverse mode, written onto the same tape.

Going backwards through the steps, each hands on to its operands what one unit of it is worth to the
output. What the steps have computed is used again, and so a gradient needs next to no new
transcendental function: the exponential is its own derivative, a logarithm asks for a quotient.

At a bend (``maximum``, ``minimum``, ``where``) the derivative is that of the branch taken; a branch
that is not taken counts nothing, even where its slope is infinite. Where the value is NaN, so are
its derivatives. Where a power has no finite slope (no load, at rest) they are infinite or NaN.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.engine.program import needed
from ballscrew.engine.steps import Step, choose
from ballscrew.engine.tape import Tape, Traced


class UnknownSlopeError(Exception):
    """A recording has an operation whose derivative is not known."""


class _Worth(NamedTuple):
    """What one unit of a step is worth to the output; whether a mask may have made it zero."""

    value: Traced | float
    masked: bool


#: What a step's operands get, from the step's own worth, its operands and its value.
_Rule = Callable[["_Pen", Any, Sequence[Any], Traced], Sequence[Any]]


def partials(tape: Tape, output: Traced | float, by: Sequence[int]) -> list[Traced | float]:
    """The derivatives of an output by inputs of the tape, recorded on it.

    Raises :class:`UnknownSlopeError` for an operation without a rule.
    """
    if not isinstance(output, Traced):
        return [0.0 for _ in by]
    last = output.index
    steps = {i: step for i, step in enumerate(tape.steps) if step is not None}
    matter = _depending_on(tape, by)
    worth: dict[int, _Worth] = {last: _Worth(1.0, False)}
    pen = _Pen(tape)
    for i, step in reversed(needed(steps, [last])):
        if i in worth and i in matter:
            for operand, share in zip(step.operands, _shares(pen, tape, i, step, worth[i]), strict=True):
                if operand[0] == "step" and int(operand[1]) in matter and share is not None:
                    _add(pen, worth, int(operand[1]), share)
    is_number = pen(np.equal, tape.value(last), tape.value(last))
    found: list[Traced | float] = []
    for i in by:
        value = worth[i].value if i in worth else 0.0
        found.append(pen(choose, is_number, value, np.nan))
    return found


class _Pen:
    """Writes steps as they are, without collecting powers: what is computed already is to be used, not derived anew."""

    def __init__(self, tape: Tape) -> None:
        self.tape = tape

    def __call__(self, function: Any, *operands: Any) -> Any:
        numbers = [o for o in operands if not isinstance(o, Traced)]
        if len(numbers) == len(operands):
            return float(function(*numbers))
        return self.tape.value(self.tape.record(function, *operands, is_mask=function in _MASKS))

    def times(self, left: Any, right: Any) -> Any:
        """A product; ones and minus ones are not worth a step."""
        for one, other in ((left, right), (right, left)):
            if not isinstance(one, Traced) and one == 1:
                return other
        return self(np.multiply, left, right)

    def plus(self, left: Any, right: Any) -> Any:
        """A sum."""
        return self(np.add, left, right)

    def over(self, left: Any, right: Any) -> Any:
        """A quotient."""
        return self(np.divide, left, right)

    def where(self, mask: Any, yes: Any, no: Any) -> Any:
        """A choice."""
        return self(choose, mask, yes, no)


_MASKS = (np.equal, np.less, np.less_equal, np.greater_equal)


def _depending_on(tape: Tape, inputs: Sequence[int]) -> set[int]:
    """The steps that depend on some inputs by more than a mask."""
    found = set(inputs)
    for i, step in enumerate(tape.steps):
        if step is not None and not step.is_mask:
            operands = step.operands[1:] if step.function is choose else step.operands
            if any(kind == "step" and int(o) in found for kind, o in operands):
                found.add(i)
    return found


def _add(pen: _Pen, worth: dict[int, _Worth], index: int, share: _Worth) -> None:
    before = worth.get(index)
    if before is None:
        worth[index] = share
    else:
        worth[index] = _Worth(pen.plus(before.value, share.value), before.masked and share.masked)


def _shares(pen: _Pen, tape: Tape, index: int, step: Step, worth: _Worth) -> list[_Worth | None]:
    """What each operand of a step gets of the step's worth."""
    operands = [tape.value(int(o)) if kind == "step" else o for kind, o in step.operands]
    g, value = worth.value, tape.value(index)
    bends = step.function in _BENDS
    rule = _RULES.get(step.function)
    if rule is None:
        raise UnknownSlopeError(step.function.__name__)
    shares = rule(pen, g, operands, value)
    if worth.masked and step.function in _STEEP and isinstance(g, Traced):
        # what counts nothing counts nothing, however steep
        nothing = pen(np.equal, g, 0.0)
        shares = [None if share is None else pen.where(nothing, 0.0, share) for share in shares]
    return [None if share is None else _Worth(share, worth.masked or bends) for share in shares]


def _minus(pen: _Pen, value: Any) -> Any:
    return pen.times(value, -1.0)


def _of_add(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return g, g


def _of_subtract(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return g, _minus(pen, g)


def _of_multiply(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return pen.times(g, o[1]), pen.times(g, o[0])


def _of_divide(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    above = pen.over(g, o[1])
    return above, _minus(pen, pen.times(above, y))


def _of_power(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    base, exponent = o
    below = pen(np.power, base, pen(np.subtract, exponent, 1.0))
    by_base = pen.times(pen.times(g, exponent), below)
    if not isinstance(exponent, Traced):
        return by_base, None
    # 0 · log 0 counts nothing
    logarithm = pen(np.log, pen.where(pen(np.equal, base, 0.0), 1.0, base))
    return by_base, pen.times(g, pen.times(y, logarithm))


def _of_choice(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return None, pen.where(o[0], g, 0.0), pen.where(o[0], 0.0, g)


def _of_extreme(relation: Any) -> _Rule:
    def rule(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
        first = pen(relation, o[0], o[1])
        return pen.where(first, g, 0.0), pen.where(first, 0.0, g)

    return rule


def _of_absolute(pen: _Pen, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return (pen.where(pen(np.less, o[0], 0.0), _minus(pen, g), g),)


def _by(slope: Callable[[_Pen, Any, Any], Any]) -> _Rule:
    """A rule from the slope of a function of one operand."""
    return lambda pen, g, o, y: (pen.times(g, slope(pen, o[0], y)),)


def _through(divisor: Callable[[_Pen, Any, Any], Any]) -> _Rule:
    """A rule from one over the slope of a function of one operand."""
    return lambda pen, g, o, y: (pen.over(g, divisor(pen, o[0], y)),)


def _one_plus_square(pen: _Pen, x: Any, sign: float = 1.0) -> Any:
    return pen.plus(pen.times(pen.times(x, x), sign), 1.0)


_RULES: Mapping[Any, _Rule] = {
    np.add: _of_add,
    np.subtract: _of_subtract,
    np.multiply: _of_multiply,
    np.divide: _of_divide,
    np.power: _of_power,
    choose: _of_choice,
    np.maximum: _of_extreme(np.greater_equal),
    np.minimum: _of_extreme(np.less_equal),
    np.absolute: _of_absolute,
    np.exp: _by(lambda pen, x, y: y),
    np.expm1: _by(lambda pen, x, y: pen.plus(y, 1.0)),
    np.log: _through(lambda pen, x, y: x),
    np.log1p: _through(lambda pen, x, y: pen.plus(x, 1.0)),
    np.sqrt: _through(lambda pen, x, y: pen.times(y, 2.0)),
    np.sin: _by(lambda pen, x, y: pen(np.cos, x)),
    np.cos: _by(lambda pen, x, y: _minus(pen, pen(np.sin, x))),
    np.tan: _by(lambda pen, x, y: _one_plus_square(pen, y)),
    np.arcsin: _through(lambda pen, x, y: pen(np.sqrt, _one_plus_square(pen, x, -1.0))),
    np.arccos: _through(lambda pen, x, y: _minus(pen, pen(np.sqrt, _one_plus_square(pen, x, -1.0)))),
    np.arctan: _through(lambda pen, x, y: _one_plus_square(pen, x)),
    np.arcsinh: _through(lambda pen, x, y: pen(np.sqrt, _one_plus_square(pen, x))),
}
#: Where a mask begins, and what can be infinitely steep.
_BENDS = (choose, np.maximum, np.minimum)
_STEEP = (np.divide, np.power, np.log, np.log1p, np.sqrt, np.arcsin, np.arccos)
