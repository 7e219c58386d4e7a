"""``ballscrew list``: each name is one that the program takes."""

import json

import pytest
from typer.testing import CliRunner

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.cases.schema.case_schema import MODELS
from ballscrew.faces.cli import main
from ballscrew.physics.friction.model import LAWS
from ballscrew.questions.names import KINDS, names, text


def test_every_name_is_known_where_it_is_used():
    assert {one.name for one in names("models")} == set(MODELS)
    assert {(one.group, one.name) for one in names("laws")} == {(s, law) for s, laws in LAWS.items() for law in laws}
    for one in names("grades"):
        assert bs.Lubricant.from_grade(one.name, temperature=313.15).grade == one.name


def test_every_name_has_a_meaning():
    assert [one for kind in KINDS for one in names(kind) if not one.meaning] == []


def test_inputs_and_outputs_are_those_of_the_case(example):
    case = case_file.load(example)
    inputs = {one.name for one in names("inputs", case)}
    assert "axial_load" in inputs
    assert "preload" not in inputs
    assert "preload" in {one.name for one in names("inputs")}
    assert "screw_torque" in {one.name for one in names("outputs", case)}


def test_the_command_lists_by_word_and_as_json(ballscrew):
    found = ballscrew("list", "grades", "--word", "vg 1", "--json")
    listed = [one["name"] for one in json.loads(found.stdout)["results"]["grades"]]
    assert listed == ["ISO VG 10", "ISO VG 15", "ISO VG 100", "ISO VG 150"]
    shown = ballscrew("list", "grades", "--word", "vg 1").stdout
    assert [line.partition("  ")[0].strip() for line in shown.splitlines()] == listed


def test_groups_have_headings():
    lines = text(names("laws")).splitlines()
    assert lines[0] == "frame:"
    assert any(line.startswith("hamrock-dowson ") for line in lines)


@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_the_shell_completes_commands(shell):
    words = {"COMP_WORDS": "ballscrew hand", "COMP_CWORD": "1", "_TYPER_COMPLETE_ARGS": "ballscrew hand"}
    environment = {"_BALLSCREW_COMPLETE": f"complete_{shell}", **words}
    done = CliRunner().invoke(main.app, [], prog_name="ballscrew", env=environment)
    assert "hand-over" in done.stdout
