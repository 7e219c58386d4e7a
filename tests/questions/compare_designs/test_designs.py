"""``ballscrew compare`` of several case files, or of a project: the checks of each, and changes against the first."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ballscrew.faces.cli.main import app
from support.commands import ROOT
from support.documents import assert_same

PROJECT = str(ROOT / "examples" / "projects" / "two_oils.toml")


def output(*arguments):
    found = CliRunner().invoke(app, [*map(str, arguments)])
    assert found.exit_code == 0, found.exception
    return found.stdout


def documents(*arguments):
    return json.loads(output("compare", *arguments, "--json"))["designs"]


def test_each_design_is_that_of_check_and_changes_are_against_the_first():
    thick, thin = documents(PROJECT, "--own")
    alone = json.loads(output("check", f"{PROJECT}#thin oil", "--json"))
    kept = {name: thin[name] for name in ("inputs", "results", "checks", "holds")}
    assert_same(kept, {name: alone[name] for name in kept})
    torques = [one["results"]["screw_torque"] for one in (thick, thin)]
    assert thin["change"]["screw_torque"] == pytest.approx(torques[1] / torques[0] - 1)
    assert thick["change"]["screw_torque"] == 0


def test_all_at_the_load_and_speed_of_the_first(tmp_path):
    """And so two case files are what a project of the same cases is; without --own the oil alone differs."""
    designs = documents(PROJECT)
    assert len({one["inputs"]["operation"]["screw_speed"] for one in designs}) == 1
    assert designs[1]["results"]["screw_torque"] < designs[0]["results"]["screw_torque"]
    at = 'operation.screw_speed="1000 rpm"'
    alone = json.loads(output("run", f"{PROJECT}#thin oil", "--set", at, "--json"))
    assert_same(designs[1]["results"]["screw_torque"], alone["results"]["screw_torque"])
    text = output("compare", PROJECT, "--to", tmp_path / "designs.svg")
    assert "Changes are against thick oil" in text
    assert "thin oil" in (tmp_path / "designs.svg").read_text(encoding="utf-8")


def test_what_is_wrong_is_said_of_its_design(tmp_path):
    broken = tmp_path / "broken.toml"
    broken.write_text(Path(PROJECT).read_text(encoding="utf-8").replace("ISO VG 32", "ISO VG 33"))
    for arguments, words in (
        ([broken], "thin oil: lubricant.grade"),
        ([PROJECT, PROJECT], "two designs of one name (thick oil)"),
        ([f"{PROJECT}#thin oil", "--own"], "--own: is for several designs"),
        ([PROJECT, "--self-heating"], "--self-heating: is for one case"),
        ([f"{PROJECT}#no oil"], "has no such design"),
    ):
        found = CliRunner().invoke(app, ["compare", *map(str, arguments)])
        assert words in str(found.exception), found.exception
    found = CliRunner().invoke(app, ["run", PROJECT])
    assert "is a project of several designs (thick oil, thin oil)" in str(found.exception)
