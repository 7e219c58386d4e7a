"""What the page of the errata has from the program: verdicts from the data, numbers of models, tests by markers."""

from __future__ import annotations

import dataclasses

import equation_table
from ballscrew.basis.references import PaperEquation, paper_equations
from ballscrew.evidence.papers.olaru2005.closures import REPAIRS, repairs
from ballscrew.physics.equations import friction, hertz, rolling
from ballscrew.physics.friction.model import PAPER_FRICTION, FrictionModel
from ballscrew.questions.shared.text_tables import markdown_table
from effect_study.cases import PAPER, RPM

PRINTED, CORRECTED = FrictionModel.olaru2005(), FrictionModel.corrected()
TESTS = "evidence/papers/test_errata.py::"
#: The equations of each section, and the slot of the model that repairs it.
ERRATA: dict[str, tuple[tuple[str, ...], str | None]] = {
    "film": (("§4 (26)",), "film"),
    "root": (("§4 (22)",), None),
    "neighbours": (("§2.2 (21)",), "ball_chain"),
    "moments": (("§6 (28)", "§6 (31)"), "race_torques"),
    "work": (("§7 (35)",), None),
    "ellipse": (("§2.2 (18)", "§2.2 (19)"), "hertz"),
    "offset": (("§2.2 (17)",), "pure_rolling_offset"),
    "fit": (("§2.2 (20)",), None),
    "branch": (("§5 (24)",), None),
}


def percent(ratio: float, digits: int = 1) -> str:
    """A ratio as a signed change in per cent."""
    return f"{100 * (ratio - 1):+.{digits}f} %".replace("-", "−")


def numbers() -> dict[str, str]:
    """All that stands in the text of the page, by its name there."""
    return {f"errata_{name}": value for name, value in {**_of_sections(), **_of_models(), **_of_contacts()}.items()}


def _of_sections() -> dict[str, str]:
    """Where each error is and the verdict on it, the tests that hold it, and what its repair does to the torque."""
    found: dict[str, str] = {}
    tests = equation_table.tests()
    before, *changed = repairs()
    by_slot = dict(zip(REPAIRS, changed, strict=True))
    for key, (places, slot) in ERRATA.items():
        equations = [one for one in paper_equations() if _place(one) in places]
        where = " and ".join(f"{_place(one)}, {one.what}" for one in equations)
        found[f"{key}_where"] = f"{where}: {'; '.join(dict.fromkeys(one.verdict for one in equations))}."
        names = [name.removeprefix(TESTS) for one in equations for name in tests[one.address] if TESTS in name]
        assert names, key
        found[f"{key}_tests"] = ", ".join(f"`{name}`" for name in dict.fromkeys(names))
        if slot is not None:
            torques = before.torque_alone, by_slot[slot].torque_alone
            found[f"{key}_repair"] = (
                f"from {torques[0]:.4f} to {torques[1]:.4f} N m ({percent(torques[1] / torques[0])})"
            )
    return found


def _of_models() -> dict[str, str]:
    """The paper's case as printed, corrected and to the letter."""
    printed, corrected = PAPER.result(PRINTED), PAPER.result(CORRECTED)
    literal = PAPER.result(FrictionModel.olaru2005(literal_film_parameter=True))
    works = PAPER.result(dataclasses.replace(PRINTED, ideal_torque=CORRECTED.ideal_torque))
    torque = float(printed.screw_torque)
    films = [
        PAPER.result(PRINTED, screw_speed=rpm * RPM).screw.minimum_film_thickness
        / PAPER.result(CORRECTED, screw_speed=rpm * RPM).screw.minimum_film_thickness
        for rpm in (10, 1000)
    ]
    taken = PAPER.screw.loaded_balls * corrected.ball_to_ball_force * corrected.frame.path_radius
    fell = percent(float(literal.screw_torque) / torque, 0)
    return {
        "film_slow": f"{float(films[0]):.2f}",
        "film_fast": f"{float(films[1]):.2f}",
        "root_literal": f"{float(literal.screw.film_parameter):.3g}",
        "root_right": f"{float(printed.screw.film_parameter):.2f}",
        "root_torques": f"{float(literal.screw_torque):.3f} N m for {torque:.3f} ({fell})",
        "moments_short": f"{100 * (1 - torque * PAPER.screw_speed / float(printed.friction_power)):.1f}",
        "moments_taken": f"{1e3 * float(taken):.1f}",
        "moments_right": f"{1e3 * float(corrected.screw_torque - corrected.nut_torque):.1f}",
        "moments_printed": f"{1e3 * float(printed.screw_torque - printed.nut_torque):.1f}",
        "work_low": f"{100 * (1 - float(printed.ideal_torque / works.ideal_torque)):.1f}",
        "work_efficiencies": f"{float(printed.efficiency):.4f} for {float(works.efficiency):.4f}",
        "offset_none": f"{float(friction.offset_from_traction(0.0)):.4f}",
        "offset_screw": f"{float(corrected.screw.pure_rolling_offset):.4f}",
        "offset_nut": f"{float(corrected.nut.pure_rolling_offset):.4f}",
    }


def _of_contacts() -> dict[str, str]:
    """Fits of the paper at its own screw contact."""
    printed = PAPER.result(PRINTED)
    k, Q, d_w = float(printed.screw.radii_ratio), float(printed.contact_load), PAPER.screw.ball_diameter
    kappa = hertz.ellipticity(k)
    a = hertz.semi_major_axis_coefficient(k, kappa, hertz.elliptic_integrals(kappa).E)
    fit_a, fit_b = hertz.semi_major_axis_coefficient_houpert(k), hertz.semi_minor_axis_coefficient_houpert(k)
    grown = rolling.elastic_resistance_moment(1000 * d_w, Q, k) / rolling.elastic_resistance_moment(d_w, Q, k)
    law, slow = PAPER_FRICTION, float(PAPER.result(PRINTED, screw_speed=RPM).screw.film_parameter)
    mu = friction.asperity_friction_coefficient(slow, law.boundary_friction_coefficient, law.decay, law.exponent)
    return {
        "ellipse_k": f"{k:.1f}",
        "ellipse_major": percent(float(fit_a / a)),
        "ellipse_minor": percent(float(fit_b * kappa / a)),
        "ellipse_pressure": percent(float(a * (a / kappa) / (fit_a * fit_b))),
        "ellipse_moment": percent(float((fit_a / a) ** 2)),
        "fit_grown": f"{grown:.1f}",
        "branch_share": f"{float(mu / law.boundary_friction_coefficient):.3f}",
    }


def _place(equation: PaperEquation) -> str:
    return f"§{equation.section} ({equation.number})"


def rest() -> str:
    """Verdicts with a remark that have no section on the page, and how equations are named."""
    told = {place for places, _ in ERRATA.values() for place in places}
    rows = [
        (_place(equation), equation.what, equation.verdict)
        for equation in paper_equations()
        if _place(equation) not in told and equation.verdict != "right"
    ]
    used = [equation.number for equation in paper_equations()]
    twice = sorted({number for number in used if used.count(number) > 1})
    return markdown_table(("where", "what", "verdict"), rows) + (
        f"\nThe numbers ({twice[0]}) to ({twice[-1]}) are used for two equations each, so an equation is named by"
        " section and number everywhere in this package.\n"
    )


def without_a_section() -> list[str]:
    """Addresses whose verdict reports an error that no section describes."""
    told = {place for places, _ in ERRATA.values() for place in places}
    fine = ("right", "exact")
    return [e.address for e in paper_equations() if not e.verdict.startswith(fine) and _place(e) not in told]
