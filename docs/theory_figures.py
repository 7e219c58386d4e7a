"""Figures of the pages on theory: geometry, contact, film and friction; see ``theory_screw_figures`` for the rest."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Ellipse

import theory_screw_figures
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.equations import film, geometry, hertz, kinematics, rheology, rolling
from ballscrew.physics.friction.model import PAPER_FRICTION, FrictionModel
from ballscrew.physics.laws.friction import LoadSharing
from ballscrew.questions.shared import charts
from effect_study.cases import CASES, CATALOGUE, PAPER, RPM, Case
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
    W = rheology.load_parameter(Q, E, R_x)
    U = rheology.speed_parameter(PAPER.oil.viscosity, PAPER.result(REFERENCE).entrainment_speed, E, R_x)
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


FIGURES = {
    "section": section,
    "speeds": speeds,
    "ellipses": ellipses,
    "fits": fits,
    "films": films,
    "rolling_parts": rolling_parts,
    "mixed_friction": mixed_friction,
}


def parts() -> dict[str, Callable[[], Figure]]:
    """All figures of these pages."""
    return {f"{name}.svg": draw for name, draw in {**FIGURES, **theory_screw_figures.FIGURES}.items()}
