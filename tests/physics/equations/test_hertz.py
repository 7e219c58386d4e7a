"""Truth: the paper's fits as printed, and Hertz contacts with known answers."""

import math

import pytest

from ballscrew.physics.equations import hertz
from support.equations import first_integral_brewe_hamrock

from .numbers import CONTACT_LOAD, EQUIVALENT_MODULUS, RADII_RATIO, ROLLING_RADIUS

RELATIVE = 1e-12


def exact_coefficients(k):
    kappa = hertz.ellipticity(k)
    K, E, *_ = hertz.elliptic_integrals(kappa)
    major = hertz.semi_major_axis_coefficient(k, kappa, E)
    return major, major / kappa, hertz.approach_coefficient(k, kappa, K, E)


@pytest.mark.equation("Olaru2005 §2.2 (18)", "Olaru2005 §2.2 (19)")
@pytest.mark.parametrize(
    ("coefficient", "factor", "exponent", "value"),
    # reference sheet: mpmath, 40 digits
    [
        (hertz.semi_major_axis_coefficient_houpert, 1.1552, 0.4676, 5.42571487704369921e-4),
        (hertz.semi_minor_axis_coefficient_houpert, 1.1502, -0.1876, 5.12785261390040394e-5),
    ],
)
def test_semi_axes_as_printed(coefficient, factor, exponent, value):
    W = CONTACT_LOAD / (EQUIVALENT_MODULUS * ROLLING_RADIUS**2)
    found = hertz.semi_axis(coefficient(RADII_RATIO), ROLLING_RADIUS, W)
    assert found == pytest.approx(factor * ROLLING_RADIUS * RADII_RATIO**exponent * W ** (1 / 3), rel=RELATIVE)
    assert found == pytest.approx(value, rel=RELATIVE)


def test_equivalent_modulus_of_steel():
    # reference sheet: mpmath, 40 digits
    assert hertz.equivalent_modulus(2.06e11, 0.3, 2.06e11, 0.3) == pytest.approx(2.26373626373626374e11, rel=RELATIVE)


def test_equivalent_modulus_against_a_rigid_body():
    assert hertz.equivalent_modulus(2.06e11, 0.3, 1e30, 0.3) == pytest.approx(2 * 2.06e11 / 0.91, rel=RELATIVE)


def test_sphere_on_plane():
    # Johnson1985 §4.2: a^3 = 3QR/4E*, delta = a^2/R, p0 = 3Q/2 pi a^2, with E* half the equivalent modulus
    Q, R, E = 100.0, 1.5e-3, 2.26e11
    W = Q / (E * R**2)
    major, minor, approach = exact_coefficients(1.0)
    a = (3 * Q * R / (2 * E)) ** (1 / 3)
    assert hertz.semi_axis(major, R, W) == pytest.approx(a, rel=RELATIVE)
    assert hertz.semi_axis(minor, R, W) == pytest.approx(a, rel=RELATIVE)
    assert hertz.mutual_approach(approach, R, W) == pytest.approx(a**2 / R, rel=RELATIVE)
    assert hertz.maximum_pressure(major, minor, E, W) == pytest.approx(3 * Q / (2 * math.pi * a**2), rel=RELATIVE)


@pytest.mark.parametrize(
    ("k", "kappa", "a", "b", "p0", "delta"),
    # reference sheet: mpmath, 40 digits; Q = 100 N, R_x = 1.5 mm, E' = 2.26e11 Pa
    [
        (1.5, 1.31010296211275037, 1.22003453806014876e-4, 9.31250881299167597e-5, 4.20245008993404545e9, 6.1985035e-6),
        (5.0, 2.89018103983640734, 2.14630210168407118e-4, 7.42618566830255258e-5, 2.99560627976911185e9, 4.9093496e-6),
        (20.0, 6.92868096435724239, 3.90767215117736949e-4, 5.63985002524917835e-5, 2.16648512315957025e9, 3.605247e-6),
        (60.0, 13.4556758546599842, 6.10840916776249660e-4, 4.53965243644526837e-5, 1.72183155363534226e9, 2.759874e-6),
    ],
)
def test_exact_ellipses(k, kappa, a, b, p0, delta):
    Q, R, E = 100.0, 1.5e-3, 2.26e11
    W = Q / (E * R**2)
    major, minor, approach = exact_coefficients(k)
    assert hertz.ellipticity(k) == pytest.approx(kappa, rel=RELATIVE)
    assert hertz.semi_axis(major, R, W) == pytest.approx(a, rel=RELATIVE)
    assert hertz.semi_axis(minor, R, W) == pytest.approx(b, rel=RELATIVE)
    assert hertz.maximum_pressure(major, minor, E, W) == pytest.approx(p0, rel=RELATIVE)
    assert hertz.mutual_approach(approach, R, W) == pytest.approx(delta, rel=2e-7)


def test_hertz_pressure_is_an_ellipsoid():
    assert hertz.hertz_pressure(2e9, 0.0, 0.0) == 2e9
    assert hertz.hertz_pressure(2e9, 0.6, 0.0) == pytest.approx(1.6e9, rel=RELATIVE)
    assert hertz.hertz_pressure(2e9, 0.0, 1.0) == 0.0
    assert hertz.hertz_pressure(2e9, 0.48, 0.64) == pytest.approx(1.2e9, rel=RELATIVE)


def brewe_hamrock(k):
    kappa, E = hertz.ellipticity_brewe_hamrock(k), hertz.second_integral_brewe_hamrock(k)
    major = hertz.semi_major_axis_coefficient(k, kappa, E)
    return major, major / kappa, hertz.approach_coefficient(k, kappa, first_integral_brewe_hamrock(k), E)


def test_brewe_and_hamrock_are_exact_for_a_circle():
    assert hertz.ellipticity_brewe_hamrock(1.0) == 1.0
    assert first_integral_brewe_hamrock(1.0) == pytest.approx(math.pi / 2, rel=RELATIVE)
    assert hertz.second_integral_brewe_hamrock(1.0) == pytest.approx(math.pi / 2, rel=RELATIVE)
    assert brewe_hamrock(1.0) == pytest.approx(exact_coefficients(1.0), rel=RELATIVE)


@pytest.mark.parametrize(
    ("k", "major", "minor", "approach"),
    # measured against the exact solution; BreweHamrock1977 state 3 % for the ellipticity and the integrals
    [(2.0, 0.017, 0.004, 0.024), (5.0, 0.027, 0.011, 0.026), (10.0, 0.027, 0.012, 0.017), (36.0, 0.013, 0.005, 0.012)],
)
def test_brewe_and_hamrock_are_close_to_the_exact_solution(k, major, minor, approach):
    found, exact = brewe_hamrock(k), exact_coefficients(k)
    for value, reference, within in zip(found, exact, (major, minor, approach), strict=True):
        assert value == pytest.approx(reference, rel=within)
        assert value != pytest.approx(reference, rel=1e-3)


@pytest.mark.parametrize("k", [1.0, 5.0, 36.0])
def test_contact_stiffness_is_the_slope_of_the_load(k):
    R, E, Q = 1.5e-3, 2.26e11, 100.0
    *_, c_d = exact_coefficients(k)

    def approach(load):
        return hertz.mutual_approach(c_d, R, load / (E * R**2))

    step = 1e-3
    slope = 2 * step / (approach(Q + step) - approach(Q - step))
    W = Q / (E * R**2)
    assert hertz.contact_stiffness(c_d, E, R, W) == pytest.approx(slope, rel=1e-7)
    assert hertz.contact_stiffness(c_d, E, R, W) == pytest.approx(3 * Q / (2 * approach(Q)), rel=RELATIVE)
    assert hertz.contact_stiffness(c_d, E, R, 0.0) == 0.0


def test_mean_pressure_is_load_over_area():
    Q, R, E = 100.0, 1.5e-3, 2.26e11
    W = Q / (E * R**2)
    major, minor, _ = exact_coefficients(5.0)
    area = math.pi * hertz.semi_axis(major, R, W) * hertz.semi_axis(minor, R, W)
    p_m = hertz.mean_pressure(hertz.maximum_pressure(major, minor, E, W))
    assert p_m == pytest.approx(Q / area, rel=RELATIVE)
