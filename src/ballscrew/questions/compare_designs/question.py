"""The question of models and laws side by side, or of several designs."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import SELF_HEATING, Answer, Done, Endpoint, File, Question, Request, Work

_OWN = Option("Of several designs: each at its own load and speed, not at those of the first.")


@dataclasses.dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """What is asked of a comparison."""

    self_heating: Annotated[bool, SELF_HEATING] = False
    own: Annotated[bool, _OWN] = False


def _prepare(request: Request) -> Work:
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.compare_designs.answer import is_one_case

    options = request.options(CompareOptions)
    paths = request.files["cases"]
    is_one = not paths or is_one_case(paths)
    if is_one and options.own:
        raise InputError(Fault("--own", "is for several designs", "", "name several case files, or a project"))
    if not is_one and options.self_heating:
        raise InputError(Fault("--self-heating", "is for one case", "", "compare one design alone"))
    return _models(request, options) if is_one else _designs(request, options)


def _models(request: Request, options: CompareOptions) -> Work:
    """The comparison of models and laws on one case."""
    from ballscrew.questions.compare.compute import comparison, document
    from ballscrew.questions.compare.sheet import sheet
    from ballscrew.questions.warm_up.self_heating_document import with_self_heating

    case = request.load()

    def answer(done: Done) -> Answer:
        heating = None
        if options.self_heating:
            from ballscrew.questions.warm_up.self_heating import self_heating

            heating = self_heating(case)
        warm = case if heating is None else heating.warm
        compared = comparison(warm, done)
        return Answer(
            sheet(warm, compared, () if heating is None else heating.records),
            lambda: with_self_heating(document(warm, compared), heating),
            f"{len(compared.rows)} models and laws",
        )

    return Work(answer)


def _designs(request: Request, options: CompareOptions) -> Work:
    """The comparison of several designs."""
    from ballscrew.questions.compare_designs.answer import document, sheet, side_by_side

    def answer(_: object) -> Answer:
        designs = side_by_side(request.files["cases"], own=options.own, **vars(request.case_options))
        return Answer(sheet(designs), lambda: document(designs), f"{len(designs.designs)} designs")

    return Work(answer)


def _response() -> Any:
    from ballscrew.questions.compare.response import Compare

    return Compare


COMPARE = Question(
    name="compare",
    help="""Models and laws side by side, or several designs.

    Of several case files, or of a project file, each design is run and checked, and changes are against the first;
    project.toml#name is one design of it, as for all commands. Of one case it is as follows.

    First the models as they are, then the model of the case with one law at a time in place of its
    own: torque, its parts, efficiency in both directions, and what lies outside its validity. With
    --self-heating all at the oil and preload in which the model of the case ends.
    """,
    reads=(
        File(
            "cases",
            "Case file (TOML); or several, or a project, for designs side by side.",
            metavar="CASE...",
            is_case=True,
            is_repeated=True,
        ),
    ),
    options=(CompareOptions,),
    files=Option("Also write a table (.csv, .xlsx) or a picture (.png, .svg, .pdf).", short="-o", metavar="FILE"),
    has_options_last=True,
    prepare=_prepare,
    endpoint=Endpoint(response=_response, options=()),
)
