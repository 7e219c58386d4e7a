"""Every equation is in every check, or on a list of exceptions with a reason."""

import ast
from pathlib import Path

import pytest

import ballscrew.physics.equations

from .discovery import BY_NAME, BY_UNIT, DIMENSIONAL_FITS, ELSEWHERE, EQUATIONS, RECURRENCES
from .test_symbols import FORMULAS
from .test_units import CONSISTENT


def test_every_public_function_is_found():
    # Read from the files, apart from how the discovery imports them.
    (folder,) = ballscrew.physics.equations.__path__
    source = Path(folder).parents[2]
    elsewhere = [source / f"{name.replace('.', '/')}.py" for name in ELSEWHERE]
    written = {
        f"{path.stem}.{node.name}"
        for path in (*Path(folder).rglob("*.py"), *elsewhere)
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")
    }
    assert written == set(EQUATIONS)
    assert len(written) >= 50


def test_every_equation_is_checked_by_its_formula_or_as_a_recurrence():
    assert set(FORMULAS) | set(RECURRENCES) == set(EQUATIONS)
    assert set(FORMULAS) & set(RECURRENCES) == set()


def test_every_equation_is_checked_for_units_or_is_a_dimensional_fit():
    assert set(CONSISTENT) | set(DIMENSIONAL_FITS) == set(EQUATIONS)
    assert set(CONSISTENT) & set(DIMENSIONAL_FITS) == set()


@pytest.mark.parametrize("exceptions", [RECURRENCES, DIMENSIONAL_FITS])
def test_exceptions_are_known_and_have_a_reason(exceptions):
    assert set(exceptions) <= set(EQUATIONS)
    assert all(exceptions.values())


def test_domains_are_of_parameters_that_exist():
    names = {name for equation in EQUATIONS.values() for name in equation.parameters}
    assert set(BY_NAME) <= names


def test_every_unit_has_a_domain():
    units = {unit for equation in EQUATIONS.values() for unit in equation.units.values()}
    assert units <= set(BY_UNIT)
