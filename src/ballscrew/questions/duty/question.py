"""The question of what a cycle of an axis asks of its motor."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Annotated, Any

from ballscrew.questions.duty.options import DutyOptions
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Done, Endpoint, Question, Request, Sent, Work


@dataclasses.dataclass(frozen=True, kw_only=True)
class TraceOptions:
    """A recorded motion."""

    trace: Annotated[
        str | None,
        Option("A recorded motion in place of [motion]: time, position or speed, force.", metavar="FILE"),
    ] = None


def _prepare(request: Request) -> Work:
    from ballscrew.cases.schema.duty_schema import TRAJECTORY
    from ballscrew.questions.duty import compute
    from ballscrew.questions.duty.answer import document, with_band
    from ballscrew.questions.duty.sheet import sheet

    options, trace = request.options(DutyOptions), request.options(TraceOptions).trace
    assert request.case is not None
    tables = request.case.tables()
    if trace is not None:
        tables["motion"] = {"kind": TRAJECTORY, "file": str(Path(trace).absolute())}
    case = request.case.build(tables, moves=True)

    def answer(done: Done) -> Answer:
        report = compute.duty(case)
        size = f"{len(report.duty.states.time)} states"
        if not options.is_banded:
            return Answer(sheet(report), lambda: document(report), size)
        from ballscrew.questions.duty.band import band  # loads xarray

        bands = band(report, options.samples, only_given=options.only_given, done=done)
        return Answer(sheet(report, bands), lambda: with_band(bands), size)

    return Work(answer, "band" if options.is_banded else "")


def _response() -> Any:
    from ballscrew.questions.duty.compute import DutyReport
    from ballscrew.questions.shared.declared import response

    return response(DutyReport, "Duty", judged=True)


DUTY = Question(
    name="duty",
    help="""Motor torque, energy, brake and life over a cycle.

    The case has an [axis] and a [motion], and perhaps a [motor]; it needs no [operation]. The rule of catalogues
    stands beside the numbers; [model] name = "constant-efficiency" asks for it.
    """,
    options=(TraceOptions, DutyOptions),
    case_texts={"settings": 'Change a value: --set axis.mass="500 kg".'},
    files=Option(
        "Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg); may be repeated.", short="-o", metavar="FILE"
    ),
    has_several_files=True,
    has_options_last=True,
    prepare=_prepare,
    endpoint=Endpoint(response=_response, options=(), files=(Sent("trace", "trace", is_optional=True),)),
)
