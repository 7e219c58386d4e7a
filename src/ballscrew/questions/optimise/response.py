"""Response models of the API for an optimisation."""

from __future__ import annotations

from collections.abc import Sequence

from pydantic import Field

from ballscrew.questions.select.answer import OneObjective
from ballscrew.questions.shared.answer_parts import Closed, Numbers, Open, Provenance, Record, Shown, Tables
from ballscrew.questions.shared.declared import with_answers


class Member(Open):
    """A design of the front: the document of its check, with its sizes and the numbers compared."""

    name: str
    variables: Numbers = Field(description="sizes in SI; the preload as a share of the dynamic load rating")
    holds: bool = Field(description="whether all checks were judged and hold")
    valid: bool = Field(description="whether it lies within the validity of the model")
    pareto: bool = Field(description="whether no other member is better in all objectives by the full model")
    searched: Numbers = Field(description="the objectives of the search: with a quantile, at that")
    objectives: Numbers = Field(description="by the full model, SI")
    results: Tables
    checks: list[Tables]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    verdicts: list[Record]
    warnings: list[Record]
    case: Tables = Field(description="its case file as tables")


class Search(Closed):
    """The options of the search, and what it did."""

    population: float
    generations: float
    elastic_generations: float
    members: float
    seed: float
    quantile: float | None
    samples: float
    margin: float
    evaluations: int
    front: int = Field(description="designs of its front, of which the candidates are a choice")
    engine: str
    engine_reason: str
    largest_change: Numbers = Field(description="of each objective from the search to the full model, over the former")


class Optimise(with_answers(objectives=Sequence[OneObjective]), Shown):
    """Free geometries for a need: the front of the best."""

    need: Tables
    nut: str
    bounds: dict[str, list[float]] = Field(description="of the sizes that are free, SI")
    ratios: dict[str, list[float]] = Field(description="of sizes, that rows of the catalogue keep")
    search: Search
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
