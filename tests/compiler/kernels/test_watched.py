"""Watched kernels: the results of the kernel that does not watch, and the ends that NumPy finds."""

import numpy as np
import pytest

from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.kernels.kernel import Kernel, WatchedKernel, aligned_array
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape

pytestmark = pytest.mark.compiles

LANES = 8
SOURCES = ["points", "rows", "points"]
MASKS = {"sum": False, "larger": True}


def program():
    tape = Tape(3)
    x, row, y = (tape.value(i) for i in range(3))
    return Program.of(tape, {"sum": np.exp(x * 1e-3) + row * y, "larger": x > y})


@pytest.fixture(scope="module")
def both():
    plain, watched = (kernel_text(program(), SOURCES, MASKS, lanes=LANES, watched=watched) for watched in (False, True))
    return Kernel.of(plain, SOURCES), WatchedKernel(watched, SOURCES, LANES)


def room(count):
    return [aligned_array(count, bool if mask else float) for mask in MASKS.values()]


@pytest.mark.parametrize("count", [1, LANES - 1, LANES, LANES + 1, 5 * LANES, 5 * LANES + 3])
@pytest.mark.parametrize("odd", [None, np.nan, -np.nan, np.inf, -np.inf, -0.0, 0.0, -3.0, 5e-324, 1.7e308])
def test_ends_and_results(both, odd, count):
    kernel, watched = both
    rng = np.random.default_rng(count)
    for place in {0, count // 2, count - 1}:
        x, y, row = rng.uniform(1, 2, count), rng.uniform(1, 2, count), np.array([0.5])
        if odd is not None:
            x[place] = odd
        expected, found = room(count), room(count)
        kernel(slice(0, 1), slice(0, count), count, [x, row, y], expected)
        ends = watched(count, [x, row, y], found)
        for one, other in zip(found, expected, strict=True):
            assert np.array_equal(one, other, equal_nan=True)
        assert ends[1] is None
        for values, held in ((x, ends[0]), (y, ends[2])):
            assert np.array_equal(held, [np.min(values), np.max(values)], equal_nan=True)


def test_none_is_left_out(both):
    """Each place once the least, once the greatest."""
    _, watched = both
    count = 3 * LANES + 2
    for place in range(count):
        for value in (0.25, 7.0):
            x = np.full(count, 1.0)
            x[place] = value
            ends = watched(count, [x, np.ones(1), x], room(count))
            assert np.array_equal(ends[0], [min(1.0, value), max(1.0, value)])
