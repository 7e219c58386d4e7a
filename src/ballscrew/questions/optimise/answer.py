"""The results of an optimisation, declared once: the front, each member by the full model."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from ballscrew.basis.quantities import fields_of
from ballscrew.basis.records import documents
from ballscrew.physics.sizing.checks import judged
from ballscrew.questions.check.answer import check_document, list_document
from ballscrew.questions.optimise import OptimiseOptions
from ballscrew.questions.optimise.compute import Member, Optimisation, optimise, plan, warnings
from ballscrew.questions.optimise.design_model import VARIABLES, SearchOptions
from ballscrew.questions.optimise.sheet import cost, sheet
from ballscrew.questions.select.answer import OneObjective, need_document, objective, objectives, refuse_overwriting
from ballscrew.questions.select.requirements import OBJECTIVES
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import FINITE, from_attributes, parts_like, table_of
from ballscrew.questions.shared.question import Answer, Done, Request, Work

#: What is the same for all members, or too long for a list.
_LEFT_OUT = ("units", "provenance", "loads", "name", "nut", "results", "checks", "judged", "holds", "verdict")


@dataclasses.dataclass(frozen=True, eq=False)
class OneMember(parts_like(Member, "name", "variables", "holds", "valid", "pareto", "searched", "objectives")):
    """A design of the front, with its sizes and the numbers compared."""


@dataclasses.dataclass(frozen=True, eq=False)
class Search(table_of(fields_of(SearchOptions), of=Annotated[float, FINITE])):
    """The options of the search, and what it did."""

    quantile: float | None
    evaluations: int
    #: Designs of its front, of which the candidates are a choice.
    front: int
    engine: str
    engine_reason: str
    #: Of each objective from the search to the full model, over the former.
    largest_change: Mapping[str, float]


@dataclasses.dataclass(frozen=True, eq=False)
class Front:
    """Free geometries for a need: what is free, and how the front was searched."""

    nut: str
    #: The numbers compared.
    objectives: Sequence[OneObjective]
    #: Of the sizes that are free, SI.
    bounds: Mapping[str, Sequence[Annotated[float, FINITE]]]
    #: Of sizes, that rows of the catalogue keep.
    ratios: Mapping[str, Sequence[Annotated[float, FINITE]]]
    search: Search


def document(optimisation: Optimisation) -> dict[str, Any]:
    """The document in SI; ``results`` and ``checks`` of a member are those of ``ballscrew check --json``."""
    space = optimisation.space
    first = list_document([optimisation.members[0].checked])[0] if optimisation.members else {}
    units = {name: unit for name, unit in first.get("units", {}).items() if name != "loads"}
    search = from_attributes(
        Search,
        space.options,
        evaluations=optimisation.evaluations,
        front=len(optimisation.front.designs),
        engine=optimisation.engine[0],
        engine_reason=optimisation.engine[1],
        largest_change=optimisation.largest_change,
    )
    return {
        "need": need_document(optimisation.need),
        **declared.document(
            from_attributes(Front, space, objectives=[objective(name) for name in space.objectives], search=search)
        ),
        "candidates": [_member(member) for member in optimisation.members],
        "notes": list(optimisation.notes),
        "warnings": documents(warnings(optimisation)),
        "units": {
            **units,
            "variables": {name: quantity.unit for name, quantity in VARIABLES.items()},
            "objectives": {name: one.quantity.unit for name, one in OBJECTIVES.items()},
        },
        "provenance": first.get("provenance"),
    }


def _member(member: Member) -> dict[str, Any]:
    whole = list_document([member.checked])[0]
    return {
        **declared.document(from_attributes(OneMember, member)),
        "results": whole["results"],
        "checks": [check_document(check) for check in member.checks],
        "judged": judged(member.checks),
        **{name: part for name, part in whole.items() if name not in _LEFT_OUT},
        "case": dict(member.case),
    }


def _search(request: Request) -> dict[str, Any]:
    """Arguments that both a search and its plan take; the seed is of the search alone."""
    options = vars(request.options(OptimiseOptions))
    return {**options, **vars(request.case_options), "objectives": objectives(options["objectives"])}


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    limits, need = _search(request), request.need
    assert need is not None
    refuse_overwriting(request)
    seed = limits.pop("seed")
    planned = plan(need, **limits)

    def answer(done: Done) -> Answer:
        front = optimise(need, seed=seed, done=done, **limits)
        return Answer(sheet(front), lambda: document(front), f"{len(front.members)} designs")

    return Work(answer, "designs", cost=cost(planned))


def plan_document(request: Request) -> Any:
    """The document of the plan."""
    limits = _search(request)
    limits.pop("seed")
    assert request.need is not None
    planned = plan(request.need, **limits)
    designs = planned.rigid + planned.elastic
    return {"designs": designs, "members": planned.members, "seconds": planned.seconds}
