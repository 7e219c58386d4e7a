"""The band of a result: torque over speed or load with its bands, and what they are made of."""

from __future__ import annotations

import math
import textwrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files.case_file import Case
from ballscrew.cases.case_files.descriptions import title
from ballscrew.engine.uncertainty.bands import Band, BandCurve
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.questions.band import text
from ballscrew.questions.band.compute import BandReport
from ballscrew.questions.shared import charts

_TORQUE = "friction torque on the screw (N m)"
#: Inches of a line of the right panel, and of what stands around all.
_LINE, _FRAME = 0.27, 1.3
_BAR, _LABEL_SIZE = 0.6, 8.5
_TITLE_CHARACTERS = 100
#: Both causes, and each alone.
_COLOURS = (charts.SKY, charts.BLUE, charts.ORANGE)


def picture(case: Case, report: BandReport, curve: BandCurve) -> Figure:
    """To the left the torque along a load or a speed, to the right both causes and the laws at the operating point."""
    band = report.band
    lines = 3 + sum(len(laws) for laws in band.alternatives.values())
    height = max(charts.PANEL_HEIGHT, _FRAME + _LINE * lines)
    figure, (left, right) = charts.new_figure(text.caption(case, report, curve), height=height)
    wrapped = "\n".join(textwrap.wrap(title(case), _TITLE_CHARACTERS))
    figure.suptitle(wrapped, x=0.012, ha="left", fontsize=11, fontweight="bold")
    _along(left, curve, fields_of(OperatingState)[curve.along], band)
    _causes(right, band)
    return figure


def _along(panel: Axes, curve: BandCurve, quantity: Quantity, band: Band) -> None:
    x: NDArray[Any] = np.asarray(units.from_si(curve.points, quantity))
    share = f"{100 * band.level:.4g} %"
    panel.fill_between(x, *curve.both, color=charts.SHADE, linewidth=0, label=f"{share}, inputs and laws")
    panel.fill_between(x, *curve.parameters, color=charts.SKY, alpha=0.5, linewidth=0, label=f"{share}, inputs alone")
    panel.plot(x, curve.median, color=charts.INK, label="median")
    panel.plot(x, curve.value, color=charts.BLUE, linestyle="--", label="the case as it is")
    here = len(x) // 2  # the operating point is the middle of the curve
    torque = band["screw_torque"]
    if math.isfinite(torque.median):
        off = np.array([[torque.median - torque.both.low], [torque.both.high - torque.median]])
        panel.errorbar(x[here], torque.median, np.maximum(off, 0), fmt="o", color=charts.RED, capsize=3, label="here")
    panel.set_xlabel(f"{quantity.info.meaning} ({quantity.shown_in})")
    panel.set_ylabel(_TORQUE)
    panel.set_xlim(float(x[0]), float(x[-1]))
    panel.set_ylim(bottom=0)
    panel.set_title(f"over the {quantity.info.meaning}")
    panel.legend(loc="best", fontsize=_LABEL_SIZE)


def _causes(panel: Axes, band: Band) -> None:
    torque = band["screw_torque"]
    labels = list(text.CAUSES)
    for y, (interval, colour) in enumerate(zip(text.intervals(torque), _COLOURS, strict=True)):
        if all(map(math.isfinite, interval)):
            panel.barh(y, interval.high - interval.low, _BAR, left=interval.low, color=colour)
    if math.isfinite(torque.median):
        panel.plot([torque.median] * 2, [-_BAR / 2, _BAR / 2], color=charts.INK, linewidth=1.8)
    for laws in band.alternatives.values():
        for law in laws:
            panel.plot(torque.value * math.exp(law.shift), len(labels), "o", color=charts.ORANGE, markersize=4.5)
            labels.append(f"{law.slot.replace('_', ' ')}: {law.name}")
    if math.isfinite(torque.value):
        panel.axvline(torque.value, color=charts.BLUE, linewidth=1.0, linestyle="--", zorder=1)
    panel.set_yticks(range(len(labels)), labels)
    for tick in panel.get_yticklabels():
        tick.set_fontsize(_LABEL_SIZE)
    panel.set_ylim(len(labels) - 0.4, -0.6)
    panel.use_sticky_edges = False  # a bar does not begin at zero: no axis is to begin at a bar
    panel.margins(x=0.06)
    panel.grid(visible=False, axis="y")
    panel.tick_params(axis="y", length=0)
    panel.set_xlabel(_TORQUE)
    panel.set_title("what makes it, at the operating point")
