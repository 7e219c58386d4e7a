"""Response models of the API for screws that are ranked for a need."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from ballscrew.questions.select.answer import (
    BrakeOfNeed,
    CycleOfNeed,
    FullBath,
    MotorTorque,
    OneCandidate,
    OneObjective,
)
from ballscrew.questions.select.compute import Plan as PlanOfNeed
from ballscrew.questions.shared.answer_parts import Closed, Open, Provenance, Record, Tables, field
from ballscrew.questions.shared.declared import schema

_Candidate: Any = schema(OneCandidate)
_Objective: Any = schema(OneObjective)
_Cycle, _Bath, _Motor, _Brake = (schema(each) for each in (CycleOfNeed, FullBath, MotorTorque, BrakeOfNeed))
Plan: Any = schema(PlanOfNeed)


class Candidate(_Candidate, Open):
    """A row with a nut, a preload and an oil: the document of its check, with its rank."""

    results: Tables
    checks: list[Tables]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    verdicts: list[Record]
    warnings: list[Record]
    duty: _Cycle = field("numbers of its cycle, where the need has a motion", optional=True)  # pyright: ignore[reportInvalidTypeForm]
    full_bath: _Bath | None = field("those in a full bath of oil; null by the rule of catalogues", optional=True)  # pyright: ignore[reportInvalidTypeForm]
    motor_torque: _Motor = field("torques that a motor is chosen by", optional=True)  # pyright: ignore[reportInvalidTypeForm]
    brake: _Brake = field("what the brake must hold", optional=True)  # pyright: ignore[reportInvalidTypeForm]


class Select(Closed):
    """Candidates for a need, the best first."""

    need: Tables
    objectives: list[_Objective]  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    best: str | None = Field(description="label of the first that holds within the validity of the model")
    holding: int
    ruled_out: int = Field(description="candidates that their loads alone rule out, without the full model")
    candidates: list[Candidate]
    notes: list[str]
    warnings: list[Record] = Field(description="lubricant.starved, of the first candidate that is")
    units: Tables
    provenance: Provenance | None
