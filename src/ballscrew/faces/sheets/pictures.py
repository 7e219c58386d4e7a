"""The charts of a sheet as a figure of matplotlib, in the style of the house."""

from __future__ import annotations

import dataclasses
import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Band,
    Bar,
    Bars,
    Chart,
    Colour,
    Curve,
    Level,
    Lines,
    Map,
    Sheet,
    Vertical,
    sentence,
)
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.charts import SHADES

_STYLES: Mapping[str, Mapping[str, Any]] = {
    "line": {"linewidth": 1.2},
    "dashed": {"linestyle": "--", "linewidth": 1.2},
    "dotted": {"linestyle": ":", "linewidth": 1.2},
    "dots": {"linestyle": "", "marker": ".", "markersize": 4},
    "circles": {"linestyle": "", "marker": "o", "markerfacecolor": "none", "markersize": 4},
}
_TITLE_CHARACTERS, _LABEL_CHARACTERS, _LABEL_SIZE, _SHADE, _CONTOURS, _HATCH = 100, 36, 8.0, 0.15, 12, "/////"
#: Inches: the height of a chart in a picture and on a page of a report, and how wide a page is.
_CHART, _PAGE_CHART, _PAGE_WIDTH = 2.7, 2.1, 7.1
#: More bars than these have a row of their own, with inches for each and for what is above and below.
_FEW_BARS, _BAR_HEIGHT, _FRAME = 12, 0.24, 1.3
#: Points: the pad of a title, and each line of a legend below it.
_TITLE_PAD, _LEGEND_LINE, _LEGEND_COLUMNS = 6.0, 15.0, 4
Drawn: TypeAlias = Chart | Map | Bars


def picture(sheet: Sheet) -> Figure:
    """All charts below the title, verdicts, warnings and small lines as caption; call within the house style."""
    rows = _rows(list(sheet.of_kind(Chart, Map, Bars)))
    lines = [line for block in sheet.of_kind(Lines) if not block.detail for line in block.lines]
    caption = " ".join(f"{sentence(line.text)}." for line in lines if line.kind != "plain")
    figure = charts.captioned_figure(caption, 2 * charts.PANEL_WIDTH, sum(_heights(rows, _CHART)))
    title = "\n".join(textwrap.wrap(sheet.title, _TITLE_CHARACTERS))
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    _draw(figure, rows, _heights(rows, _CHART))
    return figure


def page(blocks: Sequence[Drawn]) -> Figure:
    """Charts for a page of a report, without title and caption."""
    rows = _rows(blocks)
    heights = _heights(rows, _PAGE_CHART)
    figure = Figure(figsize=(_PAGE_WIDTH, sum(heights)), layout="constrained")
    _draw(figure, rows, heights)
    return figure


def _rows(blocks: Sequence[Drawn]) -> list[list[Drawn]]:
    """Blocks in rows of two; bars that are many, of parts, or have texts have a row of their own."""
    rows: list[list[Drawn]] = []
    for block in blocks:
        if rows and len(rows[-1]) == 1 and not _is_wide(rows[-1][0]) and not _is_wide(block):
            rows[-1].append(block)
        else:
            rows.append([block])
    return rows


def _is_wide(block: Drawn) -> bool:
    if not isinstance(block, Bars):
        return False
    return len(block.bars) > _FEW_BARS or any(bar.text for bar in block.bars) or bool(_legend(block))


def _heights(rows: Sequence[Sequence[Drawn]], chart: float) -> list[float]:
    """Inches of each row."""
    return [
        _FRAME + _BAR_HEIGHT * len(row[0].bars) if isinstance(row[0], Bars) and _is_wide(row[0]) else chart
        for row in rows
    ]


def _draw(figure: Figure, rows: Sequence[Sequence[Drawn]], heights: Sequence[float]) -> None:
    if not rows:
        return
    parts = figure.subfigures(len(rows), 1, height_ratios=heights, squeeze=False)  # long names move their own row only
    for part, row in zip(parts.flat, rows, strict=True):
        for column, block in enumerate(row):
            panel = part.add_subplot(1, len(row), column + 1)
            match block:
                case Chart():
                    _chart(panel, block)
                case Map():
                    _map(panel, block)
                case Bars():
                    _bars(panel, block)


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
                colour, name = SHADES[mark.colour], mark.name or None
                shade = 1.0 if mark.solid else _SHADE
                panel.fill_between(x, low, high, color=colour, alpha=shade, linewidth=0, label=name)
            case Level() | Vertical():
                _mark(panel, mark, chart, color=SHADES[mark.colour], label=mark.name or None)
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
        if isinstance(mark, Curve):
            _curve(panel, dataclasses.replace(mark, name=""), block.x, block.y)
        else:
            _mark(panel, mark, block, color="white")
    panel.grid(visible=False)
    bar = panel.figure.colorbar(colours, cax=panel.inset_axes((1.03, 0.0, 0.05, 1.0)))
    bar.set_label(_label(block.value))
    bar.ax.tick_params(labelsize=_LABEL_SIZE)
    _axes(panel, block)


def _mark(panel: Axes, mark: Level | Vertical, block: Chart | Map, **style: Any) -> None:
    if isinstance(mark, Level):
        panel.axhline(float(_shown(mark.y, block.y)), linestyle=":", linewidth=1.0, **style)
    else:
        panel.axvline(float(_shown(mark.x, block.x)), linestyle=":", linewidth=0.7, **style)


def _axes(panel: Axes, block: Chart | Map) -> None:
    ylabel = _label(block.y)
    if len(ylabel) > _LABEL_CHARACTERS:  # the unit stands below
        ylabel = "\n[".join(ylabel.rsplit(" [", 1))
    panel.set(xlabel=_label(block.x), ylabel=ylabel, title=block.title)
    panel.set(xscale="log" if block.x.log else "linear", yscale="log" if block.y.log else "linear")
    if block.x.least is not None:
        panel.set_xlim(left=float(_shown(block.x.least, block.x)))
    if block.y.least is not None:
        least = float(_shown(block.y.least, block.y))
        panel.update_datalim([(0.0, least)], updatex=False)  # the margin above is one of the whole axis
        panel.autoscale_view()
        panel.set_ylim(bottom=least)


def _shown(values: Any, axis: Axis) -> Any:
    return np.asarray(units.from_si(np.asarray(values, dtype=float), axis.quantity))


def _curve(panel: Axes, curve: Curve, x: Axis, y: Axis) -> None:
    points = _shown(curve.x, x), _shown(curve.y, y)
    colour, label = SHADES[curve.colour], curve.name or None
    if curve.style == "area":
        panel.fill_between(*points, color=colour, alpha=0.5, label=label)
    else:
        panel.plot(*points, color=colour, label=label, **_STYLES[curve.style])
    for text, x_of_text, y_of_text in zip(curve.labels, *points, strict=False):
        if math.isfinite(x_of_text) and math.isfinite(y_of_text):
            place = (float(x_of_text), float(y_of_text))
            panel.annotate(text, place, xytext=(4, 3), textcoords="offset points", fontsize=_LABEL_SIZE)


def _bars(panel: Axes, block: Bars) -> None:
    for place, bar in enumerate(block.bars):
        _bar(panel, place, bar, block)
    panel.axvline(float(units.from_si(block.origin, block.quantity)), color=charts.GREY, linewidth=0.8)
    if block.origin:  # bars do not begin at zero: no axis begins at one
        panel.use_sticky_edges = False
        panel.margins(x=0.05)
    for mark in block.marks:
        at = float(units.from_si(mark.x, block.quantity))
        panel.axvline(at, color=SHADES[mark.colour], linestyle=":", linewidth=1.0)
        panel.text(at, 0.0, f" {mark.name}", transform=panel.get_xaxis_transform(), va="bottom", fontsize=_LABEL_SIZE)
    panel.set_yticks(range(len(block.bars)), [bar.name for bar in block.bars])
    for tick, bar in zip(panel.get_yticklabels(), block.bars, strict=True):
        tick.set_fontweight("normal" if bar.parts else "bold")
    panel.tick_params(axis="y", length=0, labelsize=_LABEL_SIZE)
    panel.grid(visible=False, axis="y")
    panel.set_ylim(max(len(block.bars), 1) - 0.4, -0.6)
    unit = units.label(block.quantity)
    panel.set_xlabel(f"[{unit}]" if unit else "")
    legend = _legend(block)
    lines = -(-len(legend) // _LEGEND_COLUMNS)
    panel.set_title(block.title, pad=_TITLE_PAD + lines * _LEGEND_LINE)
    if legend:
        handles = [Patch(color=SHADES[colour], label=name) for name, colour in legend.items()]
        panel.legend(handles=handles, loc="lower left", bbox_to_anchor=(0, 1), ncols=_LEGEND_COLUMNS, fontsize="small")


def _legend(block: Bars) -> dict[str, Colour]:
    """The colours of the parts that have names."""
    return {name: colour for bar in block.bars for name, value, colour in bar.parts if name and value}


def _bar(panel: Axes, place: int, bar: Bar, block: Bars) -> None:
    """Its parts from the origin, negative ones to the left."""
    quantity = block.quantity
    origin = float(units.from_si(block.origin if bar.start is None else bar.start, quantity))
    ends = {True: origin, False: origin}
    for _, value, colour in bar.parts:
        width, hatch = float(units.from_si(value, quantity)), _HATCH if bar.hatched else None
        if math.isfinite(width):
            panel.barh(
                place, width, left=ends[width < 0], color=SHADES[colour], hatch=hatch, edgecolor="white", linewidth=0
            )
            ends[width < 0] += width
    if bar.band is not None and all(map(math.isfinite, bar.band)):
        end = sum(ends.values()) - origin
        low, high = (float(units.from_si(value, quantity)) for value in bar.band)
        error = [[max(end - low, 0.0)], [max(high - end, 0.0)]]  # percentiles may leave the value out
        panel.errorbar(end, place, xerr=error, color=charts.INK, elinewidth=1.0, capsize=2)
    if bar.text:
        panel.text(1.0, place, f" {bar.text}", transform=panel.get_yaxis_transform(), va="center", fontsize=_LABEL_SIZE)


def _label(axis: Axis) -> str:
    unit = units.label(axis.quantity).replace("degC", "°C")
    return f"{axis.name} [{unit}]" if unit else axis.name
