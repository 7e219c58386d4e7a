"""The equations without a single formula, against mpmath with 40 digits.

Largest relative errors where this was written: the integrals 2.3e-15 for ellipticities from 1e-3 to
1e3 and 5.0e-15 from 1e-4 to 1e4, the ellipticity 1.4e-15 for radii ratios from 1e-5 to 1e5. The
tolerances leave room for the last digits of other mathematical libraries.
"""

import ast
import inspect

import mpmath
import numpy as np
import pytest

from ballscrew.physics.equations.hertz import elliptic_integrals, ellipticity

from .discovery import EQUATIONS, RECURRENCES

DIGITS = 40
INTEGRALS_WITHIN = 1e-14
ELLIPTICITY_WITHIN = 5e-15


def test_the_recurrences_are_the_equations_with_a_loop():
    looping = {
        name
        for name, equation in EQUATIONS.items()
        for node in ast.walk(ast.parse(inspect.getsource(equation.function)))
        if isinstance(node, ast.For | ast.While)
    }
    assert looping == set(RECURRENCES)


def integrals(kappa):
    """K, E, B, D and C as they are defined; at an ellipticity of exactly 1 their limits."""
    m = 1 - 1 / mpmath.mpf(kappa) ** 2
    if m == 0:
        return mpmath.pi / 2, mpmath.pi / 2, mpmath.pi / 4, mpmath.pi / 4, mpmath.pi / 16
    K, E = mpmath.ellipk(m), mpmath.ellipe(m)
    D = (K - E) / m
    B = K - D
    return K, E, B, D, (D - B) / m


@pytest.mark.parametrize(
    ("lowest", "highest"), [(1e-4, 1e-2), (1e-2, 1.0), (1.0, 1.0 + 1e-7), (1.0 - 1e-7, 1.0), (1.0, 1e2), (1e2, 1e4)]
)
def test_elliptic_integrals(lowest, highest):
    with mpmath.workdps(DIGITS):
        for kappa in np.geomspace(lowest, highest, 60):
            ours = elliptic_integrals(float(kappa))
            for name, value, exact in zip(ours._fields, ours, integrals(float(kappa)), strict=True):
                assert abs(value / exact - 1) <= INTEGRALS_WITHIN, (name, kappa)


def exact_ellipticity(radii_ratio, start):
    """The root of k = kappa^2 B/D, on the logarithm of kappa."""
    log_k = mpmath.log(mpmath.mpf(radii_ratio))

    def residual(log_kappa):
        kappa = mpmath.exp(log_kappa)
        _, _, B, D, _ = integrals(kappa)
        return mpmath.log(kappa**2 * B / D) - log_k

    guess = mpmath.log(start)
    return mpmath.exp(mpmath.findroot(residual, (guess * (1 - mpmath.mpf("1e-3")), guess * (1 + mpmath.mpf("1e-3")))))


@pytest.mark.slow
@pytest.mark.parametrize(("lowest", "highest"), [(1e-5, 1e-2), (1e-2, 0.97), (1.03, 1e2), (1e2, 1e5)])
def test_ellipticity(lowest, highest):
    with mpmath.workdps(DIGITS):
        for k in np.geomspace(lowest, highest, 30):
            start = mpmath.mpf(float(k)) ** (2 / mpmath.pi)
            exact = exact_ellipticity(float(k), start)
            assert abs(ellipticity(float(k)) / exact - 1) <= ELLIPTICITY_WITHIN, k


def test_ellipticity_of_a_circle_is_exact():
    assert ellipticity(1.0) == 1.0


@pytest.mark.parametrize("offset", [1e-3, 1e-6, 1e-9, 1e-12])
def test_ellipticity_near_the_circle(offset):
    with mpmath.workdps(DIGITS):
        for k in (1 + offset, 1 - offset):
            exact = exact_ellipticity(k, mpmath.mpf(k) ** (2 / mpmath.pi))
            assert abs(ellipticity(k) / exact - 1) <= ELLIPTICITY_WITHIN
