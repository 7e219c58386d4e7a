"""Addresses of the API made of questions (:mod:`ballscrew.questions.shared.question`)."""

from __future__ import annotations

import contextlib
import functools
import inspect
from collections.abc import Generator, Mapping
from pathlib import Path
from typing import Any

from fastapi import APIRouter
from pydantic import Field, create_model
from starlette.responses import Response

from ballscrew.faces.web.bodies import (
    MOST_FILE_BYTES,
    MOST_LOG_BYTES,
    Body,
    CaseBody,
    NeedBody,
    SentCase,
    SentFile,
    refuse_paths,
)
from ballscrew.faces.web.endpoint_parts import as_bytes, as_json, post, with_sheet
from ballscrew.faces.web.limits import check_options
from ballscrew.faces.web.request_queue import Deadline
from ballscrew.faces.web.sent_files import written
from ballscrew.questions import responses
from ballscrew.questions.records import QUESTIONS
from ballscrew.questions.shared.options import body_fields, options_of
from ballscrew.questions.shared.question import Question, Request, Sent

router = APIRouter()


def body_of(question: Question) -> type[Body]:
    """The body of a question: a case or a need, the files that it reads, and its options as they are written."""
    has_need = any(file.is_need for file in question.reads)
    fields: dict[str, Any] = {file.name: _field(file) for file in question.endpoint.files}
    for options in question.sent_options:
        fields |= body_fields(options)
    words = ["A need" if has_need else "A case", *(f"``{name}``" for name in fields)]
    base = NeedBody if has_need else CaseBody
    body = create_model(_title(question), __base__=base, __doc__=", ".join(words) + ".", **fields)
    body.files = tuple(file.name for file in question.endpoint.files)
    if body.files:
        body.most_bytes = MOST_FILE_BYTES if has_need else MOST_LOG_BYTES
    return body


def _title(question: Question) -> str:
    return "".join(word.capitalize() for word in question.name.split("-")) + "Body"


def _field(file: Sent) -> Any:
    """The field of a file in a body."""
    if file.most > 1:
        return (list[SentFile], Field(min_length=1, max_length=file.most))
    return (SentFile | None, None) if file.is_optional else (SentFile, ...)


def answer(question: Question, body: Body, done: Deadline) -> Response:
    """The answer to a body of a question: its document with its sheet."""
    with _request(question, body, done) as request:
        result = question.answer.prepare(request).answer(done)
        return with_sheet(result.document(), result.sheet)


@contextlib.contextmanager
def _request(question: Question, body: Body, done: Deadline) -> Generator[Request]:
    """The request of a body, whose files are there meanwhile."""
    values = dict(body)
    if isinstance(body, CaseBody):  # options of a search have bounds of their own
        check_options(question.sent_options, values)
    options = {
        **_defaults(question),
        **question.endpoint.written,
        **{name: values[name] for cls in question.sent_options for name in options_of(cls)},
    }
    files: dict[str, list[Path]] = {file.name: [] for file in question.reads}
    with written(_contents(question, values)) as paths:
        for file in question.endpoint.files:
            sent = [path for field, path in paths.items() if field.partition(" ")[0] == file.name]
            if file.stands_for in files:
                files[file.stands_for] += sent
            elif sent:
                options[file.stands_for] = str(sent[0])
        if isinstance(body, NeedBody):
            refuse_paths(body.need)
        yield Request(
            files=files,
            case=SentCase(body.case) if isinstance(body, CaseBody) else None,
            need=body.need if isinstance(body, NeedBody) else None,
            written=options,
            send=lambda part: done.row(as_bytes(part)),
        )


def _defaults(question: Question) -> dict[str, Any]:
    """All options of a question as they are written where they are left out; of one that several have, the first."""
    classes = reversed(question.options)
    return {name: option.written_default for cls in classes for name, option in options_of(cls).items()}


def _contents(question: Question, values: Mapping[str, Any]) -> dict[str, SentFile]:
    """The files of a body by their fields, with a number where a field has several."""
    contents: dict[str, SentFile] = {}
    for file in question.endpoint.files:
        if file.most > 1:
            contents |= {f"{file.name} {number}": each for number, each in enumerate(values[file.name], start=1)}
        elif values[file.name] is not None:
            contents[file.name] = values[file.name]
    return contents


def _add(question: Question) -> None:
    """Add the addresses of a question."""
    work = functools.partial(answer, question)
    name, help = question.name.replace("-", "_"), inspect.cleandoc(question.help).partition("\n\n")[0]
    words = f"{help} The document of ``ballscrew {question.name} --json``, with its sheet."
    body, plan = BODIES[question.name], question.endpoint.plan
    post(router, f"/{question.name}", body, responses.OF_QUESTIONS[question.name], name=name, description=words)(work)
    if not plan:
        return

    def planned(body: Body, done: Deadline) -> Response:
        with _request(question, body, done) as request:
            return as_json(question.answer.plan_document(request))

    def is_quick(body: Body) -> bool:
        return not _contents(question, dict(body))

    post(
        router,
        f"/{question.name}/plan",
        body,
        responses.OF_PLANS[question.name],
        name=f"{name}_plan",
        description=plan,
        is_quick=is_quick,
    )(planned)


BODIES = {question.name: body_of(question) for question in QUESTIONS}
for _question in QUESTIONS:
    _add(_question)
