"""Linear guides by the contacts of the screw: a straight path, the loads of the balls, two contacts and four."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.supports import guide as contact_guide

OIL = bs.Lubricant.from_grade("ISO VG 68", 303.15)
SIZES = {"ball_diameter": 0.004, "balls": 14, "lubricant": OIL, "preload": 400.0, "carriages": 1}
ARCS, POINTED = bs.ContactGuide(**SIZES), bs.ContactGuide(**SIZES, contacts_per_ball=4, rows=2)


def test_balls_run_at_half_the_speed_of_the_carriage():
    found = ARCS.under(np.array([2000.0]), 0.8)
    assert found.balls.entrainment_speed == pytest.approx(0.4, rel=1e-6)


def test_a_load_that_relieves_the_others_is_borne_by_half_of_the_rows():
    """Their contacts climb the grooves, so that each bears less than at the angle without load."""
    pressed, relieved = ARCS.under(np.array([4000.0]), 0.5).balls.kinds
    assert 2 * 14 * pressed.given_load * np.sin(pressed.contact_angle) == pytest.approx(4000.0, rel=1e-9)
    assert pressed.contact_angle > math.pi / 4
    assert relieved.given_load == 0


@pytest.mark.parametrize("guide", [ARCS, POINTED], ids=["two contacts", "four contacts"])
def test_the_path_is_straight(guide, monkeypatch):
    """Ten times as large a circle is as straight."""
    loads = np.array([[100.0], [1500.0]])
    here = guide.under(loads, 0.5).friction_effort
    monkeypatch.setattr(contact_guide, "STRAIGHT", 10 * contact_guide.STRAIGHT)
    straighter = bs.ContactGuide(**SIZES, contacts_per_ball=guide.contacts_per_ball, rows=guide.rows)
    np.testing.assert_allclose(straighter.under(loads, 0.5).friction_effort, here, rtol=2e-5)


def test_two_contacts_do_not_spin_and_four_must():
    loads = np.array([200.0])
    two, four = (guide.under(loads, 0.5).contributions for guide in (ARCS, POINTED))
    assert two["spin"] < 1e-5 * sum(two.values())
    assert four["spin"] > 0.3 * sum(four.values())


def test_parts_sum_and_carriages_add():
    guide = bs.ContactGuide(**{**SIZES, "carriages": 4}, seal_force=3.0)
    loads = np.array([500.0, 800.0, 0.0, 1500.0])
    whole = guide.under(loads, -0.3)
    alone = [bs.ContactGuide(**SIZES).under(np.array([load]), 0.3).friction_effort for load in loads]
    assert whole.friction_effort == pytest.approx(sum(alone) + 4 * 3.0, rel=1e-12)
    assert sum(whole.contributions.values()) == pytest.approx(whole.friction_effort, rel=1e-12)
    assert whole.friction_power == pytest.approx(0.3 * whole.friction_effort, rel=1e-12)
    even = guide(bs.OperatingState(4 * 500.0, 0.3))
    assert even.friction_effort == pytest.approx(4 * alone[0] + 12.0, rel=1e-12)


def test_pressed_and_pulled_are_alike():
    loads = np.array([[-2000.0], [2000.0]])
    pulled, pressed = ARCS.under(loads, 0.5).friction_effort
    assert pulled == pytest.approx(pressed, rel=1e-9)


def test_in_a_duty_it_is_an_element_with_its_mechanisms():
    axis = bs.Axis(mass=500.0, inertia=1e-3, guides=bs.ContactGuide(**{**SIZES, "carriages": 4}, seal_force=3.0))
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=3000.0))
    motion = bs.Trapezoid(stroke=0.4, speed=0.3, acceleration=3.0)
    duty = bs.duty(0.9, screw, axis=axis, motion=motion)
    parts = duty.energy_lost_in["guides"]
    assert {"hydrodynamic rolling", "curvature slip", "guide seals"} <= set(parts)
    assert sum(parts.values()) == pytest.approx(duty.energy_by["guides"] + duty.energy_by["guide seals"], rel=1e-9)
    drawn = duty.energy_drawn - duty.energy_returned
    assert drawn == pytest.approx(sum(duty.heat.values()) * duty.states.cycle_time, rel=1e-9)


def test_faults_name_the_field():
    with pytest.raises(bs.InputError) as raised:
        bs.ContactGuide(**{**SIZES, "preload": -1.0}, rows=3, contacts_per_ball=5)
    assert [fault.field for fault in raised.value.faults] == ["guides.contacts_per_ball", "guides.preload"]
    with pytest.raises(bs.InputError, match=r"guides\.rows: must be even"):
        bs.ContactGuide(**SIZES, rows=3)
    with pytest.raises(bs.InputError, match=r"guides\.contacts_per_ball: must be 2 or 4"):
        bs.ContactGuide(**SIZES, contacts_per_ball=3)
