"""The worst error of an export against the model, over its range."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.exports.subject import HandOver

#: Values at points by name.
Values = Mapping[str, NDArray[Any]]


@dataclasses.dataclass(frozen=True, slots=True, kw_only=True)
class WorstError:
    """The worst error of an output: the largest absolute one with its point, and the largest relative one.

    Of a truth value, such as ``valid``, the error is 1 where it differs.
    """

    output: str
    unit: str
    #: Largest absolute error; infinite where a number is missing that the model has.
    value: float
    #: Inputs of the point where it occurs, in SI.
    at: Mapping[str, float]
    #: Largest error of a point relative to the value of the model at it, zeros aside.
    relative: float
    #: Inputs of the point where that occurs.
    relative_at: Mapping[str, float]
    #: Largest absolute value of the model over the points.
    largest: float
    #: Number of points.
    points: int

    @property
    def of_largest(self) -> float:
        """Largest absolute error as a share of the largest value."""
        return self.value / self.largest if self.largest else (0.0 if self.value == 0 else np.inf)

    def document(self) -> dict[str, Any]:
        """The error as it stands in JSON."""
        return {**dataclasses.asdict(self), "of_largest": self.of_largest}


def worst_errors(
    subject: HandOver,
    approximate: Callable[[Values], Values],
    *,
    points: Values | None = None,
    exact: Values | None = None,
    outputs: Sequence[str] | None = None,
) -> tuple[WorstError, ...]:
    """The worst error of each output of ``approximate``, a function of points by input, against the model.

    Points are those of :meth:`~ballscrew.exports.subject.HandOver.sample` unless given; ``exact`` is the model at them,
    where it is known already. Points where the model has no number are left out.
    """
    at = subject.sample() if points is None else points
    true, found = subject.evaluate(at) if exact is None else exact, approximate(at)
    names = [name for name in subject.output_names if name in found] if outputs is None else outputs
    return tuple(_worst(name, subject.units[name], true[name], found[name], at) for name in names)


def _worst(name: str, unit: str, exact: NDArray[Any], found: Any, at: Values) -> WorstError:
    true = np.asarray(exact, dtype=float)
    off = np.abs(np.asarray(found, dtype=float) - true)
    off = np.where(np.isfinite(true), np.where(np.isnan(off), np.inf, off), 0.0)
    size = np.where(np.isfinite(true), np.abs(true), 0.0)
    relative = np.divide(off, size, out=np.zeros_like(off), where=size > 0)
    first, other = int(np.argmax(off)), int(np.argmax(relative))
    place, other_place = ({n: float(np.broadcast_to(v, off.shape)[i]) for n, v in at.items()} for i in (first, other))
    return WorstError(
        output=name,
        unit=unit,
        value=float(off[first]),
        at=place,
        relative=float(relative[other]),
        relative_at=other_place,
        largest=float(np.max(size)),
        points=off.size,
    )
