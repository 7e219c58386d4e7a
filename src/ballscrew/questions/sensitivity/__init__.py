"""The inputs that a result varies with, and by how much."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Question


@dataclasses.dataclass(frozen=True, kw_only=True)
class SensitivityOptions:
    """Options of a sensitivity analysis."""

    output: Annotated[str, Option("Result, for example efficiency.", metavar="NAME")] = "screw_torque"
    method: Annotated[
        str,
        Option("sobol: shares of the variance; morris: screening of many inputs; local: derivatives.", metavar="NAME"),
    ] = "sobol"
    samples: Annotated[int | None, Option("A power of two (sobol), or trajectories (morris).", metavar="N")] = None
    seed: Annotated[int, Option("Seed: the same one gives the same numbers.", metavar="N")] = 0
    only_given: Annotated[
        bool, Option("Only inputs that the case file gives a distribution, and none of the usual ones.")
    ] = False


SENSITIVITY = Question(
    module="ballscrew.questions.sensitivity.answer",
    name="sensitivity",
    help="""Share of each uncertain input in a band. The output also says what to measure to halve the band.

    Uncertain inputs are those that the case file gives a distribution, such as "0.54 ± 0.01", and those that are
    rarely known, with a usual one. Laws are not varied here.
    """,
    options=(SensitivityOptions,),
    case_texts={"settings": 'Change a value: --set screw.lead="10 mm ± 0.02 mm".'},
    files=Option("Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg).", short="-o", metavar="FILE"),
)
