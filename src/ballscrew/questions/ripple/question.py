"""The question of the friction torque over the angle of the screw."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.ripple.options import RippleOptions
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Done, Endpoint, Question, Request, Work


def _prepare(request: Request) -> Work:
    from ballscrew.questions.ripple.answer import document, ripple_of, sheet

    options, case = request.options(RippleOptions), request.load()

    def answer(done: Done) -> Answer:
        report = ripple_of(case, options, done)
        return Answer(sheet(report), lambda: document(report), f"{len(report.ripple.angle)} angles")

    return Work(answer, "ripple")


def _response() -> Any:
    from ballscrew.questions.ripple.answer import RippleResults
    from ballscrew.questions.shared.answer_parts import Assumed
    from ballscrew.questions.shared.declared import response

    return response(RippleResults, "Ripple", beside=Assumed)


RIPPLE = Question(
    name="ripple",
    help="""Friction torque over the angle of the screw.

    Peak to peak, orders with their causes, and what faults change.

    The balls of each circuit are followed through grooves that deviate. Torque is a poor sensor of spalls and a good
    one of lost preload and of circuits without room: --fault all has the figures for this nut.
    """,
    options=(RippleOptions,),
    case_texts={"settings": 'Change a value: --set nut.preload="4 kN".'},
    files=Option("Draw torque and orders (.png, .svg, .pdf) or write them (.xlsx, .csv).", metavar="FILE"),
    prepare=_prepare,
    endpoint=Endpoint(response=_response),
)
