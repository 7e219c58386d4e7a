"""What each effect adds: the way from the corrected model to the reference, and the effects by themselves."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from ballscrew.cases.case_files import case_file
from ballscrew.physics.friction.model import FrictionModel
from effect_study import curves
from effect_study.cases import CASES, CATALOGUE, PAPER, RPM, effects, sensitivities, steps
from oracles.contact_integral import contact_integral
from oracles.free_ball import BallResistances
from oracles.tractions import Coulomb

BY_NAME = pytest.mark.parametrize("case", CASES.values(), ids=CASES)


@pytest.fixture(scope="module", params=CASES.values(), ids=CASES)
def found(request):
    return request.param, {effect.short: effect for effect in effects(request.param)}


# -- the steps ------------------------------------------------------------------------------------


def test_the_way_starts_at_the_corrected_model_and_ends_at_the_reference():
    first, *_, last = steps()
    assert first.model.label == "corrected"
    assert last.model.label == "reference"


@BY_NAME
def test_the_last_step_gives_what_the_reference_gives(case):
    reached, reference = case.result(steps()[-1].model), case.result(FrictionModel.reference())
    assert reached.screw_torque == reference.screw_torque
    assert reached.efficiency == reference.efficiency
    assert dict(reached.contributions) == dict(reference.contributions)


def test_a_step_changes_one_slot():
    for before, after in zip(steps(), steps()[1:], strict=False):
        fields = {field.name for field in dataclasses.fields(FrictionModel)} - {"name"}
        changed = {name for name in fields if getattr(before.model, name) is not getattr(after.model, name)}
        assert len(changed) == 1, after.short


def test_parts_sum_to_the_torque_and_additions_to_the_difference(found):
    _, by_name = found
    every = list(by_name.values())
    for effect in every:
        assert sum(effect.parts.values()) == pytest.approx(effect.torque, rel=1e-12)
    assert sum(effect.added for effect in every) == pytest.approx(every[-1].torque - every[0].torque, rel=1e-12)


@BY_NAME
def test_every_step_is_valid(case):
    for step in steps():
        assert case.result(step.model).warnings == [], step.short


def test_signs_of_the_effects(found):
    """Rolling in all regimes, sharing, slip and rubbing balls add; heat, less boundary friction and running in take."""
    _, by_name = found
    signs = {name: math.copysign(1, effect.added) for name, effect in by_name.items() if name != "corrected"}
    less = {name for name, sign in signs.items() if sign < 0}
    assert less == {"inlet heat", "µ_0 0.12", "run-in", "no braking"}


def test_effects_touch_the_parts_they_should(found):
    _, by_name = found
    for before, after, still in (
        ("corrected", "rolling", ("elastic_hysteresis", "ball_to_ball")),
        ("inlet heat", "load sharing", ("hydrodynamic_rolling", "elastic_hysteresis", "ball_to_ball")),
        ("run-in", "spin", ("hydrodynamic_rolling", "elastic_hysteresis", "ball_to_ball")),
        ("ellipse", "helix", ("hydrodynamic_rolling", "elastic_hysteresis", "ball_to_ball")),
    ):
        for part in still:
            assert by_name[before].parts[part] == by_name[after].parts[part]
    for name, effect in by_name.items():
        assert (effect.parts["helix"] > 0) == (name in {"helix", "no braking", "balls"})
        assert (effect.parts["spin"] > 0) == (name in {"spin", "ellipse", "helix", "no braking", "balls"})


def test_spin_and_helix_matter_more_with_open_grooves_and_a_steep_lead():
    close, open_ = ({effect.short: effect for effect in effects(case)} for case in (PAPER, CATALOGUE))
    for name in ("spin", "helix"):
        assert open_[name].added / open_["run-in"].torque > 3 * close[name].added / close["run-in"].torque


@BY_NAME
def test_sensitivities_are_sorted_and_bracket_the_reference(case):
    found = sensitivities(case)
    reference = float(case.result(FrictionModel.reference()).screw_torque)
    widths = [one.highest - one.lowest for one in found]
    assert widths == sorted(widths, reverse=True)
    for one in found:
        assert one.reference == reference
        assert one.lowest <= 0 <= one.highest
        assert one.highest - one.lowest > 0.01


def test_the_catalogue_screw_is_the_example_file():
    example = case_file.load(Path(__file__).parents[2] / "examples" / "feed_drive.toml")
    assert example.model.label == "reference"
    mine = CATALOGUE.result(FrictionModel.reference())
    theirs = example.model(
        example.screw,
        example.lubricant,
        axial_load=example.operation.axial_load,
        screw_speed=example.operation.screw_speed,
    )
    assert float(theirs.screw_torque) == pytest.approx(float(mine.screw_torque), rel=1e-12)
    for name in ("pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls", "contact_angle"):
        assert getattr(example.screw, name) == pytest.approx(getattr(CATALOGUE.screw, name), rel=1e-12)


@BY_NAME
def test_the_load_of_skidding_grows_with_speed(case):
    slow, fast = (curves.largest_flagged_load(case, "skid", speed * RPM) for speed in (600, 3000))
    assert slow < 0.4 * fast
    assert slow == curves.largest_flagged_load(case, "skid")
    assert curves.largest_flagged_load(case, "contact_pressure") == 0


@BY_NAME
def test_no_load_and_no_speed_give_what_the_page_on_validity_says(case):
    for name, model in curves.MODELS.items():
        unloaded = case.result(model, axial_load=0.0)
        assert not unloaded.validity["skid"]
        assert np.isnan(unloaded.efficiency)
        parts = {part for part, torque in unloaded.contributions.items() if torque}
        assert parts == (set() if name == "reference" else {"ball_to_ball", "chain_braking"})
        at_rest, slow = case.result(model, screw_speed=0.0), case.result(model, screw_speed=1e-8)
        assert at_rest.warnings == []
        assert at_rest.contributions["hydrodynamic_rolling"] == 0
        assert at_rest.screw_torque == pytest.approx(slow.screw_torque, rel=1e-3)


# -- curves ---------------------------------------------------------------------------------------


def test_spin_curves_have_their_limits():
    found = curves.spin_curves()
    assert found.curvature[0] == 1
    assert found.spin[0] == pytest.approx(0, abs=1e-15)
    assert found.curvature[-1] == pytest.approx(0, abs=1e-12)
    assert found.spin[-1] == pytest.approx(1, abs=1e-12)
    assert found.one_line_from == pytest.approx(1, abs=0.01)
    assert np.all(np.diff(found.curvature_power + found.spin_power) > 0)


@BY_NAME
def test_the_slip_picture_is_that_of_the_integral(case):
    """Sign by sign and point by point: the strips settle where the integral does."""
    result = case.result(FrictionModel.reference())
    s, n = result.screw, result.nut
    integral = contact_integral(
        case.screw,
        float(result.contact_load),
        (Coulomb(float(s.friction_coefficient)), Coulomb(float(n.friction_coefficient))),
        resistances=BallResistances(
            float(s.hydrodynamic_rolling_force),
            float(n.hydrodynamic_rolling_force),
            float(s.elastic_resistance_moment),
            float(n.elastic_resistance_moment),
            float(result.ball_friction_moment),
            float(result.net_braking_force),
        ),
        screw_speed=case.screw_speed,
    )
    for on_screw, mine, theirs in ((True, s, integral.screw), (False, n, integral.nut)):
        field = theirs.field
        across, along = field.across / float(mine.semi_major_axis), field.along / float(mine.semi_minor_axis)
        picture = curves.slip_picture(result, on_screw, across, along)
        load = field.pressure * field.area
        for found, expected in ((picture.slip_along, field.slip_along), (picture.slip_across, field.slip_across)):
            difference, size = (np.sqrt(load @ value**2) for value in (found - expected, expected))
            assert difference < 0.05 * size


@BY_NAME
def test_parts_over_lead(case):
    lead, result = curves.over_lead(case)
    assert lead[-1] == pytest.approx(case.screw.pitch_circle_diameter)
    assert np.all(result.valid)
    assert np.all(np.diff(result.contributions["helix"]) > 0)
    assert np.all(np.diff(result.screw_torque) > 0)


@BY_NAME
def test_the_ball_skids_at_light_load_only(case):
    load, results = curves.over_light_load(case)
    result = results["reference"]
    skids = ~np.asarray(result.validity["skid"])
    assert skids[0]
    assert not skids[-1]
    assert np.count_nonzero(np.diff(skids.astype(int))) == 1
    assert np.all((np.asarray(result.rolling_share) < 1) == skids)
    power = result.friction_power / (result.screw_torque * case.screw_speed)
    assert power == pytest.approx(1, rel=1e-12)
    assert load[skids].max() < 0.01 * case.axial_load
