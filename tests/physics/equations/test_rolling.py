"""Truth: the paper's printed forms, its source's check value, and the geometry of the pressure force."""

import math

import pytest

from ballscrew.physics.equations import rheology, rolling

from .numbers import BALL_DIAMETER, CONTACT_LOAD, EQUIVALENT_MODULUS, RADII_RATIO, ROLLING_RADIUS, SCREWS

every_screw = pytest.mark.parametrize(("d_m", "d_w", "alpha", "f"), SCREWS.values(), ids=SCREWS)


@pytest.mark.equation("Olaru2005 §2.1 (1)")
def test_rolling_force_of_the_paper():
    # reference sheet: mpmath, 40 digits
    U, W = 1.84958236788959844e-10, 1.99078134111473684e-4
    F_R = rolling.hydrodynamic_rolling_force(EQUIVALENT_MODULUS, ROLLING_RADIUS, RADII_RATIO, 4972.0, U, W)
    assert pytest.approx(4.19780240988863249e-2, rel=1e-12) == F_R
    powers = 0.348 * math.log(RADII_RATIO) + 0.022 * math.log(4972) + 0.66 * math.log(U) + 0.47 * math.log(W)
    assert pytest.approx(2.86 * EQUIVALENT_MODULUS * ROLLING_RADIUS**2 * math.exp(powers), rel=1e-12) == F_R


@pytest.mark.equation("Olaru2005 §2.1 (1)")
def test_rolling_moment_of_a_published_contact():
    # Check values of the reference sheet: D 4.365, R 40.635, r 2.3571 mm, W 136 N, u 22.361 m/s,
    # eta 0.043691 Pa s, alpha 0.2/9.8067e6 1/Pa; (1) times R_x is 0.502 N mm. E' is not given: steel on steel.
    ball, ring, groove = 4.365e-3 / 2, 40.635e-3, 2.3571e-3
    E, R_x, R_y = EQUIVALENT_MODULUS, 1 / (1 / ball + 1 / ring), 1 / (1 / ball - 1 / groove)
    G = rheology.material_parameter(E, 0.2 / 9.8067e6)
    U = rheology.speed_parameter(0.043691, 22.361, E, R_x)
    W = rheology.load_parameter(136.0, E, R_x)
    moment = rolling.hydrodynamic_rolling_force(E, R_x, R_y / R_x, G, U, W) * R_x
    assert moment == pytest.approx(0.502e-3, rel=2e-3)


@every_screw
@pytest.mark.equation("Olaru2005 §2.1 (10)", "Olaru2005 §2.1 (11)", "Olaru2005 §2.1 (12)")
def test_pressure_forces_of_the_two_rings(d_m, d_w, alpha, f):
    # In the rolling plane the ring centres lie d_m/(2 cos alpha) from the ball's. The screw is convex; the
    # nut is concave, so there the ball's radius counts negative against the ring's.
    to_centre, ball = d_m / (2 * math.cos(alpha)), d_w / 2
    gamma = d_w * math.cos(alpha) / d_m
    at_screw = rolling.pressure_force(0.04, to_centre - ball, ball)
    at_nut = rolling.pressure_force(0.04, to_centre + ball, -ball)
    assert rolling.screw_pressure_force(0.04, gamma) == pytest.approx(at_screw, rel=1e-13)
    assert rolling.nut_pressure_force(0.04, gamma) == pytest.approx(at_nut, rel=1e-13)


@every_screw
@pytest.mark.equation("Olaru2005 §2.1 (10)")
def test_pressure_force_as_printed(d_m, d_w, alpha, f):
    assert rolling.pressure_force(0.04, d_m / 2, d_w / 2) == pytest.approx(2 * 0.04 * d_m / (d_m + d_w), rel=1e-13)
    # Against a plane the pressure pushes with twice the rolling force, whatever the ball.
    assert rolling.pressure_force(0.04, 1e9, d_w / 2) == pytest.approx(0.08, rel=1e-9)


@every_screw
@pytest.mark.equation("Olaru2005 §2.1 (11)")
def test_nut_pressure_force_as_printed(d_m, d_w, alpha, f):
    printed = 2 * 0.04 * (1 + d_w * math.cos(alpha) / d_m)
    assert rolling.nut_pressure_force(0.04, d_w * math.cos(alpha) / d_m) == pytest.approx(printed, rel=1e-13)


@every_screw
@pytest.mark.equation("Olaru2005 §2.1 (12)")
def test_screw_pressure_force_as_printed(d_m, d_w, alpha, f):
    printed = 2 * 0.04 * (1 - d_w * math.cos(alpha) / d_m)
    assert rolling.screw_pressure_force(0.04, d_w * math.cos(alpha) / d_m) == pytest.approx(printed, rel=1e-13)


@pytest.mark.equation("Olaru2005 §2.2 (20)")
def test_elastic_resistance_moment_of_the_paper():
    # reference sheet: mpmath, 40 digits
    M_ER = rolling.elastic_resistance_moment(BALL_DIAMETER, CONTACT_LOAD, RADII_RATIO)
    assert pytest.approx(3.8727882312177574582741807712e-5, rel=1e-12) == M_ER
    # A sphere on a plane, where the bracket is one.
    sphere = math.exp(math.log(7.48e-7) + 0.33 * math.log(BALL_DIAMETER / 2) + 1.33 * math.log(CONTACT_LOAD))
    assert rolling.elastic_resistance_moment(BALL_DIAMETER, CONTACT_LOAD, 1.0) == pytest.approx(sphere, rel=1e-12)


def test_elastic_regime_parameter():
    # BibouletHoupert2010: M = 0.5549 k^-0.6029 W U^-3/4, at a load where it is half-way, M = 6.6
    k, U = 36.0, 1.85e-10
    W = 6.6 / 0.5549 * k**0.6029 * U**0.75
    assert rolling.elastic_regime_parameter(k, W, U) == pytest.approx(6.6, rel=1e-12)
