"""The question of free geometries for a need."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.optimise.options import OptimiseOptions
from ballscrew.questions.select.question import objectives, refuse_overwriting
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import NEED, Answer, Done, Endpoint, Plan, Question, Request, Work


def _search(request: Request) -> dict[str, Any]:
    """What both a search and its plan take; the seed is of the search alone."""
    options = vars(request.options(OptimiseOptions))
    return {**options, **vars(request.case_options), "objectives": objectives(options["objectives"])}


def _prepare(request: Request) -> Work:
    from ballscrew.questions.optimise import compute
    from ballscrew.questions.optimise.answer import document
    from ballscrew.questions.optimise.sheet import cost, sheet

    limits, need = _search(request), request.need
    assert need is not None
    refuse_overwriting(request)
    seed = limits.pop("seed")
    planned = compute.plan(need, **limits)

    def answer(done: Done) -> Answer:
        front = compute.optimise(need, seed=seed, done=done, **limits)
        return Answer(sheet(front), lambda: document(front), f"{len(front.members)} designs")

    return Work(answer, "designs", cost=cost(planned))


def _plan(request: Request) -> Any:
    from ballscrew.questions.optimise import compute

    limits = _search(request)
    limits.pop("seed")
    assert request.need is not None
    plan = compute.plan(request.need, **limits)
    return {"designs": plan.rigid + plan.elastic, "members": plan.members, "seconds": plan.seconds}


def _response() -> Any:
    from ballscrew.questions.optimise.response import Optimise

    return Optimise


def _plan_response() -> Any:
    from ballscrew.questions.optimise.response import OptimisePlan

    return OptimisePlan


OPTIMISE = Question(
    name="optimise",
    help="""Pareto front of screw geometries for a need. They are free within what makers produce.

    The need is that of ballscrew select; its table [optimise] has bounds and objectives. Each member is evaluated by
    the full model and all checks. Needs the extra optimise.
    """,
    reads=(NEED,),
    options=(OptimiseOptions,),
    case_texts={"settings": "Change a value: --set optimise.nut=single."},
    files=Option(
        "Also write a table (.csv, .xlsx) or a picture (.png, .svg, .pdf); may be repeated.", short="-o", metavar="FILE"
    ),
    has_several_files=True,
    prepare=_prepare,
    endpoint=Endpoint(
        response=_response, plan=Plan(_plan, _plan_response, "Designs of an optimisation, and about its time.")
    ),
)
