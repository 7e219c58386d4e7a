"""``--rows`` of run, check, sweep and fit: all screws of a table in place of that of a case."""

import csv
import io
import json
import math
import tomllib
from pathlib import Path

import numpy as np
import openpyxl
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files import case_file
from ballscrew.questions.shared import every_row
from ballscrew.questions.sweep import table
from support.fit_logs import PAPER, TRUE_FRICTION, columns, text_of
from support.processes import refused

TABLE = """\
name;d0 [mm];Ph [mm];Dw [mm];i;Ca [kN];Preload;Seals;D1 [mm];Nut;log
A;40;10;6,35;4;50,3;7 %;0,3 N m;;double;
B;40;10;6,35;4;50,3;;none;;single;
C;32;5;3,175;5;19,6;;;;double;
"""
CASE = """\
[screw]
catalogue = "rexroth-40x10x6-6-double"
nut_roughness = "0.2 um"

[nut]
type = "double"
preload = "5 %"
spacing = "10 mm"

[losses]
seals.seal_torque = "0.1 N m"

[lubricant]
grade = "ISO VG 100"
temperature = "40 degC"

[operation]
axial_load = "4 kN"
screw_speed = "600 rpm"
"""
OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
SPEED = 600 * math.pi / 30
#: A row that no nut can be: its fault is found when the table is read; and one that only the case is at odds with.
BAD = "D;40;10;6,35;4;50,3;7 %;;;single;\n"
UNLISTED = "E;40;10;6,35;4;50,3;;;;offset lead;\n"


@pytest.fixture
def place(tmp_path):
    (tmp_path / "own.csv").write_text(TABLE, encoding="utf-8")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    return tmp_path


def screws_of(place):
    """The screws as the case and the rows together describe them, in Python."""
    rows, rough = bs.screws(place / "own.csv"), {"nut_roughness": 0.2e-6}
    seals = {"seals": bs.Seals(0.1)}
    return {
        "A": rows["A"].screw(**rough, nut=bs.DoubleNut(0.07 * 50300, 0.01, losses={"seals": bs.Seals(0.3)})),
        "B": rows["B"].screw(**rough, nut=bs.SingleNut(angle_under_load=True)),
        "C": rows["C"].screw(**rough, nut=bs.DoubleNut(0.05 * 19600, 0.01, losses=seals)),
    }


def torque(screw, load=4000.0):
    return float(bs.FrictionModel.reference()(screw, OIL, axial_load=load, screw_speed=SPEED).screw_torque)


def read_csv(text):
    return list(csv.DictReader(io.StringIO(text)))


# -- a case and a row -----------------------------------------------------------------------------


def test_a_row_counts_before_the_case_and_the_case_for_the_rest(place):
    found = every_row.cases(place / "case.toml", place / "own.csv")
    assert {name: each.case.screw for name, each in found.found.items()} == screws_of(place)
    only = every_row.cases(
        place / "case.toml", place / "own.csv", "a", settings=["nut.preload=2 kN", "bodies.same_side=true"]
    )
    (name,) = only.found
    assert name == "A"
    assert only.found["A"].case.screw.nut.preload == 2000.0
    assert only.found["A"].case.screw.nut.bodies is not None


def test_sizes_of_bodies_of_the_case_are_of_its_own_screw(place):
    tables = {"bodies": {"screw_diameter": "30 mm", "same_side": False}, "nut": {"preloda": "1 kN"}}
    row = bs.screws(place / "own.csv")["A"]
    made = every_row.tables_of_row(tables, row, place / "own.csv")
    assert made["bodies"] == {"same_side": False}
    assert made["nut"] == {"preloda": "1 kN"}  # no field of any nut: a fault of the case, to be found


def test_a_share_of_a_rating_that_is_not_listed_is_that_of_python(place):
    """The rating follows from the geometry: what the case says of the surfaces does not count."""
    (place / "own.csv").write_text(TABLE.replace("50,3", ""), encoding="utf-8")
    found = every_row.cases(place / "case.toml", place / "own.csv", "A").found["A"].case.screw
    assert found.nut_roughness == 0.2e-6
    assert found.nut.preload == bs.screws(place / "own.csv")["A"].screw().nut.preload


# -- run ------------------------------------------------------------------------------------------


def test_run(ballscrew, place):
    process = ballscrew("run", "case.toml", "--rows", "own.csv", "--to", "out.csv")
    assert process.returncode == 0, process.stderr
    assert [line.split()[0] for line in process.stdout.splitlines()[2:6]] == ["name", "A", "B", "C"]
    assert process.stderr == "out.csv: 3 screws\n"
    rows = read_csv((place / "out.csv").read_text(encoding="utf-8"))
    expected = {name: pytest.approx(torque(screw), rel=1e-11) for name, screw in screws_of(place).items()}
    assert {row["name"]: float(row["screw torque [N m]"]) for row in rows} == expected
    assert [row["nut"] for row in rows] == ["double", "single", "double"]
    listed = json.loads(ballscrew("run", "case.toml", "--rows", "own.csv", "--row", "C", "--json").stdout)
    assert [each["name"] for each in listed] == ["C"]
    assert listed[0]["results"]["screw_torque"] == expected["C"]
    assert "balls" not in listed[0]["loads"]


def test_faulty_rows(ballscrew, place):
    command = ("run", "case.toml", "--rows", "own.csv", "--to", "out.csv")
    (place / "own.csv").write_text(TABLE + BAD, encoding="utf-8")
    problem = 'own.csv row 5, column "Preload": a nut of type "single" has none (7 %)'
    refused(ballscrew(*command), problem)
    (place / "own.csv").write_text(TABLE + BAD + UNLISTED, encoding="utf-8")
    (place / "case.toml").write_text(CASE.replace('preload = "5 %"\n', 'oversize = "1 um"\n'), encoding="utf-8")
    process = ballscrew(*command, "--keep-going")
    assert process.returncode == 0
    # a double nut has no oversize, so that none is left of the preload of the case
    assert [line.split()[0] for line in process.stdout.splitlines()[2:5]] == ["name", "A", "B"]
    lines = process.stderr.splitlines()
    assert lines[0] == "out.csv: 2 screws"
    assert lines[1].startswith(problem)
    assert lines[2] == "own.csv: 1 of 5 rows left out"
    assert lines[3].startswith("C (own.csv row 4), nut.preload: missing")
    assert lines[4].startswith("E (own.csv row 6), nut.preload: missing")
    assert lines[5] == "2 of 4 rows left out"
    (place / "out.csv").unlink()
    (place / "own.csv").write_text(TABLE, encoding="utf-8")
    refused(ballscrew(*command), "C (own.csv row 4), nut.preload: missing")
    assert not (place / "out.csv").exists()


# -- check ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_check(ballscrew, place):
    process = ballscrew("check", "case.toml", "--rows", "own.csv", "--to", "out.xlsx")
    assert process.returncode == 0, process.stderr
    assert [line.split()[:3] for line in process.stdout.splitlines()[3:6]] == [[name, "4", "kN"] for name in "ABC"]
    sheet = openpyxl.load_workbook(place / "out.xlsx").active
    headings, *rows = sheet.iter_rows(values_only=True)
    assert [row[headings.index("name")] for row in rows] == ["A", "B", "C"]
    torques = [row[headings.index("screw torque [N m]")] for row in rows]
    assert torques == [pytest.approx(torque(screw), rel=1e-11) for screw in screws_of(place).values()]
    assert rows[0][headings.index("static safety used")] > 0
    one = ballscrew("check", "case.toml", "--rows", "own.csv", "--row", "A").stdout
    assert one.startswith("A (own.csv row 2): 4000 N, 600 rpm, double nut, preload 3521 N")
    # without a case, what is listed is not assumed
    alone = ballscrew("check", "A", "--rows", "own.csv").stdout
    assert "preload 3.521 kN: 7 % of the dynamic load rating 50.3 kN, as listed" in alone
    assert "usual for such a nut" not in alone


# -- sweep ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_sweep_has_a_dimension_screw(ballscrew, place):
    command = ("sweep", "case.toml", "--rows", "own.csv", "--vary", "axial_load=0, 4 kN")
    process = ballscrew(*command, "--to", "map.nc")
    assert process.returncode == 0, process.stderr
    with xr.open_dataset(place / "map.nc", engine="h5netcdf") as found:
        assert found["screw_torque"].dims == ("screw", "axial_load")
        assert found["screw"].to_numpy().tolist() == ["A", "B", "C"]
        assert found["screw_lead"].to_numpy().tolist() == pytest.approx([0.01, 0.01, 0.005])
        assert found["screw_lead"].attrs["units"] == "m"
        for name, screw in screws_of(place).items():
            alone = [torque(screw, load) for load in (0.0, 4000.0)]
            assert found["screw_torque"].sel(screw=name).to_numpy() == pytest.approx(alone, rel=1e-11)
    rows = read_csv(ballscrew(*command, "--output", "screw_torque").stdout)
    assert [row["screw"] for row in rows] == ["A", "A", "B", "B", "C", "C"]
    assert float(rows[-1]["screw torque [N m]"]) == pytest.approx(alone[-1], rel=1e-11)


def test_what_a_screw_does_not_have_is_no_number():
    """A row of balls has conditions and results of its own; NaN is no result, and what cannot fail holds."""
    one = xr.Dataset({"a": ("x", [1.0, 2.0]), "valid": ("x", [True, False])}, {"x": [0, 1]}, {"same": 1, "own": 2.0})
    other = xr.Dataset(
        {"b": ("x", [3.0, 4.0]), "valid": ("x", [True, True]), "validity_b": ("x", [False, True])},
        {"x": [0, 1]},
        {"same": 1, "kind": "b"},
    )
    found = table.together({"one": one, "other": other}, {"own": "m"})
    assert np.isnan(found["a"].sel(screw="other")).all()
    assert found["b"].sel(screw="other").to_numpy().tolist() == [3.0, 4.0]
    assert found["validity_b"].dtype == bool
    assert found["validity_b"].to_numpy().tolist() == [[True, True], [False, True]]
    assert found.attrs == {"same": 1}
    assert found["kind"].to_numpy().tolist() == ["", "b"]
    assert found["own"].attrs == {"units": "m"}


# -- rows one after the other ---------------------------------------------------------------------


def test_ctrl_c_keeps_what_is_done():
    def work(row):
        if row == 3:
            raise KeyboardInterrupt
        return row

    told = []
    rows = {f"row {number}": number for number in (1, 2, 3, 4)}
    found = every_row.each(rows, work, done=lambda *numbers: told.append(numbers))
    assert found.interrupted
    assert found.found == {"row 1": 1, "row 2": 2}
    assert list(found.notes) == [
        "interrupted: 2 of 4 are done and kept, the last is row 2 · run the same again for all"
    ]
    assert told == [(1, 4), (2, 4)]
    with pytest.raises(KeyboardInterrupt):
        every_row.each({"row 3": 3}, work)


def test_one_fault_of_all_rows_is_said_once():
    def work(row):
        raise InputError(Fault("nut.type", "unknown", "x"))

    with pytest.raises(InputError) as caught:
        every_row.each({"A": 1, "B": 2}, work, keep_going=True)
    assert caught.value.lines() == ["nut.type: unknown (x)"]


# -- fit ------------------------------------------------------------------------------------------


@pytest.fixture
def rig(tmp_path):
    """Two screws as that of the logs, each with a log, and one without."""
    (tmp_path / "case.toml").write_text(PAPER, encoding="utf-8")
    (tmp_path / "logs").mkdir()
    for seed, name in enumerate(("a.csv", "b.csv")):
        (tmp_path / "logs" / name).write_text(text_of(columns(60, seed)), encoding="utf-8")
    made = case_file.build(tomllib.loads(PAPER)).screw
    # the turns that give as many loaded balls
    size = "40;5;3.175;{};0.515;logs/{}\n".format
    (tmp_path / "rigs.csv").write_text(
        "name;d0 [mm];Ph [mm];Dw [mm];i;f;log\n"
        + f"X 1;{size(1.676, 'a.csv')}Y/2;{size(1.676, 'b.csv')}Z;40;5;3;2;;\n",
        encoding="utf-8",
    )
    assert bs.screws(tmp_path / "rigs.csv")["X 1"].screw() == made
    return tmp_path


@pytest.mark.slow
def test_fit(ballscrew, rig):
    process = ballscrew("fit", "--case", "case.toml", "--rows", "rigs.csv", "--to", "fits", "--json")
    assert process.returncode == 0, process.stderr
    assert process.stderr.splitlines() == ["fits: 2 screws", "rigs.csv: no log of Z"]
    listed = json.loads(process.stdout)
    assert [each["name"] for each in listed] == ["X 1", "Y/2"]
    found = [each["estimates"]["boundary_friction_coefficient"] for each in listed]
    for estimate in found:
        assert abs(estimate["value"] - TRUE_FRICTION) < 4 * estimate["std"]
    assert found[0]["value"] != found[1]["value"]
    assert sorted(path.name for path in (rig / "fits").iterdir()) == ["X_1.toml", "Y_2.toml"]
    calibrated = case_file.load(rig / "fits" / "Y_2.toml")
    assert calibrated.origins.row.name == "Y/2"
    assert calibrated.model.friction.boundary_friction_coefficient == pytest.approx(found[1]["value"], rel=1e-9)


@pytest.mark.slow
def test_a_fit_that_is_warned_against_is_the_only_one_that_is_not_written(ballscrew, rig):
    command = ("fit", "--case", "case.toml", "--rows", "rigs.csv", "--to", "fits", "--json")
    path = rig / "logs" / "a.csv"
    data = columns()
    path.write_text(text_of({**data, "torque": 1000 * data["torque"]}), encoding="utf-8")
    process = ballscrew(*command)
    assert process.returncode == 2
    assert [each["name"] for each in json.loads(process.stdout)] == ["X 1", "Y/2"]
    count, line = process.stderr.splitlines()
    assert count == "fits: 1 screws"
    assert line.startswith("--to: is not written: implausible: boundary friction coefficient ")
    assert "X_1.toml" in line
    assert [path.name for path in (rig / "fits").iterdir()] == ["Y_2.toml"]
    assert ballscrew(*command, "--keep-going").returncode == 0
    assert sorted(path.name for path in (rig / "fits").iterdir()) == ["X_1.toml", "Y_2.toml"]


@pytest.mark.slow
def test_faulty_logs(ballscrew, rig):
    command = ("fit", "--case", "case.toml", "--rows", "rigs.csv", "--to", "fits.csv")
    (rig / "logs" / "a.csv").unlink()
    process = ballscrew(*command)
    refused(process, "does not exist")
    assert process.stderr.startswith("X 1 (rigs.csv row 2), ")
    assert not (rig / "fits.csv").exists()
    process = ballscrew(*command, "--keep-going")
    assert process.returncode == 0, process.stderr
    (row,) = read_csv((rig / "fits.csv").read_text(encoding="utf-8"))
    assert (row["name"], row["log"]) == ("Y/2", "b.csv")
    low, value, high = (float(row[f"boundary friction coefficient{end}"]) for end in (" low", "", " high"))
    assert low < value < high
    assert process.stdout.splitlines()[3].split()[:2] == ["Y/2", "b.csv"]


def test_two_rows_with_the_same_file(ballscrew, rig):
    table = Path(rig / "rigs.csv")
    table.write_text(table.read_text(encoding="utf-8").replace("Y/2", "X_1"), encoding="utf-8")
    expected = "--to: would have the same file as another row (X_1 and X 1) · give the rows other names"
    refused(ballscrew("fit", "--case", "case.toml", "--rows", "rigs.csv", "--to", "fits"), expected)
