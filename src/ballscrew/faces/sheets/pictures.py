"""The charts of a sheet as a figure of matplotlib, in the style of the house."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.basis.sheet import Axis, Band, Bars, Chart, Colour, Curve, Level, Lines, Map, Sheet, Vertical
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
    "dotted": {"linestyle": ":", "linewidth": 1.2},
    "dots": {"linestyle": "", "marker": ".", "markersize": 4},
    "circles": {"linestyle": "", "marker": "o", "markerfacecolor": "none", "markersize": 4},
}
_TITLE_CHARACTERS, _LABEL_SIZE, _SHADE, _CONTOURS = 100, 8.0, 0.15, 12
#: Inches on a page of a report, for two rows.
_PAGE = (7.1, 4.2)


def picture(sheet: Sheet) -> Figure:
    """All charts below the title, the verdicts as caption; call within the house style."""
    blocks = list(sheet.of_kind(Chart, Map, Bars))
    verdicts = [line.text for block in sheet.of_kind(Lines) for line in block.lines if line.kind == "verdict"]
    figure, panels = charts.new_figure(". ".join([*verdicts, ""]).strip(), rows=-(-len(blocks) // 2), height=2.7)
    title = "\n".join(textwrap.wrap(sheet.title, _TITLE_CHARACTERS))
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    _draw(panels, blocks)
    return figure


def page(sheet: Sheet) -> Figure:
    """The charts and maps for a page of a report, without those in detail, title and caption."""
    blocks = [block for block in sheet.of_kind(Chart, Map) if not block.detail]
    figure = Figure(figsize=(_PAGE[0], _PAGE[1] / 2 * -(-len(blocks) // 2)), layout="constrained")
    _draw(list(np.ravel(figure.subplots(-(-len(blocks) // 2), 2, squeeze=False))), blocks)
    return figure


def _draw(panels: Sequence[Axes], blocks: Sequence[Chart | Map | Bars]) -> None:
    for panel, block in zip(panels, blocks, strict=False):
        match block:
            case Chart():
                _chart(panel, block)
            case Map():
                _map(panel, block)
            case Bars():
                _bars(panel, block)
    for panel in panels[len(blocks) :]:
        panel.set_axis_off()


def _chart(panel: Axes, chart: Chart) -> None:
    second = None if chart.second is None else panel.twinx()
    for mark in chart.marks:
        match mark:
            case Curve() if mark.second and second is not None and chart.second is not None:
                _curve(second, mark, chart.x, chart.second)
            case Curve():
                _curve(panel, mark, chart.x, chart.y)
            case Band():
                x, low, high = (_shown(v, a) for v, a in ((mark.x, chart.x), (mark.low, chart.y), (mark.high, chart.y)))
                colour, name = _COLOURS[mark.colour], mark.name or None
                panel.fill_between(x, low, high, color=colour, alpha=_SHADE, linewidth=0, label=name)
            case Level() | Vertical():
                colour = _COLOURS[mark.colour] if isinstance(mark, Level) else charts.GREY
                _mark(panel, mark, chart, color=colour, label=mark.name or None)
    _axes(panel, chart)
    if second is not None and chart.second is not None:
        styles = {mark.style for mark in chart.marks if isinstance(mark, Curve) and mark.second}
        second.set_ylabel(_label(chart.second) + (" (dashed)" if styles == {"dashed"} else ""))
        second.grid(visible=False)
    elif any(mark.name for mark in chart.marks):  # beside the chart, where it hides no curve
        panel.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _map(panel: Axes, block: Map) -> None:
    x, y = _shown(block.places[0], block.x), _shown(block.places[1], block.y)
    colours = panel.contourf(x, y, _shown(block.values, block.value), levels=_CONTOURS, cmap="inferno")
    for mark in block.marks:
        _mark(panel, mark, block, color="white")
    panel.grid(visible=False)
    bar = panel.figure.colorbar(colours, ax=panel)
    bar.set_label(_label(block.value))
    bar.ax.tick_params(labelsize=_LABEL_SIZE)
    _axes(panel, block)


def _mark(panel: Axes, mark: Level | Vertical, block: Chart | Map, **style: Any) -> None:
    if isinstance(mark, Level):
        panel.axhline(float(_shown(mark.y, block.y)), linestyle=":", linewidth=1.0, **style)
    else:
        panel.axvline(float(_shown(mark.x, block.x)), linestyle=":", linewidth=0.7, **style)


def _axes(panel: Axes, block: Chart | Map) -> None:
    panel.set(xlabel=_label(block.x), ylabel=_label(block.y), title=block.title)
    panel.set(xscale="log" if block.x.log else "linear", yscale="log" if block.y.log else "linear")
    if block.x.least is not None:
        panel.set_xlim(left=float(_shown(block.x.least, block.x)))
    if block.y.least is not None:
        panel.set_ylim(bottom=float(_shown(block.y.least, block.y)))


def _shown(values: Any, axis: Axis) -> Any:
    return np.asarray(units.from_si(np.asarray(values, dtype=float), axis.quantity))


def _curve(panel: Axes, curve: Curve, x: Axis, y: Axis) -> None:
    points = _shown(curve.x, x), _shown(curve.y, y)
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
