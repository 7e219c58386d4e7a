"""The formula in the docstring is the code: both are evaluated with 30 digits at the same points."""

import pytest

from support.rules import for_each

from .discovery import EQUATIONS, RECURRENCES
from .formulas import differences, formula_of, lettered, letters_of, parsed, spelling

FORMULAS = {name: equation for name, equation in EQUATIONS.items() if name not in RECURRENCES}


@for_each(equation=FORMULAS)
def test_the_formula_is_the_code(equation):
    formula = formula_of(equation.function)
    assert formula is not None, "no formula"
    assert differences(equation, formula) == []


# -- the check itself: a wrong formula must be found out -------------------------------------------

WRONG = {
    "another exponent": (
        "film.minimum_film_thickness",
        r"h = 3.63 R_x U^m G^{0.49} W^{-0.073} (1 - \exp(-0.67\kappa))",
    ),
    "another factor": (
        "rolling.hydrodynamic_rolling_force",
        r"F_R = 2.87 E' R_x^2 k^{0.348} G^{0.022} U^{0.66} W^{0.47}",
    ),
    "another sign": ("geometry.screw_rolling_radius", r"R_x = \frac{d_w}{2} (1 + \gamma)"),
    "a missing square root": ("film.film_parameter", r"\lambda = \frac{h}{\sigma_b^2 + \sigma_R^2}"),
    "the wrong limit": (
        "friction.clamped_friction_coefficient",
        r"\mu_m = \max\left(\min\left(\mu_a, \mu_f\right), \mu_0\right)",
    ),
    "another power": ("hertz.mutual_approach", r"\delta = c_d R_x W^{1/3}"),
    "a missing letter": ("rheology.speed_parameter", r"U = \frac{\eta_0 v}{E'}"),
    "an unknown letter": ("rheology.dynamic_viscosity", r"\eta_0 = \nu \rho_0"),
    "letters exchanged": ("geometry.radii_ratio", r"k = \frac{R_x}{R_y}"),
    "a formula for something else": ("friction.traction_ratio", r"Y = 1 - 3 Y + Y^3"),
}


@pytest.mark.slow
@pytest.mark.parametrize("wrong", WRONG)
def test_a_wrong_formula_is_found_out(wrong):
    name, formula = WRONG[wrong]
    assert differences(EQUATIONS[name], formula) != []


def changed_numbers(numbers):
    """The numbers with each of them changed by one in the last digit, one at a time."""
    for name, number in numbers.items():
        decimals = len(number.partition(".")[2])
        yield {**numbers, name: f"{float(number) + 10**-decimals:.{decimals}f}"}


@pytest.mark.slow
@for_each(equation=FORMULAS)
def test_every_number_of_a_formula_counts(equation):
    left, _, right = formula_of(equation.function).partition("=")
    with_letters, numbers = lettered(right)
    formula = f"{left} = {with_letters}"
    assert differences(equation, formula, numbers) == []
    for changed in changed_numbers(numbers):
        assert differences(equation, formula, changed) != [], changed


def test_numbers_are_changed_where_they_stand():
    formula, numbers = lettered(r"2 F_{B2} \sigma_1 U^{0.66}")
    assert formula == r"{Z_{aa}} F_{B2} \sigma_1 U^{{Z_{ab}}}"
    assert list(changed_numbers(numbers)) == [{"Z_aa": "3", "Z_ab": "0.66"}, {"Z_aa": "2", "Z_ab": "0.67"}]


# -- the parts of the check ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("latex", "python"),
    [("M_{E*R}", "M_ER"), ("E'", "E"), ("varphi", "phi"), ("lambda", "lam"), ("c_{\\alpha}", "c_alpha"), ("k", "k")],
)
def test_spelling(latex, python):
    assert spelling(latex) == python


def test_letters_are_read_from_the_first_lines():
    assert letters_of(EQUATIONS["rolling.hydrodynamic_rolling_force"].function) == {
        "equivalent_modulus": "E",
        "rolling_radius": "R_x",
        "radii_ratio": "k",
        "material_parameter": "G",
        "speed_parameter": "U",
        "load_parameter": "W",
    }


def test_a_letter_before_a_bracket_is_a_factor():
    assert str(parsed(r"R_s = L (1 - \gamma)").rhs) == "L*(1 - gamma)"
    assert str(parsed(r"x = K \left(y z\right)^2").rhs) == "K*y**2*z**2"
    assert str(parsed(r"x = \frac{y}{\pi (1 + c_\alpha)}").rhs) == "y/(pi*(c_alpha + 1))"


def test_a_subscript_is_no_differential():
    assert str(parsed(r"x = c_d R_x").rhs) == "R_x*c_d"
