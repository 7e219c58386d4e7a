"""An axis with a support bearing among its elements: the torque of the motor is the sum of its parts."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.axis import GRAVITY
from ballscrew.supports.makers_bearing import SKFBearing

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
SCREW = ROW.screw(nut=bs.DoubleNut(preload=3605.0))
OIL = bs.Lubricant.from_grade("ISO VG 68", 313.15)
SIZES = {"bore": 0.030, "outside_diameter": 0.062, "lubricant": OIL, "preload": 2000.0, "seal_torque": 0.05}
BEARING = bs.SupportBearing(contact_angle=math.radians(60), **SIZES)
GUIDE = bs.LinearGuide(friction_coefficient=0.003, seal_force=3.0)
MASS = 500.0
AXIS = bs.Axis(
    mass=MASS,
    inclination=math.radians(20),
    guide_friction_coefficient=GUIDE.friction_coefficient,
    guide_seal_force=4 * GUIDE.seal_force,
    inertia=2e-3,
)
MOTION = bs.Trapezoid(stroke=0.4, speed=0.3, acceleration=3.0, dwell=0.2)


def a_duty(also):
    return bs.duty(bs.FrictionModel.reference(), SCREW, OIL, axis=AXIS, motion=MOTION, also=also)


@pytest.fixture(scope="module")
def duties():
    return a_duty({}), a_duty({"fixed bearing": BEARING, "far bearing": SKFBearing(**SIZES)})


def test_torque_is_the_sum_of_its_parts_with_the_bearings_among_them(duties):
    bare, whole = duties
    np.testing.assert_allclose(sum(whole.parts.values()), whole.torque, rtol=1e-12)
    added = whole.parts["fixed bearing"] + whole.parts["far bearing"]
    np.testing.assert_allclose(whole.torque, bare.torque + added, rtol=1e-12, atol=1e-14)


def test_a_bearing_takes_the_load_and_the_speed_of_the_screw(duties):
    _, whole = duties
    state = bs.OperatingState(whole.axial_load, whole.screw_speed)
    expected = BEARING(state).friction_effort * whole.states.direction
    np.testing.assert_allclose(whole.parts["fixed bearing"], expected, rtol=1e-12)
    lost = whole.states.integral(BEARING(state).friction_power)
    assert whole.energy_by["fixed bearing"] == pytest.approx(lost, rel=1e-9)


def test_energy_closes_with_the_bearings(duties):
    _, whole = duties
    drawn = whole.energy_drawn - whole.energy_returned
    assert drawn == pytest.approx(whole.energy_lost + whole.energy_of_process + whole.energy_stored, rel=1e-9)


def test_guides_of_the_axis_are_the_element(duties):
    bare, _ = duties
    weight = MASS * GRAVITY * math.cos(AXIS.inclination)
    arm = SCREW.lead / (2 * math.pi)
    found = GUIDE(bs.OperatingState(weight, 0.3)).friction_effort * arm
    moving = np.abs(bare.states.direction) > 0
    of_axis = np.abs(bare.parts["guides"] + bare.parts["guide seals"])[moving]
    np.testing.assert_allclose(of_axis, found, rtol=1e-12)
