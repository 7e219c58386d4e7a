"""The state of a nut over time, from a table of tests."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
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
class ConditionOptions:
    """Options of a condition; numbers in SI."""

    #: That of the case is of another motion.
    speed: Annotated[
        float | None,
        Option(
            'Screw speed of the tests of a table without speeds: "100 rpm".',
            metavar="VALUE",
            unit="rad/s",
            shown_in="rpm",
            above=0,
            hint="check the number and its unit",
        ),
    ] = None
    reference_temperature: Annotated[
        float | None,
        Option(
            'Temperature to reduce the torques to: "20 degC"; else the first.',
            metavar="VALUE",
            flag="at",
            unit="K",
            shown_in="degC",
        ),
    ] = None
    baseline: Annotated[int, Option("Number of first tests that count as healthy.", metavar="TESTS")] = 5
    tolerance: Annotated[float, Option("Share of the preload that may be lost.", metavar="SHARE")] = 0.1
    false_alarms: Annotated[float, Option("Share of healthy tests that may give an alarm.", metavar="SHARE")] = 0.002
    kind: TorqueKind = "unknown"
    columns: Annotated[Mapping[str, str], headings('Heading of a column: torque="M_R [N m]".')] = dataclasses.field(
        default_factory=dict[str, str]
    )
    torque_constant: TorqueConstant = None
    inertia: Inertia = None
    keep_going: KeepGoing = False


#: Logs of one condition; more tests stand in a table.
MOST_LOGS = 100


CONDITION = Question(
    module="ballscrew.questions.condition.answer",
    name="condition",
    help="""Preload of a nut over time, with trend and alarm. From torques that were logged test by test.

    All torques are reduced to one temperature by the model; without logged temperatures the intervals are wide, and the
    output says so first.
    """,
    reads=(
        File(
            "tests",
            "A table with a row for each test (date, torque, temperature), or the logs of the tests in order.",
            metavar="TABLE | LOG1 LOG2 …",
            is_optional=True,
            is_repeated=True,
        ),
        CASE_OF_LOGS,
    ),
    options=(ConditionOptions,),
    case_texts={"settings": 'Change a value: --set nut.preload="4 kN ± 10 %".'},
    files=Option("Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg).", metavar="FILE"),
    endpoint=Endpoint(files=(Sent("tests", "tests", most=MOST_LOGS),)),
)
