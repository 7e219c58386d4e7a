"""Exact derivatives of a recording by reverse mode, recorded on the same tape.

The steps are visited backwards, and the adjoint of each (the derivative of the output by the step) is
propagated to its operands. Values of the forward pass are reused, so a gradient needs next to no new
transcendental function: the exponential is its own derivative, a logarithm needs a quotient.

At a kink (``maximum``, ``minimum``, ``where``) the derivative is that of the branch taken; the other
branch contributes zero, even where its derivative is infinite. Where the value is NaN, so are its
derivatives. Where a power has no finite derivative (no load, at rest) they are infinite or NaN.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.compiler.tracing.program import required_steps
from ballscrew.compiler.tracing.tape import Step, Tape, Traced, choose


class UnknownDerivativeError(Exception):
    """An operation of a recording whose derivative is not known."""


class _Adjoint(NamedTuple):
    """The derivative of the output by a step, and whether a mask may have made it zero."""

    value: Traced | float
    masked: bool


#: Contributions to the adjoints of a step's operands, from the step's adjoint, its operands and its value.
_Rule = Callable[["_TapeWriter", Any, Sequence[Any], Traced], Sequence[Any]]


def partials(tape: Tape, output: Traced | float, by: Sequence[int]) -> list[Traced | float]:
    """The derivatives of an output by inputs of the tape, recorded on it.

    Raises :class:`UnknownDerivativeError` for an operation without a rule.
    """
    if not isinstance(output, Traced):
        return [0.0 for _ in by]
    last = output.index
    steps = {i: step for i, step in enumerate(tape.steps) if step is not None}
    active = _depending_on(tape, by)
    adjoints: dict[int, _Adjoint] = {last: _Adjoint(1.0, False)}
    writer = _TapeWriter(tape)
    for i, step in reversed(required_steps(steps, [last])):
        if i in adjoints and i in active:
            for operand, contribution in zip(
                step.operands, _operand_adjoints(writer, tape, i, step, adjoints[i]), strict=True
            ):
                if operand[0] == "step" and int(operand[1]) in active and contribution is not None:
                    _accumulate(writer, adjoints, int(operand[1]), contribution)
    is_number = writer(np.equal, tape.value(last), tape.value(last))
    result: list[Traced | float] = []
    for i in by:
        value = adjoints[i].value if i in adjoints else 0.0
        result.append(writer(choose, is_number, value, np.nan))
    return result


class _TapeWriter:
    """Records steps without collecting powers, so that values already computed are reused."""

    def __init__(self, tape: Tape) -> None:
        self.tape = tape

    def __call__(self, function: Any, *operands: Any) -> Any:
        numbers = [o for o in operands if not isinstance(o, Traced)]
        if len(numbers) == len(operands):
            return float(function(*numbers))
        return self.tape.value(self.tape.record(function, *operands, is_mask=function in _MASKS))

    def times(self, left: Any, right: Any) -> Any:
        """A product; a factor of one is left out."""
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
    """The steps that depend on some inputs other than through a mask."""
    depending = set(inputs)
    for i, step in enumerate(tape.steps):
        if step is not None and not step.is_mask:
            operands = step.operands[1:] if step.function is choose else step.operands
            if any(kind == "step" and int(o) in depending for kind, o in operands):
                depending.add(i)
    return depending


def _accumulate(writer: _TapeWriter, adjoints: dict[int, _Adjoint], index: int, contribution: _Adjoint) -> None:
    before = adjoints.get(index)
    if before is None:
        adjoints[index] = contribution
    else:
        adjoints[index] = _Adjoint(writer.plus(before.value, contribution.value), before.masked and contribution.masked)


def _operand_adjoints(
    writer: _TapeWriter, tape: Tape, index: int, step: Step, adjoint: _Adjoint
) -> list[_Adjoint | None]:
    """The contributions of a step to the adjoints of its operands."""
    operands = [tape.value(int(o)) if kind == "step" else o for kind, o in step.operands]
    g, value = adjoint.value, tape.value(index)
    branches = step.function in _BRANCHES
    rule = _RULES.get(step.function)
    if rule is None:
        raise UnknownDerivativeError(step.function.__name__)
    contributions = rule(writer, g, operands, value)
    if adjoint.masked and step.function in _UNBOUNDED and isinstance(g, Traced):
        # a contribution of zero stays zero where the derivative is infinite
        nothing = writer(np.equal, g, 0.0)
        contributions = [
            None if contribution is None else writer.where(nothing, 0.0, contribution) for contribution in contributions
        ]
    return [
        None if contribution is None else _Adjoint(contribution, adjoint.masked or branches)
        for contribution in contributions
    ]


def _negate(writer: _TapeWriter, value: Any) -> Any:
    return writer.times(value, -1.0)


def _of_add(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return g, g


def _of_subtract(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return g, _negate(writer, g)


def _of_multiply(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return writer.times(g, o[1]), writer.times(g, o[0])


def _of_divide(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    above = writer.over(g, o[1])
    return above, _negate(writer, writer.times(above, y))


def _of_power(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    base, exponent = o
    below = writer(np.power, base, writer(np.subtract, exponent, 1.0))
    by_base = writer.times(writer.times(g, exponent), below)
    if not isinstance(exponent, Traced):
        return by_base, None
    # 0 · log 0 = 0
    logarithm = writer(np.log, writer.where(writer(np.equal, base, 0.0), 1.0, base))
    return by_base, writer.times(g, writer.times(y, logarithm))


def _of_choice(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return None, writer.where(o[0], g, 0.0), writer.where(o[0], 0.0, g)


def _of_extreme(relation: Any) -> _Rule:
    def rule(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
        first = writer(relation, o[0], o[1])
        return writer.where(first, g, 0.0), writer.where(first, 0.0, g)

    return rule


def _of_absolute(writer: _TapeWriter, g: Any, o: Sequence[Any], y: Any) -> Sequence[Any]:
    return (writer.where(writer(np.less, o[0], 0.0), _negate(writer, g), g),)


def _times_derivative(slope: Callable[[_TapeWriter, Any, Any], Any]) -> _Rule:
    """A rule from the derivative of a function of one operand."""
    return lambda writer, g, o, y: (writer.times(g, slope(writer, o[0], y)),)


def _divide_by(divisor: Callable[[_TapeWriter, Any, Any], Any]) -> _Rule:
    """A rule from the reciprocal of the derivative of a function of one operand."""
    return lambda writer, g, o, y: (writer.over(g, divisor(writer, o[0], y)),)


def _one_plus_square(writer: _TapeWriter, x: Any, sign: float = 1.0) -> Any:
    return writer.plus(writer.times(writer.times(x, x), sign), 1.0)


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
    np.exp: _times_derivative(lambda writer, x, y: y),
    np.expm1: _times_derivative(lambda writer, x, y: writer.plus(y, 1.0)),
    np.log: _divide_by(lambda writer, x, y: x),
    np.log1p: _divide_by(lambda writer, x, y: writer.plus(x, 1.0)),
    np.sqrt: _divide_by(lambda writer, x, y: writer.times(y, 2.0)),
    np.sin: _times_derivative(lambda writer, x, y: writer(np.cos, x)),
    np.cos: _times_derivative(lambda writer, x, y: _negate(writer, writer(np.sin, x))),
    np.tan: _times_derivative(lambda writer, x, y: _one_plus_square(writer, y)),
    np.arcsin: _divide_by(lambda writer, x, y: writer(np.sqrt, _one_plus_square(writer, x, -1.0))),
    np.arccos: _divide_by(lambda writer, x, y: _negate(writer, writer(np.sqrt, _one_plus_square(writer, x, -1.0)))),
    np.arctan: _divide_by(lambda writer, x, y: _one_plus_square(writer, x)),
    np.arcsinh: _divide_by(lambda writer, x, y: writer(np.sqrt, _one_plus_square(writer, x))),
}
#: Functions with branches, and functions with an unbounded derivative.
_BRANCHES = (choose, np.maximum, np.minimum)
_UNBOUNDED = (np.divide, np.power, np.log, np.log1p, np.sqrt, np.arcsin, np.arccos)
