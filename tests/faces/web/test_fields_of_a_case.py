"""Every field of a case, one by one, against the OpenAPI description.

A file of its own: schemathesis makes the thousand requests while tests are collected, which takes seconds in each
worker. ``conftest.py`` leaves it out of runs without long tests.
"""

import pytest

from .test_schema_of_the_api import FEW, check, one_by_one


@pytest.mark.long
@one_by_one.include(path="/api/v1/toml").parametrize()  # of one address, as all read a case in the same way
@FEW
def test_fields_of_a_case(case):
    check(case)
