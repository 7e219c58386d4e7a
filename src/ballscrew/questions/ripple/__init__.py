"""The friction torque over the angle of the screw, its orders, and what defects of a nut do to them."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Question


@dataclasses.dataclass(frozen=True, kw_only=True)
class RippleOptions:
    """Options of the torque over the angle; numbers in SI.

    What is left out is that of the law ``chain`` of the force between balls, where the case has it.
    """

    fault: Annotated[
        Sequence[str],
        Option(
            'Also with a fault: missing-ball, full, spall="2 mm x 2 um", preload=0.35, groove=3, or all; '
            "may be repeated.",
            metavar="FAULT",
        ),
    ] = ()
    gap: Annotated[
        float | None, Option("Free room in each circuit, in balls; 0.55 if left out, an assumption.", metavar="BALLS")
    ] = None
    groove_deviation: Annotated[
        float | None,
        Option(
            'Deviation of nut groove against screw groove, root mean square; "1 um" if left out, an assumption.',
            metavar="LENGTH",
            unit="m",
            shown_in="um",
            at_least=0,
            hint="grooves have 0.5 um to 2 um",
        ),
    ] = None
    circuits: Annotated[
        int | None, Option("Circuits of each half; one if left out, an assumption.", metavar="NUMBER")
    ] = None
    return_balls: Annotated[
        int | None, Option("Balls in the return of each circuit; half a turn of them if left out.", metavar="NUMBER")
    ] = None
    wall_factor: Annotated[
        float | None,
        Option("Drag of the oil in the return over that far from walls; 10 if left out.", metavar="FACTOR"),
    ] = None
    relief: Annotated[
        float, Option("Length at the ends over which balls take their load, in balls.", metavar="BALLS")
    ] = 1.0
    turns: Annotated[float, Option("Turns of the screw to compute, at least.", metavar="TURNS")] = 12.0
    seed: Annotated[int, Option("Seed of the grooves: one seed gives the same nut.", metavar="NUMBER")] = 1
    seeds: Annotated[int, Option("Number of nuts, with seeds from --seed on: a band.", metavar="NUMBER")] = 1


RIPPLE = Question(
    module="ballscrew.questions.ripple.answer",
    name="ripple",
    help="""Friction torque over the angle of the screw.

    Peak to peak, orders with their causes, and what faults change.

    The balls of each circuit are followed through grooves that deviate. Torque is a poor sensor of spalls and a good
    one of lost preload and of circuits without room: --fault all has the figures for this nut.
    """,
    options=(RippleOptions,),
    case_texts={"settings": 'Change a value: --set nut.preload="4 kN".'},
    files=Option("Draw torque and orders (.png, .svg, .pdf) or write them (.xlsx, .csv).", metavar="FILE"),
)
