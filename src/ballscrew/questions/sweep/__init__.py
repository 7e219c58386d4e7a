"""The results over the axes of a grid, in memory or in files."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.band import BandOptions
from ballscrew.questions.shared.options import Level, OnlyGiven, Option, number_of_samples


@dataclasses.dataclass(frozen=True, kw_only=True)
class SweepOptions:
    """Options of a sweep: axes, outputs, and the ends of their bands."""

    vary: Annotated[
        Sequence[str],
        Option('Axis: axial_load="100:4000:14 N" or "100, 200 N".', metavar="FIELD=VALUES", is_table=True),
    ] = ()
    outputs: Annotated[
        Sequence[str],
        Option("What to return, for example efficiency; may be repeated.", metavar="NAME", flag="output"),
    ] = ()
    band: Annotated[bool, Option("Band of each output: low and high beside it, as of run --band.")] = False
    samples: Annotated[int | None, number_of_samples("samples a point, 16384; where balls differ 1024")] = None
    level: Level = None
    only_given: OnlyGiven = False

    @property
    def is_banded(self) -> bool:
        """True where bands are asked for, by themselves or by one of their options."""
        return self.band or self.of_bands != BandOptions()

    @property
    def of_bands(self) -> BandOptions:
        """The options of the band of each point."""
        return BandOptions(samples=self.samples, level=self.level, only_given=self.only_given)
