"""The options of a fit to a log of a moving axis."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.log_options import Columns, KeepGoing, TorqueConstant
from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class FitMotionOptions:
    """What is asked of a fit to a moving log; numbers in SI."""

    #: Empty for what is usual.
    free: Annotated[Sequence[str], Option("What to fit, with commas.", metavar="NAMES")] = ()
    columns: Columns = dataclasses.field(default_factory=dict[str, str])
    torque_constant: TorqueConstant = None
    gain: Annotated[
        float | None,
        Option(
            'Force for each volt of a control voltage, of a moving log: "35 N/V".', metavar="VALUE", unit="N/V", above=0
        ),
    ] = None
    carried_mass: Annotated[
        float | None,
        Option('Mass that the nut of a moving log carries: "20 kg".', metavar="VALUE", unit="kg", at_least=0),
    ] = None
    axis: Annotated[str, Option('Axis of a log of several: "X1", with which its headings begin.', metavar="NAME")] = ""
    period: Annotated[
        float | None,
        Option('Time between the rows of a log without a time: "0.1 s".', metavar="TIME", unit="s", above=0),
    ] = None
    steady: Annotated[
        bool,
        Option("Friction over speed of rows at constant speed, and no motion; in A without a torque constant."),
    ] = False
    seed: Annotated[int, Option("Seed of the choice of held-out operating points.", metavar="N")] = 0
    keep_going: KeepGoing = False
