"""Figures of the effects for two screws: steps to the reference model, parts over speed, lead and load."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.shared import charts
from effect_study import curves
from effect_study.cases import Case, Effect, effects
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


#: The figures by name.
DRAWN: Mapping[str, Callable[[Cases], Figure]] = {
    "effects_steps": steps,
    "effects_parts_over_speed": parts_over_speed,
    "effects_models": models_over_speed_and_load,
    "effects_lead": parts_over_lead,
    "effects_light_load": light_load,
}
