"""Cases that the page starts from: the examples of the repository, byte by byte."""

from importlib import resources

import pytest

from ballscrew.web.starts import starts
from support.commands import ROOT


@pytest.mark.parametrize("name", [name for name, start in starts().items() if start["moves"]])
def test_a_start_is_the_example_of_its_name(name):
    file = f"{name.replace('-', '_')}.toml"
    shipped = resources.files("ballscrew").joinpath(f"data/starts/{file}").read_bytes()
    assert shipped == (ROOT / "examples" / file).read_bytes()
    assert {"axis", "motion"} <= set(starts()[name]["case"])
