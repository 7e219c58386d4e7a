"""Figures of the effects for two screws, and of the laws behind them.

Steps to the reference model, parts over speed, lead and load; slip over spin and in the contacts, rolling forces, load
shares.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.shared import charts
from effect_study import curves
from effect_study.cases import PAPER, RPM, Case, Effect, effects
from effect_study.cases import steps as reference_steps

Cases = Mapping[str, Case]

SPEED, TORQUE = "screw speed n (rpm)", "friction torque M$_S$ (N m)"
LOAD, LEAD = "axial load F (N)", "lead P$_h$ (mm)"
#: Parts of the torque, from bottom to top of a stack.
STACK: Mapping[str, str] = {
    mechanism: charts.MECHANISM_COLOURS[mechanism]
    for mechanism in (
        "ball_to_ball",
        "chain_braking",
        "elastic_hysteresis",
        "hydrodynamic_rolling",
        "curvature",
        "spin",
        "helix",
    )
}
MODEL_LINES: Mapping[str, tuple[str, Any, str]] = {
    "olaru2005": ("as printed", ":", charts.GREY),
    "corrected": ("corrected", "--", charts.ORANGE),
    "reference": ("reference", "-", charts.BLUE),
}


def mathtext(words: str) -> str:
    """Plain text with the indices of symbols as subscripts: ``d_m`` and the like."""
    return re.sub(r"(\w)_(\w+)", r"\1$_{\2}$", words)


def framed(
    panel: Axes, x: str, y: str, title: str = "", xlim: Any = None, ylim: Any = None, legend: str | None = None
) -> None:
    """Words on the axes of a panel, with the indices of symbols set low; its ends, and its legend."""
    panel.set(xlabel=mathtext(x), ylabel=mathtext(y), **({"title": mathtext(title)} if title else {}))
    panel.set(**{name: ends for name, ends in (("xlim", xlim), ("ylim", ylim)) if ends is not None})
    if legend is not None:
        panel.legend(loc=legend)


#: Spaces at which a caption must not break: in "F = 4000 N", "40 × 10", "1/z N".
_TIED = re.compile(
    r"(?<=[=×]) | (?=[=×])|(?<=\d) (?=(?:mm|N|rpm|GPa|Pa|1/GPa|balls)\b|°C)|(?<=1/z) |(?<=\bPa) (?=s\b)"
    r"|(?<=_\w) (?=\d)|(?<=\bf) (?=\d)|(?<=E′) "
)


def case_caption(cases: Cases, words: str, varied: Sequence[str] = ()) -> str:
    """Caption of a figure: its description and the cases of the panels, without the quantities that vary."""
    captions = " ".join(f"{case.title[0].upper()}{case.title[1:]}: {case.caption(*varied)}" for case in cases.values())
    return mathtext(_TIED.sub("\N{NO-BREAK SPACE}", f"{words} {captions}"))


def titled(panels: Sequence[Axes], cases: Cases) -> list[tuple[Axes, Case]]:
    """Each panel with its case, titled."""
    pairs = list(zip(panels, cases.values(), strict=True))
    for panel, case in pairs:
        panel.set_title(case.title)
    return pairs


def _label(panels: Sequence[Axes], x: str, y: str) -> None:
    for panel in panels:
        framed(panel, x, y)


def _upward_legend(panel: Axes, **options: Any) -> None:
    """A legend in the order of the stack, its top first."""
    handles, labels = panel.get_legend_handles_labels()
    panel.legend(handles[::-1], labels[::-1], **options)


def _legend_above(figure: Figure, panel: Axes) -> None:
    """The legend of a panel above all of them."""
    figure.legend(*panel.get_legend_handles_labels(), loc="outside upper center", ncols=4)


def _stack(panel: Axes, x: Any, result: FrictionResult, total: Any = 1.0) -> None:
    """The parts of the torque over ``x``, in units of ``total``."""
    panel.stackplot(
        x,
        [np.asarray(result.contributions[mechanism]) / total for mechanism in STACK],
        labels=[MECHANISMS[mechanism] for mechanism in STACK],
        colors=tuple(STACK.values()),
        linewidth=0,
    )


# -- the steps ------------------------------------------------------------------------------------


def steps(cases: Cases) -> Figure:
    """The parts of the torque after each effect, from the corrected paper down to the reference model."""
    caption = case_caption(
        cases,
        "Reference model built up: each bar has all effects above it; at its end the torque, and what the effect adds.",
    )
    figure, panels = charts.new_figure(caption, height=3.9, sharey=True)
    for panel, case in titled(panels, cases):
        found = effects(case)
        _bars(panel, found)
        panel.set_xlim(0, 1.32 * max(effect.torque for effect in found))
    names = [mathtext(step.short) for step in reference_steps()]
    panels[0].set_yticks(range(len(names)), names)
    panels[0].invert_yaxis()
    for panel in panels:
        panel.grid(visible=False, axis="y")
        panel.set_xlabel(TORQUE)
    _legend_above(figure, panels[1])
    return figure


def _bars(panel: Axes, found: Sequence[Effect]) -> None:
    rows = range(len(found))
    left = np.zeros(len(found))
    for mechanism, colour in STACK.items():
        widths = np.array([effect.parts[mechanism] for effect in found])
        panel.barh(rows, widths, left=left, height=0.66, color=colour, label=MECHANISMS[mechanism])
        left = left + widths
    for row, effect in enumerate(found):
        added = f"  {effect.added:+.3f}".replace("-", "−") if row else ""
        panel.text(effect.torque, row, f" {effect.torque:.3f}{added}", va="center", ha="left", fontsize=9)


# -- over speed -----------------------------------------------------------------------------------


def parts_over_speed(cases: Cases) -> Figure:
    """The parts of the torque over speed, reference model."""
    figure, panels = charts.new_figure(case_caption(cases, "Reference model.", ["screw_speed"]))
    for panel, case in titled(panels, cases):
        speed, results = curves.over_speed(case)
        result = results["reference"]
        _stack(panel, speed, result)
        panel.plot(speed, result.screw_torque, color=charts.INK, label="total")
        panel.set(xlim=(0, 3000), ylim=(0, 1.5 * float(np.max(result.screw_torque))))
        _upward_legend(panel, loc="upper left", ncols=2)
    _label(panels, SPEED, TORQUE)
    return figure


# -- three models ---------------------------------------------------------------------------------


def models_over_speed_and_load(cases: Cases) -> Figure:
    """The torque of the three models over speed and over load."""
    caption = case_caption(cases, "Above over speed, at the load stated; below over load, at the speed stated.")
    figure, panels = charts.new_figure(caption, rows=2, height=2.9)
    for row, x, of in ((panels[:2], SPEED, curves.over_speed), (panels[2:], LOAD, curves.over_load)):
        for panel, case in titled(row, cases):
            abscissa, results = of(case)
            for name, (words, line, colour) in MODEL_LINES.items():
                panel.plot(abscissa, results[name].screw_torque, ls=line, color=colour, label=words)
            panel.set(xlim=(0, float(abscissa[-1])), ylim=(0, None))
        _label(row, x, TORQUE)
    charts.shared_legend(panels, loc="lower right")
    return figure


# -- over lead ------------------------------------------------------------------------------------


def parts_over_lead(cases: Cases) -> Figure:
    """The parts of the torque over the lead, reference model: the helix dominates at large leads."""
    words = (
        "Reference model; the lead varies from a twentieth of d_m, or where the balls have room, to d_m. Dotted: the "
        "screw's own lead."
    )
    figure, panels = charts.new_figure(case_caption(cases, words))
    for panel, case in titled(panels, cases):
        lead, result = curves.over_lead(case)
        _stack(panel, lead * 1e3, result)
        panel.plot(lead * 1e3, result.screw_torque, color=charts.INK, label="total")
        own = float(case.screw.lead)
        height = float(np.interp(own, lead, np.asarray(result.screw_torque)))
        panel.vlines(own * 1e3, 0, height, color=charts.INK, linestyle=":", linewidth=1.2)
        panel.set(xlim=(lead[0] * 1e3, lead[-1] * 1e3), ylim=(0, 1.45 * float(np.max(result.screw_torque))))
        _upward_legend(panel, loc="upper left", ncols=2)
    _label(panels, LEAD, TORQUE)
    return figure


# -- over load ------------------------------------------------------------------------------------


def light_load(cases: Cases) -> Figure:
    """The parts of the torque over six decades of load, and the loads at which the ball skids."""
    words = (
        "Above, the parts of the reference model in units of its torque; below, the torque of three models, where "
        "those of the paper ask for more than friction can give. Shaded: the ball skids; striped: the film is "
        "nearer rigid than elastic, M < 6.6."
    )
    figure, panels = charts.new_figure(case_caption(cases, words, ["axial_load"]), rows=2, height=2.9)
    for shares, torques, case in zip(panels[:2], panels[2:], cases.values(), strict=True):
        load, results = curves.over_light_load(case)
        result = results["reference"]
        _stack(shares, load, result, result.screw_torque)
        shares.plot(load, result.rolling_share, color=charts.INK, label="share of rolling carried")
        for name, (label, line, colour) in MODEL_LINES.items():
            torques.loglog(load, results[name].screw_torque, ls=line, color=colour, label=label)
        skids, rigid = (curves.largest_flagged_load(case, reason) for reason in ("skid", "elastic_regime"))
        for panel in (shares, torques):
            panel.set(title=case.title, xscale="log", xlim=(load[0], load[-1]))
            panel.axvspan(load[0], skids, facecolor=charts.GREY, alpha=0.35, zorder=2.5, label="the ball skids")
            panel.axvspan(skids, rigid, facecolor="none", edgecolor=charts.GREY, hatch="//", linewidth=0, zorder=2.5)
        shares.set_ylim(0, 1)
    _label(panels[:2], LOAD, "share of torque (1)")
    _label(panels[2:], LOAD, TORQUE)
    _legend_above(figure, panels[0])
    panels[2].legend(loc="lower right")
    return figure


# -- slip over spin -------------------------------------------------------------------------------


def slip_over_spin(cases: Cases) -> Figure:
    """Curvature and spin moment, and the slip power they make, over the spin parameter."""
    words = (
        "Slip on the line across the contact, no net force. Dashed, in the same colours: the polynomials of Houpert "
        "1999, made for E_s up to 1. Dotted: from there on one line of pure rolling is left. Circles: the screw "
        "contacts with half of the spin, before the ball finds its balance."
    )
    figure, panels = charts.new_figure(case_caption(cases, words))
    found = curves.spin_curves()
    moments, powers = panels
    E_s = found.spin_parameter
    for words, closed, polynomial, colour in (
        ("curvature moment", found.curvature, found.curvature_polynomial, charts.ORANGE),
        ("spin moment", found.spin, found.spin_polynomial, charts.RED),
    ):
        moments.plot(E_s, closed, color=colour, label=words)
        moments.plot(E_s, polynomial, "--", color=colour, linewidth=1.2)
    moments.set(ylim=(-0.25, 2.25), ylabel="moment / its largest value (1)", title="moments")
    powers.stackplot(
        E_s,
        [found.curvature_power, found.spin_power],
        labels=["curvature slip", "spin slip"],
        colors=(charts.ORANGE, charts.RED),
        linewidth=0,
    )
    total = found.curvature_power + found.spin_power
    powers.plot(E_s, total, color=charts.INK, label="slip power")
    for case in cases.values():
        at = half_spin_parameter(case)
        height = float(np.interp(at, E_s, total))
        powers.plot(at, height, "o", color="white", markeredgecolor=charts.INK, markersize=6)
        powers.annotate(
            case.title,
            (at, height),
            xytext=(10, -6),
            textcoords="offset points",
            ha="left",
            fontsize=9,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.9, "boxstyle": "round,pad=0.2"},
        )
    powers.set(ylabel="slip power / that of curvature alone (1)", title="power", ylim=(0, None))
    at_one_line = float(np.interp(found.one_line_from, E_s, total))
    for panel, bottom, top in ((moments, -0.25, 1.0), (powers, 0.0, at_one_line)):
        panel.vlines(found.one_line_from, bottom, top, color=charts.INK, linestyle=":", linewidth=1.2)
        panel.set(xlim=(0, 2.5), xlabel="spin parameter E$_s$ (1)")
        panel.legend(loc="upper left")
    return figure


def half_spin_parameter(case: Case) -> float:
    """Spin parameter of the screw contact with half of the ball's spin."""
    contact = case.result(curves.MODELS["reference"]).screw
    return float(contact.spin_parameter * contact.motion.spin / contact.spin)


# -- slip in the contacts -------------------------------------------------------------------------


def slip_fields(cases: Cases) -> Figure:
    """Slip over both contacts of both screws: size, direction, and lines of pure rolling."""
    words = (
        "Reference model; slip of race against ball. Colour: its size; arrows: its direction and size; dashed: no "
        "slip along the path. The ellipses are drawn wider along the path than they are."
    )
    figure, panels = charts.new_figure(case_caption(cases, words), rows=2, height=2.75)
    for row, case in zip((panels[:2], panels[2:]), cases.values(), strict=True):
        result = case.result(curves.MODELS["reference"])
        fastest = max(_speeds(result, on_screw).max() for on_screw in (True, False))
        images: list[Any] = []
        for panel, on_screw in zip(row, (True, False), strict=True):
            images.append(_slip_field(panel, result, on_screw, fastest))
            framed(
                panel,
                "across the path (mm)",
                "along the path (mm)",
                f"{case.title}: ball on {'screw' if on_screw else 'nut'}",
            )
        bar = figure.colorbar(images[-1], ax=list(row), pad=0.02, aspect=14)
        bar.set_label("slip (mm/s)")
    return figure


def _grid(points: int) -> tuple[Any, Any]:
    across, along = np.meshgrid(np.linspace(-1, 1, points), np.linspace(-1, 1, points))
    return across, along


def _speeds(result: FrictionResult, on_screw: bool) -> Any:
    """Size of the slip over the contact, mm/s; nothing outside the ellipse."""
    across, along = _grid(121)
    picture = curves.slip_picture(result, on_screw, across, along)
    speed = np.hypot(picture.slip_along, picture.slip_across) * 1e3
    return np.ma.masked_where(across**2 + along**2 > 1.02, speed)


def _slip_field(panel: Axes, result: FrictionResult, on_screw: bool, fastest: float) -> Any:
    contact = result.screw if on_screw else result.nut
    a, b = float(contact.semi_major_axis) * 1e3, float(contact.semi_minor_axis) * 1e3
    outline = Ellipse((0, 0), 2 * a, 2 * b, facecolor="none", edgecolor=charts.INK, linewidth=1.3, zorder=3)
    panel.add_patch(outline)
    image = panel.imshow(
        _speeds(result, on_screw),
        extent=(-a, a, -b, b),
        origin="lower",
        aspect="auto",
        cmap="YlOrBr",
        vmin=0,
        vmax=1.15 * fastest,
        interpolation="bilinear",
    )
    image.set_clip_path(outline)
    across = np.concatenate([np.linspace(-0.88, 0.88, 9) * width for width in (0.72, 1.0, 0.72)])
    along = np.repeat([-0.55, 0.0, 0.55], 9)
    picture = curves.slip_picture(result, on_screw, across, along)
    panel.quiver(
        across * a,
        along * b,
        picture.slip_across * 1e3,
        picture.slip_along * 1e3,
        angles="uv",
        pivot="mid",
        scale=1.8 * fastest,
        scale_units="inches",
        units="inches",
        width=0.016,
        color=charts.INK,
        zorder=4,
    )
    heights = np.linspace(-1, 1, 4001)
    path = curves.slip_picture(result, on_screw, heights, 0 * heights).slip_along
    for height in heights[1:][np.diff(np.sign(path)) != 0]:
        half = b * float(np.sqrt(1 - height**2))
        panel.plot([height * a] * 2, [-half, half], color=charts.INK, linestyle="--", linewidth=1, zorder=3)
    panel.set(xlim=(-1.12 * a, 1.12 * a), ylim=(-1.25 * b, 1.25 * b))
    panel.grid(visible=False)
    return image


# -- rolling forces -------------------------------------------------------------------------------

_LAW_LINES = (("-", charts.BLUE), ("-.", charts.GREEN), ("--", charts.ORANGE), (":", charts.PURPLE))


def rolling_laws(cases: Cases) -> Figure:
    """Rolling forces by law, relative to the reference law, over load and speed; faint outside their range."""
    words = (
        "Rolling force at the screw contact of the paper's screw, inlet cool, in units of the force by Biboulet and "
        "Houpert. Faint: the contact is nearer rigid than elastic (M < 6.6), where these laws were not made. "
        "Aihara's is a law for rollers, taken for a roller as long as the ellipse, with its own heating."
    )
    caption = case_caption({"paper": cases["paper"]}, words, ["axial_load", "screw_speed"])
    figure, panels = charts.new_figure(caption, sharey=True)
    over_load, over_speed = curves.rolling_over_load(), curves.rolling_over_speed()
    for panel, found, scale, x in (
        (panels[0], over_load, 1.0, "contact load Q of a ball (N)"),
        (panels[1], over_speed, RPM, "screw speed n (rpm)"),
    ):
        base = found.forces["Biboulet and Houpert 2010"]
        for (name, force), (line, colour) in zip(found.forces.items(), _LAW_LINES, strict=True):
            ratio = force / base
            within = found.elastic if name in curves.ELASTIC_ONLY else np.ones_like(found.elastic)
            panel.plot(found.abscissa / scale, ratio, ls=line, color=colour, alpha=0.3, linewidth=1.2)
            panel.plot(found.abscissa / scale, np.where(within, ratio, np.nan), ls=line, color=colour, label=name)
        panel.set(xscale="log", xlabel=x, ylabel="rolling force / that of the reference (1)", ylim=(0, 1.75))
    at = PAPER.result(curves.MODELS["reference"])
    panels[0].set_title(f"over load, at {PAPER.screw_speed / RPM:.0f} rpm")
    panels[1].set_title(f"over speed, at {float(at.contact_load):.0f} N a ball")
    panels[0].legend(loc="upper left")
    panels[1].legend(loc="lower left")
    return figure


# -- load shares ----------------------------------------------------------------------------------


def load_shares(cases: Cases) -> Figure:
    """Load share of the asperities, and the friction coefficient, over the film parameter."""
    words = (
        "Left, laws for the share of the load that asperities carry, Greenwood and Tripp's at the pressure of the "
        "paper's screw. Right, friction coefficients with B 1.42, C 0.8; the film alone has 0.02. Dotted: λ at the "
        "screw contact of the paper's screw."
    )
    figure, panels = charts.new_figure(case_caption({"paper": cases["paper"]}, words))
    found = curves.share_curves()
    lines = zip(found.shares.items(), (*charts.GROWING[:4], charts.GREEN, charts.ORANGE), strict=True)
    for index, ((name, share), colour) in enumerate(lines):
        line = charts.LINE_STYLES[index % 5]
        panels[0].plot(found.film_parameter, share, ls=line, color=colour, label=name)
    looks = (("--", charts.ORANGE), ("-.", charts.PURPLE), (":", charts.GREEN), ("-", charts.BLUE))
    for (name, mu), (line, colour) in zip(found.coefficients.items(), looks, strict=True):
        panels[1].plot(found.film_parameter, mu, ls=line, color=colour, label=mathtext(name))
    at = float(PAPER.result(curves.MODELS["reference"]).screw.film_parameter)
    for panel, title, y in zip(
        panels, ("load share of the asperities", "friction coefficient"),
        ("share of the asperities w (1)", "friction coefficient µ$_m$ (1)"), strict=True,
    ):  # fmt: skip
        panel.axvline(at, color=charts.GREY, linestyle=":", linewidth=1.2)
        framed(panel, "film parameter λ (1)", y, title, xlim=(0, 4), ylim=(0, None))
        panel.legend(loc="upper right", fontsize=8)
    return figure


#: The figures by name.
DRAWN: Mapping[str, Callable[[Cases], Figure]] = {
    "effects_steps": steps,
    "effects_parts_over_speed": parts_over_speed,
    "effects_models": models_over_speed_and_load,
    "effects_lead": parts_over_lead,
    "effects_light_load": light_load,
    "effects_slip_over_spin": slip_over_spin,
    "effects_slip_fields": slip_fields,
    "effects_rolling_laws": rolling_laws,
    "effects_load_shares": load_shares,
}
