"""The options of a report."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class ReportOptions:
    """Options of a report: samples of its band, and what stands below its title."""

    samples: Annotated[int | None, Option("Of the band: 16384; where balls differ 1024.", metavar="N")] = None
    project: Annotated[str, Option("Stands below the title.", metavar="NAME")] = ""
    date: Annotated[str, Option("Such as 2026-11-23, or today; none by itself.", metavar="DATE")] = ""
