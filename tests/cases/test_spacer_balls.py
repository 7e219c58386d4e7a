"""Spacer balls in case files, in tables of screws, in ratings and in what is said of a result."""

import dataclasses
import json

import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file, descriptions, nut_tables
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.cases.screw_tables import catalogue
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.questions.shared import every_row
from support.drive_case import drive_case

TABLE = """\
Part number;d0 [mm];Ph [mm];Dw [mm];i;Ca [kN];Preload;Nut;Spacer balls
A;40;10;6;6;50;7 %;double;yes
B;40;10;6;6;50;7 %;double;no
C;40;10;6;6;50;7 %;double;
D;40;10;6;6;;7 %;double;1:1
E;40;10;6;6;50;;single;ja
"""


@pytest.fixture
def written(tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text(drive_case(), encoding="utf-8")
    return path


@pytest.fixture
def rows(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text(TABLE, encoding="utf-8")
    return bs.screws(path)


def test_a_case_file_has_them(written):
    case = case_file.load(written, ["nut.spacer_balls=true"])
    plain = case_file.load(written)
    assert case.screw.nut == dataclasses.replace(plain.screw.nut, spacer_balls=True)
    assert (case.screw.loaded_balls, case.screw.carrying_balls) == (121, 60.5)
    assert inputs(case)["nut"]["spacer_balls"] is True
    said = descriptions.assumptions(case)
    assert "every second ball is a spacer: 60.5 of 121 carry; ratings as listed" in said
    assert "force between balls none: spacer balls part them" in said
    assert not any("model / vendor" in text for text in said)  # no row of a vendor has them
    assert any("model / vendor" in text for text in descriptions.assumptions(plain))
    with pytest.raises(InputError, match=r"^nut\.spacer_balls: must be true or false"):
        case_file.load(written, ["nut.spacer_balls=often"])


def test_a_single_nut_of_equal_balls_has_them(written):
    case = case_file.build({**case_file.read(written), "nut": {"type": "single", "spacer_balls": True}})
    assert case.nut.spacer_balls


def test_ratings_are_of_the_balls_that_carry(written):
    """By ISO 3408-5 the dynamic rating goes with the balls of a turn to the power 2/3, the static one with them."""
    row = bs.catalogue()["rexroth-40x10x6-6-double"]
    full, half = ratings_of(row), ratings_of(dataclasses.replace(row, spacer_balls=True))
    assert half.dynamic / full.dynamic == pytest.approx(0.5 ** (2 / 3), rel=1e-12)
    assert half.static / full.static == pytest.approx(0.5, rel=1e-12)
    case = case_file.load(written, ["nut.spacer_balls=true"])
    assert nut_tables.screw_ratings(case.screw, case.origins.row) == pytest.approx(half)
    assert nut_tables.screw_ratings(case_file.load(written).screw, case.origins.row) == pytest.approx(full)


def test_tables_of_screws_have_a_column(rows):
    assert [row.spacer_balls for row in rows.values()] == [True, False, None, True, True]
    assert rows["A"].screw().nut == bs.DoubleNut(0.07 * 50e3, spacer_balls=True)
    assert rows["B"].screw().nut == rows["C"].screw().nut == bs.DoubleNut(0.07 * 50e3)
    # a share of a rating that is not listed is one of the balls that carry
    computed = ratings_of(dataclasses.replace(rows["D"], spacer_balls=True)).dynamic
    assert rows["D"].screw().nut == bs.DoubleNut(0.07 * computed, spacer_balls=True)
    assert rows["E"].screw().nut == bs.SingleNut(spacer_balls=True)


def test_a_word_that_is_neither_yes_nor_no_is_refused(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text(TABLE.replace(";yes", ";sometimes"), encoding="utf-8")
    with pytest.raises(
        InputError, match=r'column "Spacer balls": is not a word that is known .sometimes. · write one of'
    ):
        bs.screws(path)


@pytest.mark.parametrize(("name", "has"), [("A", True), ("B", False), ("C", True), ("E", True)])
def test_a_row_says_it_in_place_of_the_case(rows, tmp_path, name, has):
    """What a row leaves open is that of the case."""
    tables = {**case_file.read(_written(tmp_path, "spacer_balls = true")), "model": {}}
    own = every_row.tables_of_row(tables, rows[name], tmp_path / "own.csv")
    case = case_file.build(own, folder=tmp_path, rows={name: rows[name]})
    assert case.screw.nut.spacer_balls == has


def _written(folder, more):
    path = folder / "case.toml"
    path.write_text(drive_case().replace('type = "double"', f'type = "double"\n{more}'), encoding="utf-8")
    return path


def test_the_case_of_a_row_keeps_them(rows, tmp_path):
    path = tmp_path / "of_row.toml"
    path.write_text(catalogue.case_text(rows["A"]), encoding="utf-8")
    assert case_file.load(path).screw.nut.spacer_balls
    assert "spacer" not in catalogue.case_text(rows["B"])


@pytest.mark.slow
def test_a_band_is_that_of_the_nut_with_them(ballscrew, written):
    def median(*settings):
        done = ballscrew(
            "run", written, "--band", "--json", "--samples", 64, "--set", "lubricant.temperature=40 degC", *settings
        )
        return json.loads(done.stdout)["band"]["screw_torque"]["median"]

    assert median("--set", "nut.spacer_balls=true") < 0.8 * median()


def test_a_row_in_python_has_them():
    row = CatalogueRow(name="A", nominal_diameter=0.04, lead=0.01, ball_diameter=0.006, turns=6, spacer_balls=True)
    assert row.screw().nut == bs.SingleNut(spacer_balls=True)
