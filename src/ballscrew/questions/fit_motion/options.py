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
    seed: Annotated[int, Option("Seed of the choice of held-out operating points.", metavar="N")] = 0
    keep_going: KeepGoing = False
