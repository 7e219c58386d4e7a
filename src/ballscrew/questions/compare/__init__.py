"""The torque by several models, laws and rules of one line; or several designs side by side."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import SELF_HEATING, Endpoint, File, Question

_OWN = Option("Of several designs: each at its own load and speed, not at those of the first.")


@dataclasses.dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """Options of a comparison."""

    self_heating: Annotated[bool, SELF_HEATING] = False
    own: Annotated[bool, _OWN] = False


COMPARE = Question(
    module="ballscrew.questions.compare.answer",
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
    endpoint=Endpoint(options=()),
)
