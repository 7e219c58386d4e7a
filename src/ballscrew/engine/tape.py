"""A model, recorded once to be evaluated many times.

The model is called with :class:`Traced` values instead of arrays. What they go through is written
down: constants fold as they go, equal steps are shared, steps no output needs are dropped, and
products of powers (film, rolling force, contact size, elastic moment) are kept as exponents until
somebody needs a sum, so that one exponential of a weighted sum of logarithms does the work of
several powers, for both contacts at once. The equations do not know: they see an array. What is
raised to a broken power is taken to be positive or zero, as everywhere in the model.

Inputs may come in groups (the axes of a grid). A product of powers then becomes one factor for each
group, so that a factor can be computed once for each value of its axis.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

#: Whole powers up to this one are multiplied out.
HIGHEST_WHOLE_POWER = 8

#: A step's operand: the index of an earlier step, or a constant.
Operand = int | float | bool


class Step(NamedTuple):
    """One elementwise operation on earlier steps and constants."""

    function: Any
    operands: tuple[tuple[str, Operand], ...]
    is_mask: bool


def choose(mask: Any, yes: Any, no: Any, out: NDArray[Any]) -> None:
    """``where`` into a buffer of its own."""
    np.copyto(out, no)
    np.copyto(out, yes, where=mask)


class Tape:
    """The steps recorded so far; the first ones are the inputs."""

    def __init__(
        self, inputs: int, groups: Sequence[int] | None = None, nonnegative: Sequence[bool] | None = None
    ) -> None:
        self.inputs = inputs
        self.steps: list[Step | None] = [None] * inputs
        #: The groups of inputs that each step depends on, a bit for each.
        self.groups = [1] * inputs if groups is None else list(groups)
        #: Whether each step is known to be positive, zero or NaN.
        self.nonnegative = [False] * inputs if nonnegative is None else list(nonnegative)
        self._known: dict[Step, int] = {}

    def record(self, function: Any, *operands: Any, is_mask: bool = False) -> int:
        """Write down a step, or find it if it is written down already."""
        coded = tuple(("step", o.index) if isinstance(o, Traced) else ("constant", o) for o in operands)
        step = Step(function, coded, is_mask)
        if step not in self._known:
            self.steps.append(step)
            self.groups.append(0)
            for kind, operand in coded:
                self.groups[-1] |= self.groups[int(operand)] if kind == "step" else 0
            self.nonnegative.append(self._is_nonnegative(step))
            self._known[step] = len(self.steps) - 1
        return self._known[step]

    def _is_nonnegative(self, step: Step) -> bool:
        if step.function in (np.exp, np.sqrt, np.absolute):
            return True
        if step.function not in _KEEP_SIGN:
            return False
        operands = step.operands[1:] if step.function is choose else step.operands
        return all(self.nonnegative[int(o)] if kind == "step" else o >= 0 for kind, o in operands)

    def is_known(self, function: Any, *operands: Any) -> bool:
        """Whether a step is written down already."""
        coded = tuple(("step", o.index) if isinstance(o, Traced) else ("constant", o) for o in operands)
        return Step(function, coded, False) in self._known

    def value(self, index: int) -> Traced:
        """The value of a step."""
        return Traced(self, {index: 1.0}, 1.0)

    def is_mask(self, index: int) -> bool:
        """Whether a step yields truth values."""
        step = self.steps[index]
        return step is not None and step.is_mask


_MASKS = {
    np.equal, np.not_equal, np.less, np.less_equal, np.greater, np.greater_equal,
    np.isfinite, np.isnan, np.isinf, np.logical_and, np.logical_or, np.logical_xor, np.logical_not,
}  # fmt: skip
#: What makes positive numbers of positive numbers.
_KEEP_SIGN = {np.add, np.multiply, np.divide, np.maximum, np.minimum, np.power, choose}
_TRUTH = {np.bitwise_and, np.bitwise_or, np.bitwise_xor, np.invert}


class Traced(np.lib.mixins.NDArrayOperatorsMixin):
    """``scale · ∏ step**exponent``: an array in the making.

    Where the mask ``zero`` holds (the index of a step), the product is zero whatever its factors are.
    """

    def __init__(self, tape: Tape, powers: Mapping[int, float], scale: float, zero: int | None = None) -> None:
        self.tape = tape
        self.powers = dict(powers)
        self.scale = np.float64(scale)  # divides by zero as arrays do
        self.zero = zero
        self._index: int | None = None

    @property
    def index(self) -> int:
        """The step that holds the values; recorded when first asked for."""
        if self._index is None:
            core = self._core()
            if self.zero is not None:
                core = self.tape.record(choose, self.tape.value(self.zero), 0.0, self.tape.value(core))
            self._index = core if self.scale == 1 else self.tape.record(np.multiply, self.tape.value(core), self.scale)
        return self._index

    def _core(self) -> int:
        """The step that holds the product without its scale: a factor for each group of inputs."""
        tape = self.tape
        result: int | None = None
        for _, powers in _by_group(tape, self.powers):
            factor = _product(tape, powers)
            result = factor if result is None else tape.record(np.multiply, tape.value(result), tape.value(factor))
        return tape.record(np.multiply, 1.0, 1.0) if result is None else result

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **kwargs: Any) -> Any:
        """Products, quotients and constant powers stay exponents; all else becomes a step."""
        if method != "__call__" or kwargs or ufunc.nout != 1:
            return NotImplemented
        if ufunc is np.positive:
            return self
        if ufunc is np.negative:
            return _times(self, -1.0, 1.0)
        if ufunc is np.square:
            return self._raised(2.0)
        if ufunc is np.sqrt:
            return self._raised(0.5)
        if ufunc is np.multiply and not any(map(_is_mask, inputs)):
            return _times(inputs[0], inputs[1], 1.0)
        if ufunc is np.divide and not any(map(_is_mask, inputs)):
            return _times(inputs[0], inputs[1], -1.0)
        if ufunc in (np.add, np.subtract) and _is_nothing(inputs[1]) and not _is_mask(inputs[0]):
            return inputs[0]
        if ufunc is np.add and _is_nothing(inputs[0]) and not _is_mask(inputs[1]):
            return inputs[1]
        if ufunc is np.power:
            return _power(*inputs)
        if (
            ufunc in (np.equal, np.not_equal)
            and not isinstance(inputs[1], Traced)
            and inputs[1] == 0
            and self.scale != 0
        ):
            inputs = (Traced(self.tape, self.powers, 1.0, self.zero), inputs[1])  # the scale does not matter
        is_mask = ufunc in _MASKS or (ufunc in _TRUTH and all(map(_is_mask, inputs)))
        return self.tape.value(self.tape.record(ufunc, *map(_constant, inputs), is_mask=is_mask))

    def __array_function__(
        self, function: Callable[..., Any], types: Any, args: Sequence[Any], kwargs: Mapping[str, Any]
    ) -> Any:  # fmt: skip
        """``where`` becomes a step; ``where(mask, 0.0, product)`` keeps the scale of the product."""
        if function is not np.where or len(args) != 3 or kwargs:
            return NotImplemented
        mask, yes, no = args
        if not isinstance(mask, Traced):
            return yes if mask else no
        if isinstance(no, Traced) and not _is_mask(no) and not isinstance(yes, Traced) and yes == 0:
            no = no.settled
            return Traced(self.tape, no.powers, no.scale, mask.index)
        choice = self.tape.record(choose, mask, _constant(yes), _constant(no), is_mask=_is_mask(yes) and _is_mask(no))
        return self.tape.value(choice)

    def __getitem__(self, key: tuple[()]) -> Traced:
        """``x[()]``, which turns a NumPy array without axes into a number, is the value itself."""
        if key != ():
            raise TypeError("a traced value has no axes to index")
        return self

    def __array__(self, *_: Any, **__: Any) -> Any:
        """A traced value has no numbers yet; a law that needs them is evaluated on plain arrays."""
        raise TypeError("a traced value cannot become an array")

    def __bool__(self) -> bool:
        """A traced value has no truth: what depends on it must be said with ``where``."""
        raise TypeError("a traced value has no truth value; use where()")

    @property
    def settled(self) -> Traced:
        """The same value, with nothing left to be said about where it is zero."""
        return self if self.zero is None else self.tape.value(self.index)

    def _raised(self, exponent: float) -> Traced:
        """A power; what folding exponents would change (see :func:`_folds`) is a step of its own."""
        if self.zero is not None and not (exponent > 0 and np.isfinite(self.scale) and self.scale > 0):
            return self.settled._raised(exponent)
        folds = all(_folds(p, exponent) for p in self.powers.values())
        if not folds or (self.scale < 0 and exponent != int(exponent)):
            return self.tape.value(self.tape.record(np.power, self, exponent))
        return Traced(self.tape, {i: p * exponent for i, p in self.powers.items()}, self.scale**exponent, self.zero)


def _by_group(tape: Tape, powers: Mapping[int, float]) -> Iterator[tuple[int, list[tuple[int, float]]]]:
    """Factors of a product by the groups of inputs they depend on; the latest first, as that is what is shared."""
    ordered = sorted(powers.items(), reverse=True)
    for group in dict.fromkeys(tape.groups[i] for i, _ in ordered):
        yield group, [(i, p) for i, p in ordered if tape.groups[i] == group]


def _product(tape: Tape, powers: Sequence[tuple[int, float]]) -> int:
    """The step that holds a product of powers.

    Whole powers are multiplied out, as their base may be negative; alone, a root is cheaper than a logarithm.
    """
    if len(powers) == 1 and powers[0][1] == 1:
        return powers[0][0]
    if all(p % 2 == 0 for _, p in powers):  # the square of what is likely to be there already
        root = tape.value(_product(tape, [(i, p / 2) for i, p in powers]))
        return tape.record(np.multiply, root, root)
    broken = [(i, p) for i, p in powers if p != int(p)]
    roots = broken if all(abs(p) == 0.5 for _, p in broken) else []
    result: int | None = None
    if broken and not roots:
        broken = [(i, p) for i, p in powers if p != int(p) or _goes_along(tape, i, p)]
        powers = [(i, p) for i, p in powers if (i, p) not in broken]
        result = tape.record(np.exp, _sum_of_logarithms(tape, broken))
    factors = [(i, p) for i, p in powers if p == int(p) for _ in range(int(abs(p)))]
    factors += [(tape.record(np.sqrt, tape.value(i)), p) for i, p in roots]
    for i, power in factors:
        if power < 0:
            start = 1.0 if result is None else tape.value(result)
            result = tape.record(np.divide, start, tape.value(i))
        else:
            result = i if result is None else tape.record(np.multiply, tape.value(result), tape.value(i))
    assert result is not None, "a product has factors"
    return result


def _goes_along(tape: Tape, index: int, power: float) -> bool:
    """Whether a whole power is cheaper in an exponent that is there anyway: an exponential, or a divisor."""
    step = tape.steps[index]
    if step is not None and step.function is np.exp:
        return True
    return power < 0 and tape.nonnegative[index] and tape.is_known(np.log, tape.value(index))


def _sum_of_logarithms(tape: Tape, powers: Sequence[tuple[int, float]], scale: float = 1.0) -> Any:
    """The logarithm of a product of powers."""
    result: Any = float(np.log(scale)) if scale != 1 else None
    for i, power in powers:
        logarithm = _logarithm(tape, i)
        term = logarithm if power == 1 else _step(tape, np.multiply, logarithm, power)
        result = term if result is None else _step(tape, np.add, result, term)
    return result


def _logarithm(tape: Tape, index: int) -> Any:
    """The logarithm of a step, from logarithms that are there already where that spares one."""
    step = tape.steps[index]
    if step is None or tape.is_known(np.log, tape.value(index)):
        return tape.value(tape.record(np.log, tape.value(index)))
    if step.function is np.exp:
        return tape.value(int(step.operands[0][1]))
    if step.function is choose and step.operands[1] == ("constant", 0.0) and step.operands[2][0] == "step":
        mask, kept = (tape.value(int(o)) for _, o in (step.operands[0], step.operands[2]))
        return _step(tape, choose, mask, -np.inf, _logarithm(tape, kept.index))
    if step.function in (np.multiply, np.divide) and _is_spared(tape, index):
        terms = [_logarithm(tape, int(o)) if kind == "step" else float(np.log(o)) for kind, o in step.operands]
        return _step(tape, np.add if step.function is np.multiply else np.subtract, *terms)
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


def _step(tape: Tape, function: Any, *operands: Any) -> Any:
    """A step as it is, or a constant."""
    if not any(isinstance(o, Traced) for o in operands):
        return float(function(*operands))
    return tape.value(tape.record(function, *operands))


def _power(base: Any, exponent: Any) -> Traced:
    """A power; one with an exponent that is recorded too is ``exp(exponent · log(base))``, and 1 for the exponent 0.

    Its base is taken to be positive or zero, like that of any broken power.
    """
    if not isinstance(exponent, Traced):
        return base._raised(float(exponent))
    tape = exponent.tape
    if not isinstance(base, Traced):
        logarithm: Any = float(np.log(_constant(base)))
    elif base.scale > 0:
        logarithm = _sum_of_logarithms(tape, sorted(base.powers.items(), reverse=True), base.scale)
        if base.zero is not None:
            logarithm = _step(tape, choose, tape.value(base.zero), -np.inf, logarithm)
    else:
        logarithm = _logarithm(tape, base.index)
    is_nothing = tape.value(tape.record(np.equal, exponent, 0.0, is_mask=True))
    product = _step(tape, choose, is_nothing, 0.0, _step(tape, np.multiply, exponent, logarithm))
    return _step(tape, np.exp, product)


def _folds(power: float, exponent: float) -> bool:
    """Whether ``(x**power)**exponent`` is ``x**(power*exponent)``, where x is not negative if the result is broken.

    Not for the root of a square, not for the square of a root, not for the power 0; and high whole
    powers are better left as they are.
    """
    if exponent == 0 or not np.isfinite(exponent):
        return False
    whole = power == int(power), exponent == int(exponent)
    total = power * exponent
    if all(whole) and abs(total) > HIGHEST_WHOLE_POWER:
        return False
    if not whole[1]:
        return total != int(total)
    return whole[0] or total != int(total)


def _is_nothing(value: Any) -> bool:
    """Whether a constant is the number zero: what a law without an effect adds."""
    return isinstance(value, float | int | np.floating) and not isinstance(value, bool) and value == 0


def _is_mask(value: Any) -> bool:
    if isinstance(value, Traced):
        (index, power), *more = value.powers.items()
        alone = not more and power == 1 and value.scale == 1 and value.zero is None
        return alone and value.tape.is_mask(index)
    return isinstance(value, bool | np.bool_)


def _constant(value: Any) -> Any:
    if isinstance(value, Traced):
        return value
    if np.ndim(value):
        raise TypeError("a traced value meets an array of fixed size")
    return bool(value) if isinstance(value, bool | np.bool_) else float(value)


def _times(left: Any, right: Any, sign: float) -> Traced:
    """``left * right**sign``, where at least one side is traced."""
    if not isinstance(left, Traced):
        right = right if sign > 0 else right.settled
        scale = float(_constant(left)) * right.scale**sign
        return Traced(right.tape, {i: sign * p for i, p in right.powers.items()}, scale, right.zero)
    if not isinstance(right, Traced):
        return Traced(left.tape, left.powers, left.scale * np.float64(_constant(right)) ** sign, left.zero)
    left, right = left.settled, right.settled
    powers = dict(left.powers)
    for index, power in right.powers.items():
        powers[index] = powers.get(index, 0.0) + sign * power
    broken = {i for side in (left, right) for i, p in side.powers.items() if p != int(p)}
    # x/x is not 1 at zero, and a product of roots is not x below zero: keep the step
    if any(power == 0 or (power == int(power) and i in broken) for i, power in powers.items()):
        function = np.multiply if sign > 0 else np.divide
        return left.tape.value(left.tape.record(function, left, right))
    return Traced(left.tape, powers, left.scale * right.scale**sign)
