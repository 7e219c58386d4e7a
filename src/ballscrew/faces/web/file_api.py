"""Addresses of the API for files: designs that are opened and saved, logs that are fitted, and hand-overs.

A file is read by the readers of the command line from a folder that is removed before the answer is sent.
"""

from __future__ import annotations

import base64
import dataclasses
import io
import tomllib
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath
from typing import Annotated, Any

import tomli_w
from fastapi import APIRouter, Query, Request
from starlette.responses import Response

from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.output import json_text
from ballscrew.cases.case_files import fitted_case
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.opened_file import opened
from ballscrew.cases.case_files.project import KEY, VERSION, designs_of, tables_of
from ballscrew.exports import hand_over as requests
from ballscrew.exports.export import Export
from ballscrew.faces.web import openapi
from ballscrew.faces.web.bodies import (
    CaseBody,
    FitBody,
    HandOverBody,
    LogBody,
    OpenBody,
    ProjectBody,
    TargetBody,
    case_of,
    read,
    refuse_nulls,
)
from ballscrew.faces.web.endpoint_parts import always, as_json, heavy, post, with_sheet
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.faces.web.sent_files import written
from ballscrew.files.torque_logs.reading import preview
from ballscrew.questions import responses
from ballscrew.questions.fit import answer, compute
from ballscrew.questions.fit.log import is_moving_log, read_options, steady_log
from ballscrew.questions.fit.sheet import sheet
from ballscrew.questions.hand_over import HandOverOptions
from ballscrew.questions.hand_over import answer as hand_over_documents
from ballscrew.questions.hand_over.answer import blocks, lines
from ballscrew.questions.shared import option_values

#: Media types of a project, by its ``kind``.
KINDS = {"toml": "application/toml", "json": "application/json"}

router = APIRouter()


@post(router, "/open", OpenBody, responses.Opened)
def open_file(body: OpenBody, _: Deadline) -> Response:
    """The designs of a case file, a project or a table of screws, unchecked: ``run`` finds their faults."""
    with written({"file": body.file}, tables=False) as paths:
        file = opened(paths["file"])
    designs = [{"name": each.name, "case": dict(each.tables), "aside": dict(each.aside)} for each in file.designs]
    return as_json({"kind": file.kind, "designs": designs, "comments": file.comments, "notes": list(file.notes)})


@post(router, "/toml", CaseBody, responses=openapi.text("application/toml"), is_quick=always)
def toml(body: CaseBody, _: object) -> Response:
    """The case as a file, ready for ``ballscrew run``."""
    case_of(body.case)
    return Response(tomli_w.dumps(body.case), media_type="application/toml")


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
        designs = designs_of({KEY: VERSION, "designs": body.designs}, "request")
        tables = tables_of(designs)
        return Response(tomli_w.dumps(tables) if kind == "toml" else json_text.as_json(tables), media_type=KINDS[kind])

    return await heavy(request, work)


@post(router, "/log", LogBody, responses.Log)
def log(body: LogBody, _: Deadline) -> Response:
    """The columns of a log and what each is taken for, and the numbers of the case that may be fitted to it."""
    case = case_of(body.case)
    with written({"log": body.log}) as paths:
        moving = is_moving_log(paths["log"], body.columns)
        columns = preview(paths["log"], body.columns)
    return as_json(answer.columns_document(columns, compute.candidates(case), moving=moving))


@post(router, "/fit", FitBody, responses.Fit)
def fit(body: LogBody, done: Deadline) -> Response:
    """A case fitted to a log of torques: the document of ``ballscrew fit --json``, its sheet and the fitted case."""
    case = case_of(body.case)
    options = read_options(case, dict(body))
    with written({"log": body.log}) as paths:
        if is_moving_log(paths["log"], body.columns):
            remedy = "give a log of load, speed and torque; this one is for ballscrew fit on the command line"
            raise InputError(Fault("log", "is of a moving axis", paths["log"].name, remedy))
        steady = steady_log(case, paths["log"], options, done)
    assumed: Sequence[str] = ()
    if options.self_heating:
        from ballscrew.questions.fit.compute import warm_log

        steady, assumed = warm_log(case, steady, options.kind)
    report = dataclasses.replace(compute.fit(case, steady, options, done), assumed=assumed)
    calibrated = fitted_case.text_of(body.case, case, report.model)
    document = {
        **answer.document(case, report),
        "calibrated": {"toml": calibrated, "case": tomllib.loads(calibrated)},
    }
    return with_sheet(document, sheet(case, report))


@post(router, "/hand-over", HandOverBody, responses.HandOver)
def hand_over(body: TargetBody, _: Deadline) -> Response:
    """A case as files for another program: the document of ``ballscrew hand-over --json``, with the files."""
    options = option_values.read(HandOverOptions, dict(body))
    requests.check_target(body.to)
    case: Case = case_of(body.case)
    export = requests.of_case(case, body.to, requests.Request(**vars(options)))
    names = [PurePosixPath(name) for name in export.files]
    ranges = [line for heading, entries in blocks(export) for line in (heading, *entries)]
    return as_json(
        {
            **hand_over_documents.document(export, case, names),
            "words": {"lines": lines(export), "ranges": ranges},
            "file": _file(export),
        }
    )


def _file(export: Export) -> dict[str, str]:
    """The only file of an export, or an archive of several."""
    if len(export.files) == 1:
        ((name, content),) = export.files.items()
        media = "application/octet-stream"
    else:
        name, media, content = f"{export.target}.zip", "application/zip", _archive(export.files)
    return {"name": name, "media_type": media, "base64": base64.b64encode(content).decode()}


def _archive(files: Mapping[str, bytes]) -> bytes:
    """A zip archive, the same bytes for the same files."""
    with io.BytesIO() as made:
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in files.items():
                archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
        return made.getvalue()
