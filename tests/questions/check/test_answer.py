"""The answer of the checks: sizes, ratings and loads are declared once, and the same on every face."""

import pytest

from ballscrew.basis import units
from ballscrew.basis.output.sheet import columns_of
from ballscrew.basis.quantities import quantities_of
from ballscrew.faces.sheets import files, terminal
from ballscrew.questions.check.answer import Options, Rated, document, one
from ballscrew.questions.check.sheet import cells, sheet
from ballscrew.questions.shared import schemas
from support.drive_case import drive_case


@pytest.fixture(scope="module")
def found():
    return one("rexroth-40x10x6-6-double", None, Options({}, (), None), keep_going=False)[0]


def schema_of(cls):
    return schemas.schema(cls).model_json_schema()["properties"]


def test_ratings_are_on_every_face(found):
    answer, words = document(found), terminal.text(sheet(found))
    headings = files.rows_of(columns_of("screws", lambda: [cells(found)])).headings
    for name, quantity in quantities_of(Rated).items():
        for of in ("listed", "computed"):
            value = answer["ratings"][of][name]
            assert value == getattr(getattr(found.ratings, of), name) > 0
            assert answer["units"]["ratings"][of][name] == quantity.unit == schema_of(Rated)[name]["x-si-unit"]
            assert units.shown(value, quantity) in words
        assert schema_of(Rated)[name]["description"].startswith(quantity.info.meaning)
        assert quantity.info.meaning in words
        assert {units.heading(quantity), units.heading(quantity, f"{name} by geometry")} <= set(headings)


MOUNTED = """
[motor]
rated_torque = "9 N m"
peak_torque = "9 N m"
largest_speed = "3000 rpm"
holding_torque = "{held} N m"
[installation]
unsupported_length = "{length} mm"
ends = "fixed-supported"
"""


def test_what_the_motor_holds_and_a_slender_shaft_are_on_every_face(tmp_path):
    path = tmp_path / "case.toml"

    def told(held, length):
        path.write_text(drive_case(more=MOUNTED.format(held=held, length=length)), encoding="utf-8")
        checked = one(str(path), None, Options({}, (), None), keep_going=False)[0]
        records = {record["id"]: record for record in document(checked)["verdicts"]}
        assert all(record["text"] in " ".join(terminal.text(sheet(checked)).split()) for record in records.values())
        return records, checked.run.at_rest.holding_torque

    records, needed = told(0, 2000)
    assert needed > 0
    assert "verdict.slenderness" not in records  # 2 m are 50 times 40 mm
    assert (records["verdict.motor_holds"]["holds"], records["verdict.motor_holds"]["limit"]) == (False, needed)
    assert "duty counts it" not in records["verdict.motor_holds"]["text"]
    records, _ = told(1.01 * needed, 2001)
    assert records["verdict.motor_holds"]["holds"]
    assert records["verdict.slenderness"]["value"] == pytest.approx(2001 / 40)


@pytest.mark.parametrize(("mass", "is_said"), [("105 kg", False), ("40 kg", True)])
def test_a_load_far_from_the_weight_of_the_axis_is_told(tmp_path, mass, is_said):
    """1 kN is the weight of 102 kg. Of an axis the motor also has the help of bearings and guides."""
    path = tmp_path / "case.toml"
    axis = f'[axis]\nmass = "{mass}"\ninclination = "90 deg"\n'
    path.write_text(drive_case(more=axis + MOUNTED.format(held=0, length=900)), encoding="utf-8")
    checked = one(str(path), None, Options({}, (), None), keep_going=False)[0]
    words = " ".join(terminal.text(sheet(checked)).split())
    assert ("operation.axial_load 1000 N, where the weight of the axis is 392.3 N along the screw" in words) == is_said
    assert "bearings and guides is not counted here, duty counts it" in words
