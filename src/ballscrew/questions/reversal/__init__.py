"""Friction after a reversal or from rest, by mechanism, and the models of control engineering that stand for it."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Question


@dataclasses.dataclass(frozen=True, kw_only=True)
class ReversalOptions:
    """Options of a reversal; numbers in SI."""

    from_rest: Annotated[bool, Option("Start from rest instead of after motion in the other direction.")] = False
    travel: Annotated[
        float | None,
        Option(
            'How far the nut travels: "1 mm"; as far as the friction needs if left out.',
            metavar="LENGTH",
            unit="m",
            shown_in="mm",
            above=0,
        ),
    ] = None
    inertia: Annotated[
        float | None,
        Option(
            'Inertia of all that turns with the screw: "2e-3 kg m^2"; LuGre has no damping without it.',
            metavar="VALUE",
            unit="kg m^2",
            above=0,
        ),
    ] = None
    gap: Annotated[
        float,
        Option(
            "Balls that would still go into a circuit; they close up before they press again.",
            metavar="BALLS",
            at_least=0,
        ),
    ] = 0.5


REVERSAL = Question(
    module="ballscrew.questions.reversal.answer",
    name="reversal",
    help="""Friction after a reversal, and models for controllers. Over the angle of the screw, by mechanism.

    Dahl, LuGre and Maxwell-slip elements (GMS) are fitted, each with its error. That helix slip comes back over degrees
    of the screw is a hypothesis.
    """,
    options=(ReversalOptions,),
    files=Option("Also write a table (.csv, .xlsx) or a picture.", short="-o", metavar="FILE"),
)
