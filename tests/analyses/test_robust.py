"""The loss of the fits against its closed form, and what is said of noise."""

import numpy as np
import pytest
from scipy import integrate

from ballscrew.analyses.robust import BEND, MEDIAN_TO_DEVIATION, Prior, memory, pull, scatter_of, solve

RESIDUALS = np.array([-300.0, -5.0, -1.35, -0.3, 0.0, 1e-6, 0.5, 1.0, 3.0, 40.0, 1e4])
NO_PRIOR = Prior(lambda x: np.empty(0), lambda x: np.empty((0, x.size)))


def rho(r):
    """The pseudo-Huber loss, as books have it."""
    return 2 * BEND**2 * (np.sqrt(1 + (r / BEND) ** 2) - 1)


def test_the_pull_is_half_the_derivative_of_the_loss_and_has_its_own():
    scatter = 0.02
    psi, curvature = pull(scatter * RESIDUALS, scatter)
    step = 1e-5 * np.maximum(1, np.abs(RESIDUALS))
    np.testing.assert_allclose(psi, (rho(RESIDUALS + step) - rho(RESIDUALS - step)) / (4 * step), rtol=1e-6, atol=1e-9)
    beside = [pull(scatter * (RESIDUALS + sign * step), scatter)[0] for sign in (1, -1)]
    np.testing.assert_allclose(curvature, (beside[0] - beside[1]) / (2 * step), rtol=1e-4, atol=1e-9)


def test_near_zero_a_square_far_out_a_line():
    psi, curvature = pull(np.array([1e-4, 1e6, -1e6]), 1.0)
    np.testing.assert_allclose(psi, [1e-4, BEND, -BEND], rtol=1e-7)
    np.testing.assert_allclose(curvature, [1, 0, 0], atol=1e-7)


def test_the_loss_is_as_efficient_as_it_says():
    """Variance of a mean by this loss over that of the plain mean, for normal noise: E[ψ²]/E[ψ']², 1/0.95."""

    def mean_of(function):
        return integrate.quad(lambda r: function(r) * np.exp(-(r**2) / 2) / np.sqrt(2 * np.pi), -12, 12)[0]

    psi, curvature = (lambda r, i=i: float(pull(np.array([r]), 1.0)[i][0]) for i in (0, 1))
    assert mean_of(curvature) ** 2 / mean_of(lambda r: psi(r) ** 2) == pytest.approx(0.95, abs=0.005)


@pytest.mark.parametrize("deviation", [1e-6, 0.02, 300.0])
def test_the_scatter_of_normal_noise_is_its_standard_deviation(deviation):
    noise = np.random.default_rng(1).normal(0, deviation, 200_000)
    # the median of so many is known to 0.26 %
    assert scatter_of(noise, np.ones(1)) == pytest.approx(deviation, rel=0.01)
    noise[:20_000] *= 1000
    # a tenth far out: the median moves from the 50 % to the 55.6 % quantile of the others
    assert scatter_of(noise, np.ones(1)) == pytest.approx(deviation * MEDIAN_TO_DEVIATION * 0.7647, rel=0.01)


def test_the_scatter_is_never_zero():
    assert scatter_of(np.zeros(5), np.array([2.0, -7.0])) == pytest.approx(7e-9)
    assert scatter_of(np.zeros(5), np.zeros(5)) > 0


def autoregressive(rows, correlation, seed=0):
    """A series whose neighbours are alike: x[i] = φ x[i-1] + e[i]."""
    found = np.random.default_rng(seed).standard_normal(rows)
    for i in range(1, rows):
        found[i] += correlation * found[i - 1]
    return found


def test_white_noise_is_forgotten_at_once():
    """The first correlation is above two of its errors in one of 44 series; in those the reach is short."""
    reaches = [memory(np.random.default_rng(seed).standard_normal(2000)) for seed in range(400)]
    assert np.mean(np.array(reaches) == 0) == pytest.approx(0.977, abs=0.025)
    assert max(reaches) <= 6


@pytest.mark.parametrize("correlation", [0.5, 0.9])
def test_noise_that_follows_itself_is_remembered_until_it_is_lost_in_the_noise(correlation):
    """φ^lag falls below 2/√n at lag ln(2/√n)/ln φ."""
    rows = 4000
    lost = np.log(2 / np.sqrt(rows)) / np.log(correlation)
    found = np.median([memory(autoregressive(rows, correlation, seed)) for seed in range(40)])
    assert found == pytest.approx(2 * lost, rel=0.35)


def test_alternating_noise_and_few_rows_have_no_memory():
    assert memory((-1.0) ** np.arange(100)) == 0
    assert memory(np.ones(100)) == 0
    assert memory(autoregressive(19, 0.9)) == 0


def test_a_straight_line_is_found_in_spite_of_outliers_and_is_the_least_of_the_loss():
    random = np.random.default_rng(3)
    x = np.linspace(-1, 1, 400)
    columns = np.stack([np.ones(400), x], axis=1)
    measured = columns @ [1.0, 2.0] + random.normal(0, 0.1, 400)
    measured[::20] += 50
    bounds = np.full(2, -np.inf), np.full(2, np.inf)
    found = solve(lambda v: (columns @ v, columns), measured, np.zeros(2), np.ones(2), bounds, NO_PRIOR)
    assert found.converged
    # twenty rows of 400 pull with all their might: 1.35·0.1·20/(0.67·380)
    np.testing.assert_allclose(found.values, [1.0, 2.0], atol=0.03)
    assert np.count_nonzero(found.outlying) == 20
    psi, _ = pull(found.residuals, found.scatter)
    # but for the last change of the scatter, a thousandth at most
    np.testing.assert_allclose(columns.T @ psi, 0, atol=1e-3 * np.sqrt(psi @ psi))
    plain = np.linalg.lstsq(columns, measured, rcond=None)[0]
    assert abs(plain[0] - 1) > 2


def test_a_prior_is_a_square_whatever_the_rows_say():
    """One number, no rows that count: the prior alone decides, far out as well."""
    prior = Prior(lambda x: (x - 100.0) / 0.5, lambda x: np.eye(1) / 0.5)
    bounds = np.array([-np.inf]), np.array([np.inf])
    nothing = np.zeros((50, 1))
    noise = np.random.default_rng(0).standard_normal(50)
    found = solve(lambda v: (nothing @ v, nothing), noise, np.zeros(1), np.ones(1), bounds, prior)
    assert found.values == pytest.approx([100.0])


def test_bounds_are_kept():
    columns = np.ones((50, 1))
    measured = 3 + 0.1 * np.random.default_rng(0).standard_normal(50)
    bounds = np.array([0.0]), np.array([2.0])
    found = solve(lambda v: (columns @ v, columns), measured, np.array([5.0]), np.ones(1), bounds, NO_PRIOR)
    assert found.values[0] == pytest.approx(2.0, abs=1e-6)
    assert found.values[0] <= 2.0
