"""The ends of arrays: those of NumPy, whatever the size and the shape."""

import numpy as np
import pytest

from ballscrew.evaluation.ends import BLOCK, ends


@pytest.mark.parametrize("shape", [(), (1,), (1000,), (3 * BLOCK + 7,), (3, BLOCK + 1)])
@pytest.mark.parametrize("odd", [None, np.nan, np.inf, -np.inf])
def test_ends_are_those_of_numpy(shape, odd):
    values = np.random.default_rng(5).normal(size=shape)
    if odd is not None:
        values[(-1,) * values.ndim] = odd
    for array in (values, values.T, values[..., ::2] if shape else values):
        assert np.array_equal(ends(array), [np.min(array), np.max(array)], equal_nan=True)
