"""A support bearing is the contact core of the screw in a plane: balance, limits, and what it sums to."""

import dataclasses
import math

import numpy as np
import pint
import pytest

import ballscrew as bs
from ballscrew.axis.supports.bearing import bearing_model
from ballscrew.physics.laws.frame import helix_frame
from support.screws import with_grooves
from support.strategies import MODELS

OIL = bs.Lubricant(viscosity=0.06, density=870.0)
ROW = bs.SupportBearing(
    bore=0.025, outside_diameter=0.052, contact_angle=math.radians(40), lubricant=OIL, rows=1, ball_diameter=0.008
)
PAIR = dataclasses.replace(ROW, contact_angle=math.radians(60), rows=2, preload=1500.0, seal_torque=0.05)
LOADS = np.array([-6000.0, -800.0, 0.0, 800.0, 6000.0])


def screw_of(bearing, lead, scale=1.0):
    """A ball screw of the sizes of a bearing; the circle of its balls grows by the scale, and the balls with it."""
    balls = {"ball_diameter": bearing.balls_size, "loaded_balls": bearing.balls_of_a_row}
    d_m, angle = scale * bearing.mean_diameter, bearing.contact_angle
    return with_grooves(0.52, pitch_circle_diameter=d_m, lead=lead, contact_angle=angle, **balls)


def test_a_row_is_the_core_in_the_bearing_frame():
    model = bearing_model(MODELS["reference"])
    expected = model(screw_of(ROW, 0.012), OIL, axial_load=1500.0, screw_speed=80.0)
    found = ROW(bs.OperatingState(1500.0, 80.0))
    assert found.friction_effort == pytest.approx(expected.screw_torque, rel=1e-14)
    balls = found.balls
    load = ROW.balls_of_a_row * balls.contact_load * math.sin(ROW.contact_angle)
    assert load == pytest.approx(1500.0, rel=1e-15)


def test_both_sides_of_a_pair_balance_the_load():
    loads = PAIR(bs.OperatingState(LOADS, 80.0)).balls.solved_loads
    balls = PAIR.balls_of_a_row
    ahead, behind = (
        np.sum(balls * getattr(loads, f"{side}_load") * np.sin(getattr(loads, f"{side}_angle")), axis=-1)
        for side in ("forward", "backward")
    )
    np.testing.assert_allclose(ahead - behind, LOADS, rtol=1e-9, atol=1e-6)
    assert ahead[2] == pytest.approx(PAIR.preload, rel=1e-9)


def test_without_a_lead_the_helix_is_the_plane():
    model = dataclasses.replace(bearing_model(), frame=helix_frame)
    contacts = ROW.contacts
    flat = model(contacts, OIL, axial_load=1500.0, screw_speed=80.0)
    assert flat.screw_torque == pytest.approx(ROW(bs.OperatingState(1500.0, 80.0)).friction_effort, rel=1e-12)


@pytest.mark.implausible
def test_a_screw_tends_to_a_bearing_as_its_lead_vanishes_against_its_circle():
    """The least lead is the ball's: the circle grows instead. The helix counts by the square of its slope."""
    plane, helix = bearing_model(), dataclasses.replace(bearing_model(), frame=helix_frame)
    apart = []
    for scale in (4.0, 8.0, 16.0):
        screw = screw_of(ROW, 0.0085, scale)
        given = {"axial_load": 1500.0, "screw_speed": 80.0 / scale}
        on_helix = helix(screw, OIL, **given).screw_torque
        apart.append(abs(float(on_helix / plane(screw, OIL, **given).screw_torque) - 1))
    assert apart[0] > 2 * apart[1] > 4 * apart[2] > 0
    assert apart[2] < 1e-3


def test_parts_power_and_signs():
    speeds = np.array([-90.0, 90.0, 90.0, 30.0, -90.0])
    found = PAIR(bs.OperatingState(LOADS, speeds))
    np.testing.assert_allclose(sum(found.contributions.values()), found.friction_effort, rtol=1e-12)
    np.testing.assert_allclose(found.friction_power, found.friction_effort * abs(speeds), rtol=1e-9)
    np.testing.assert_allclose(found.contributions["seals"], 0.05)
    mirrored = PAIR(bs.OperatingState(-LOADS, -speeds))
    np.testing.assert_allclose(mirrored.friction_effort, found.friction_effort, rtol=1e-9)
    assert all(np.all(mask) for mask in found.validity.values())
    assert found.warning_records == []


def test_rigidity_is_the_slope_of_load_over_displacement():
    step = 1.0
    for bearing, load in ((PAIR, 0.0), (PAIR, 700.0), (dataclasses.replace(ROW, preload=0.0), 700.0)):
        moved = [-step, step]
        contacts = bearing.contacts
        if bearing.rows == 1:
            contacts = dataclasses.replace(contacts, nut=bs.SingleNut(angle_under_load=True))
        model = bearing_model()
        there = [model(contacts, OIL, axial_load=load + by, screw_speed=80.0).solved_loads.deflection for by in moved]
        assert bearing.rigidity(load) == pytest.approx(2 * step / (there[1] - there[0]), rel=1e-4)


def test_one_row_carries_one_direction():
    found = ROW(bs.OperatingState(np.array([-500.0, 500.0]), 80.0))
    assert list(found.validity["direction"]) == [False, True]
    (record,) = [each for each in found.warning_records if each.name == "direction"]
    assert "take a pair" in record.text


def test_rows_share_the_load_of_their_side():
    four = dataclasses.replace(PAIR, rows=4, preload=3000.0)
    state, double = bs.OperatingState(700.0, 80.0), bs.OperatingState(1400.0, 80.0)
    of_balls = [each.friction_effort - 0.05 for each in (PAIR(state), four(double))]
    assert of_balls[1] == pytest.approx(2 * of_balls[0], rel=1e-9)


def test_what_is_not_given_is_assumed_and_said():
    bearing = bs.SupportBearing(bore=0.025, outside_diameter=0.052, contact_angle=0.7, lubricant=OIL)
    assert bearing.balls_size == pytest.approx(0.0081)
    assert bearing.balls_of_a_row == 13
    assert bearing.contacts.nut_conformity == bearing.contacts.screw_conformity == 0.52
    assert len(bearing.assumed) == 3
    assert ROW.assumed == ("balls that fill 0.9 of the circle", "a conformity of 0.52")
    assert dataclasses.replace(ROW, balls=12, conformity=0.53).assumed == ()


def test_quantities_with_units_are_converted():
    unit = pint.UnitRegistry()
    given = bs.SupportBearing(
        bore=25 * unit.mm,
        outside_diameter=5.2 * unit.cm,
        contact_angle=40 * unit.degree,
        lubricant=OIL,
        rows=1,
        ball_diameter=8 * unit.mm,
    )
    state = bs.OperatingState(1500.0, 80.0)
    assert given(state).friction_effort == pytest.approx(float(ROW(state).friction_effort), rel=1e-12)
    assert given.rigidity(1.5 * unit.kN) == pytest.approx(float(ROW.rigidity(1500.0)), rel=1e-12)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"outside_diameter": 0.02}, "bearing.outside_diameter"),
        ({"rows": 3}, "bearing.rows"),
        ({"preload": 10.0}, "bearing.preload"),
        ({"balls": 16}, "bearing.balls"),
        ({"bore": np.array([0.02, 0.03])}, "bearing.bore"),
        ({"conformity": 0.4}, "bearing.conformity"),
    ],
)
def test_faults_name_the_field(change, field):
    with pytest.raises(bs.InputError) as raised:
        dataclasses.replace(ROW, **change)
    assert [fault.field for fault in raised.value.faults] == [field]
