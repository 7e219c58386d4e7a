"""The answer of a selection: a candidate is declared once, and the same on every face."""

import pytest

import ballscrew as bs
from ballscrew.basis import units
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files.named_calibration import by_rules
from ballscrew.faces.sheets import files
from ballscrew.questions.responses import Candidate, Select
from ballscrew.questions.select.answer import MotorTorque, OfMotion, OneCandidate, document
from ballscrew.questions.select.compute import BrakeOfNeed, Plan, plan
from ballscrew.questions.select.requirements import OBJECTIVES
from ballscrew.questions.select.sheet import beside_rules, of_selection
from ballscrew.questions.shared import declared, schemas
from support.answers import without_unit

POINT = {"force": "2 kN", "feed": "10 m/min", "preload": "5 %", "rows": "hiwin-40-20k4"}
MOVING = {
    "mass": "400 kg", "inclination": "90 deg", "acceleration": "3 m/s^2", "feed": "15 m/min", "stroke": "600 mm",
    "nut": "double", "preload": "5 %", "rows": "hiwin-40-20k4",
}  # fmt: skip


@pytest.fixture(scope="module", params=[POINT, MOVING], ids=["a point", "a motion"])
def found(request):
    return bs.select(request.param)


@pytest.mark.slow
def test_the_numbers_compared_are_on_every_face(found):
    answer, headings = document(found), files.rows_of(of_selection(found.ranked)).headings
    schema = schemas.schema(OneCandidate).model_json_schema()["$defs"]["Objectives"]["properties"]
    for name, objective in OBJECTIVES.items():
        quantity = objective.quantity
        assert name in answer["candidates"][0]["objectives"]
        assert answer["units"]["objectives"][name] == quantity.unit == schema[name].get("x-si-unit", "1")
        assert schema[name]["description"].startswith(quantity.info.meaning)
        assert units.heading(quantity) in headings
    named = {one["name"]: one for one in answer["objectives"]}
    assert {name: one["meaning"] for name, one in named.items()} == {
        name: OBJECTIVES[name].quantity.info.meaning for name in found.objectives
    }


@pytest.mark.slow
def test_torques_of_motor_and_brake_are_on_every_face():
    found = bs.select(MOVING)
    answer, headings = document(found), " ".join(files.rows_of(of_selection(found.ranked)).headings)
    candidate, schema = answer["candidates"][0], Candidate.model_json_schema()["$defs"]
    for part, cls, word in (("motor_torque", MotorTorque, "motor"), ("brake", BrakeOfNeed, "brake")):
        for name, quantity in quantities_of(cls).items():
            described = schema[cls.__name__]["properties"][name]
            assert candidate[part][name] > 0
            assert answer["units"][part][name] == quantity.unit == described["x-si-unit"]
            assert described["description"].startswith(quantity.info.meaning)
            assert f"{word} {name}".replace("_", " ") in headings


def test_the_best_stands_beside_the_rules_of_makers():
    """In the text; in files every candidate does."""
    need = {
        "operation": {"axial_load": "2 kN", "feed": "10 m/min"},
        "installation": {"unsupported_length": "1 m", "ends": "fixed-supported"},
        "limits": {"running_time": "100 h"},
        "need": {"rows": "hiwin-40-20k4"},
    }
    found = bs.select({**need, "nut": {"type": "double", "preload": "5 %"}})
    assert found.best is not None
    (line,) = beside_rules(found)
    assert line.startswith("1: drag torque without seals ")
    assert "HIWIN, its maker, " in " ".join(line.split())
    of_best = found.best.checked.run
    sheet = files.rows_of(of_selection(found.ranked[:1]))
    cells = dict(zip(sheet.headings, sheet.rows[0], strict=True))
    assert cells["torque without load of balls [N m]"] == pytest.approx(of_best.nut.drag_of_balls, rel=1e-9)
    for one in by_rules(of_best.case):
        assert cells[f"torque without load by {one.rule.label} [N m]"] == pytest.approx(one.torque, rel=1e-9)
    single = bs.select({**need, "nut": {"type": "single"}})
    assert single.best is not None
    assert beside_rules(single) == []


def test_answers_are_valid_by_their_schema(found):
    answer = document(found)
    Select.model_validate({**answer, "sheet": {}})
    assert ("duty" in answer["candidates"][0]) == found.need.moves


def test_every_number_has_a_unit(found):
    answer = document(found)
    (candidate,) = answer["candidates"]
    parts = [*declared.parts_of(OneCandidate), *(declared.parts_of(OfMotion) if found.need.moves else ())]
    assert list(without_unit({name: candidate[name] for name in parts if name != "case"}, answer["units"])) == []


def test_a_plan_is_valid_by_its_schema():
    answer = declared.document(plan(POINT))
    schemas.schema(Plan).model_validate(answer)
    assert answer["unasked"][0].keys() == {"input", "checks"}
