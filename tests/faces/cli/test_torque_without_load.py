"""The torque without load is of the whole nut, with seals, everywhere; rules know balls alone, and so their base."""

import json
from pathlib import Path

import pytest

from ballscrew.cases.case_files import case_file
from ballscrew.cases.screw_tables.catalogue import case_text, screws
from ballscrew.questions.compare.compute import comparison
from ballscrew.questions.run.compute import run

AXIS = Path(__file__).parents[3] / "examples" / "vertical_axis.toml"  # seals of 0.3 N m
OWN = """name;make;d0 [mm];Ph [mm];Dw [mm];turns;Ca [kN];nut;preload;seals
A;THK;40;10;6;5;50;double;7 %;standard
B;Rexroth;40;10;6;5;50;double;7 %;standard
C;THK;40;10;6;5;50;double;7 %;0.4 N m
D;;40;10;6;5;50;double;7 %;standard
"""


@pytest.fixture(scope="module")
def found():
    return comparison(case_file.load(AXIS))


def test_it_is_the_same_in_all_commands(found):
    of_run = run(case_file.load(AXIS)).nut
    assert found.drag_torque == pytest.approx(of_run.preload_drag, rel=1e-9)
    assert of_run.idle_losses == {"seals": 0.3}
    bare = run(case_file.load(AXIS, ['losses.seals.seal_torque="0 N m"'])).nut
    assert found.drag_torque - bare.preload_drag == pytest.approx(0.3, rel=1e-9)


def test_rules_are_held_against_the_balls(found):
    bare = run(case_file.load(AXIS, ['losses.seals.seal_torque="0 N m"']))
    balls = found.of_balls
    assert balls.losses == {"seals": pytest.approx(0.3)}
    assert balls.screw_torque == pytest.approx(float(bare.friction.screw_torque), rel=1e-9)
    assert balls.drag_torque == pytest.approx(bare.nut.preload_drag, rel=1e-9)
    assert balls.efficiency == pytest.approx(float(bare.friction.efficiency), rel=1e-9)
    for rule in found.rules:
        for value, change, base in (
            (rule.screw_torque, rule.change, balls.screw_torque),
            (rule.drag_torque, rule.drag_change, balls.drag_torque),
        ):
            assert base * (1 + change) == pytest.approx(value, rel=1e-9, nan_ok=True)


def test_the_table_has_the_base_that_its_changes_are_relative_to(ballscrew):
    text = ballscrew("compare", AXIS).stdout
    own, base, first = text[text.index("\nthis case") + 1 :].splitlines()[:3]
    assert "case" not in own.split()[2:]
    assert base.startswith("without seals, as all below")
    torque, mark = base.split()[5:7]
    assert mark == "case"
    value, change = first.split()[3:5]
    assert float(change.rstrip("%")) == pytest.approx(100 * (float(value) / float(torque) - 1), abs=0.1)
    document = json.loads(ballscrew("compare", AXIS, "--json").stdout)
    assert document["drag_torque"] == json.loads(ballscrew("run", AXIS, "--json").stdout)["results"]["preload_drag"]
    assert document["of_balls"]["losses"] == {"seals": 0.3}


@pytest.mark.parametrize("command", ["run", "check"])
def test_what_of_it_are_seals_stands_below_it(ballscrew, command):
    lines = [" ".join(line.split()) for line in ballscrew(command, AXIS).stdout.splitlines()]
    at = next(place for place, line in enumerate(lines) if line.startswith("torque without load"))
    assert lines[at + 1] == "of it seals 0.3 N m"


def test_seals_of_another_maker_are_called_so(tmp_path, ballscrew):
    table = tmp_path / "own.csv"
    table.write_text(OWN, encoding="utf-8")
    rows = screws(table)
    source = {name: row.seal_torque_source for name, row in rows.items()}
    assert source == {
        "A": "standard seals of Rexroth2006, not of THK",
        "B": "standard seals of Rexroth2006",
        "C": "",
        "D": "standard seals of Rexroth2006, of whatever make the nut is",
    }
    lines = {
        name: next(line for line in case_text(row).splitlines() if "seal_torque" in line) for name, row in rows.items()
    }
    assert lines["A"].endswith("# standard seals of Rexroth2006, not of THK")
    assert lines["C"].endswith("# as listed")
    text = " ".join(ballscrew("check", "A", "--rows", table).stdout.split())
    assert "seals 0.4 N m: standard seals of Rexroth2006, not of THK; give the torque of your seals" in text
    assumed = json.loads(ballscrew("check", "A", "--rows", table, "--json").stdout)["assumed"]
    assert any("not of THK" in line for line in assumed)
