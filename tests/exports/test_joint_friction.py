"""The friction of a joint that knows no load: its fit, its error, and what a case says of it."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.exports.export import target
from ballscrew.exports.programs import joint_friction

OPTIONS = {"load": 1000.0, "inertia": 2e-4}
SPEED = np.geomspace(1 / 60, 1, 60)


@pytest.fixture(scope="module")
def handed(handed_over):
    return handed_over(bs.FrictionModel.olaru2005(), bs.DoubleNut(preload=900.0), to="mujoco", **OPTIONS)


@pytest.mark.parametrize("coefficients", [(0.2, 0.1), (0.2, 0.5, -0.4, 0.1), (0.0, 0.3, 0.0, 0.2)])
def test_a_polynomial_is_found_again(coefficients):
    torque = np.polynomial.polynomial.polyval(SPEED, coefficients)
    found = joint_friction.least_largest_error(SPEED, torque, len(coefficients) - 1)
    assert found == pytest.approx(coefficients, abs=1e-9)


@pytest.mark.parametrize("degree", [1, 3])
def test_the_largest_error_is_the_least(degree):
    """Chebyshev: the best of all polynomials with n coefficients has its largest error n + 1 times, in turns."""
    torque = 0.5 + 0.3 * SPEED + 0.05 * np.sin(7 * SPEED)
    off = (
        np.polynomial.polynomial.polyval(SPEED, joint_friction.least_largest_error(SPEED, torque, degree)) / torque - 1
    )
    signs = np.sign(off[np.abs(off) > np.max(np.abs(off)) * (1 - 1e-6)])
    assert np.sum(signs[1:] != signs[:-1]) + 1 >= degree + 2


def test_a_falling_friction_gives_no_damping_that_drives():
    torque = 0.2 + 0.4 / (1 + 20 * SPEED)
    found = joint_friction.least_largest_error(SPEED, torque, 3)
    drag = np.polynomial.polynomial.polyval(np.linspace(0, 10, 100_001), found) - found[0]
    assert found[0] > 0
    assert np.min(drag) >= -1e-15


def test_the_joint_is_as_far_off_as_it_says(handed):
    joint = joint_friction.joint_friction(handed, 3)
    errors = joint_friction.joint_errors(handed, joint)
    worst = errors.at_load
    speed = worst.relative_at["screw_speed"]
    true = handed.evaluate({"axial_load": 1000.0, "screw_speed": speed})["screw_torque"]
    assert abs(float(joint.torque(speed) / true) - 1) == pytest.approx(worst.relative, rel=1e-9)
    assert worst.relative < 0.02
    assert errors.over_loads.relative > 5 * worst.relative
    (warning,) = errors.warnings(joint)
    assert f"{100 * worst.relative:.2g} % off the model at 1 kN" in warning.text
    assert f"{errors.over_loads.value:.2g} N m off at" in warning.text


def test_the_error_over_the_range_counts_rest_and_slow_speeds(handed):
    joint = joint_friction.joint_friction(handed, 3)
    errors = joint_friction.joint_errors(handed, joint)
    assert joint_friction.joint_range(handed)["screw_speed"] == (-300.0, 300.0)
    assert abs(errors.over_loads.at["screw_speed"]) < joint.speeds[0]
    assert errors.at_rest.value == pytest.approx(abs(joint.at_rest - joint.coefficients[0]), rel=1e-9)
    assert errors.at_rest.relative > 5 * errors.at_load.relative
    assert [one.output for one in errors.of_export][1:] == [
        "screw_torque_at_load_and_speeds_of_fit",
        "screw_torque_at_rest",
    ]


def test_without_a_load_no_range_around_it_is_named(handed):
    idle = dataclasses.replace(handed, options={**handed.options, "load": 0.0})
    errors = joint_friction.joint_errors(idle, joint_friction.joint_friction(idle, 1))
    assert "off the model at 0 kN, and" in errors.text


def test_of_a_slide_it_is_the_same_power(handed):
    """Force times speed of the slide is torque times speed of the shaft."""
    joint = joint_friction.joint_friction(handed, 3)
    turning = 40.0
    slide = turning * joint.lead / (2 * math.pi)
    force = joint.dry + sum(c * slide ** (n + 1) for n, c in enumerate(joint.damping))
    assert force * slide == pytest.approx(float(joint.torque(turning)) * turning, rel=1e-12)
    assert joint.armature * slide**2 == pytest.approx(2e-4 * turning**2, rel=1e-12)


def test_where_the_model_does_not_hold_a_warning_says_so(handed):
    """Under a light load a film is beyond the range of its law at high speed."""
    light = dataclasses.replace(handed, options={**handed.options, "load": 10.0})
    light = dataclasses.replace(light, inputs=tuple(without_preload(one) for one in light.inputs))
    joint = joint_friction.joint_friction(light, 1)
    assert 0 < joint.share_valid < 1
    warnings = joint_friction.joint_errors(light, joint).warnings(joint)
    assert [one.id for one in warnings] == ["hand_over.no_load", "hand_over.fit_validity"]
    assert warnings[1].value == joint.share_valid


def without_preload(one):
    return dataclasses.replace(one, value=10.0) if one.name == "preload" else one


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"load": math.nan}, r"hand_over\.load: missing · .*give load"),
        ({"load": 2e7}, r"hand_over\.load: is beyond the bounds of the model"),
        ({"lowest_speed": 400.0}, r"hand_over\.lowest_speed: must be above 0 and below the highest"),
        ({"mass": -1.0}, r"hand_over\.mass: must be above 0"),
        ({"inclination": 2.0}, r"hand_over\.inclination: is beyond the vertical"),
        ({"inertia": -1.0}, r"hand_over\.inertia: must be 0 or more"),
    ],
)
def test_faults_say_what_to_do(handed, change, expected):
    wrong = dataclasses.replace(handed, options={**handed.options, **change})
    with pytest.raises(bs.InputError, match=expected):
        joint_friction.joint_friction(wrong, 1)


def test_a_case_gives_load_and_inertia_at_the_screw(example):
    case = case_file.load(example.parent / "vertical_axis.toml", ["axis.transmission_ratio=2"])
    found = target("mujoco").options_of_case(case)
    assert (found["load"], found["inertia"]) == (4000.0, pytest.approx(4 * 45e-4))
    point = {"presliding_load": case.operation.axial_load, "presliding_speed": case.operation.screw_speed}
    assert target("c").options_of_case(case) == point


@pytest.mark.parametrize(
    "changes",
    [
        ["axis.mass=350 kg"],
        ["axis.mass=350 kg", "axis.inclination=30 deg"],
        ["axis.mass=350 kg", "axis.inclination=-90 deg"],
        ["axis.mass=350 kg", "axis.counterweight=300 kg"],
        ["axis.mass=350 kg", "axis.counterweight=200 kg", "axis.counterforce=250 N", "axis.inclination=-60 deg"],
        ["axis.inclination=0 deg"],
    ],
)
def test_a_case_gives_what_moves_and_its_weight(handed, example, changes):
    case = case_file.load(example.parent / "vertical_axis.toml", changes)
    options = {**handed.options, **target("mujoco").options_of_case(case)}
    joint = joint_friction.joint_friction(dataclasses.replace(handed, options=options), 1)
    assert joint.mass == case.axis.mass + case.axis.counterweight
    assert joint.gravity_force == pytest.approx(case.axis.gravity_force, rel=1e-12, abs=1e-9)
    assert joint.direction == pytest.approx((math.cos(case.axis.inclination), 0, math.sin(case.axis.inclination)))
    assert joint.warnings(balances=True) == []
    balanced = case.axis.counterweight + case.axis.counterforce > 0
    assert [one.id for one in joint.warnings(balances=False)] == ["hand_over.counterforce"] * balanced


@pytest.mark.parametrize("load", [1000.0, -1000.0, 0.0])
def test_without_a_mass_it_is_that_of_the_load_and_a_sentence_says_so(handed, load):
    joint = joint_friction.joint_friction(dataclasses.replace(handed, options={**handed.options, "load": load}), 1)
    assert joint.mass == pytest.approx(abs(load) / 9.80665 if load else 1.0)
    (said,) = joint.warnings(balances=True)
    assert said.id == "hand_over.mass"
    assert f"no mass is given ([axis] mass): the axis of the files is vertical and has {joint.mass:.4g} kg" in said.text
