"""The coverage on the page on uncertainty is what its command writes."""

import pytest

import uncertainty_tables

from .pages import DOCS


@pytest.mark.long
def test_the_coverage_is_current():
    """If it was meant to move: python docs/uncertainty_tables.py --write."""
    assert (DOCS / "coverage.inc").read_text(encoding="utf-8") == uncertainty_tables.coverage_table()
