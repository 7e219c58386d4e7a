"""Sources of a band: bars of all inputs, and the band that remains as inputs become known."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.cases.case_files.case_file import Case
from ballscrew.engine.uncertainty.sensitivity import HALF, Sensitivity
from ballscrew.engine.uncertainty.sobol import Estimate
from ballscrew.questions.sensitivity import text
from ballscrew.questions.sensitivity.compute import SensitivityReport
from ballscrew.questions.shared import charts

#: Inches of a row, and of what stands above and below all rows.
_ROW, _FRAME = 0.36, 1.5
_TITLE_CHARACTERS = 100
_BARS = 0.76
_LABEL_SIZE = 8.0
_COLOURS = (charts.BLUE, charts.SKY)


def picture(case: Case, report: SensitivityReport) -> Figure:
    """The measures of all inputs; call within the house style."""
    result = report.result
    axis = "share of the variance"
    if result.method != "sobol":
        unit = text.unit(result.quantity)
        axis = "change by one deviation of the input" + (f" ({unit})" if unit else "")
    shown = ("effect",) if result.method == "local" else text.SHOWN[result.method]
    return bars(
        [f"What moves the {text.output_meaning(result)}", text.operating_point(case)],
        text.caption(case, report),
        axis,
        [f"{report.describe(name)}\n{text.distribution(report.uncertain[name])}" for name in result.inputs],
        {text.HEADINGS[m]: [_as_shown(result, result.measures[m][name]) for name in result.inputs] for m in shown},
        [(report.describe(known.inputs[-1]), known.remaining) for known in result.explained_variance],
    )


def _as_shown(result: Sensitivity, estimate: Estimate) -> Estimate:
    """A share as it is, an effect in the display unit."""
    if result.method == "sobol":
        return estimate
    return Estimate(*(float(units.from_si(value, result.quantity)) for value in estimate))


def bars(
    title: Sequence[str],
    caption: str,
    axis: str,
    inputs: Sequence[str],
    measures: Mapping[str, Sequence[Estimate]],
    knowing: Sequence[tuple[str, float]],
) -> Figure:
    """The measures of each input with their intervals; beside them what is left, if any ``knowing`` says so.

    ``knowing`` has the inputs from the largest, and the share of the standard deviation that is left if each and all
    before it are known.
    """
    rows = max(len(inputs), len(knowing) + 1)
    columns, widths = (2, (3, 2)) if knowing else (1, (1,))
    figure, panels = charts.new_figure(caption, columns=columns, height=_FRAME + _ROW * rows, width_ratios=widths)
    lines = [line for text in title for line in textwrap.wrap(text, _TITLE_CHARACTERS)]
    figure.suptitle("\n".join(lines), x=0.012, ha="left", fontsize=11, fontweight="bold")
    _bars(panels[0], axis, inputs, measures)
    if knowing:
        _left(panels[1], knowing)
    for panel in panels:
        panel.set_ylim(rows - 0.4, -0.6)
    return figure


def _bars(panel: Axes, axis: str, inputs: Sequence[str], measures: Mapping[str, Sequence[Estimate]]) -> None:
    places = np.arange(len(inputs))
    thickness = _BARS / len(measures)
    for k, ((label, estimates), colour) in enumerate(zip(measures.items(), _COLOURS, strict=False)):
        values, low, high = np.transpose(estimates)
        y = places + thickness * (k - (len(measures) - 1) / 2)
        panel.barh(y, values, thickness, color=colour, label=label)
        if np.any(high > low):
            # an interval of percentiles may leave its estimate out
            ends = [np.maximum(values - low, 0), np.maximum(high - values, 0)]
            panel.errorbar(values, y, xerr=ends, fmt="none", ecolor=charts.INK, elinewidth=1.0, capsize=2)
    panel.axvline(0, color=charts.GREY, linewidth=0.8)
    panel.set_xlabel(axis)
    if len(measures) > 1:
        panel.legend(loc="lower right", fontsize=_LABEL_SIZE)
    _rows(panel, inputs)


def _left(panel: Axes, knowing: Sequence[tuple[str, float]]) -> None:
    left = 100 * np.array([1.0, *(share for _, share in knowing)])
    panel.barh(np.arange(len(left)), left, _BARS / 2, color=charts.ORANGE)
    panel.axvline(100 * HALF, color=charts.INK, linewidth=0.9, linestyle="--")
    panel.annotate(
        "half", (100 * HALF, 1), xycoords=("data", "axes fraction"), xytext=(3, -1), textcoords="offset points",
        va="bottom", fontsize=_LABEL_SIZE, color=charts.INK,
    )  # fmt: skip
    panel.set_xlim(0, 100)
    panel.set_xlabel("deviation left (%)")
    _rows(panel, ["nothing known", *(f"+ {name}" for name, _ in knowing)])


def _rows(panel: Axes, labels: Sequence[str]) -> None:
    """Rows from top to bottom."""
    panel.set_yticks(range(len(labels)), labels)
    panel.tick_params(axis="y", length=0, labelsize=_LABEL_SIZE)
    panel.grid(visible=False, axis="y")
