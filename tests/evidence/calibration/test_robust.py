"""MM estimation against its closed forms, and what is said of noise."""

import numpy as np
import pytest
from scipy import integrate

from ballscrew.evidence.calibration.robust import (
    BIWEIGHT_CUTOFF,
    MAD_TO_STANDARD_DEVIATION,
    PSEUDO_HUBER_SCALE,
    Noise,
    Prior,
    Solution,
    autocorrelation_lag,
    biweight,
    loss_of,
    noise_of,
    pseudo_huber,
    scatter_of,
    solve,
)
from support.synthetic_logs import autoregressive

RESIDUALS = np.array([-300.0, -5.0, -4.6, -1.35, -0.3, 0.0, 1e-3, 0.5, 1.0, 3.0, 4.7, 1e4])
NO_PRIOR = Prior(lambda x: np.empty(0), lambda x: np.empty((0, x.size)))


def published_pseudo_huber(r):
    """The first loss, as books have it."""
    return 2 * PSEUDO_HUBER_SCALE**2 * (np.sqrt(1 + (r / PSEUDO_HUBER_SCALE) ** 2) - 1)


def tukey(r):
    """The second, as books have it, twice over: near zero it is r²."""
    return np.where(
        np.abs(r) < BIWEIGHT_CUTOFF,
        BIWEIGHT_CUTOFF**2 / 3 * (1 - (1 - (r / BIWEIGHT_CUTOFF) ** 2) ** 3),
        BIWEIGHT_CUTOFF**2 / 3,
    )


def resting(residuals, noise, torques=None):
    """A solution with these residuals; the model is one number that all rows have."""
    rows = residuals.size
    torques = np.ones(rows) if torques is None else torques
    return Solution(np.zeros(1), torques, residuals, np.ones((rows, 1)), noise, True)


def fitted(columns, measured, prior=NO_PRIOR, start=None, bounds=None):
    """A straight line through what was measured."""
    numbers = columns.shape[1]
    bounds = (np.full(numbers, -np.inf), np.full(numbers, np.inf)) if bounds is None else bounds
    start = np.zeros(numbers) if start is None else start
    return solve(lambda v: (columns @ v, columns), measured, start, np.ones(numbers), bounds, prior)


# -- the losses -----------------------------------------------------------------------------------


@pytest.mark.parametrize(("loss", "closed"), [(pseudo_huber, published_pseudo_huber), (biweight, tukey)])
def test_losses_are_those_of_books_with_their_derivatives(loss, closed):
    value, first, second = loss(RESIDUALS**2)
    # the difference of two numbers near one has their rounding
    np.testing.assert_allclose(value, closed(RESIDUALS), rtol=1e-12, atol=1e-14)
    z = np.array([0.01, 0.5, 3.0, 15.0, 21.0, 23.0, 400.0])
    step = 1e-5 * z
    value, first, second = loss(z)
    above, below = loss(z + step), loss(z - step)
    np.testing.assert_allclose(first, (above[0] - below[0]) / (2 * step), rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(second, (above[1] - below[1]) / (2 * step), rtol=1e-6, atol=1e-9)


def test_near_zero_both_are_squares_far_out_one_is_a_line_and_the_other_flat():
    small, far = np.array([1e-8]), np.array([1e6, 4e6]) ** 2
    for loss in (pseudo_huber, biweight):
        assert [float(found[0]) for found in loss(small)[:2]] == pytest.approx([1e-8, 1.0], rel=1e-6)
    # a line of slope 2 c, and nothing more to gain
    assert np.diff(pseudo_huber(far)[0])[0] == pytest.approx(2 * PSEUDO_HUBER_SCALE * 3e6, rel=1e-5)
    assert biweight(far)[0].tolist() == [BIWEIGHT_CUTOFF**2 / 3] * 2
    assert biweight(far)[1].tolist() == [0, 0]


def test_the_pull_is_half_the_derivative_of_the_biweight_and_the_curvature_its_own():
    noise = Noise(0.02, 0.0)
    step = 1e-5
    found = resting(0.02 * RESIDUALS, noise)
    pull = (tukey(RESIDUALS + step) - tukey(RESIDUALS - step)) / (4 * step)
    np.testing.assert_allclose(found.influence, pull, atol=1e-8)
    above, below = (resting(0.02 * (RESIDUALS + sign * step), noise).influence for sign in (1, -1))
    inside = np.abs(RESIDUALS) < BIWEIGHT_CUTOFF
    assert found.outlying.tolist() == (~inside).tolist()
    assert found.curvature == pytest.approx(float(np.mean(((above - below) / (2 * step))[inside])), rel=1e-6)


def test_a_solution_has_the_scatter_of_its_torques():
    torques = np.array([0.0, 1.0, -20.0])
    found = resting(np.array([0.03, -0.4, 9.0]), Noise(0.03, 0.1), torques)
    np.testing.assert_allclose(found.scatter, [0.03, np.sqrt(0.03**2 + 0.1**2), np.sqrt(0.03**2 + 2.0**2)])
    r = found.residuals / found.scatter
    np.testing.assert_allclose(found.influence, r * (1 - (r / BIWEIGHT_CUTOFF) ** 2) ** 2)
    assert loss_of(found.residuals, found.scatter) == pytest.approx(float(np.sum(tukey(r))))
    assert loss_of(np.array([2.0, -600.0]), 2.0) == pytest.approx(
        float(tukey(np.array([1.0]))[0]) + BIWEIGHT_CUTOFF**2 / 3
    )


@pytest.mark.parametrize("closed", [published_pseudo_huber, tukey])
def test_the_losses_are_as_efficient_as_they_say(closed):
    """Variance of the plain mean over that of a mean by the loss, for normal noise: E[ψ']²/E[ψ²], 0.95."""

    def mean_of(function):
        density = lambda r: function(r) * np.exp(-(r**2) / 2) / np.sqrt(2 * np.pi)  # noqa: E731  (as short as the formula)
        return integrate.quad(density, -12, 12, points=[-BIWEIGHT_CUTOFF, BIWEIGHT_CUTOFF], limit=200)[0]

    loss = {published_pseudo_huber: pseudo_huber, tukey: biweight}[closed]

    def pull(r):
        return r * float(loss(np.array([r * r]))[1][0])

    # by parts: E[ψ'] = E[r ψ]
    assert mean_of(lambda r: r * pull(r)) ** 2 / mean_of(lambda r: pull(r) ** 2) == pytest.approx(0.95, abs=0.005)


# -- the noise ------------------------------------------------------------------------------------


@pytest.mark.parametrize("deviation", [1e-6, 0.02, 300.0])
def test_the_scatter_of_normal_noise_is_its_standard_deviation(deviation):
    noise = np.random.default_rng(1).normal(0, deviation, 200_000)
    # the median of so many is known to 0.26 %
    assert scatter_of(noise, np.ones(1)) == pytest.approx(deviation, rel=0.01)
    noise[:20_000] *= 1000
    # a tenth far out: the median moves from the 50 % to the 55.6 % quantile of the others
    assert scatter_of(noise, np.ones(1)) == pytest.approx(deviation * MAD_TO_STANDARD_DEVIATION * 0.7647, rel=0.01)


def test_the_scatter_is_never_zero():
    assert scatter_of(np.zeros(5), np.array([2.0, -7.0])) == pytest.approx(7e-9)
    assert scatter_of(np.zeros(5), np.zeros(5)) > 0
    found = noise_of(np.zeros(100), np.linspace(-7, 2, 100))
    assert found == (pytest.approx(7e-9), 0.0)
    assert np.all(np.isfinite(noise_of(np.zeros(100), np.zeros(100))))


@pytest.mark.parametrize(("floor", "share"), [(0.02, 0.05), (0.02, 0.0), (0.0, 0.05), (2.0, 0.05)])
def test_the_noise_is_found_with_both_its_parts(floor, share):
    """40 000 rows in eight parts: each variance is known to 2.3 %, so the squares of both parts to a few per cent."""
    random = np.random.default_rng(6)
    torques = random.uniform(-2, 2, 40_000)
    found = noise_of(np.hypot(floor, share * torques) * random.standard_normal(40_000), torques)
    # of the smaller part only what it adds to the larger one can be seen
    smallest, largest = np.hypot(floor, 0.1 * share), np.hypot(floor, 2 * share)
    np.testing.assert_allclose(found.of(np.array([0.1])), smallest, rtol=0.05 if floor else 0.4)
    np.testing.assert_allclose(found.of(np.array([-2.0])), largest, rtol=0.05)


def test_noise_that_is_the_same_everywhere_is_taken_as_such_by_few_rows():
    random = np.random.default_rng(6)
    residuals, torques = random.standard_normal(35), np.linspace(0, 9, 35)
    assert noise_of(residuals, torques) == (scatter_of(residuals, torques), 0.0)
    grown = noise_of(torques * random.standard_normal(35), torques)
    assert grown.share == 0.0
    # of one torque nothing can be told of a share
    assert noise_of(random.standard_normal(1000), np.full(1000, 3.0)).of(np.array([3.0])) == pytest.approx(1, rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("rows", [40, 100, 400])
def test_the_noise_of_few_rows_is_no_smaller_than_it_is(rows):
    """Medians of twelve rows are off by a third; a mean that trusts the small ones most would be too small."""
    torques = np.linspace(1, 2, rows)
    found = [noise_of(np.random.default_rng(seed).standard_normal(rows), torques) for seed in range(400)]
    # the share is never negative, which lifts the far end a little
    means = np.mean([noise.of(np.array([1.0, 1.5])) for noise in found], axis=0)
    np.testing.assert_allclose(means, 1.0, atol=0.08)


# -- the fit --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_for_normal_noise_the_fit_is_nearly_that_of_least_squares():
    """Over many logs: variances of a mean by the fit and by the plain mean are as 1/0.95 to 1."""
    columns = np.ones((100, 1))
    noises = [np.random.default_rng(seed).normal(0, 0.3, 100) for seed in range(600)]
    robust = np.array([fitted(columns, noise).values[0] for noise in noises])
    plain = np.array([noise.mean() for noise in noises])
    # both see the same noise, so that their ratio is known to √(0.05/600 · 4) = 2 %
    assert robust.var() / plain.var() == pytest.approx(1 / 0.95, abs=0.06)


@pytest.mark.parametrize("far", [[50.0], [50.0, -80.0], [3.0], [1e4]])
def test_outliers_count_nothing_to_one_side_or_to_both(far):
    """The fit is the same as without the rows, but for the scatter, which they make larger."""
    random = np.random.default_rng(3)
    x = np.linspace(-1, 1, 400)
    columns = np.stack([np.ones(400), x], axis=1)
    clean = columns @ [1.0, 2.0] + random.normal(0, 0.1, 400)
    measured = clean.copy()
    measured[::10] += np.resize(far, 40)
    found = fitted(columns, measured)
    kept = ~np.isin(np.arange(400), np.arange(0, 400, 10))
    alone = fitted(columns[kept], measured[kept])
    assert found.converged
    assert np.count_nonzero(found.outlying & ~kept) == 40
    # errors are 0.005 and 0.009
    np.testing.assert_allclose(found.values, alone.values, atol=1e-3)
    np.testing.assert_allclose(found.values, [1.0, 2.0], atol=0.03)
    plain = np.linalg.lstsq(columns, measured, rcond=None)[0]
    assert np.max(np.abs(plain - [1, 2])) > 0.1


def test_where_the_fit_rests_the_pulls_are_in_balance():
    random = np.random.default_rng(3)
    columns = np.stack([np.ones(400), np.linspace(-1, 1, 400)], axis=1)
    measured = columns @ [1.0, 2.0] + random.normal(0, 0.1, 400)
    measured[::20] += 50
    found = fitted(columns, measured)
    psi = found.influence / found.scatter
    # by far less than the pulls would change by chance
    by_chance = np.linalg.norm(columns, axis=0) * np.linalg.norm(psi) / np.sqrt(400)
    assert np.all(np.abs(columns.T @ psi) < 1e-3 * by_chance)
    np.testing.assert_allclose(found.residuals, columns @ found.values - measured, atol=1e-13)
    np.testing.assert_allclose(found.torques, columns @ found.values)


@pytest.mark.slow
def test_noise_that_grows_with_the_torque_is_weighted_as_it_should_be():
    """Weighted least squares with the true noise is the best there is; the plain one is far off it here."""
    x = np.linspace(0.01, 1, 300)
    columns = np.stack([np.ones(300), 10 * x], axis=1)
    deviation = 0.1 * (columns @ [0.1, 1.0])
    robust, weighted, plain = [], [], []
    for seed in range(150):
        measured = columns @ [0.1, 1.0] + deviation * np.random.default_rng(seed).standard_normal(300)
        robust.append(fitted(columns, measured).values)
        weighted.append(np.linalg.lstsq(columns / deviation[:, np.newaxis], measured / deviation, rcond=None)[0])
        plain.append(np.linalg.lstsq(columns, measured, rcond=None)[0])
    best, found, poor = (np.var(values, axis=0) for values in (weighted, robust, plain))
    assert np.all(found < 1.25 * best)
    assert np.all(found < poor)
    assert poor[0] > 5 * best[0]


def test_a_prior_is_a_square_whatever_the_rows_say():
    """One number, no rows that count: the prior alone decides, far out as well."""
    prior = Prior(lambda x: (x - 100.0) / 0.5, lambda x: np.eye(1) / 0.5)
    noise = np.random.default_rng(0).standard_normal(50)
    found = fitted(np.zeros((50, 1)), noise, prior)
    assert found.values == pytest.approx([100.0])


def test_bounds_are_kept():
    measured = 3 + 0.1 * np.random.default_rng(0).standard_normal(50)
    bounds = np.array([0.0]), np.array([2.0])
    found = fitted(np.ones((50, 1)), measured, start=np.array([5.0]), bounds=bounds)
    assert found.values[0] == pytest.approx(2.0, abs=1e-6)
    assert found.values[0] <= 2.0


# -- autocorrelation_lag ---------------------------------------------------------------------------------------


def test_white_noise_is_forgotten_at_once():
    """The first correlation is above two of its errors in one of 44 series; in those the reach is short."""
    reaches = [autocorrelation_lag(np.random.default_rng(seed).standard_normal(2000)) for seed in range(400)]
    assert np.mean(np.array(reaches) == 0) == pytest.approx(0.977, abs=0.025)
    assert max(reaches) <= 6


@pytest.mark.parametrize("correlation", [0.5, 0.9])
def test_noise_that_follows_itself_is_remembered_until_it_is_lost_in_the_noise(correlation):
    """φ^lag falls below 2/√n at lag ln(2/√n)/ln φ."""
    rows = 4000
    lost = np.log(2 / np.sqrt(rows)) / np.log(correlation)
    found = np.median([autocorrelation_lag(autoregressive(rows, correlation, seed)) for seed in range(40)])
    assert found == pytest.approx(2 * lost, rel=0.35)


def test_alternating_noise_and_few_rows_have_no_memory():
    assert autocorrelation_lag((-1.0) ** np.arange(100)) == 0
    assert autocorrelation_lag(np.ones(100)) == 0
    assert autocorrelation_lag(autoregressive(19, 0.9)) == 0


def test_twenty_rows_tell_of_each_other_and_fewer_do_not():
    """Halves of opposite sign go together at every lag; a tenth of the rows is the longest that is looked at."""
    halves = np.repeat([1.0, -1.0], 10)
    assert autocorrelation_lag(halves) == 2
    assert autocorrelation_lag(halves[:19]) == 0
