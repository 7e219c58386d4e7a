"""Lends the units."""

import pint
import pytest


@pytest.fixture(scope="session")
def registry() -> pint.UnitRegistry:
    """One registry: quantities of two registries do not mix."""
    return pint.UnitRegistry()
