"""Response models of the API for an optimisation."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.optimise.answer import Front, OneMember
from ballscrew.questions.select.response import OfCheck
from ballscrew.questions.shared.answer_parts import Closed, Provenance, Record, Shown, Tables
from ballscrew.questions.shared.declared import schema


class Member(schema(OneMember), OfCheck):
    """A design of the front: the document of its check, with its sizes and the numbers compared."""

    case: Tables = Field(description="its case file as tables")


class Optimise(schema(Front), Shown):
    """Free geometries for a need: the front of the best."""

    need: Tables
    candidates: list[Member]
    notes: list[str]
    warnings: list[Record]
    units: Tables
    provenance: Provenance | None


class OptimisePlan(Closed):
    """What an optimisation would do."""

    designs: int = Field(description="that the search evaluates")
    members: int = Field(description="that are then evaluated in full, at most")
    seconds: float = Field(description="of one processor, about")
