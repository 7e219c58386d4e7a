"""The question of friction after a reversal, and of the models of control engineering fitted to it."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.reversal.options import ReversalOptions
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Endpoint, Question, Request, Work


def _prepare(request: Request) -> Work:
    from ballscrew.questions.reversal.answer import document, reversal, sheet

    options, case = request.options(ReversalOptions), request.load()

    def answer(_: object) -> Answer:
        report = reversal(case, options)
        return Answer(sheet(report), lambda: document(report), f"{len(report.reversal.screw_angle)} angles")

    return Work(answer, "reversal")


def _response() -> Any:
    from ballscrew.questions.reversal.answer import ReversalResults
    from ballscrew.questions.shared.declared import response

    return response(ReversalResults, "Reversal")


REVERSAL = Question(
    name="reversal",
    help="""Friction after a reversal, and models for controllers. Over the angle of the screw, by mechanism.

    Dahl, LuGre and Maxwell-slip elements (GMS) are fitted, each with its error. That helix slip comes back over degrees
    of the screw is a hypothesis.
    """,
    options=(ReversalOptions,),
    files=Option("Also write a table (.csv, .xlsx) or a picture.", short="-o", metavar="FILE"),
    prepare=_prepare,
    endpoint=Endpoint(response=_response),
)
