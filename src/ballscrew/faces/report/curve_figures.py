"""The curves of a report, as SVG that reads as text and follows the page into the dark."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from ballscrew.faces.report.curves import Curves
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.charts import svg_of

#: Inches: the width of an A4 page between its margins.
_WIDTH, _HEIGHT = 7.1, 2.5
_SPEED, _LOAD = "speed of the screw (rpm)", "axial load (N)"
#: From pale to strong, so that black numbers are read on it.
_PALE = LinearSegmentedColormap.from_list("pale", ["#F7FBFF", "#9ECAE1"])
#: Losses of the nut, which have no colour of their own.
_OTHERS = (charts.GREY, charts.YELLOW, "#999999")
_HERE: Mapping[str, Any] = {"color": charts.RED, "linewidth": 1.0, "linestyle": "--"}
#: A veil over what lies outside the model's validity.
_VEIL, _THIN = charts.GREY, 0.25


def pictures(curves: Curves) -> dict[str, str]:
    """All figures by name, as SVG text without a title."""
    drawn: Mapping[str, Callable[[Curves], Figure]] = {"speed": _over_speed, "load": _over_load, "maps": _maps}
    return {name: svg_of(functools.partial(draw, curves), name) for name, draw in drawn.items()}


def _panels() -> tuple[Figure, Axes, Axes]:
    figure = Figure(figsize=(_WIDTH, _HEIGHT), layout="constrained")
    panels: Any = figure.subplots(1, 2)
    left, right = panels
    return figure, left, right


def _over_speed(curves: Curves) -> Figure:
    figure, left, right = _panels()
    parts = {name: part for name, part in curves.parts.items() if np.any(np.nan_to_num(part))}
    others = iter(_OTHERS * len(parts))
    colours = [charts.MECHANISM_COLOURS.get(name) or next(others) for name in parts]
    labels = [MECHANISMS.get(name, name) for name in parts]
    if parts:
        stacked = np.stack(list(parts.values()))
        stacked[:, ~np.all(np.isfinite(stacked), axis=0)] = np.nan  # a gap, not a torque that lacks a part
        left.stackplot(curves.speeds, stacked, colors=colours, labels=labels, alpha=0.9, linewidth=0)
        total = stacked.sum(axis=0)
        left.plot(curves.speeds, total, color=charts.INK, linewidth=1.2)
        largest = total
        if curves.flooded_torque is not None:
            label = "all, in a full bath of oil"
            left.plot(
                curves.speeds, curves.flooded_torque, color=charts.INK, linewidth=1.2, linestyle="--", label=label
            )
            largest = np.fmax(total, curves.flooded_torque)
        left.set_ylim(0, 1.5 * float(np.nanmax(largest, initial=0.0)) or 1.0)
        handles, names = left.get_legend_handles_labels()
        left.legend(handles[::-1], names[::-1], loc="upper center", ncols=2)
    _frame(left, curves.here[0], curves.speeds, _SPEED, "friction torque on the screw (N m)")
    left.set_title("Torque and its parts over the speed")
    _lines(right, curves.speeds, curves.films)
    _frame(right, curves.here[0], curves.speeds, _SPEED, "film parameter λ")
    right.set_title("Film over the speed")
    _veil((left, right), curves.speeds, curves.valid_over_speed)
    return figure


def _over_load(curves: Curves) -> Figure:
    figure, left, right = _panels()
    left.plot(curves.loads, curves.efficiency, color=charts.BLUE, label="screw drives")
    back = np.where(curves.back_driving_efficiency < 0, np.nan, curves.back_driving_efficiency)
    left.plot(curves.loads, back, color=charts.ORANGE, linestyle="--", label="load drives")
    left.set_ylim(0, 1)
    left.legend(loc="lower right")
    _frame(left, curves.here[1], curves.loads, _LOAD, "efficiency")
    left.set_title("Efficiency over the load")
    _lines(right, curves.loads, curves.pressure)
    _frame(right, curves.here[1], curves.loads, _LOAD, "greatest pressure (GPa)")
    right.set_title("Contact pressure over the load")
    _veil((left, right), curves.loads, curves.valid_over_load)
    return figure


def _veil(panels: Sequence[Axes], x: Any, valid: Any) -> None:
    """Veil where the model does not hold, halfway to the points where it does."""
    edges = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    ends = np.flatnonzero(np.diff(np.concatenate([[False], ~valid, [False]])))
    for panel in panels:
        for begin, end in zip(ends[::2], ends[1::2], strict=True):
            panel.axvspan(float(edges[begin]), float(edges[end]), color=_VEIL, alpha=_THIN, linewidth=0, zorder=3)


def _lines(panel: Axes, x: Any, lines: Mapping[str, Any]) -> None:
    for (words, y), colour, dashes in zip(lines.items(), (charts.BLUE, charts.ORANGE), ("-", "--"), strict=False):
        panel.plot(x, y, color=colour, linestyle=dashes, label=words)
    panel.legend(loc="lower right")


def _frame(panel: Axes, here: float, x: Any, across: str, up: str) -> None:
    panel.axvline(here, **_HERE)
    panel.set_xlim(0, float(x[-1]))
    panel.set_ylim(bottom=0)
    panel.set_xlabel(across)
    panel.set_ylabel(up)


def _maps(curves: Curves) -> Figure:
    figure, left, right = _panels()
    for panel, values, title in (
        (left, curves.map_efficiency, "Efficiency"),
        (right, curves.map_torque, "Friction torque on the screw (N m)"),
    ):
        _map(panel, curves, np.ma.masked_invalid(values))
        panel.set_title(title)
    return figure


def _map(panel: Axes, curves: Curves, values: Any) -> None:
    low, high = (float(values.min()), float(values.max())) if values.count() else (math.nan, math.nan)
    panel.grid(visible=False)
    if math.isfinite(low) and math.isfinite(high) and high > low:
        x, y = curves.map_speeds, curves.map_loads
        # steps that are closer where the values are closer: as many places of the map between each two
        levels = np.unique([float(f"{level:.2g}") for level in np.quantile(values.compressed(), np.linspace(0, 1, 9))])
        panel.contourf(x, y, values, levels=40, cmap=_PALE)
        lines = panel.contour(x, y, values, levels=levels, colors=[charts.BLUE], linewidths=0.8)
        panel.clabel(lines, fontsize=7, colors=["#000000"])
    if not np.all(curves.valid_everywhere):
        outside = np.where(curves.valid_everywhere, 0.0, 1.0)
        panel.contourf(curves.map_speeds, curves.map_loads, outside, levels=[0.5, 1.5], colors=[_VEIL], alpha=_THIN)
    panel.plot(
        *curves.here,
        "o",
        color=charts.RED,
        markersize=6,
        clip_on=False,
        path_effects=[patheffects.withStroke(linewidth=2.5, foreground="white")],
    )
    panel.set_xlim(0, float(curves.map_speeds[-1]))
    panel.set_ylim(0, float(curves.map_loads[-1]))
    panel.set_xlabel(_SPEED)
    panel.set_ylabel(_LOAD)
