"""A duty: motion, torque by cause and power over the cycle; torque over speed; torque and energy by cause."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of
from ballscrew.questions.duty import text
from ballscrew.questions.duty import verdicts as duty_verdicts
from ballscrew.questions.duty.compute import NUMBERS, DutyReport, cause_of
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.chart_colours import CAUSE_COLOURS

_MOTION = fields_of(Trapezoid)
_TURNING = NUMBERS["mean_speed"]
_TITLE_CHARACTERS, _LABEL_SIZE, _LEAST = 100, 8.0, 1e-9
_CURVE_POINTS = 200
#: More points than this are a blot, and a large file.
_MOST_POINTS = 5000
#: Inches on a page of a report.
_PAGE = (7.1, 4.2)


def picture(report: DutyReport) -> Figure:
    """All panels; call within the house style."""
    figure, panels = charts.new_figure(caption(report), rows=3, height=2.7)
    figure.suptitle(
        "\n".join(textwrap.wrap(text.title(report), _TITLE_CHARACTERS)),
        x=0.012, ha="left", fontsize=11, fontweight="bold",
    )  # fmt: skip
    _motion(panels[0], report)
    _cloud(panels[1], report)
    _torque(panels[2], report)
    _bars(panels[3], "share of the RMS torque", report.torque_rms_by, "N m")
    _power(panels[4], report)
    _bars(panels[5], "energy lost in a cycle", report.duty.energy_lost_by, "J")
    return figure


def panels(report: DutyReport) -> Figure:
    """Motion, torque, power and torque over speed for a page of a report, without a caption."""
    figure = Figure(figsize=_PAGE, layout="constrained")
    places: Any = figure.subplots(2, 2)
    for panel, draw in zip(places.ravel(), (_motion, _cloud, _torque, _power), strict=True):
        draw(panel, report)
    return figure


def caption(report: DutyReport) -> str:
    """The verdicts of a duty, and what the panels show."""
    said = ". ".join(record.text for record in duty_verdicts.verdicts(report))
    return f"{said}. Torques are those of the motor, by mechanics; bars to the left act against the sum of the others."


def _motion(panel: Axes, report: DutyReport) -> None:
    states = report.duty.states
    speed = _MOTION["speed"]
    panel.plot(states.time, units.from_si(states.speed, speed), color=charts.BLUE, label="speed")
    panel.set(xlabel="time [s]", ylabel=f"speed [{speed.shown_in}]", title="motion")
    place = panel.twinx()
    length = _MOTION["stroke"]
    place.plot(states.time, units.from_si(states.position, length), color=charts.GREY, linestyle="--", label="position")
    place.set_ylabel(f"position [{length.shown_in}] (dashed)")
    place.grid(visible=False)


def _torque(panel: Axes, report: DutyReport) -> None:
    duty = report.duty
    for group, part in report.torque_by_cause.items():
        panel.plot(duty.states.time, part, color=CAUSE_COLOURS[group], linewidth=1.2, label=group)
    panel.plot(duty.states.time, duty.torque, color=charts.INK, label="motor")
    panel.axhline(duty.torque_rms, color=charts.GREY, linestyle=":", linewidth=1.0, label="RMS")
    panel.set(xlabel="time [s]", ylabel="torque [N m]", title="torque of the motor by cause")
    _legend_beside(panel)


def _power(panel: Axes, report: DutyReport) -> None:
    time, power = report.duty.states.time, report.duty.power
    panel.plot(time, power, color=charts.INK, linewidth=1.2)
    panel.fill_between(time, np.maximum(power, 0.0), color=charts.ORANGE, alpha=0.5, label="drawn")
    panel.fill_between(time, np.minimum(power, 0.0), color=charts.GREEN, alpha=0.5, label="returned")
    panel.set(xlabel="time [s]", ylabel="power [W]", title="power of the motor")
    panel.legend(fontsize=_LABEL_SIZE)


def _cloud(panel: Axes, report: DutyReport) -> None:
    duty = report.duty
    some = slice(None, None, -(-len(duty.torque) // _MOST_POINTS))
    speed = units.from_si(duty.motor_speed[some], _TURNING)
    panel.plot(speed, duty.torque[some], ".", color=charts.INK, markersize=4, label="cycle")
    if duty.starved:
        bath = duty.flooded.torque[some]
        panel.plot(speed, bath, "o", mfc="none", color=charts.BLUE, markersize=4, label="in a full bath of oil")
    if report.motor is not None:
        motor = report.motor.motor
        along = np.linspace(-float(motor.largest_speed), float(motor.largest_speed), _CURVE_POINTS)
        shown, peak = units.from_si(along, _TURNING), motor.peak_at(along)
        for sign in (1, -1):
            panel.plot(shown, sign * peak, color=charts.RED, label="peak" if sign > 0 else None)
            rated = sign * float(motor.rated_torque)
            panel.plot(
                shown, np.full_like(shown, rated), "--", color=charts.ORANGE, label="rated" if sign > 0 else None
            )
    panel.axhline(duty.torque_rms, color=charts.GREY, linestyle=":", linewidth=1.2, label="RMS of the cycle")
    panel.set(xlabel=f"speed of the motor [{_TURNING.shown_in}]", ylabel="torque [N m]", title="torque over speed")
    _legend_beside(panel)


def _legend_beside(panel: Axes) -> None:
    """A legend that hides no curve."""
    panel.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _bars(panel: Axes, title: str, parts: Mapping[str, float], unit: str) -> None:
    """Parts from the largest down; parts that are nothing are left out."""
    largest = max(map(abs, parts.values()), default=0.0)
    shown: Sequence[tuple[str, float]] = sorted(
        ((name, value) for name, value in parts.items() if abs(value) > _LEAST * largest),
        key=lambda part: -abs(part[1]),
    )
    places = np.arange(len(shown))
    panel.barh(places, [value for _, value in shown], color=[CAUSE_COLOURS[cause_of(name)] for name, _ in shown])
    panel.axvline(0, color=charts.GREY, linewidth=0.8)
    panel.set_yticks(places, [name for name, _ in shown])
    panel.tick_params(axis="y", length=0, labelsize=_LABEL_SIZE)
    panel.grid(visible=False, axis="y")
    panel.set_ylim(max(len(shown), 1) - 0.4, -0.6)
    panel.set(xlabel=f"[{unit}]", title=title)
