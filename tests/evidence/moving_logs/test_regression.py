"""Errors of least squares whose residuals follow each other: identities, and intervals that hold."""

import numpy as np
import pytest
from scipy import signal

from ballscrew.evidence.moving_logs.equation import LeastSquares, block_length, bootstrap_sums


def coloured(rows, pole, seed):
    random = np.random.default_rng(seed)
    return signal.lfilter([np.sqrt(1 - pole**2)], [1, -pole], random.standard_normal(rows + 200))[200:]


def test_the_covariance_is_that_of_newey_and_west():
    random = np.random.default_rng(3)
    columns = np.column_stack([np.ones(300), random.standard_normal(300)])
    solved = LeastSquares.of(columns, columns @ [1.0, 2.0] + coloured(300, 0.8, 4))
    scores = solved.residuals[:, np.newaxis] * columns
    spread = scores.T @ scores
    for lag in range(1, solved.block):
        crossed = scores[lag:].T @ scores[:-lag]
        spread = spread + (1 - lag / solved.block) * (crossed + crossed.T)
    inverse = np.linalg.inv(columns.T @ columns)
    freedom = solved.blocks / (solved.blocks - 2)
    np.testing.assert_allclose(solved.covariance, freedom * inverse @ spread @ inverse, rtol=1e-10)


def test_independent_residuals_have_short_blocks_and_ordinary_errors():
    random = np.random.default_rng(0)
    columns = np.column_stack([np.ones(4000), random.standard_normal(4000)])
    solved = LeastSquares.of(columns, columns @ [1.0, 2.0] + random.standard_normal(4000))
    assert solved.block <= 4
    # 1/√n, known to 1/√(2·4000/block)
    np.testing.assert_allclose(solved.errors, 1 / np.sqrt(4000), rtol=0.1)


def test_the_error_of_a_mean_is_that_of_the_process():
    pole = 0.95
    # variance of a mean of a first-order process: (1 + ρ)/(1 − ρ)/n; lower by some tenths for Bartlett's weights
    expected = np.sqrt((1 + pole) / (1 - pole) / 8000)
    found = [LeastSquares.of(np.ones((8000, 1)), coloured(8000, pole, seed)).errors[0] for seed in range(20)]
    assert 0.75 * expected < np.mean(found) < 1.25 * expected


def test_a_resampled_log_has_as_many_rows():
    sums = bootstrap_sums(np.ones((1000, 2)), 50, replicates=5)
    assert sums.shape == (5, 2)
    np.testing.assert_array_equal(sums, 1000.0)


@pytest.mark.parametrize("residuals", [np.zeros(500), np.ones(500)])
def test_residuals_without_noise_make_one_row_a_block(residuals):
    assert block_length(residuals) == 1
