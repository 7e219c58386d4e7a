"""The JSON API for balls in motion: the friction after a reversal, and the torque over the angle."""

from __future__ import annotations

from fastapi import APIRouter, Request
from starlette.responses import Response

from ballscrew.faces.web import limits, openapi
from ballscrew.faces.web.bodies import CaseBody, ReversalBody, RippleBody, case_of, read
from ballscrew.faces.web.endpoint_parts import heavy, with_sheet
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.questions.reversal import answer as reversal_documents
from ballscrew.questions.reversal import compute as reversals
from ballscrew.questions.reversal.answer import ReversalResults
from ballscrew.questions.reversal.options import ReversalOptions
from ballscrew.questions.reversal.sheet import sheet as reversal_sheet
from ballscrew.questions.ripple import answer as ripple_documents
from ballscrew.questions.ripple import compute as ripples
from ballscrew.questions.ripple.answer import RippleResults
from ballscrew.questions.ripple.options import RippleOptions
from ballscrew.questions.ripple.sheet import sheet as ripple_sheet
from ballscrew.questions.shared import option_values
from ballscrew.questions.shared.answer_parts import Assumed
from ballscrew.questions.shared.declared import response

router = APIRouter()


@router.post(
    "/reversal",
    openapi_extra=openapi.body(ReversalBody),
    response_model=response(ReversalResults, "Reversal"),
    responses=openapi.problems_of(),
)
async def reversal(request: Request) -> Response:
    """Friction of a case after a reversal, a hypothesis: the document of ``ballscrew reversal --json``."""
    body: CaseBody = await read(request, ReversalBody)
    options = option_values.read(ReversalOptions, dict(body))

    def work(_: Deadline) -> Response:
        case = case_of(body.case)
        limits.check_reversal(case, options)
        report = reversals.reversal(case, options)
        return with_sheet(reversal_documents.document(report), reversal_sheet(report))

    return await heavy(request, work)


@router.post(
    "/ripple",
    openapi_extra=openapi.body(RippleBody),
    response_model=response(RippleResults, "Ripple", beside=Assumed),
    responses=openapi.problems_of(),
)
async def ripple(request: Request) -> Response:
    """Friction torque of the balls of a nut over the angle of its screw: the document of ``ballscrew ripple --json``.

    What no catalogue prints is assumed, and named in the answer.
    """
    body: CaseBody = await read(request, RippleBody)
    options = option_values.read(RippleOptions, dict(body))

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        limits.check_ripple(case, options)
        report = ripples.ripple_of(case, options, done)
        return with_sheet(ripple_documents.document(report), ripple_sheet(report))

    return await heavy(request, work)
