"""The charts of a sheet as a figure of matplotlib, in the style of the house."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.basis.sheet import Axis, Bars, Chart, Colour, Curve, Level, Lines, Sheet
from ballscrew.questions.shared import charts

_COLOURS: Mapping[Colour, str] = {
    "ink": charts.INK,
    "grey": charts.GREY,
    "blue": charts.BLUE,
    "orange": charts.ORANGE,
    "green": charts.GREEN,
    "purple": charts.PURPLE,
    "sky": charts.SKY,
    "red": charts.RED,
    "yellow": charts.YELLOW,
}
_STYLES: Mapping[str, Mapping[str, Any]] = {
    "line": {"linewidth": 1.2},
    "dashed": {"linestyle": "--", "linewidth": 1.2},
    "dots": {"linestyle": "", "marker": ".", "markersize": 4},
    "circles": {"linestyle": "", "marker": "o", "markerfacecolor": "none", "markersize": 4},
}
_TITLE_CHARACTERS, _LABEL_SIZE = 100, 8.0
#: Inches on a page of a report, for two rows.
_PAGE = (7.1, 4.2)


def picture(sheet: Sheet) -> Figure:
    """All charts below the title, the verdicts as caption; call within the house style."""
    blocks = list(sheet.of_kind(Chart, Bars))
    verdicts = [line.text for block in sheet.of_kind(Lines) for line in block.lines if line.kind == "verdict"]
    figure, panels = charts.new_figure(". ".join([*verdicts, ""]).strip(), rows=-(-len(blocks) // 2), height=2.7)
    title = "\n".join(textwrap.wrap(sheet.title, _TITLE_CHARACTERS))
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    _draw(panels, blocks)
    return figure


def page(sheet: Sheet) -> Figure:
    """The charts of curves for a page of a report, without title and caption."""
    blocks = list(sheet.of_kind(Chart))
    figure = Figure(figsize=(_PAGE[0], _PAGE[1] / 2 * -(-len(blocks) // 2)), layout="constrained")
    _draw(list(np.ravel(figure.subplots(-(-len(blocks) // 2), 2, squeeze=False))), blocks)
    return figure


def _draw(panels: Sequence[Axes], blocks: Sequence[Chart | Bars]) -> None:
    for panel, block in zip(panels, blocks, strict=False):
        if isinstance(block, Chart):
            _chart(panel, block)
        else:
            _bars(panel, block)
    for panel in panels[len(blocks) :]:
        panel.set_axis_off()


def _chart(panel: Axes, chart: Chart) -> None:
    second = None if chart.second is None else panel.twinx()
    for mark in chart.marks:
        if isinstance(mark, Level):
            y = units.from_si(mark.y, chart.y.quantity)
            panel.axhline(y, color=charts.GREY, linestyle=":", linewidth=1.0, label=mark.name)
        else:
            axis = chart.second if mark.second and chart.second is not None else chart.y
            _curve(second if mark.second and second is not None else panel, mark, chart.x, axis)
    panel.set(xlabel=_label(chart.x), ylabel=_label(chart.y), title=chart.title)
    if second is not None and chart.second is not None:
        styles = {mark.style for mark in chart.marks if isinstance(mark, Curve) and mark.second}
        second.set_ylabel(_label(chart.second) + (" (dashed)" if styles == {"dashed"} else ""))
        second.grid(visible=False)
    elif any(mark.name for mark in chart.marks):  # beside the chart, where it hides no curve
        panel.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _curve(panel: Axes, curve: Curve, x: Axis, y: Axis) -> None:
    points = units.from_si(np.asarray(curve.x), x.quantity), units.from_si(np.asarray(curve.y), y.quantity)
    colour, label = _COLOURS[curve.colour], curve.name or None
    if curve.style == "area":
        panel.fill_between(*points, color=colour, alpha=0.5, label=label)
    else:
        panel.plot(*points, color=colour, label=label, **_STYLES[curve.style])


def _bars(panel: Axes, bars: Bars) -> None:
    places = np.arange(len(bars.bars))
    widths = [units.from_si(value, bars.quantity) for _, value, _ in bars.bars]
    panel.barh(places, widths, color=[_COLOURS[colour] for _, _, colour in bars.bars])
    panel.axvline(0, color=charts.GREY, linewidth=0.8)
    panel.set_yticks(places, [name for name, _, _ in bars.bars])
    panel.tick_params(axis="y", length=0, labelsize=_LABEL_SIZE)
    panel.grid(visible=False, axis="y")
    panel.set_ylim(max(len(places), 1) - 0.4, -0.6)
    panel.set(xlabel=f"[{units.label(bars.quantity)}]", title=bars.title)


def _label(axis: Axis) -> str:
    return units.heading(axis.quantity, axis.name)
