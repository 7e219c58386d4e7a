"""The options of a duty."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.log_options import OnlyGiven, number_of_samples
from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class DutyOptions:
    """What is asked of a duty: a band of its torques and energies."""

    band: Annotated[bool, Option("Band of torques and energies, by uncertain inputs.")] = False
    samples: Annotated[int | None, number_of_samples("samples, 1024")] = None
    only_given: OnlyGiven = False

    @property
    def is_banded(self) -> bool:
        """True where a band is asked for, by itself or by one of its options."""
        return self.band or self.only_given or self.samples is not None
