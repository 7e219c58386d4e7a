"""Truth: geometry and Hertz' law at 40 digits, and the contact angle that the literature has for one screw."""

import math

import mpmath
import numpy as np
import pytest
from scipy.optimize import brentq

from ballscrew.physics.equations import hertz, rigidity

#: A few operations on doubles.
RELATIVE = 2e-15
#: Centre distance of grooves of 0.515 about balls of 3.175 mm, from hardly a displacement to one as large.
CENTRES = 9.525e-5
DISPLACEMENTS = (-2e-5, -1e-9, 1e-13, 1e-10, 1e-7, 3e-6, 2e-5, 9.5e-5)


def approach(angle, displacement, excess=0.0):
    s = rigidity.loaded_centre_distance(CENTRES, angle, displacement)
    return rigidity.ball_approach(CENTRES, angle, displacement, s, excess)


@pytest.mark.parametrize("degrees", [20, 45, 70])
@pytest.mark.parametrize("displacement", DISPLACEMENTS)
def test_approach_is_the_change_of_the_distance(degrees, displacement):
    """s − A loses all digits of a small approach; the formula used loses none."""
    angle = math.radians(degrees)
    with mpmath.workdps(40):
        A, alpha, xi = map(mpmath.mpf, (CENTRES, angle, displacement))
        s = mpmath.sqrt((A * mpmath.cos(alpha)) ** 2 + (A * mpmath.sin(alpha) + xi) ** 2)
        assert abs(approach(angle, displacement) / (s - A) - 1) <= RELATIVE
        sine = rigidity.loaded_contact_sine(CENTRES, angle, displacement, float(s))
        assert abs(sine / ((A * mpmath.sin(alpha) + xi) / s) - 1) <= RELATIVE


def test_the_excess_of_a_ball_adds_to_its_approach():
    assert approach(0.8, 1e-6, 3e-7) - approach(0.8, 1e-6) == pytest.approx(3e-7, rel=1e-12)
    assert approach(0.8, 0.0, -3e-7) == -3e-7


def test_a_small_displacement_approaches_by_its_share_along_the_normal():
    assert approach(0.8, 1e-12) == pytest.approx(1e-12 * math.sin(0.8), rel=1e-7)


def test_centres_of_grooves_as_wide_as_the_ball_coincide():
    assert rigidity.groove_centre_distance(0.5, 0.5, 3e-3) == 0
    assert rigidity.groove_centre_distance(0.52, 0.54, 3e-3) == pytest.approx(0.06 * 3e-3, rel=1e-14)


# -- Hertz' law ------------------------------------------------------------------------------------


@pytest.mark.parametrize("load", [1e-3, 10.0, 1e4])
@pytest.mark.parametrize("coefficient", [1.2, 2.7])
def test_load_is_the_inverse_of_the_mutual_approach(load, coefficient):
    E, R_x = 2.26e11, 1.6e-3
    delta = hertz.mutual_approach(coefficient, R_x, load / (E * R_x**2))
    K = rigidity.contact_load_deflection(coefficient, E, R_x)
    assert rigidity.hertz_load(K, delta) == pytest.approx(load, rel=1e-14)


def test_two_contacts_in_series_carry_one_load_and_approach_by_the_sum():
    K_s, K_n, load = 3e9, 7e10, 250.0
    both = (load / K_s) ** (2 / 3) + (load / K_n) ** (2 / 3)
    assert rigidity.hertz_load(rigidity.series_load_deflection(K_s, K_n), both) == pytest.approx(load, rel=1e-14)
    assert rigidity.series_load_deflection(K_s, K_s) == pytest.approx(K_s / 2**1.5, rel=1e-14)
    assert rigidity.series_load_deflection(K_s, 1e30) == pytest.approx(K_s, rel=1e-12)


# -- the screw of the paper ------------------------------------------------------------------------


def test_contact_angle_of_the_papers_screw_under_load():
    """45° become 48.3° at 4 kN: rigid bodies, 56 balls of 3.175 mm, conformity 0.515, E' 2.26e11 Pa.

    From the Hertz approach of both contacts by itself, with the balance of the balls as one equation.
    """
    d_w, d_m, z, alpha, phi = 3.175e-3, 0.040, 56, math.pi / 4, math.atan(0.005 / (math.pi * 0.040))
    A = rigidity.groove_centre_distance(0.515, 0.515, d_w)
    gamma = d_w * math.cos(alpha) * math.cos(phi) ** 2 / d_m
    R_y = 0.515 * d_w / (2 * 0.515 - 1)

    def load_deflection(R_x):
        k = R_y / R_x
        kappa = hertz.ellipticity(k)
        integrals = hertz.elliptic_integrals(kappa)
        coefficient = hertz.approach_coefficient(k, kappa, integrals.K, integrals.E)
        return rigidity.contact_load_deflection(coefficient, 2.26e11, R_x)

    K = rigidity.series_load_deflection(*(load_deflection(d_w / 2 * (1 + side * gamma)) for side in (-1, 1)))

    def left(xi):
        s = rigidity.loaded_centre_distance(A, alpha, xi)
        Q = rigidity.hertz_load(K, rigidity.ball_approach(A, alpha, xi, s, 0.0))
        return z * Q * rigidity.loaded_contact_sine(A, alpha, xi, s) * math.cos(phi) - 4000.0

    xi = brentq(left, 0.0, 1e-4, xtol=1e-16)
    sine = rigidity.loaded_contact_sine(A, alpha, xi, rigidity.loaded_centre_distance(A, alpha, xi))
    assert np.degrees(np.arcsin(sine)) == pytest.approx(48.3, abs=0.05)
