"""Arrays are never refused: where they make no sense the result says so, and in silence."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.solvers.slip import curvature_slip

NAMES = ("efficiency", "back_driving_efficiency", "friction_power", "contributions", "dissipation", "drive_torque")
SIDES = ("maximum_pressure", "mutual_approach", "semi_minor_axis", "elastic_regime_parameter", "traction_limit")


def valid(model, screw, oil, axial_load=4000.0, screw_speed=62.0):
    """The mask; all lazy properties are read too, as none may warn (warnings are errors here)."""
    result = model(screw, oil, axial_load=axial_load, screw_speed=screw_speed)
    for name in NAMES:
        getattr(result, name)
    for side in (result.screw, result.nut):
        for name in SIDES:
            getattr(side, name)
    for part in result.contributions.values():
        assert np.shape(part) == np.shape(result.screw_torque)
    return result.valid


@pytest.mark.parametrize(
    ("field", "bad", "good"),
    [
        ("pitch_circle_diameter", 0.004, 0.04),
        ("lead", 0.001, 0.005),
        ("lead", -0.005, 0.005),
        ("ball_diameter", 0.03, 3.175e-3),
        ("loaded_balls", 50.5, 50.0),
        ("starts", 2.5, 1.0),
        ("contact_angle", 2.0, 0.7),
        ("screw_conformity", 0.4, 0.515),
        ("nut_conformity", 1.5, 0.515),
        ("ball_roughness", 0.0, 1e-7),
        ("screw_roughness", -1e-6, 1e-7),
    ],
)
def test_of_the_screw(model, seed_screw, seed_oil, field, bad, good):
    screw = dataclasses.replace(seed_screw, **{field: np.array([bad, good])})
    assert list(valid(model, screw, seed_oil)) == [False, True]


@pytest.mark.parametrize(("bad", "good"), [(-1.0, 0.1), (0.0, 0.1), (np.nan, 0.1), (np.inf, 0.1)])
def test_of_the_oil(model, seed_screw, seed_oil, bad, good):
    oil = dataclasses.replace(seed_oil, viscosity=np.array([bad, good]))
    assert list(valid(model, seed_screw, oil)) == [False, True]


def test_of_the_temperature(model, seed_screw):
    oil = bs.Lubricant.from_grade("ISO VG 100", np.array([0.0, 1e4, 313.15]))
    assert list(valid(model, seed_screw, oil)) == [False, False, True]


@pytest.mark.parametrize(
    ("field", "bad"), [("ball_to_ball_force", -1.0), ("ball_friction_coefficient", -0.1), ("pure_rolling_offset", 2.0)]
)
def test_of_the_model(model, seed_screw, seed_oil, field, bad):
    if field == "pure_rolling_offset" and model.slip is not curvature_slip:
        model = dataclasses.replace(model, slip=curvature_slip)
    changed = dataclasses.replace(model, **{field: np.array([bad, 0.1])})
    assert list(valid(changed, seed_screw, seed_oil)) == [False, True]


@pytest.mark.parametrize(("field", "bad", "good"), [("decay", -0.1, 1.42), ("exponent", -0.1, 0.8)])
def test_of_a_law(model, seed_screw, seed_oil, field, bad, good):
    law = dataclasses.replace(model.friction, **{field: np.array([bad, good])})
    assert list(valid(dataclasses.replace(model, friction=law), seed_screw, seed_oil)) == [False, True]


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_of_the_operating_point(model, seed_screw, seed_oil, bad):
    assert list(valid(model, seed_screw, seed_oil, axial_load=np.array([bad, 4000.0]))) == [False, True]
    assert list(valid(model, seed_screw, seed_oil, screw_speed=np.array([bad, 60.0]))) == [False, True]


def test_loads_and_speeds_of_either_sign_are_no_fault(model, seed_screw, seed_oil):
    signs = np.array([-1.0, 1.0])
    assert np.all(valid(model, seed_screw, seed_oil, axial_load=4000.0 * signs))
    assert np.all(valid(model, seed_screw, seed_oil, screw_speed=60.0 * signs))


def test_masks_have_the_shape_of_the_whole_result(model, seed_screw, seed_oil):
    screw = dataclasses.replace(seed_screw, lead=np.array([0.005, 0.01]))
    assert np.shape(valid(model, screw, seed_oil)) == (2,)
    oil = dataclasses.replace(seed_oil, viscosity=np.array([0.1, 0.2, 0.3, 0.4]))
    loads = np.array([[1000.0], [2000.0], [3000.0]])
    result = model(seed_screw, oil, axial_load=loads, screw_speed=60.0)
    assert {np.shape(mask) for mask in result.validity.values()} == {(3, 4)}


def test_a_model_says_what_was_changed(model):
    assert model.label == model.name
    assert dataclasses.replace(model, friction=dataclasses.replace(model.friction)).label == model.name
    changed = dataclasses.replace(model, ball_friction_coefficient=0.2, friction=bs.ZhouHoeprich(decay=2.0))
    assert changed.label == f"{model.name}, changed: friction, ball_friction_coefficient"
