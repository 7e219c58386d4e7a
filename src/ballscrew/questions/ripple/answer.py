"""The results of a ripple, declared once: JSON and units follow from the annotations."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

from ballscrew.basis.quantities import Info, Unit
from ballscrew.physics.moving_balls.ripple import Ripple
from ballscrew.questions.ripple.compute import Range, RippleReport
from ballscrew.questions.shared.declared import from_attributes, parts_like
from ballscrew.questions.shared.envelope import envelope


@dataclasses.dataclass(frozen=True)
class Fault:
    """A fault that is asked for."""

    #: The fault as it was written.
    fault: str


@dataclasses.dataclass(frozen=True, eq=False)
class FaultResult(
    parts_like(Ripple, "mean", "peak_to_peak", "deviation", "relative", "share", "orders"),
    Fault,
):
    """The torque with a fault."""


class CurveResult(NamedTuple):
    """A curve of the torque."""

    #: Turns of the screw, or orders.
    x: Annotated[Sequence[float], Unit("1")]
    #: The friction torque, or its amplitude.
    y: Annotated[Sequence[float], Unit("N m")]


@dataclasses.dataclass(frozen=True, eq=False)
class RippleResults(
    parts_like(Ripple, "mean", "peak_to_peak", "deviation", "relative", "parts", "displacement", "share", "orders")
):
    """The friction torque of the balls of a nut over the angle of the screw."""

    parts: Annotated[Mapping[str, float], Unit("N m"), Info("", "mean torques by cause")]
    #: The peak to peak of several nuts, where they are asked for.
    range: Range | None
    #: The torque with each fault that is asked for.
    faults: Sequence[FaultResult]
    #: Torque over the turns of the screw.
    torque: CurveResult
    #: Amplitude of the torque over the order.
    spectrum: CurveResult


def document(report: RippleReport) -> dict[str, Any]:
    """Inputs, torque over the angle, orders, faults, verdicts and provenance."""
    ripple = report.ripple
    results = from_attributes(
        RippleResults,
        ripple,
        range=report.range,
        faults=[from_attributes(FaultResult, ripple, fault=name) for name, ripple in report.faults.items()],
        torque=CurveResult((ripple.angle / (2 * math.pi)).tolist(), ripple.torque.tolist()),
        spectrum=CurveResult(*(values.tolist() for values in ripple.spectrum)),
    )
    return envelope(
        report.case,
        results,
        assumed=report.assumed,
        warnings=report.case.implausible(),
        verdicts=report.verdicts,
    )
