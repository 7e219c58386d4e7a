"""Model against stated values, row by row: the ratios before and after a calibration, with the vendors' bands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.analyses.validation import DESCRIPTORS, Entry, Point
from ballscrew.interfaces import units
from ballscrew.interfaces.figures import style

_HEIGHT = 2.6
#: Marker and colour of the model as it is, and calibrated.
_MARKS = (("o", "white", style.BLUE), ("o", style.RED, style.RED))


def ratios(found: Sequence[Sequence[Entry]], caption: str) -> Figure:
    """A row of panels for each set: the ratio against two descriptors of its rows."""
    figure, panels = style.new_figure(caption, rows=len(found), height=_HEIGHT)
    for entries, pair in zip(found, zip(panels[::2], panels[1::2], strict=True), strict=True):
        data = entries[0].data
        for panel, axis in zip(pair, data.axes, strict=True):
            _panel(panel, entries, axis)
        pair[0].set_title(data.name)
        pair[1].set_title("\n".join(_judged(entry) for entry in entries), fontsize=8.5, fontweight="normal")
    return figure


def _judged(entry: Entry) -> str:
    who = "calibrated" if entry.calibration else "as it is"
    scatter = f" ± {entry.std_ratio:.2f}" if np.isfinite(entry.std_ratio) else ""
    share = "" if entry.share_in_band is None else f", {entry.share_in_band:.0%} in band"
    return f"{who}: {entry.mean_ratio:.2f}{scatter}, n = {len(entry.counted)}{share}".replace("%", " %")


def _panel(panel: Axes, entries: Sequence[Entry], axis: str) -> None:
    words, quantity = DESCRIPTORS[axis]
    panel.axhline(1.0, color=style.INK, linewidth=0.9)
    for entry, (marker, face, edge) in zip(entries, _MARKS, strict=False):
        points = entry.counted
        x = units.from_si(np.array([point.descriptors[axis] for point in points]), quantity)
        if entry is entries[0]:
            _bands(panel, x, entry)
        label = f"calibrated ({entry.calibration})" if entry.calibration else f"{entry.model.name}, as it is"
        panel.plot(
            x, [point.ratio for point in points], marker, color=edge, markerfacecolor=face, markersize=4.5, label=label
        )
    unit = "" if quantity.unit == "1" else f" ({quantity.shown_in})"
    panel.set_xlabel(f"{words}{unit}")
    panel.set_ylabel("model / stated (1)")
    tops = [end for entry in entries for point in entry.counted for end in (point.ratio, _top(point))]
    panel.set_ylim(0, 1.06 * max([*tops, 1.0]))
    panel.legend(loc="lower right", fontsize=8)


def _top(point: Point) -> float:
    """Where the band ends, in units of its middle."""
    return 1.0 if point.band.high is None else point.band.high / point.band.middle


def _bands(panel: Axes, x: Any, entry: Entry) -> None:
    """The vendor's bands in units of their middle."""
    for where, point in zip(x, entry.counted, strict=True):
        middle, low, high = point.band
        if low is not None and high is not None:
            panel.plot([where, where], [low / middle, high / middle], color=style.SHADE, linewidth=4, zorder=1)
