"""A program as C99: its steps as lines of C, in functions short enough for a compiler to be quick.

A compiler takes time with the square of the length of a function, and a model has up to 50,000 steps. Each function
has a part of the steps; what a later one needs is in an array, whose places are used again when nobody needs them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.errors import Fault, InputError
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.steps import Operand, Step, choose

#: Steps of a function.
STEPS_OF_A_FUNCTION = 250

INFIX: Mapping[Any, str] = {
    np.add: "+", np.subtract: "-", np.multiply: "*", np.divide: "/",
    np.equal: "==", np.not_equal: "!=", np.less: "<", np.less_equal: "<=", np.greater: ">", np.greater_equal: ">=",
    np.bitwise_and: "&", np.bitwise_or: "|", np.bitwise_xor: "^",
    np.logical_and: "&", np.logical_or: "|", np.logical_xor: "^",
}  # fmt: skip
CALLS: Mapping[Any, str] = {
    np.sqrt: "sqrt", np.absolute: "fabs", np.exp: "exp", np.expm1: "expm1", np.log: "log", np.log1p: "log1p",
    np.sin: "sin", np.cos: "cos", np.tan: "tan", np.arcsin: "asin", np.arccos: "acos", np.arctan: "atan",
    np.arctan2: "atan2", np.sinh: "sinh", np.cosh: "cosh", np.tanh: "tanh", np.arcsinh: "asinh", np.power: "pow",
    np.floor: "floor", np.ceil: "ceil", np.cbrt: "cbrt", np.hypot: "hypot",
}  # fmt: skip
TESTS: Mapping[Any, str] = {np.isnan: "isnan", np.isinf: "isinf", np.isfinite: "isfinite"}
EXTREMES: Mapping[Any, str] = {np.maximum: "greater_of", np.minimum: "less_of"}
#: Functions of the source that have no name in the library; those of NumPy hand on what is not a number.
_OWN: Mapping[str, str] = {
    "greater_of": "static double greater_of(double a, double b) { return a > b || a != a ? a : b; }",
    "less_of": "static double less_of(double a, double b) { return a < b || a != a ? a : b; }",
    "remainder_of": """\
static double remainder_of(double a, double b)
{
    const double m = fmod(a, b);
    return m == 0.0 ? copysign(0.0, b) : (b < 0.0) != (m < 0.0) ? m + b : m;
}""",
}


def number(value: float) -> str:
    """A number as C writes it, to the last digit."""
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "INFINITY" if value > 0 else "(-INFINITY)"
    return repr(float(value)) if value >= 0 and not str(value).startswith("-") else f"({float(value)!r})"


class Functions(NamedTuple):
    """A program as functions of C, which read an array of inputs, and read and write one of work space."""

    texts: tuple[str, ...]
    #: Statements that call them, in order.
    calls: tuple[str, ...]
    #: The expression of each output after the calls.
    results: Mapping[str, str]
    #: Numbers in the work space.
    room: int


class Body(NamedTuple):
    """The evaluation of a model in C, between its inputs ``x`` and its outputs: functions, statements, results."""

    texts: tuple[str, ...]
    statements: tuple[str, ...]
    results: Mapping[str, str]
    #: Numbers on the stack.
    room: int


def functions(program: Program, name: str = "part", inputs: str = "x", room: str = "v") -> Functions:
    """A program as functions of C, with the names of its functions and of the arrays that they are called with.

    Raises :class:`~ballscrew.basis.errors.InputError` for an operation that C lacks.
    """
    steps = program.steps
    parts = [steps[i : i + STEPS_OF_A_FUNCTION] for i in range(0, len(steps), STEPS_OF_A_FUNCTION)]
    part_of = {i: k for k, part in enumerate(parts) for i, _ in part}
    places = _places(parts, part_of, _last_uses(program, part_of, len(parts)))
    masks = frozenset(i for i, step in steps if step.is_mask)
    texts: list[str] = []
    for k, part in enumerate(parts):
        lines = _lines(part, part_of, k, places, masks)
        lines = [f"(void){each};" for each in "xv" if not any(f"{each}[" in line for line in lines)] + lines
        head = f"static void {name}_{k}(const double *x, double *v)"
        texts.append("\n".join([head, "{", *(f"    {line}" for line in lines), "}"]))
    results = {n: f"{room}[{places[i]}]" if i in part_of else f"{inputs}[{i}]" for n, i in program.outputs.items()}
    results |= {n: number(float(value)) for n, value in program.constants.items()}
    calls = tuple(f"{name}_{k}({inputs}, {room});" for k in range(len(parts)))
    return Functions(tuple(texts), calls, results, max(places.values(), default=0) + 1)


def own_functions(texts: Sequence[str]) -> list[str]:
    """The functions that these texts call and the C library lacks."""
    return [text for word, text in _OWN.items() if any(f"{word}(" in part for part in texts)]


def _last_uses(program: Program, part_of: Mapping[int, int], end: int) -> dict[int, int]:
    """The part that reads each step last; outputs are read at the end."""
    found: dict[int, int] = {}
    for i, step in program.steps:
        found |= {int(o): part_of[i] for kind, o in step.operands if kind == "step" and int(o) in part_of}
    return found | {i: end for i in program.outputs.values() if i in part_of}


def _places(
    parts: Sequence[Sequence[tuple[int, Step]]], part_of: Mapping[int, int], last: Mapping[int, int]
) -> dict[int, int]:
    """The place in the array of each step that a later function or the caller reads."""
    found: dict[int, int] = {}
    free: list[int] = []
    ends: dict[int, list[int]] = {}
    for i, k in last.items():
        ends.setdefault(k, []).append(i)
    size = 0
    for k, part in enumerate(parts):
        for i, _ in part:
            if last.get(i, k) > k:
                found[i] = free.pop() if free else size
                size = max(size, found[i] + 1)
        free += [found[i] for i in ends.get(k, []) if part_of[i] < k]
    return found


def _lines(
    part: Sequence[tuple[int, Step]],
    part_of: Mapping[int, int],
    k: int,
    places: Mapping[int, int],
    masks: frozenset[int],
) -> list[str]:
    """The statements of a function: a constant for each step, and a place for those that are read later."""

    def operand(one: tuple[str, Operand]) -> str:
        kind, o = one
        if kind != "step":
            return str(int(o)) if isinstance(o, bool) else number(float(o))
        i = int(o)
        if i not in part_of:
            return f"x[{i}]"
        if part_of[i] == k:
            return f"s{i}"
        return f"(v[{places[i]}] != 0.0)" if i in masks else f"v[{places[i]}]"

    lines: list[str] = []
    for i, step in part:
        lines.append(f"const {'int' if step.is_mask else 'double'} s{i} = {expression(step, operand)};")
        if i in places:
            lines.append(f"v[{places[i]}] = s{i};")
    return lines


def expression(step: Step, operand: Callable[[tuple[str, Operand]], str]) -> str:
    """A step as an expression of C. Raises :class:`~ballscrew.basis.errors.InputError` for an operation C lacks."""
    function, values = step.function, [operand(one) for one in step.operands]
    if function is choose:
        return "{} ? {} : {}".format(*values)
    if function in INFIX:
        return f"{values[0]} {INFIX[function]} {values[1]}"
    if function in (np.invert, np.logical_not):
        return f"!{values[0]}"
    if function in TESTS:
        return f"{TESTS[function]}({values[0]}) != 0"
    if function in EXTREMES:
        return f"{EXTREMES[function]}({values[0]}, {values[1]})"
    if function is np.remainder:
        return f"remainder_of({values[0]}, {values[1]})"
    if function in CALLS:
        return f"{CALLS[function]}({', '.join(values)})"
    remedy = "write the law with functions of the C library, or take a table (--to table)"
    raise InputError(Fault("hand_over.to", f"C has no {function.__name__}", "", remedy))
