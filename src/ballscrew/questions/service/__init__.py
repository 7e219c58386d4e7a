"""The preload that is left, from logs of two dates."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Inertia, KeepGoing, Option, TorqueConstant, TorqueKind, headings
from ballscrew.questions.shared.question import (
    CASE_OF_LOGS,
    Endpoint,
    File,
    Question,
    Sent,
)


@dataclasses.dataclass(frozen=True, kw_only=True)
class ServiceOptions:
    """Options of a service by logs; numbers in SI."""

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


SERVICE = Question(
    module="ballscrew.questions.service.answer",
    name="service",
    help="""Preload left in a nut, by logs or a drag torque.

    From a log when new and one when worn, from one log against the case, or from one drag torque.

    The answer has its interval and its probability. What else could have changed the torque is fitted, too: boundary
    friction, the oil, the seals.
    """,
    reads=(
        File(
            "logs",
            "Log of the new screw and of the worn one; of one alone, against the case.",
            metavar="[NEW] WORN",
            is_optional=True,
            is_repeated=True,
        ),
        CASE_OF_LOGS,
    ),
    options=(ReadingOptions, ServiceOptions),
    case_texts={"settings": 'Change a value: --set nut.preload="4 kN ± 10 %".'},
    files=Option("Draw both logs and both preloads: .png, .svg or .pdf.", flag="picture", metavar="FILE"),
    endpoint=Endpoint(
        options=(ServiceOptions,),
        files=(Sent("new", "logs", is_optional=True), Sent("worn", "logs")),
    ),
)
