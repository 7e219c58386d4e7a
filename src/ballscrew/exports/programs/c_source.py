"""A program as C99: its steps as lines of C, in functions short enough for a compiler to be quick.

A compiler takes time with the square of the length of a function, and a model has up to 50,000 steps. Each function
has a part of the steps; what a later one needs is in an array, whose places are used again when nobody needs them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.compiler.tracing.merging import Reduction
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Operand, Step, choose
from ballscrew.exports.export import data, refusal
from ballscrew.exports.programs.two_levels import TwoLevels, two_levels
from ballscrew.exports.subject import HandOver

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

#: Arrays over the balls that the solver finds.
_ARRAYS = 4
#: Files of the solver, which become a part of the source.
_SOLVER = ("ballscrew_loads.h", "ballscrew_loads.c")


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
    result: dict[int, int] = {}
    for i, step in program.steps:
        result |= {int(o): part_of[i] for kind, o in step.operands if kind == "step" and int(o) in part_of}
    return result | {i: end for i in program.outputs.values() if i in part_of}


def _places(
    parts: Sequence[Sequence[tuple[int, Step]]], part_of: Mapping[int, int], last: Mapping[int, int]
) -> dict[int, int]:
    """The place in the array of each step that a later function or the caller reads."""
    result: dict[int, int] = {}
    free: list[int] = []
    ends: dict[int, list[int]] = {}
    for i, k in last.items():
        ends.setdefault(k, []).append(i)
    size = 0
    for k, part in enumerate(parts):
        for i, _ in part:
            if last.get(i, k) > k:
                result[i] = free.pop() if free else size
                size = max(size, result[i] + 1)
        free += [result[i] for i in ends.get(k, []) if part_of[i] < k]
    return result


def _lines(
    part: Sequence[tuple[int, Step]],
    part_of: Mapping[int, int],
    k: int,
    places: Mapping[int, int],
    masks: frozenset[int],
) -> list[str]:
    """The statements of a function: a constant for each step, and a place for those that are read later."""

    def operand(entry: tuple[str, Operand]) -> str:
        kind, o = entry
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
    function, values = step.function, [operand(entry) for entry in step.operands]
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
    raise refusal("to", f"C has no {function.__name__}", "", remedy)


def body_of(job: HandOver) -> Body:
    """The evaluation of the model in C.

    Raises :class:`~ballscrew.basis.errors.InputError` as :func:`functions` does.
    """
    if job.has_elastic_bodies:
        return _body_by_ball(two_levels(job))
    made = functions(job.program)
    return Body(made.texts, (f"double v[{made.room}];", *made.calls), made.results, made.room)


def _body_by_ball(parts: TwoLevels) -> Body:
    """The evaluation of a nut with elastic bodies: its loads, a loop over the balls, what follows from the sums."""
    points = functions(parts.points, "point", "z", "a")
    ball = functions(parts.each_ball, "ball", "y", "b")
    behind = functions(parts.behind, "behind", "z", "c")
    fields = ", ".join(number(value) if isinstance(value, float) else str(value) for value in parts.nut)
    balls, reductions = parts.nut.all_balls, parts.stages.reductions
    preload = "0.0" if parts.preload is None else f"x[{parts.preload}]"
    statements = [
        f"static const ballscrew_nut nut = {{{fields}}};",
        f"double a[{points.room}], b[{ball.room}], c[{behind.room}], y[{len(parts.tables)}];",
        f"double z[{parts.behind.inputs}] = {{0.0}}, found[BALLSCREW_LOADS_SIZE({balls})];",
        f"double room[BALLSCREW_LOADS_ROOM({balls})], r[{len(reductions)}] = {{0.0}};",
        *(f"z[{k}] = x[{i}];" for k, i in enumerate(parts.inputs)),
        f"z[{parts.solved}] = ballscrew_loads(&nut, x[0], {preload}, room, found);",
        *points.calls,
        *(f"y[{k}] = {points.results[str(what)]};" for k, (by_ball, what) in enumerate(parts.tables) if not by_ball),
        f"for (i = 0; i < {balls}; i++) {{",
        *(f"    y[{k}] = found[{what} * {balls} + i];" for k, (by_ball, what) in enumerate(parts.tables) if by_ball),
        *(f"    {call}" for call in ball.calls),
        *(f"    {line}" for line in _reduced(reductions, ball.results)),
        "}",
        f"for (i = 0; i < {len(reductions)}; i++)",
        f"    z[{parts.behind.inputs - len(reductions)} + i] = r[i];",
        *behind.calls,
    ]
    assert {*range(_ARRAYS)} >= {what for by_ball, what in parts.tables if by_ball}
    room = points.room + ball.room + behind.room + len(parts.tables) + parts.behind.inputs + 15 * balls
    return Body((*_solver(), *points.texts, *ball.texts, *behind.texts), tuple(statements), behind.results, room)


def _reduced(reductions: tuple[Reduction, ...], values: Mapping[str, str]) -> list[str]:
    """The sums, the greatest values, and the values at the ball where one is greatest, as they grow ball by ball."""
    lines: list[str] = []
    for k, entry in enumerate(reductions):
        value = values[entry.values]
        if entry.function is np.sum:
            lines.append(f"r[{k}] += {value};")
        elif entry.function is np.max:
            lines.append(f"r[{k}] = i == 0 || {value} > r[{k}] || {value} != {value} ? {value} : r[{k}];")
        elif entry.function is np.argmax:
            takes = [(j, other) for j, other in enumerate(reductions) if other.place == k]
            lines.append(f"if (i == 0 || {value} > r[{k}]) {{")
            lines.append(f"    r[{k}] = {value};")
            lines += [f"    r[{j}] = {values[other.values]};" for j, other in takes]
            lines.append("}")
    return lines


def _solver() -> list[str]:
    """The solver as a part of the source: what it offers is static."""
    texts = [data(name).decode() for name in _SOLVER]
    plain = re.sub(r'^#(include "ballscrew_loads\.h"|include <math\.h>)\n', "", "\n".join(texts), flags=re.MULTILINE)
    return [re.sub(r"^double ballscrew_loads\(", "static double ballscrew_loads(", plain, flags=re.MULTILINE)]
