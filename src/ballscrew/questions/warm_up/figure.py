"""Warming up: the shaft over place and time, temperatures, growth, torque and preload over time."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.questions.shared import charts
from ballscrew.questions.warm_up import text
from ballscrew.questions.warm_up import verdicts as warm_up_verdicts
from ballscrew.questions.warm_up.compute import PLACE, SERIES, WarmUpReport

if TYPE_CHECKING:  # slow to import
    from ballscrew.questions.warm_up.band import WarmUpBandReport

_TITLE_CHARACTERS, _LABEL_SIZE, _LEVELS, _SHADE = 100, 8.0, 12, 0.15

#: Inches on a page of a report.
_PAGE = (7.1, 4.2)


def picture(report: WarmUpReport, found: WarmUpBandReport | None = None) -> Figure:
    """All panels, with bands where there are any; call within the house style."""
    figure, panels = charts.new_figure(caption(report, found), rows=3, height=2.7)
    figure.suptitle(
        "\n".join(textwrap.wrap(text.title(report), _TITLE_CHARACTERS)),
        x=0.012, ha="left", fontsize=11, fontweight="bold",
    )  # fmt: skip
    _shaft(figure, panels[0], report)
    _temperatures(panels[1], report)
    _drift(panels[2], report)
    held = report.warm_up.network.preload_set
    _over_time(panels[3], report, "preload" if held else "friction_power", charts.PURPLE)
    _over_time(panels[4], report, "screw_torque", charts.RED)
    _compensation(panels[5], report)
    if found is not None:
        _shade(found, panels[1], "nut_temperature", charts.RED)
        _shade(found, panels[2], "shaft_growth", charts.INK)
        if held:
            _shade(found, panels[3], "preload", charts.PURPLE)
        _shade(found, panels[4], "screw_torque", charts.RED)
    return figure


def panels(report: WarmUpReport) -> Figure:
    """Temperatures, growth, preload or friction, and torque for a page of a report, without a caption."""
    figure = Figure(figsize=_PAGE, layout="constrained")
    places: Any = figure.subplots(2, 2)
    first, second, third, fourth = places.ravel()
    _temperatures(first, report)
    _drift(second, report)
    held = report.warm_up.network.preload_set
    _over_time(third, report, "preload" if held else "friction_power", charts.PURPLE)
    _over_time(fourth, report, "screw_torque", charts.RED)
    return figure


def _shade(found: WarmUpBandReport, panel: Axes, name: str, colour: str) -> None:
    quantity, one = SERIES[name], found.bands.series[name]
    hours = units.from_si(found.bands.time, SERIES["time"])
    low, high = (np.asarray(units.from_si(end, quantity), dtype=float) for end in (one.low, one.high))
    panel.fill_between(np.asarray(hours, dtype=float), low, high, color=colour, alpha=_SHADE, linewidth=0)


def caption(report: WarmUpReport, found: WarmUpBandReport | None = None) -> str:
    """The verdicts, and what the panels show."""
    said = ". ".join(record.text for record in warm_up_verdicts.verdicts(report))
    shaded = ""
    if found is not None:
        level, count = f"{100 * found.bands.level:.4g} %", found.bands.count
        shaded = f" Shaded: {level} of {count} samples (nut, whole shaft, preload, torque)."
    return f"{said}. Dashed: the steady state.{shaded} While the axis stands, the torque is that of a move just then."


def _hours(report: WarmUpReport) -> np.ndarray:
    return np.asarray(units.from_si(report.warm_up.time, SERIES["time"]), dtype=float)


def _shaft(figure: Figure, panel: Axes, report: WarmUpReport) -> None:
    quantity = SERIES["shaft_temperature"]
    shown = np.asarray(units.from_si(report.warm_up.shaft_temperature, quantity), dtype=float)
    places = np.asarray(units.from_si(report.warm_up.places, PLACE), dtype=float)
    drawn = panel.contourf(_hours(report), places, shown.T, levels=_LEVELS, cmap="inferno")
    panel.grid(visible=False)
    for end in report.warm_up.network.ends:
        panel.axhline(float(units.from_si(end, PLACE)), color="white", linewidth=0.8, linestyle=":")
    bar = figure.colorbar(drawn, ax=panel)
    bar.ax.tick_params(labelsize=_LABEL_SIZE)
    panel.set(
        xlabel="time [h]", ylabel=f"place [{PLACE.shown_in}]", title=f"shaft [{_label(quantity)}]; dotted: the stroke"
    )


def _label(quantity: Quantity) -> str:
    return units.label(quantity).replace("degC", "°C")


def _temperatures(panel: Axes, report: WarmUpReport) -> None:
    colours = {"nut_temperature": charts.RED, "oil_temperature": charts.ORANGE, "shaft_temperature": charts.BLUE,
               "first_bearing_temperature": charts.GREY}  # fmt: skip
    end = report.equilibrium
    for name, colour in colours.items():
        quantity = SERIES[name]
        panel.plot(_hours(report), units.from_si(report.series[name], quantity), color=colour,
                   label=quantity.info.meaning.replace("temperature of the ", ""))  # fmt: skip
        if name in end and np.isfinite(end[name]):
            panel.axhline(float(units.from_si(end[name], quantity)), color=colour, linewidth=0.8, linestyle="--")
    panel.set(xlabel="time [h]", ylabel="[°C]", title="temperatures")
    panel.legend(fontsize=_LABEL_SIZE)


def _drift(panel: Axes, report: WarmUpReport) -> None:
    quantity = SERIES["shaft_growth"]
    places, growth = report.drift
    for place, values, colour in zip(places, growth.T, (charts.GREEN, charts.ORANGE, charts.PURPLE), strict=True):
        panel.plot(_hours(report), units.from_si(values, quantity), color=colour,
                   label=f"at {units.shown(float(place), PLACE)}")  # fmt: skip
    whole = units.from_si(report.series["shaft_growth"], quantity)
    panel.plot(_hours(report), whole, color=charts.INK, linestyle=":", label="whole shaft")
    panel.set(xlabel="time [h]", ylabel=f"[{units.label(quantity)}]", title="growth at ends and middle of the stroke")
    panel.legend(fontsize=_LABEL_SIZE)


def _over_time(panel: Axes, report: WarmUpReport, name: str, colour: str) -> None:
    quantity, works = SERIES[name], np.asarray(report.warm_up.works)
    values = np.asarray(units.from_si(report.series[name], quantity), dtype=float)
    panel.plot(_hours(report), values, color=colour, alpha=0.4, linestyle=":")
    panel.plot(_hours(report)[works], values[works], color=colour)
    full = report.full_bath
    if full is not None:
        bath = np.asarray(units.from_si(full.series[name], quantity), dtype=float)
        panel.plot(_hours(full), bath, color=charts.BLUE, label="in a full bath of oil")
        panel.legend(fontsize=_LABEL_SIZE)
    end = report.equilibrium["power" if name == "friction_power" else name]
    if np.isfinite(end):
        panel.axhline(float(units.from_si(end, quantity)), color=charts.GREY, linewidth=0.8, linestyle="--")
    panel.set(xlabel="time [h]", ylabel=f"[{units.label(quantity)}]", title=quantity.info.meaning)


def _compensation(panel: Axes, report: WarmUpReport) -> None:
    places, growth = report.compensation
    quantity = SERIES["shaft_growth"]
    panel.plot(units.from_si(places, PLACE), units.from_si(growth, quantity), "o-", color=charts.INK, markersize=3)
    panel.set(
        xlabel=f"place [{PLACE.shown_in}]", ylabel=f"growth [{units.label(quantity)}]",
        title="compensation at the end of work",
    )  # fmt: skip
