"""The options of a sensitivity analysis."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class SensitivityOptions:
    """What is asked of a sensitivity analysis."""

    output: Annotated[str, Option("Of which result, for example efficiency.", metavar="NAME")] = "screw_torque"
    method: Annotated[
        str,
        Option("sobol: shares of the variance; morris: screening of many inputs; local: derivatives.", metavar="NAME"),
    ] = "sobol"
    samples: Annotated[int | None, Option("A power of two (sobol), or trajectories (morris).", metavar="N")] = None
    seed: Annotated[int, Option("The same seed gives the same numbers.", metavar="N")] = 0
    only_given: Annotated[bool, Option("Only what the case file gives a distribution; nothing usual.")] = False
