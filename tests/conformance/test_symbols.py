"""The formula in the docstring is the code: both are evaluated with 30 digits at the same points."""

import pytest

from support.rules import for_each

from .discovery import EQUATIONS, RECURRENCES
from .formulas import differences, formula_of, lettered

FORMULAS = {name: equation for name, equation in EQUATIONS.items() if name not in RECURRENCES}


@for_each(equation=FORMULAS)
def test_the_formula_is_the_code(equation):
    formula = formula_of(equation.function)
    assert formula is not None, "no formula"
    assert differences(equation, formula) == []


# -- the check itself: a wrong formula must be found out -------------------------------------------


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
