"""Figures of the pages on theory: slip, balance, efficiency, the nut, its life, and the repairs of the paper."""

from __future__ import annotations

import dataclasses

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ballscrew.evidence.papers.olaru2005.closures import repairs
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.equations import life, nut_losses, slip, transmission
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.solvers.line_slip import creep_of_lines, pure_rolling_lines
from ballscrew.questions.shared import charts
from effect_study.cases import CASES, CATALOGUE, PAPER, RPM
from effect_study.curves import over_lead
from effect_study.effect_figures import case_caption, framed, mathtext

REFERENCE = FrictionModel.reference()
CELSIUS = 273.15


def slip_lines() -> Figure:
    """Slip across the contact for increasing spin, and the lines of pure rolling."""
    figure, (profile, lines) = charts.new_figure(
        mathtext(
            "Slip on the line across the contact, from curvature (C at the rim) and spin (E_s times as much), with the "
            "creep at which no net force is left. Right: where the slip is zero, without a net force and with half of "
            "the greatest."
        )
    )
    t = np.linspace(-1, 1, 201)
    for E_s, colour, line in zip((0.0, 0.5, 1.0, 1.5), charts.GROWING, charts.LINE_STYLES, strict=False):
        found = pure_rolling_lines(np.asarray(E_s), np.asarray(0.0))
        creep = float(creep_of_lines(found, 1.0, E_s))
        profile.plot(
            t, slip.path_slip_speed(creep, E_s, 1.0, t, t**2), color=colour, ls=line, label=mathtext(f"E_s = {E_s:g}")
        )
        at = [float(found.upper), *([float(found.lower)] if found.are_two else [])]
        profile.plot(at, [0.0] * len(at), "o", color=colour, markersize=5)
    profile.axhline(0, color=charts.GREY, linewidth=0.9)
    framed(
        profile,
        "height in the contact t = y/a (1)",
        "slip s/C (1)",
        "Slip with spin",
        xlim=(-1, 1),
        legend="upper left",
    )
    profile.set_xticks([-1, -0.5, 0, 0.5, 1])
    spin = np.linspace(0, 2.5, 501)
    for T, colour, line in ((0.0, charts.BLUE, "-"), (0.5, charts.RED, "--")):
        found = pure_rolling_lines(spin, np.full_like(spin, T))
        lines.plot(spin, found.upper, color=colour, ls=line, label=f"T = {T:g}")
        lines.plot(spin, np.where(found.are_two, found.lower, np.nan), color=colour, ls=line)
    framed(
        lines,
        "spin parameter E_s (1)",
        "heights of pure rolling (1)",
        "Two lines, then one",
        xlim=(0, 2.5),
        ylim=(-1.05, 1.05),
        legend="upper right",
    )
    return figure


def power() -> Figure:
    """Input power against dissipated power, by model."""
    figure, panels = charts.new_figure(
        case_caption(
            CASES,
            "Black: what friction takes from the shaft, its torque times the speed. Coloured: what the mechanisms "
            "dissipate, each from its own forces and speeds. Beside them: the difference.",
        ),
        height=3.4,
    )
    models = (FrictionModel.olaru2005(), FrictionModel.corrected(), REFERENCE)
    for panel, case in zip(panels, CASES.values(), strict=True):
        panel.set_title(case.title)
        largest = 0.0
        for row, model in enumerate(models):
            result = case.result(model)
            given = float(result.screw_torque) * case.screw_speed
            panel.barh(row - 0.2, given, height=0.36, color=charts.INK, label="into the shaft" if row == 0 else None)
            left = 0.0
            for mechanism, colour in charts.MECHANISM_COLOURS.items():
                part = float(result.dissipation[mechanism])
                panel.barh(
                    row + 0.2,
                    part,
                    left=left,
                    height=0.36,
                    color=colour,
                    label=MECHANISMS[mechanism] if row == 0 else None,
                )
                left += part
            missing = 100 * (given / left - 1)
            words = f"{missing:+.1f} %".replace("-", "−") if abs(missing) > 1e-6 else "equal"
            panel.text(max(given, left), row, f"  {words}", va="center", fontsize=9)
            largest = max(largest, given, left)
        panel.set_yticks(range(len(models)), ["as printed", "corrected", "reference"])
        panel.invert_yaxis()
        panel.grid(visible=False, axis="y")
        panel.set(xlim=(0, 1.25 * largest), xlabel="power (W)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


def quadrants() -> Figure:
    """The torque on the shaft in the four quadrants, and efficiencies over the lead angle."""
    figure, (four, leads) = charts.new_figure(
        case_caption(
            {"catalogue": CATALOGUE},
            "Left: torque on the shaft; blue, the part of the load. Right: grey, screws as inclined planes with a "
            "friction angle ρ, the last of them a plain thread with µ 0.1; blue, the catalogue screw with other leads, "
            "at 10 rpm and 0 °C.",
        )
    )
    result = CATALOGUE.result(REFERENCE)
    ideal = float(result.ideal_torque)
    for place, quadrant in enumerate(result.quadrants.values()):
        shaft, of_load = float(quadrant.shaft_torque), quadrant.load_sign * ideal
        first = place == 0
        four.bar(place, of_load, width=0.6, color=charts.SKY, label="of the load" if first else None)
        ends = [place - 0.38, place + 0.38]
        four.plot(ends, [shaft, shaft], color=charts.RED, label="on the shaft" if first else None)
        beyond = np.sign(shaft) * (max(abs(shaft), ideal) + 0.9)
        four.text(place, beyond, f"{shaft:+.2f}".replace("-", "−"), ha="center", va="center", fontsize=9)
    four.axhline(0, color=charts.INK, linewidth=1)
    names = ["screw drives\nforward", "load drives\nin reverse", "screw drives\nin reverse", "load drives\nforward"]
    four.set_xticks(range(4), names, fontsize=8.5)
    four.set(ylabel="torque on the shaft (N m)", title="Four quadrants", ylim=(-1.4 * ideal, 1.75 * ideal))
    four.grid(visible=False, axis="x")
    four.legend(loc="upper right", ncols=2)
    _efficiencies(leads)
    return figure


def _efficiencies(panel: Axes) -> None:
    phi = np.radians(np.linspace(0.05, 20, 400))
    for rho, words, height in ((0.3, "ρ = 0.3°", 1.0), (1.0, "ρ = 1°", 0.93), (5.7, "ρ = 5.7°", 0.72)):
        angle = np.radians(rho)
        drives = transmission.classical_efficiency(phi, angle)
        driven = transmission.classical_back_driving_efficiency(phi, angle)
        panel.plot(np.degrees(phi), drives, color=charts.GREY, linewidth=1.2)
        panel.plot(np.degrees(phi), np.where(driven > -0.3, driven, np.nan), color=charts.GREY, ls="--", linewidth=1.2)
        panel.text(20.2, height, words, fontsize=8.5, va="center", color=charts.GREY)
    oil = Lubricant.from_grade("ISO VG 100", temperature=CELSIUS)
    lead, _ = over_lead(CATALOGUE)
    found = dataclasses.replace(CATALOGUE, oil=oil).result(REFERENCE, lead=lead, screw_speed=10 * RPM)
    angle = np.degrees(np.asarray(found.ball_screw.lead_angle))
    panel.plot(angle, found.efficiency, color=charts.BLUE, label="screw drives")
    panel.plot(angle, found.back_driving_efficiency, color=charts.BLUE, ls="--", label="load drives")
    panel.axhspan(-0.3, 0, color=charts.LIGHT_SHADE, zorder=0)
    panel.text(10, -0.15, "the screw locks itself", fontsize=9, color=charts.GREY, ha="center", va="center")
    framed(panel, "lead angle φ (°)", "efficiency (1)", "Over the lead angle", xlim=(0, 20), ylim=(-0.3, 1.03))
    panel.legend(loc="lower right", bbox_to_anchor=(1, 0.24))


def halves() -> Figure:
    """The loads of the halves of a double nut over their deflection, and over the load."""
    x = np.linspace(-1.2, 1.6, 281)
    forward, backward = nut_losses.forward_half_load(1.0, np.maximum(x, -1)), nut_losses.backward_half_load(1.0, x)
    figure, (springs, shares) = charts.new_figure(
        mathtext(
            "Two halves of a double nut as springs of Hertz contacts; loads in units of the preload, displacement in "
            "units of what the preload alone approaches either half. Left: between the curves stands the load on the "
            "nut. Right: what it leaves on either half; dotted: lift-off."
        )
    )
    springs.plot(x, forward, color=charts.BLUE, label="half that is loaded")
    springs.plot(x, backward, color=charts.RED, ls="--", label="half that is relieved")
    at = 0.5
    low, high = float(nut_losses.backward_half_load(1.0, at)), float(nut_losses.forward_half_load(1.0, at))
    springs.annotate("", (at, high), (at, low), arrowprops={"arrowstyle": "<->", "color": charts.INK})
    springs.text(at + 0.06, (low + high) / 2, "load on the nut F", fontsize=9, va="center")
    springs.plot(0, 1, "o", color=charts.INK, markersize=5)
    springs.annotate("preload", (0, 1), xytext=(-52, -4), textcoords="offset points", fontsize=9, va="center")
    framed(
        springs,
        "displacement of the nut x (1)",
        "load of the half / preload (1)",
        "Two springs against each other",
        xlim=(-1.2, 1.6),
        ylim=(0, 4.3),
        legend="upper left",
    )
    x = np.linspace(0, 1.4, 281)
    loads = nut_losses.forward_half_load(1.0, x), nut_losses.backward_half_load(1.0, x)
    outside = loads[0] - loads[1]
    shares.plot(outside, loads[0], color=charts.BLUE, label="half that is loaded")
    shares.plot(outside, loads[1], color=charts.RED, ls="--", label="half that is relieved")
    shares.plot(outside, outside, color=charts.GREY, linewidth=1, label="without preload")
    shares.axvline(float(nut_losses.lift_off_load(1.0)), color=charts.GREY, linestyle=":", linewidth=1.2)
    framed(
        shares,
        "load on the nut / preload (1)",
        "load of the half / preload (1)",
        "Who carries the load",
        xlim=(0, float(outside[-1])),
        ylim=(0, 4.3),
        legend="upper left",
    )
    return figure


def lives() -> Figure:
    """The life of a double nut over its load, with more and less preload."""
    rating = 1.0
    figure, (by_load, by_preload) = charts.new_figure(
        mathtext(
            "Double nut; loads and preloads as shares of the dynamic load rating C_a; revolutions that nine of ten "
            "nuts outlive, both halves together. ISO 3408-5 as recalled."
        )
    )
    load = np.linspace(0.02, 0.4, 191)
    for share, colour, line in zip((0.0, 0.03, 0.07, 0.12), charts.GROWING, charts.LINE_STYLES, strict=False):
        by_load.semilogy(
            load,
            double_nut_life(rating, load, share),
            color=colour,
            ls=line,
            label=f"preload {share:.0%}".replace("%", " %"),
        )
    framed(
        by_load, "load on the nut F/C_a (1)", "life (revolutions)", "Over the load", xlim=(0, 0.4), legend="upper right"
    )
    share = np.linspace(0.005, 0.2, 196)
    for at, colour, line in zip((0.05, 0.1, 0.2), charts.GROWING[1:], charts.LINE_STYLES, strict=False):
        kept = double_nut_life(rating, np.full_like(share, at), share) / life.basic_life(rating, at)
        by_preload.plot(share, kept, color=colour, ls=line, label=f"load {at:.0%}".replace("%", " %"))
    framed(
        by_preload,
        "preload F_pr/C_a (1)",
        "life / life without preload (1)",
        "What a preload costs",
        xlim=(0, 0.2),
        ylim=(0, 1.05),
        legend="upper right",
    )
    return figure


def double_nut_life(rating, load, preload_force):
    """Revolutions of both halves together; without a preload, of the one that carries the load."""
    if np.all(preload_force == 0):
        return life.basic_life(rating, load)
    released = life.preload_release(load, preload_force)
    relieved = life.relieved_half_load(preload_force, released)
    loaded = load + relieved
    tiny = 1e-12 * rating  # a half that is free lasts for ever
    return life.combined_life(life.basic_life(rating, loaded), life.basic_life(rating, np.maximum(relieved, tiny)))


def repair_steps() -> Figure:
    """Torque and efficiency of the paper's case after each repair."""
    found = repairs()
    figure, (alone, together) = charts.new_figure(
        case_caption({"paper": PAPER}, "Left: the printed model with one repair. Right: with all so far."),
        height=3.3,
        sharey=True,
    )
    for panel, torques, title in (
        (alone, [step.torque_alone for step in found], "One repair alone"),
        (together, [step.torque_so_far for step in found], "One after the other"),
    ):
        panel.barh(range(len(found)), torques, height=0.62, color=[charts.GREY, *[charts.SKY] * (len(found) - 1)])
        for row, torque in enumerate(torques):
            panel.text(torque, row, f" {torque:.4f}", va="center", fontsize=9)
        panel.axvline(torques[0], color=charts.INK, linestyle=":", linewidth=1)
        panel.set(title=title, xlabel=mathtext("friction torque M_S (N m)"), xlim=(0, 1.22 * max(torques)))
        panel.grid(visible=False, axis="y")
    alone.set_yticks(range(len(found)), [mathtext(step.description) for step in found], fontsize=8.5)
    alone.invert_yaxis()
    return figure


FIGURES = {
    "slip_lines": slip_lines,
    "power": power,
    "quadrants": quadrants,
    "halves": halves,
    "lives": lives,
    "repairs": repair_steps,
}
