"""The loaded zone: loads and speeds of balls in grooves that deviate, and the creep of their contacts."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.equations import ball_chain, kinematics
from ballscrew.physics.friction.balls import ball_friction
from ballscrew.physics.moving_balls.loaded_zone import Groove, creep, loaded_zone
from ballscrew.physics.solvers.line_slip import line_slip
from support.equations import speed_deviation

ROWS = [
    "rexroth-16x5x3-4-double",
    "rexroth-40x10x6-6-double",
    "rexroth-63x10x6-4-double",
    "rexroth-125x20x12.7-6-double",
]
MODEL = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
#: Rolling in it takes next to no friction.
THIN_OIL = bs.Lubricant.from_grade("ISO VG 32", temperature=350.0)
OMEGA = 100 * 2 * math.pi / 60


def screw(name="rexroth-40x10x6-6-double", share=0.05):
    row = bs.catalogue()[name]
    return row.screw(nut=bs.DoubleNut(preload=share * row.dynamic_load_rating))


def zone_of(part, deviation=0.0, **changes):
    given = {"axial_load": 0.0, "screw_speed": OMEGA, "seed": 1, **changes}
    return loaded_zone(MODEL, part, OIL, groove_deviation=deviation, **given)


def slip_of(model, part, oil, load):
    """Friction, lateral slip, spin, semi-axis and speed of a ball, as the closed forms of its creep ask for them."""
    ball = ball_friction(model, part, oil, model.laws.frame(part), load, OMEGA, 0.0)
    s, n = ball.screw, ball.nut
    return (
        (s.friction_coefficient + n.friction_coefficient) / 2,
        s.lateral_slip_speed + n.lateral_slip_speed,
        s.spin + n.spin,
        (s.semi_major_axis + n.semi_major_axis) / 2,
        ball.entrainment_speed / (1 + ball.frame.curvature_ratio),
    )


@pytest.mark.parametrize("name", ROWS)
def test_the_creep_of_the_slip_solver_is_that_of_the_rule(name):
    # c/Q of the solver over the ellipse at 5 % of the rating, 100 rpm (6.0, 9.1, 20.0, 18.7), against the closed form
    part = screw(name)
    load = zone_of(part).nominal_load
    found = creep(MODEL, part, OIL, load, OMEGA).coefficient[0]
    assert found == pytest.approx(ball_chain.creep_coefficient(*slip_of(MODEL, part, OIL, load)), rel=0.02)


def test_published_sizes_have_their_creep():
    # 9.2, 20.2 and 18.8 for 40x10x6, 63x10x6 and 125x20x12.7 in an independent prototype
    for name, expected in zip(ROWS[1:], (9.2, 20.2, 18.8), strict=True):
        part = screw(name)
        assert creep(MODEL, part, OIL, zone_of(part).nominal_load, OMEGA).coefficient[0] == pytest.approx(
            expected, rel=0.02
        )


@pytest.mark.implausible
@pytest.mark.parametrize("load", [5.0, 40.0])
def test_lateral_slip_alone_has_its_creep_coefficient(load):
    # a contact angle near zero leaves no spin, wide grooves hardly any curvature: 4 mu v / D, with the speed of the
    # ball
    part = dataclasses.replace(
        screw(), contact_angle=1e-4, screw_conformity=1.0, nut_conformity=1.0, lead=0.04, nut=bs.SingleNut()
    )
    mu, slip, _, _, v = slip_of(MODEL, part, THIN_OIL, load)
    expected = ball_chain.creep_coefficient_of_lateral_slip(mu, slip, v)
    assert creep(MODEL, part, THIN_OIL, load, OMEGA).coefficient[0] == pytest.approx(expected, rel=0.005)


@pytest.mark.implausible
def test_spin_alone_has_its_creep_coefficient():
    # slender contacts without lateral slip, whose spin outgrows the curvature: 6 mu v / (Omega a)
    line = dataclasses.replace(MODEL, slip=line_slip)
    part = dataclasses.replace(screw(), contact_angle=math.radians(88), nut=bs.SingleNut())
    mu, _, spin, a, v = slip_of(line, part, THIN_OIL, 20.0)
    expected = ball_chain.creep_coefficient_of_spin(mu, spin, a, v)
    assert creep(line, part, THIN_OIL, 20.0, OMEGA).coefficient[0] == pytest.approx(expected, rel=1e-3)


def test_the_load_follows_from_the_deviations():
    # at a place without relief, the approach changes by the deviation along the normal, and the angle across it
    part = screw()
    zone = zone_of(part)
    middle = np.array([zone.length / 2])
    nominal = zone.at(middle, 0.0)
    assert nominal.load == pytest.approx(zone.nominal_load, rel=1e-12)
    alpha, A = float(nominal.contact_angle[0]), zone.centre_distance + zone.nominal_approach
    step = 1e-9
    for axial, radial in ((step, 0.0), (0.0, step)):
        harmonics = np.zeros((2, 2, 1))
        harmonics[:, 0, 0] = axial, radial
        moved = dataclasses.replace(zone, nut_groove=Groove(harmonics), length=2 * math.pi * zone.path_radius * 2)
        found = moved.at(np.array([moved.length / 2]), 0.0)  # two whole turns: the cosine is one
        along = axial * math.sin(alpha) + radial * math.cos(alpha)
        assert found.load / nominal.load - 1 == pytest.approx(1.5 * along / zone.nominal_approach, rel=2e-3)
        change = ball_chain.contact_angle_change(axial, radial, alpha, A)
        assert found.contact_angle - nominal.contact_angle == pytest.approx(change, rel=2e-3)
        gamma = MODEL.laws.frame(dataclasses.replace(part, contact_angle=alpha)).curvature_ratio
        deviation = speed_deviation(gamma, alpha, change, radial / 2, zone.path_radius)
        assert found.speed / nominal.speed - 1 == pytest.approx(deviation, rel=2e-3)


def test_the_natural_speed_is_that_of_the_kinematics():
    part = screw()
    zone = zone_of(part)
    alpha = float(zone.at(np.array([zone.length / 2]), 0.0).contact_angle[0])
    frame = MODEL.laws.frame(dataclasses.replace(part, contact_angle=alpha))
    orbit = kinematics.orbital_rotation(frame.entrainment_speed(1.0), frame.nut_contact_radius)
    assert zone.natural_speed == pytest.approx(orbit * frame.path_radius, rel=1e-14)


def test_the_load_rises_with_the_place_at_a_relieved_end():
    zone = zone_of(screw(), relief=2.0)
    ways = np.array([0.0, 0.25, 0.5, 1.0]) * zone.relief
    for places in (ways, zone.length - ways):
        assert zone.at(places, 0.0).load == pytest.approx(zone.nominal_load * np.array([0, 0.25, 0.5, 1]), rel=1e-9)
    outside = zone.at(np.array([-1e-9, zone.length * (1 + 1e-9)]), 0.0)
    assert not np.any(outside.load)
    assert not np.any(outside.creep)
    assert not np.any(outside.limit)


def test_grooves_have_the_deviation_that_is_asked_for():
    angles = np.linspace(0, 2 * math.pi, 400, endpoint=False)
    for seed in range(5):
        found = Groove.scattered(1e-6, np.random.default_rng(seed)).at(angles)
        assert np.sqrt(np.mean(found**2, axis=1)) == pytest.approx([1e-6, 1e-6], rel=1e-12)
    one, same, other = (zone_of(screw(), 1e-6, seed=seed).nut_groove.harmonics for seed in (1, 1, 2))
    assert np.all(one == same)
    assert np.any(one != other)


def test_the_screw_turns_under_the_balls():
    # what lies on the screw is met again by a ball at the same place after a turn, and by one further on after a part
    zone = zone_of(screw(), 1e-6)
    still = dataclasses.replace(zone, nut_groove=Groove(np.zeros((2, 2, 1))))
    place, on = zone.length / 2, 0.7
    here = still.at(np.array([place]), 0.0).load
    assert still.at(np.array([place]), 2 * math.pi).load == pytest.approx(here, rel=1e-9)
    assert still.at(np.array([place + on * zone.path_radius]), on).load == pytest.approx(here, rel=1e-9)
    assert abs(still.at(np.array([place]), on).load / here - 1) > 1e-3


def test_places_and_angles_broadcast():
    for keeps in (False, True):
        zone = zone_of(screw(), 1e-6, keeps_load=keeps)
        places = np.linspace(0, zone.length, 12).reshape(3, 4)
        angles = np.array([0.0, 1.0, 2.0])
        whole = zone.at(places, angles)
        for k in range(3):
            for one, many in zip(zone.at(places[k], angles[k]), whole, strict=True):
                assert many[k] == pytest.approx(one, rel=1e-12)
