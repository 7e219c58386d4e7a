"""A comparison of models, laws and rules, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from ballscrew.basis.quantities import Info, Ratio, Torque, Unit, quantities_of
from ballscrew.cases.schema.case_schema import LAWS
from ballscrew.engine.evaluation.comparison import ComparedRule, Comparison, OfBalls, Row
from ballscrew.engine.evaluation.comparison import Spread as TwoRows
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.shared.declared import LEFT_OUT, OneOf

_KNOWN = quantities_of(FrictionResult)
_SLOTS = OneOf(tuple(LAWS))


@dataclasses.dataclass(frozen=True, kw_only=True)
class ComparedModel:
    """The case with one model."""

    #: Of the model, or of the law.
    name: str
    screw_torque: Annotated[Torque, _KNOWN["screw_torque"].info]
    #: Friction torque over that of the case, less one.
    change: Ratio
    #: Parts of the friction torque.
    contributions: Annotated[Mapping[str, float], Unit("N m")]
    efficiency: Annotated[Ratio, _KNOWN["efficiency"].info]
    back_driving_efficiency: Annotated[Ratio, _KNOWN["back_driving_efficiency"].info]
    holding_torque: Annotated[Torque, _KNOWN["holding_torque"].info]
    self_locking: Annotated[bool, _KNOWN["self_locking"].info]
    #: True where all conditions of the model hold.
    valid: bool
    #: The conditions that fail.
    not_valid_because: Sequence[str]


@dataclasses.dataclass(frozen=True, kw_only=True)
class ComparedLaw(ComparedModel):
    """The case with another law in one slot."""

    #: The slot of the law.
    slot: Annotated[str, _SLOTS]
    #: False for a printed form that breaks a balance: it is in no spread.
    counts: bool


@dataclasses.dataclass(frozen=True)
class SpreadEnd:
    """The least or the greatest torque of some models or laws."""

    #: The slot of the law; null of a model.
    slot: Annotated[str | None, _SLOTS]
    #: Of the model, or of the law.
    name: str
    screw_torque: Annotated[Torque, _KNOWN["screw_torque"].info]


@dataclasses.dataclass(frozen=True)
class Ends:
    """Least and greatest torque."""

    #: The least.
    least: SpreadEnd
    #: The greatest.
    greatest: SpreadEnd


@dataclasses.dataclass(frozen=True)
class Spread:
    """Spread of the torque over models and over laws."""

    #: Over all models; null where none has a torque.
    models: Ends | None
    #: Over the laws that count and are valid here; null where none is.
    valid_laws: Ends | None
    #: Changes of the torque by the laws of each slot: the ends.
    change_by_slot: Annotated[Mapping[str, Sequence[float]], Unit("1")]


@dataclasses.dataclass(frozen=True, eq=False)
class Compared:
    """All models and all laws side by side."""

    #: The case with its own model.
    case: ComparedModel
    #: The case with each model.
    models: Sequence[ComparedModel]
    #: The model of the case with another law in one slot.
    laws: Sequence[ComparedLaw]
    #: How far models and laws are apart.
    spread: Spread


@dataclasses.dataclass(frozen=True, eq=False)
class ByRules:
    """The torque by rules of one line, and what they are held against."""

    #: What people use in place of a model; in no spread.
    rules: Sequence[ComparedRule]
    drag_torque: Annotated[
        Torque, Info("M_d", "drag torque of the preloaded nut of the case, seals and other losses included")
    ]
    #: The case without its seals and other losses: what the rules are held against.
    of_balls: Annotated[OfBalls | None, LEFT_OUT]


def compared(found: Comparison) -> Compared:
    """A comparison as it is answered."""
    return Compared(
        case=ComparedModel(**_numbers(found.case)),
        models=[ComparedModel(**_numbers(row)) for row in found.models],
        laws=[ComparedLaw(**_numbers(row), slot=row.candidate.slot, counts=row.candidate.counts) for row in found.laws],
        spread=Spread(_ends(found.spread_of_models), _ends(found.spread_of_laws), found.spans),
    )


def by_rules(found: Comparison) -> ByRules:
    """The rules of a comparison as they are answered."""
    return ByRules(found.rules, found.drag_torque, found.of_balls)


def _numbers(row: Row) -> dict[str, Any]:
    """The fields of :class:`ComparedModel`."""
    of_result = ("screw_torque", "efficiency", "back_driving_efficiency", "holding_torque", "self_locking")
    return {
        "name": row.candidate.name,
        "change": row.change,
        "contributions": row.result.contributions,
        **{name: getattr(row.result, name) for name in of_result},
        "valid": not row.outside,
        "not_valid_because": row.outside,
    }


def _ends(spread: TwoRows | None) -> Ends | None:
    if spread is None:
        return None
    return Ends(*(SpreadEnd(row.candidate.slot or None, row.candidate.name, row.torque) for row in spread))
