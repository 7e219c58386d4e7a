"""``ballscrew check``: from a row, shipped or one's own, or from a case to everything in one command."""

import json
import math

import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.physics.equations import life
from ballscrew.physics.sizing.catalogue import printed_rows
from ballscrew.physics.sizing.checks import loads_of_halves
from ballscrew.questions.check import answer
from support.commands import ROOT
from support.processes import refused

EXAMPLE = ROOT / "examples" / "catalogue_screw.toml"
SCREWS = ROOT / "examples" / "screws.csv"
NAME = "rexroth-40x10x6-6-double"
RPM = 2 * math.pi / 60

#: The same screw with other headings, a decimal comma and semicolons.
OWN = """\
Part number;Screw diameter [mm];Ph [mm];Ball size [mm];Circuits;Ca [kN];Coa [kN];Type of nut
mine;40;10;6,0;6;72,1;132,2;Double
bad;40;10;-6;6;72,1;132,2;Double
""".replace("Type of nut", "nut type")


def checked(name=NAME, **given):
    return answer.one(
        str(name), None, answer.Options({k.replace("__", "."): v for k, v in given.items()}, [], None), False
    )[0]


# -- a row ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("row", printed_rows(), ids=lambda row: row.name)
def test_every_row_shipped(row):
    """With its usual preload, at a tenth of its rating: all is finite, and a preload costs life."""
    found = checked(row.name)
    # the relieved flank of small oversize balls carries so little that its film is an estimate, and says so
    outside = {reason for reason, holds in found.run.friction.validity.items() if not holds}
    assert outside <= ({"elastic_regime"} if row.nut == "oversize-balls" else set())
    assert 0.7 < float(found.run.friction.efficiency) < 1
    without = found.check("life").value if not found.nut.preload else 1e9
    assert without == pytest.approx(1e9)
    assert (found.check("life").value < 0.9e9) == (found.nut.preload > 0)
    assert found.check("contact_pressure").holds
    assert all(check.holds is not False or check.name == "diameter_speed_product" for check in found.checks)


def test_what_is_given_counts():
    found = checked(
        operation__axial_load="10 kN",
        operation__screw_speed="1000 rpm",
        nut__type="single",
        lubricant__grade="VG68",
        lubricant__temperature="50 degC",
        installation__unsupported_length="4 m",
        installation__ends="fixed-free",
    )
    case = found.case
    assert (case.operation.axial_load, case.operation.screw_speed) == (10_000, pytest.approx(1000 * RPM))
    assert isinstance(found.nut.nut, bs.SingleNut)
    assert case.origins.oil["temperature"] == pytest.approx(323.15)
    assert found.check("critical_speed").holds is False
    assert "fails: buckling, critical speed" in found.verdict
    assumed = " ".join(found.assumed)
    for words in ("axial load", "speed 600", "as listed", "none was given"):
        assert words not in assumed
    assert "preload 7 % of C_a, usual for such a nut: none was given" in checked().assumed


def test_the_life_of_a_preloaded_nut_names_its_rule():
    """That of a duty is the standard's, which answers otherwise at one load."""
    rule = "life: by the loads of both flanks in the model; a duty has those of ISO 3408-5"
    preloaded, single = checked(nut__type="double"), checked(nut__type="single")
    assert rule in preloaded.assumed
    assert rule not in single.assumed
    load, rated = float(preloaded.case.operation.axial_load), preloaded.case.origins.listed["dynamic_load_rating"]
    nut = bs.DoubleNut(preloaded.nut.preload)
    by_the_standard = life.combined_life(*(life.basic_life(rated, each) for each in loads_of_halves(nut, load)))
    assert preloaded.check("life").value != pytest.approx(by_the_standard, rel=0.02)


def test_a_row_without_ratings_and_settings(ballscrew, tmp_path):
    (tmp_path / "own.csv").write_text("name,d0 [mm],Ph [mm],Dw [mm],i\nA,40,10,6.35,4\n", encoding="utf-8")
    process = ballscrew("check", "a", "--rows", "own.csv", "--set", "limits.running_time=20000 h")
    assert process.returncode == 0, process.stderr
    text = " ".join(process.stdout.split())
    assert "single nut, as the row lists none" in text
    assert "dynamic load rating computed from the geometry: none is listed" in text
    assert "dynamic axial load rating –" in text
    assert "life 1000 million 720 million 72.0% passes" in text


# -- a case ---------------------------------------------------------------------------------------


def test_a_case_is_checked_as_run_has_it(ballscrew):
    document = json.loads(ballscrew("check", EXAMPLE, "--json").stdout)
    alone = json.loads(ballscrew("run", EXAMPLE, "--json").stdout)
    assert document["results"] == alone["results"]
    assert document["loads"] == alone["loads"]
    assert document["inputs"] == alone["inputs"]
    assert document["verdict"] == "passes"
    assert all(check["passes"] is True for check in document["checks"])


def test_a_case_without_a_nut(ballscrew):
    drive = ROOT / "examples" / "feed_drive.toml"
    found = checked(drive)
    case = case_file.load(drive)
    alone = case.model(case.screw, case.lubricant, axial_load=5000.0, screw_speed=600 * RPM)
    # the contact angle opens under load, which the single ball does not know
    assert float(found.run.friction.screw_torque) == pytest.approx(float(alone.screw_torque), rel=0.02)
    assert "no [nut] given: a single nut" in found.assumed
    assert ballscrew("check", drive, "--nut", "double", "--preload", "5 kN").returncode == 0


def test_a_case_of_a_row_without_a_nut(tmp_path):
    text = EXAMPLE.read_text(encoding="utf-8")
    (tmp_path / "case.toml").write_text(text.replace("[nut]", "[lib]").replace("[lib]\npreload", "#"), encoding="utf-8")
    found = checked(tmp_path / "case.toml")
    assert isinstance(found.nut.nut, bs.DoubleNut)
    assert found.nut.nut.preload == 0
    assert "no [nut] given: the nut of the row, without preload" in found.assumed


# -- many rows ------------------------------------------------------------------------------------


def test_ones_own_screw_is_the_one_shipped(ballscrew, tmp_path):
    (tmp_path / "own.csv").write_text(OWN.replace("-6;", "6;"), encoding="cp1252")
    own = json.loads(ballscrew("check", "mine", "--rows", "own.csv", "--preload", "7 %", "--json").stdout)
    shipped = json.loads(ballscrew("check", NAME, "--preload", "7 %", "--json").stdout)
    assert shipped["results"].pop("rule_of_make") == "rexroth"  # the table of one's own has no make
    assert own["results"] == shipped["results"]
    assert own["checks"] == shipped["checks"]
    assert own["ratings"] == shipped["ratings"]


@pytest.mark.slow
def test_all_rows_of_a_table(ballscrew):
    process = ballscrew("check", "--rows", SCREWS)
    assert process.returncode == 0, process.stderr
    lines = process.stdout.splitlines()[2:]
    assert [line.split()[0] for line in lines] == ["name", "A-40x10-4", "A-40x10-5", "A-32x5-4.5", "A-50x20-3.5"]
    assert all("4 of 8 judged, and these hold" in line for line in lines[1:])
    documents = json.loads(ballscrew("check", "--rows", SCREWS, "--json").stdout)
    assert [document["name"] for document in documents] == [line.split()[0] for line in lines[1:]]
    assert "balls" not in documents[0]["loads"]
    listed = ballscrew("check", "double", "--all")
    names = [line for line in listed.stdout.splitlines() if line.startswith(("  rexroth", "  thk"))]
    assert len(names) == sum(row.nut == "double" and not row.refusal for row in bs.catalogue().values())


def test_bad_rows_are_named_and_good_ones_kept(ballscrew, tmp_path):
    (tmp_path / "own.csv").write_text(OWN, encoding="utf-8")
    problem = 'own.csv row 3, column "Ball size [mm]": must be positive (-6) · lengths are positive'
    refused(ballscrew("check", "--rows", "own.csv"), problem)
    refused(ballscrew("check", "mine", "--rows", "own.csv"), problem)
    process = ballscrew("check", "--rows", "own.csv", "--keep-going")
    assert process.returncode == 0
    assert process.stderr.splitlines() == [problem, "own.csv: 1 of 2 rows left out"]
    assert [line.split()[0] for line in process.stdout.splitlines()[2:]] == ["name", "mine"]
    assert ballscrew("check", "mine", "--rows", "own.csv", "--keep-going").returncode == 0
    (tmp_path / "own.csv").write_text(OWN.replace("mine;40", "mine;0"), encoding="utf-8")
    assert ballscrew("check", "--rows", "own.csv", "--keep-going").returncode == 2


# -- what is wrong --------------------------------------------------------------------------------


def test_a_check_that_fails_is_no_error(ballscrew):
    process = ballscrew("check", NAME, "--length", "9 m", "--ends", "fixed-free")
    assert process.returncode == 0
    assert "FAILS" in process.stdout


def test_long_verdicts_go_on_below_themselves(ballscrew):
    warm = ("--temperature", "60 degC")  # no row of a full bath beside it
    lines = ballscrew("check", "125x10x6.5-6-double", "--all", *warm).stdout.splitlines()[2:]
    place = lines[0].index("verdict")
    assert lines[1][place:].startswith("fails: diameter speed")
    assert len(lines) > 2
    assert all(line[:place].isspace() for line in lines[2:])
    words = " ".join(line[place:].strip() for line in lines[1:])
    assert words == "fails: diameter speed product; 4 of 8 judged"


def test_a_missing_speed_is_named_by_its_option(ballscrew, tmp_path):
    tables = '[screw]\ncatalogue = "rexroth-40x10x6-6-double"\n[lubricant]\nviscosity = "0.1 Pa s"\n'
    (tmp_path / "case.toml").write_text(tables, encoding="utf-8")
    refused(ballscrew("check", "case.toml", "--axial-load", "5 kN"), '--speed: missing · add --speed "…')


def test_a_verdict_says_of_what_where_the_case_has_a_cycle(ballscrew):
    """``check`` judges the operating point as if it lasted, ``duty`` the cycle: neither says it of the other."""
    case = str(ROOT / "examples" / "vertical_axis.toml")
    assert "verdict: this operating point for ever: fails: life, running time" in ballscrew("check", case).stdout
    assert "\nover the cycle: passes all checks" in ballscrew("duty", case).stdout


# -- sources ----------------------------------------------------------------------------------------


def test_a_recalled_check_that_passes_says_so(ballscrew):
    text = " ".join(ballscrew("check", NAME, "--set", "limits.running_time=100 h").stdout.split())
    assert "passes; by formulas as recalled: basic rating life L10" in text
    assert "passes: largest load over the core of the shaft" in text
    assert "passes; by an estimate: DN value" in text
    fails = " ".join(ballscrew("check", NAME, "--set", "limits.running_time=1000000 h").stdout.split())
    assert "FAILS; by formulas as recalled: basic rating life L10" in fails
