"""Model against stated values, row by row: the ratios before and after a calibration, with the vendors' bands."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.evidence.validation.entries import DESCRIPTORS, Entry, Point
from ballscrew.questions.shared import charts
from ballscrew.questions.validate import text
from ballscrew.questions.validate.compute import Request

_HEIGHT = 3.2
#: An axis with fewer values shows no trend.
_FEWEST_VALUES = 3
_TITLE_CHARACTERS, _TITLE_LINE = 44, 13
#: Up to so many rows have their names below the axis.
_NAMES_AT_MOST = 4
#: Marker and colour of the model as it is, and calibrated.
_MARKS = (("o", "white", charts.BLUE), ("o", charts.RED, charts.RED))


def picture(found: Sequence[Sequence[Entry]], request: Request) -> Figure:
    """The ratios of all sets of a request; call within the house style."""
    sources = [text.source_and_fit(entries[0].data, request) for entries in found]
    return ratios(found, text.caption(found, request), sources)


def ratios(found: Sequence[Sequence[Entry]], caption: str, sources: Sequence[str]) -> Figure:
    """A row of panels for each set: the ratio against what its rows differ in, and no panel where they do not.

    ``sources`` say of each set who states its values. A set without a panel is told in the caption; if no set has
    one, each has a panel with its rows side by side.
    """
    rows = [(entries, source, _axes(entries)) for entries, source in zip(found, sources, strict=True)]
    drawn = [row for row in rows if row[2]]
    if drawn:
        caption = " ".join([caption, *(_in_words(entries) for entries, _, axes in rows if not axes)])
    else:
        drawn = [(entries, source, [""]) for entries, source, _ in rows]
    figure, panels = charts.new_figure(caption, rows=len(drawn), height=_HEIGHT)
    for (entries, source, axes), pair in zip(drawn, zip(panels[::2], panels[1::2], strict=True), strict=True):
        for panel, axis in zip(pair, axes, strict=False):
            _panel(panel, entries, source, axis)
        for panel in pair[len(axes) :]:
            panel.remove()
    return figure


def _axes(entries: Sequence[Entry]) -> list[str]:
    """The descriptors of a set that its rows differ in."""
    points = [point for entry in entries for point in entry.counted]
    return [
        axis for axis in entries[0].data.axes if len({point.descriptors[axis] for point in points}) >= _FEWEST_VALUES
    ]


def _in_words(entries: Sequence[Entry]) -> str:
    """``Not drawn, too few sizes: thk-jis (as it is: 0.41, n = 1).``"""
    return f"Not drawn, too few sizes: {entries[0].data.name} ({'; '.join(map(_judged, entries))})."


def _judged(entry: Entry) -> str:
    who = "calibrated" if entry.calibration else "as it is"
    scatter = f" ± {entry.std_ratio:.2f}" if np.isfinite(entry.std_ratio) else ""
    share = "" if entry.share_in_band is None else f", {entry.share_in_band:.0%} in band"
    ratio = f"{entry.mean_ratio:.2f}{scatter}"
    if entry.data.alternatives:  # each row could be the one screw: their mean says nothing
        ratio = "{:.2f} to {:.2f}".format(*entry.range_ratio)
    return f"{who}: {ratio}, n = {len(entry.counted)}{share}".replace("%", " %")


def _panel(panel: Axes, entries: Sequence[Entry], source: str, axis: str) -> None:
    """The ratios against a descriptor; with none, row by row."""
    panel.axhline(1.0, color=charts.INK, linewidth=0.9)
    for entry, (marker, face, edge) in zip(entries, _MARKS, strict=False):
        x = _places(entry, axis)
        if entry is entries[0]:
            _bands(panel, x, entry)
        panel.plot(
            x,
            [point.ratio for point in entry.counted],
            marker,
            color=edge,
            markerfacecolor=face,
            markersize=4.5,
            label=_judged(entry),
        )
    _label(panel, entries[0], axis)
    tops = [end for entry in entries for point in entry.counted for end in (point.ratio, _top(point))]
    panel.set_ylim(0, 1.06 * max([*tops, 1.0]))
    above: Any = {"loc": "lower left", "bbox_to_anchor": (0, 1), "borderaxespad": 0.2, "borderpad": 0}
    panel.legend(**above, title=source, alignment="left", fontsize=8, title_fontsize=8)
    words = textwrap.wrap(entries[0].data.title, _TITLE_CHARACTERS)
    # above the legend, which has a line for who states the values and one for each entry
    panel.set_title("\n".join(words), pad=_TITLE_LINE * (len(entries) + 1) + 4)


def _places(entry: Entry, axis: str) -> Any:
    if not axis:
        return np.arange(1.0, len(entry.counted) + 1)
    return units.from_si(np.array([point.descriptors[axis] for point in entry.counted]), DESCRIPTORS[axis].quantity)


def _label(panel: Axes, entry: Entry, axis: str) -> None:
    panel.set_ylabel("model / stated")
    if axis:
        words, quantity = DESCRIPTORS[axis]
        panel.set_xlabel(words if quantity.unit == "1" else f"{words} ({quantity.shown_in})")
        return
    panel.set_xlabel("row")
    panel.set_xlim(0, len(entry.counted) + 1)
    if len(entry.counted) <= _NAMES_AT_MOST:
        panel.set_xticks(_places(entry, axis), [point.name for point in entry.counted])


def _top(point: Point) -> float:
    """Ends of the band, in units of its middle."""
    return 1.0 if point.band.high is None else point.band.high / point.band.middle


def _bands(panel: Axes, x: Any, entry: Entry) -> None:
    """The vendor's bands in units of their middle."""
    for where, point in zip(x, entry.counted, strict=True):
        middle, low, high = point.band
        if low is not None and high is not None:
            panel.plot([where, where], [low / middle, high / middle], color=charts.SHADE, linewidth=4, zorder=1)
