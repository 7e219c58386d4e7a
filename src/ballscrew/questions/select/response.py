"""Response models of the API for screws that are ranked for a need."""

from __future__ import annotations

from collections.abc import Sequence

from pydantic import Field

from ballscrew.questions.select.answer import OfMotion, OneCandidate, OneObjective
from ballscrew.questions.shared.answer_parts import Open, Provenance, Record, Shown, Tables
from ballscrew.questions.shared.declared import schema, with_answers


class OfCheck(Open):
    """The parts of the document of a check that candidates have."""

    results: Tables
    checks: list[Tables]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    verdicts: list[Record]
    warnings: list[Record]


class Candidate(schema(OneCandidate), schema(OfMotion, optional=True), OfCheck):
    """A row with a nut, a preload and an oil: the document of its check, with its rank."""


class Select(with_answers(objectives=Sequence[OneObjective]), Shown):
    """Candidates for a need, the best first."""

    need: Tables
    best: str | None = Field(description="label of the first that holds within the validity of the model")
    holding: int
    ruled_out: int = Field(description="candidates that their loads alone rule out, without the full model")
    candidates: list[Candidate]
    notes: list[str]
    warnings: list[Record] = Field(description="lubricant.starved, of the first candidate that is")
    units: Tables
    provenance: Provenance | None
