"""A nut with elastic bodies as C: the solver of its loads, a loop over the balls, and what follows from the sums."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from ballscrew.compiler.tracing.reductions import Reduction
from ballscrew.exports.programs import c_source, interpreter
from ballscrew.exports.programs.c_source import Body, number
from ballscrew.exports.programs.two_levels import TwoLevels

#: Arrays over the balls that the solver finds.
_ARRAYS = 4
#: Files of the solver, which become a part of the source.
_SOLVER = ("ballscrew_loads.h", "ballscrew_loads.c")


def body(parts: TwoLevels) -> Body:
    """The evaluation as C. Raises :class:`~ballscrew.basis.errors.InputError` for an operation that C lacks."""
    points = c_source.functions(parts.points, "point", "z", "a")
    ball = c_source.functions(parts.each_ball, "ball", "y", "b")
    behind = c_source.functions(parts.behind, "behind", "z", "c")
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
    for k, one in enumerate(reductions):
        value = values[one.values]
        if one.function is np.sum:
            lines.append(f"r[{k}] += {value};")
        elif one.function is np.max:
            lines.append(f"r[{k}] = i == 0 || {value} > r[{k}] || {value} != {value} ? {value} : r[{k}];")
        elif one.function is np.argmax:
            takes = [(j, other) for j, other in enumerate(reductions) if other.place == k]
            lines.append(f"if (i == 0 || {value} > r[{k}]) {{")
            lines.append(f"    r[{k}] = {value};")
            lines += [f"    r[{j}] = {values[other.values]};" for j, other in takes]
            lines.append("}")
    return lines


def _solver() -> list[str]:
    """The solver as a part of the source: what it offers is static."""
    texts = [interpreter.data(name).decode() for name in _SOLVER]
    plain = re.sub(r'^#(include "ballscrew_loads\.h"|include <math\.h>)\n', "", "\n".join(texts), flags=re.MULTILINE)
    return [re.sub(r"^double ballscrew_loads\(", "static double ballscrew_loads(", plain, flags=re.MULTILINE)]
