"""The torque over the angle of the screw, and its orders, with faults beside it."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from ballscrew.questions.ripple import text
from ballscrew.questions.ripple.compute import RippleReport
from ballscrew.questions.shared import charts

#: Orders and turns that are drawn.
MOST_ORDER, TURNS = 24.0, 6.0
#: Amplitudes below this share of the greatest one are not drawn.
FLOOR = 1e-4


def picture(report: RippleReport) -> Figure:
    """Torque and spectrum; call within the house style."""
    figure, (over_angle, over_order) = charts.new_figure(caption(report))
    figure.suptitle(text.title(report), x=0.012, ha="left", fontsize=11, fontweight="bold")
    colours = (charts.BLUE, charts.ORANGE, charts.GREEN, charts.PURPLE, charts.RED, charts.GREY)
    for i, (name, found) in enumerate((("as it is", report.ripple), *report.faults.items())):
        colour = colours[i % len(colours)]
        turns = found.angle / (2 * math.pi)
        over_angle.plot(turns[turns <= TURNS], found.torque[turns <= TURNS], color=colour, lw=0.9, label=name)
        orders, amplitudes = found.spectrum
        shown = (orders > 0) & (orders <= MOST_ORDER)
        over_order.plot(orders[shown], 1e3 * amplitudes[shown], color=colour, lw=0.9, label=name)
    over_angle.set(xlabel="turns of the screw", ylabel="friction torque [N m]", title="torque of the balls")
    highest = max(float(np.max(found.torque)) for found in (report.ripple, *report.faults.values()))
    over_angle.set_ylim(0, 1.5 * highest)  # room for the legend above the curves
    over_angle.legend(loc="upper right", ncols=2)
    for one in report.ripple.orders:
        over_order.axvline(float(one.order), color=charts.GREY, lw=0.5, ls=":")
    top = max(float(np.max(found.spectrum[1])) for found in (report.ripple, *report.faults.values()))
    over_order.set_ylim(1e3 * FLOOR * top, 3e3 * top)
    over_order.set(xlabel="order [1/turn]", ylabel="amplitude [N mm]", title="orders of the torque", yscale="log")
    return figure


def caption(report: RippleReport) -> str:
    """The verdicts, and what the panels show."""
    said = ". ".join(record.text for record in report.verdicts)
    return f"{said}. Dotted: orders that have a cause."
