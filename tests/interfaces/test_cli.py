"""The commands, run as people run them."""

import csv
import io
import json
import math

import numpy as np
import openpyxl
import pytest
import xarray as xr

import ballscrew as bs

PAPER = {
    "pitch_circle_diameter": 0.040, "lead": 0.005, "ball_diameter": 3.175e-3, "loaded_balls": 56,
    "contact_angle": math.pi / 4, "screw_conformity": 0.515, "nut_conformity": 0.515,
}  # fmt: skip


def paper_result(model):
    oil = bs.Lubricant(viscosity=0.1, pressure_viscosity_coefficient=2.2e-8)
    return model(bs.BallScrew(**PAPER), oil, axial_load=4000.0, screw_speed=20 * math.pi)


@pytest.mark.parametrize(
    ("name", "model"),
    [
        ("olaru2005", bs.FrictionModel.olaru2005()),
        ("olaru2005-literal", bs.FrictionModel.olaru2005(literal_film_parameter=True)),
        ("corrected", bs.FrictionModel.corrected()),
    ],
)
def test_json_is_the_python_result(name, model, example, ballscrew):
    process = ballscrew("run", example, "--model", name, "--json")
    assert process.returncode == 0, process.stderr
    document = json.loads(process.stdout)
    assert list(document) == ["inputs", "results", "units", "warnings", "provenance"]
    expected, found = paper_result(model), document["results"]
    for key in ("screw_torque", "nut_torque", "ideal_torque", "drive_torque", "efficiency", "friction_power"):
        assert found[key] == pytest.approx(float(getattr(expected, key)), rel=1e-12)
    assert sum(found["contributions"].values()) == pytest.approx(found["screw_torque"], rel=1e-12)
    assert found["screw"]["film_parameter"] == pytest.approx(float(expected.screw.film_parameter), rel=1e-12)
    assert document["units"]["screw_torque"] == "N m"
    assert document["units"]["screw"]["film_parameter"] == "1"
    assert document["inputs"]["screw"]["lead"] == 0.005
    assert document["provenance"] == {
        "version": bs.__version__, "model": name, "references": document["provenance"]["references"],
    }  # fmt: skip
    assert "Olaru2005" in document["provenance"]["references"]
    assert document["warnings"] == []


def test_settings_change_the_case(example, ballscrew):
    process = ballscrew(
        "run", example, "--json", "--set", 'operation.axial_load="2 kN"', "--set", "model.ball_to_ball_force=0 N"
    )
    document = json.loads(process.stdout)
    assert document["inputs"]["operation"]["axial_load"] == 2000.0
    assert document["results"]["contributions"]["ball_to_ball"] == 0.0


def test_no_load_is_legal_and_not_finite_is_null(example, ballscrew):
    process = ballscrew("run", example, "--json", "--set", "operation.axial_load=0 N")
    document = json.loads(process.stdout)
    assert process.returncode == 0
    assert document["results"]["efficiency"] == 0.0
    assert document["results"]["back_driving_efficiency"] is None
    assert any(warning.startswith("skid") for warning in document["warnings"])


def test_tables_for_people(example, ballscrew):
    process = ballscrew("run", example)
    assert process.returncode == 0
    for text in ("4000 N, 600 rpm", "0.1893 N m", "curvature slip", "█", "film thickness"):
        assert text in process.stdout
    locked = ballscrew("run", example, "--set", "operation.axial_load=10 N", "--set", "model.ball_to_ball_force=1 N")
    assert "self-locking" in locked.stdout


def test_a_grade_instead_of_a_viscosity(example, tmp_path, ballscrew):
    text = example.read_text(encoding="utf-8")
    start, end = text.index("[lubricant]"), text.index("[operation]")
    case = tmp_path / "grade.toml"
    case.write_text(
        f'{text[:start]}[lubricant]\ngrade = "ISO VG 100"\ntemperature = "25 degC"\n{text[end:]}', encoding="utf-8"
    )
    document = json.loads(ballscrew("run", case, "--json").stdout)
    oil = document["inputs"]["lubricant"]
    assert (oil["grade"], oil["temperature"]) == ("ISO VG 100", 298.15)
    assert oil["viscosity"] == bs.Lubricant.from_grade("ISO VG 100", 298.15).viscosity
    assert "Jungnickel2010" in document["provenance"]["references"]
    assert "oil ISO VG 100: " in ballscrew("run", case).stdout
    assert "@misc{Jungnickel2010" in ballscrew("cite", case).stdout


def test_efficiency_table_on_the_terminal(example, ballscrew):
    process = ballscrew("sweep", example, "--vary", "axial_load=1000:4000:4 N", "--vary", "screw_speed=0, 300, 600 rpm")
    rows = list(csv.reader(io.StringIO(process.stdout)))
    assert rows[0] == ["efficiency: axial load [N] down, screw speed [rpm] across", "0.0", "300.0", "600.0"]
    assert [row[0] for row in rows[1:]] == ["1000.0", "2000.0", "3000.0", "4000.0"]
    assert float(rows[4][3]) == pytest.approx(float(paper_result(bs.FrictionModel.olaru2005()).efficiency), rel=1e-10)


def test_one_row_a_point(example, ballscrew):
    process = ballscrew(
        "sweep", example, "--vary", "axial_load=1,4 kN", "--vary", "friction.boundary_friction_coefficient=0.1,0.2",
        "--output", "screw_torque", "--output", "valid",
    )  # fmt: skip
    rows = list(csv.reader(io.StringIO(process.stdout)))
    assert rows[0] == ["axial load [N]", "friction boundary friction coefficient", "screw torque [N m]", "valid"]
    assert len(rows) == 5
    assert float(rows[4][2]) == pytest.approx(float(paper_result(bs.FrictionModel.olaru2005()).screw_torque), rel=1e-10)


def test_what_is_not_finite_is_an_empty_cell_and_what_is_not_valid_is_said(example, ballscrew):
    axes = ["--vary", "axial_load=0, 4000 N", "--vary", "screw_speed=0, 600 rpm", "--output", "back_driving_efficiency"]
    process = ballscrew("sweep", example, *axes)
    rows = list(csv.reader(io.StringIO(process.stdout)))
    assert rows[1] == ["0.0", "", ""]
    assert float(rows[2][2]) == pytest.approx(float(paper_result(bs.FrictionModel.olaru2005()).back_driving_efficiency))
    assert process.stderr.startswith(
        "beware: 2 of 4 points lie outside the model's validity (skid 2, elastic_regime 1)"
    )


def test_too_much_pressure_is_said(example, ballscrew):
    process = ballscrew("run", example, "--json", "--set", "operation.axial_load=5 MN")
    document = json.loads(process.stdout)
    assert not document["results"]["valid"]
    assert any(warning.startswith("contact_pressure: ") for warning in document["warnings"])


def test_axes_from_the_case_file(example, tmp_path, ballscrew):
    case = tmp_path / "sweep.toml"
    case.write_text(example.read_text(encoding="utf-8") + '\n[sweep]\nlead = "5, 10 mm"\n', encoding="utf-8")
    rows = list(csv.reader(io.StringIO(ballscrew("sweep", case).stdout)))
    assert rows[0][0] == "lead [mm]"
    assert [row[0] for row in rows[1:]] == ["5.0", "10.0"]


@pytest.mark.parametrize("suffix", ["csv", "xlsx", "nc"])
def test_files_hold_the_same_numbers(suffix, example, tmp_path, ballscrew):
    path = tmp_path / f"map.{suffix}"
    axes = ["--vary", "axial_load=1000:4000:3 N", "--vary", "screw_speed=300:600:2 rpm"]
    process = ballscrew("sweep", example, *axes, "--output", "efficiency", "--output", "screw_torque", "--to", path)
    assert process.returncode == 0, process.stderr
    assert list(tmp_path.iterdir()) == [path]
    expected = paper_result(bs.FrictionModel.olaru2005())
    if suffix == "nc":
        with xr.open_dataset(path, engine="h5netcdf") as dataset:
            assert dict(dataset.sizes) == {"axial_load": 3, "screw_speed": 2}
            assert dataset.screw_torque.attrs["units"] == "N m"
            torque, efficiency = dataset.screw_torque.values[-1, -1], dataset.efficiency.values[-1, -1]
    elif suffix == "xlsx":
        book = openpyxl.load_workbook(path)
        assert book.sheetnames == ["efficiency", "screw_torque", "points", "inputs"]
        torque, efficiency = book["screw_torque"].cell(4, 3).value, book["efficiency"].cell(4, 3).value
    else:
        rows = list(csv.reader(io.StringIO(path.read_text(encoding="utf-8"))))
        efficiency, torque = map(float, rows[-1][2:])
    assert torque == pytest.approx(float(expected.screw_torque), rel=1e-10)
    assert efficiency == pytest.approx(float(expected.efficiency), rel=1e-10)


def test_cite_names_what_the_model_uses(example, ballscrew):
    process = ballscrew("cite", example)
    assert "@incollection{Olaru2005" in process.stdout
    assert "HamrockDowson1977" in process.stdout
    assert "Johnson1985" not in process.stdout
    assert "Johnson1985" in ballscrew("cite", example, "--model", "corrected").stdout


def test_schema_describes_the_example(example, ballscrew):
    schema = json.loads(ballscrew("schema").stdout)
    assert schema["$schema"].endswith("2020-12/schema")
    screw = schema["$defs"]["Screw"]
    assert screw["properties"]["lead"]["x-si-unit"] == "m"
    assert screw["additionalProperties"] is False
    assert set(screw["required"]) >= {"lead", "ball_diameter", "loaded_balls"}
    assert schema["$defs"]["Model"]["properties"]["name"]["enum"] == [
        "olaru2005",
        "olaru2005-literal",
        "corrected",
        "reference",
    ]


def test_run_loads_nothing_heavy(example, ballscrew):
    """A single point must not wait for xarray, pandas, matplotlib or a compiler."""
    import subprocess
    import sys

    code = (
        "import sys; from ballscrew.interfaces import cli; sys.argv = ['ballscrew', 'run', sys.argv[1], '--json']\n"
        "try: cli.main()\n"
        "except SystemExit: pass\n"
        # pint loads scipy itself where it is, and none of its parts
        "heavy = {'xarray', 'pandas', 'matplotlib', 'scipy.special', 'numba', 'jax', 'dask'} & set(sys.modules)\n"
        "sys.exit(sorted(heavy) and str(heavy) or 0)"
    )
    process = subprocess.run([sys.executable, "-c", code, example], capture_output=True, text=True, check=False)
    assert process.returncode == 0, process.stderr


def test_version_and_help(ballscrew):
    assert ballscrew("--version").stdout.strip() == f"ballscrew {bs.__version__}"
    text = ballscrew("--help").stdout
    for command in ("run", "sweep", "reproduce", "schema", "cite"):
        assert command in text


def test_front_door():
    """Every exported name is there, and nothing else is promised."""
    for name in bs.__all__:
        assert getattr(bs, name) is not None
    assert dir(bs) == sorted(bs.__all__)
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        bs.nonsense  # noqa: B018  (the access is the test)
    assert np.isfinite(paper_result(bs.FrictionModel.corrected()).screw_torque)
