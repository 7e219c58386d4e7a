"""The preload then and now: both logs over the speed with the fitted curves, and both preloads with their intervals."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import model_text, nut_text
from ballscrew.evidence.service.preload_estimate import PreloadEstimate
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.questions.service import text
from ballscrew.questions.service.compute import ServiceReport
from ballscrew.questions.service.document import preload_quantity
from ballscrew.questions.service.points import curves
from ballscrew.questions.shared import charts

#: More points than this are a blot.
MOST_POINTS = 3000
_COLOURS = {"new": charts.BLUE, "worn": charts.ORANGE, "preload": charts.BLUE}


def picture(case: Case, report: ServiceReport) -> Figure:
    """Torque over speed to the left, preloads to the right; call within the house style."""
    figure, (left, right) = charts.new_figure(text.caption(case, report))
    title = f"{', '.join(text.names(report))}: {nut_text(case.screw.nut)}, {model_text(case)}"
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    _torques(left, report)
    _preloads(right, case, report)
    return figure


def _torques(panel: Axes, report: ServiceReport) -> None:
    speed = fields_of(OperatingState)["screw_speed"]
    widest = 0.0
    for label, one in curves(report, MOST_POINTS).items():
        colour = _COLOURS[label]
        panel.plot(units.from_si(one.measured_speed, speed), one.measured, ".", ms=3, alpha=0.5, color=colour)
        panel.plot(units.from_si(one.speed, speed), one.torque, color=colour, label=label)
        widest = max(widest, float(np.quantile(one.measured, 0.99)), float(np.max(one.torque)))
        if one.speed[-1] > 20 * one.speed[0]:
            panel.set_xscale("log")
    if report.reading is not None:
        shown = units.from_si(report.reading.screw_speed, speed)
        panel.plot([shown], [report.reading.torque], "o", color=charts.BLUE, label="measured")
        widest = report.reading.torque
    panel.set(xlabel=f"speed [{speed.shown_in}]", ylabel="friction torque [N m]", title="torque over speed")
    panel.set_ylim(0, 1.15 * widest)
    panel.legend()


def _preloads(panel: Axes, case: Case, report: ServiceReport) -> None:
    quantity = preload_quantity(case)
    labels: list[str] = []
    for place, (label, one) in enumerate(report.estimates.items()):
        labels.append(text.label_of(label, one))
        _bar(panel, place, one, _COLOURS[label], quantity)
    panel.set_yticks(range(len(labels)), labels)
    panel.set_ylim(len(labels) - 0.4, -0.6)
    panel.set_xlim(left=0)
    panel.grid(visible=False, axis="y")
    panel.set_xlabel(f"preload [{quantity.shown_in}]")
    panel.set_title("preload with its 95 % interval")


def _bar(panel: Axes, place: int, one: PreloadEstimate, colour: str, quantity: Quantity) -> None:
    value = float(units.from_si(one.preload, quantity))
    panel.barh(place, value, 0.5, color=colour, alpha=0.6)
    low, high = (float(units.from_si(end, quantity)) for end in one.interval())
    if math.isfinite(high):
        panel.errorbar(value, place, xerr=[[value - low], [high - value]], color=charts.INK, capsize=4, lw=1.4)
