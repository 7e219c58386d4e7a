"""A step of a recording: one elementwise operation on earlier steps and constants."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

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
