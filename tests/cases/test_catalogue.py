"""``ballscrew catalogue``: rows shipped and rows of one's own, for people, programs and case files."""

import csv
import dataclasses
import json
import math
import re
from pathlib import Path

import numpy as np
import openpyxl
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.screw_tables.catalogue import case_text, chosen, named
from ballscrew.cases.screw_tables.nut_kinds import kind_in, kind_of
from ballscrew.physics.components.nut import NUTS
from ballscrew.physics.sizing.catalogue import SMALLEST_BALL, CatalogueRow, catalogue, printed_rows
from support.commands import ROOT
from support.processes import refused

DATA = Path(__file__).parents[1] / "data"
ROWS = catalogue()
KGF = 9.80665
GOOD = {"nominal_diameter": 0.04, "lead": 0.01, "ball_diameter": 0.006, "turns": 4}
PRINTED = printed_rows()
every_row = pytest.mark.parametrize("row", PRINTED, ids=lambda row: row.name)


def of_file(name):
    with (DATA / name).open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


# -- the rows shipped -----------------------------------------------------------------------------


@every_row
def test_rows_shipped_make_screws(row):
    screw = row.screw()
    assert screw.loaded_balls == row.loaded_balls
    assert row.nut in NUTS
    assert row.source
    assert row.name == row.name.lower()
    assert 10 <= row.balls_per_turn <= 60
    assert row.groove_root_diameter < row.nominal_diameter
    assert row.static_load_rating > row.dynamic_load_rating > 0


def test_rows_of_a_general_catalogue():
    """The law of their sizes: a ball fits its groove; each makes a screw, or says why no torque is computed of it."""
    rows = [row for row in ROWS.values() if row.make == "THK"]
    assert len(rows) == 608
    assert {row.ball_diameter_source for row in rows} == {"estimate"}
    depth = np.array([(row.pitch_circle_diameter - row.root_diameter) / row.ball_diameter for row in rows])
    assert np.all((depth > 1) & (depth < 1.3))
    assert all(row.static_load_rating > row.dynamic_load_rating > 0 for row in rows)
    assert all(re.fullmatch(r"THK General Catalog, PDF page \d+, line \d+", row.source) for row in rows)
    for row in rows:
        if not row.refusal:
            assert row.screw().loaded_balls == row.loaded_balls
    assert {row.family for row in rows if row.refusal} == {"SBN", "SBK", "HBN", "JPF rolled"}


def test_rows_of_which_no_torque_is_computed(ballscrew):
    text = "screw.catalogue: no torque is computed of this nut (thk-sbn3212-5) · balls in a cage"
    refused(ballscrew("check", "SBN3212-5"), text)
    assert json.loads(ballscrew("catalogue", "show", "SBN3212-5", "--json").stdout)["notes"][-1].startswith("no torque")


@pytest.mark.parametrize(("file", "kind"), [("rexroth_double_nut.csv", "double"), ("rexroth_single_nut.csv", "single")])
def test_rexroth_rows_are_those_of_the_tables(file, kind):
    found = of_file(file)
    assert sum(name.startswith("rexroth") and name.endswith(kind) for name in ROWS) == len(found)
    for line in found:
        size = (line[f"{name}_mm"] for name in ("nominal_diameter", "lead", "ball_diameter"))
        row = ROWS[f"rexroth-{'x'.join(size)}-{line['circuits']}-{kind}"]
        for name in ("nominal_diameter", "lead", "ball_diameter"):
            assert getattr(row, name) == pytest.approx(float(line[f"{name}_mm"]) / 1000, rel=1e-15)
        assert row.turns == int(line["circuits"])
        assert row.dynamic_load_rating == float(line["dynamic_load_rating_N"])
        assert row.static_load_rating == float(line["static_load_rating_N"])
        rigidity = line.get("rigidity_10pct_N_per_um")
        assert row.rigidity == (None if rigidity is None else float(rigidity) * 1e6)
        assert row.nut == {"double": "double", "single": "oversize-balls"}[kind]
        assert row.source == "Rexroth R310RU 3301 (2006.02)"


def test_hiwin_rows_are_those_of_the_table():
    found = of_file("hiwin_fsc.csv")
    assert sum(name.startswith("hiwin") for name in ROWS) == len(found)
    for line in found:
        row = ROWS[f"hiwin-{line['model'].lower()}"]
        for name in ("nominal_diameter", "lead", "ball_diameter", "pitch_circle_diameter", "root_diameter"):
            assert getattr(row, name) == pytest.approx(float(line[f"{name}_mm"]) / 1000, rel=1e-15)
        assert row.turns == int(line["circuits"])
        assert row.dynamic_load_rating == pytest.approx(float(line["dynamic_load_rating_kgf"]) * KGF, rel=1e-14)
        assert row.static_load_rating == pytest.approx(float(line["static_load_rating_kgf"]) * KGF, rel=1e-14)
        assert row.rigidity == pytest.approx(float(line["stiffness_kgf_per_um"]) * KGF * 1e6, rel=1e-14)
        assert (row.nut, row.source) == ("single", "HIWIN S99TE20-1610")


def test_what_is_said_of_pitch_circles_is_so():
    """Where none is listed, people read that those listed are 1.5 to 5 % larger than the nominal diameter."""
    listed = [row for row in ROWS.values() if row.pitch_circle_diameter]
    ratios = np.array([row.pitch_circle_diameter / row.nominal_diameter for row in listed])
    assert ratios.min() == pytest.approx(1.015)
    assert np.mean(ratios < 1.0501) > 0.89


def test_a_ball_in_the_wrong_unit_is_seen():
    with pytest.raises(
        InputError, match=r"A\.ball_diameter: too small for the pitch circle \(6e-06 m\) · check the unit"
    ):
        CatalogueRow(name="A", **{**GOOD, "ball_diameter": 6e-6})
    assert CatalogueRow(name="A", **{**GOOD, "ball_diameter": 1.001 * SMALLEST_BALL * 0.04})
    with pytest.raises(InputError, match="too small for the pitch circle"):
        CatalogueRow(name="A", **{**GOOD, "ball_diameter": 1e-320})


# -- for people -----------------------------------------------------------------------------------


def test_words_choose_the_rows_that_have_all_of_them():
    singles = [name for name in ROWS if name.startswith("rexroth") and name.endswith("single")]
    assert [row.name for row in chosen(ROWS, "Single REXROTH")] == singles


def test_sizes_are_those_of_the_row_and_not_of_its_name(ballscrew):
    def names(*words):
        return [line.split()[0] for line in ballscrew("catalogue", "list", *words).stdout.splitlines()[1:]]

    of_40 = [row.name for row in catalogue().values() if row.nominal_diameter == 0.04]
    assert names("40x") == of_40
    assert len([name for name in of_40 if name.startswith("hiwin")]) == 4
    assert names("hiwin", "40x20") == names("HIWIN", "40×20x4") == ["hiwin-40-20k4"]
    assert names("40x40x6", "single") == ["rexroth-40x40x6-2-single", "rexroth-40x40x6-3-single"]
    assert names("40x40x2") == ["rexroth-40x40x6-2-single"]
    assert names("x40") == [row.name for row in catalogue().values() if row.lead == 0.04]
    assert names("50x40x6.5-3") == ["rexroth-50x40x6.5-3-single"]


def test_show(ballscrew):
    process = ballscrew("catalogue", "show", "HIWIN-40-20K4")
    assert process.returncode == 0, process.stderr
    rows = {line[:60].strip(): line[60:].strip() for line in process.stdout.splitlines()}
    assert rows["dynamic axial load rating"] == "50.308 kN"
    assert rows["lead angle of the helix of the ball centres"] == "8.7421 deg"
    assert rows["whole balls that find room in one turn"] == "20"
    assert rows["balls of one nut body that carry load"] == "75"
    assert rows["pitch circle diameter that counts"] == "41.4 mm"
    root = rows["diameter at the bottom of the groove, from the conformity"]
    assert root == "34.911 mm (34.878 mm to 34.944 mm for a conformity of 0.54 ± 0.01; listed: 34.91 mm)"
    for text in ("conformity 0.54 ± 0.01, as most", "contact angle 45 deg, the usual one", "0.24 turns without load"):
        assert f"\n  {text}" in process.stdout
    assert "pitch circle as large" not in process.stdout
    assert "pitch circle as large" in ballscrew("catalogue", "show", "rexroth-40x10x6-6-double").stdout


@every_row
def test_a_case_is_the_screw_of_the_row(row, tmp_path):
    path = tmp_path / "my.toml"
    path.write_text(case_text(row), encoding="ascii")
    case = case_file.load(path)
    assert kind_of(case.nut) == (row.nut or "single")
    for field in dataclasses.fields(case.screw):
        if field.name == "nut":
            continue
        expected, found = getattr(row.screw(), field.name), getattr(case.screw, field.name)
        if isinstance(expected, bs.Material):
            assert dataclasses.astuple(found) == dataclasses.astuple(expected)
        else:
            assert found == pytest.approx(expected, rel=1e-12), field.name
    assert case.operation.axial_load == pytest.approx(row.dynamic_load_rating / 10, rel=1e-5)
    assert case.operation.screw_speed == pytest.approx(20 * math.pi)
    assert case.origins.oil == {"grade": "ISO VG 100", "temperature": pytest.approx(313.15)}


def test_json(ballscrew):
    document = json.loads(ballscrew("catalogue", "show", "rexroth-40x10x6-6-double", "--json").stdout)
    row = ROWS["rexroth-40x10x6-6-double"]
    assert (document["name"], document["nut"], document["source"]) == (row.name, row.nut, row.source)
    assert document["row"]["rigidity"] == 1250e6
    assert document["row"]["pitch_circle_diameter"] is None
    assert document["derived"]["loaded_balls"] == 121
    assert document["derived"]["groove_root_diameter"] == pytest.approx(row.groove_root_diameter)
    assert set(document["units"]["row"]) == set(document["row"])
    assert set(document["units"]["derived"]) == set(document["derived"])
    assert (document["units"]["row"]["rigidity"], document["units"]["derived"]["lead_angle"]) == ("N/m", "rad")
    assert set(document["assumed"]) == {
        "starts",
        "contact_angle",
        "conformity",
        "pitch_circle_diameter",
        "loaded_turns",
    }
    assert document["provenance"] == {"version": bs.__version__}
    listed = json.loads(ballscrew("catalogue", "list", "double", "--json").stdout)
    assert listed["rows"][3] == {key: document[key] for key in listed["rows"][3]}
    assert listed["units"] == document["units"]
    assert [found["name"] for found in listed["rows"]] == [row.name for row in ROWS.values() if row.nut == "double"]


# -- rows of one's own ----------------------------------------------------------------------------

OWN = """\
Part number;d0 [mm];Ph [mm];Dw [mm];i;Ca [kN];D1 [mm];alpha [°];f;Nut;starts
Größe 1;40;20;6,35;4;50,3;70;45;0,52;Double;2
;40;5;3,175;2,5;;;;;;
"""


@pytest.mark.slow
def test_rows_of_ones_own(ballscrew, tmp_path):
    (tmp_path / "own.csv").write_text(OWN, encoding="cp1252")
    process = ballscrew("catalogue", "list", "--rows", "own.csv")
    assert process.returncode == 0, process.stderr
    assert process.stderr == ""
    names = [line.split("  ")[0] for line in process.stdout.splitlines()[1:]]
    assert names == ["Größe 1", "40x5x3.175-2.5"]
    assert process.stdout.splitlines()[2].split()[-6:] == ["88", "-", "-", "own.csv", "row", "3"]
    case = ballscrew(
        "catalogue", "show", "größe 1", "--rows", "own.csv", "--case", environment={"PYTHONIOENCODING": "cp1252"}
    )
    (tmp_path / "my.toml").write_text(case.stdout, encoding="utf-8")
    screw = case_file.load(tmp_path / "my.toml").screw
    assert (screw.screw_conformity, screw.nut_conformity, screw.starts) == (0.52, 0.52, 2)
    assert "# Gr\\xf6\\xdfe 1: own.csv row 2" in case.stdout
    assert "Nut: double." in case.stdout
    unrated = ballscrew("catalogue", "show", "40x5x3.175-2.5", "--rows", "own.csv", "--case").stdout
    assert '"1 kN"' in unrated
    assert "an example; the row lists no dynamic load rating" in unrated
    (tmp_path / "my.toml").write_text(unrated, encoding="utf-8")
    assert ballscrew("run", "my.toml").returncode == 0
    shown = ballscrew("catalogue", "show", "Größe 1", "--rows", "own.csv").stdout
    assert "Assumed\n  contact angle 45 deg" in shown  # it says 45 deg itself, which is what is usual


def test_own_rows_as_the_vendors_list_them(ballscrew):
    for name, like in [("rexroth_double_nut.csv", "rexroth-16x5x3-4-double"), ("hiwin_fsc.csv", "hiwin-20-5k4")]:
        process = ballscrew("catalogue", "list", "--rows", DATA / name, "--json")
        assert process.returncode == 0, process.stderr
        first = json.loads(process.stdout)["rows"][0]["row"]
        # the vendor's table has no outer diameter of the nut; the row shipped has that of a standard, and says so
        assert first.pop("nut_outer_diameter") is None
        for field, value in first.items():
            expected = getattr(ROWS[like], field)
            assert value == (None if expected is None else pytest.approx(expected, rel=1e-12)), field


@pytest.mark.parametrize(
    ("words", "kind"),
    [("Doppelmutter", "double"), ("Einzelmutter", "single"), ("double", "double"), ("Double Nut", "double"),
     ("preloaded double nut", "double"), ("Flanged single nut", "single"), ("Flansch-Einzelmutter", "single"),
     ("vorgespannte Doppelmutter", "double"), ("oversized balls", "oversize-balls"), ("Offset lead", "offset-lead"),
     ("oversize-balls", "oversize-balls"), ("", "")],
)  # fmt: skip
def test_nuts_in_words(words, kind):
    assert kind_in(words) == kind


def test_kinds_of_nuts_are_not_guessed():
    """A single nut with preload may have oversize balls or an offset lead."""
    for words in ("preloaded single nut", "duble", "nut"):
        assert kind_in(words) not in NUTS
    assert all(kind_in(kind) == kind for kind in NUTS)


def test_an_unknown_row_is_one_of_its_file(ballscrew, tmp_path):
    (tmp_path / "own.csv").write_text(OWN, encoding="cp1252")
    problem = 'own.csv: unknown row (zzz) · see "ballscrew catalogue list --rows own.csv"'
    refused(ballscrew("catalogue", "show", "zzz", "--rows", "own.csv"), problem)
    refused(ballscrew("check", "zzz", "--rows", "own.csv"), problem)
    refused(ballscrew("catalogue", "list", "zzz", "--rows", "own.csv"), "own.csv: no row has these words (zzz)")


def test_a_spreadsheet_of_ones_own(ballscrew, tmp_path):
    book = openpyxl.Workbook()
    book.active.append(["model", "d0 [mm]", "Ph [mm]", "Dw [mm]", "turns"])
    book.active.append(["A", 40, 10, 6.35, 4])
    book.active.append(["A", 40, 10, 6.35, 3])
    book.active.append(["B", 40, 10, 25, 3])
    book.save(tmp_path / "own.xlsx")
    refused(
        ballscrew("catalogue", "list", "--rows", "own.xlsx"),
        'own.xlsx row 3, column "model": is given twice (A) · row 2 has it, too: name both apart',
        'own.xlsx row 4, column "Dw [mm]": too big for the pitch circle (25) · keep it below half the pitch circle '
        "diameter, 20 mm",
    )
    process = ballscrew("catalogue", "list", "--rows", "own.xlsx", "--keep-going")
    assert process.returncode == 0
    assert [line.split()[0] for line in process.stdout.splitlines()] == ["name", "A"]
    assert process.stderr.splitlines()[-1] == "own.xlsx: 2 of 3 rows left out"
    assert len(process.stderr.splitlines()) == 3


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("Double", "duble", 'own.csv row 2, column "Nut": unknown kind of nut (duble) · did you mean "double"?'),
        ("6,35", "-6,35", 'own.csv row 2, column "Dw [mm]": must be positive (-6,35) · lengths are positive'),
        ("6,35", "", 'own.csv row 2, column "Dw [mm]": is empty'),
        (
            "6,35",
            "0,00635",
            'column "Dw [mm]": too small for the pitch circle (0,00635) · check the unit; 0.04 mm or more',
        ),
        ("0,52", "0,5", 'own.csv row 2, column "f": must be above 0.5 (0,5)'),
        ("45", "90", 'own.csv row 2, column "alpha [°]": must be below 90 deg (90)'),
        ("4;50,3", "0,2;50,3", 'own.csv row 2, column "i": must be above 0.24 (0,2)'),
        ("4;50,3", "1e308;50,3", 'own.csv row 2, column "i": must be at most 100 (1e308)'),
        ("50,3", "50.300,5", 'own.csv row 2, column "Ca [kN]": has a separator of thousands (50.300,5)'),
        ("Dw [mm]", "Dw", 'own.csv column "Dw": needs a unit · write "Dw [mm]"'),
        (
            "Dw [mm]",
            "ball_diametr [mm]",
            'own.csv: has no column "ball_diameter [mm]" · write it for "ball_diametr [mm]"',
        ),
        ("Ca [kN]", "Ph_mm", 'own.csv column "Ph_mm": means the same as "Ph [mm]"'),
        (OWN, "", "own.csv: is empty"),
        (OWN[OWN.index("Größe") :], "", "own.csv: has no rows below its headings"),
        (
            "70",
            "46,3",
            'column "D1 [mm]": leaves no wall around the balls (46,3) · check the unit and the column; above 46.35 mm',
        ),
        (";20;", ";1;", 'column "Dw [mm]": too big for the lead: balls of neighbouring turns overlap (6,35) · keep it'),
    ],
)
def test_bad_rows(old, new, expected, ballscrew, tmp_path):
    assert old in OWN
    (tmp_path / "own.csv").write_text(OWN.replace(old, new, 1), encoding="utf-8")
    refused(ballscrew("catalogue", "list", "--rows", "own.csv"), expected)


def test_files_that_are_no_table(ballscrew, tmp_path):
    refused(ballscrew("catalogue", "list", "--rows", "none.csv"), "none.csv: does not exist")
    refused(ballscrew("catalogue", "list", "--rows", tmp_path), "cannot be read (Is a directory)")
    (tmp_path / "bad.csv").write_text("d0 [mm];Ph [mm];Dw [mm];i\n40;-1;6;4\n", encoding="utf-8")
    refused(ballscrew("catalogue", "list", "--rows", "bad.csv", "--keep-going"), "must be positive (-1)")


def test_a_name_that_the_catalogue_in_python_does_not_have():
    rows = bs.catalogue()
    with pytest.raises(bs.InputError, match=r'catalogue: unknown row .*did you mean "rexroth-40x10x6-6-double"'):
        rows["rexroth-40x10x6-6-doubel"]
    with pytest.raises(KeyError, match="known: rexroth"):
        rows["typo"]
    assert rows.get("typo") is None
    assert "typo" not in rows


def test_a_case_is_loaded_by_its_path_as_text():
    path = ROOT / "examples" / "feed_drive.toml"
    assert case_file.load(str(path)).screw == case_file.load(path).screw
    with pytest.raises(bs.InputError, match=r"nowhere\.toml: does not exist"):
        case_file.load("nowhere.toml")


def test_outer_diameters_of_nuts_say_where_they_are_from(ballscrew, tmp_path):
    """Rows shipped name the standard; a column of one's own is the vendor's, whatever it is called."""
    given = [row for row in ROWS.values() if row.nut_outer_diameter is not None]
    assert len(given) == 28
    assert all(row.nut_outer_diameter_source.startswith("DIN 69051-5") for row in given)
    assert all(row.nut_outer_diameter > row.ball_circle + row.ball_diameter for row in given)
    assert all(not row.nut_outer_diameter_source for row in ROWS.values() if row.nut_outer_diameter is None)
    for heading in ("D1 [mm]", "D_1 (mm)", "nut_outer_diameter_mm"):
        (tmp_path / "own.csv").write_text(f"d0 [mm],Ph [mm],Dw [mm],i,{heading}\n40,10,6,4,63\n", encoding="utf-8")
        process = ballscrew("catalogue", "list", "--rows", tmp_path / "own.csv", "--json")
        assert json.loads(process.stdout)["rows"][0]["row"]["nut_outer_diameter"] == pytest.approx(0.063)


def test_the_head_of_a_case_calls_a_preload_an_example_only_where_it_is_one():
    listed = ROWS["hiwin-40-20k4"]
    examples = "# The screw of a catalogue row; preload, oil and operating point are examples."
    others = "# The screw of a catalogue row; oil and operating point are examples."
    assert others in case_text(listed)
    double = dataclasses.replace(listed, nut="double")
    assert examples in case_text(double)
    assert others in case_text(dataclasses.replace(double, preload=2400.0))
    assert others in case_text(dataclasses.replace(double, preload_share=0.05))


@pytest.mark.parametrize("name", ["BNFN4010-5", "bnfn 4010-5", "THK BNFN4010-5", "THK BNFN 4010-5", "thk-bnfn4010-5"])
def test_a_part_number_is_found_as_its_catalogue_prints_it(name):
    assert named(catalogue(), name).name == "thk-bnfn4010-5"


def test_a_ball_that_no_catalogue_prints_is_marked():
    thk, hiwin = (catalogue()[name] for name in ("thk-bnfn4010-5", "hiwin-40-5k5"))
    assert 'ball_diameter = "6.35 mm"               # an estimate, by the depth of the groove' in case_text(thk)
    assert "# an estimate" not in case_text(hiwin)
