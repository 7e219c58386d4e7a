"""The JSON API for studies of a design: the inputs that its band comes from, and free geometries for a need."""

from __future__ import annotations

import dataclasses
from typing import Any

from fastapi import APIRouter, Request
from starlette.responses import Response

from ballscrew.faces.web import limits, openapi
from ballscrew.faces.web.bodies import CaseBody, NeedOnly, OptimiseBody, SensitivityBody, case_of, read, refuse_paths
from ballscrew.faces.web.endpoint_parts import as_json, heavy, queue_of, with_sheet
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.questions.optimise import answer as optimise_documents
from ballscrew.questions.optimise import response as optimise_answers
from ballscrew.questions.optimise.compute import Plan, optimise, plan
from ballscrew.questions.optimise.options import OptimiseOptions
from ballscrew.questions.optimise.sheet import sheet as optimise_sheet
from ballscrew.questions.select.need import Need, need_of
from ballscrew.questions.sensitivity import answer as sensitivity_documents
from ballscrew.questions.sensitivity import compute as sensitivities
from ballscrew.questions.sensitivity.answer import Indices
from ballscrew.questions.sensitivity.options import SensitivityOptions
from ballscrew.questions.sensitivity.sheet import sheet as sensitivity_sheet
from ballscrew.questions.shared import option_values
from ballscrew.questions.shared.declared import response

router = APIRouter()


@router.post(
    "/sensitivity",
    openapi_extra=openapi.body(SensitivityBody),
    response_model=response(Indices, "Sensitivity", named="sensitivity"),
    responses=openapi.problems_of(),
)
async def sensitivity(request: Request) -> Response:
    """The inputs that the band of a result comes from: the document of ``ballscrew sensitivity --json``."""
    body: CaseBody = await read(request, SensitivityBody)
    options = option_values.read(SensitivityOptions, dict(body))

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        samples = limits.samples_of_sensitivity(case, options)
        report = sensitivities.sensitivity(case, dataclasses.replace(options, samples=samples), done)
        return with_sheet(sensitivity_documents.document(case, report), sensitivity_sheet(case, report))

    return await heavy(request, work)


@router.post(
    "/optimise",
    openapi_extra=openapi.body(OptimiseBody),
    response_model=optimise_answers.Optimise,
    responses=openapi.problems_of(),
)
async def optimised(request: Request) -> Response:
    """Free geometries for a need, the front of the best: the document of ``ballscrew optimise --json``.

    As a job it may take longer than a request that is waited for, and tells how far it is.
    """
    body: NeedOnly = await read(request, OptimiseBody)
    options = option_values.read(OptimiseOptions, dict(body))

    def work(done: Deadline) -> Response:
        need, _ = _planned(body, options)
        found = optimise(need, **_asked(options), seed=options.seed, done=done)
        return with_sheet(optimise_documents.document(found), optimise_sheet(found))

    return await heavy(request, work)


@router.post(
    "/optimise/plan",
    openapi_extra=openapi.body(OptimiseBody),
    response_model=optimise_answers.OptimisePlan,
    responses=openapi.problems_of(),
)
async def optimise_plan(request: Request) -> Response:
    """What an optimisation would do: its designs, and about its time."""
    body: NeedOnly = await read(request, OptimiseBody)
    options = option_values.read(OptimiseOptions, dict(body))

    def work() -> Response:
        _, found = _planned(body, options)
        return as_json({"designs": found.rigid + found.elastic, "members": found.members, "seconds": found.seconds})

    return await queue_of(request).quick(work)


def _planned(body: NeedOnly, options: OptimiseOptions) -> tuple[Need, Plan]:
    """The need, and what its search would do, unless that is too much."""
    refuse_paths(body.need)
    need = limits.check_need(need_of(body.need))
    limits.check_search(need, options)
    found = plan(need, **_asked(options))
    limits.check_plan(found)
    return need, found


def _asked(options: OptimiseOptions) -> dict[str, Any]:
    """What both a search and its plan take."""
    return {
        "objectives": [name.replace("-", "_") for name in options.objectives] or None,
        "population": options.population,
        "generations": options.generations,
        "members": options.members,
        "quantile": options.quantile,
    }
