"""Addresses of the API for jobs: long requests that are started, asked for, and cancelled."""

from __future__ import annotations

from typing import Annotated, Any
from urllib.parse import urlencode

from fastapi import APIRouter, Path, Query, Request
from starlette.responses import Response

from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.faces.web import openapi
from ballscrew.faces.web.bodies import MOST_LOG_BYTES, content_of
from ballscrew.faces.web.endpoint_parts import as_bytes
from ballscrew.faces.web.jobs import Job, Jobs
from ballscrew.faces.web.problems import Refused
from ballscrew.questions import responses

#: Addresses whose requests may be jobs: all that may compute for more than two seconds.
ADDRESSES = (
    "band", "check", "compare", "condition", "duty", "fit", "hand-over", "log", "open", "optimise", "report",
    "reversal", "ripple", "run", "select", "sensitivity", "service", "sweep", "warm-up",
)  # fmt: skip
#: Seconds that one may wait for news of a job.
LONGEST_WAIT = 30.0

router = APIRouter(prefix="/jobs")
_Address = Annotated[str, Path(json_schema_extra={"enum": [*ADDRESSES]}, description="of the request")]
_Id = Annotated[str, Path(description="of the job", examples=["none"])]


@router.post(
    "/{address}",
    status_code=202,
    openapi_extra={"requestBody": {"required": True, "content": {"application/json": {"schema": {"type": "object"}}}}},
    response_model=responses.Job,
    responses=openapi.problems_of(404),
)
async def start(
    request: Request, address: _Address, kind: Annotated[str, Query(description="of a report")] = ""
) -> Response:
    """Start a request to an address as a job; the body is that of the address."""
    if address not in ADDRESSES:
        raise InputError(Fault("/jobs/", "no such address for jobs", address[:80], nearest(address, ADDRESSES)))
    body = await content_of(request, MOST_LOG_BYTES)
    jobs = _jobs_of(request)
    job = jobs.begin(address, urlencode({"kind": kind}) if kind else "", body)
    document = _document(jobs, job, 0)
    document.status_code = 202
    document.headers["Location"] = f"/api/v1/jobs/{job.id}"
    return document


@router.get("/{id}", response_model=responses.Job, responses=openapi.problems_of(404))
async def state(
    request: Request,
    id: _Id,
    wait: Annotated[float, Query(ge=0, le=LONGEST_WAIT, description="seconds to wait for news at most")] = 0.0,
    rows: Annotated[int, Query(ge=0, description="rows that are known already")] = 0,
) -> Response:
    """Progress of a job, and the rows of its answer that it has found by now."""
    jobs = _jobs_of(request)
    job = jobs.named(id)
    if len(job.rows) <= rows:
        await job.changed(wait)
    return _document(jobs, job, rows)


@router.get(
    "/{id}/answer", responses={200: {"description": "the answer of the address"}, **openapi.problems_of(404, 409)}
)
async def answer(request: Request, id: _Id) -> Response:
    """The answer of a job that has ended: what its address answers, a refusal with its status, or a file."""
    result = _jobs_of(request).named(id).answer
    if result is None:
        raise Refused(409, Fault("job", "has not ended", "", "ask how far it is, and wait"))
    return Response(result.body, result.status, media_type=result.media_type)


@router.delete("/{id}", response_model=responses.Job, responses=openapi.problems_of(404))
async def cancel(request: Request, id: _Id) -> Response:
    """Cancel a job: its work is killed at once."""
    jobs = _jobs_of(request)
    job = jobs.named(id)
    job.cancel()
    return _document(jobs, job, 0)


def _jobs_of(request: Request) -> Jobs:
    jobs: Jobs = request.app.state.jobs
    return jobs


def _document(jobs: Jobs, job: Job, known: int) -> Response:
    fields: dict[str, Any] = {
        "id": job.id, "address": job.address, "state": job.state, "before": jobs.before(job),
        "finished": job.finished, "total": job.total, "computed": job.computed, "limit": jobs.limit,
    }  # fmt: skip
    rows = b",".join(job.rows[known:])  # JSON already
    return Response(as_bytes(fields)[:-1] + b',"rows":[' + rows + b"]}", media_type="application/json")
