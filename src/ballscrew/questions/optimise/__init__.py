"""Optimisation: free geometries within what is made, searched for a need by several objectives at once."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.select import Objectives
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import NEED, Endpoint, Question


@dataclasses.dataclass(frozen=True, kw_only=True)
class OptimiseOptions:
    """Options of an optimisation; None stands for what the table ``[optimise]`` says, or what is usual."""

    #: Empty for those of the need.
    objectives: Objectives = ()
    quantile: Annotated[
        float | None, Option("Objectives at this quantile of the uncertain inputs: 0.9.", metavar="SHARE")
    ] = None
    population: Annotated[int | None, Option("Designs of a generation; 200 if left out.", metavar="N")] = None
    generations: Annotated[int | None, Option("Generations with rigid bodies; 60 if left out.", metavar="N")] = None
    members: Annotated[int | None, Option("Members shown, in full; 24 if left out.", metavar="N")] = None
    seed: Annotated[int | None, Option("Seed of the search; 0 if left out.", metavar="N")] = None


OPTIMISE = Question(
    module="ballscrew.questions.optimise.answer",
    name="optimise",
    help="""Pareto front of screw geometries for a need. They are free within what makers produce.

    The need is that of ballscrew select; its table [optimise] has bounds and objectives. Each member is evaluated by
    the full model and all checks. Needs the extra optimise.
    """,
    reads=(NEED,),
    options=(OptimiseOptions,),
    case_texts={"settings": "Change a value: --set optimise.nut=single."},
    files=Option(
        "Also write a table (.csv, .xlsx) or a picture (.png, .svg, .pdf); may be repeated.", short="-o", metavar="FILE"
    ),
    has_several_files=True,
    endpoint=Endpoint(plan="Designs of an optimisation, and about its time."),
)
