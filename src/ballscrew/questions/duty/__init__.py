"""The duty of an axis: torque of the motor, energy and life over a cycle."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import OnlyGiven, Option, number_of_samples
from ballscrew.questions.shared.question import Endpoint, Question, Sent


@dataclasses.dataclass(frozen=True, kw_only=True)
class DutyOptions:
    """Options of a duty: a band of its torques and energies."""

    band: Annotated[bool, Option("Band of torques and energies, by uncertain inputs.")] = False
    samples: Annotated[int | None, number_of_samples("samples, 1024")] = None
    only_given: OnlyGiven = False

    @property
    def is_banded(self) -> bool:
        """True where a band is asked for, by itself or by one of its options."""
        return self.band or self.only_given or self.samples is not None


@dataclasses.dataclass(frozen=True, kw_only=True)
class TraceOptions:
    """A recorded motion."""

    trace: Annotated[
        str | None,
        Option("A recorded motion in place of [motion]: time, position or speed, force.", metavar="FILE"),
    ] = None


DUTY = Question(
    module="ballscrew.questions.duty.answer",
    name="duty",
    help="""Motor torque, energy, brake and life over a cycle.

    The case has an [axis] and a [motion], and perhaps a [motor]; it needs no [operation]. The rule of catalogues
    stands beside the numbers; [model] name = "constant-efficiency" asks for it.
    """,
    options=(TraceOptions, DutyOptions),
    case_texts={"settings": 'Change a value: --set axis.mass="500 kg".'},
    files=Option(
        "Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg); may be repeated.", short="-o", metavar="FILE"
    ),
    has_several_files=True,
    has_options_last=True,
    endpoint=Endpoint(options=(), files=(Sent("trace", "trace", is_optional=True),)),
)
