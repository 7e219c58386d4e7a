"""Friction over the angle of the screw after a reversal: its parts by mechanism, and the fitted models."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.engine.sweeps.reversal import PARTS
from ballscrew.physics.moving_balls.friction_states import SlipElementsFit, of_elements
from ballscrew.questions.reversal import text
from ballscrew.questions.reversal.compute import ANGLE, TORQUE, ReversalReport
from ballscrew.questions.shared import charts

_COLOURS: Mapping[str, str] = {
    "rolling": charts.SKY,
    "spin_and_curvature": charts.RED,
    "helix": charts.BLUE,
    "ball_to_ball": charts.PURPLE,
    "losses": charts.GREEN,
}
_TITLE_CHARACTERS = 100


def picture(report: ReversalReport) -> Figure:
    """The parts and the models over the angle, which is logarithmic; call within the house style."""
    figure, panels = charts.new_figure(text.caption(report), height=4.2)
    figure.suptitle(
        "\n".join(textwrap.wrap(text.title(report), _TITLE_CHARACTERS)),
        x=0.012, ha="left", fontsize=11, fontweight="bold",
    )  # fmt: skip
    _parts(panels[0], report)
    _models(panels[1], report)
    for panel in panels:
        panel.set_xscale("log")
        panel.set(xlabel="angle of the screw [°]", ylabel=f"friction torque [{units.label(TORQUE)}]")
        panel.axhline(0.0, color=charts.GREY, lw=0.8)
        # curves fill their panel
        panel.legend(fontsize="small", loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2)
    return figure


def _angles(report: ReversalReport) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """The angles that a logarithmic axis has, as they are shown, and where they are."""
    angle = np.asarray(report.reversal.screw_angle, dtype=float)
    return np.asarray(units.from_si(angle[angle > 0], ANGLE)), angle > 0


def _parts(panel: Axes, report: ReversalReport) -> None:
    shown, here = _angles(report)
    for name, values in report.reversal.contributions.items():
        torque = np.asarray(values, dtype=float)[here]
        if np.any(torque):
            words = PARTS.get(name, name).partition(",")[0]
            panel.plot(shown, torque, color=_COLOURS.get(name, charts.GREY), lw=1.4, label=words)
    panel.plot(shown, np.asarray(report.reversal.screw_torque)[here], color=charts.INK, label="all friction")
    panel.set_title("by mechanism")


def _models(panel: Axes, report: ReversalReport) -> None:
    shown, here = _angles(report)
    curve = report.curve
    angle = np.asarray(curve.screw_angle, dtype=float)[here]
    panel.plot(shown, np.asarray(report.reversal.screw_torque)[here], color=charts.INK, lw=2.6, label="computed")

    def model(torque: NDArray[np.float64], colour: str, style: str, label: str) -> None:
        panel.plot(shown, torque + curve.at_once, color=colour, ls=style, lw=1.3, label=label)

    if report.first is not None:
        first = report.first.model.torque(angle, curve.initial_torque)
        model(first, charts.ORANGE, "--", "Dahl, first 0.02°")
    model(report.tracking.model.torque(angle, curve.initial_torque), charts.RED, "--", "Dahl and LuGre, tracking")
    fewest, most = report.elements[0], report.elements[-1]
    model(_of(fewest, report)[here], charts.GREEN, "-.", f"{len(fewest.elements)} Maxwell-slip elements")
    if len(most.elements) > len(fewest.elements):
        model(_of(most, report)[here], charts.SKY, ":", f"{len(most.elements)} Maxwell-slip elements")
    panel.set_title("models fitted to it")


def _of(fit: SlipElementsFit, report: ReversalReport) -> NDArray[np.float64]:
    return of_elements(fit.elements, report.curve)
