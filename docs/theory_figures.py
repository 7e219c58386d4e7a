"""Figures of the pages on theory."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Ellipse

from ballscrew.evidence.papers.olaru2005.closures import repairs
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.equations import (
    film,
    geometry,
    hertz,
    kinematics,
    life,
    nut_losses,
    rolling,
    slip,
    transmission,
)
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import PAPER_FRICTION, FrictionModel
from ballscrew.physics.laws.friction import LoadSharing
from ballscrew.physics.solvers.line_slip import creep_of_lines, pure_rolling_lines
from ballscrew.questions.shared import charts
from effect_study.cases import CASES, CATALOGUE, PAPER, RPM, Case
from effect_study.curves import over_lead
from effect_study.effect_figures import SPEED, case_caption, framed, mathtext, titled

REFERENCE = FrictionModel.reference()
GIGA, MICRO, MILLI = 1e9, 1e-6, 1e-3


# -- geometry -------------------------------------------------------------------------------------


def section() -> Figure:
    """The ball between its grooves, across its path; and the helix, unrolled."""
    case = CATALOGUE
    screw = case.screw
    figure, (across, unrolled) = charts.new_figure(
        case_caption(
            {"catalogue": case},
            "Left: section across the path of the ball, to scale. Dashed: the circles of the grooves, of radius f d_w; "
            "A: distance of their centres. Right: the path of the ball centres, one turn unrolled, to scale.",
        ),
        height=3.9,
    )
    _grooves(across, screw.ball_diameter / MILLI, screw.screw_conformity, float(screw.contact_angle))
    turn, lead = math.pi * screw.pitch_circle_diameter / MILLI, screw.lead / MILLI
    unrolled.plot([0, turn], [0, lead], color=charts.BLUE, label="path of the ball centres")
    unrolled.plot([0, turn, turn], [0, 0, lead], color=charts.GREY, linewidth=1.2)
    unrolled.text(turn / 2, -3.5, mathtext(f"π d_m = {turn:.0f} mm"), ha="center", va="top", fontsize=9)
    unrolled.text(turn + 2, lead / 2, mathtext(f"P_h\n{lead:.0f} mm"), ha="left", va="center", fontsize=9)
    angle = math.degrees(float(geometry.lead_angle(screw.lead, screw.pitch_circle_diameter)))
    unrolled.add_patch(Arc((0, 0), 110, 110, theta1=0, theta2=angle, color=charts.INK, linewidth=1))
    unrolled.annotate(
        f"φ = {angle:.2f}°",
        (54.5, 1.9),
        xytext=(40, 22),
        fontsize=9,
        arrowprops={"arrowstyle": "-", "color": charts.GREY},
    )
    unrolled.set(
        xlim=(-4, turn + 20),
        ylim=(-22, 42),
        aspect="equal",
        xlabel="around the screw (mm)",
        ylabel="along the axis (mm)",
        title="One turn of the helix",
    )
    unrolled.legend(loc="upper left")
    return figure


def _grooves(panel: Axes, diameter: float, conformity: float, angle: float) -> None:
    """Screw below, nut above; load from the lower right to the upper left."""
    radius, groove = diameter / 2, conformity * diameter
    offset = groove - radius
    panel.set_title("Ball, grooves and contact angle")
    panel.add_patch(Circle((0, 0), radius, facecolor=charts.LIGHT_SHADE, edgecolor=charts.INK, linewidth=1.4))
    for sign, words, colour in ((-1, "screw", charts.BLUE), (1, "nut", charts.RED)):
        # contact of the screw at the lower right, of the nut opposite
        normal = np.array([-sign * math.sin(angle), sign * math.cos(angle)])
        centre = -normal * offset
        contact = normal * radius
        panel.add_patch(
            Circle(tuple(centre), groove, fill=False, edgecolor=colour, linestyle=(0, (4, 3)), linewidth=0.9)
        )
        at = math.degrees(math.atan2(normal[1], normal[0]))
        panel.add_patch(
            Arc(tuple(centre), 2 * groove, 2 * groove, theta1=at - 42, theta2=at + 42, color=colour, linewidth=2.4)
        )
        panel.plot(*contact, "o", color=colour, markersize=6, zorder=5)
        panel.plot(*centre, "+", color=colour, markersize=8, markeredgewidth=1.6, zorder=5)
        panel.text(*(contact * 1.32), words, ha="center", va="center", fontsize=9.5, color=colour)
    line = np.array([math.sin(angle), -math.cos(angle)]) * radius
    panel.plot([-line[0], line[0]], [-line[1], line[1]], color=charts.GREY, linewidth=1)
    panel.plot([0, 0], [-radius, radius], color=charts.GREY, linewidth=1, linestyle=":")
    panel.add_patch(Arc((0, 0), radius, radius, theta1=-90, theta2=-90 + math.degrees(angle), color=charts.INK))
    panel.text(0.3 * radius, -0.72 * radius, "α", ha="center", va="center", fontsize=11)
    panel.annotate(
        "A",
        (0.0, 0.0),
        xytext=(-0.62 * radius, -0.2 * radius),
        fontsize=10,
        arrowprops={"arrowstyle": "-", "color": charts.GREY, "linewidth": 0.8, "shrinkB": 1},
    )
    reach = 1.62 * radius
    panel.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
    panel.grid(visible=False)
    framed(panel, "along the axis (mm)", "away from the axis (mm)")


def speeds() -> Figure:
    """Speeds across the ball, and the effect of the lead."""
    case = PAPER
    figure, (profile, leads) = charts.new_figure(
        case_caption(
            {"paper": case},
            "Left: speed along the path over the distance from the screw axis, in the section of the contacts; nut at "
            "rest. Right: the same screw with other leads, against a lead of zero.",
            ["axial_load", "oil"],
        )
    )
    result = case.result(REFERENCE)
    frame, v = result.frame, float(result.entrainment_speed)
    L, R_s, R_n = (
        float(result.frame.path_radius),
        float(result.screw.contact_radius),
        float(result.nut.contact_radius),
    )
    omega_c = float(kinematics.orbital_rotation(v, R_n))
    centre = float(kinematics.orbital_speed(omega_c, frame.path_radius))
    r = np.linspace(0, R_s, 2)
    profile.plot(r / MILLI, case.screw_speed * r, color=charts.BLUE, label="screw")
    ball = np.linspace(R_s, R_n, 2)
    profile.plot(
        ball / MILLI, np.interp(ball, [R_s, R_n], [case.screw_speed * R_s, 0.0]), color=charts.ORANGE, label="ball"
    )
    profile.plot([R_n / MILLI, (R_n + 4e-3) / MILLI], [0, 0], color=charts.RED, label="nut")
    profile.plot(L / MILLI, centre, "o", color=charts.INK, markersize=5)
    profile.annotate(
        f"ball centre\n{centre:.2f} m/s", (L / MILLI, centre), xytext=(6, 8), textcoords="offset points", fontsize=9
    )
    framed(
        profile,
        "distance from the screw axis (mm)",
        "speed along the path (m/s)",
        "Rolling without slip",
        xlim=(0, 26),
        ylim=(-0.06, 1.6),
        legend="upper left",
    )
    lead = np.linspace(0, 0.04, 81)
    phi = geometry.lead_angle(lead, case.screw.pitch_circle_diameter)
    path = geometry.path_radius(case.screw.pitch_circle_diameter, phi)
    gamma = geometry.curvature_ratio(
        case.screw.ball_diameter, case.screw.pitch_circle_diameter, case.screw.contact_angle, phi
    )
    entrainment = kinematics.entrainment_speed(case.screw_speed, path, gamma)
    lateral = kinematics.torsion_speed(case.screw_speed, case.screw.ball_diameter, phi)
    leads.plot(
        lead / MILLI, 100 * (entrainment / entrainment[0] - 1), color=charts.BLUE, label="more entrainment speed v"
    )
    leads.plot(lead / MILLI, 100 * lateral / entrainment, color=charts.RED, ls="--", label="lateral slip D, of v")
    framed(
        leads, "lead P_h (mm)", "per cent", "What the helix changes", xlim=(0, 40), ylim=(0, None), legend="upper left"
    )
    return figure


# -- contact --------------------------------------------------------------------------------------


def ellipses() -> Figure:
    """Contact ellipses to scale, and the pressure across them."""
    figure, panels = charts.new_figure(
        case_caption(CASES, "Above: contact ellipses, to scale; below: pressure across them, in the middle."),
        rows=2,
        height=2.7,
        sharex=True,
    )
    for shape, profile, case in zip(panels[:2], panels[2:], CASES.values(), strict=True):
        result = case.result(REFERENCE)
        shape.set_title(case.title)
        for words, contact, colour, side in (
            ("screw", result.screw, charts.BLUE, 1),
            ("nut", result.nut, charts.RED, -1),
        ):
            a, b = (float(axis) / MILLI for axis in (contact.semi_major_axis, contact.semi_minor_axis))
            shape.add_patch(
                Ellipse((0, 0.16 * side), 2 * a, 2 * b, facecolor=colour, alpha=0.35, edgecolor=colour, linewidth=1.4)
            )
            shape.text(0.66, 0.16 * side, words, ha="center", va="center", fontsize=9, color=colour)
            t = np.linspace(-1, 1, 201)
            pressure = hertz.hertz_pressure(float(contact.maximum_pressure), t, 0.0) / GIGA
            profile.plot(a * t, pressure, color=colour, ls="-" if side > 0 else "--", label=words)
        shape.set_xlim(-0.8, 0.8)
        shape.update_datalim([(-0.8, -0.4), (0.8, 0.4)])  # patches alone scale nothing
        shape.autoscale_view(scalex=False)
        shape.set_aspect("equal", adjustable="datalim")
        shape.set_ylabel("along the path (mm)")
        shape.tick_params(labelbottom=True)
        framed(profile, "across the path y (mm)", "pressure p (GPa)", ylim=(0, 2.4), legend="upper right")
    return figure


def fits() -> Figure:
    """Errors of the power laws for the ellipse."""
    k = np.geomspace(1, 100, 121)
    kappa = hertz.ellipticity(k)
    major = hertz.semi_major_axis_coefficient(k, kappa, hertz.elliptic_integrals(kappa).E)
    power = hertz.ellipticity_brewe_hamrock(k)
    by_power = hertz.semi_major_axis_coefficient(k, power, hertz.second_integral_brewe_hamrock(k))
    figure, (axes, shape) = charts.new_figure(
        mathtext(
            "Left: power laws for the semi-axes against the exact ones; dotted: the radii ratio of the paper's screw "
            "(f 0.515) and of a catalogue screw (f 0.54), at the screw. Right: the exact ellipticity a/b."
        )
    )
    for words, values, exact, colour, line in (
        ("a, (18) of the paper", hertz.semi_major_axis_coefficient_houpert(k), major, charts.ORANGE, "-"),
        ("b, (19) of the paper", hertz.semi_minor_axis_coefficient_houpert(k), major / kappa, charts.BLUE, "-"),
        ("a, Brewe and Hamrock", by_power, major, charts.ORANGE, "--"),
        ("b, Brewe and Hamrock", by_power / power, major / kappa, charts.BLUE, "--"),
    ):
        axes.semilogx(k, 100 * (values / exact - 1), color=colour, ls=line, label=words)
    for case in CASES.values():
        at = float(case.result(REFERENCE).screw.radii_ratio)
        for panel in (axes, shape):
            panel.axvline(at, color=charts.GREY, linestyle=":", linewidth=1.1)
    axes.set(ylabel="error of the semi-axis (%)", title="Fits")
    axes.legend(loc="upper left")
    shape.loglog(k, kappa, color=charts.INK, label="exact")
    shape.loglog(k, power, color=charts.ORANGE, ls="--", label="Brewe and Hamrock")
    shape.set(ylabel="ellipticity κ = a/b (1)", title="Slender contacts")
    shape.legend(loc="upper left")
    for panel in (axes, shape):
        panel.set(xlabel=mathtext("radii ratio k = R_y/R_x (1)"), xlim=(1, 100))
        panel.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
        panel.minorticks_off()
    shape.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
    return figure


# -- film and friction ----------------------------------------------------------------------------

#: Grades and line styles of the figures over temperature.
GRADES = {"ISO VG 32": ":", "ISO VG 68": "-.", "ISO VG 100": "-", "ISO VG 220": "--"}
CELSIUS = 273.15


def films() -> Figure:
    """Film over speed, as printed and as cited; film parameter over temperature."""
    figure, (speed_panel, heat_panel) = charts.new_figure(
        mathtext(
            "Minimum film and film parameter at the screw. Left: the paper's screw; dotted: the combined roughness. "
            f"{PAPER.caption('screw_speed')} Right: a catalogue screw. {CATALOGUE.caption('oil')}"
        )
    )
    speed = np.geomspace(1, 3000, 121)
    for words, model, colour, line in (
        ("exponent 0.66, as printed", FrictionModel.olaru2005(), charts.GREY, ":"),
        ("exponent 0.68, as cited", FrictionModel.corrected(), charts.ORANGE, "--"),
        ("and the inlet warms", REFERENCE, charts.BLUE, "-"),
    ):
        contact = PAPER.result(model, screw_speed=speed * RPM).screw
        speed_panel.loglog(
            speed, np.asarray(contact.minimum_film_thickness) / MICRO, color=colour, ls=line, label=words
        )
    rough = float(film.combined_roughness(PAPER.screw.ball_roughness, PAPER.screw.screw_roughness)) / MICRO
    speed_panel.axhline(rough, color=charts.INK, linestyle=(0, (1, 2)), linewidth=1)
    framed(speed_panel, SPEED, "minimum film h (µm)", "Film over speed", xlim=(1, 3000), legend="lower right")
    temperature = np.linspace(0, 90, 91)
    for grade, line in GRADES.items():
        values = [_film_parameter(CATALOGUE, grade, t + CELSIUS) for t in temperature]
        heat_panel.semilogy(temperature, values, color=charts.BLUE, ls=line, label=grade)
    heat_panel.axhline(1, color=charts.GREY, linewidth=1)
    heat_panel.set_xlim(0, 90)
    heat_panel.set_yticks([0.1, 0.2, 0.5, 1, 2, 5], ["0.1", "0.2", "0.5", "1", "2", "5"])
    heat_panel.minorticks_off()
    framed(heat_panel, "temperature of the oil (°C)", "film parameter λ (1)", "Cold and warm", legend="upper right")
    return figure


def _film_parameter(case: Case, grade: str, temperature: float) -> float:
    return float(_with_oil(case, grade, temperature).result(REFERENCE).screw.film_parameter)


def _with_oil(case: Case, grade: str, temperature: float) -> Case:
    return dataclasses.replace(case, oil=Lubricant.from_grade(grade, temperature=temperature))


def rolling_parts() -> Figure:
    """The two asymptotes of the rolling force and their blend; the elastic resistance by two laws."""
    figure, (oil, steel) = charts.new_figure(
        case_caption(
            {"paper": PAPER},
            "At the screw. Left: force of the inlet flow without its heating. Right: shaded, the loss of steel with "
            "α from 0.02 to 0.04.",
            ["axial_load"],
        )
    )
    load = np.geomspace(10, 8000, 121)
    contact = PAPER.result(REFERENCE, axial_load=load).screw
    Q, E, R_x, k = contact.contact_load, contact.equivalent_modulus, contact.rolling_radius, contact.radii_ratio
    W, U = contact.load_parameter, contact.speed_parameter
    rigid, elastic = rolling.rigid_rolling_force(E, R_x, k, W, U), rolling.elastic_rolling_force(E, R_x, k, W, U)
    blend = rolling.blended_rolling_force(rigid, elastic, rolling.rigid_regime_share(k, W, U))
    oil.loglog(Q, rigid, color=charts.ORANGE, ls="--", label="rigid, constant viscosity")
    oil.loglog(Q, elastic, color=charts.GREEN, ls="--", label="elastic, viscosity grows")
    oil.loglog(Q, blend, color=charts.BLUE, label="blend")
    oil.set(ylabel=mathtext("rolling force F_R (N)"), title="The oil of the inlet")
    low, high = (rolling.hysteresis_moment(loss, Q, contact.semi_minor_axis) * 1e3 for loss in (0.02, 0.04))
    steel.fill_between(Q, low, high, color=charts.SHADE, label="(3/16) α Q b")
    steel.loglog(
        Q, rolling.elastic_resistance_moment(PAPER.screw.ball_diameter, Q, k) * 1e3, color=charts.BLUE, label="(20)"
    )
    steel.set(ylabel=mathtext("elastic moment M_ER (N mm)"), title="The steel")
    for panel in (oil, steel):
        panel.set_xlabel("load of the ball Q (N)")
        panel.legend(loc="upper left")
    return figure


def mixed_friction() -> Figure:
    """The friction coefficient over speed, cold and warm, by two laws."""
    figure, panels = charts.new_figure(
        case_caption(
            CASES,
            "Friction coefficient of the contact at the screw, ISO VG 100. Clamped: the law of the paper, with its µ_0 "
            "of 0.2; shared: that of the reference model, with 0.12.",
            ["screw_speed", "oil"],
        ),
        sharey=True,
    )
    speed = np.geomspace(0.3, 3000, 161)
    clamped = dataclasses.replace(REFERENCE, friction=PAPER_FRICTION)
    shared = dataclasses.replace(REFERENCE, friction=LoadSharing())
    for panel, case in titled(panels, CASES):
        for celsius, colour in ((10, charts.BLUE), (40, charts.PURPLE), (70, charts.RED)):
            warm = _with_oil(case, "ISO VG 100", celsius + CELSIUS)
            for words, model, line in (("clamped", clamped, "--"), ("shared", shared, "-")):
                values = warm.result(model, screw_speed=speed * RPM).screw.friction_coefficient
                panel.semilogx(speed, values, color=colour, ls=line, label=f"{celsius} °C, {words}")
        framed(panel, SPEED, "friction coefficient µ_m (1)", xlim=(0.3, 3000), ylim=(0, 0.22))
    panels[1].tick_params(labelleft=True)
    panels[0].legend(loc="lower left")
    return figure


# -- slip, balance, efficiency, the nut, its life, and the repairs of the paper ---------------------------


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
    "section": section,
    "speeds": speeds,
    "ellipses": ellipses,
    "fits": fits,
    "films": films,
    "rolling_parts": rolling_parts,
    "mixed_friction": mixed_friction,
    "slip_lines": slip_lines,
    "power": power,
    "quadrants": quadrants,
    "halves": halves,
    "lives": lives,
    "repairs": repair_steps,
}


def parts() -> dict[str, Callable[[], Figure]]:
    """All figures of these pages."""
    return {f"{name}.svg": draw for name, draw in FIGURES.items()}
