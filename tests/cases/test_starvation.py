"""A cold, thick oil: the torque of the starved track never stands without that of the full bath."""

import copy

import pytest

from ballscrew.cases import case_file
from ballscrew.documents import band as band_documents
from ballscrew.documents import run as run_documents
from ballscrew.studies import band
from ballscrew.studies.run import run

COLD = {
    "screw": {"catalogue": "rexroth-40x10x6-6-double"},
    "nut": {"type": "double", "preload": "7 %"},
    "lubricant": {"grade": "ISO VG 220", "temperature": "5 degC"},
    "operation": {"axial_load": "3 kN", "screw_speed": "1000 rpm"},
}


def case_with(temperature="5 degC", constant=None):
    tables = copy.deepcopy(COLD)
    tables["lubricant"]["temperature"] = temperature
    if constant is not None:
        tables["model"] = {"inlet": {"law": "heated", "replenishment_constant": constant}}
    return case_file.build(tables)


def verdicts_of(case):
    return {record["id"]: record for record in run_documents.document(run(case))["verdicts"]}


def test_a_starved_torque_stands_beside_that_of_the_full_bath():
    bath = run(case_with(constant=0.0))
    flooded = float(bath.friction.screw_torque)
    starved = verdicts_of(case_with())["lubricant.starved"]
    assert starved["value"] == pytest.approx(flooded, rel=1e-12)
    assert starved["unit"] == "N m"
    assert starved["severity"] == "warning"
    assert f"{flooded:.4g} N m in a full bath of oil" in starved["text"]
    assert starved["limit"] == float(run(case_with()).friction.screw_torque)
    assert bath.friction.flooded_torque == flooded
    assert "lubricant.starved" not in verdicts_of(case_with("60 degC"))


def test_what_friction_holds_in_motion_alone_is_no_self_locking():
    found = verdicts_of(case_with(constant=0.0))
    assert "verdict.self_locking" not in found
    assert "it needs a brake" in found["verdict.held_in_motion"]["text"]
    assert found["verdict.held_in_motion"]["severity"] == "warning"
    assert found["verdict.held_in_motion"]["value"] < 0 < found["verdict.back_driving.at_rest"]["value"]


def test_the_band_says_where_the_full_bath_lies():
    case = case_with()
    report = band.band(case, band.Options(samples=2, only_given=True))
    found = {record.id: record for record in band_documents.verdicts(case, report)}["band.flooded"]
    assert found.value == run(case).friction.flooded_torque
    assert found.limit == report.band["screw_torque"].both.high < found.value  # nothing is uncertain here
    assert found.text.endswith("above it")
