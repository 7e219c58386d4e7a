"""``ballscrew ripple``: size, orders and faults on the terminal."""

from __future__ import annotations

import math

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.physics.moving_balls.ripple import NamedOrder, Ripple
from ballscrew.questions.ripple.compute import RippleReport, relative

_KNOWN = quantities_of(Ripple)
_AMPLITUDE = quantities_of(NamedOrder)["amplitude"]


def text(report: RippleReport) -> str:
    """A ripple in full."""
    lines = [
        title(report),
        "",
        descriptions.design(report.case, plain_text=True),
        "",
        *_sizes(report),
        "",
        *_orders(report),
        "",
        *(record.text for record in report.verdicts),
        *(f"beware  {record.name}: {record.text}" for record in report.case.implausible()),
        "",
        "assumed",
        *(f"  {units.filled(line)}" for line in report.assumed),
    ]
    return "\n".join(line if "\n" in line else wrapped(line) for line in lines)


def title(report: RippleReport) -> str:
    """``torque over the angle: double nut, preload 3500 N``."""
    return f"torque over the angle: {descriptions.nut_text(report.case.screw.nut)}"


def _sizes(report: RippleReport) -> list[str]:
    """Mean and range of the torque, as the nut is and with each fault."""
    rows = [["", "mean", "peak to peak", "over mean", "standard deviation", "force between balls"]]
    for name, found in (("as it is", report.ripple), *report.faults.items()):
        torques = (units.shown(getattr(found, each), _KNOWN[each], 3) for each in ("mean", "peak_to_peak"))
        deviation = units.shown(found.deviation, _KNOWN["deviation"], 3)
        rows.append([name, *torques, f"{relative(found):.1%}", deviation, f"{found.share:.2g} of the load"])
    lines = aligned(rows)
    if report.range is not None:
        low, median, high = (units.shown(end, _KNOWN["peak_to_peak"], 3) for end in report.range[1:])
        lines.append(f"{report.range.nuts} nuts: peak to peak {median}, eight in ten {low} to {high}")
    if math.isfinite(report.ripple.displacement):
        moved = units.shown(report.ripple.displacement, _KNOWN["displacement"], 2)
        lines.append(f"nut against screw moves by {moved} along the axis at constant load")
    return lines


def _orders(report: RippleReport) -> list[str]:
    """The orders with their causes, as the nut is and with each fault."""
    rows = [["per turn", "cause", "amplitude", *report.faults]]
    for i, one in enumerate(report.ripple.orders):
        others = (float(found.orders[i].amplitude) for found in report.faults.values())
        amplitudes = (units.shown(each, _AMPLITUDE, 2) for each in (float(one.amplitude), *others))
        rows.append([f"{one.order:.4g}", one.name, *amplitudes])
    return aligned(rows)
