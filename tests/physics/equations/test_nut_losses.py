"""Truth: virtual work, limits of the drag of a sphere, integrals of lubrication, impulses, the seals of a catalogue."""

import math

import numpy as np
import pytest

from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import kinematics, nut_losses
from ballscrew.physics.laws.frame import bearing_frame, helix_frame
from ballscrew.physics.laws.nut_losses import seal_table

from .numbers import SCREWS

RELATIVE = 1e-13
OIL = {"viscosity": 0.1, "ball_diameter": 3.175e-3, "orbital_speed": 0.6}


# -- seals ----------------------------------------------------------------------------------------


def test_a_lip_rubs_at_the_lever_of_the_radius():
    circumference = math.pi * 0.04
    assert nut_losses.seal_torque(2, 80.0, 0.04) == pytest.approx(2 * 80.0 * circumference * 0.02, rel=RELATIVE)


def test_seals_of_a_catalogue_follow_the_square_of_the_diameter():
    # Rexroth R310RU 3301: torque of two seals from 16 mm to 125 mm, 0.08 N m to 5 N m
    friction = [row.torque / nut_losses.seal_torque(2, 1.0, row.nominal_diameter) for row in seal_table()]
    assert min(friction) == pytest.approx(61, abs=0.5)
    assert max(friction) == pytest.approx(109, abs=0.5)
    slope, _ = np.polyfit(*np.log([(row.nominal_diameter, row.torque) for row in seal_table()]).T, 1)
    assert slope == pytest.approx(2.0, abs=0.1)


# -- the path of the balls ------------------------------------------------------------------------


@pytest.mark.implausible
@pytest.mark.parametrize("place", [bearing_frame, helix_frame])
@pytest.mark.parametrize("name", SCREWS)
def test_path_advance_is_orbital_speed_over_screw_speed(name, place):
    d_m, d_w, alpha, f = SCREWS[name]
    frame = place(BallScrew(d_m, 0.01, d_w, 50, alpha, f, f))
    omega = 62.8
    rotation = kinematics.orbital_rotation(frame.entrainment_speed(omega), frame.nut_contact_radius)
    speed = kinematics.orbital_speed(rotation, frame.path_radius)
    advance = nut_losses.path_advance(frame.path_radius, frame.curvature_ratio)
    assert advance * omega == pytest.approx(speed, rel=RELATIVE)


def test_balls_far_smaller_than_the_screw_go_half_as_fast():
    assert nut_losses.path_advance(0.02, 0.0) == 0.01


def test_torque_of_path_forces_is_virtual_work():
    omega, advance, force, number = 62.8, 9.4e-3, 0.4, 3
    power = number * force * advance * omega
    assert nut_losses.path_torque(number, force, advance) * omega == pytest.approx(power, rel=RELATIVE)


# -- drag of a ball -------------------------------------------------------------------------------


def test_slow_balls_feel_the_force_of_stokes():
    stokes = 6 * math.pi * 0.1 * 3.175e-3 / 2 * 0.6
    assert nut_losses.ball_drag_force(1.0, **OIL, ball_reynolds_number=0.0) == pytest.approx(stokes, rel=RELATIVE)


@pytest.mark.parametrize(("reynolds", "coefficient"), [(1.0, 27.6), (10.0, 4.15), (100.0, 1.092), (1000.0, 0.4382)])
def test_drag_coefficient_of_a_sphere(reynolds, coefficient):
    # 24/Re (1 + 0.15 Re^0.687), by hand; the standard curve has about 27, 4.1, 1.09 and 0.46
    d_w, v_o, eta_0 = 3.175e-3, 0.6, 0.1
    density = reynolds * eta_0 / (v_o * d_w)
    assert nut_losses.ball_reynolds_number(density, v_o, d_w, eta_0) == pytest.approx(reynolds, rel=RELATIVE)
    force = nut_losses.ball_drag_force(1.0, eta_0, d_w, v_o, reynolds)
    found = force / (density / 2 * v_o**2 * math.pi * d_w**2 / 4)
    assert found == pytest.approx(coefficient, rel=1e-3)


def test_drag_vanishes_with_the_oil_and_with_the_speed():
    assert nut_losses.ball_drag_force(0.0, **OIL, ball_reynolds_number=16.0) == 0.0
    assert nut_losses.ball_drag_force(1.0, 0.1, 3.175e-3, 0.0, 0.0) == 0.0
    assert nut_losses.ball_drag_force_harris(0.0, 0.44, 870.0, 3.175e-3, 0.6) == 0.0
    assert nut_losses.ball_drag_force_harris(1.0, 0.44, 870.0, 3.175e-3, 0.0) == 0.0


@pytest.mark.parametrize("speed", [0.5, 2.0, 10.0])
def test_drag_of_harris_is_near_the_pressure_on_the_cross_section(speed):
    # exactly so at 2 v = 1 m/s, then less by the twentieth root of 2 v
    pressure_force = 0.44 * 870.0 / 2 * speed**2 * math.pi * 3.175e-3**2 / 4
    force = nut_losses.ball_drag_force_harris(1.0, 0.44, 870.0, 3.175e-3, speed)
    assert force == pytest.approx(pressure_force * (2 * speed) ** -0.05, rel=1e-12)


# -- oil between balls ----------------------------------------------------------------------------


def power_of_gap(gap, diameter=6e-3, viscosity=0.1, rotation=300.0):
    """Power of one gap, W, of balls that turn as fast as the screw."""
    return rotation * nut_losses.sheared_oil_torque(1.0, viscosity, diameter, gap, 1.0, rotation)


@pytest.mark.parametrize("gap", [1e-6, 5e-5, 1e-3])
def test_power_of_a_gap_is_that_of_the_shear_in_it(gap):
    # rings of oil between two surfaces that pass each other, each as fast as a ball's
    radius, viscosity, rotation = 3e-3, 0.1, 300.0
    edges = radius * np.concatenate([[0.0], np.geomspace(1e-5, 1.0, 20001)])
    middle = (edges[1:] + edges[:-1]) / 2
    sheared = viscosity * (2 * rotation * radius) ** 2 / (gap + middle**2 / radius)
    power = np.sum(sheared * np.pi * np.diff(edges**2))
    assert power_of_gap(gap) == pytest.approx(power, rel=1e-6)


def test_power_of_a_small_gap_grows_as_the_resistance_of_two_spheres():
    # JeffreyOnishi1984: moments -8 pi eta R^3 (1/5 of its own rotation + 1/20 of the other's) ln(R/h), on both spheres
    radius, viscosity, rotation = 3e-3, 0.1, 300.0
    moment = 8 * math.pi * viscosity * radius**3 * (1 / 5 + 1 / 20) * rotation
    for gap in (1e-9, 1e-8):
        growth = power_of_gap(gap) - power_of_gap(10 * gap)
        assert growth == pytest.approx(2 * moment * rotation * math.log(10), rel=1e-4)


def test_oil_between_balls_is_linear_in_viscosity_and_square_in_speed():
    assert power_of_gap(5e-5, viscosity=0.3) == pytest.approx(3 * power_of_gap(5e-5), rel=RELATIVE)
    assert power_of_gap(5e-5, rotation=600.0) == pytest.approx(4 * power_of_gap(5e-5), rel=RELATIVE)
    # of one shape
    assert power_of_gap(1e-4, diameter=12e-3) == pytest.approx(8 * power_of_gap(5e-5), rel=RELATIVE)


@pytest.mark.implausible
@pytest.mark.parametrize("name", SCREWS)
def test_turns_of_a_ball_are_its_rotation_over_that_of_the_screw(name):
    d_m, d_w, alpha, f = SCREWS[name]
    frame = helix_frame(BallScrew(d_m, 0.01, d_w, 50, alpha, f, f))
    omega = 62.8
    turns = nut_losses.ball_turns(frame.path_radius, frame.curvature_ratio, d_w)
    assert turns * omega == pytest.approx(kinematics.ball_rotation(frame.entrainment_speed(omega), d_w), rel=RELATIVE)


# -- balls that enter -----------------------------------------------------------------------------


def test_work_on_a_ball_that_is_spun_up_by_sliding():
    """Both contacts rub with one force until the ball rolls: the screw goes on at twice the speed of its centre."""
    mass, radius, speed, friction = 0.9e-3, 3e-3, 0.6, 2.0
    inertia = 0.4 * mass * radius**2
    time = inertia * speed / radius / (2 * friction * radius)
    work = friction * 2 * speed * time
    assert nut_losses.entry_work(mass, speed, speed, 0.0) == pytest.approx(work, rel=RELATIVE)
    assert work == pytest.approx(2 * inertia * (speed / radius) ** 2 / 2, rel=RELATIVE)


def test_work_on_a_ball_that_is_pushed_up_to_the_speed_of_the_chain():
    """Stopped: an impulse, delivered at the speed of the chain."""
    mass, speed = 0.9e-3, 0.6
    assert nut_losses.entry_work(mass, speed, 0.0, 1.0) == pytest.approx(mass * speed * speed, rel=RELATIVE)
    whole = nut_losses.entry_work(mass, speed, speed, 1.0)
    assert whole == pytest.approx(1.4 * mass * speed**2, rel=RELATIVE)
    assert whole == pytest.approx(2 * (mass / 2 + 0.4 * mass / 2) * speed**2, rel=RELATIVE)


def test_power_of_entries_is_work_by_rate():
    omega, advance, d_w, work = 62.8, 9.4e-3, 6e-3, 3e-4
    rate = advance * omega / d_w
    assert nut_losses.entry_torque(3, work, advance, d_w) * omega == pytest.approx(3 * work * rate, rel=RELATIVE)
