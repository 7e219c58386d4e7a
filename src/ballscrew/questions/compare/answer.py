"""Response models of the API for a comparison of models, laws and rules."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.schema.schema import LAWS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.shared.answer_parts import (
    Closed,
    Number,
    Numbers,
    Provenance,
    Record,
    Tables,
    field,
    model,
    quantities,
)

_COMPARED = ("screw_torque", "efficiency", "back_driving_efficiency", "holding_torque")


class _Row(Closed):
    name: str
    change: Number = Field(description="friction torque over that of the case, less one")
    contributions: Numbers
    self_locking: bool
    valid: bool
    not_valid_because: list[str]


ComparedModel = model(
    "ComparedModel",
    "The case with one model.",
    _Row,
    **quantities({name: quantities_of(FrictionResult)[name] for name in _COMPARED}),
)
_Slot: TypeAlias = Annotated[str, Field(json_schema_extra={"enum": list(LAWS)})]
ComparedLaw = model(
    "ComparedLaw",
    "The case with another law in one slot.",
    ComparedModel,
    slot=(_Slot, ...),
    counts=(bool, field("false for a printed form that breaks a balance: it is in no spread")),
)


class ComparedRule(Closed):
    """A rule of one line that people use in place of a model."""

    name: str
    title: str
    formula: str
    source: str
    screw_torque: Number = Field(
        description="friction torque of the balls under the load, N m; null where the rule has no answer"
    )
    change: Number = Field(description="friction torque over that of the balls of the case, less one")
    efficiency: Number
    drag_torque: Number = Field(description="torque of the balls of the preloaded nut without load, N m")
    drag_change: Number = Field(description="torque without load over that of the balls of the case, less one")


class OfBalls(Closed):
    """The case without its seals and other losses, of which no rule knows: what the rules are held against."""

    screw_torque: Number = Field(description="friction torque under the load, N m")
    efficiency: Number
    drag_torque: Number = Field(description="torque of the preloaded nut without load, N m")
    losses: dict[str, Number] = Field(description="what is left out, N m")


class SpreadEnd(Closed):
    """The least or the greatest torque of some models or laws."""

    slot: _Slot | None
    name: str
    screw_torque: Number


class Ends(Closed):
    """Least and greatest torque."""

    least: SpreadEnd
    greatest: SpreadEnd


class Spread(Closed):
    """Spread of the torque over models and over laws."""

    models: Ends | None
    valid_laws: Ends | None
    change_by_slot: dict[str, list[Number]]


class Compare(Closed):
    """All models and all laws side by side."""

    inputs: Tables
    case: ComparedModel  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    models: list[ComparedModel]  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    laws: list[ComparedLaw]  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    rules: list[ComparedRule]
    drag_torque: Number = Field(
        description="torque of the case's preloaded nut without load, seals and other losses included, N m"
    )
    of_balls: OfBalls = field(optional=True)
    spread: Spread
    units: dict[str, str]
    reasons: dict[str, str]
    verdicts: list[Record] = field(optional=True)
    checks: list[Record] = field(optional=True)
    warnings: list[Record] = field(optional=True)
    provenance: Provenance
