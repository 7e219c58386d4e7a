"""The question of the stiffness of an axis."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.axis.options import AxisOptions
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Endpoint, Question, Request, Work


def _prepare(request: Request) -> Work:
    from ballscrew.questions.axis.answer import chain_of, document, moves, sheet

    options, case = request.options(AxisOptions), request.load(moves)

    def answer(_: object) -> Answer:
        report = chain_of(case, options.at)
        return Answer(sheet(report), lambda: document(report), f"{len(report.chain.position)} places")

    return Work(answer)


def _response() -> Any:
    from ballscrew.questions.axis.answer import ChainResults
    from ballscrew.questions.shared.answer_parts import Assumed
    from ballscrew.questions.shared.declared import response

    return response(ChainResults, "Chain", beside=Assumed)


AXIS = Question(
    name="axis",
    help="""Rigidity, lost motion and critical speed of an axis.

    The output has the buckling load, too, at places of the nut over the stroke.

    Nut, shaft, bearings, mount and the twist of the shaft, one behind the other. The case has an [installation]; with
    [axis] and [motion] the travel, the largest load and the largest speed are theirs, or else of [operation].
    """,
    options=(AxisOptions,),
    case_texts={"settings": 'Change a value: --set installation.ends="fixed-fixed".', "calibration": None},
    files=Option("Also write a table (.csv, .xlsx) or a picture; may be repeated.", short="-o", metavar="FILE"),
    has_several_files=True,
    prepare=_prepare,
    endpoint=Endpoint(response=_response),
)
