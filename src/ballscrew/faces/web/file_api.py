"""Addresses of the API for files: those that are opened, and those that are saved."""

from __future__ import annotations

from typing import Annotated, Any

import tomli_w
from fastapi import APIRouter, Query, Request
from starlette.responses import Response

from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.output.json_text import as_json as json_text
from ballscrew.cases.case_files import project as projects
from ballscrew.cases.case_files.opened_file import opened
from ballscrew.faces.web import openapi
from ballscrew.faces.web.bodies import CaseBody, OpenBody, ProjectBody, case_of, read, refuse_nulls
from ballscrew.faces.web.endpoint_parts import as_json, heavy, queue_of
from ballscrew.faces.web.sent_files import written
from ballscrew.questions.shared import file_answer as file_answers

#: Media types of a project, by its ``kind``.
KINDS = {"toml": "application/toml", "json": "application/json"}

router = APIRouter()


@router.post(
    "/open", openapi_extra=openapi.body(OpenBody), response_model=file_answers.Opened, responses=openapi.problems_of()
)
async def open_file(request: Request) -> Response:
    """The designs of a case file, a project or a table of screws, unchecked: ``run`` finds their faults."""
    body: OpenBody = await read(request, OpenBody)

    def work(_: Any) -> Response:
        with written({"file": body.file}, tables=False) as paths:
            found = opened(paths["file"])
        designs = [{"name": one.name, "case": dict(one.tables), "aside": dict(one.aside)} for one in found.designs]
        return as_json({"kind": found.kind, "designs": designs, "comments": found.comments, "notes": list(found.notes)})

    return await heavy(request, work)


@router.post("/toml", openapi_extra=openapi.body(CaseBody), responses=openapi.text("application/toml"))
async def toml(request: Request) -> Response:
    """The case as a file, ready for ``ballscrew run``."""
    body: CaseBody = await read(request, CaseBody)

    def text() -> str:
        case_of(body.case)
        return tomli_w.dumps(body.case)

    return Response(await queue_of(request).quick(text), media_type="application/toml")


@router.post("/project", openapi_extra=openapi.body(ProjectBody), responses=openapi.text(*KINDS.values()))
async def project(
    request: Request,
    kind: Annotated[str, Query(json_schema_extra={"enum": [*KINDS]}, description="the kind of file")] = "toml",
) -> Response:
    """Designs as one project file, ready for ``ballscrew compare``; they may be at fault."""
    body: ProjectBody = await read(request, ProjectBody)
    if kind not in KINDS:
        raise InputError(Fault("?kind", "unknown kind of file", kind, nearest(kind, KINDS)))

    def work(_: Any) -> Response:
        refuse_nulls(body.designs)
        found = projects.designs_of({projects.KEY: projects.VERSION, "designs": body.designs}, "request")
        tables = projects.tables_of(found)
        return Response(tomli_w.dumps(tables) if kind == "toml" else json_text(tables), media_type=KINDS[kind])

    return await heavy(request, work)
