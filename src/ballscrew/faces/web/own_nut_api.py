"""The address of the API for a nut of one's own, from the few numbers that a catalogue prints."""

from __future__ import annotations

from fastapi import APIRouter, Request
from starlette.responses import Response

from ballscrew.cases.screw_tables.own_nut import own_nut_of
from ballscrew.faces.web import openapi
from ballscrew.faces.web.bodies import OwnNutBody, read
from ballscrew.faces.web.endpoint_parts import as_json, queue_of
from ballscrew.questions.catalogue import answer as catalogue_answers
from ballscrew.questions.catalogue import own_nut as own_nuts

router = APIRouter()


@router.post(
    "/own-nut",
    openapi_extra=openapi.body(OwnNutBody),
    response_model=catalogue_answers.OwnNut,
    responses=openapi.problems_of(),
)
async def own_nut(request: Request) -> Response:
    """A case of few numbers, what was estimated in it: the document of ``ballscrew catalogue own --json``."""
    body: OwnNutBody = await read(request, OwnNutBody)
    return await queue_of(request).quick(lambda: as_json(own_nuts.document(own_nut_of(body.numbers))))
