"""Programs as documents of plain lists, which other processes read: steps by the names of their functions, no code."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.steps import Step, choose


def can_be_written(program: Program) -> bool:
    """True where each step is an elementwise function of NumPy, or a choice."""
    return all(_named(step.function.__name__) is step.function for _, step in program.steps)


def as_document(program: Program) -> dict[str, Any]:
    """A program as lists and tables of numbers and names."""
    return {
        "inputs": program.inputs,
        "steps": [(i, *_written(step)) for i, step in program.steps],
        "outputs": dict(program.outputs),
        "constants": {name: _plain(value) for name, value in program.constants.items()},
        "nonnegative": sorted(program.nonnegative),
    }


def from_document(held: Mapping[str, Any]) -> Program:
    """The reverse of :func:`as_document`. Raises ``ValueError`` for a function that it does not write."""
    steps: list[tuple[int, Step]] = []
    for i, name, operands, is_mask in held["steps"]:
        function = _named(name)
        if function is None:
            raise ValueError(name)
        steps.append((i, Step(function, tuple((kind, operand) for kind, operand in operands), is_mask)))
    return Program(held["inputs"], tuple(steps), held["outputs"], held["constants"], frozenset(held["nonnegative"]))


def _written(step: Step) -> tuple[str, list[tuple[str, Any]], bool]:
    operands = [(kind, _plain(operand)) for kind, operand in step.operands]
    return step.function.__name__, operands, bool(step.is_mask)


def _plain(value: Any) -> Any:
    """A number or a truth value of Python's own."""
    return value.item() if isinstance(value, np.generic | np.ndarray) else value


def _named(name: str) -> Any:
    """The function of a name; None where there is none."""
    if name == choose.__name__:
        return choose
    result = getattr(np, name, None)
    return result if isinstance(result, np.ufunc) else None
