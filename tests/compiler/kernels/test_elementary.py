"""Elementary functions of kernels against high precision: polynomials, values, and the rules of IEEE 754."""

import mpmath
import numpy as np
import pytest

from ballscrew.compiler.kernels import ir
from support.small_kernels import recorded, run

pytestmark = pytest.mark.compiles
EPSILON = 2.0**-52

ROOT = mpmath.sqrt(mpmath.mpf(1) / 2)
STEEPEST = (1 - ROOT) / (1 + ROOT)
#: Coefficients, what they stand for, and where.
POLYNOMIALS = {
    "exp": (ir.EXP, lambda r: (mpmath.exp(r) - 1 - r) / r**2, -mpmath.log(2) / 2, mpmath.log(2) / 2),
    "log": (ir.LOG, lambda z: 2 * mpmath.atanh(mpmath.sqrt(z)) / mpmath.sqrt(z), 0, STEEPEST**2),
    "arcsin": (ir.ARCSIN, lambda z: (mpmath.asin(mpmath.sqrt(z)) / mpmath.sqrt(z) - 1) / z, 0, 0.25),
    "arctan": (
        ir.ARCTAN,
        lambda z: (mpmath.atan(mpmath.sqrt(z)) / mpmath.sqrt(z) - 1) / z,
        0,
        (mpmath.sqrt(2) - 1) ** 2,
    ),
    "sin": (
        ir.SIN,
        lambda z: (mpmath.sin(mpmath.sqrt(z)) / mpmath.sqrt(z) - 1) / z,
        0,
        (mpmath.pi / 4) ** 2,
    ),
    "cos": (ir.COS, lambda z: (mpmath.cos(mpmath.sqrt(z)) - 1 + z / 2) / z**2, 0, (mpmath.pi / 4) ** 2),
}
#: How much a polynomial's error weighs in the function, relative to it: the power of its variable in front.
WEIGHT = {
    "exp": lambda r: r**2,
    "log": lambda z: 1,
    "arcsin": lambda z: z,
    "arctan": lambda z: z,
    "sin": lambda z: z,
    "cos": lambda z: z**2,
}


@pytest.mark.parametrize("name", POLYNOMIALS)
def test_polynomials_are_the_functions(name):
    """To less than a unit in the last place of the function, over the whole interval."""
    coefficients, function, start, stop = POLYNOMIALS[name]
    with mpmath.workdps(50):
        for share in np.linspace(0.001, 1, 201):
            x = start + (stop - start) * mpmath.mpf(float(share))
            if x == 0:
                continue
            polynomial = mpmath.polyval([mpmath.mpf(c) for c in coefficients[::-1]], x)
            assert abs(polynomial - function(x)) * WEIGHT[name](x) < EPSILON / 2, (name, x)


def logarithmic(low, high):
    return lambda rng, n: 10 ** rng.uniform(low, high, n)


def plain(low, high):
    return lambda rng, n: rng.uniform(low, high, n)


#: Function, what it is, where, and how many units in the last place it may be off.
FUNCTIONS = {
    "exp": (np.exp, mpmath.exp, plain(-700, 700), 2),
    "log": (np.log, mpmath.log, logarithmic(-300, 300), 3),
    "log near one": (np.log, mpmath.log, plain(0.7, 1.4), 4),
    "log1p": (np.log1p, mpmath.log1p, plain(-0.5, 2), 5),
    "expm1": (np.expm1, mpmath.expm1, plain(-2, 2), 6),
    "sin": (np.sin, mpmath.sin, plain(-100, 100), 2),
    "cos": (np.cos, mpmath.cos, plain(-100, 100), 2),
    "tan": (np.tan, mpmath.tan, plain(-100, 100), 4),
    "arcsin": (np.arcsin, mpmath.asin, plain(-1, 1), 3),
    "arccos": (np.arccos, mpmath.acos, plain(-1, 0.9), 4),
    "arctan": (np.arctan, mpmath.atan, plain(-20, 20), 3),
    "arcsinh": (np.arcsinh, mpmath.asinh, plain(-20, 20), 6),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_values(name):
    function, exact, points, units = FUNCTIONS[name]
    x = points(np.random.default_rng(1), 400)
    found = run(recorded(function, 1), x)
    with mpmath.workdps(40):
        for argument, value in zip(x.tolist(), found.tolist(), strict=True):
            truth = exact(mpmath.mpf(argument))
            # sines lose what reducing a large angle loses: the rounding of the angle's last place
            room = units * EPSILON * abs(truth) + (1e-18 if name in ("sin", "cos", "tan") else 0)
            assert abs(mpmath.mpf(value) - truth) <= room, (name, argument)


def test_powers():
    rng = np.random.default_rng(2)
    base, exponent = 10 ** rng.uniform(-12, 12, 400), rng.uniform(-3, 3, 400)
    found = run(recorded(lambda x, y: x**y, 2), base, exponent)
    with mpmath.workdps(40):
        for x, y, value in zip(base.tolist(), exponent.tolist(), found.tolist(), strict=True):
            truth = mpmath.mpf(x) ** mpmath.mpf(y)
            # an error of the logarithm counts as often as the exponent is large
            units = 4 + 2 * abs(y * mpmath.log(x))
            assert abs(mpmath.mpf(value) - truth) <= units * EPSILON * truth, (x, y)


SPECIAL = np.array(
    [0.0, -0.0, 1.0, -1.0, np.inf, -np.inf, np.nan, 1e308, -1e308, 1e-300, -3.5, 2.0, 709.0, -745.0, 1e4]
)


@pytest.mark.parametrize(
    "function",
    [np.exp, np.log, np.sqrt, np.arctan, np.arcsinh, np.log1p, np.expm1, np.arcsin, np.absolute, np.floor, np.ceil],
)
def test_ends_of_the_range(function):
    """Zero, infinity, NaN and numbers out of the domain come out as NumPy has them."""
    found = run(recorded(lambda x: 1.0 * function(x), 1), SPECIAL)
    with np.errstate(all="ignore"):
        expected = function(SPECIAL)
    usual = np.abs(expected) > 1e-307  # what is smaller may be zero
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    assert np.array_equal(np.isinf(found), np.isinf(expected))
    assert np.allclose(
        found[usual & np.isfinite(expected)], expected[usual & np.isfinite(expected)], rtol=1e-15, atol=0
    )
    assert np.all(np.abs(found[~usual & ~np.isnan(expected)]) <= 1e-307)


def test_sines_of_no_number():
    assert np.isnan(run(recorded(np.sin, 1), np.array([np.nan, np.inf, -np.inf]))).all()
