"""The options of an optimisation."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.select.options import Objectives
from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class OptimiseOptions:
    """What is asked of an optimisation; None stands for what the table ``[optimise]`` says, or what is usual."""

    #: Empty for those of the need.
    objectives: Objectives = ()
    quantile: Annotated[
        float | None, Option("Objectives at this quantile of the uncertain inputs: 0.9.", metavar="SHARE")
    ] = None
    population: Annotated[int | None, Option("Designs of a generation; 200 if left out.", metavar="N")] = None
    generations: Annotated[int | None, Option("Generations with rigid bodies; 60 if left out.", metavar="N")] = None
    members: Annotated[int | None, Option("Members shown, in full; 24 if left out.", metavar="N")] = None
    seed: Annotated[int | None, Option("Seed of the search; 0 if left out.", metavar="N")] = None
