"""The answer of the checks: sizes, ratings and loads are declared once, and the same on every face."""

import pytest

from ballscrew.basis import units
from ballscrew.basis.output.sheet import columns_of
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import files, terminal
from ballscrew.faces.web import documents
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.check.answer import Geometry, Options, Rated, document, one
from ballscrew.questions.check.sheet import cells, sheet
from ballscrew.questions.responses import Checks
from ballscrew.questions.run.compute import NutLoads, run
from ballscrew.questions.run.sheet import stiffness_fields
from ballscrew.questions.shared import schemas
from support.answers import without_unit
from support.commands import ROOT
from support.drive_case import drive_case

EXAMPLES = ROOT / "examples"


@pytest.fixture(scope="module")
def found():
    return one("rexroth-40x10x6-6-double", None, Options({}, (), None), keep_going=False)[0]


def schema_of(cls):
    return schemas.schema(cls).model_json_schema()["properties"]


def test_ratings_are_on_every_face(found):
    answer, words = document(found), terminal.text(sheet(found))
    headings = files.rows_of(columns_of("screws", [cells(found)])).headings
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
    records, _ = told(1.01 * needed, 2001)
    assert records["verdict.motor_holds"]["holds"]
    assert records["verdict.slenderness"]["value"] == pytest.approx(2001 / 40)


def test_sizes_are_on_every_face(found):
    answer, words = document(found), terminal.text(sheet(found))
    for name, quantity in quantities_of(Geometry).items():
        assert answer["geometry"][name] == getattr(found.geometry, name) > 0
        assert answer["units"]["geometry"][name] == quantity.unit == schema_of(Geometry)[name]["x-si-unit"]
        assert schema_of(Geometry)[name]["description"].startswith(quantity.info.meaning)
        assert f"{quantity.info.meaning} " in words
        assert units.shown(answer["geometry"][name], quantity) in words


def test_loads_are_on_every_face(found):
    answer, words = document(found), terminal.text(sheet(found))
    loads, of_loads = answer["loads"], answer["units"]["loads"]
    schema = schemas.schema(NutLoads).model_json_schema()
    of_balls = schema["$defs"]["EachBall"]["properties"]
    for name, quantity in quantities_of(BallLoads).items():
        part, unit, described = loads, of_loads, schema["properties"]
        if name in of_balls:
            part, unit, described = loads["balls"], of_loads["balls"], of_balls
        assert name in part
        assert unit[name] == quantity.unit == described[name].get("x-si-unit", "1")
        assert described[name]["description"].startswith(quantity.info.meaning)
    for name in stiffness_fields(found.nut):
        assert quantities_of(BallLoads)[name].info.meaning in words


@pytest.mark.parametrize("example", ["catalogue_screw.toml", "olaru2005.toml", "vertical_axis.toml"])
def test_answers_are_valid_by_their_schema(example):
    case = case_file.load(EXAMPLES / example)
    Checks.model_validate(documents.check(run(case)))


def test_every_number_has_a_unit(found):
    answer = document(found)
    parts = {name: answer[name] for name in ("geometry", "loads", "ratings")}
    # as counted, and the factor of a standard
    assert set(without_unit(parts, answer["units"])) <= {"loads.balls.count", "loads.axial_rigidity.accuracy_factor"}
