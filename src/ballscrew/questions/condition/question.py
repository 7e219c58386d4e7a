"""The question of the state of a nut over time."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.condition.options import ConditionOptions
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

#: Logs of one condition; more tests stand in a table.
MOST_LOGS = 100


def _prepare(request: Request) -> Work:
    from ballscrew.questions.condition.answer import check_kind, document, of_files, sheet

    tests = request.files["tests"]
    _check_files(request)
    check_kind(len(tests), request.written)
    options, case = request.options(ConditionOptions), request.load()

    def answer(done: Done) -> Answer:
        condition = of_files(case, tests, options, done)
        return Answer(sheet(case, condition), lambda: document(case, condition), f"{len(condition.states)} tests")

    return Work(answer, "condition")


def _check_files(request: Request) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a question without case or tests."""
    from ballscrew.basis.errors import Fault, raise_if_any

    faults: list[Fault] = []
    if request.case is None:
        faults.append(Fault("--case", "missing", "", "give the case file of the screw: --case FILE"))
    if not request.files["tests"]:
        faults.append(Fault("TABLE", "missing", "", "give a table with a row for each test, or the logs of the tests"))
    raise_if_any(faults)


def _response() -> Any:
    from ballscrew.questions.condition.answer import ConditionResults
    from ballscrew.questions.shared.answer_parts import OfLogs
    from ballscrew.questions.shared.declared import response

    return response(ConditionResults, "Condition", beside=OfLogs)


CONDITION = Question(
    name="condition",
    help="""Preload of a nut over time, with trend and alarm. From torques that were logged test by test.

    All torques are reduced to one temperature by the model; without logged temperatures the intervals are wide, and the
    output says so first.
    """,
    reads=(
        File(
            "tests",
            "A table with a row for each test (date, torque, temperature), or the logs of the tests in order.",
            metavar="TABLE | LOG1 LOG2 …",
            is_optional=True,
            is_repeated=True,
        ),
        CASE_OF_LOGS,
    ),
    options=(ConditionOptions,),
    case_texts={"settings": 'Change a value: --set nut.preload="4 kN ± 10 %".'},
    files=Option("Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg).", metavar="FILE"),
    prepare=_prepare,
    endpoint=Endpoint(response=_response, files=(Sent("tests", "tests", most=MOST_LOGS),)),
)
