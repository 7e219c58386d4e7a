"""Stiffness, lost motion, critical speed and buckling of an axis over its stroke."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Question


@dataclasses.dataclass(frozen=True, kw_only=True)
class AxisOptions:
    """Options of an axis: places of its nut, m."""

    at: Annotated[
        Sequence[float],
        Option(
            'Place of the nut from the fixed bearing, "300 mm"; may be repeated.',
            metavar="PLACE",
            unit="m",
            shown_in="mm",
        ),
    ] = ()


AXIS = Question(
    module="ballscrew.questions.axis.answer",
    name="axis",
    help="""Rigidity, lost motion and critical speed of an axis.

    The output has the buckling load, too, at places of the nut over the stroke.

    Nut, shaft, bearings, mount and the twist of the shaft, one behind the other. The case has an [installation]; with
    [axis] and [motion] the travel, the largest load and the largest speed are theirs, or else of [operation].
    """,
    options=(AxisOptions,),
    case_texts={"settings": 'Change a value: --set installation.ends="fixed-fixed".', "calibration": None},
    files=Option("Also write a table (.csv, .xlsx) or a picture; may be repeated.", short="-o", metavar="FILE"),
    has_several_files=True,
)
