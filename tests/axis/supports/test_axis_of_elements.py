"""An axis with a support bearing among its elements: the torque of the motor is the sum of its parts."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.duty_cycle.brake import brake_of
from ballscrew.axis.duty_cycle.duty_band import duty_band
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.guide import CarriedMass, GuidedTable
from ballscrew.axis.supports.makers_bearing import KnownBearing, SKFBearing
from ballscrew.physics.components.materials import GRAVITY

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


def a_duty(also, motion=MOTION):
    return bs.duty(bs.FrictionModel.reference(), SCREW, OIL, axis=AXIS, motion=motion, also=also)


@pytest.fixture(scope="module")
def duties():
    """At the same states."""
    whole = a_duty({"fixed bearing": BEARING, "far bearing": SKFBearing(**SIZES)})
    return a_duty({}, whole.states), whole


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


def test_guides_of_the_axis_are_the_element(duties):
    bare, _ = duties
    weight = MASS * GRAVITY * math.cos(AXIS.inclination)
    arm = SCREW.lead / (2 * math.pi)
    found = GUIDE(bs.OperatingState(weight, 0.3)).friction_effort * arm
    moving = np.abs(bare.states.direction) > 0
    of_axis = np.abs(bare.parts["guides"] + bare.parts["guide seals"])[moving]
    np.testing.assert_allclose(of_axis, found, rtol=1e-12)


def test_heat_of_the_elements_is_all_that_is_lost(duties):
    _, whole = duties
    parts = whole.energy_lost_in
    assert set(parts) == {"nut", "fixed bearing", "far bearing", "guides"}
    assert sum(sum(of.values()) for of in parts.values()) == pytest.approx(whole.energy_lost, rel=1e-12)
    drawn = whole.energy_drawn - whole.energy_returned
    heat = sum(whole.heat.values()) * whole.states.cycle_time
    assert drawn == pytest.approx(heat + whole.energy_of_process + whole.energy_stored, rel=1e-9)


def test_heat_of_a_bearing_is_its_power_by_mechanism(duties):
    _, whole = duties
    found = BEARING(bs.OperatingState(whole.axial_load, whole.screw_speed))
    power = whole.states.integral(found.friction_power)
    assert sum(whole.energy_lost_in["fixed bearing"].values()) == pytest.approx(power, rel=1e-9)
    seals = 0.05 * whole.states.integral(np.abs(whole.screw_speed))
    assert whole.energy_lost_in["fixed bearing"]["seals"] == pytest.approx(seals, rel=1e-9)


def test_belt_and_ratio_leave_the_heat_of_the_other_elements(duties):
    _, whole = duties
    geared = dataclasses.replace(AXIS, transmission_ratio=2.5, transmission_efficiency=0.95)
    found = bs.duty(bs.FrictionModel.reference(), SCREW, OIL, axis=geared, motion=MOTION, also=whole.also)
    for name, heat in whole.heat.items():
        assert found.heat[name] == pytest.approx(heat, rel=1e-9)
    drawn = found.energy_drawn - found.energy_returned
    assert drawn == pytest.approx(sum(found.heat.values()) * found.states.cycle_time, rel=1e-9)


def test_guides_as_an_element_are_those_of_a_coefficient(duties):
    bare, _ = duties
    plain = dataclasses.replace(AXIS, guide_friction_coefficient=0.0, guide_seal_force=0.0)
    of_element = bs.duty(
        bs.FrictionModel.reference(), SCREW, OIL, axis=dataclasses.replace(plain, guides=GUIDE), motion=bare.states
    )
    np.testing.assert_allclose(of_element.torque, bare.torque, rtol=1e-12, atol=1e-14)
    assert brake_of(of_element).holding_torque == pytest.approx(brake_of(bare).holding_torque, rel=1e-12)
    with pytest.raises(bs.InputError, match=r"axis\.guide_seal_force"):
        dataclasses.replace(AXIS, guides=GUIDE, guide_friction_coefficient=0.0)


def test_carriages_rub_by_the_load_of_each():
    """A mass high above the screw tips the table: carriages that are pulled rub, too, and the guides more in all."""
    flat = dataclasses.replace(AXIS, inclination=0.0, guide_friction_coefficient=0.0, guide_seal_force=0.0)
    table = GuidedTable(
        masses=(CarriedMass(mass=MASS, above=1.2),), carriage_spacing=0.3, rail_spacing=0.3, inclination=0.0
    )
    even, tipped = dataclasses.replace(flat, guides=GUIDE), dataclasses.replace(flat, guides=GUIDE, table=table)
    states = MOTION.states()
    more = tipped.loads(states).guides - even.loads(states).guides
    expected = np.abs(table.loads(states.acceleration).normal).sum(axis=-1) - MASS * GRAVITY
    np.testing.assert_allclose(more, 0.003 * expected * states.direction, atol=1e-12)
    assert np.max(more) > 1.0
    with pytest.raises(bs.InputError, match=r"axis\.mass: is another one"):
        dataclasses.replace(tipped, mass=MASS + 1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "central", "half"), [("bearings.fixed.torque", 0.3, 0.1), ("guides.friction_coefficient", 0.003, 0.001)]
)
def test_a_band_by_one_number_of_an_element_is_that_of_the_number(name, central, half):
    """What is lost goes evenly with it: the quantiles of the one are those of the other, but for the samples' grain."""
    axis = dataclasses.replace(AXIS, guide_friction_coefficient=0.0, guide_seal_force=0.0, guides=GUIDE)
    bearing = MountedBearing(place="fixed", element=KnownBearing(torque=0.3), load_share=0.0)
    found = bs.duty(bs.FrictionModel.reference(), SCREW, OIL, axis=axis, motion=MOTION, also={bearing.name: bearing})
    samples = 256
    band = duty_band(
        found, distributions={}, beside={name: bs.Uniform(central - half, central + half)}, samples=samples
    )
    element = {"bearings.fixed.torque": "fixed bearing", "guides.friction_coefficient": "guides"}[name]
    part = {"fixed bearing": "known", "guides": "by load"}[element]
    slope = found.energy_lost_in[element][part] / central
    grain = 2 / samples * 2 * half * slope
    energy = band["energy_lost"]
    assert energy.value == pytest.approx(found.energy_lost, rel=1e-9)
    assert energy.band.low == pytest.approx(found.energy_lost - 0.95 * half * slope, abs=grain)
    assert energy.band.high == pytest.approx(found.energy_lost + 0.95 * half * slope, abs=grain)


def test_a_band_of_an_element_that_is_not_there_is_refused(duties):
    with pytest.raises(bs.InputError, match=r"band\.distributions"):
        duty_band(duties[0], distributions={}, beside={"bearings.fixed.torque": bs.Uniform(0.1, 0.2)}, samples=16)
