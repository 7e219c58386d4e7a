"""Laws from outside: what they return is checked, and what they raise names them.

The package's own laws are used as they are; their results are known, and a check would cost at every call.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ballscrew.basis.errors import Fault, InputError
from ballscrew.physics.laws.conditions import HertzShape
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.protocols import BallChain, InletFactors, RaceTorques

#: What the law of a slot returns, where it is not one quantity.
_RETURNS: Mapping[str, type] = {
    "frame": Frame,
    "hertz": HertzShape,
    "inlet": InletFactors,
    "ball_chain": BallChain,
    "race_torques": RaceTorques,
}
_CONTAINERS = (str, bytes, list, tuple, dict, set)


def is_own(law: Any) -> bool:
    """True for laws of the package, and for no law."""
    return law is None or (getattr(law, "__module__", None) or "").partition(".")[0] == "ballscrew"


def name_of(law: Any) -> str:
    """A law from outside as a case file names it: ``module:name``."""
    named = law if hasattr(law, "__qualname__") else type(law)
    return f"{named.__module__}:{named.__qualname__}"


def usable(slot: str, law: Any, returns: type | None = None) -> Any:
    """The law itself, or around one from outside a law that checks what it returns."""
    return law if is_own(law) else _Checked(slot, law, returns or _RETURNS.get(slot))


@dataclasses.dataclass(frozen=True, eq=False, slots=True)
class _Checked:
    """A law from outside."""

    slot: str
    law: Any
    returns: type | None

    def __call__(self, *arguments: Any) -> Any:
        try:
            result = self.law(*arguments)
        except Exception as error:  # named and raised again, whatever it is
            error.add_note(f"raised by the law model.{self.slot} = {name_of(self.law)}")
            law = f"model.{self.slot}: {name_of(self.law)}"
            error.raised_by_law = law  # pyright: ignore[reportAttributeAccessIssue]  (ours, on an error of anybody)
            raise
        problem = self._problem(result, arguments)
        if problem is not None:
            given = f"{name_of(self.law)} returned {_shown(result)}"
            raise InputError(Fault(f"model.{self.slot}", problem, given, self._remedy))
        return result

    @property
    def _remedy(self) -> str:
        if self.returns is None:
            return "return a number, or an array in the shape of what the law is given"
        return f"return {self.returns.__module__}.{self.returns.__qualname__}"

    def _problem(self, result: Any, arguments: tuple[Any, ...]) -> str | None:
        """Defect of a returned value; None if there is none."""
        values = (result,)
        if self.returns is not None:
            if not isinstance(result, self.returns):
                return f"must return a {self.returns.__name__}"
            values = result if isinstance(result, tuple) else ()
        for value in values:
            if not _is_number(value):
                return "must return numbers"
        if any(isinstance(value, np.ndarray) and value.ndim for value in values):
            allowed = np.broadcast_shapes(*_shapes((*arguments, self.law)))
            for value in values:
                if not _fits(np.shape(value) if isinstance(value, np.ndarray) else (), allowed):
                    return "must return an array in the shape of what it is given"
        return None


def _is_number(value: Any) -> bool:
    """True for real numbers, arrays of them, symbols and recorded values."""
    if isinstance(value, (*_CONTAINERS, bool, complex, np.bool_, np.complexfloating)) or value is None:
        return False
    kind = getattr(getattr(value, "dtype", None), "kind", None)
    return hasattr(value, "__truediv__") and hasattr(value, "__mul__") if kind is None else kind in "fiuV"


def _fits(shape: tuple[int, ...], allowed: tuple[int, ...]) -> bool:
    try:
        return np.broadcast_shapes(shape, allowed) == allowed
    except ValueError:
        return False


def _shapes(parts: Any) -> Iterator[tuple[int, ...]]:
    """The shapes of all arrays in parts, and in the parts of those."""
    yield ()
    for part in parts:
        if isinstance(part, np.ndarray):
            yield part.shape
        elif isinstance(part, tuple):
            yield from _shapes(part)
        elif dataclasses.is_dataclass(part):
            yield from _shapes(getattr(part, field.name) for field in dataclasses.fields(part))


def _shown(result: Any) -> str:
    if isinstance(result, np.ndarray) and result.dtype.kind in "fiu":
        return f"an array of shape {result.shape}"
    return "None" if result is None else f"a {type(result).__name__}"
