"""The options of a service: of logs, and of a torque without load in their place."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated

from ballscrew.questions.shared.log_options import Inertia, KeepGoing, TorqueConstant, TorqueKind, headings
from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class ServiceOptions:
    """What is asked of a service by logs; numbers in SI."""

    tolerance: Annotated[float, Option("Share of the preload that may be lost.", metavar="SHARE")] = 0.1
    free: Annotated[
        Sequence[str], Option("What to fit beside the preload, with commas: constant_torque.", metavar="NAMES")
    ] = ()
    kind: TorqueKind = "unknown"
    columns: Annotated[Mapping[str, str], headings('Heading of a column, in both logs: load="0 N".')] = (
        dataclasses.field(default_factory=dict[str, str])
    )
    torque_constant: TorqueConstant = None
    inertia: Inertia = None
    keep_going: KeepGoing = False


@dataclasses.dataclass(frozen=True, kw_only=True)
class ReadingOptions:
    """A torque without load in place of logs: as text with its interval; speed and temperature in SI."""

    torque: Annotated[
        str | None, Option('In place of logs: drag torque with seals, "0.40 ± 0.02 N m".', metavar="VALUE")
    ] = None
    speed: Annotated[
        float | None,
        Option(
            'Screw speed at which that torque was measured: "100 rpm".', metavar="VALUE", unit="rad/s", shown_in="rpm"
        ),
    ] = None
    temperature: Annotated[
        float | None, Option('Temperature of the nut meanwhile: "35 degC".', metavar="VALUE", unit="K", shown_in="degC")
    ] = None
