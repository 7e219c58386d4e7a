"""The answer of a reversal: places of a curve that is known, and the same on every face."""

import dataclasses
import math

import numpy as np
import pytest

from ballscrew.basis.errors import InputError
from ballscrew.basis.output.sheet import Chart
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import report_blocks, terminal
from ballscrew.physics.moving_balls.friction_states import work_share
from ballscrew.questions.reversal import ReversalOptions, answer
from ballscrew.questions.reversal.answer import document, sheet
from support.answers import without_unit
from support.commands import ROOT
from support.reversals import STEADY, closed_form

EXAMPLE = ROOT / "examples" / "service.toml"
CASE = case_file.load(EXAMPLE, [])


@pytest.fixture(scope="module")
def report():
    """Of the closed form, whose helix winds up within 10° and whose balls close up within 30°."""
    return answer.of(CASE, closed_form(), ReversalOptions(inertia=2e-3))


def by_share(places):
    return {one.share: one for one in places}


def test_places_of_each_mechanism(report):
    """Straight lines: a share s of the swing is back at s of the angle; balls that press later begin with a half."""
    found = {name: by_share(places) for name, places in report.swing_by_mechanism.items()}
    for share in answer.SHARES:
        for name, within in (("spin_and_curvature", 0.04), ("helix", 10.0)):
            place = found[name][share]
            assert math.degrees(place.screw_angle) == pytest.approx(share * within, rel=1e-3)
            assert place.travel == pytest.approx(0.01 * place.screw_angle / (2 * math.pi), rel=1e-12)
        assert found["rolling"][share].screw_angle == found["losses"][share].screw_angle == 0
        pressed = math.degrees(found["ball_to_ball"][share].screw_angle)
        assert pressed == pytest.approx(30 * (2 * share - 1), rel=1e-3, abs=1e-12)


def test_places_of_all_friction(report):
    """At 90 %, 0.054 N m of 0.54 are missing: of what the helix and the closing balls have at each angle."""
    place = by_share(report.swing)[0.9]
    angle = math.degrees(place.screw_angle)
    missing = 2 * STEADY["helix"] * max(1 - angle / 10, 0) + STEADY["ball_to_ball"] * (1 - angle / 30)
    assert missing == pytest.approx(0.1 * 2 * sum(STEADY.values()), rel=1e-4)


def test_from_rest():
    """From zero, and in half the angle."""
    rested = answer.of(CASE, closed_form(from_rest=True), ReversalOptions(from_rest=True))
    place = by_share(rested.swing_by_mechanism["helix"])[0.9]
    assert math.degrees(place.screw_angle) == pytest.approx(0.9 * 5, rel=1e-3)
    assert sheet(rested).title.startswith("Friction from rest")
    assert rested.verdicts[0].text.startswith("from rest 90%")


def test_a_travel_that_is_too_short():
    short = answer.of(CASE, closed_form(travel=1e-4), ReversalOptions())
    assert math.isnan(by_share(short.swing)[0.98].screw_angle)
    assert short.verdicts[0].text == "after a reversal less than 90% of the friction is back within 100 µm"
    assert "–" in terminal.text(sheet(short))
    found = document(short)
    assert found["verdicts"][0]["value"] is None or math.isnan(found["verdicts"][0]["value"])


def test_elements_are_those_that_are_there(report):
    """Two hold it not quite, three hold it, so that there is no fit of four."""
    assert [len(fit.elements) for fit in report.slip_elements] == [2, 3]
    assert report.slip_elements[1].error.largest < 1e-4 < report.slip_elements[0].error.largest


def test_a_curve_that_one_element_holds():
    """Of rolling and of contacts that wind up over straight lines, and a travel too short for tracking."""
    steady = {"rolling": 0.05, "spin_and_curvature": 0.06}
    found = answer.of(CASE, closed_form(steady=steady, travel=5e-5), ReversalOptions())
    assert [len(fit.elements) for fit in found.slip_elements] == [1]
    assert found.verdicts[-1].text == "one Maxwell-slip element is off by up to 0%"
    assert "reversal.one_stiffness" not in [one.id for one in found.verdicts]


def test_both_stiffnesses_are_told(report):
    said = {one.id: one for one in report.verdicts}["reversal.one_stiffness"]
    assert said.value == report.dahl.error.largest > 0.3
    assert report.dahl_first.model.presliding_stiffness > 20 * report.dahl.model.presliding_stiffness


def test_the_hypothesis_is_said(report):
    assert report.warnings[0].id == "reversal.hypothesis"
    assert "EMPS" in terminal.text(sheet(report))
    assert "EMPS" in str(report_blocks.blocks(sheet(report), "reversal"))
    held = dataclasses.replace(closed_form(), displacement=(np.zeros(501),))
    alone = answer.of(CASE, held, ReversalOptions())
    assert "reversal.hypothesis" not in [one.id for one in alone.warnings]


def test_a_part_that_is_not_there():
    without = answer.of(CASE, closed_form(steady={**STEADY, "helix": 0.0, "losses": 1e-17}), ReversalOptions())
    assert without.swing_by_mechanism.keys() == {"rolling", "spin_and_curvature", "ball_to_ball"}


def test_bristles_that_are_far_off_are_said(report):
    assert [one.id for one in report.warnings] == ["reversal.hypothesis", "reversal.first_range"]
    off = answer.of(CASE, dataclasses.replace(closed_form(), bristles_over_model=0.63), ReversalOptions())
    said = {one.id: one for one in off.warnings}["reversal.bristles"]
    assert said.value == 0.63
    assert "63%" in said.text


def test_a_part_goes_to_where_its_curve_ends():
    """Bristles that give the helix a part of what the model has by spin: 90 % is of the way that it really goes."""
    found = closed_form()
    moved = {**found.contributions}
    moved["helix"] = 1.1 * found.contributions["helix"]
    moved["spin_and_curvature"] = found.screw_torque - sum(v for n, v in moved.items() if n != "spin_and_curvature")
    other = answer.of(CASE, dataclasses.replace(found, contributions=moved), ReversalOptions())
    place = by_share(other.swing_by_mechanism["helix"])[0.9]
    assert math.degrees(place.screw_angle) == pytest.approx(9, rel=1e-3)


def test_every_number_is_in_the_document(report):
    found = document(report)
    results = found["results"]
    assert results["screw_torque"] == list(report.reversal.screw_torque)
    assert results["contributions"]["helix"][-1] == STEADY["helix"]
    assert results["lugre"]["model"]["micro_damping"] == report.lugre.model.micro_damping > 0
    assert results["slip_elements"][1]["elements"][1]["slip_torque"] == pytest.approx(0.1, rel=1e-4)
    assert [one["share"] for one in results["swing"]] == list(answer.SHARES)
    assert list(without_unit(results, found["units"])) == []
    assert found["units"]["slip_elements"]["elements"]["stiffness"] == "N m/rad"
    identities = [(one["id"], one["subject"]) for one in (*found["warnings"], *found["verdicts"])]
    assert len(set(identities)) == len(identities)


def test_the_charts(report):
    """The curve and its parts are drawn as they are, and the models with what follows at once."""
    parts, models = ({mark.name: mark for mark in chart.marks} for chart in sheet(report).of_kind(Chart))
    assert {"all friction", "helix slip", "rolling resistance", "ball to ball and return"} <= parts.keys()
    assert list(parts["all friction"].x) == list(report.reversal.screw_angle[1:])
    assert list(parts["all friction"].y) == list(report.reversal.screw_torque[1:])
    assert models["3 Maxwell-slip elements"].y == pytest.approx(models["computed"].y, abs=1e-5)
    assert models["Dahl, first 0.02°"].y[-1] == pytest.approx(sum(STEADY.values()), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("speed", ["100 rpm", "-100 rpm"])
def test_the_viscous_slope_is_that_of_a_run(speed):
    """Torques by rolling at 90 and 110 rpm, of runs, either way; the rest of what follows at once is dry."""
    case = case_file.load(EXAMPLE, [f"operation.screw_speed={speed}"])
    rolling = []
    for rpm in (90, 110):
        found = case.model(case.screw, case.lubricant, axial_load=0.0, screw_speed=rpm * math.pi / 30)
        rolling.append(found.contributions["hydrodynamic_rolling"] + found.contributions["elastic_hysteresis"])
    slope = (rolling[1] - rolling[0]) / (20 * math.pi / 30)
    model = answer.of(case, closed_form(), ReversalOptions()).lugre.model
    # the chord of a curve over a tenth either way, against one over a hundredth
    assert model.viscous_slope == pytest.approx(slope, rel=5e-3)
    at_once = STEADY["rolling"] + STEADY["losses"] + STEADY["ball_to_ball"] / 2
    assert model.dry_torque + model.viscous_slope * 100 * math.pi / 30 == pytest.approx(at_once, rel=1e-5)


def test_a_screw_at_rest_is_refused():
    resting = case_file.load(EXAMPLE, ["operation.screw_speed=0 rpm"])
    with pytest.raises(InputError) as error:
        answer.reversal(resting, ReversalOptions())
    assert error.value.faults[0].where == "operation.screw_speed"


@pytest.mark.slow
def test_a_computed_reversal():
    """That of a case: what it goes to is the torque of a run, and the helix comes back hundreds of times later."""
    found = answer.reversal(CASE, ReversalOptions())
    run = CASE.model(CASE.screw, CASE.lubricant, axial_load=0.0, screw_speed=float(CASE.operation.screw_speed))
    assert float(found.reversal.steady_torque) == pytest.approx(float(run.screw_torque), rel=1e-12)
    helix, spin = (by_share(found.swing_by_mechanism[name])[0.9] for name in ("helix", "spin_and_curvature"))
    assert helix.screw_angle > 100 * spin.screw_angle > 0
    assert found.dahl_first.model.presliding_stiffness > 10 * found.dahl.model.presliding_stiffness
    errors = [fit.error.largest for fit in found.slip_elements]
    assert max(errors) < found.dahl.error.largest < found.dahl_first.error.largest
    # the elements, with what is at once, lose on short strokes what the balls do, to what is said
    (said,) = [one for one in found.warnings if one.id == "reversal.work_of_elements"]
    for fit in found.slip_elements:
        assert len(fit.loops) == 4
        ratios = [
            work_share(fit.elements, loop.stroke, at_once=found.curve.at_once) / loop.work_share for loop in fit.loops
        ]
        assert max(abs(np.array(ratios) - 1)) == pytest.approx(fit.work_error, rel=1e-12)
        assert fit.work_error <= said.value < 0.25
    assert "0.5 deg to ±5 deg" in said.text
    results = document(found)["results"]["slip_elements"]
    assert [one["work_error"] for one in results] == [fit.work_error for fit in found.slip_elements]
