"""Truth: the integrals behind the paper's moments, its friction law, and its constants."""

import math

import numpy as np
import pytest

from ballscrew.physics.equations import friction, geometry, hertz

from .numbers import BALL_DIAMETER, BOUNDARY, CONFORMITY, DECAY, EXPONENT, FULL_FILM

OFFSETS = [0.0, 0.1, 0.2, 0.34, 0.347296, 0.5, 0.64]
ZERO_TRACTION = 2 * math.sin(math.radians(10))

NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


def over_the_ellipse(integrand, a, b, p0, c):
    """Integral of pressure times integrand(y) over the ellipse, cut at the lines of pure rolling y = c, -c."""
    total = 0.0
    for low, high in ((-1.0, -c / a), (-c / a, c / a), (c / a, 1.0)):
        t = (low + high) / 2 + (high - low) / 2 * NODES
        dt = (high - low) / 2 * WEIGHTS
        theta, dtheta = math.pi / 2 * NODES, math.pi / 2 * WEIGHTS
        half_width = np.sqrt(1 - t**2)
        s = half_width[:, None] * np.sin(theta)
        ds = half_width[:, None] * np.cos(theta) * dtheta
        pressure = hertz.hertz_pressure(p0, t[:, None], s)
        total += a * b * np.sum(dt * integrand(a * t) * np.sum(pressure * ds, axis=1))
    return total


def contact(mu=0.0613, Q=101.0, a=5.4e-4, b=5.1e-5):
    return mu, Q, a, b, 3 * Q / (2 * math.pi * a * b), geometry.deformed_radius(BALL_DIAMETER, CONFORMITY)


def test_the_quadrature_carries_the_load():
    _, Q, a, b, p0, _ = contact()
    assert over_the_ellipse(np.ones_like, a, b, p0, 0.3 * a) == pytest.approx(Q, rel=1e-13)


@pytest.mark.equation("Olaru2005 §2.2 (14)", "Olaru2005 §2.2 (15)")
def test_heights_may_be_measured_from_the_lines_of_pure_rolling_without_net_traction():
    # The paper's words for z in (14). The two readings differ by c^2/2 R_d times the net traction.
    mu, Q, a, b, p0, R_d = contact()
    c = ZERO_TRACTION * a

    def moment(y):
        return np.sign(y**2 - c**2) * mu * (y**2 - c**2) / (2 * R_d)

    integral = over_the_ellipse(moment, a, b, p0, c)
    assert friction.curvature_friction_moment(mu, Q, a, R_d, ZERO_TRACTION) == pytest.approx(integral, rel=1e-12)


@pytest.mark.equation("Olaru2005 §2.2 (15)")
def test_constants_of_the_curvature_moment():
    # reference sheet: mpmath, 40 digits
    assert friction.curvature_friction_moment(1.0, 1.0, 1.0, 1.0, 0.34) == pytest.approx(8.171106272e-2, rel=1e-14)
    zero = friction.curvature_friction_moment(1.0, 1.0, 1.0, 1.0, ZERO_TRACTION)
    assert zero == pytest.approx(8.05711988721778677e-2, rel=1e-14)


@pytest.mark.equation("Olaru2005 §2.1 (13)", "Olaru2005 §2.2 (17)")
def test_offset_without_net_traction():
    # reference sheet: mpmath, 40 digits; the paper imposes 0.34
    assert friction.offset_from_traction(0.0) == pytest.approx(0.347296355333860698, rel=1e-15)
    assert friction.offset_from_traction(0.0) == pytest.approx(ZERO_TRACTION, rel=1e-15)
    assert friction.traction_ratio(0.34) == pytest.approx(1.9304e-2, rel=1e-13)


@pytest.mark.parametrize(("traction", "offset"), [(1.0, 0.0), (-1.0, 1.0), (0.019304, 0.34), (-0.375, 0.5)])
def test_offset_from_traction(traction, offset):
    assert friction.offset_from_traction(traction) == pytest.approx(offset, rel=1e-13, abs=1e-16)


@pytest.mark.equation("Olaru2005 §2.2 (17)")
def test_pure_rolling_offset():
    assert friction.pure_rolling_offset(0.34 * 5.4e-4, 5.4e-4) == pytest.approx(0.34, rel=1e-15)
    # "in the positive or negative direction": the two lines
    assert friction.pure_rolling_offset(-0.34 * 5.4e-4, 5.4e-4) == pytest.approx(-0.34, rel=1e-15)


@pytest.mark.equation("Olaru2005 §2.2 (21)")
def test_ball_friction_moment_of_the_paper():
    # reference sheet: mpmath, 40 digits; 1/z newtons between the balls
    M_B = friction.ball_friction_moment(0.1, 1 / 56, 3.175e-3)
    assert pytest.approx(2.83482142857142857e-6, rel=1e-14) == M_B
    assert pytest.approx(0.1 * (1 / 56) * 3.175e-3 / 2, rel=1e-14) == M_B


@pytest.mark.equation("Olaru2005 §5 (23)")
def test_asperity_friction():
    assert friction.asperity_friction_coefficient(0.0, BOUNDARY, DECAY, EXPONENT) == BOUNDARY
    # reference sheet: mpmath, 40 digits: the asperities' share of the load at a film parameter of 0.8
    share = friction.asperity_friction_coefficient(0.8, 1.0, DECAY, EXPONENT)
    assert share == pytest.approx(0.304877100810121948, rel=1e-14)
    for lam in (0.1, 0.8, 3.0):
        printed = 0.2 * math.exp(-1.42 * lam**0.8)
        ours = friction.asperity_friction_coefficient(lam, BOUNDARY, DECAY, EXPONENT)
        assert ours == pytest.approx(printed, rel=1e-14)


def branches(mu_a):
    """(24), (25) and (26) as the paper prints them."""
    if mu_a >= 0.2:
        return 0.2
    if mu_a >= 0.02:
        return mu_a
    return 0.02


@pytest.mark.parametrize("mu_a", [0.0, 0.01, 0.02, 0.020001, 0.1, 0.199999, 0.2, 0.3])
@pytest.mark.equation("Olaru2005 §5 (24)", "Olaru2005 §5 (25)", "Olaru2005 §5 (26)")
def test_the_clamp_is_the_three_branches(mu_a):
    assert friction.clamped_friction_coefficient(mu_a, BOUNDARY, FULL_FILM) == branches(mu_a)


@pytest.mark.equation("Olaru2005 §5 (24)")
def test_the_first_branch_is_continuous_at_rest():
    mu_a = friction.asperity_friction_coefficient(1e-12, BOUNDARY, DECAY, EXPONENT)
    assert friction.clamped_friction_coefficient(mu_a, BOUNDARY, FULL_FILM) == pytest.approx(BOUNDARY, rel=1e-8)
