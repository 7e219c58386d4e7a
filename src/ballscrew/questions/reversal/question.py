"""The question of friction after a reversal, and of the models of control engineering fitted to it."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Endpoint, Question, Request, Work


@dataclasses.dataclass(frozen=True, kw_only=True)
class ReversalOptions:
    """What is asked of a reversal; numbers in SI."""

    from_rest: Annotated[bool, Option("Start from rest instead of after motion in the other direction.")] = False
    travel: Annotated[
        float | None,
        Option(
            'How far the nut travels: "1 mm"; as far as the friction needs if left out.',
            metavar="LENGTH",
            unit="m",
            shown_in="mm",
            above=0,
        ),
    ] = None
    inertia: Annotated[
        float | None,
        Option(
            'Inertia of all that turns with the screw: "2e-3 kg m^2"; LuGre has no damping without it.',
            metavar="VALUE",
            unit="kg m^2",
            above=0,
        ),
    ] = None
    gap: Annotated[
        float,
        Option(
            "Balls that would still go into a circuit; they close up before they press again.",
            metavar="BALLS",
            at_least=0,
        ),
    ] = 0.5


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
