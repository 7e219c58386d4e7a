"""A fit of a moving log at a glance: force over time, residuals over speed, friction over speed, the exponent."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import model_text
from ballscrew.evidence.moving_logs.motion_fit import LINEAR, POWER, SCREW, MotionFit
from ballscrew.files.torque_logs.motion import Floats
from ballscrew.questions.fit_motion import text
from ballscrew.questions.shared import charts

#: Colours of the models.
COLOURS = {LINEAR: charts.ORANGE, POWER: charts.GREEN, SCREW: charts.BLUE}
#: Rows that are drawn at most, speeds of a curve, and bins of the residuals.
MOST_ROWS, SPEEDS, BINS = 4000, 200, 20
#: Rows at least in a bin that is drawn.
_FEWEST = 5


def picture(case: Case, found: MotionFit) -> Figure:
    """A fit of a moving log at a glance; call within the house style."""
    figure, panels = charts.new_figure(text.caption(case, found), rows=2, columns=2)
    title = f"{text.log_name(found)}, {model_text(case)}"
    figure.suptitle(title, x=0.012, ha="left", fontsize=11, fontweight="bold")
    _over_time(panels[0], found)
    _residuals(panels[1], found)
    _friction(panels[2], found)
    _exponents(panels[3], found)
    return figure


def _some(count: int) -> NDArray[np.int64]:
    return np.arange(0, count, max(1, -(-count // MOST_ROWS)))


def _over_time(panel: Axes, found: MotionFit) -> None:
    equation = found.equation
    shown = _some(equation.used.size)
    time = equation.log.time[equation.used] - equation.log.time[0]
    panel.plot(time[shown], equation.force[shown], color=charts.GREY, lw=2.2, label="measured")
    panel.plot(
        time[shown], found.force(found.model)[shown], color=COLOURS[found.model], lw=1, label=text.SPOKEN[found.model]
    )
    panel.set(xlabel="time [s]", ylabel="force at the nut [N]", title="force over time")
    panel.legend(loc="upper right")


def _residuals(panel: Axes, found: MotionFit) -> None:
    """Means of residuals over parts of the rows in the order of their speed."""
    equation = found.equation
    speed = equation.filtered(equation.speed)
    parts = np.array_split(np.argsort(speed, kind="stable"), min(BINS, max(1, speed.size // _FEWEST)))
    at = [1e3 * float(np.mean(speed[part])) for part in parts]
    for name in found.relative_errors:
        off = found.force(name) - equation.force
        panel.plot(
            at, [float(np.mean(off[part])) for part in parts], "o-", ms=3, color=COLOURS[name], label=text.SPOKEN[name]
        )
    panel.axhline(0, color=charts.INK, lw=0.8)
    panel.set(xlabel="speed [mm/s]", ylabel="model − measured [N]", title="residuals, means over the speed")
    panel.margins(y=0.35)
    panel.legend(loc="upper center")


def _friction(panel: Axes, found: MotionFit) -> None:
    """Friction over speed: what is left of the force without mass and offset, and the models."""
    equation = found.equation
    mass, offset, constant, viscous = found.linear.values.tolist()
    direction, speed = np.sign(equation.filtered(equation.direction)), np.abs(equation.filtered(equation.speed))
    left = direction * (equation.force - mass * equation.filtered(equation.acceleration) - offset)
    shown = _some(speed.size)
    panel.plot(1e3 * speed[shown], left[shown], ".", ms=2, color=charts.SKY, alpha=0.35, label="measured")
    at: Floats = np.linspace(equation.rest, float(np.max(np.abs(equation.speed))), SPEEDS)
    curves = {LINEAR: constant + viscous * at}
    if found.power is not None:
        curves[POWER] = found.power.friction(at)
    if found.screw is not None:
        screw = found.screw
        curves[SCREW] = screw.constant_force + screw.viscous_coefficient * at + screw.screw_force(at)
        panel.plot(1e3 * at, screw.screw_force(at), "--", color=COLOURS[SCREW], lw=1, label="of this the balls")
    for name, values in curves.items():
        panel.plot(1e3 * at, values, color=COLOURS[name], label=text.SPOKEN[name])
    top = float(np.quantile(left, 0.995)) if left.size else 1.0
    panel.set(ylim=(min(0.0, -0.05 * top), 1.35 * top), xlabel="speed [mm/s]", ylabel="friction force [N]")
    panel.set_title("friction over speed")
    panel.legend(loc="lower right", markerscale=4)


def _exponents(panel: Axes, found: MotionFit) -> None:
    """The exponent of the speed and its intervals, and under each choice."""
    if found.power is None:
        panel.set_axis_off()
        return
    power = found.power
    known = {name: value for name, value in power.choices.items() if np.isfinite(value)}
    places = np.arange(len(known))
    panel.axvspan(*power.bootstrap, color=charts.SHADE, zorder=0, label="95 % by resampled blocks")
    panel.axvline(power.exponent, color=COLOURS[POWER], label=f"fitted, {power.exponent:.2f}")
    panel.axvline(1.0, color=charts.INK, lw=0.8, ls=":", label="viscous")
    panel.plot(list(known.values()), places, "o", color=COLOURS[POWER], ms=4)
    panel.set_yticks(places, list(known), fontsize=7)
    panel.set_ylim(len(known) + 3.5, -0.7)
    panel.set(xlabel="exponent of the speed", title="the exponent under other choices")
    panel.legend(loc="lower left", fontsize=7)
