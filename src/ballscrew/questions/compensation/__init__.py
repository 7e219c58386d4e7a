"""The error of position by heat, as a table for controls."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Literal

from ballscrew.questions.shared.options import Option

#: Distance of the points of a list, m.
STEP = 0.02


@dataclasses.dataclass(frozen=True, kw_only=True)
class CompensationOptions:
    """Options of a compensation; lengths in m."""

    hours: Annotated[float, Option("Hours of work.", metavar="H")] = 4.0
    axis: Annotated[str, Option("Name of the axis in the control.", metavar="NAME")] = "X1"
    zero: Annotated[
        float,
        Option(
            "Zero of the axis, from the fixed bearing; 0 mm if left out.", metavar="LENGTH", unit="m", shown_in="mm"
        ),
    ] = 0.0
    direction: Annotated[
        Literal["away", "towards"] | None,
        Option(
            "Positions of the axis grow away from the fixed bearing, or towards it; away if left out.",
            metavar="away|towards",
        ),
    ] = None
    step: Annotated[
        float, Option("Distance of the points; 20 mm if left out.", metavar="LENGTH", unit="m", shown_in="mm")
    ] = STEP
    reference: Annotated[
        float | None,
        Option("Position of the axis where nothing is compensated.", metavar="LENGTH", unit="m", shown_in="mm"),
    ] = None
