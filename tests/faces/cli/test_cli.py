"""The commands, run as people run them."""

import csv
import io
import json
import math
import re
import subprocess
import sys
import warnings

import numpy as np
import openpyxl
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.faces.cli import main
from support.commands import ROOT

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
        ("reference", bs.FrictionModel.reference()),
    ],
)
def test_json_is_the_python_result(name, model, example, ballscrew):
    process = ballscrew("run", example, "--model", name, "--json")
    assert process.returncode == 0, process.stderr
    document = json.loads(process.stdout)
    assert list(document) == ["inputs", "results", "units", "warnings", "verdicts", "checks", "provenance"]
    expected, found = paper_result(model), document["results"]
    named = {key: value for key, value in found.items() if isinstance(value, bool | float) and hasattr(expected, key)}
    assert {"screw_torque", "holding_torque", "efficiency", "friction_power", "rolling_share", "valid"} <= named.keys()
    for key, value in named.items():
        assert value == pytest.approx(float(getattr(expected, key)), rel=1e-12), key
    assert found["contributions"] == pytest.approx({k: float(v) for k, v in expected.contributions.items()}, rel=1e-12)
    for key, quadrant in expected.quadrants.items():
        assert found["quadrants"][key] == pytest.approx(quadrant._asdict(), rel=1e-12)
    for side in ("screw", "nut"):
        assert found[side]["film_parameter"] == pytest.approx(float(getattr(expected, side).film_parameter), rel=1e-12)
    assert document["units"]["screw_torque"] == "N m"
    assert document["units"]["screw"]["film_parameter"] == "1"
    assert document["inputs"]["screw"]["lead"] == 0.005
    assert document["provenance"] == {
        "version": bs.__version__,
        "model": name,
        "references": document["provenance"]["references"],
    }
    assert "Olaru2005" in document["provenance"]["references"]
    assert [warning["id"] for warning in document["warnings"]] == ["model.power_balance"] * ("olaru2005" in name)


def test_no_load_is_legal_and_not_finite_is_null(example, ballscrew):
    process = ballscrew("run", example, "--json", "--set", "operation.axial_load=0 N")
    document = json.loads(process.stdout)
    assert process.returncode == 0
    assert document["results"]["efficiency"] is None  # no load is driven
    assert document["results"]["back_driving_efficiency"] is None
    assert "validity.skid" in {record["id"] for record in document["warnings"]}


def test_what_is_zero_is_left_out(example, ballscrew):
    text = ballscrew("run", example).stdout
    assert "spin slip" not in text
    assert "helix slip" not in text
    assert "offset of the lines of pure rolling" in text
    none = ballscrew("run", example, "--model", "reference", "--set", "operation.axial_load=0 N").stdout
    assert "no axial load" in none
    assert "skid" not in none
    assert "locks" not in none
    assert "Where the friction" not in none
    assert not re.search(r"nan|inf\b| -0 ", none)


def test_users_get_the_reference_model(example, tmp_path, ballscrew):
    text = example.read_text(encoding="utf-8")
    case = tmp_path / "case.toml"
    case.write_text(text[: text.index("[model]")], encoding="utf-8")
    document = json.loads(ballscrew("run", case, "--json").stdout)
    assert document["provenance"]["model"] == "reference"
    expected = paper_result(bs.FrictionModel.reference())
    assert document["results"]["screw_torque"] == pytest.approx(float(expected.screw_torque), rel=1e-12)
    assert "BibouletHoupert2010" in document["provenance"]["references"]


@pytest.mark.parametrize("path", sorted((ROOT / "examples").glob("*.toml")), ids=lambda path: path.stem)
def test_every_example(path, tmp_path, ballscrew):
    """Also with what stands in its comments put in."""
    for command in ("run", "compare", "sweep"):
        process = ballscrew(command, path)
        assert process.returncode == 0, process.stderr
        # an example whose range is cold says so
        assert [line for line in process.stderr.splitlines() if not line.startswith("warning  starved: ")] == []
    text = path.read_text(encoding="utf-8")
    uncommented = re.sub(r"^# (\[model\]|[\w.]+ = )", r"\1", text, flags=re.MULTILINE)
    assert uncommented.count("=") > text.count("\n#") > 0
    case = tmp_path / "case.toml"
    case.write_text(uncommented, encoding="utf-8")
    assert uncommented != text
    document = json.loads(ballscrew("run", case, "--json").stdout)
    assert ", changed: " in document["provenance"]["model"]


def test_what_is_not_finite_is_an_empty_cell_and_what_is_not_valid_is_said(example, ballscrew):
    axes = ["--vary", "axial_load=0, 4000 N", "--vary", "screw_speed=0, 600 rpm", "--output", "back_driving_efficiency"]
    process = ballscrew("sweep", example, *axes)
    rows = list(csv.reader(io.StringIO(process.stdout)))
    assert rows[1] == ["0.0", "", ""]
    assert float(rows[2][2]) == pytest.approx(float(paper_result(bs.FrictionModel.olaru2005()).back_driving_efficiency))
    assert process.stderr.startswith(
        "warning  valid: 2 of 4 points lie outside the model's validity (skid 2, elastic_regime 1)"
    )


def test_axes_from_the_case_file(example, tmp_path, ballscrew):
    case = tmp_path / "sweep.toml"
    case.write_text(example.read_text(encoding="utf-8") + '\n[sweep]\nlead = "5, 10 mm"\n', encoding="utf-8")
    rows = list(csv.reader(io.StringIO(ballscrew("sweep", case).stdout)))
    assert rows[0][0] == "lead [mm]"
    assert [row[0] for row in rows[1:]] == ["5.0", "10.0"]


@pytest.mark.parametrize("suffix", ["csv", "xlsx", "nc"])
def test_files_hold_the_same_numbers(suffix, example, tmp_path, ballscrew):
    path = tmp_path / "new" / "folder" / f"map.{suffix}"
    axes = ["--vary", "axial_load=1000:4000:3 N", "--vary", "screw_speed=300:600:2 rpm"]
    process = ballscrew("sweep", example, *axes, "--output", "efficiency", "--output", "screw_torque", "--to", path)
    assert process.returncode == 0, process.stderr
    assert list(path.parent.iterdir()) == [path]
    expected = paper_result(bs.FrictionModel.olaru2005())
    if suffix == "nc":
        with xr.open_dataset(path, engine="h5netcdf") as dataset:
            assert dict(dataset.sizes) == {"axial_load": 3, "screw_speed": 2}
            assert dataset.screw_torque.attrs["units"] == "N m"
            torque, efficiency = dataset.screw_torque.values[-1, -1], dataset.efficiency.values[-1, -1]
    elif suffix == "xlsx":
        book = openpyxl.load_workbook(path)
        assert book.sheetnames == ["efficiency", "screw_torque", "valid", "points", "inputs"]
        assert book["valid"].cell(4, 3).value == 1
        inputs = {row[0]: row[1:] for row in book["inputs"].iter_rows(values_only=True)}
        assert inputs["screw_lead"] == (0.005, "m")
        assert inputs["lubricant_viscosity"] == (0.1, "Pa s")
        assert "operation_axial_load" not in inputs
        torque, efficiency = book["screw_torque"].cell(4, 3).value, book["efficiency"].cell(4, 3).value
    else:
        rows = list(csv.reader(io.StringIO(path.read_text(encoding="utf-8"))))
        efficiency, torque, valid = map(float, rows[-1][2:])
        assert valid == 1
    assert torque == pytest.approx(float(expected.screw_torque), rel=1e-10)
    assert efficiency == pytest.approx(float(expected.efficiency), rel=1e-10)


def test_changed_laws_are_named(example, ballscrew):
    settings = ["--set", "model.rolling=houpert", "--set", "model.friction.boundary_friction_coefficient=0.15"]
    text = ballscrew("run", example, "--model", "reference", *settings).stdout
    changed = "changed: friction = run-in (boundary friction coefficient 0.15), rolling = houpert"
    assert f"4000 N, 600 rpm, model reference, {changed}" in text.replace("\n", " ")


def test_cite_names_what_the_model_uses(example, ballscrew):
    process = ballscrew("cite", example)
    assert "@incollection{Olaru2005" in process.stdout
    assert "HamrockDowson1977" in process.stdout
    assert "Johnson1985" not in process.stdout
    assert "Johnson1985" in ballscrew("cite", example, "--model", "corrected").stdout
    assert "@misc{Jungnickel2010" in ballscrew("cite", ROOT / "examples" / "feed_drive.toml").stdout  # of its grade


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
        "constant-efficiency",
    ]


def test_version_and_help(ballscrew):
    assert ballscrew("--version").stdout.strip() == f"ballscrew {bs.__version__}"
    text = ballscrew("--help").stdout
    for command in ("run", "compare", "sweep", "reproduce", "schema", "cite"):
        assert command in text
    for command in ("run", "compare", "sweep", "cite"):
        words = " ".join(ballscrew(command, "--help").stdout.split())
        assert "in place of that of the file: olaru2005, olaru2005-literal, corrected, reference (default)" in words


def test_front_door():
    """Every exported name is there, and nothing else is promised."""
    for name in bs.__all__:
        assert getattr(bs, name) is not None
    assert dir(bs) == sorted(bs.__all__)
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        bs.nonsense  # noqa: B018  (the access is the test)
    assert np.isfinite(paper_result(bs.FrictionModel.corrected()).screw_torque)


@pytest.mark.slow
def test_citations_survive_without_docstrings(ballscrew, example):
    """-OO leaves docstrings out, in which the laws name their sources."""
    optimised = subprocess.run(
        [sys.executable, "-OO", "-m", "ballscrew.faces.cli", "cite", example],
        capture_output=True,
        text=True,
        check=True,
    )
    assert optimised.stdout == ballscrew("cite", example).stdout
    assert "HamrockDowson1977" in optimised.stdout


@pytest.mark.parametrize(("asked", "shown"), [([], 0), (["default"], 1)])
def test_warnings_of_libraries_reach_the_terminal_only_where_python_is_asked_for_them(asked, shown, monkeypatch):
    monkeypatch.setattr(sys, "warnoptions", asked)
    monkeypatch.setattr(main, "command_line", lambda: lambda: np.ones(1) / np.zeros(1))
    monkeypatch.setitem(sys.modules, "dask", None)  # what a command does to its own process ends with this test
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        main.main()
    assert len(seen) == shown
