"""The options of a selection."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Option

Objectives = Annotated[
    Sequence[str],
    Option(
        "Objectives to compare; the first ranks: loss, inertia, reflected_mass, life, rigidity, drive_torque, …",
        metavar="NAMES",
    ),
]


@dataclasses.dataclass(frozen=True, kw_only=True)
class SelectOptions:
    """What is asked of a selection beside the need."""

    words: Annotated[
        str, Option('Only rows with these sizes and words: "rexroth 40x".', metavar="WORDS", flag="filter")
    ] = ""
    complete: Annotated[bool, Option("The full model also for candidates that their loads alone rule out.")] = False


@dataclasses.dataclass(frozen=True, kw_only=True)
class ListOptions:
    """How the candidates are ranked, and which of them are listed."""

    #: Empty for those of the need.
    objectives: Objectives = ()
    holds: Annotated[bool, Option("Only candidates without a failed check; some checks may not be judged.")] = False
    front: Annotated[bool, Option("Only members of the Pareto front.")] = False
    first: Annotated[int, Option("Lines shown; 0 for all.", metavar="N", at_least=0)] = 20
    #: None for that of the first one listed.
    rank: Annotated[
        int | None,
        Option(
            "Rank of the candidate whose case --to FILE.toml writes; the first listed if left out.",
            metavar="N",
            at_least=1,
        ),
    ] = None
