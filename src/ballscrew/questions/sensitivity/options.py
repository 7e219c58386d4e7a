"""The options of a sensitivity analysis."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class SensitivityOptions:
    """What is asked of a sensitivity analysis."""

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
