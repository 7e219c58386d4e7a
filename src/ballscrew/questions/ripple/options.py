"""The options of a ripple."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class RippleOptions:
    """What is asked of the torque over the angle; numbers in SI.

    What is left out is that of the law ``chain`` of the force between balls, where the case has it.
    """

    fault: Annotated[
        Sequence[str],
        Option(
            'Compute it with a fault, too: missing-ball, full, spall="2 mm x 2 um", preload=0.35, groove=3; repeat, or '
            "all.",
            metavar="FAULT",
        ),
    ] = ()
    gap: Annotated[float | None, Option("Room in each circuit, in balls, else 0.55; assumed.", metavar="BALLS")] = None
    groove_deviation: Annotated[
        float | None,
        Option(
            'Of nut groove against screw groove, root mean square, else "1 um"; assumed.', metavar="LENGTH", unit="m",
            shown_in="um", at_least=0, hint="grooves have 0.5 um to 2 um",
        ),
    ] = None  # fmt: skip
    circuits: Annotated[int | None, Option("Circuits of each half, else one; assumed.", metavar="NUMBER")] = None
    return_balls: Annotated[
        int | None, Option("Balls in the return of each circuit, else half a turn of them.", metavar="NUMBER")
    ] = None
    wall_factor: Annotated[
        float | None, Option("Drag of the oil in the return over that far from walls, else 10.", metavar="FACTOR")
    ] = None
    relief: Annotated[
        float, Option("Length at the ends over which balls take their load, in balls.", metavar="BALLS")
    ] = 1.0
    turns: Annotated[float, Option("Turns of the screw that are looked at, at least.", metavar="TURNS")] = 12.0
    seed: Annotated[int, Option("Of the grooves: one seed gives the same nut.", metavar="NUMBER")] = 1
    seeds: Annotated[int, Option("So many nuts, with seeds from that one on: a band.", metavar="NUMBER")] = 1
