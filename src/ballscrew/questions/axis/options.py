"""The options of the stiffness of an axis."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class AxisOptions:
    """What is asked of an axis: places of its nut, m."""

    at: Annotated[
        Sequence[float],
        Option(
            'Place of the nut from the fixed bearing, "300 mm"; may be repeated.',
            metavar="PLACE",
            unit="m",
            shown_in="mm",
        ),
    ] = ()
