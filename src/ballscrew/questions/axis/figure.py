"""The chain of an axis over its stroke: rigidity, what gives way, critical speed, buckling."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.questions.axis import text
from ballscrew.questions.axis.compute import LOAD, SERIES, SPEED, SPRINGS, ChainReport
from ballscrew.questions.shared import charts

_COLOURS: Mapping[str, str] = dict(
    zip(SPRINGS, (charts.BLUE, charts.ORANGE, charts.GREEN, charts.GREY, charts.PURPLE), strict=True)
)
_TITLE_CHARACTERS = 100
#: Inches on a page of a report.
_PAGE = (7.1, 4.2)


def picture(report: ChainReport) -> Figure:
    """All panels; call within the house style."""
    figure, panels = charts.new_figure(caption(report), rows=2, height=2.7)
    figure.suptitle(
        "\n".join(textwrap.wrap(text.title(report), _TITLE_CHARACTERS)),
        x=0.012, ha="left", fontsize=11, fontweight="bold",
    )  # fmt: skip
    _draw(panels, report)
    return figure


def panels(report: ChainReport) -> Figure:
    """The panels for a page of a report, without a caption."""
    figure = Figure(figsize=_PAGE, layout="constrained")
    places: Any = figure.subplots(2, 2)
    _draw(places.ravel(), report)
    return figure


def _draw(panels: Sequence[Axes], report: ChainReport) -> None:
    _line(panels[0], report, "total", "rigidity between motor and table")
    panels[0].set_ylim(bottom=0)
    _shares(panels[1], report)
    _line(panels[2], report, "critical_speed", "critical speed of the shaft")
    _limit(panels[2], report.largest_speed, SPEED, "largest speed")
    _line(panels[3], report, "buckling_load", "buckling load of the shaft")
    _limit(panels[3], report.largest_load, LOAD, "largest load")
    for panel in panels:
        low, high = (float(units.from_si(end, SERIES["position"])) for end in report.travel)
        panel.axvspan(low, high, color=charts.LIGHT_SHADE, zorder=0)
        panel.set_xlabel(f"nut from the fixed bearing [{SERIES['position'].shown_in}]")


def caption(report: ChainReport) -> str:
    """The verdicts, and what the panels show."""
    said = ". ".join(record.text for record in report.verdicts)
    return f"{said}. Shaded: the travel of the nut."


def _places(report: ChainReport) -> Any:
    return units.from_si(report.chain.position, SERIES["position"])


def _line(panel: Axes, report: ChainReport, name: str, title: str) -> None:
    quantity = SERIES[name]
    panel.plot(_places(report), units.from_si(report.series[name], quantity), color=charts.BLUE)
    panel.set(ylabel=f"[{units.label(quantity)}]", title=title)


def _limit(panel: Axes, value: float, quantity: Quantity, label: str) -> None:
    shown = float(units.from_si(value, quantity))
    panel.axhline(shown, color=charts.RED, linestyle="--", linewidth=1.2, label=label)
    panel.legend(fontsize="small")
    panel.set_yscale("log")
    if shown > 0:
        panel.set_ylim(bottom=min(shown, panel.get_ylim()[0]) / 1.5)


def _shares(panel: Axes, report: ChainReport) -> None:
    shares = report.chain.shares
    known = [name for name in SPRINGS if np.any(shares[name])]
    panel.stackplot(
        _places(report), [100 * shares[name] for name in known], labels=known, colors=[_COLOURS[name] for name in known]
    )
    panel.set(ylabel="[%]", title="share of the compliance", ylim=(0, 100))
    panel.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
