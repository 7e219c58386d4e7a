"""A candidate of a selection, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, NamedTuple

from ballscrew.basis.quantities import Force, Info, Length, Ratio, Torque, quantities_of
from ballscrew.cases.screw_tables.nut_kinds import NUT_FIELDS
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.questions.duty.answer import FullBath
from ballscrew.questions.duty.compute import NUMBERS, DutyReport
from ballscrew.questions.select.candidates import Candidate
from ballscrew.questions.select.compute import Ranked
from ballscrew.questions.select.objectives import OBJECTIVES
from ballscrew.questions.shared.declared import FINITE, from_attributes, table_of

_ROW = quantities_of(CatalogueRow)


class CycleOfNeed(table_of(NUMBERS)):
    """Numbers of the cycle of a need."""


class Objectives(table_of({name: one.quantity for name, one in OBJECTIVES.items()})):
    """The numbers compared."""


class Failing(NamedTuple):
    """A check that fails."""

    #: Of the check.
    name: str
    #: Demand over capacity; null where the check is a question of yes or no.
    utilisation: Ratio


class RowSizes(NamedTuple):
    """Sizes of a row, and its source."""

    nominal_diameter: Annotated[Length, _ROW["nominal_diameter"].info, FINITE]
    lead: Annotated[Length, _ROW["lead"].info, FINITE]
    #: Where the row is from.
    source: str


class OneObjective(NamedTuple):
    """A number that is compared."""

    #: In options and documents.
    name: str
    #: What it is.
    meaning: str
    #: SI.
    unit: str
    #: The direction that is better.
    better: Literal["less", "more"]


@dataclasses.dataclass(frozen=True, eq=False)
class OneCandidate:
    """A row with a nut, a preload and an oil, its rank, and the numbers compared."""

    #: From 1, the best.
    rank: int
    #: Of the row.
    name: str
    #: Row, nut, preload and oil.
    label: str
    #: Of the row.
    row: RowSizes
    #: Kind of the nut.
    nut: str
    preload: Annotated[Force, NUT_FIELDS["preload"].info]
    #: Name of the oil.
    oil: str
    #: True where all checks were judged and hold.
    holds: bool
    #: False where its loads alone rule it out: friction was not computed, results are empty.
    complete: bool
    #: True within the validity of the model, as far as it was computed.
    valid: bool
    #: True where no other candidate that fits is better in all objectives.
    pareto: bool
    rigid_lift_off_load: Annotated[
        Force | None,
        Info("F_l", "load above which rigid bodies lose the preload, of a nut that has none left; null: some is left"),
    ]
    #: Largest utilisation.
    worst: Ratio
    #: The checks that fail.
    fails: Sequence[Failing]
    #: All checks in a few words.
    verdict: str
    #: The numbers compared.
    objectives: Objectives
    #: Its case file as tables.
    case: Mapping[str, Any]
    #: True where the torque in a full bath of oil is larger: loss and torques compared are the larger.
    starved: bool


class MotorTorque(NamedTuple):
    """The torques that a motor is chosen by."""

    torque_peak: Annotated[Torque, NUMBERS["torque_peak"].info]
    torque_rms: Annotated[Torque, NUMBERS["torque_rms"].info]


class BrakeOfNeed(NamedTuple):
    """What the brake of an axis must hold."""

    #: True where the axis starts to move by itself, or goes on once started.
    falls: bool
    holding_torque: Annotated[Torque, Info("M_h", "largest torque that keeps the axis at rest")]
    load_torque: Annotated[Torque, Info("M_l", "torque of the load without any friction")]
    brake_torque: Annotated[Torque, Info("M_b", "rated torque of a brake")]


#: The torques of the brake.
BRAKE = tuple(quantities_of(BrakeOfNeed))


@dataclasses.dataclass(frozen=True, eq=False)
class OfMotion:
    """What a candidate has beside the others where the need has a motion."""

    #: Numbers of its cycle, where the need has a motion.
    duty: CycleOfNeed
    #: Those in a full bath of oil; null by the rule of catalogues, which knows no oil.
    full_bath: FullBath | None
    #: The torques that a motor is chosen by.
    motor_torque: MotorTorque
    #: What the brake must hold.
    brake: BrakeOfNeed


def candidate(ranked: Ranked, verdict: str, case: Mapping[str, Any]) -> OneCandidate:
    """A candidate with its rank, all checks in a few words, and its case file."""
    found, row = ranked.candidate, ranked.candidate.variant.row
    return from_attributes(
        OneCandidate,
        found,
        rank=ranked.rank,
        label=found.variant.label,
        row=RowSizes(row.nominal_diameter, row.lead, row.source),
        nut=found.variant.nut,
        oil=found.variant.oil_name,
        pareto=ranked.pareto,
        worst=worst(found),
        fails=fails(found),
        verdict=verdict,
        objectives=Objectives(**found.objectives),
        case=case,
        starved=bool(found.starved),
    )


def worst(found: Candidate) -> float | None:
    """The largest utilisation; None where it is not finite."""
    return found.worst if math.isfinite(found.worst) else None


def fails(found: Candidate) -> list[Failing]:
    """The checks that fail."""
    return [Failing(check.name, check.utilisation) for check in found.failed]


def of_motion(duty: DutyReport) -> OfMotion:
    """The cycle of a candidate."""
    return OfMotion(
        CycleOfNeed(**duty.numbers),
        None if duty.by_rule else FullBath(**duty.full_bath),
        MotorTorque(**duty.motor_torque),
        from_attributes(BrakeOfNeed, duty.brake),
    )


def objective(name: str) -> OneObjective:
    """An objective with meaning, unit, and the direction that is better."""
    one = OBJECTIVES[name]
    return OneObjective(name, one.quantity.info.meaning, one.quantity.unit, "more" if one.larger_is_better else "less")
