"""The question of the stiffness of an axis."""

from __future__ import annotations

from ballscrew.questions.axis.options import AxisOptions
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Question, Request, Work


def _prepare(request: Request) -> Work:
    from ballscrew.questions.axis import compute
    from ballscrew.questions.axis.answer import document
    from ballscrew.questions.axis.sheet import sheet

    options = request.options(AxisOptions)
    case_options = request.case_options
    case = compute.load(
        request.case_file, case_options.settings, case_options.model, allow_code=case_options.allow_code
    )

    def answer(_: object) -> Answer:
        report = compute.chain_of(case, options.at)
        return Answer(sheet(report), lambda: document(report), f"{len(report.chain.position)} places")

    return Work(answer)


QUESTION = Question(
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
)
