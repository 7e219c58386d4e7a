"""Cases that the page starts from: the examples of the repository, byte by byte."""

from importlib import resources

import pytest

from ballscrew.faces.page.starts import logs, starts
from support.commands import ROOT


@pytest.mark.parametrize("name", [name for name, start in starts().items() if start["moves"]])
def test_a_start_is_the_example_of_its_name(name):
    file = f"{name.replace('-', '_')}.toml"
    shipped = resources.files("ballscrew").joinpath(f"data/starts/{file}").read_bytes()
    assert shipped == (ROOT / "examples" / file).read_bytes()
    assert {"axis", "motion"} <= set(starts()[name]["case"])


def test_logs_to_try_are_examples():
    folder = resources.files("ballscrew").joinpath("data/logs")
    shipped = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert shipped == {name: (ROOT / "examples" / name).read_bytes() for name in shipped}
    given = {one["name"] for found in logs().values() for one in found["logs"]}
    assert {*given, *(found["file"] for found in logs().values())} == set(shipped)
    # without the constant torque free, too, the first warning of the example would ask for it
    assert logs()["fit"]["free"] == ["friction.boundary_friction_coefficient", "constant_torque"]
