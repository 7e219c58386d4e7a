"""The results of a ripple, declared once: JSON and units follow from the annotations."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, NamedTuple

from ballscrew.basis.quantities import Info, Length, Ratio, Torque, Unit, quantities_of
from ballscrew.physics.moving_balls.ripple import NamedOrder, Ripple
from ballscrew.questions.ripple.compute import RippleReport, relative

_KNOWN = quantities_of(Ripple)
_OF_ORDER = quantities_of(NamedOrder)
_RELATIVE = Info("M_pp/M_m", "greatest less least friction torque, over the mean")


class OrderResult(NamedTuple):
    """An order of the torque that has a cause."""

    #: The cause of the order.
    name: str
    order: Annotated[Ratio, _OF_ORDER["order"].info]
    amplitude: Annotated[Torque, _OF_ORDER["amplitude"].info]


class FaultResult(NamedTuple):
    """The torque with a fault."""

    #: The fault as it was written.
    fault: str
    mean: Annotated[Torque, _KNOWN["mean"].info]
    peak_to_peak: Annotated[Torque, _KNOWN["peak_to_peak"].info]
    deviation: Annotated[Torque, _KNOWN["deviation"].info]
    relative: Annotated[Ratio, _RELATIVE]
    share: Annotated[Ratio, _KNOWN["share"].info]
    #: The same orders.
    orders: Sequence[OrderResult]


class RangeResult(NamedTuple):
    """The peak to peak of several nuts."""

    #: The number of nuts.
    nuts: int
    low: Annotated[Torque, Info("M_10", "peak to peak that one nut in ten is below")]
    median: Annotated[Torque, Info("M_50", "median of the peaks to peaks")]
    high: Annotated[Torque, Info("M_90", "peak to peak that one nut in ten is above")]


class CurveResult(NamedTuple):
    """A curve of the torque."""

    #: Turns of the screw, or orders.
    x: Annotated[Sequence[float], Unit("1")]
    #: The friction torque, or its amplitude.
    y: Annotated[Sequence[float], Unit("N m")]


class RippleResults(NamedTuple):
    """The friction torque of the balls of a nut over the angle of the screw."""

    mean: Annotated[Torque, _KNOWN["mean"].info]
    peak_to_peak: Annotated[Torque, _KNOWN["peak_to_peak"].info]
    deviation: Annotated[Torque, _KNOWN["deviation"].info]
    relative: Annotated[Ratio, _RELATIVE]
    parts: Annotated[Mapping[str, float], Unit("N m"), Info("", "mean torques by cause")]
    displacement: Annotated[Length, _KNOWN["displacement"].info]
    share: Annotated[Ratio, _KNOWN["share"].info]
    #: The orders that have a cause.
    orders: Sequence[OrderResult]
    #: The peak to peak of several nuts, where they are asked for.
    range: RangeResult | None
    #: The torque with each fault that is asked for.
    faults: Sequence[FaultResult]
    #: Torque over the turns of the screw.
    torque: CurveResult
    #: Amplitude of the torque over the order.
    spectrum: CurveResult


def results(report: RippleReport) -> RippleResults:
    """The results of a ripple."""
    found, several = report.ripple, report.range
    turns = found.angle / (2 * math.pi)
    orders, amplitudes = found.spectrum
    return RippleResults(
        mean=found.mean,
        peak_to_peak=found.peak_to_peak,
        deviation=found.deviation,
        relative=relative(found),
        parts=found.parts,
        displacement=found.displacement,
        share=found.share,
        orders=_orders(found),
        range=None if several is None else RangeResult(*several),
        faults=[
            FaultResult(name, one.mean, one.peak_to_peak, one.deviation, relative(one), one.share, _orders(one))
            for name, one in report.faults.items()
        ],
        torque=CurveResult(turns.tolist(), found.torque.tolist()),
        spectrum=CurveResult(orders.tolist(), amplitudes.tolist()),
    )


def _orders(found: Ripple) -> Sequence[OrderResult]:
    return [OrderResult(one.name, float(one.order), float(one.amplitude)) for one in found.orders]
