"""Selection: screws of catalogues against a need, each judged by the full model and all checks, and ranked."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.options import KeepGoing, Option
from ballscrew.questions.shared.question import NEED, Endpoint, Question, Sent

Objectives = Annotated[
    Sequence[str],
    Option(
        "Objectives to compare; the first ranks: loss, inertia, reflected_mass, life, rigidity, drive_torque, …",
        metavar="NAMES",
    ),
]


@dataclasses.dataclass(frozen=True, kw_only=True)
class SelectOptions:
    """Options of a selection beside the need."""

    words: Annotated[
        str, Option('Only rows with these sizes and words: "rexroth 40x".', metavar="WORDS", flag="filter")
    ] = ""
    complete: Annotated[bool, Option("The full model also for candidates that their loads alone rule out.")] = False


@dataclasses.dataclass(frozen=True, kw_only=True)
class ListOptions:
    """Ranking of the candidates, and which of them are listed."""

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


#: The kind of a case file.
CASE_FILE = ".toml"


@dataclasses.dataclass(frozen=True, kw_only=True)
class TableOptions:
    """A table of screws."""

    rows: Annotated[
        str | None,
        Option("A table of screws of your own, .csv or .xlsx, in place of the catalogue.", metavar="FILE"),
    ] = None
    keep_going: KeepGoing = False


SELECT = Question(
    module="ballscrew.questions.select.answer",
    name="select",
    help="""Rank the screws of the catalogue for a need. Each row counts with its nut, preloads and oils.

    Each candidate is judged by the full model and all checks, but for those that their loads alone rule out. The
    exit code is 0 where none holds, too: the list says what fails, and by how much. With --to FILE.toml the case of one
    candidate is written, with all tables of the need, for duty, axis, warm-up, run and report.
    """,
    reads=(NEED,),
    options=(SelectOptions, ListOptions, TableOptions),
    case_texts={"settings": 'Change a value: --set need.feed="20 m/min".'},
    files=Option(
        "Also write a table (.csv, .xlsx), a picture (.png, .svg, .pdf) or a candidate's case (.toml); may be "
        "repeated.",
        short="-o",
        metavar="FILE",
    ),
    has_several_files=True,
    own_kinds=(CASE_FILE,),
    endpoint=Endpoint(
        options=(SelectOptions,),
        files=(Sent("table", "rows", is_optional=True),),
        written={"keep_going": True},
        plan="Candidates and time of a selection, and the inputs without which checks are not judged.",
    ),
)
