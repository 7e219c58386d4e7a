"""The paper's Figs 5 to 9 and the influences it names: as printed and corrected, side by side."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.cases.case_files import descriptions
from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.questions.reproduce.preloaded_nut import DRAG, PICTURE, PreloadedNut, label_of, level
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.charts import Columns, Plot

#: Short labels.
LABELS: Mapping[str, str] = {"olaru2005": "as printed", "corrected": "corrected"}
#: What stands above the panels.
TITLES: Mapping[str, str] = {
    "olaru2005": f"{LABELS['olaru2005']}: the paper's equations",
    "corrected": f"{LABELS['corrected']}: without its misprints",
}
#: The same in full, for captions.
MEANING = (
    "As printed: the paper's equations, with the square root in λ that they need. Corrected: without its misprints, "
    "and with the reactions that it leaves out."
)

SPEED, TORQUE, LOAD = "screw speed n (rpm)", "friction torque M$_S$ (N m)", "contact load Q of a ball (N)"
EFFICIENCY = "efficiency η"
_SCREW = "d$_m$ 40 mm, lead 5 mm, d$_w$ 3.175 mm, 56 balls, 45°"
_CHOSEN = "Chosen, as not stated in the paper: E′ 226 GPa, α$_p$ 22 1/GPa, equal load on all balls. " + MEANING
_AT_SPEEDS = f"Screw {_SCREW}; F = 4000 N."
_PAPER = "#FBEFD5"


@dataclasses.dataclass(frozen=True)
class Influence:
    """One parameter whose influence is drawn: its dimension, prefix, label and the label of a value."""

    prefix: str
    dimension: str
    symbol: str
    label: Callable[[float], str]
    caption: str


def _rpm(data: xr.Dataset) -> Any:
    return np.round(data["screw_speed"].to_numpy() / case.RPM, 6)


def _one_over_z(force: float) -> str:
    share = round(force * case.SCREW.loaded_balls, 6)
    return f"{share:g}/z N" if share else "0 N"


def _panels(data: xr.Dataset, panels: Sequence[Axes]) -> list[tuple[Axes, xr.Dataset]]:
    """Each panel with the data of its model, titled."""
    pairs: list[tuple[Axes, xr.Dataset]] = []
    for panel, name in zip(panels, TITLES, strict=True):
        panel.set_title(TITLES[name])
        pairs.append((panel, data.sel(model=name)))
    return pairs


def _label(panels: Sequence[Axes], x: str, y: str) -> None:
    for panel in panels:
        panel.set_xlabel(x)
        panel.set_ylabel(y)
        panel.tick_params(labelleft=True)


# -- over speed -----------------------------------------------------------------------------------


def torque_on_screw_and_nut(data: xr.Dataset) -> Figure:
    """Fig. 5: torque on screw and nut for two forces between the balls."""
    caption = (
        f"{_AT_SPEEDS} Viscosity 0.1 Pa s and the speed as abscissa are assumed, as the paper states neither for its "
        f"Fig. 5. {_CHOSEN}"
    )
    figure, panels = charts.new_figure(caption, sharey=True)
    for panel, model in _panels(data, panels):
        for force, colour in zip(model["fig5_ball_to_ball_force"].to_numpy(), (charts.BLUE, charts.RED), strict=True):
            curve = model.sel(fig5_ball_to_ball_force=force)
            words = _one_over_z(float(force))
            panel.plot(_rpm(data), curve["fig5_screw_torque"], color=colour, label=f"screw, F$_B$ = {words}")
            panel.plot(_rpm(data), curve["fig5_nut_torque"], "--", color=colour, label=f"nut, F$_B$ = {words}")
        panel.set_xlim(0, 1000)
    _label(panels, SPEED, "friction torque (N m)")
    charts.shared_legend(panels, loc="lower right", ncols=2)
    panels[0].set_ylim(bottom=float(data["fig5_nut_torque"].min()) - 0.035)
    return figure


def torque_over_speed(data: xr.Dataset) -> Figure:
    """Fig. 6: torque over speed, with its minimum."""
    caption = f"{_AT_SPEEDS} Viscosity 0.1 Pa s, F$_B$ = 1/z N. Band: where the paper has the minimum. {_CHOSEN}"
    figure, panels = charts.new_figure(caption, sharey=True)
    for panel, model in _panels(data, panels):
        torque = model["fig6_screw_torque"].to_numpy()
        lowest = int(np.argmin(torque))
        panel.axvspan(200, 300, color=_PAPER, zorder=0)
        panel.plot(_rpm(data), torque, color=charts.BLUE)
        panel.plot(_rpm(data)[lowest], torque[lowest], "o", color=charts.RED, markersize=6)
        panel.annotate(
            f"minimum at {_rpm(data)[lowest]:.0f} rpm\n{torque[lowest]:.3f} N m",
            (_rpm(data)[lowest], torque[lowest]),
            xytext=(30, -30),
            textcoords="offset points",
            arrowprops={"arrowstyle": "-", "color": charts.GREY, "shrinkB": 5},
            color=charts.INK,
            fontsize=9,
            va="center",
        )
        panel.set_xlim(0, 1000)
    panels[0].set_ylim(0.15, 0.25)
    _label(panels, SPEED, TORQUE)
    return figure


def efficiency_over_speed(data: xr.Dataset) -> Figure:
    """Fig. 7: efficiency over speed."""
    caption = f"{_AT_SPEEDS} Viscosity 0.1 Pa s, F$_B$ = 1/z N. Band: the paper's efficiencies. {_CHOSEN}"
    figure, panels = charts.new_figure(caption, sharey=True)
    for panel, model in _panels(data, panels):
        panel.axhspan(0.90, 0.92, color=_PAPER, zorder=0)
        panel.text(985, 0.91, "paper: 0.90 to 0.92", ha="right", va="center", fontsize=9, color=charts.GREY)
        panel.plot(_rpm(data), model["fig7_efficiency"], color=charts.BLUE)
        panel.set_xlim(0, 1000)
    panels[0].set_ylim(0.89, 0.96)
    _label(panels, SPEED, EFFICIENCY)
    return figure


def parts_over_speed(data: xr.Dataset) -> Figure:
    """The parts of the torque over speed: why there is a minimum."""
    caption = f"{_AT_SPEEDS} Viscosity 0.1 Pa s, F$_B$ = 1/z N. The parts add up to the torque of Fig. 6. {_CHOSEN}"
    figure, panels = charts.new_figure(caption, sharey=True)
    # areas are not simplified when they are written: fewer points where the curves are smooth
    sparse = np.r_[0:20, 20 : len(_rpm(data)) : 5]
    for panel, model in _panels(data, panels):
        names = ("ball_to_ball", "chain_braking", "elastic_hysteresis", "hydrodynamic_rolling", "curvature")
        parts = [model[f"parts_contribution_{name}"].to_numpy() for name in names]
        panel.stackplot(
            _rpm(data)[sparse],
            [part[sparse] for part in parts],
            labels=[MECHANISMS[name] for name in names],
            colors=[charts.MECHANISM_COLOURS[name] for name in names],
            linewidth=0,
        )
        panel.plot(_rpm(data), model["fig6_screw_torque"], color=charts.INK, label="total")
        panel.set_xlim(0, 1000)
    panels[0].set_ylim(0, 0.26)
    _label(panels, SPEED, TORQUE)
    handles, labels = panels[0].get_legend_handles_labels()
    # above both panels, where they cover nothing: three beside each other, as six are wider than the figure
    figure.legend(handles[::-1], labels[::-1], loc="outside upper center", ncols=3)
    return figure


# -- over load ------------------------------------------------------------------------------------


def _shade_light_loads(panel: Axes, model: xr.Dataset) -> None:
    """The loads at which the ball would skid, and those too light for the film equations."""
    load = model["fig8_contact_load"].to_numpy()
    skid = load[model["fig8_skid"].to_numpy()].max()
    light = load[model["fig8_elastic_regime"].to_numpy()].max()
    panel.axvspan(skid, light, color=charts.LIGHT_SHADE, zorder=0, label="too light for (1) and (26)")
    panel.axvspan(0, skid, color="#B8B8B8", zorder=0, label="the ball would skid")


def _over_load(
    data: xr.Dataset,
    name: str,
    ylabel: str,
    caption: str,
    close_up: tuple[float, float],
    place: tuple[float, float, float, float],
) -> Figure:
    """A quantity over contact load, with a close-up of the light loads (up to load and value) at a place."""
    figure, panels = charts.new_figure(caption, sharey=True)
    for panel, model in _panels(data, panels):
        load, values = model["fig8_contact_load"].to_numpy(), model[name].to_numpy()
        panel.plot(load, values, color=charts.BLUE)
        _shade_light_loads(panel, model)
        panel.set_xlim(0, 102)
        panel.legend(loc="lower right")
        inset = panel.inset_axes(place)
        inset.plot(load, values, color=charts.BLUE, linewidth=1.5)
        _shade_light_loads(inset, model)
        inset.set_xlim(0, close_up[0])
        inset.set_ylim(0, close_up[1])
        inset.tick_params(labelsize=8)
        inset.set_title("light loads", fontsize=8.5, fontweight="normal")
    _label(panels, LOAD, ylabel)
    return figure


def torque_over_load(data: xr.Dataset) -> Figure:
    """Fig. 8: torque over contact load."""
    caption = (
        f"Screw {_SCREW}; n = 600 rpm; axial load 0 to 4000 N; F$_B$ = 1/z N. Viscosity 0.1 Pa s is assumed, as the "
        f"paper does not state it for its Fig. 8. {_CHOSEN}"
    )
    return _over_load(data, "fig8_screw_torque", TORQUE, caption, (5.0, 0.035), (0.11, 0.56, 0.4, 0.35))


def efficiency_over_load(data: xr.Dataset) -> Figure:
    """Fig. 9: efficiency over contact load, with the range in which the ball would skid."""
    caption = (
        f"Screw {_SCREW}; n = 600 rpm; axial load 0 to 4000 N; F$_B$ = 1/z N. Viscosity 0.1 Pa s is assumed, as the "
        f"paper does not state it for its Fig. 9. Band: the paper's efficiencies above 20 N (dotted). {_CHOSEN}"
    )
    figure = _over_load(data, "fig9_efficiency", EFFICIENCY, caption, (5.0, 1.0), (0.48, 0.32, 0.48, 0.4))
    for panel in figure.axes[:2]:
        panel.axhspan(0.90, 0.92, color="#F3D089", zorder=0.5)
        panel.axvline(case.DIVIDING_CONTACT_LOAD, color=charts.GREY, linestyle=":", linewidth=1)
    figure.axes[0].set_ylim(0, 1)
    return figure


# -- influences -----------------------------------------------------------------------------------

INFLUENCES = (
    Influence(
        "viscosity",
        "viscosity",
        "viscosity",
        lambda value: f"{value:g} Pa s",
        "F$_B$ = 1/z N. The paper names the range of viscosity and shows no curve.",
    ),
    Influence(
        "conformity",
        "conformity",
        "conformity",
        lambda value: f"{value:g}",
        "Viscosity 0.1 Pa s, F$_B$ = 1/z N, both races alike. The paper names the range of conformity "
        "and shows no curve.",
    ),
    Influence(
        "ball_friction",
        "ball_friction_coefficient",
        "friction between balls µ_b",
        lambda value: f"{value:g}",
        "Viscosity 0.1 Pa s, F$_B$ = 1/z N. The paper has 0.1 throughout; the other values are ours.",
    ),
    Influence(
        "ball_force",
        "ball_to_ball_force",
        "force between balls F_B",
        _one_over_z,
        "Viscosity 0.1 Pa s. The paper has 1/z and 2/z N; the other values are ours.",
    ),
)


def influence_plot(influence: Influence) -> Plot:
    """Torque and efficiency over speed for a few values of one parameter."""

    def draw(data: xr.Dataset) -> Figure:
        caption = f"{_AT_SPEEDS} {influence.caption} {_CHOSEN}"
        figure, panels = charts.new_figure(caption, rows=2, height=3.0, sharex=True, sharey="row")
        values = data[influence.dimension].to_numpy()
        title = influence.symbol.replace("µ_b", "µ$_b$").replace("F_B", "F$_B$")
        for row, (output, ylabel) in enumerate((("screw_torque", TORQUE), ("efficiency", EFFICIENCY))):
            pair = panels[2 * row : 2 * row + 2]
            for panel, model in _panels(data, pair):
                curves = model[f"{influence.prefix}_{output}"]
                for value, colour, line in zip(values, charts.GROWING, charts.LINE_STYLES, strict=False):
                    label = influence.label(float(value))
                    panel.plot(_rpm(data), curves.sel({influence.dimension: value}), color=colour, ls=line, label=label)
                panel.set_xlim(0, 1000)
            _label(pair, SPEED, ylabel)
        for panel in panels[:2]:
            low, high = panel.get_ylim()
            panel.set_ylim(low, high + 0.28 * (high - low))
            panel.legend(
                title=title, title_fontsize=9, ncols=4 if len(values) == 4 else 3, loc="upper center", columnspacing=1.2
            )
            panel.tick_params(labelbottom=True)
        return figure

    def table(data: xr.Dataset) -> Columns:
        columns: dict[str, Any] = {"screw speed (rpm)": _rpm(data)}
        for output, (label, unit) in _OUTPUTS.items():
            for value in data[influence.dimension].to_numpy():
                for name in TITLES:
                    curve = data[f"{influence.prefix}_{output}"].sel({influence.dimension: value, "model": name})
                    heading = f"{label}, {influence.symbol} {influence.label(float(value))}, {name} ({unit})"
                    columns[heading] = curve.to_numpy()
        return columns

    return Plot(f"influence_{influence.prefix}", draw, table)


# -- tables ---------------------------------------------------------------------------------------

_OUTPUTS = {"screw_torque": ("friction torque on screw", "N m"), "efficiency": ("efficiency", "1")}


def _speed_table(*variables: tuple[str, str, str]) -> Callable[[xr.Dataset], Columns]:
    """Columns over speed for variables given as (name, label, unit), one for each model."""

    def table(data: xr.Dataset) -> Columns:
        columns: dict[str, Any] = {"screw speed (rpm)": _rpm(data)}
        for variable, label, unit in variables:
            for name in TITLES:
                columns[f"{label}, {name} ({unit})"] = data[variable].sel(model=name).to_numpy()
        return columns

    return table


def _load_table(variable: str, words: str, unit: str) -> Callable[[xr.Dataset], Columns]:
    def table(data: xr.Dataset) -> Columns:
        columns: dict[str, Any] = {"axial load (N)": data["axial_load"].to_numpy()}
        for name in TITLES:
            model = data.sel(model=name)
            columns[f"contact load, {name} (N)"] = model["fig8_contact_load"].to_numpy()
            columns[f"{words}, {name} ({unit})"] = model[variable].to_numpy()
            columns[f"ball would skid, {name} (1 = yes)"] = model["fig8_skid"].to_numpy().astype(int)
            columns[f"too light for (1) and (26), {name} (1 = yes)"] = (
                model["fig8_elastic_regime"].to_numpy().astype(int)
            )
        return columns

    return table


def _pair_table(data: xr.Dataset) -> Columns:
    columns: dict[str, Any] = {"screw speed (rpm)": _rpm(data)}
    for force in data["fig5_ball_to_ball_force"].to_numpy():
        for side in ("screw", "nut"):
            for name in TITLES:
                curve = data[f"fig5_{side}_torque"].sel(fig5_ball_to_ball_force=force, model=name)
                heading = f"friction torque on {side}, F_B {_one_over_z(float(force))}, {name} (N m)"
                columns[heading] = curve.to_numpy()
    return columns


PLOTS = (
    Plot("fig5_torque_on_screw_and_nut", torque_on_screw_and_nut, _pair_table),
    Plot(
        "fig6_torque_over_speed",
        torque_over_speed,
        _speed_table(("fig6_screw_torque", "friction torque on screw", "N m")),
    ),
    Plot("fig7_efficiency_over_speed", efficiency_over_speed, _speed_table(("fig7_efficiency", "efficiency", "1"))),
    Plot(
        "fig8_torque_over_load", torque_over_load, _load_table("fig8_screw_torque", "friction torque on screw", "N m")
    ),
    Plot("fig9_efficiency_over_load", efficiency_over_load, _load_table("fig9_efficiency", "efficiency", "1")),
    Plot(
        "parts_over_speed",
        parts_over_speed,
        _speed_table(
            *((f"parts_contribution_{mechanism}", words, "N m") for mechanism, words in MECHANISMS.items()),
            ("parts_screw_film_parameter", "film parameter at the screw", "1"),
            ("parts_nut_film_parameter", "film parameter at the nut", "1"),
            ("parts_screw_friction_coefficient", "friction coefficient at the screw", "1"),
            ("parts_nut_friction_coefficient", "friction coefficient at the nut", "1"),
        ),
    ),
    *(influence_plot(influence) for influence in INFLUENCES),
)


_BAR = 0.5


def band_and_rules(preloaded_nut: PreloadedNut) -> Figure:
    """The band of the model as a bar, with its value and its median; below it a point for each rule."""
    here = preloaded_nut.unloaded
    torque = here.band.band["screw_torque"]
    caption = (
        f"{descriptions.title(here.case)}; {descriptions.design(here.case)}. Bar: {level(here)} of "
        f"{here.band.band.count} samples of uncertain inputs and laws. "
        "Without seals, because the makers' rules leave them out."
    )
    figure, (panel,) = charts.new_figure(caption, columns=1, height=2.4)
    panel.barh(0, torque.both.high - torque.both.low, _BAR, left=torque.both.low, color=charts.SKY)
    ends = [-_BAR / 2, _BAR / 2]
    panel.plot([torque.median] * 2, ends, color=charts.INK, linestyle=":", label="median of the samples")
    panel.plot([torque.value] * 2, ends, color=charts.INK, label="at the values of the case")
    labels = ["reference model"]
    rules = preloaded_nut.rules
    for place, one in enumerate(rules, start=1):
        colour = charts.RED if one.beside.by_rule.is_own else charts.ORANGE
        panel.plot(float(one.beside.by_rule.torque), place, "o", color=colour)
        labels.append(label_of(one))
    panel.axvspan(*torque.both, color=charts.LIGHT_SHADE, zorder=0)
    panel.set_yticks(range(len(labels)), labels)
    panel.set_ylim(len(labels) - 0.5, -0.6)
    panel.set_xlim(left=0)
    panel.set_xlabel(f"{DRAG} (N m)")
    panel.grid(visible=False, axis="y")
    panel.tick_params(axis="y", length=0)
    figure.legend(loc="outside upper right", ncols=2)
    return figure


def _columns(preloaded_nut: PreloadedNut) -> Columns:
    torque = preloaded_nut.unloaded.band.band["screw_torque"]
    rules = preloaded_nut.rules
    return {
        "of": ["reference model", *(label_of(one) for one in rules)],
        f"{DRAG} (N m)": [torque.value, *(float(one.beside.by_rule.torque) for one in rules)],
        "least of the band (N m)": [torque.both.low, *[""] * len(rules)],
        "greatest of the band (N m)": [torque.both.high, *[""] * len(rules)],
        "within the band (1 = yes)": ["", *(int(one.is_in_band) for one in rules)],
    }


PLOT = Plot(PICTURE, band_and_rules, _columns)
