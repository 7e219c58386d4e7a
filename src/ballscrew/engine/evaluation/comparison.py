"""Comparison of models and laws at one operating point: their spread, and their validity there."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

from ballscrew.basis.quantities import Ratio, Torque, Unit
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult


@dataclasses.dataclass(frozen=True, eq=False)
class Candidate:
    """A model to compare: its name and, where it is the case's model with another law, the slot of the law.

    With ``counts`` false it is shown, but enters no spread.
    """

    name: str
    model: FrictionModel
    slot: str = ""
    counts: bool = True


@dataclasses.dataclass(frozen=True, eq=False)
class Row:
    """A candidate and its result."""

    candidate: Candidate
    result: FrictionResult
    #: Friction torque over that of the case's model, less one; NaN where that is zero.
    change: float

    @property
    def torque(self) -> float:
        """Friction torque on the screw, N m."""
        return float(self.result.screw_torque)

    @property
    def outside(self) -> tuple[str, ...]:
        """The reasons for which it is not valid here."""
        return tuple(reason for reason, holds in self.result.validity.items() if not holds)


class ComparedRule(NamedTuple):
    """A rule of one line that people use in place of a model; its numbers are NaN where it has no answer."""

    #: Its short name.
    name: str
    #: Its name for people.
    title: str
    #: The rule in one line.
    formula: str
    #: Where it is stated.
    source: str
    #: Friction torque of the balls under the load.
    screw_torque: Torque
    #: Friction torque over that of the balls of the case, less one.
    change: Ratio
    #: Efficiency that belongs to the torque.
    efficiency: Ratio
    #: Torque of the balls of the preloaded nut without load.
    drag_torque: Torque
    #: Torque without load over that of the balls of the case, less one.
    drag_change: Ratio


class OfBalls(NamedTuple):
    """A case without its seals and other losses, of which no rule knows: what the rules are held against."""

    #: Friction torque under the load.
    screw_torque: Torque
    #: Efficiency that belongs to it.
    efficiency: Ratio
    #: Torque of the preloaded nut without load; NaN without preload.
    drag_torque: Torque
    #: What is left out: the torque of each loss under the load.
    losses: Annotated[Mapping[str, float], Unit("N m")]


class Spread(NamedTuple):
    """The rows with the least and with the greatest friction torque."""

    least: Row
    greatest: Row


@dataclasses.dataclass(frozen=True, eq=False)
class Comparison:
    """The case's own model, all models, and the case's model with one law at a time in place of its own."""

    case: Row
    models: Sequence[Row]
    laws: Sequence[Row]
    #: What people use in place of a model; in no spread.
    rules: Sequence[ComparedRule] = ()
    #: Torque of the case's preloaded nut without load, seals and other losses included, N m; NaN without preload.
    drag_torque: float = math.nan
    #: The case without losses beside those of the balls; None where it has none.
    of_balls: OfBalls | None = None

    @property
    def rows(self) -> list[Row]:
        """All rows, the case's first, each once."""
        return [self.case, *(row for row in (*self.models, *self.laws) if row is not self.case)]

    @property
    def spread_of_models(self) -> Spread | None:
        """Over all models, valid or not; None where no torque is finite."""
        return _spread(self.models)

    @property
    def spread_of_laws(self) -> Spread | None:
        """Over the case's model and the laws that count and are valid here; None where none is."""
        return _spread(row for row in (self.case, *self.laws) if row.candidate.counts and not row.outside)

    @property
    def spans(self) -> Mapping[str, tuple[float, float]]:
        """Ranges, by slot, in which the laws that count and are valid here move the torque; the widest first."""
        spans: dict[str, tuple[float, float]] = {}
        for row in self.laws:
            if row.candidate.counts and not row.outside and math.isfinite(row.change):
                low, high = spans.get(row.candidate.slot, (0.0, 0.0))
                spans[row.candidate.slot] = (min(low, row.change), max(high, row.change))
        return dict(sorted(spans.items(), key=lambda item: item[1][0] - item[1][1]))


def _spread(rows: Iterable[Row]) -> Spread | None:
    finite = [row for row in rows if math.isfinite(row.torque)]
    if not finite:
        return None
    return Spread(min(finite, key=lambda row: row.torque), max(finite, key=lambda row: row.torque))


def compare(
    case: FrictionModel,
    models: Sequence[Candidate],
    laws: Sequence[Candidate],
    screw: BallScrew,
    lubricant: Lubricant,
    operation: OperatingState,
    done: Callable[[int, int], None] | None = None,
) -> Comparison:
    """Evaluate the case's model, other models, and the case's with other laws, at one operating point.

    Where one of the models is the case's own, their rows are one; models that do not know the nut are left out.
    ``done(finished, total)`` reports the rows.
    """
    finished = 0

    def result_of(model: FrictionModel) -> FrictionResult:
        load, speed = operation.axial_load, operation.screw_speed
        return model(screw, lubricant, axial_load=load, screw_speed=speed)

    name = next((candidate.name for candidate in models if candidate.model is case), "this case")
    own = Row(Candidate(name, case), result_of(case), 0.0)

    def row(candidate: Candidate) -> Row:
        nonlocal finished
        if candidate.model is case:
            return own
        finished += 1
        if done is not None:
            done(finished, len(models) + len(laws) + 1)
        result = result_of(candidate.model)
        change = float(result.screw_torque) / own.torque - 1 if own.torque else math.nan
        return Row(candidate, result, change)

    models, laws = ([c for c in each if c.model.knows(screw.nut)] for each in (models, laws))
    return Comparison(
        own,
        [row(candidate) for candidate in models],
        [row(candidate) for candidate in laws],
    )


def same_law(one: Any, other: Any) -> bool:
    """Return whether two laws are equal, coefficients included."""
    if dataclasses.is_dataclass(one) and type(one) is type(other):
        return vars(one) == vars(other)
    return one is other
