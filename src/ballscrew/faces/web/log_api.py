"""The JSON API for logs and hand-overs: calibrate a case, find the preload that is left, and hand the model over.

A log is read by the readers of the command line from a folder that is removed before the answer is sent.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Sequence

from fastapi import APIRouter, Request
from starlette.responses import Response

from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.exports import requests
from ballscrew.faces.web import limits, log_documents, openapi, sent_files, starts
from ballscrew.faces.web.bodies import case_of, read
from ballscrew.faces.web.endpoint_parts import as_bytes, as_json, heavy, kept, with_sheet
from ballscrew.faces.web.log_bodies import (
    ConditionBody,
    FitBody,
    HandOverBody,
    LogBody,
    LogsBody,
    ServiceBody,
    TargetBody,
    TestsBody,
)
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.files.torque_logs.preview import preview
from ballscrew.questions.condition import answer as condition_documents
from ballscrew.questions.condition import compute as conditions
from ballscrew.questions.condition.answer import ConditionResults
from ballscrew.questions.condition.options import ConditionOptions
from ballscrew.questions.condition.sheet import sheet as condition_sheet
from ballscrew.questions.fit import compute as fits
from ballscrew.questions.fit import log_answer
from ballscrew.questions.fit import log_document as log_documents_of
from ballscrew.questions.fit import response as fit_answers
from ballscrew.questions.fit.log import read_options, steady_log
from ballscrew.questions.fit.sheet import sheet as fit_sheet
from ballscrew.questions.fit_motion.log import is_moving
from ballscrew.questions.hand_over import answer as hand_over_answers
from ballscrew.questions.hand_over import document as hand_over_documents
from ballscrew.questions.hand_over.options import HandOverOptions
from ballscrew.questions.service import answer as service_documents
from ballscrew.questions.service import compute as services
from ballscrew.questions.service.answer import ServiceResults
from ballscrew.questions.service.options import ServiceOptions
from ballscrew.questions.service.sheet import sheet as service_sheet
from ballscrew.questions.shared import option_values
from ballscrew.questions.shared.answer_parts import OfLogs
from ballscrew.questions.shared.declared import response

router = APIRouter()


@router.post(
    "/log", openapi_extra=openapi.body(LogBody), response_model=log_answer.Log, responses=openapi.problems_of()
)
async def log(request: Request) -> Response:
    """The columns of a log and what each is taken for, and the numbers of the case that may be fitted to it."""
    body: LogBody = await read(request, LogBody)

    def work(_: Deadline) -> Response:
        case = case_of(body.case)
        with sent_files.written({"log": body.log}) as paths:
            moving = is_moving(paths["log"], body.columns)
            found = preview(paths["log"], body.columns)
        return as_json(log_documents_of.document(found, fits.candidates(case), moving=moving))

    return await heavy(request, work)


@router.post(
    "/fit", openapi_extra=openapi.body(FitBody), response_model=fit_answers.Fit, responses=openapi.problems_of()
)
async def fit(request: Request) -> Response:
    """A case fitted to a log of torques: the document of ``ballscrew fit --json``, its sheet and the fitted case."""
    body: LogBody = await read(request, FitBody)

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        chosen = read_options(case, dict(body))
        with sent_files.written({"log": body.log}) as paths:
            if is_moving(paths["log"], body.columns):
                remedy = "give a log of load, speed and torque; this one is for ballscrew fit on the command line"
                raise InputError(Fault("log", "is of a moving axis", paths["log"].name, remedy))
            steady = steady_log(case, paths["log"], chosen, done)
        assumed: Sequence[str] = ()
        if chosen.self_heating:
            from ballscrew.questions.fit.warm_log import warm_log

            steady, assumed = warm_log(case, steady, chosen.kind)
        report = dataclasses.replace(fits.fit(case, steady, chosen, done), assumed=assumed)
        return with_sheet(log_documents.fit(case, body.case, report), fit_sheet(case, report))

    return await heavy(request, work)


@router.post(
    "/service",
    openapi_extra=openapi.body(ServiceBody),
    response_model=response(ServiceResults, "Service", beside=OfLogs),
    responses=openapi.problems_of(),
)
async def service(request: Request) -> Response:
    """The preload left in a nut, by one log or two: the document of ``ballscrew service --json``, with its sheet."""
    body: LogsBody = await read(request, ServiceBody)

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        chosen = option_values.read(ServiceOptions, dict(body))
        logs = {name: file for name, file in (("new", body.new), ("worn", body.worn)) if file is not None}
        with sent_files.written(logs) as paths:
            report = services.of_logs(case, list(paths.values()), chosen, done)
        return with_sheet(service_documents.document(case, report), service_sheet(case, report))

    return await heavy(request, work)


@router.post(
    "/condition",
    openapi_extra=openapi.body(ConditionBody),
    response_model=response(ConditionResults, "Condition", beside=OfLogs),
    responses=openapi.problems_of(),
)
async def condition(request: Request) -> Response:
    """The state of a nut over time: the document of ``ballscrew condition --json``, with its sheet."""
    body: TestsBody = await read(request, ConditionBody)
    options = option_values.read(ConditionOptions, dict(body))
    conditions.check_kind(len(body.tests), dict(body))

    def work(done: Deadline) -> Response:
        case = case_of(body.case)
        with sent_files.written({f"tests {number}": file for number, file in enumerate(body.tests, 1)}) as paths:
            found = conditions.of_files(case, list(paths.values()), options, done)
        return with_sheet(condition_documents.document(case, found), condition_sheet(case, found))

    return await heavy(request, work)


@router.post(
    "/hand-over",
    openapi_extra=openapi.body(HandOverBody),
    response_model=hand_over_answers.HandOver,
    responses=openapi.problems_of(),
)
async def hand_over(request: Request) -> Response:
    """A case as files for another program: the document of ``ballscrew hand-over --json``, with the files."""
    body: TargetBody = await read(request, HandOverBody)
    options = option_values.read(HandOverOptions, dict(body))

    def work(_: Deadline) -> Response:
        requests.check_target(body.to)
        case: Case = limits.check_hand_over(
            case_of(body.case), options.parameters, options.outputs, options.derivatives
        )
        return as_json(
            log_documents.hand_over(case, requests.of_case(case, body.to, requests.Request(**vars(options))))
        )

    return await heavy(request, work)


@router.get("/targets", response_model=hand_over_answers.Targets, responses=openapi.problems_of())
async def targets(request: Request) -> Response:
    """The targets of a hand-over, and the choices that each has."""
    return kept(request, _targets())


@functools.cache
def _targets() -> bytes:
    return as_bytes(hand_over_documents.targets())


@router.get("/examples", response_model=log_answer.Examples, responses=openapi.problems_of())
async def examples(request: Request) -> Response:
    """Logs to try, each with its case: those of the folder ``examples`` of the repository."""
    return kept(request, _examples())


@functools.cache
def _examples() -> bytes:
    return as_bytes(starts.logs())
