"""What data tell, on straight lines, where all of it has a closed form."""

import numpy as np
import pytest

from ballscrew.evidence.calibration import robust
from ballscrew.evidence.calibration.identifiability import (
    MAXIMUM_RELATIVE_ERROR,
    Identifiability,
    IdentifiableDirections,
    Uncertainty,
    weighted_derivatives,
)
from ballscrew.evidence.calibration.robust import Noise, Solution, scatter_of
from support.synthetic_logs import autoregressive

NOTHING = np.empty((0, 3))


def columns(rows, seed=0):
    """Three columns of different sizes, correlated."""
    drawn = np.random.default_rng(seed).standard_normal((rows, 3))
    return np.stack([np.ones(rows), drawn[:, 0], 5 * drawn[:, 0] + 3 * drawn[:, 1]], axis=1)


def least_squares(slopes, noise):
    """A fit of a straight line to nothing but noise, as the trust region leaves it without a bend."""
    values = np.linalg.lstsq(slopes, noise, rcond=None)[0]
    residuals = slopes @ values - noise
    return Solution(values, slopes @ values, residuals, slopes, Noise(scatter_of(residuals, noise), 0.0), True)


def by_the_loss(slopes, noise):
    unbounded = np.full(slopes.shape[1], np.inf)
    prior = robust.Prior(lambda x: np.empty(0), lambda x: np.empty((0, x.size)))
    start = np.zeros(slopes.shape[1])
    return robust.solve(lambda v: (slopes @ v, slopes), noise, start, 1 + start, (-unbounded, unbounded), prior)


@pytest.fixture
def no_bend(monkeypatch):
    for name in ("PSEUDO_HUBER_SCALE", "BIWEIGHT_CUTOFF"):
        monkeypatch.setattr(robust, name, 1e6)


def covariance_of(solution, known=None):
    numbers = solution.values.size
    return Uncertainty.of(solution, np.ones(numbers), np.empty((0, numbers)) if known is None else known).covariance


@pytest.mark.usefixtures("no_bend")
def test_without_a_bend_the_covariance_is_that_of_least_squares():
    """s² (XᵀX)⁻¹; with 20 000 rows it is known to about a per cent."""
    slopes = columns(20_000)
    noise = np.random.default_rng(4).normal(0, 0.3, 20_000)
    found = covariance_of(least_squares(slopes, noise))
    classical = 0.3**2 * np.linalg.inv(slopes.T @ slopes)
    error = np.sqrt(np.diagonal(classical))
    np.testing.assert_allclose(found / np.outer(error, error), classical / np.outer(error, error), atol=0.04)


def hc3(slopes, residuals):
    """``(XᵀX)⁻¹ Σ x xᵀ r²/(1 − h)² (XᵀX)⁻¹``, row by row."""
    inverse = np.linalg.inv(slopes.T @ slopes)
    total = np.zeros_like(inverse)
    for row, r in zip(slopes, residuals, strict=True):
        total += np.outer(row, row) * (r / (1 - row @ inverse @ row)) ** 2
    return inverse @ total @ inverse


def even(slopes, residuals):
    """s² (XᵀX)⁻¹."""
    rows, numbers = slopes.shape
    return residuals @ residuals / (rows - numbers) * np.linalg.inv(slopes.T @ slopes)


@pytest.mark.usefixtures("no_bend")
def test_the_variance_of_a_mean_of_few_rows_has_a_closed_form():
    """All rows have the leverage 1/n: Σ r²/(n − 1)², a little more than s²/n, and without the leverage too small."""
    ones = np.ones((12, 1))
    found = []
    for seed in range(2000):
        solution = least_squares(ones, np.random.default_rng(seed).standard_normal(12))
        found.append(covariance_of(solution)[0, 0])
        assert found[-1] == pytest.approx(solution.residuals @ solution.residuals / 11**2, rel=1e-9)
    # each variance is off by √(2/11); their mean by a per cent
    assert np.mean(found) == pytest.approx(1 / 11, rel=0.03)


@pytest.mark.usefixtures("no_bend")
def test_one_number_has_the_larger_of_two_variances():
    """That of HC3, or of equal noise in all rows; either is the larger one in some logs."""
    larger = []
    slopes = columns(15)[:, 1:2]
    for seed in range(50):
        solution = least_squares(slopes, np.random.default_rng(seed).standard_normal(15))
        both = [float(of(slopes, solution.residuals)[0, 0]) for of in (hc3, even)]
        assert covariance_of(solution)[0, 0] == pytest.approx(max(both), rel=1e-8)
        larger.append(both[0] > both[1])
    assert 0 < np.mean(larger) < 1


@pytest.mark.usefixtures("no_bend")
def test_no_combination_of_numbers_is_known_better_than_either_says():
    slopes = columns(18)
    for seed in range(50):
        solution = least_squares(slopes, np.random.default_rng(seed).standard_normal(18))
        found = covariance_of(solution)
        root = np.linalg.inv(np.linalg.cholesky(found))
        shares = [np.linalg.eigvalsh(root @ of(slopes, solution.residuals) @ root.T) for of in (hc3, even)]
        # in each direction the larger of the two, and nothing more
        assert np.max(shares) < 1 + 1e-6
        assert shares[0].max() > 1 - 1e-6 or shares[1].min() > 1 - 1e-6


@pytest.mark.usefixtures("no_bend")
def test_a_row_that_stands_alone_counts_with_its_leverage():
    """One row far out in the column: the line runs through it nearly, and its residual says nothing of its noise."""
    place = np.append(np.random.default_rng(0).uniform(-1, 1, 59), 8.0)
    slopes = np.stack([np.ones(60), place], axis=1)
    hits = {"fit": 0, "plain": 0}
    for seed in range(1000):
        # noise that grows with the column
        noise = np.hypot(0.3, place) * np.random.default_rng(seed).standard_normal(60)
        solution = least_squares(slopes, noise)
        inverse = np.linalg.inv(slopes.T @ slopes)
        plain = inverse @ (slopes.T * solution.residuals**2) @ slopes @ inverse
        for name, variance in {"fit": covariance_of(solution)[1, 1], "plain": plain[1, 1]}.items():
            hits[name] += abs(solution.values[1]) < 2 * np.sqrt(variance)
    assert hits["plain"] < 600
    assert hits["fit"] > hits["plain"] + 150


@pytest.mark.usefixtures("no_bend")
def test_errors_hold_where_the_noise_depends_on_the_place():
    """White (1980): noise that grows with the column makes its slope worse than s² (XᵀX)⁻¹ says."""
    slopes = columns(20_000)[:, 1:2]
    noise = slopes[:, 0] * np.random.default_rng(4).standard_normal(20_000)
    found = covariance_of(least_squares(slopes, noise))[0, 0]
    # of x ~ N(0, 1): E[x⁴]/E[x²]² = 3
    assert found * 20_000 == pytest.approx(3, rel=0.1)


def test_the_biweight_costs_five_per_cent():
    slopes = columns(20_000)
    noise = np.random.default_rng(4).normal(0, 0.3, 20_000)
    solution = by_the_loss(slopes, noise)
    classical = 0.3**2 * np.linalg.inv(slopes.T @ slopes)
    ratio = np.diagonal(covariance_of(solution)) / np.diagonal(classical)
    np.testing.assert_allclose(ratio, 1 / 0.95, atol=0.03)


@pytest.mark.usefixtures("no_bend")
@pytest.mark.parametrize("correlation", [0.5, 0.8])
def test_noise_that_follows_itself_widens_a_mean_as_theory_says(correlation):
    """The variance of a mean of an AR(1) series is σ²/n (1 + φ)/(1 − φ); weights that fall take up to a fifth off."""
    rows, ones = 5000, np.ones((5000, 1))
    noises = [autoregressive(rows, correlation, seed) for seed in range(30)]
    found = np.mean([covariance_of(least_squares(ones, noise))[0, 0] for noise in noises])
    theory = (1 + correlation) / (1 - correlation) / (1 - correlation**2) / rows
    assert 0.8 * theory < found < 1.05 * theory


def test_a_prior_adds_its_information():
    """Without rows that tell anything the error is that of the prior; with both, of both."""
    slopes = columns(2000)
    noise = np.random.default_rng(4).normal(0, 0.3, 2000)
    solution = by_the_loss(slopes, noise)
    alone = covariance_of(solution)[0, 0]
    known = np.array([[1 / 0.004, 0, 0]])
    # the column of ones is next to uncorrelated with the others
    assert covariance_of(solution, known)[0, 0] == pytest.approx(1 / (1 / alone + 1 / 0.004**2), rel=0.05)
    blind = Solution(np.zeros(1), np.ones(50), np.ones(50), np.zeros((50, 1)), Noise(1.0, 0.0), True)
    assert covariance_of(blind, np.array([[1 / 0.1]]))[0, 0] == pytest.approx(0.01)


def test_directions_are_told_down_to_half_the_scale():
    root = np.diag([100.0, 1.01 / MAXIMUM_RELATIVE_ERROR, 0.99 / MAXIMUM_RELATIVE_ERROR, 0.0])
    found = IdentifiableDirections.of(root)
    assert found.identifiable.tolist() == [True, True, False, False]
    assert found.identifiable_parameters.tolist() == [True, True, False, False]
    np.testing.assert_allclose(np.abs(found.unidentifiable_directions), np.eye(4)[:, 2:])
    # what is lost in rounding is not told, whatever the scatter
    assert IdentifiableDirections.of(np.diag([1e12, 1e3])).identifiable.tolist() == [True, False]
    assert not IdentifiableDirections.of(np.zeros((0, 2))).identifiable.any()


def twins():
    """Two numbers of which only the sum counts, one that is told, and a sensor."""
    rows = 5000
    drawn = np.random.default_rng(0).standard_normal((rows, 2))
    slopes = np.stack([drawn[:, 0], drawn[:, 0], drawn[:, 1], np.ones(rows)], axis=1)
    return by_the_loss(slopes, np.random.default_rng(1).normal(0, 0.1, rows))


def test_of_two_that_act_as_one_the_product_is_told():
    found = Identifiability.of(twins(), ("one", "other", "third"), np.ones(4))
    assert found.identified == {"one": False, "other": False, "third": True}
    together, third, apart = found.combinations
    assert together.identified
    assert third.identified
    assert not apart.identified
    assert together.powers == pytest.approx({"one": 0.5**0.5, "other": 0.5**0.5, "third": 0}, abs=0.1)
    assert set(apart.powers) == {"one", "other"}
    assert sorted(apart.powers.values()) == pytest.approx([-(0.5**0.5), 0.5**0.5])
    assert apart.relative_error > 1e6


def test_the_error_of_a_combination_is_that_of_the_data():
    solution = twins()
    found = Identifiability.of(solution, ("one", "other", "third"), np.ones(4))
    root = weighted_derivatives(solution)
    information = root.T @ root
    # taking the sensor out is the complement of Schur
    rest = information[:3, :3] - np.outer(information[:3, 3], information[3, :3]) / information[3, 3]
    np.testing.assert_allclose(found.singular_values**2, np.linalg.eigvalsh(rest)[::-1], atol=1e-9 * rest.max())


def test_what_depends_on_what_is_not_told_has_no_variance():
    solution = twins()
    found = Uncertainty.of(solution, np.ones(4), np.empty((0, 4)))
    total = found.variance_of(np.array([[1.0, 1, 0, 0], [1, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))
    np.testing.assert_array_equal(np.isnan(total), [False, True, True, False, False])
    # the sum of the two has the error of one number in their place
    slopes = solution.slopes[:, 1:]
    alone = by_the_loss(slopes, np.random.default_rng(1).normal(0, 0.1, 5000))
    np.testing.assert_allclose(total[0], covariance_of(alone)[0, 0], rtol=1e-3)
    assert found.variance_of(np.zeros(4)) == 0


def test_scales_change_what_is_told_and_no_error():
    solution = by_the_loss(columns(500), np.random.default_rng(1).normal(0, 0.1, 500))
    one, other = (Uncertainty.of(solution, scale, NOTHING) for scale in (np.ones(3), np.array([10.0, 0.1, 3.0])))
    np.testing.assert_allclose(one.covariance, other.covariance, rtol=1e-7)
    small = Uncertainty.of(solution, np.array([1e-3, 1.0, 1.0]), NOTHING)
    assert np.isnan(small.variance_of(np.array([1.0, 0, 0])))


def test_what_is_not_told_well_still_leaks_into_other_numbers():
    """Two columns that are nearly alike: held fast, the other would be known six times better than it is."""
    drawn = np.random.default_rng(0).standard_normal((500, 2))
    slopes = np.stack([drawn[:, 0], drawn[:, 0] + 0.17 * drawn[:, 1]], axis=1)
    solution = by_the_loss(slopes, np.random.default_rng(1).normal(0, 0.1, 500))
    open_to_much = Uncertainty.of(solution, np.array([0.03, 1.0]), np.empty((0, 2)))
    assert open_to_much.directions.identifiable.tolist() == [True, False]
    classical = 0.1**2 * np.linalg.inv(slopes.T @ slopes)
    np.testing.assert_allclose(np.diagonal(open_to_much.covariance), np.diagonal(classical), rtol=0.25)
    assert classical[1, 1] > 25 * 0.1**2 / (slopes[:, 1] @ slopes[:, 1])


def test_directions_that_are_only_rounding_are_not_measured():
    found = IdentifiableDirections.of(np.diag([100.0, 0.1, 1e-9, 0.0]))
    assert found.identifiable.tolist() == [True, False, False, False]
    np.testing.assert_array_equal(np.abs(found.measured_directions), np.eye(4)[:, :2])
    # a part that rounding leaves in what is not told is no part
    turned = np.array([[100.0, 0, 0], [0, 0.1, 1e-7]])
    assert np.count_nonzero(IdentifiableDirections.of(turned).measured_directions) == 2
