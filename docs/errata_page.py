"""Page of the errata of the paper: printed form, correct form, reason, effect in numbers, test.

Which equations these are, and the verdict in words, comes from the data of the package; the formulas from the
docstrings of the functions; the tests from their markers; and every number from the program. Here stands only why.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from pathlib import Path

import make_equation_table
from ballscrew.basis.references import PaperEquation, paper_equations
from ballscrew.evidence.papers.olaru2005.closures import REPAIRS, Repair, repairs
from ballscrew.physics.equations import friction, hertz, rolling
from ballscrew.physics.friction.model import PAPER_FRICTION, FrictionModel
from effect_study.cases import PAPER, RPM

PRINTED, CORRECTED = FrictionModel.olaru2005(), FrictionModel.corrected()
ERRATA_TESTS = "evidence/papers/test_errata.py::"


@dataclasses.dataclass(frozen=True)
class Erratum:
    """One error, in one equation or in several that belong together."""

    title: str
    addresses: tuple[str, ...]
    #: Functions with the printed formula, and with the correct one.
    printed: tuple[str, ...]
    right: tuple[str, ...]
    said: str
    why: str
    effect: Callable[[], str]


def percent(ratio: float, digits: int = 1) -> str:
    """A ratio as a signed change in per cent."""
    return f"{100 * (ratio - 1):+.{digits}f} %".replace("-", "−")


@functools.cache
def _repairs() -> tuple[Repair, ...]:
    return repairs()


def repaired(field: str) -> str:
    """Change of the torque of the paper's case by this correction alone."""
    found = dict(zip(REPAIRS, _repairs()[1:], strict=True))[field]
    before = _repairs()[0]
    return (
        f"Alone, the repair takes the friction torque of the paper's case from {before.torque_alone:.4f} to "
        f"{found.torque_alone:.4f} N m ({percent(found.torque_alone / before.torque_alone)})"
    )


# -- effects in numbers ----------------------------------------------------------------------------


def film_exponent() -> str:
    thick = [
        float(
            PAPER.result(PRINTED, screw_speed=rpm * RPM).screw.minimum_film_thickness
            / PAPER.result(CORRECTED, screw_speed=rpm * RPM).screw.minimum_film_thickness
        )
        for rpm in (10, 1000)
    ]
    return (
        f"The printed films are {thick[0]:.2f} times too thick at 10 rpm and {thick[1]:.2f} times at 1000 rpm"
        f" (ellipse and"
        f" helix of either model included). {repaired('film')}, as thinner films leave more load to the asperities."
    )


def square_root() -> str:
    literal = PAPER.result(FrictionModel.olaru2005(literal_film_parameter=True))
    right = PAPER.result(PRINTED)
    return (
        f"At the paper's case the printed form gives {float(literal.screw.film_parameter):.3g} in SI, where the film is"
        f" {float(right.screw.film_parameter):.2f} of the roughness. Every contact then counts as fully"
        f" lubricated, and the"
        f" friction torque is {float(literal.screw_torque):.3f} N m for {float(right.screw_torque):.3f}"
        f" ({percent(float(literal.screw_torque / right.screw_torque), 0)}). This is the one repair without"
        f" which the text cannot"
        " run, so the model *as printed* has it, and `olaru2005-literal` has not."
    )


def two_neighbours() -> str:
    return repaired("ball_chain") + "."


def contact_moments() -> str:
    printed, corrected = PAPER.result(PRINTED), PAPER.result(CORRECTED)
    short = float(printed.screw_torque) * PAPER.screw_speed / float(printed.friction_power)
    taken = float(PAPER.screw.loaded_balls * corrected.ball_to_ball_force * corrected.frame.path_radius)
    return (
        f"The printed torque times the speed is {100 * (1 - short):.1f} % short of what the mechanisms"
        f" dissipate; with the moments"
        f" the two are equal. The torques on screw and nut may differ by what the chain of balls takes alone,"
        f" {1e3 * taken:.1f} mN m here, and do with the moments"
        f" ({1e3 * float(corrected.screw_torque - corrected.nut_torque):.1f} mN m); as printed they differ by"
        f" {1e3 * float(printed.screw_torque - printed.nut_torque):.1f} mN m. {repaired('race_torques')}."
    )


def virtual_work() -> str:
    printed = PAPER.result(PRINTED)
    right = PAPER.result(dataclasses.replace(PRINTED, ideal_torque=CORRECTED.ideal_torque))
    low = float(printed.ideal_torque / right.ideal_torque)
    return (
        f"The printed torque without friction is {100 * (1 - low):.1f} % below the"
        f" virtual work of a turn, and the efficiency of the paper's case {float(printed.efficiency):.4f} for"
        f" {float(right.efficiency):.4f}."
    )


def power_laws() -> str:
    k = float(PAPER.result(PRINTED).screw.radii_ratio)
    kappa = hertz.ellipticity(k)
    a = hertz.semi_major_axis_coefficient(k, kappa, hertz.elliptic_integrals(kappa).E)
    fit_a, fit_b = hertz.semi_major_axis_coefficient_houpert(k), hertz.semi_minor_axis_coefficient_houpert(k)
    pressure = a * (a / kappa) / (fit_a * fit_b)
    return (
        f"At the screw contact of the paper (k = {k:.1f}) the semi-major axis is {percent(float(fit_a / a))},"
        f" the semi-minor"
        f" axis {percent(float(fit_b * kappa / a))}, the pressure {percent(float(pressure))}, and the curvature"
        f" moment, which"
        f" goes with a², {percent(float((fit_a / a) ** 2))}. {repaired('hertz')}."
    )


def dimensional_fit() -> str:
    case = PAPER.result(PRINTED)
    d_w, Q, k = PAPER.screw.ball_diameter, float(case.contact_load), float(case.screw.radii_ratio)
    grown = rolling.elastic_resistance_moment(1000 * d_w, Q, k) / rolling.elastic_resistance_moment(d_w, Q, k)
    return (
        f"With lengths in millimetres a moment must come out 1000 times the number; the fit gives {grown:.1f}"
        f" times. In SI it is"
        " used as it stands."
    )


def dead_branch() -> str:
    law = PAPER_FRICTION
    lam = float(PAPER.result(PRINTED, screw_speed=1 * RPM).screw.film_parameter)
    mu = friction.asperity_friction_coefficient(lam, law.boundary_friction_coefficient, law.decay, law.exponent)
    return (
        f"At 1 rpm µ_a is {float(mu / law.boundary_friction_coefficient):.3f} of µ_0 already. The branch"
        f" changes no number: it"
        " is kept as the limit of rest."
    )


def imposed_offset() -> str:
    result = PAPER.result(CORRECTED)
    Y = [float(side.pure_rolling_offset) for side in (result.screw, result.nut)]
    none = float(friction.offset_from_traction(0.0))
    return (
        f"Without a net force it is {none:.4f}; at the paper's case equilibrium asks for {Y[0]:.4f} at the"
        f" screw and {Y[1]:.4f}"
        f" at the nut. {repaired('pure_rolling_offset')}: 0.34 was a good guess."
    )


E = "ballscrew.physics.equations."
ERRATA = (
    Erratum(
        "The film is too thick",
        ("Olaru2005 §4 (26)",),
        (),
        (E + "film.minimum_film_thickness",),
        "The exponent m of the speed parameter U is printed as 0.66.",
        "The source that the paper cites has 0.68. The 0.66 is the exponent in (1), the rolling force, and seems to"
        " have been copied from"
        " there. The print also has two points in the exponent of W.",
        film_exponent,
    ),
    Erratum(
        "The film parameter has a unit",
        ("Olaru2005 §4 (22)",),
        (E + "film.literal_film_parameter",),
        (E + "film.film_parameter",),
        "The square root of the sum of squares is missing.",
        "A length over a length squared is no ratio: measured in micrometres it is another number. Roughness of"
        " two surfaces adds"
        " by squares, as independent heights do, and the gap has the root of the sum.",
        square_root,
    ),
    Erratum(
        "A ball in a chain touches two",
        ("Olaru2005 §2.2 (21)",),
        (E + "friction.ball_friction_moment",),
        (E + "equilibrium.chain_braking_force",),
        "The braking moment is that of one neighbour.",
        "Every ball has one before and one behind, and rubs on both. Where the chain is curved the friction"
        " between neighbours"
        " also pushes the ball back along its path.",
        two_neighbours,
    ),
    Erratum(
        "The moments of the contact act on the races, too: the conservation error",
        ("Olaru2005 §6 (28)", "Olaru2005 §6 (31)"),
        (E + "equilibrium.race_torque",),
        (E + "equilibrium.balanced_screw_torque", E + "equilibrium.balanced_nut_torque"),
        "The torque on a race is its tangential force times its radius only.",
        "A moment in a contact acts on the ball, and with the opposite sign on the race: action = reaction."
        " Curvature and elastic"
        " resistance are such moments, and a part of each, the cosine of the contact angle, turns about the"
        " screw axis. Left out,"
        " screw and nut have different torques even where nothing but the balls connects them, and the power"
        " that goes in is not"
        " the power that is dissipated.",
        contact_moments,
    ),
    Erratum(
        "The torque without friction breaks virtual work",
        ("Olaru2005 §7 (35)",),
        (E + "transmission.ideal_torque_printed",),
        (E + "transmission.ideal_torque",),
        "The lever is the radius of the contact at the screw.",
        "In one turn the nut advances by a lead. What the screw does, 2π times its torque, is the load times"
        " the lead, wherever"
        " the contacts lie.",
        virtual_work,
    ),
    Erratum(
        "The power laws for the ellipse",
        ("Olaru2005 §2.2 (18)", "Olaru2005 §2.2 (19)"),
        (E + "hertz.semi_major_axis_coefficient_houpert", E + "hertz.semi_minor_axis_coefficient_houpert"),
        (E + "hertz.semi_major_axis_coefficient",),
        "No misprint: fits, used outside their range of radii ratios.",
        "They are accurate for open grooves. The paper's close grooves make a slender ellipse, where they are not.",
        power_laws,
    ),
    Erratum(
        "The offset of the lines of pure rolling is not free",
        ("Olaru2005 §2.2 (17)",),
        (E + "friction.pure_rolling_offset",),
        (E + "friction.offset_from_traction",),
        "Y is imposed, as 0.34.",
        "The sliding force follows from the equilibrium of the ball. The same friction, integrated over the"
        " contact, has to give"
        " that force, and that fixes Y at each contact.",
        imposed_offset,
    ),
    Erratum(
        "A fit in disguise",
        ("Olaru2005 §2.2 (20)",),
        (E + "rolling.elastic_resistance_moment",),
        (E + "rolling.hysteresis_moment",),
        "The exponents of load and length do not give the unit of a moment.",
        "It is a fit to measured steel bearings, and right in newtons and metres only. The loss of elastic work"
        " has no such"
        " trouble; the models of the paper keep the fit.",
        dimensional_fit,
    ),
    Erratum(
        "A branch that nothing reaches",
        ("Olaru2005 §5 (24)",),
        (E + "friction.clamped_friction_coefficient",),
        (E + "mixed_lubrication.load_sharing_friction_coefficient",),
        "At very small speed the friction of the asperities is stated to exceed µ_0, and is clamped there.",
        "The exponential is below one for every film thickness above zero.",
        dead_branch,
    ),
)


def page() -> str:
    """The errata, one section each, and the other remarks of the verdicts."""
    return "\n".join([*(_section(erratum) for erratum in ERRATA), _rest()])


def _section(erratum: Erratum) -> str:
    known = {equation.address: equation for equation in paper_equations()}
    equations = [known[address] for address in erratum.addresses]
    where = " and ".join(_place(equation) for equation in equations)
    verdicts = "; ".join(dict.fromkeys(equation.verdict for equation in equations))
    lines = [f"## {erratum.title}", "", f"**{where}**: {verdicts}.", "", f"**Printed.** {erratum.said}", ""]
    lines += _formulas(erratum.printed)
    lines += ["**Right.**" if erratum.right else "", ""]
    lines += _formulas(erratum.right)
    lines += [f"**Why.** {erratum.why}", "", f"**What it does.** {erratum.effect()}", "", _held_by(equations), ""]
    return "\n".join(lines)


def _place(equation: PaperEquation) -> str:
    return f"§{equation.section} ({equation.number}), {equation.what}"


def _formulas(names: tuple[str, ...]) -> list[str]:
    return [line for name in names for line in (f"<!-- equation: {name} -->", "<!-- end -->", "")]


@functools.cache
def _tests() -> dict[str, list[str]]:
    return make_equation_table.tests()


def _held_by(equations: list[PaperEquation]) -> str:
    tests = _tests()
    names = [
        name.removeprefix(ERRATA_TESTS)
        for equation in equations
        for name in tests[equation.address]
        if name.startswith(ERRATA_TESTS)
    ]
    assert names, equations
    return (
        "**Held by** "
        + ", ".join(f"`{name}`" for name in dict.fromkeys(names))
        + " in `tests/evidence/papers/test_errata.py`."
    )


def _rest() -> str:
    """Verdicts with a remark that have no section above."""
    told = {address for erratum in ERRATA for address in erratum.addresses}
    rows = [
        f"| §{equation.section} ({equation.number}) | {equation.what} | {equation.verdict} |"
        for equation in paper_equations()
        if equation.address not in told and equation.verdict != "right"
    ]
    return "\n".join(
        ["## Smaller remarks", "", "| where | what | verdict |", "|---|---|---|", *rows, "", _numbering(), ""]
    )


def _numbering() -> str:
    numbers = [equation.number for equation in paper_equations()]
    twice = sorted({number for number in numbers if numbers.count(number) > 1})
    return (
        f"The numbers ({twice[0]}) to ({twice[-1]}) are used for two equations each, so an equation is named by"
        f" section and number"
        " everywhere in this package."
    )


def without_a_section() -> list[str]:
    """Addresses whose verdict reports an error that no section describes."""
    told = {address for erratum in ERRATA for address in erratum.addresses}
    fine = ("right", "exact")
    return [e.address for e in paper_equations() if not e.verdict.startswith(fine) and e.address not in told]


def write(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "errata.md").write_text(page(), encoding="utf-8")
