"""Sweeps that meet points which cannot be built, sweeps over the oil temperature, and examples in the schema."""

import csv
import io
import json
import tomllib

import openpyxl
import pytest

import ballscrew as bs
from support.commands import ROOT


def test_what_cannot_be_built_is_empty_and_said(tmp_path, ballscrew):
    drive = ROOT / "examples" / "feed_drive.toml"
    process = ballscrew("sweep", drive, "--vary", "lead=5, 10 mm", "--output", "screw_torque")
    rows = list(csv.reader(io.StringIO(process.stdout)))
    assert rows[0][1:] == ["screw torque [N m]", "valid"]
    assert rows[1] == ["5.0", "", "0"]
    assert rows[2][2] == "1"
    sentence = ballscrew("run", drive, "--set", "screw.lead=5 mm").stderr.strip()
    assert f"the first at lead 5 mm: {sentence}" in process.stderr
    path = tmp_path / "map.xlsx"
    ballscrew("sweep", drive, "--vary", "lead=5, 10 mm", "--output", "screw_torque", "--to", path)
    book = openpyxl.load_workbook(path)
    assert book["points"].cell(2, 2).value is None
    inputs = {row[0]: row[1:] for row in book["inputs"].iter_rows(values_only=True)}
    assert inputs["operation_axial_load"] == (5000, "N")
    assert inputs["lubricant_temperature"] == (313.15, "K")
    assert inputs["lubricant_grade"][0] == "ISO VG 100"


def test_a_sweep_over_the_temperature_of_a_grade(example, ballscrew):
    drive = ROOT / "examples" / "feed_drive.toml"
    wanted = ["--output", "screw_torque", "--vary", "temperature=20, 60 degC"]
    process = ballscrew("sweep", drive, *wanted)
    rows = list(csv.reader(io.StringIO(process.stdout)))
    assert rows[0][0] == "temperature [degC]"
    for row, celsius in zip(rows[1:], (20, 60), strict=True):
        alone = json.loads(ballscrew("run", drive, "--json", "--set", f"lubricant.temperature={celsius} degC").stdout)
        assert float(row[1]) == pytest.approx(alone["results"]["screw_torque"], rel=1e-9)
    given = ballscrew("sweep", drive, *wanted, "--set", "lubricant.pressure_viscosity_coefficient=15 1/GPa")
    assert given.returncode == 0, given.stderr
    assert given.stdout != process.stdout
    assert "give the oil by its data sheet or its grade" in ballscrew("sweep", example, *wanted).stderr
    assert "goes with the temperature" in ballscrew("sweep", drive, *wanted, "--vary", "viscosity=1,2 Pa s").stderr


def test_every_example_of_the_schema_parses():
    from ballscrew.basis import units
    from ballscrew.basis.errors import Fault, fault_of
    from ballscrew.basis.quantities import fields_of
    from ballscrew.cases.schema import case_schema
    from ballscrew.cases.schema.fields import EXAMPLES
    from ballscrew.physics.friction.model import LAWS

    drive = tomllib.loads((ROOT / "examples" / "feed_drive.toml").read_text(encoding="utf-8"))
    written = {name: value for section in ("screw", "lubricant", "operation") for name, value in drive[section].items()}
    assert {name: value for name, value in EXAMPLES.items() if name in written} == {
        name: value for name, value in written.items() if name != "grade"
    }
    definitions = case_schema.json_schema()["$defs"]
    parts = {"Screw": bs.BallScrew, "Lubricant": bs.Lubricant, "Operation": case_schema.OperatingState,
             "Material": bs.Material, "Model": bs.FrictionModel}  # fmt: skip
    known = {title: dict(fields_of(part)) for title, part in parts.items()}
    known["Lubricant"] |= {**fields_of(bs.DataSheet), "temperature": case_schema.SHEET_TEMPERATURE}
    tables = [(definitions[title]["properties"], quantities) for title, quantities in known.items()]
    for slot in LAWS:
        options = definitions["Model"]["properties"][slot]["anyOf"][1:]
        for option in (one for one in options if "properties" in one):
            name = option["properties"]["law"].get("const")
            tables.append((option["properties"], case_schema.coefficients_of(slot, name) if name else {}))
    seen = 0
    for properties, quantities in tables:
        for field, quantity in quantities.items():
            sample, *_ = properties[field]["examples"]  # others may be in units of another kind
            value = units.parse(field, sample, quantity)
            assert not isinstance(value, Fault), value
            assert fault_of("", quantity, value) is None
            seen += 1
    assert seen > 40
