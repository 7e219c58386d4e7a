"""Runs a test that asks for an ``equation`` once for each equation of the package; lends the units."""

import pint
import pytest

from .discovery import EQUATIONS


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """One test for each equation."""
    if "equation" in metafunc.fixturenames:
        metafunc.parametrize("equation", [pytest.param(e, id=name) for name, e in EQUATIONS.items()])


@pytest.fixture(scope="session")
def registry() -> pint.UnitRegistry:
    """One registry: quantities of two registries do not mix."""
    return pint.UnitRegistry()
