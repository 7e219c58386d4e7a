"""The condition over time: torque at one temperature, preload left, and the sums that give the alarm."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import model_text, nut_text
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.condition_values import Condition
from ballscrew.questions.condition import points, text
from ballscrew.questions.shared import charts

_HOUR, _DAY = 3600.0, 86400.0


def picture(case: Case, found: Condition) -> Figure:
    """Torque, preload and sums over the time; call within the house style."""
    figure, panels = charts.new_figure(text.caption(case, found), columns=3)
    figure.suptitle(
        f"{text.names(found)}: {nut_text(case.screw.nut)}, {model_text(case)}",
        x=0.012, ha="left", fontsize=11, fontweight="bold",
    )  # fmt: skip
    times, label = _times(found)
    _torques(panels[0], found, times)
    _preloads(panels[1], found, times)
    _sums(panels[2], found, times)
    for panel in panels:
        panel.set_xlabel(label)
        panel.axvspan(float(times[0]), float(times[found.baseline - 1]), color=charts.GREY, alpha=0.12, lw=0)
        if found.alarm is not None:
            panel.axvline(float(times[found.alarm]), color=charts.RED, lw=1.2, label="alarm")
        panel.legend()
    return figure


def _times(found: Condition) -> tuple[Vector, str]:
    times = np.array([one.time for one in found.states])
    if found.per == "test":
        return times, "test"
    whole = float(np.ptp(times))
    return (times / _DAY, "days from the first test") if whole > 90 * _DAY else (times / _HOUR, "time [h]")


def _torques(panel: Axes, found: Condition, times: Vector) -> None:
    value, low, high = (
        np.array([getattr(one, name) for one in found.states]) for name in ("torque", "torque_low", "torque_high")
    )
    panel.errorbar(times, value, yerr=[value - low, high - value], fmt="o", ms=3.5, color=charts.BLUE, lw=0.8)
    panel.axhline(float(np.exp(np.mean(np.log(value[: found.baseline])))), color=charts.GREY, lw=1)
    panel.set(ylabel="friction torque [N m]", title=f"torque {text.at_reference(found)}", ylim=(0, 1.1 * high.max()))


def _preloads(panel: Axes, found: Condition, times: Vector) -> None:
    value, low, high = (
        100 * np.array([getattr(one, name) for one in found.states])
        for name in ("preload", "preload_low", "preload_high")
    )
    panel.fill_between(times, low, high, color=charts.BLUE, alpha=0.15, lw=0)
    panel.plot(times, value, "o-", ms=3.5, lw=0.8, color=charts.BLUE)
    panel.axhline(100 * (1 - found.tolerance), color=charts.ORANGE, ls="--", lw=1.2, label="tolerance")
    trend = points.trend_of(found)
    if trend is not None:
        panel.plot(times, 100 * trend, color=charts.INK, lw=1, label="trend")
    top = float(np.nanmax(high)) if np.isfinite(high).any() else 100.0
    panel.set(ylabel="preload [% of that of the first tests]", title="preload left", ylim=(0, min(1.05 * top, 250)))


def _sums(panel: Axes, found: Condition, times: Vector) -> None:
    chart = found.chart
    panel.plot(times, chart.fall, "o-", ms=3.5, lw=0.8, color=charts.BLUE, label="fall")
    panel.plot(times, chart.rise, "s-", ms=3, lw=0.8, color=charts.GREEN, label="rise")
    panel.plot(times, chart.limit, color=charts.ORANGE, ls="--", lw=1.2, label="limit")
    panel.set(ylabel="CUSUM [standard deviations]", title="sums of changes", ylim=(0, None))
