"""Nuts of few numbers as people write them: on the command line, in a table, over the API."""

import json
import tomllib

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.screw_tables.catalogue import screws
from ballscrew.cases.screw_tables.own_nut import numbers_in, own_nut_of
from support.commands import ROOT

FEW = "d0=40 mm, lead=10 mm, turns=2x2.5, Ca=52,7 kN, nut=Double nut, preload=5 %"


def test_numbers_by_the_names_of_catalogues():
    row = own_nut_of(numbers_in(FEW)).row
    assert (row.nominal_diameter, row.lead, row.turns, row.dynamic_load_rating) == (0.04, 0.01, 5.0, 52700.0)
    assert (row.nut, row.preload_share) == ("double", 0.05)
    german = own_nut_of({"Nenndurchmesser": "40 mm", "Steigung": "10 mm", "Umläufe": "5", "dyn. Tragzahl": "52,7 kN"})
    assert german.row.ball_diameter == row.ball_diameter


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ({"d0": "40 mm", "lead": "10 mm"}, "own-nut.turns: is missing"),
        ({"d0": "40", "lead": "10 mm", "turns": "5"}, "own-nut.nominal_diameter: needs a unit"),
        ({"d0": "40 mm", "lead": "10 mm", "turns": "5", "leed": "1 mm"}, "own-nut.leed: unknown number of a nut"),
        (
            {"d0": "40 mm", "nominal_diameter": "40 mm", "lead": "1 mm", "turns": "5"},
            "nominal_diameter: is given twice",
        ),
        ({"d0": "40 mm", "lead": "10 mm", "turns": "5", "Ca": "52 mm"}, "dynamic_load_rating: wrong unit"),
    ],
)
def test_numbers_that_cannot_be_read(numbers, words):
    with pytest.raises(InputError, match=words) as raised:
        own_nut_of(numbers)
    assert len(raised.value.faults) == 1


@pytest.mark.parametrize("text", ["d0", "d0=40 mm, =3", "d0=40 mm, d0=41 mm"])
def test_texts_that_are_no_numbers(text):
    with pytest.raises(InputError):
        numbers_in(text)


def test_the_command_writes_a_case_that_runs(ballscrew, tmp_path):
    process = ballscrew("catalogue", "own", FEW, "--case")
    assert process.returncode == 0, process.stderr
    (tmp_path / "own.toml").write_text(process.stdout, encoding="utf-8")
    case = case_file.load(tmp_path / "own.toml")
    found = own_nut_of(numbers_in(FEW)).row
    assert case.screw.loaded_balls == found.loaded_balls
    assert case.screw.ball_diameter == pytest.approx(found.ball_diameter)
    assert process.stdout.count("# estimated, ") == 9  # both conformities have theirs
    document = json.loads(ballscrew("catalogue", "own", FEW, "--json").stdout)
    assert document["case"] == tomllib.loads(process.stdout)
    assert {one["name"] for one in document["estimates"]} >= {"ball_diameter", "loaded_balls", "conformity"}


def test_a_table_whose_balls_are_estimated(tmp_path):
    (tmp_path / "own.csv").write_text(
        "d0 [mm];Ph [mm];Dw [mm];turns;Ca [kN]\n40;10;estimate;2x2.5;52.7\n40;10;6.35;5;52.7\n", encoding="utf-8"
    )
    rows = screws(tmp_path / "own.csv")
    estimated, given = rows.values()
    assert (
        estimated.ball_diameter
        == own_nut_of({"d0": "40 mm", "lead": "10 mm", "turns": "5", "Ca": "52.7 kN"}).row.ball_diameter
    )
    assert "ISO 3408-5" in estimated.ball_diameter_source
    assert (given.ball_diameter, given.ball_diameter_source) == (0.00635, "")
    assert rows.notes == ("own.csv: ball diameters are estimated of 1 rows: 40x10-5",)


def test_the_nuts_of_thk_are_read_and_none_is_odd():
    rows = screws(ROOT / "examples" / "thk_screws.csv")
    assert len(rows) == 97
    # by the lead, as the rows of one lead have one pitch circle; THK prints no ball
    assert all(0.3 < row.ball_diameter / row.lead < 0.7 for row in rows.values())
    assert len(rows.notes) == 1
    # one groove, whatever the nut: by its rating alone each row had another ball, 5.1 mm to 5.8 mm
    assert {row.ball_diameter for row in rows.values() if " 4010-" in row.name} == {0.00635}
