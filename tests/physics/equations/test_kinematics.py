"""Truth: the paper's printed speed, and rigid bodies that roll without slipping."""

import math

import numpy as np
import pytest

from ballscrew.physics.equations import geometry, kinematics

from .numbers import SCREWS

every_screw = pytest.mark.parametrize(("d_m", "d_w", "alpha", "f"), SCREWS.values(), ids=SCREWS)
RELATIVE = 1e-13


@every_screw
@pytest.mark.equation("Olaru2005 §2.1 (8)", "Olaru2005 §6 (29)", "Olaru2005 §6 (32)")
def test_speeds_of_a_ball_that_rolls_without_slipping(d_m, d_w, alpha, f):
    # Seen from the travelling ball the screw surface moves at (omega - omega_c) R_s, the nut surface at
    # omega_c R_n, and both at omega_b d_w/2: three equations for omega_c, omega_b and the speed.
    omega = 62.8
    R_s, R_n = d_m / 2 - d_w * math.cos(alpha) / 2, d_m / 2 + d_w * math.cos(alpha) / 2
    orbital, rotation, v = np.linalg.solve([[R_s, 0, 1], [R_n, 0, -1], [0, d_w / 2, -1]], [omega * R_s, 0, 0])
    gamma = geometry.curvature_ratio(d_w, d_m, alpha, 0.0)
    L = geometry.path_radius(d_m, 0.0)
    assert kinematics.entrainment_speed(omega, L, gamma) == pytest.approx(v, rel=1e-12)
    assert kinematics.ball_rotation(v, d_w) == pytest.approx(rotation, rel=1e-12)
    omega_c = kinematics.orbital_rotation(v, geometry.nut_contact_radius(L, gamma))
    assert omega_c == pytest.approx(orbital, rel=1e-12)
    omega_s = kinematics.screw_relative_rotation(v, geometry.screw_contact_radius(L, gamma))
    assert omega_s == pytest.approx(omega - orbital, rel=1e-12)
    assert kinematics.orbital_speed(omega_c, L) == pytest.approx(orbital * d_m / 2, rel=1e-12)


def test_entrainment_speed_on_the_helix():
    # reference sheet: mpmath, 40 digits
    phi = geometry.lead_angle(0.005, 0.040)
    gamma = geometry.curvature_ratio(3.175e-3, 0.040, math.pi / 4, phi)
    v = kinematics.entrainment_speed(600 * math.pi / 30, geometry.path_radius(0.040, phi), gamma)
    assert v == pytest.approx(6.26841058184168525e-1, rel=RELATIVE)


@every_screw
def test_contact_rotations_add_vectors(d_m, d_w, alpha, f):
    # The ball turns about the direction across its path in the contact plane; screw and nut turn, seen
    # from it, about the screw's axis, which makes the contact angle with that direction.
    ball, screw, nut = 300.0, 30.0, 25.0
    across = np.array([math.cos(alpha), math.sin(alpha)])
    axis = np.array([1.0, 0.0])
    at_screw = (ball * across + screw * axis) @ across
    at_nut = (ball * across - nut * axis) @ across
    c_alpha = geometry.rolling_plane_cosine(alpha, 0.0)
    assert kinematics.screw_contact_rotation(ball, screw, c_alpha) == pytest.approx(at_screw, rel=RELATIVE)
    assert kinematics.nut_contact_rotation(ball, nut, c_alpha) == pytest.approx(at_nut, rel=RELATIVE)


@every_screw
@pytest.mark.equation("Olaru2005 §2.2 (17)")
def test_curvature_sliding_speed_of_a_bent_contact(d_m, d_w, alpha, f):
    # The deformed surface lies y^2/2 R_d nearer to the ball's axis; the ball turns at v/R_x against the race.
    v, a = 0.63, 5e-4
    gamma = geometry.curvature_ratio(d_w, d_m, alpha, 0.0)
    R_x, R_d = geometry.screw_rolling_radius(d_w, gamma), geometry.deformed_radius(d_w, f)
    c = 0.34 * a
    for y in (0.0, 0.1 * a, c, 0.7 * a, a):
        height_above_the_line = c**2 / (2 * R_d) - y**2 / (2 * R_d)
        speed = kinematics.curvature_sliding_speed(v, R_x, R_d, y, c)
        assert speed == pytest.approx(v / R_x * height_above_the_line, rel=1e-12, abs=1e-18)
    assert kinematics.curvature_sliding_speed(v, R_x, R_d, c, c) == 0.0
    assert kinematics.curvature_sliding_speed(v, R_x, R_d, -c, c) == 0.0


@every_screw
def test_ball_surface_speed_of_races_that_creep(d_m, d_w, alpha, f):
    # Two speeds at each race, one of the screw's rotation: omega_s R_s = w + A_s, omega_c R_n = w + A_n,
    # omega_s + omega_c = omega. Three equations for omega_s, omega_c and w.
    omega, A_s, A_n = 62.8, 3e-3, -1e-3
    gamma, L = geometry.curvature_ratio(d_w, d_m, alpha, 0.0), geometry.path_radius(d_m, 0.0)
    R_s, R_n = geometry.screw_contact_radius(L, gamma), geometry.nut_contact_radius(L, gamma)
    omega_s, omega_c, w = np.linalg.solve([[R_s, 0, -1], [0, R_n, -1], [1, 1, 0]], [A_s, A_n, omega])
    v = kinematics.entrainment_speed(omega, L, gamma)
    found = kinematics.ball_surface_speed(v, A_s, A_n, R_s, R_n, L)
    assert found == pytest.approx(w, rel=1e-12)
    assert kinematics.screw_relative_rotation(found + A_s, R_s) == pytest.approx(omega_s, rel=1e-12)
    assert kinematics.orbital_rotation(found + A_n, R_n) == pytest.approx(omega_c, rel=1e-12)
    assert kinematics.ball_surface_speed(v, 0.0, 0.0, R_s, R_n, L) == v


@every_screw
@pytest.mark.parametrize("lead", [0.0, 0.2, 1.0])
def test_the_screw_moves_against_the_nut_by_spin_and_torsion(d_m, d_w, alpha, f, lead):
    # The screw turns about its axis and shifts along it, so that its thread moves through that of the nut.
    # Whatever the ball does, these are the differences that its two contacts have to take as slip.
    omega = 62.8
    phi = geometry.lead_angle(lead * d_m, d_m)
    axis = np.array([0.0, 0.0, 1.0])
    path = np.array([0.0, math.cos(phi), math.sin(phi)])
    binormal = np.array([0.0, -math.sin(phi), math.cos(phi)])
    radial = np.array([1.0, 0.0, 0.0])
    normal = math.cos(alpha) * radial + math.sin(alpha) * binormal
    across = np.cross(path, normal)

    def screw_against_nut(place):
        return np.cross(omega * axis, d_m / 2 * radial + place) + omega * lead * d_m / (2 * math.pi) * axis

    # in the ball's middle they pass along its path
    assert np.linalg.norm(np.cross(screw_against_nut(0 * axis), path)) == pytest.approx(0, abs=1e-12)
    s_alpha = geometry.rolling_plane_sine(alpha, phi)
    assert kinematics.relative_spin(omega, s_alpha) == pytest.approx(omega * axis @ normal, rel=RELATIVE)
    # a ball that turns about its path moves by as much at one contact as it does against it at the other
    D = abs(screw_against_nut(-d_w / 2 * normal) @ across)
    assert kinematics.torsion_speed(omega, d_w, phi) == pytest.approx(D, rel=1e-12, abs=1e-15)
