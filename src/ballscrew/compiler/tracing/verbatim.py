"""Values that are recorded step by step as NumPy would evaluate them: no powers are collected, nothing is reordered.

For short formulas whose roots and products are cheaper than the logarithms of :mod:`ballscrew.compiler.tracing.tape`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.steps import choose
from ballscrew.compiler.tracing.tape import MASKS, CannotRecordError, Tape


class Verbatim(np.lib.mixins.NDArrayOperatorsMixin):
    """The value of a step of a tape."""

    def __init__(self, tape: Tape, index: int) -> None:
        self.tape = tape
        self.index = index

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **kwargs: Any) -> Any:
        """A function of NumPy as a step."""
        if method != "__call__" or kwargs or ufunc.nout != 1:
            raise CannotRecordError(f"numpy.{ufunc.__name__} cannot be recorded as it is called here")
        if ufunc is np.negative:
            return self._step(np.multiply, -1.0, *inputs)
        return self._step(ufunc, *inputs, is_mask=ufunc in MASKS)

    def __array_function__(
        self, function: Callable[..., Any], types: Any, args: Sequence[Any], kwargs: Mapping[str, Any]
    ) -> Any:  # fmt: skip
        """``where`` as a step."""
        if function is not np.where or len(args) != 3 or kwargs:
            raise CannotRecordError(f"numpy.{function.__name__} cannot be recorded")
        return self._step(choose, *args)

    def _step(self, function: Any, *operands: Any, is_mask: bool = False) -> Verbatim:
        traced = (self.tape.value(o.index) if isinstance(o, Verbatim) else o for o in operands)
        return Verbatim(self.tape, self.tape.record(function, *traced, is_mask=is_mask))


def verbatim_program(inputs: int, formula: Callable[..., Mapping[str, Any]]) -> Program:
    """A formula of so many inputs as a program of the results that it names."""
    tape = Tape(inputs)
    result = formula(*(Verbatim(tape, i) for i in range(inputs)))
    return Program.of(tape, {n: tape.value(v.index) if isinstance(v, Verbatim) else v for n, v in result.items()})
