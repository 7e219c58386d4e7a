"""The tape: a model recorded once, to be evaluated many times.

The model is called with :class:`Traced` values instead of arrays, and every operation on them is recorded:
constants are folded, equal steps are shared, steps that no output needs are dropped, and
products of powers (film, rolling force, contact size, elastic moment) are kept as exponents until
a sum needs them, so that one exponential of a weighted sum of logarithms does the work of
several powers, for both contacts at once. The equations see an array. Powers of one base are added
up, so that x²/x is x, also where x is zero.

Inputs may come in groups (the axes of a grid). A product of powers then becomes one factor for each
group, so that a factor can be computed once for each value of its axis. On a tape that ``reduces``, the last axis of
an array stands for the rows of a grid, and sums and greatest values along it are steps as well
(:mod:`ballscrew.compiler.tracing.merging`).

A step of a recording: one elementwise operation on earlier steps and constants.

Logarithms on a tape: products of powers as weighted sums, with as few new logarithms as they need.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

#: Groups of inputs, a bit for each: rows and columns of a grid, and what has been reduced over the rows.
ROWS, COLUMNS, REDUCED = 1, 2, 4
#: Reductions over the rows of each column: sum, greatest value, its place, and the value at a place.
REDUCTIONS = frozenset({np.sum, np.max, np.argmax, np.take_along_axis})

#: A step's operand: the index of an earlier step, or a constant.
Operand = int | float | bool


class Step(NamedTuple):
    """One elementwise operation on earlier steps and constants."""

    function: Any
    operands: tuple[tuple[str, Operand], ...]
    is_mask: bool

    @property
    def read(self) -> list[int]:
        """The earlier steps among the operands."""
        return [int(o) for kind, o in self.operands if kind == "step"]

    def renumbered(self, number: Mapping[int, int]) -> Step:
        """The same step, whose earlier steps have these numbers."""
        operands = tuple((kind, number[int(o)] if kind == "step" else o) for kind, o in self.operands)
        return Step(self.function, operands, self.is_mask)


def choose(mask: Any, yes: Any, no: Any, out: NDArray[Any]) -> None:
    """Write ``where(mask, yes, no)`` into a buffer."""
    np.copyto(out, no)
    np.copyto(out, yes, where=mask)


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


class CannotRecordError(TypeError):
    """Asked of a traced value: what only numbers or plain arrays can do."""


class NoAttributeError(CannotRecordError, AttributeError):
    """Asked of a traced value: a method or an attribute of plain arrays."""


def why_not_recorded(error: BaseException) -> CannotRecordError | None:
    """Cause of an error that is an operation that cannot be recorded."""
    below: BaseException | None = error
    while below is not None and not isinstance(below, CannotRecordError):
        below = below.__cause__ or below.__context__
    return below


#: Whole powers up to this one are multiplied out.
HIGHEST_WHOLE_POWER = 8


class Tape:
    """The steps recorded so far; the first ones are the inputs."""

    def __init__(
        self,
        inputs: int,
        groups: Sequence[int] | None = None,
        nonnegative: Sequence[bool] | None = None,
        *,
        reduces: bool = False,
    ) -> None:
        self.inputs = inputs
        self.reduces = reduces
        self.steps: list[Step | None] = [None] * inputs
        #: The groups of inputs that each step depends on, a bit for each.
        self.groups = [1] * inputs if groups is None else list(groups)
        #: Whether each step is known to be positive, zero or NaN.
        self.nonnegative = [False] * inputs if nonnegative is None else list(nonnegative)
        self._known: dict[Step, int] = {}

    def record(self, function: Any, *operands: Any, is_mask: bool = False) -> int:
        """Record a step, or find the equal one already recorded; return its index."""
        coded = tuple(("step", o.index) if isinstance(o, Traced) else ("constant", o) for o in operands)
        step = Step(function, coded, is_mask)
        index = self._known.get(step)  # a step's hash is long to compute
        if index is None:
            index = self._known[step] = len(self.steps)
            self.steps.append(step)
            self.groups.append(0)
            for kind, operand in coded:
                self.groups[-1] |= self.groups[int(operand)] if kind == "step" else 0
            if function in REDUCTIONS:
                self.groups[-1] = COLUMNS | REDUCED
            self.nonnegative.append(self._is_nonnegative(step))
        return index

    def _is_nonnegative(self, step: Step) -> bool:
        if step.function in (np.exp, np.sqrt, np.absolute):
            return True
        if step.function not in _KEEP_SIGN:
            return False
        operands = step.operands[1:] if step.function is choose else step.operands
        return all(self.nonnegative[int(o)] if kind == "step" else o >= 0 for kind, o in operands)

    def step(self, function: Any, *operands: Any) -> Any:
        """The value of a step as it is, without collecting powers; or a constant."""
        if not any(isinstance(o, Traced) for o in operands):
            return float(function(*operands))
        return self.value(self.record(function, *operands))

    def is_recorded(self, function: Any, *operands: Any) -> bool:
        """Return whether a step is recorded already."""
        coded = tuple(("step", o.index) if isinstance(o, Traced) else ("constant", o) for o in operands)
        return Step(function, coded, False) in self._known

    def value(self, index: int) -> Traced:
        """The value of a step."""
        return Traced(self, {index: 1.0}, 1.0, index=index)

    def is_mask(self, index: int) -> bool:
        """Return whether a step yields truth values."""
        step = self.steps[index]
        return step is not None and step.is_mask


def _reduced(tape: Tape, function: Any, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
    """A reduction over the rows, as a step; the value itself where it is the same in all of them."""
    values, *places = args
    if dict(kwargs) != {"axis": -1}:
        raise CannotRecordError(f"numpy.{function.__name__} is recorded along the last axis only")
    of_rows = isinstance(values, Traced) and bool(tape.groups[values.index] & ROWS)
    if not of_rows and function in (np.max, np.take_along_axis):
        return values
    if not of_rows or tape.groups[values.index] & REDUCED:
        raise CannotRecordError(f"numpy.{function.__name__} of what is the same in all rows, or reduced before")
    if _is_mask(values):
        return tape.value(_reduced(tape, function, (np.where(values, 1.0, 0.0), *places), kwargs).index) != 0
    return tape.value(tape.record(function, tape.value(values.index), *places))


MASKS = {
    np.equal, np.not_equal, np.less, np.less_equal, np.greater, np.greater_equal,
    np.isfinite, np.isnan, np.isinf, np.logical_and, np.logical_or, np.logical_xor, np.logical_not,
}  # fmt: skip
#: Functions whose result is not negative where no operand is.
_KEEP_SIGN = {np.add, np.multiply, np.divide, np.maximum, np.minimum, np.power, choose, np.sum, np.max}
_TRUTH = {np.bitwise_and, np.bitwise_or, np.bitwise_xor, np.invert}


class Traced(np.lib.mixins.NDArrayOperatorsMixin):
    """``scale · ∏ step**exponent``: an array in the making.

    Where the mask ``zero`` holds (the index of a step), the product is zero whatever its factors are.
    """

    def __init__(
        self,
        tape: Tape,
        powers: Mapping[int, float],
        scale: float,
        zero: int | None = None,
        *,
        index: int | None = None,
    ) -> None:
        self.tape = tape
        self.powers = dict(powers)
        self.scale = np.float64(scale)  # divides by zero as arrays do
        self.zero = zero
        self._index = index

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
            raise CannotRecordError(f"numpy.{ufunc.__name__} cannot be recorded as it is called here")
        without_step = _product_of_powers(ufunc, inputs) if ufunc in _OF_POWERS else _summand(ufunc, inputs)
        if without_step is not None:
            return without_step
        if ufunc in (np.equal, np.not_equal):
            inputs = self._without_scale(inputs)
        if not _takes_floats(ufunc, tuple(map(_is_mask, inputs))):
            raise CannotRecordError(f"numpy.{ufunc.__name__} takes no real numbers")
        is_mask = ufunc in MASKS or (ufunc in _TRUTH and all(map(_is_mask, inputs)))
        return self.tape.value(self.tape.record(ufunc, *map(_constant, inputs), is_mask=is_mask))

    def _without_scale(self, inputs: tuple[Any, ...]) -> tuple[Any, ...]:
        """The operands of a comparison with zero, for which a scale does not matter; of another as they are."""
        if isinstance(inputs[1], Traced) or inputs[1] != 0 or self.scale == 0:
            return inputs
        return Traced(self.tape, self.powers, 1.0, self.zero), inputs[1]

    def __array_function__(
        self, function: Callable[..., Any], types: Any, args: Sequence[Any], kwargs: Mapping[str, Any]
    ) -> Any:  # fmt: skip
        """``where`` becomes a step; ``where(mask, 0.0, product)`` keeps the scale of the product."""
        if function in REDUCTIONS and self.tape.reduces:
            return _reduced(self.tape, function, args, kwargs)
        if function is not np.where or len(args) != 3 or kwargs:
            raise CannotRecordError(f"numpy.{function.__name__} cannot be recorded")
        mask, yes, no = args
        if not isinstance(mask, Traced):
            return yes if mask else no
        is_nothing = not isinstance(yes, Traced) and yes == 0
        if is_nothing and isinstance(no, Traced) and not _is_mask(no) and np.isfinite(no.scale):
            no = no.without_mask
            return Traced(self.tape, no.powers, no.scale, mask.index)
        choice = self.tape.record(choose, mask, _constant(yes), _constant(no), is_mask=_is_mask(yes) and _is_mask(no))
        return self.tape.value(choice)

    def __getitem__(self, key: tuple[()]) -> Traced:
        """``x[()]``, which turns a NumPy array without axes into a number, is the value itself."""
        if key != ():
            raise CannotRecordError("a traced value has no axes to index")
        return self

    def __getattr__(self, name: str) -> Any:
        """Operators and functions of NumPy are recorded, methods of arrays are not."""
        raise NoAttributeError(f"a traced value has no attribute {name!r}")

    def _no_number(self, *_: Any, **__: Any) -> Any:
        """A traced value has no numbers yet; a law that needs them is evaluated on plain arrays."""
        raise CannotRecordError("a traced value cannot become a number or an array")

    __array__ = __float__ = __int__ = __complex__ = __index__ = __len__ = __iter__ = __round__ = _no_number

    def __bool__(self) -> bool:
        """A traced value has no truth: what depends on it must be said with ``where``."""
        raise CannotRecordError("a traced value has no truth value; use where()")

    @property
    def without_mask(self) -> Traced:
        """The same value with its zero mask recorded as a step."""
        return self if self.zero is None else self.tape.value(self.index)

    def has_definite_sign(self) -> bool:
        """Return whether the product is negative wherever a factor is, so that a fractional power can be taken of each.

        Not for two factors of unknown sign, whose product may be positive all the same, nor for an even power.
        """
        unknown = [p for i, p in self.powers.items() if not self.tape.nonnegative[i] and p == int(p)]
        return len(unknown) < 2 and all(p % 2 == 1 for p in unknown)

    def _with_absolute_values(self) -> Traced:
        """The same value, with even powers as those of absolute values, and factors of unknown sign multiplied."""
        tape, nonnegative = self.tape, self.tape.nonnegative
        powers: dict[int, float] = {}
        for i, p in self.powers.items():
            size = tape.record(np.absolute, tape.value(i)) if p % 2 == 0 and not nonnegative[i] else i
            powers[size] = powers.get(size, 0.0) + p
        unknown = {i: p for i, p in powers.items() if not nonnegative[i] and p == int(p)}
        if len(unknown) > 1:
            powers = {i: p for i, p in powers.items() if i not in unknown}
            together = Traced(tape, unknown, 1.0).index
            powers[together] = powers.get(together, 0.0) + 1.0
        return Traced(tape, powers, self.scale, self.zero)

    def _to_power(self, exponent: float) -> Traced:
        """A power; recorded as a step where folding of exponents would change it (see :func:`_folds`)."""
        if self.zero is not None and not (exponent > 0 and np.isfinite(self.scale) and self.scale > 0):
            return self.without_mask._to_power(exponent)
        if np.isfinite(exponent) and exponent != int(exponent) and not self.has_definite_sign():
            return self._with_absolute_values()._to_power(exponent)
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
    if all(abs(p) == 0.5 for _, p in broken):
        roots = [(tape.record(np.sqrt, tape.value(i)), p) for i, p in broken]
        return _multiplied(tape, None, [*_multiplied_out(powers), *roots])
    broken = [(i, p) for i, p in powers if p != int(p) or folds_into_exponent(tape, i, p)]
    whole = [(i, p) for i, p in powers if (i, p) not in broken]
    return _multiplied(tape, tape.record(np.exp, sum_of_logarithms(tape, broken)), _multiplied_out(whole))


def _multiplied_out(powers: Sequence[tuple[int, float]]) -> list[tuple[int, float]]:
    """The whole ones among powers as factors, each as often as it counts."""
    return [(i, p) for i, p in powers if p == int(p) for _ in range(int(abs(p)))]


def _multiplied(tape: Tape, result: int | None, factors: Sequence[tuple[int, float]]) -> int:
    """The step that holds a result so far times factors, one after the other; those of a negative power divide."""
    for i, power in factors:
        if power < 0:
            start = 1.0 if result is None else tape.value(result)
            result = tape.record(np.divide, start, tape.value(i))
        else:
            result = i if result is None else tape.record(np.multiply, tape.value(result), tape.value(i))
    assert result is not None, "a product has factors"
    return result


#: Functions whose results are products of powers again, but for masks.
_OF_POWERS = {np.positive, np.negative, np.square, np.sqrt, np.multiply, np.divide, np.power}


def _product_of_powers(ufunc: np.ufunc, inputs: tuple[Any, ...]) -> Traced | None:
    """The product, quotient or power of traced values without a step of its own; none of masks."""
    if ufunc is np.positive:
        return inputs[0]
    if ufunc is np.negative:
        return _multiply(inputs[0], -1.0, 1.0)
    if ufunc is np.square:
        return inputs[0]._to_power(2.0)
    if ufunc is np.sqrt:
        return inputs[0]._to_power(0.5)
    if ufunc is np.power:
        return _power(*inputs)
    if any(map(_is_mask, inputs)):
        return None
    return _multiply(inputs[0], inputs[1], 1.0 if ufunc is np.multiply else -1.0)


def _summand(ufunc: np.ufunc, inputs: tuple[Any, ...]) -> Any:
    """The one operand of a sum or a difference that counts, where the other is nothing; else none."""
    if ufunc in (np.add, np.subtract) and _is_nothing(inputs[1]) and not _is_mask(inputs[0]):
        return inputs[0]
    if ufunc is np.add and _is_nothing(inputs[0]) and not _is_mask(inputs[1]):
        return inputs[1]
    return None


def _power(base: Any, exponent: Any) -> Traced:
    """A power; one with an exponent that is recorded too is ``exp(exponent · log(base))``, and 1 for the exponent 0.

    A base that varies too is taken to be positive or zero, as if no exponent were whole.
    """
    if not isinstance(exponent, Traced):
        return base._to_power(float(exponent))
    tape = exponent.tape
    if not isinstance(base, Traced):
        if not _constant(base) > 0:
            return tape.value(tape.record(np.power, _constant(base), exponent))
        of_base: Any = float(np.log(_constant(base)))
    elif base.scale > 0 and base.has_definite_sign():
        of_base = sum_of_logarithms(tape, sorted(base.powers.items(), reverse=True), base.scale)
        if base.zero is not None:
            of_base = tape.step(choose, tape.value(base.zero), -np.inf, of_base)
    else:
        of_base = logarithm(tape, base.index)
    is_nothing = tape.value(tape.record(np.equal, exponent, 0.0, is_mask=True))
    product = tape.step(choose, is_nothing, 0.0, tape.step(np.multiply, exponent, of_base))
    return tape.step(np.exp, product)


def _folds(power: float, exponent: float) -> bool:
    """True if ``(x**power)**exponent`` is ``x**(power*exponent)``, where x is not negative if the result is broken.

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


@functools.cache
def _takes_floats(ufunc: np.ufunc, masks: tuple[bool, ...]) -> bool:
    """True for a function of real numbers that may also take masks."""
    try:
        with np.errstate(all="ignore"):
            ufunc(*(True if mask else 0.5 for mask in masks))
    except TypeError:
        return False
    return True


def _is_nothing(value: Any) -> bool:
    """True for the constant zero, which a law without an effect adds."""
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
        raise CannotRecordError("a traced value meets an array of fixed size")
    try:
        return bool(value) if isinstance(value, bool | np.bool_) else float(value)
    except (TypeError, ValueError):
        raise CannotRecordError(f"a traced value meets a {type(value).__name__}") from None


def _multiply(left: Any, right: Any, sign: float) -> Traced:
    """``left * right**sign``, where at least one side is traced."""
    if not isinstance(left, Traced):
        right = right if sign > 0 else right.without_mask
        scale = float(_constant(left)) * right.scale**sign
        return Traced(right.tape, {i: sign * p for i, p in right.powers.items()}, scale, right.zero)
    if not isinstance(right, Traced):
        return Traced(left.tape, left.powers, left.scale * np.float64(_constant(right)) ** sign, left.zero)
    left, right = left.without_mask, right.without_mask
    powers = dict(left.powers)
    for index, power in right.powers.items():
        powers[index] = powers.get(index, 0.0) + sign * power
    broken = {i for side in (left, right) for i, p in side.powers.items() if p != int(p)}
    # x/x is not 1 at zero, and a product of roots is not x below zero: keep the step
    if any(power == 0 or (power == int(power) and i in broken) for i, power in powers.items()):
        function = np.multiply if sign > 0 else np.divide
        return left.tape.value(left.tape.record(function, left, right))
    return Traced(left.tape, powers, left.scale * right.scale**sign)
