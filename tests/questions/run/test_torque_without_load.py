"""The torque without load is of the whole nut, with seals, everywhere; rules know balls alone, and so their base."""

import json
import math
import re

import pytest

from ballscrew.cases.case_files import case_file
from ballscrew.cases.screw_tables.catalogue import case_text, screws
from ballscrew.questions.compare.compute import comparison
from ballscrew.questions.run.compute import run
from support.commands import ROOT

AXIS = ROOT / "examples" / "vertical_axis.toml"  # seals of 0.3 N m
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


@pytest.mark.slow
def test_the_table_has_the_base_that_its_changes_are_relative_to(ballscrew):
    text = ballscrew("compare", AXIS).stdout
    lines = text[text.index("\n  this case") + 1 :].splitlines()[:3]
    own, base, first = (re.split(r"\s{2,}", line.strip()) for line in lines)
    assert "case" not in own[1:]
    assert base[0] == "this case, without seals, as all below"
    assert base[2] == "case"
    value, torque = (float(cells[1].removesuffix(" N m")) for cells in (first, base))
    assert float(first[2].rstrip("%")) == pytest.approx(100 * (value / torque - 1), abs=0.1)
    document = json.loads(ballscrew("compare", AXIS, "--json").stdout)
    assert document["drag_torque"] == json.loads(ballscrew("run", AXIS, "--json").stdout)["results"]["preload_drag"]
    assert document["of_balls"]["losses"] == {"seals": 0.3}


#: THK's worked example (THKGeneral, A-689): 3 kN on a lead of 10 mm; balls and turns are those of its row.
BNFN4010 = """
[screw]
pitch_circle_diameter = "41.75 mm"
lead = "10 mm"
ball_diameter = "6.35 mm"
loaded_balls = 95
contact_angle = "45 deg"
screw_conformity = 0.54
nut_conformity = 0.54
[nut]
type = "double"
preload = "3 kN"
[losses]
seals.seal_torque = "0.4 N m"
[lubricant]
grade = "ISO VG 100"
temperature = "25 degC"
[operation]
axial_load = "3 kN"
screw_speed = "100 rpm"
"""


def test_the_answer_names_what_makers_say(tmp_path, ballscrew):
    """By the rules of JIS B 1192 (0.865 N m, as THK prints it), Rexroth and HIWIN, beside that of the balls alone."""
    case = tmp_path / "bnfn4010.toml"
    case.write_text(BNFN4010, encoding="utf-8")
    document = json.loads(ballscrew("run", case, "--json").stdout)
    found, units = document["results"], document["units"]
    assert found["rules"]["jis"] == pytest.approx(0.865, abs=5e-4)
    assert found["rules"]["rexroth"] == pytest.approx(0.004 * 3000 * 0.04175, rel=1e-12)
    phi, rho = math.atan(10 / (math.pi * 41.75)), math.radians(0.286)
    eta, back = math.tan(phi) / math.tan(phi + rho), math.tan(phi - rho) / math.tan(phi)
    assert found["rules"]["hiwin"] == pytest.approx((1 / eta - back) * 3000 * 0.010 / (2 * math.pi), rel=1e-12)
    assert (
        units["rules"]
        == dict.fromkeys(found["rules"], units["preload_drag_of_balls"])
        == dict.fromkeys(("jis", "rexroth", "hiwin"), "N m")
    )
    assert found["preload_drag_of_balls"] == pytest.approx(found["preload_drag"] - 0.4, rel=1e-12)
    assert "rule_of_make" not in found
    assert document["vendor_rows"]["maker"] == "Rexroth"
    for command in ("run", "check"):
        said = " ".join(ballscrew(command, case).stdout.split())
        balls = found["preload_drag_of_balls"]
        for label, torque in (("THK (JIS B 1192)", 0.8646), ("Rexroth", 0.501), ("HIWIN", 0.6288)):
            assert f"by the rule of {label}; model / rule {balls / torque:.2f} {torque:.4g} N m" in said
        assert "the rules of makers contradict each other here by a factor of 1.73" in said
        assert "these are rows of Rexroth, and the make of this nut is not known" in said


@pytest.mark.parametrize("command", ["run", "check"])
def test_what_of_it_are_seals_stands_below_it(ballscrew, command):
    lines = [" ".join(line.split()) for line in ballscrew(command, AXIS).stdout.splitlines()]
    at = next(place for place, line in enumerate(lines) if line.startswith("drag torque with seals"))
    assert lines[at + 1] == "of which seals 0.3 N m"


@pytest.mark.slow
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
    assert "of which seals (standard seals of Rexroth2006, not of THK) 0.4 N m" in text
