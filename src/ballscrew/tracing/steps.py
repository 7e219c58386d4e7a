"""A step of a recording: one elementwise operation on earlier steps and constants."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

#: A step's operand: the index of an earlier step, or a constant.
Operand = int | float | bool


class Step(NamedTuple):
    """One elementwise operation on earlier steps and constants."""

    function: Any
    operands: tuple[tuple[str, Operand], ...]
    is_mask: bool


def choose(mask: Any, yes: Any, no: Any, out: NDArray[Any]) -> None:
    """Write ``where(mask, yes, no)`` into a buffer."""
    np.copyto(out, no)
    np.copyto(out, yes, where=mask)
