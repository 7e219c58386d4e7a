"""Merged logarithms: fewer of them, the same values, and nothing merged that belongs apart."""

import numpy as np
import pytest

from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from support.small_kernels import played

RNG = np.random.default_rng(4)
X, Y, Z = (RNG.uniform(0.1, 5, 50) for _ in range(3))


def both(function, groups=None):
    """The programs of a function of three inputs, merged and as recorded."""
    tape = Tape(3, groups, [True] * 3)
    outputs = {"out": function(*(tape.value(i) for i in range(3)))}
    return merged_program(tape, outputs), Program.of(tape, outputs)


def logarithms(program):
    return sum(step.function is np.log for _, step in program.steps)


#: A function, how many logarithms it is recorded with, and how many are left.
CASES = {
    "always together": (lambda x, y, z: (x * y) ** 0.66 + (x * y) ** 0.47 * z, 2, 1),
    "opposite": (lambda x, y, z: (x / y) ** 0.66 + (x / y) ** 0.47 + z, 2, 1),
    "all divisors": (lambda x, y, z: 1 + (x * y * z) ** -0.3, 3, 1),
    "with different weights": (lambda x, y, z: x**0.66 * y**0.47 + (x * y) ** 0.3 + z, 2, 2),
    "two of three": (lambda x, y, z: (x * y) ** 0.66 * z**0.5 + z**0.25 * (x * y) ** 0.1, 3, 2),
    "one alone": (lambda x, y, z: (x * y) ** 0.66 + x**0.3 + z, 2, 2),
    "a logarithm that is wanted itself": (lambda x, y, z: np.log(x) + (x * y) ** 0.66 + z, 2, 2),
    "under another power": (lambda x, y, z: np.exp(-((1 + (x * y) ** 0.5 * z) ** 0.8)) + (x * y) ** 0.3, 3, None),
    "variable exponent": (lambda x, y, z: (x * y) ** z + (x * y) ** 0.2, 2, 1),
    "a logarithm of a logarithm": (lambda x, y, z: np.log(np.log(x + 2) + 1) + np.log(y) + z, 3, 2),
    "constants": (lambda x, y, z: np.exp(0.3 * np.log(2 * x) + 1.5) + y * z, 1, 1),
    "nothing to merge": (lambda x, y, z: x * y + z, 0, 0),
}


@pytest.mark.parametrize("name", CASES)
def test_fewer_logarithms_and_the_same_values(name):
    function, before, after = CASES[name]
    merged, recorded = both(function)
    assert logarithms(recorded) == before
    assert after is None or logarithms(merged) == after
    assert np.allclose(played(merged, X, Y, Z), played(recorded, X, Y, Z), rtol=1e-14, atol=0)


def test_axes_of_a_grid_are_kept_apart():
    function = CASES["always together"][0]
    merged, _ = both(function, groups=[1, 2, 2])
    assert logarithms(merged) == 2
    merged, _ = both(function, groups=[1, 1, 2])
    assert logarithms(merged) == 1


@pytest.mark.parametrize("zeros", [(0, 1, 1), (1, 0, 1), (0, 0, 1)])
def test_limits_stay(zeros):
    """A factor of zero makes a product of zero, as its logarithm does."""
    merged, recorded = both(CASES["always together"][0])
    at = [np.full(3, float(z)) for z in zeros]
    assert np.array_equal(played(merged, *at), played(recorded, *at))
    assert np.all(played(merged, *at) == 0)
