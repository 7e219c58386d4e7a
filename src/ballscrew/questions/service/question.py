"""The question of the preload left in a nut."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.service.options import ReadingOptions, ServiceOptions
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import (
    CASE_OF_LOGS,
    Answer,
    Done,
    Endpoint,
    File,
    Question,
    Request,
    Sent,
    Work,
)


def _prepare(request: Request) -> Work:
    from ballscrew.questions.service import compute
    from ballscrew.questions.service.answer import document
    from ballscrew.questions.service.reading import check_question, reading
    from ballscrew.questions.service.sheet import sheet

    logs = request.files["logs"]
    check_question(logs, request.case is not None, request.written)
    case = request.load()
    has_torque = request.written["torque"] is not None
    torque = reading(request.written) if has_torque else None
    options = ServiceOptions() if has_torque else request.options(ServiceOptions)

    def answer(done: Done) -> Answer:
        report = compute.of_logs(case, logs, options, done) if torque is None else compute.of_torque(case, torque)
        return Answer(sheet(case, report), lambda: document(case, report), f"{len(report.estimates)} preloads")

    return Work(answer, "service")


def _response() -> Any:
    from ballscrew.questions.service.answer import ServiceResults
    from ballscrew.questions.shared.answer_parts import OfLogs
    from ballscrew.questions.shared.declared import response

    return response(ServiceResults, "Service", beside=OfLogs)


SERVICE = Question(
    name="service",
    help="""Preload left in a nut, by logs or a drag torque.

    From a log when new and one when worn, from one log against the case, or from one drag torque.

    The answer has its interval and its probability. What else could have changed the torque is fitted, too: boundary
    friction, the oil, the seals.
    """,
    reads=(
        File(
            "logs",
            "Log of the new screw and of the worn one; of one alone, against the case.",
            metavar="[NEW] WORN",
            is_optional=True,
            is_repeated=True,
        ),
        CASE_OF_LOGS,
    ),
    options=(ReadingOptions, ServiceOptions),
    case_texts={"settings": 'Change a value: --set nut.preload="4 kN ± 10 %".'},
    files=Option("Draw both logs and both preloads: .png, .svg or .pdf.", flag="picture", metavar="FILE"),
    prepare=_prepare,
    endpoint=Endpoint(
        response=_response,
        options=(ServiceOptions,),
        files=(Sent("new", "logs", is_optional=True), Sent("worn", "logs")),
    ),
)
