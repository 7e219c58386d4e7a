"""Designs side by side: the parts of the friction torque of each as one bar, and the band of the torque."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.physics.friction.result import MECHANISMS
from ballscrew.questions.shared import charts

#: Inches: width, height of a bar, and of what stands above and below all bars.
_WIDTH, _ROW, _FRAME = 7.1, 0.34, 0.95
_BAR, _CAP = 0.62, 4
#: Losses of the nut, which have no colour of their own.
_OTHERS = ("#999999", "#666666", "#BBBBBB")


class DesignBar(NamedTuple):
    """A design by its name: the parts of its friction torque, and the ends of its band, N m."""

    name: str
    parts: Mapping[str, float]
    low: float
    high: float


def picture(designs: Sequence[DesignBar]) -> Figure:
    """A bar for each design, from the top; call within the house style."""
    figure = Figure(figsize=(_WIDTH, _FRAME + _ROW * len(designs)), layout="constrained")
    panel: Axes = figure.subplots()
    present = dict.fromkeys(name for one in designs for name, part in one.parts.items() if math.isfinite(part) and part)
    others = iter(_OTHERS * len(present))
    left = [0.0] * len(designs)
    for name in present:
        parts = [part if math.isfinite(part := one.parts.get(name, 0.0)) else 0.0 for one in designs]
        colour = charts.MECHANISM_COLOURS.get(name) or next(others)
        panel.barh(range(len(designs)), parts, _BAR, left=left, color=colour, label=MECHANISMS.get(name, name))
        left = [start + part for start, part in zip(left, parts, strict=True)]
    for place, one in enumerate(designs):
        if one.high > one.low:
            ends = [[max(0.0, left[place] - one.low)], [max(0.0, one.high - left[place])]]
            panel.errorbar(
                [left[place]], [place], xerr=ends, fmt="none", ecolor=charts.INK, capsize=_CAP, elinewidth=1.2
            )
    panel.set_yticks(range(len(designs)), [one.name for one in designs])
    panel.set_ylim(len(designs) - 0.4, -0.6)
    panel.tick_params(axis="y", length=0)
    panel.grid(visible=False, axis="y")
    panel.set_xlim(left=0.0)
    panel.set_xlabel("friction torque on the screw (N m)")
    if present:
        panel.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)
    return figure
