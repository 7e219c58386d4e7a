"""The question of the inputs that a result varies with."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.sensitivity.options import SensitivityOptions
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Done, Endpoint, Question, Request, Work


def _prepare(request: Request) -> Work:
    from ballscrew.questions.sensitivity.answer import document, sensitivity, sheet

    options, case = request.options(SensitivityOptions), request.load()

    def answer(done: Done) -> Answer:
        report = sensitivity(case, options, done)
        return Answer(sheet(case, report), lambda: document(case, report), f"{len(report.result.inputs)} inputs")

    return Work(answer, "sensitivity")


def _response() -> Any:
    from ballscrew.questions.sensitivity.answer import Indices
    from ballscrew.questions.shared.declared import response

    return response(Indices, "Sensitivity", named="sensitivity")


SENSITIVITY = Question(
    name="sensitivity",
    help="""Share of each uncertain input in a band. The output also says what to measure to halve the band.

    Uncertain inputs are those that the case file gives a distribution, such as "0.54 ± 0.01", and those that are
    rarely known, with a usual one. Laws are not varied here.
    """,
    options=(SensitivityOptions,),
    case_texts={"settings": 'Change a value: --set screw.lead="10 mm ± 0.02 mm".'},
    files=Option("Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg).", short="-o", metavar="FILE"),
    prepare=_prepare,
    endpoint=Endpoint(response=_response),
)
