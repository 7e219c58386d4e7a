"""Derivatives of recordings: rules against SymPy, and what happens at bends and limits."""

import mpmath
import numpy as np
import pytest

from ballscrew.compiler.tracing.gradient import UnknownDerivativeError, partials
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from support.small_kernels import played


def slopes(function, *arrays):
    """The derivatives of a function by each of its inputs."""
    tape = Tape(len(arrays))
    with np.errstate(all="ignore"):
        value = function(*(tape.value(i) for i in range(len(arrays))))
        found = partials(tape, value, list(range(len(arrays))))
    return [played(Program.of(tape, {"out": one}), *arrays) for one in found]


X = np.array([0.3, 0.7, 0.9, 0.1])
Y = np.array([1.3, 0.2, 2.5, 0.8])

FUNCTIONS = {
    "sum": (lambda x, y: 3 * x - y / 2 + 1, lambda x, y: 3 * x - y / 2 + 1),
    "product": (lambda x, y: x * y * (x + y), lambda x, y: x * y * (x + y)),
    "quotient": (lambda x, y: (1 + x) / (x + y), lambda x, y: (1 + x) / (x + y)),
    "broken powers": (lambda x, y: x**0.66 * y**-0.073 + 1, lambda x, y: x**0.66 * y**-0.073 + 1),
    "whole powers of differences": (lambda x, y: (x - y) ** 3, lambda x, y: (x - y) ** 3),
    "high powers": (lambda x, y: (x - y) ** 11, lambda x, y: (x - y) ** 11),
    "variable exponent": (lambda x, y: x**y, lambda x, y: x**y),
    "constant base": (lambda x, y: 2.0**x + y, lambda x, y: 2.0**x + y),
    "exp": (lambda x, y: np.exp(-x * y), lambda x, y: mpmath.exp(-x * y)),
    "log": (lambda x, y: np.log(x + y), lambda x, y: mpmath.log(x + y)),
    "roots": (lambda x, y: np.sqrt(x * x + y), lambda x, y: mpmath.sqrt(x * x + y)),
    "sines": (lambda x, y: np.sin(x) * np.cos(y), lambda x, y: mpmath.sin(x) * mpmath.cos(y)),
    "tan": (lambda x, y: np.tan(x * y), lambda x, y: mpmath.tan(x * y)),
    "arcsin": (lambda x, y: np.arcsin(x) + np.arccos(y / 3), lambda x, y: mpmath.asin(x) + mpmath.acos(y / 3)),
    "arctan": (lambda x, y: np.arctan(x / y), lambda x, y: mpmath.atan(x / y)),
    "arcsinh": (lambda x, y: np.arcsinh(x - y), lambda x, y: mpmath.asinh(x - y)),
    "expm1": (lambda x, y: np.expm1(x) * y, lambda x, y: mpmath.expm1(x) * y),
    "log1p": (lambda x, y: np.log1p(x) * y, lambda x, y: mpmath.log1p(x) * y),
    "absolute": (lambda x, y: np.abs(x - y) * x, lambda x, y: abs(x - y) * x),
    "extremes": (
        lambda x, y: np.maximum(x * 2, y) * np.minimum(x, 0.5),
        lambda x, y: max(x * 2, y) * min(x, mpmath.mpf(0.5)),
    ),
    "where": (
        lambda x, y: np.where(x > y, x**2, y * x) + np.where(x > 0.5, 0.0, x * y**0.5),
        lambda x, y: (x**2 if x > y else y * x) + (0 if x > 0.5 else x * mpmath.sqrt(y)),
    ),
    "nested": (
        lambda x, y: np.exp(-1.42 * (x**0.66 * y**0.4) ** 0.8) / (1 + x),
        lambda x, y: mpmath.exp(-1.42 * (x**0.66 * y**0.4) ** 0.8) / (1 + x),
    ),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_slopes(name):
    """Against numerical differentiation with fifty digits."""
    recorded, exact = FUNCTIONS[name]
    found = slopes(recorded, X, Y)
    with mpmath.workdps(50):
        for k, point in enumerate(zip(X.tolist(), Y.tolist(), strict=True)):
            at = tuple(map(mpmath.mpf, point))
            for i, order in enumerate(((1, 0), (0, 1))):
                truth = float(mpmath.diff(exact, at, order))
                assert found[i][k] == pytest.approx(truth, rel=1e-12, abs=1e-14), (name, point, order)


def test_an_output_that_depends_on_nothing():
    tape = Tape(2)
    assert partials(tape, 3.0, [0, 1]) == [0.0, 0.0]
    by_x, by_y = slopes(lambda x, y: np.exp(x), X, Y)
    assert np.all(by_x == np.exp(X))
    assert np.all(by_y == 0)


def test_a_branch_not_taken_counts_nothing_however_steep():
    zero = np.zeros(3)
    (slope,) = slopes(lambda x: np.where(x > 0, np.sqrt(x), 2 * x), zero)
    assert np.all(slope == 2)
    (slope,) = slopes(lambda x: np.where(x > 0, np.log(np.where(x > 0, x, 1.0)), 0.0) + x, zero)
    assert np.all(slope == 1)
    (slope,) = slopes(lambda x: np.maximum(x**0.5, 0.1), zero)
    assert np.all(slope == 0)


def test_no_slope_where_there_is_no_value():
    (slope,) = slopes(lambda x: np.where(x > 0, x, np.nan), np.array([-1.0, 1.0, np.nan]))
    assert np.array_equal(slope, [np.nan, 1.0, np.nan], equal_nan=True)


def test_the_slope_of_a_root_at_zero_is_infinite():
    (slope,) = slopes(lambda x: np.sqrt(x), np.array([0.0]))
    assert np.isinf(slope[0])


def test_a_branch_does_not_hide_the_slope_beside_it():
    """The slope of a sum is the sum of the slopes: also where a root is in a branch, and beside it times nothing."""
    x, y = np.array([0.0, 0.0, 4.0]), np.array([0.0, 1.0, 0.0])

    def branch(x, y):
        return np.where(x > 0, np.sqrt(x), 0.0)

    def beside(x, y):
        return y * np.sqrt(x)

    (of_branch, _), (of_other, _) = slopes(branch, x, y), slopes(beside, x, y)
    assert np.array_equal(of_branch, [0.0, 0.0, 0.25])
    assert np.array_equal(of_other, [np.nan, np.inf, 0.0], equal_nan=True)  # nothing times infinity is not known
    for both in (lambda x, y: branch(x, y) + beside(x, y), lambda x, y: beside(x, y) + branch(x, y)):
        assert np.array_equal(slopes(both, x, y)[0], of_branch + of_other, equal_nan=True)


def test_unknown_operation():
    tape = Tape(1)
    with pytest.raises(UnknownDerivativeError, match="sinh"):
        partials(tape, np.sinh(tape.value(0)), [0])


def test_truth_has_no_slope():
    """What a mask decides is not differentiated: only what it chooses."""
    (slope,) = slopes(lambda x: 1.0 * (x > 0.5) + x, X)
    assert np.all(slope == 1)
