"""The band of a result from the uncertainty of inputs and laws, with the share of each input."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Level, OnlyGiven, number_of_samples


@dataclasses.dataclass(frozen=True, kw_only=True)
class BandOptions:
    """Options of a band; None stands for what is usual."""

    samples: Annotated[int | None, number_of_samples("samples, 16384; where balls differ 1024")] = None
    level: Level = None
    only_given: OnlyGiven = False
