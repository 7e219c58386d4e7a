"""Drawings of one ball, computed: its forces and moments (Figs 2 and 3), and the slip in a contact (Fig. 4).

Every arrow has the length of what it stands for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Ellipse, FancyArrowPatch, Rectangle
from matplotlib.ticker import MaxNLocator

from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.physics.equations import kinematics
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.reproduce.figure import LABELS, MEANING, TITLES
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.charts import Columns, Plot

Results = Mapping[str, FrictionResult]

#: Degrees of arc for the greatest moment, and units of drawing for the greatest force.
_GREATEST_ARC, _GREATEST_ARROW = 150.0, 1.25
_CASE = (
    "Screw d$_m$ 40 mm, lead 5 mm, d$_w$ 3.175 mm, 56 balls, 45°; F = 4000 N, n = 600 rpm, viscosity 0.1 Pa s, "
    "F$_B$ = 1/z N. Assumed: E′ 226 GPa, α$_p$ 22 1/GPa. "
    f"{MEANING}"
)


class Arrow(NamedTuple):
    """A force or moment on the ball: symbol, words, signed value, and colour."""

    symbol: str
    words: str
    value: float
    colour: str


def drawn_results() -> Results:
    """The operating point of the drawings, for each model."""
    known = case.models()
    return {
        name: known[name](case.SCREW, case.OIL, axial_load=case.AXIAL_LOAD, screw_speed=case.SCREW_SPEED)
        for name in TITLES
    }


def forces(result: FrictionResult) -> list[Arrow]:
    """Forces on the ball along its path, N; positive in the direction of rolling. They add up to zero."""
    s, n = result.screw, result.nut
    return [
        Arrow("F$_{Ss}$", "sliding, screw", float(s.sliding_force), charts.BLUE),
        Arrow("F$_{Rs}$", "rolling, screw", -float(s.hydrodynamic_rolling_force), charts.SKY),
        Arrow("F$_{Ps}$", "pressure, screw", float(s.pressure_force), charts.GREEN),
        Arrow("F$_{Pn}$", "pressure, nut", -float(n.pressure_force), charts.YELLOW),
        Arrow("F$_{Rn}$", "rolling, nut", float(n.hydrodynamic_rolling_force), charts.ORANGE),
        Arrow("F$_{Sn}$", "sliding, nut", -float(n.sliding_force), charts.RED),
        Arrow("F$_B$", "between balls", -float(result.ball_chain.braking_force), charts.PURPLE),
    ]


def moments(result: FrictionResult) -> list[Arrow]:
    """Moments on the ball about its centre, mN mm; positive in the sense of rolling. They add up to zero."""
    s, n, radius = result.screw, result.nut, result.ball_screw.ball_diameter / 2
    million = 1e6
    return [
        Arrow(
            "(F$_{Ss}$−F$_{Rs}$) d$_w$/2",
            "screw",
            float((s.sliding_force - s.hydrodynamic_rolling_force) * radius * million),
            charts.BLUE,
        ),
        Arrow(
            "(F$_{Sn}$−F$_{Rn}$) d$_w$/2",
            "nut",
            float((n.sliding_force - n.hydrodynamic_rolling_force) * radius * million),
            charts.RED,
        ),
        Arrow("M$_{Cs}$", "curvature, screw", -float(s.curvature_friction_moment * million), charts.ORANGE),
        Arrow("M$_{Cn}$", "curvature, nut", -float(n.curvature_friction_moment * million), charts.YELLOW),
        Arrow("M$_{ERs}$", "elastic, screw", -float(s.elastic_resistance_moment * million), charts.GREEN),
        Arrow("M$_{ERn}$", "elastic, nut", -float(n.elastic_resistance_moment * million), charts.SKY),
        Arrow("M$_B$", "between balls", -float(result.ball_chain.moment * million), charts.PURPLE),
    ]


def _scene(panel: Axes) -> None:
    """The ball between nut (above) and screw (below), its neighbours hinted at."""
    panel.set_aspect("equal")
    panel.set_xlim(-2.35, 2.35)
    panel.set_ylim(-1.45, 1.45)
    panel.axis("off")
    for bottom, words, height in ((1.0, "nut", 1.2), (-1.4, "screw →", -1.2)):
        panel.add_patch(Rectangle((-2.35, bottom), 4.7, 0.4, facecolor=charts.LIGHT_SHADE, edgecolor="none"))
        panel.text(-2.28, height, words, ha="left", va="center", fontsize=8.5, color=charts.GREY)
    for edge in (1.0, -1.0):
        panel.plot([-2.35, 2.35], [edge, edge], color=charts.GREY, linewidth=1)
    for x in (-2.0, 2.0):
        panel.add_patch(Circle((x, 0), 1.0, fill=False, edgecolor="#BBBBBB", linestyle="--", linewidth=1))
    panel.add_patch(Circle((0, 0), 1.0, facecolor="white", edgecolor=charts.INK, linewidth=1.3))


def _arrow(panel: Axes, start: Sequence[float], end: Sequence[float], colour: str) -> None:
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    panel.add_patch(
        FancyArrowPatch(
            (start[0], start[1]),
            (end[0], end[1]),
            arrowstyle="-|>",
            mutation_scale=9.0 if length > 0.15 else 5.4,
            shrinkA=0,
            shrinkB=0,
            linewidth=2.2,
            color=colour,
            zorder=3,
        )
    )


def _budget(panel: Axes, arrows: Sequence[Arrow], furthest: float, xlabel: str, digits: int) -> None:
    """The arrows end to end, as bars: they come back to zero."""
    tail = 0.0
    for row, arrow in enumerate(arrows):
        head = tail + arrow.value
        panel.add_patch(Rectangle((min(tail, head), row - 0.3), abs(arrow.value), 0.6, color=arrow.colour, zorder=2))
        panel.plot(
            [head, head], [row - 0.3, row + (1.3 if arrow is not arrows[-1] else 0.3)], color=charts.GREY, lw=0.8
        )
        tail = head
    panel.axvline(0, color=charts.INK, linewidth=1)
    panel.set_xlim(-1.1 * furthest, 1.06 * furthest)
    panel.set_ylim(len(arrows) - 0.4, -0.6)
    panel.set_yticks([])
    panel.spines["left"].set_visible(False)
    # the left half is for the words
    panel.set_xticks([tick for tick in MaxNLocator(4).tick_values(0, furthest) if 0 <= tick <= furthest * 1.06])
    for row, arrow in enumerate(arrows):
        number = f"{round(arrow.value, digits):+.{digits}f}".replace("-", "−")
        panel.text(-1.1 * furthest, row, f"{arrow.symbol}  {arrow.words}", ha="left", va="center", fontsize=9)
        panel.text(-0.03 * furthest, row, number, ha="right", va="center", fontsize=9)
    panel.set_xlabel(xlabel)


def _furthest(every: Mapping[str, Sequence[Arrow]]) -> float:
    """Reach of the bars over all panels, which share one scale."""
    return max(float(np.max(np.cumsum([a.value for a in arrows]))) for arrows in every.values())


def _two_rows(caption: str) -> tuple[Figure, list[Axes]]:
    return charts.new_figure(caption, rows=2, height=2.9)


def forces_on_ball(results: Results) -> Figure:
    """Fig. 2, to scale: forces on the ball along its path, and their balance."""
    caption = (
        f"{_CASE} Forces along the path, all drawn to one scale; those of pressure pass through the ball's centre. "
        "Below, end to end: they come back to zero. Corrected, a curved chain adds a little to F$_B$."
    )
    figure, panels = _two_rows(caption)
    every = {name: forces(result) for name, result in results.items()}
    scale = _GREATEST_ARROW / max(abs(a.value) for arrows in every.values() for a in arrows)
    # where each arrow begins, and where its label stands beside the tip
    places = {
        "F$_{Ss}$": (0.0, -1.0, -0.2), "F$_{Rs}$": (0.0, -1.0, -0.2),
        "F$_{Ps}$": (0.0, 0.0, 0.17), "F$_{Pn}$": (0.0, 0.0, 0.17),
        "F$_{Rn}$": (0.0, 1.0, 0.2), "F$_{Sn}$": (0.0, 1.0, 0.2),
    }  # fmt: skip
    for (name, arrows), drawing, budget in zip(every.items(), panels[:2], panels[2:], strict=True):
        _scene(drawing)
        drawing.set_title(TITLES[name])
        for arrow in arrows:
            length = arrow.value * scale
            if arrow.symbol in places:
                x, y, above = places[arrow.symbol]
                _arrow(drawing, (x, y), (x + length, y), arrow.colour)
                drawing.text(
                    x + length * 0.62, y + above, arrow.symbol, ha="center", va="center", fontsize=9.5, zorder=4
                )
            else:
                # the ball in front holds this one back, where the two touch
                _arrow(drawing, (1.0 - length, 0.0), (1.0, 0.0), arrow.colour)
                drawing.text(1.18, 0.2, arrow.symbol, ha="center", va="center", fontsize=9.5)
        drawing.plot([2.2 - 0.1 * scale, 2.2], [1.2, 1.2], color=charts.INK, linewidth=1.5)
        drawing.text(2.12 - 0.1 * scale, 1.2, "0.1 N", ha="right", va="center", fontsize=8.5)
        _budget(budget, arrows, _furthest(every), "force on the ball, end to end (N)", 4)
    return figure


def moments_on_ball(results: Results) -> Figure:
    """Fig. 3, to scale: moments on the ball about its centre, and their balance."""
    caption = (
        f"{_CASE} Moments about the centre of the ball; the angle of each arc is in proportion to its moment. "
        "Below, end to end: they come back to zero."
    )
    figure, panels = _two_rows(caption)
    every = {name: moments(result) for name, result in results.items()}
    scale = _GREATEST_ARC / max(abs(a.value) for arrows in every.values() for a in arrows)
    # radius of the arc, and the angle at which it begins: at the screw below, at the nut above
    places = ((0.34, -90.0), (0.34, 90.0), (0.84, -90.0), (0.84, 90.0), (0.6, -90.0), (0.6, 90.0), (0.92, 0.0))
    for (name, arrows), drawing, budget in zip(every.items(), panels[:2], panels[2:], strict=True):
        _scene(drawing)
        drawing.set_title(TITLES[name])
        for arrow, (radius, begin) in zip(arrows, places, strict=True):
            _arc(drawing, radius, begin, arrow.value * scale, arrow.colour)
        for arrow, (x, y) in zip(
            arrows[2:], ((-0.93, -0.72), (0.93, 0.72), (0.28, -0.64), (-0.26, 0.64), (1.2, 0.14)), strict=True
        ):
            drawing.text(x, y, arrow.symbol, ha="center", va="center", fontsize=9, zorder=4)
        drawing.text(0.0, 0.0, "drive", ha="center", va="center", fontsize=8.5, color=charts.GREY)
        _budget(budget, arrows, _furthest(every), "moment on the ball, end to end (mN mm)", 1)
    return figure


def _arc(panel: Axes, radius: float, begin: float, sweep: float, colour: str) -> None:
    """An arc about the centre with a head at its end; positive sweep is the sense of rolling."""
    angles = np.radians(np.linspace(begin, begin + sweep, 60))
    x, y = radius * np.cos(angles), radius * np.sin(angles)
    panel.plot(x, y, color=colour, linewidth=2.4, solid_capstyle="butt", zorder=3)
    small = abs(sweep) < 15
    panel.annotate(
        "",
        (x[-1], y[-1]),
        (x[-4], y[-4]),
        arrowprops={
            "arrowstyle": "-|>",
            "color": colour,
            "mutation_scale": 6 if small else 13,
            "linewidth": 0,
            "shrinkA": 0,
            "shrinkB": 0,
        },
    )


def slip_in_contact(results: Results) -> Figure:
    """Fig. 4, computed: slip over the contact ellipse at the screw, and the lines of pure rolling."""
    caption = (
        f"{_CASE} Contact of ball and screw; slip along the direction of rolling from the curvature of the contact, "
        "no spin; positive: the ball's surface is the faster one. Dashed: lines of pure rolling at ±Y a. The ellipse "
        "is drawn wider than it is along the direction of rolling."
    )
    figure, panels = charts.new_figure(caption, rows=2, height=2.7, sharex=True, sharey="row")
    for (name, result), ellipse, profile in zip(results.items(), panels[:2], panels[2:], strict=True):
        ellipse.set_title(f"{LABELS[name]}: Y = {float(result.screw.pure_rolling_offset):.4f}")
        _slip_map(ellipse, result)
        a, c, y, slip = _slip(result)
        profile.axhline(0, color=charts.GREY, linewidth=0.8)
        profile.fill_between(y, slip, where=slip >= 0, color=charts.SKY, alpha=0.5, linewidth=0)
        profile.fill_between(y, slip, where=slip <= 0, color=charts.ORANGE, alpha=0.5, linewidth=0)
        profile.plot(y, slip, color=charts.INK)
        for line in (-c, c):
            profile.axvline(line, color=charts.INK, linestyle="--", linewidth=1)
        profile.set_xlabel("across the rolling direction y (mm)")
        profile.set_ylabel("sliding speed u$_s$ (mm/s)")
        profile.tick_params(labelleft=True)
        ellipse.tick_params(labelleft=True, labelbottom=True)
        ellipse.set_ylabel("along rolling x (mm)")
        ellipse.set_xlim(-1.12 * a, 1.12 * a)
    return figure


def _slip(result: FrictionResult) -> tuple[float, float, Any, Any]:
    """Semi-major axis, line of pure rolling, positions (mm) and sliding speeds (mm/s) at the screw."""
    side = result.screw
    a = float(side.semi_major_axis)
    c = float(side.pure_rolling_offset) * a
    y = np.linspace(-a, a, 401)
    slip = kinematics.curvature_sliding_speed(result.entrainment_speed, side.rolling_radius, side.deformed_radius, y, c)
    return a * 1e3, c * 1e3, y * 1e3, slip * 1e3


def _slip_map(panel: Axes, result: FrictionResult) -> None:
    """The ellipse, its zones of forward and backward slip, and arrows as long as the slip."""
    a, c, y, slip = _slip(result)
    b = float(result.screw.semi_minor_axis) * 1e3
    outline = Ellipse((0, 0), 2 * a, 2 * b, facecolor="none", edgecolor=charts.INK, linewidth=1.3, zorder=4)
    panel.add_patch(outline)
    for left, right, colour in ((-a, -c, charts.ORANGE), (-c, c, charts.SKY), (c, a, charts.ORANGE)):
        zone = Rectangle((left, -b), right - left, 2 * b, facecolor=colour, alpha=0.3, edgecolor="none")
        panel.add_patch(zone)
        zone.set_clip_path(outline)
    scale = 1.15 * b / float(np.max(np.abs(slip)))
    for position in np.arange(-0.95, 0.951, 0.1) * a:
        length = float(np.interp(position, y, slip)) * scale
        panel.annotate(
            "",
            (position, length),
            (position, 0.0),
            arrowprops={
                "arrowstyle": "-|>",
                "color": charts.BLUE if length > 0 else charts.RED,
                "mutation_scale": 7,
                "linewidth": 1.3,
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
    for line in (-c, c):
        panel.plot([line, line], [-1.3 * b, 1.3 * b], color=charts.INK, linestyle="--", linewidth=1)
    panel.set_ylim(-1.3 * b, 1.3 * b)
    panel.set_xlabel("across the rolling direction y (mm)")


def _arrow_table(read: Callable[[FrictionResult], list[Arrow]], unit: str) -> Callable[[Results], Columns]:
    def table(results: Results) -> Columns:
        every = {name: read(result) for name, result in results.items()}
        first = next(iter(every.values()))
        plain = str.maketrans("", "", "${}")
        columns: dict[str, Any] = {
            "symbol": [arrow.symbol.translate(plain) for arrow in first],
            "on the ball": [arrow.words for arrow in first],
        }
        return columns | {f"{name} ({unit})": [arrow.value for arrow in arrows] for name, arrows in every.items()}

    return table


def _slip_table(results: Results) -> Columns:
    columns: dict[str, Any] = {}
    for name, result in results.items():
        _, _, y, slip = _slip(result)
        columns[f"position across, {name} (mm)"] = y
        columns[f"sliding speed, {name} (mm/s)"] = slip
    return columns


PLOTS = (
    Plot("fig2_forces_on_ball", forces_on_ball, _arrow_table(forces, "N")),
    Plot("fig3_moments_on_ball", moments_on_ball, _arrow_table(moments, "mN mm")),
    Plot("fig4_slip_in_contact", slip_in_contact, _slip_table),
)
