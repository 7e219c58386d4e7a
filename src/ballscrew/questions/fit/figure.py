"""A calibration at a glance: model against log, residuals, what physics buys, and where to measure next."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.fit_result import Rows
from ballscrew.evidence.calibration.next_test import NextTest
from ballscrew.files.torque_logs.log_rows import quantities
from ballscrew.questions.fit import text
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.fit.log import CONDITIONS
from ballscrew.questions.fit.points import measured_and_predicted
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.log_points import some
from ballscrew.questions.shared.text_tables import spoken

#: More points than this are a blot.
MOST_POINTS = 4000
#: From SI to the unit of an axis, and its label.
Axis = tuple[Callable[[Any], Any], str]


def picture(case: Case, report: FitReport) -> Figure:
    """A calibration at a glance; call within the house style."""
    inputs = report.model.subject.inputs
    known = {**{name: quantity for name, (_, quantity) in inputs.items()}, "time": quantities()["time"]}
    axes = {name: _axis(name, quantity) for name, quantity in known.items() if name in (*CONDITIONS, "time")}
    title, caption = text.log_and_model(case, report), text.caption(case, report)
    return overview(title, caption, report.model, report.next_test, axes)


def _axis(name: str, quantity: Quantity) -> Axis:
    """The scale and the label of an axis."""

    def scaled(values: Any) -> Any:
        return units.from_si(np.asarray(values), quantity)

    return scaled, f"{spoken(name)} [{quantity.shown_in}]"


def overview(title: str, caption: str, found: CalibratedModel, test: NextTest | None, axes: dict[str, Axis]) -> Figure:
    """Six panels; ``axes`` has the scale and the label of each quantity on an axis, by the name of the input."""
    figure, panels = charts.new_figure(caption, rows=2, columns=3)
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    shown = _some(found.rows)
    _against(panels[0], found, shown)
    against = [name for name in ("screw_speed", "axial_load", "temperature", "time") if name in found.rows.trends][:3]
    for panel, name in zip(panels[1:4], against, strict=False):
        _residuals(panel, found.rows, shown, name, axes[name])
    for panel in panels[1 + len(against) : 4]:
        panel.set_axis_off()
    _scores(panels[4], found)
    if test is None:
        panels[5].set_axis_off()
    else:
        _next(panels[5], found, test, axes)
    return figure


def _some(rows: Rows) -> NDArray[np.int64]:
    """Rows to draw, the same each time."""
    return some(np.arange(len(rows.log)), MOST_POINTS)


def _kinds(rows: Rows, shown: NDArray[np.int64]) -> Sequence[tuple[str, str, NDArray[np.int64]]]:
    held, far = rows.held_out[shown], rows.outlying[shown]
    return (
        ("fitted", charts.SKY, shown[~held & ~far]),
        ("held out", charts.ORANGE, shown[held & ~far]),
        ("outlier", charts.GREY, shown[far]),
    )


def _against(panel: Axes, found: CalibratedModel, shown: NDArray[np.int64]) -> None:
    rows = found.rows
    measured, predicted = measured_and_predicted(found)
    for label, colour, chosen in _kinds(rows, shown):
        if chosen.size:
            panel.plot(measured[chosen], predicted[chosen], ".", ms=3, color=colour, label=label, alpha=0.7)
    ends = [0.0, float(predicted.max()) * 1.05]
    panel.plot(ends, ends, color=charts.INK, lw=1)
    spread = 0.35 * ends[1]
    panel.set(xlim=(min(0.0, -spread / 4), ends[1] + spread), ylim=(0, ends[1]))
    panel.set(xlabel="measured friction torque [N m]", ylabel="predicted [N m]", title="model against log")
    panel.legend(loc="lower right", markerscale=2)


def _residuals(panel: Axes, rows: Rows, shown: NDArray[np.int64], name: str, axis: Axis) -> None:
    scale, label = axis
    values = {"screw_speed": np.abs(rows.log.screw_speed), "axial_load": np.abs(rows.log.axial_load)}.get(
        name, getattr(rows.log, name)
    )
    off = rows.residuals * rows.direction
    for _, colour, chosen in _kinds(rows, shown):
        panel.plot(scale(values[chosen]), off[chosen], ".", ms=3, color=colour, alpha=0.7)
    trend = rows.trends[name]
    panel.errorbar(
        scale(trend.values), trend.means, yerr=2 * trend.errors, color=charts.INK, marker="o", ms=4, capsize=3, lw=1.2
    )
    panel.axhline(0, color=charts.INK, lw=0.8)
    widest = 5 * float(np.median(np.abs(off))) / 0.6745
    panel.set(ylim=(-widest, widest), xlabel=label, ylabel="predicted − measured [N m]")
    panel.set_title(f"residuals against {name.rpartition('_')[2]}")
    if name == "screw_speed" and values.max() > 20 * values.min():
        panel.set_xscale("log")


def _scores(panel: Axes, found: CalibratedModel) -> None:
    places = np.arange(len(found.scores))
    fitted = [score.fitted for score in found.scores]
    held_out = [score.held_out for score in found.scores]
    panel.barh(places - 0.2, fitted, 0.36, color=charts.SKY, label="rows fitted")
    panel.barh(places + 0.2, held_out, 0.36, color=charts.ORANGE, label="rows held out")
    panel.set_yticks(places, [textwrap.fill(score.description, 14) for score in found.scores])
    panel.invert_yaxis()
    panel.set(xlabel="root mean square off [N m]", title="what physics buys")
    panel.legend()


def _next(panel: Axes, found: CalibratedModel, test: NextTest, axes: dict[str, Axis]) -> None:
    (of_speed, speed_label), (of_load, load_label) = axes["screw_speed"], axes["axial_load"]
    place = int(np.argmin(test.remaining_volume))
    chosen = np.ones(test.remaining_volume.size, dtype=bool)
    if "temperature" in test.tests:
        chosen = test.tests["temperature"] == test.tests["temperature"][place]
    speed, load = of_speed(test.tests["screw_speed"]), of_load(test.tests["axial_load"])
    drawn = panel.scatter(
        speed[chosen], load[chosen], c=100 * test.remaining_volume[chosen], marker="s", s=42, cmap="viridis_r"
    )
    panel.figure.colorbar(drawn, ax=panel, label="uncertainty of all free numbers together that is left [%]")
    log = found.rows.log
    shown = _some(found.rows)
    logged = of_speed(np.abs(log.screw_speed[shown])), of_load(log.axial_load[shown])
    panel.plot(*logged, ".", ms=1.5, color="white")
    panel.plot(speed[place], load[place], "*", ms=15, color=charts.RED, mec="white")
    # loads of both signs, or of the negative one, have no logarithm
    panel.set(xscale="log", yscale="linear" if load.min() < 0 else "log", xlabel=speed_label, ylabel=load_label)
    panel.set_title("where to measure next")
