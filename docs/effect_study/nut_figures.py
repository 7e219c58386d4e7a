"""Figures of a nut under load and preload, for one catalogue screw."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ballscrew.physics.friction.calibrations import calibrated, calibrations
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.shared import charts
from effect_study import nut_curves as curves
from effect_study.cases import RPM
from effect_study.effect_figures import framed, mathtext

KILO, MICRO = 1e3, 1e-6
NUT_STYLES: Mapping[str, tuple[str, Any]] = {
    "single nut, no preload": (charts.GREY, ":"),
    "double nut": (charts.BLUE, "-"),
    "single nut, oversize balls": (charts.RED, "--"),
}
LOAD = "axial load F (kN)"


def _case(words: str, *, preloaded: bool = True) -> str:
    """Caption of a figure: its subject, the screw, and its preload."""
    row = curves.row()
    screw = row.screw()
    return mathtext(
        f"{words} Screw {row.nominal_diameter * KILO:g} × {row.lead * KILO:g} ({row.source}): balls of "
        f"{row.ball_diameter * KILO:g} mm, {screw.loaded_balls} loaded in each nut body, f {row.conformity:g}, α 45°"
        + (f"; preload {curves.preload() / KILO:.2f} kN, {curves.PRELOAD_SHARE:.0%} of C_a." if preloaded else ".")
    )


def distribution() -> Figure:
    """Load of each ball."""
    data = curves.distribution_curves()
    figure, (bodies, scatter) = charts.new_figure(
        _case(
            f"Load of each ball of a single nut under {data.axial_load / KILO:.1f} kN. Bodies: core of the screw, nut "
            f"1.5 d_m wide. Right: one set of balls whose diameters scatter by {curves.SCATTER / MICRO:g} µm, seed "
            f"{curves.SEED}.",
            preloaded=False,
        ),
    )
    number = np.arange(1, len(data.scattered) + 1)
    for (words, loads), colour, line in zip(
        data.elastic.items(), (charts.BLUE, charts.ORANGE), ("-", "--"), strict=True
    ):
        bodies.plot(number, loads, color=colour, linestyle=line, label=f"elastic, {words}")
    bodies.set_title("Screw and nut give way")
    scatter.plot(number, data.scattered, ".", color=charts.BLUE, markersize=4, label="elastic, balls scatter")
    scatter.set_title("And the balls differ")
    for panel in (bodies, scatter):
        panel.axhline(data.rigid, color=charts.GREY, linestyle=":", label="rigid, equal")
        framed(
            panel, "ball, from the end where the load enters", "load of the ball Q$_i$ (N)", ylim=(0, 1.45 * data.rigid)
        )
    charts.shared_legend((bodies, scatter), loc="lower left")
    return figure


def preload() -> Figure:
    """Loads of the halves of a double nut, and deflection of nuts."""
    data = curves.preload_curves()
    figure, (flanks, moves) = charts.new_figure(
        _case(
            "Bodies rigid. The relieved half of a double nut loses its load at 2.83 times the preload, or a bit more."
        )
    )
    double = data.loads["double nut"]
    x, relieved = data.axial_load / KILO, double.remaining_preload / KILO
    flanks.plot(x, x + relieved, color=charts.BLUE, label="half that carries the load")
    flanks.plot(x, relieved, color=charts.SKY, linestyle="--", label="half that is relieved")
    flanks.axvline(float(double.lift_off_load[0]) / KILO, color=charts.GREY, linestyle=":", label="lift-off")
    flanks.set(ylabel="axial force of the half (kN)", title="Double nut: what each half carries")
    flanks.legend(loc="upper left")
    for words, loads in data.loads.items():
        colour, line = NUT_STYLES[words]
        moves.plot(x, loads.deflection / MICRO, color=colour, linestyle=line, label=words)
    moves.set(ylabel="deflection (µm)", title="How far the nut gives way")
    moves.legend(loc="upper left")
    for panel in (flanks, moves):
        panel.set_xlabel(LOAD)
    return figure


def torque() -> Figure:
    """Friction torque and efficiency over the load, by kind of nut."""
    data = curves.preload_curves()
    figure, (friction, efficiency) = charts.new_figure(
        _case(
            f"Model reference, uncalibrated, {curves.GRADE} at {curves.TEMPERATURE - 273.15:g} °C, "
            f"{curves.SPEED / RPM:g} rpm, no seals."
        )
    )
    x = data.axial_load / KILO
    for words, result in data.friction.items():
        colour, line = NUT_STYLES[words]
        friction.plot(x, result.screw_torque, color=colour, linestyle=line, label=words)
        efficiency.plot(x[1:], result.efficiency[1:], color=colour, linestyle=line, label=words)
    friction.set(ylabel="friction torque M$_S$ (N m)", ylim=(0, None), title="What the preload costs")
    efficiency.set(ylabel="efficiency η", ylim=(0, 1), title="And what it leaves")
    for panel in (friction, efficiency):
        panel.set_xlabel(LOAD)
    friction.legend(loc="lower right")
    efficiency.legend(loc="lower right")
    return figure


def drag() -> Figure:
    """Drag of the preload over the lead, beside the rules of vendors."""
    reference = FrictionModel.reference()
    models = {"as it is": reference} | {
        f"calibrated, {name}": calibrated(reference, found) for name, found in calibrations().items()
    }
    figure, panels = charts.new_figure(
        _case(
            f"Drag of the preload without load for other leads, {curves.DRAG_SPEED / RPM:g} rpm, {curves.GRADE} at "
            f"{curves.DRAG_TEMPERATURE - 273.15:g} °C, no seals. Rules: Rexroth (tables of 2006), JIS B 1192 (THK)."
        ),
        columns=len(models),
    )
    for panel, (title, model) in zip(panels, models.items(), strict=True):
        data = curves.drag_curves(model)
        for words, values in data.model.items():
            colour, line = NUT_STYLES[words]
            panel.plot(data.lead_ratio, values, color=colour, linestyle=line, label=f"model, {words}")
            panel.axhline(data.rexroth[words], color=colour, linewidth=0.9, linestyle=":", label=f"Rexroth, {words}")
        panel.plot(data.lead_ratio, data.jis, color=charts.GREEN, linewidth=0.9, linestyle="-.", label="JIS, all nuts")
        framed(
            panel,
            "lead over nominal diameter P$_h$/d$_0$",
            "drag T/(F$_{pr}$ d$_0$)",
            f"Reference model, {title}",
            ylim=(0, 0.015),
        )
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


#: The figures by name.
DRAWN: Mapping[str, Callable[[], Figure]] = {
    "nut_distribution": distribution,
    "nut_preload": preload,
    "nut_torque": torque,
    "nut_drag": drag,
}


def parts() -> dict[str, Callable[[], Figure]]:
    """The figures by their files."""
    return {f"{name}.svg": draw for name, draw in DRAWN.items()}
