"""The spread of models and laws at one operating point: torque by mechanism, and efficiency beside it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ballscrew.cases.case_files.case_file import Case
from ballscrew.engine.evaluation.comparison import Comparison, Row
from ballscrew.physics.friction.result import MECHANISMS
from ballscrew.questions.compare import text
from ballscrew.questions.shared import charts

#: Inches of a row, and of what stands above and below all rows.
_ROW, _FRAME = 0.235, 1.5
_BAR = 0.72
_HATCH = "/////"
_LABEL_SIZE = 8.5


class Line(NamedTuple):
    """One line of the figure: a heading, or a row with what stands to its left and right."""

    label: str
    row: Row | None = None
    words: str = ""


def picture(case: Case, found: Comparison) -> Figure:
    """The spread of a comparison; call within the house style."""
    letters = text.reason_letters(found)
    lines: list[Line] = []
    for heading, rows in text.row_groups(case, found):
        lines.append(Line(heading))
        lines += [Line(text.name_of(row), row, text.row_label(row, found, letters)) for row in rows]
    title = f"{text.operating_point(case)}, model {case.model.label}"
    mechanisms = {name: MECHANISMS.get(name, name) for name in text.mechanisms_in(found)}
    return spread(title, text.caption(case, found), lines, found.case, mechanisms)


def spread(title: str, caption: str, lines: Sequence[Line], case: Row, mechanisms: Mapping[str, str]) -> Figure:
    """Stacked bars of the friction torque by mechanism, line by line, and both efficiencies beside them."""
    figure, (torques, efficiencies) = charts.new_figure(
        caption, height=_FRAME + _ROW * len(lines), sharey=True, width_ratios=(3, 1)
    )
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    rows = [line.row for line in lines if line.row is not None]
    if math.isfinite(case.torque):
        torques.axvline(case.torque, color=charts.INK, linewidth=0.9, linestyle=":", zorder=1)
    for y, line in enumerate(lines):
        if line.row is not None:
            _bar(torques, line.row, y, mechanisms)
            _dots(efficiencies, line.row, y)
            _words(torques, line.words, y, line.row is case)
    _axes(torques, efficiencies, rows, lines)
    _legends(torques, efficiencies, rows, mechanisms)
    return figure


def _bar(panel: Axes, row: Row, y: int, mechanisms: Mapping[str, str]) -> None:
    """One bar; what drives instead of braking is stacked to the left of zero."""
    ends = {True: 0.0, False: 0.0}
    for mechanism in mechanisms:
        part = float(row.result.contributions[mechanism])
        if not math.isfinite(part):
            continue
        brakes = part >= 0
        panel.barh(
            y, part, _BAR, left=ends[brakes], color=charts.MECHANISM_COLOURS.get(mechanism, charts.GREY),
            hatch=_HATCH if row.outside else None, edgecolor="white", linewidth=0,
        )  # fmt: skip
        ends[brakes] += part


def _words(panel: Axes, words: str, y: int, is_case: bool) -> None:
    """The numbers in a column beside the bars."""
    panel.annotate(
        words,
        (1.0, y),
        xycoords=("axes fraction", "data"),
        xytext=(4, 0),
        textcoords="offset points",
        va="center",
        fontsize=_LABEL_SIZE,
        fontweight="bold" if is_case else "normal",
        color=charts.INK,
    )


def _dots(panel: Axes, row: Row, y: int) -> None:
    """The efficiency in both directions; nothing where the load cannot drive."""
    colour = charts.INK if not row.outside else charts.GREY
    forward, back = float(row.result.efficiency), float(row.result.back_driving_efficiency)
    if math.isfinite(back) and back > 0:
        panel.plot([back, forward], [y, y], color=charts.SHADE, linewidth=1.4, zorder=1)
        panel.plot(back, y, "o", color=colour, markerfacecolor="white", markersize=4.5)
    elif not math.isnan(back):
        panel.annotate(
            "locks",
            (1.0, y),
            xycoords=("axes fraction", "data"),
            ha="right",
            va="center",
            fontsize=_LABEL_SIZE,
            color=charts.RED,
        )
    if math.isfinite(forward):
        panel.plot(forward, y, "o", color=colour, markersize=4.5)


def _axes(torques: Axes, efficiencies: Axes, rows: Sequence[Row], lines: Sequence[Line]) -> None:
    ends = [row.torque for row in rows if math.isfinite(row.torque)]
    torques.set_xlim(min([*ends, 0.0]), 1.03 * max([*ends, 0.0]) or 1.0)
    torques.set_xlabel("friction torque on the screw (N m)")
    torques.set_yticks(range(len(lines)), [line.label for line in lines])
    for tick, line in zip(torques.get_yticklabels(), lines, strict=True):
        tick.set_fontweight("bold" if line.row is None else "normal")
        tick.set_fontsize(_LABEL_SIZE)
    torques.set_ylim(len(lines) - 0.4, -0.6)
    backward = [float(row.result.back_driving_efficiency) for row in rows]
    lowest = max(min(filter(math.isfinite, backward), default=0.0), 0.0)
    efficiencies.set_xlim(max(0.0, 1.2 * lowest - 0.2), 1.0)
    efficiencies.set_xlabel("efficiency η")
    for panel in (torques, efficiencies):
        panel.grid(visible=False, axis="y")
        panel.tick_params(axis="y", length=0)


def _legends(torques: Axes, efficiencies: Axes, rows: Sequence[Row], mechanisms: Mapping[str, str]) -> None:
    """Above the panels, out of the way of the bars."""
    handles = [
        Patch(color=charts.MECHANISM_COLOURS.get(name, charts.GREY), label=words) for name, words in mechanisms.items()
    ]
    if any(row.outside for row in rows):
        handles.append(Patch(facecolor=charts.SHADE, edgecolor="white", hatch=_HATCH, label="not valid here"))
    torques.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(0, 1), ncols=3, columnspacing=1.2, fontsize=_LABEL_SIZE
    )
    efficiencies.plot([], [], "o", color=charts.INK, markersize=4.5, label="screw drives")
    efficiencies.plot([], [], "o", color=charts.INK, markerfacecolor="white", markersize=4.5, label="load drives")
    efficiencies.legend(loc="lower left", bbox_to_anchor=(0, 1), fontsize=_LABEL_SIZE)
