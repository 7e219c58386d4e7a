"""The JSON API for balls in motion: the friction of a case after a reversal."""

from __future__ import annotations

from fastapi import APIRouter, Request
from starlette.responses import Response

from ballscrew.faces.web import limits, openapi
from ballscrew.faces.web.bodies import CaseBody, ReversalBody, case_of, read
from ballscrew.faces.web.endpoint_parts import as_json, heavy
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.questions.reversal import compute as reversals
from ballscrew.questions.reversal import document as reversal_documents
from ballscrew.questions.reversal.answer import ReversalResults
from ballscrew.questions.reversal.options import ReversalOptions
from ballscrew.questions.shared import option_values
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
        return as_json(reversal_documents.document(reversals.reversal(case, options)))

    return await heavy(request, work)
