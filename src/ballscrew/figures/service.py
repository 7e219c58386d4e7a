"""The preload then and now: both logs over the speed with the fitted curves, and both preloads with their intervals."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ballscrew import units
from ballscrew.calibration.fit import points_of
from ballscrew.calibration.fit_result import Rows
from ballscrew.calibration.robust import Vector
from ballscrew.cases.case import Case
from ballscrew.cases.descriptions import model_text, nut_text
from ballscrew.components.operating_state import OperatingState
from ballscrew.documents.service import preload_quantity
from ballscrew.figures import style
from ballscrew.quantities import Quantity, fields_of
from ballscrew.service.estimate import PreloadEstimate
from ballscrew.service.posterior import torque_of_model
from ballscrew.studies.service import ServiceReport
from ballscrew.text import service as text

#: More points than this are a blot.
MOST_POINTS = 3000
_POINTS = 80
_COLOURS = {"new": style.BLUE, "worn": style.ORANGE, "preload": style.BLUE}


def picture(case: Case, report: ServiceReport) -> Figure:
    """Torque over speed to the left, preloads to the right; call within the house style."""
    figure, (left, right) = style.new_figure(text.caption(case, report))
    title = f"{', '.join(text.names(report))}: {nut_text(case.screw.nut)}, {model_text(case)}"
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    _torques(left, report)
    _preloads(right, case, report)
    return figure


def _torques(panel: Axes, report: ServiceReport) -> None:
    speed = fields_of(OperatingState)["screw_speed"]
    widest = 0.0
    for label, one in report.estimates.items():
        if one.fit is None:
            continue
        rows, colour = one.fit.rows, _COLOURS[label]
        x = np.abs(rows.log.screw_speed)
        along = np.geomspace(float(x.min()), float(x.max()), _POINTS) if np.ptp(x) > 0 else x[:1]
        curve = _friction(one, {**_usual(rows), "screw_speed": along})
        # rows of other loads and temperatures are shown by what they are off the curve
        own = points_of(rows.log, one.fit.lubricant)
        measured = rows.friction + one.fit.constant_torque - rows.residuals * rows.direction
        measured += _friction(one, {**_usual(rows), "screw_speed": x}) - _friction(one, own)
        some = _some(rows)
        panel.plot(units.from_si(x[some], speed), measured[some], ".", ms=3, alpha=0.5, color=colour)
        panel.plot(units.from_si(along, speed), curve, color=colour, label=label)
        widest = max(widest, float(np.quantile(measured, 0.99)), float(np.max(curve)))
        if np.ptp(x) > 0 and x.max() > 20 * x.min():
            panel.set_xscale("log")
    if report.reading is not None:
        shown = units.from_si(report.reading.screw_speed, speed)
        panel.plot([shown], [report.reading.torque], "o", color=style.BLUE, label="measured")
        widest = report.reading.torque
    panel.set(xlabel=f"speed [{speed.shown_in}]", ylabel="friction torque [N m]", title="torque over speed")
    panel.set_ylim(0, 1.15 * widest)
    panel.legend()


def _usual(rows: Rows) -> dict[str, Any]:
    """The median load and the mean temperature of a log."""
    found: dict[str, Any] = {"axial_load": float(np.median(np.abs(rows.log.axial_load)))}
    if rows.log.temperature is not None:
        found["temperature"] = float(np.mean(rows.log.temperature))
    return found


def _friction(one: PreloadEstimate, points: Mapping[str, Any]) -> Vector:
    """The friction torque with the preload and the numbers that were found."""
    assert one.subject is not None
    graded = one.subject.lubricant.follows_temperature
    there: dict[str, Any] = {"temperature": one.subject.lubricant.temperature, **points} if graded else dict(points)
    if not graded:
        there.pop("temperature", None)
    size = np.broadcast_arrays(*there.values())
    return torque_of_model(one.subject, dict(zip(there, size, strict=True)), np.array([[0.0], [1.0]]), one.warmer)


def _some(rows: Rows) -> NDArray[np.int64]:
    """Rows to draw, the same each time; those far off are not."""
    kept = np.flatnonzero(~rows.outlying)
    return kept if kept.size <= MOST_POINTS else np.random.default_rng(0).choice(kept, MOST_POINTS, replace=False)


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
        panel.errorbar(value, place, xerr=[[value - low], [high - value]], color=style.INK, capsize=4, lw=1.4)
