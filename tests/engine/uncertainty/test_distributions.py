"""Distributions: quantile functions against closed forms and SciPy, on all kinds of value."""

import math
import statistics

import numpy as np
import pytest
from scipy import stats

from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import Info
from ballscrew.engine.uncertainty.distributions import (
    LogNormal,
    Normal,
    Triangular,
    Uniform,
    standard_normal_quantile,
    within,
)

#: From the smallest to the largest random number there is, close to where the approximations change.
LEVELS = np.unique(
    np.concatenate(
        [
            2.0 ** -np.arange(1, 54),
            1 - 2.0 ** -np.arange(2, 54),
            np.linspace(0.001, 0.999, 999),
            0.5 + 0.425 * np.array([-1 - 1e-12, -1, -1 + 1e-12, 1 - 1e-12, 1, 1 + 1e-12]),
            math.exp(-25) * np.array([1 - 1e-12, 1, 1 + 1e-12]),
        ]
    )
)
#: With what SciPy makes of them.
DISTRIBUTIONS = {
    "uniform": (Uniform(-1.0, 3.0), stats.uniform(-1.0, 4.0)),
    "normal": (Normal(2.0, 0.3), stats.norm(2.0, 0.3)),
    "log-normal": (LogNormal(0.1, 1.4), stats.lognorm(math.log(1.4), scale=0.1)),
    "triangular": (Triangular(1.0, 2.0, 4.0), stats.triang(1 / 3, 1.0, 3.0)),
    "triangular, falling": (Triangular(1.0, 1.0, 4.0), stats.triang(0.0, 1.0, 3.0)),
    "triangular, rising": (Triangular(1.0, 4.0, 4.0), stats.triang(1.0, 1.0, 3.0)),
}


def test_normal_quantile():
    """Python's own, by the algorithm of Wichura 1988, which claims about 1 part in 1e16."""
    expected = [statistics.NormalDist().inv_cdf(float(level)) for level in LEVELS]
    assert standard_normal_quantile(LEVELS) == pytest.approx(expected, rel=4e-15, abs=1e-300)


def test_normal_quantile_published():
    """The check values of Wichura 1988."""
    levels = np.array([0.25, 0.001, 1e-20])
    expected = [-0.6744897501960817, -3.090232306167814, -9.262340089798408]
    assert standard_normal_quantile(levels) == pytest.approx(expected, rel=4e-16)


def test_normal_quantile_is_odd():
    """Where 1 − u is exact."""
    levels = np.arange(1, 1024) / 1024
    assert np.array_equal(standard_normal_quantile(levels), -standard_normal_quantile(1 - levels))
    assert standard_normal_quantile(0.5) == 0


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_quantiles(name):
    distribution, expected = DISTRIBUTIONS[name]
    size = abs(expected.mean()) + expected.std()
    found = distribution.quantile(LEVELS)
    assert found == pytest.approx(expected.ppf(LEVELS), rel=2e-14, abs=2e-14 * size)
    # SciPy makes small differences of large numbers near the ends of a triangle, and so do we
    middle = (LEVELS > 1e-6) & (LEVELS < 1 - 1e-6)
    assert expected.cdf(found[middle]) == pytest.approx(LEVELS[middle], rel=1e-8)


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_quantiles_rise(name):
    found = DISTRIBUTIONS[name][0].quantile(np.linspace(0.0005, 0.9995, 4000))
    assert np.all(np.diff(found) > 0)


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_on_all_kinds_of_value(name):
    """Floats and arrays of any shape."""
    distribution = DISTRIBUTIONS[name][0]
    expected = distribution.quantile(LEVELS)
    for place in (0, 60, 500, -1):
        assert distribution.quantile(float(LEVELS[place])) == pytest.approx(float(expected[place]), rel=1e-15)
    assert np.array_equal(distribution.quantile(LEVELS[:1000].reshape(10, 100)), expected[:1000].reshape(10, 100))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Uniform(2.0, 1.0), r"uniform.high: must be above low \(1 against 2\)"),
        (lambda: Uniform(1.0, 1.0), "one value needs no distribution"),
        (lambda: Uniform(math.nan, 1.0), r"uniform.low: must be a finite number \(nan\)"),
        (lambda: Uniform(0.0, math.inf), "uniform.high: must be a finite number"),
        (lambda: Normal("1", 1.0), "normal.mean: must be a finite number"),
        (lambda: Normal(0.0, np.ones(2)), "normal.deviation: must be a finite number"),
        (lambda: Normal(0.0, 0.0), r"normal.deviation: must be positive \(0\)"),
        (lambda: LogNormal(0.0, 2.0), "log_normal.median: must be positive"),
        (lambda: LogNormal(1.0, 1.0), r"log_normal.factor: must be above 1 \(1\) · 1.1 is"),
        (lambda: Triangular(1.0, 0.5, 2.0), r"triangular.mode: must lie between the ends \(0.5\) · 1 to 2"),
        (lambda: Triangular(1.0, 1.0, 1.0), "triangular.high: must be above low"),
    ],
)
def test_bad_numbers(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_words():
    assert Uniform(1000, 4000).describe("N") == "uniform from 1000.0 N to 4000.0 N"
    assert Normal(np.float64(0.1), 0.02).describe("1") == "normal, mean 0.1, standard deviation 0.02"
    assert LogNormal(0.1, 1.3).describe("Pa s") == "log-normal, median 0.1 Pa s, factor 1.3"
    assert Triangular(0, 1, 3).describe("m") == "triangular from 0.0 m to 3.0 m, mode 1.0 m"


# -- cut at ends ----------------------------------------------------------------------------------

CUT = {
    "normal": (Normal(2.0, 0.3, 1.8, 2.9), stats.truncnorm(-0.2 / 0.3, 3.0, 2.0, 0.3)),
    "normal, one end": (Normal(0.1, 0.05, low=0.0), stats.truncnorm(-2.0, math.inf, 0.1, 0.05)),
    "normal, half": (Normal(0.0, 1.0, low=0.0), stats.halfnorm()),
}


@pytest.mark.parametrize("name", CUT)
def test_cut_quantiles(name):
    """SciPy's truncated distributions; near an end both lose digits to the difference of two shares."""
    distribution, expected = CUT[name]
    levels = LEVELS[(LEVELS > 1e-9) & (LEVELS < 1 - 1e-9)]
    assert distribution.quantile(levels) == pytest.approx(expected.ppf(levels), rel=1e-6, abs=1e-9)
    assert expected.cdf(distribution.quantile(levels)) == pytest.approx(levels, rel=1e-7, abs=1e-12)


def test_cut_log_normal():
    """Its share below x is (F(x) − F(low)) / (F(high) − F(low)), F that of SciPy's log-normal."""
    whole = stats.lognorm(math.log(1.4), scale=0.1)
    low, high = 0.08, 0.2
    found = LogNormal(0.1, 1.4, low, high).quantile(np.linspace(0.01, 0.99, 99))
    share = (whole.cdf(found) - whole.cdf(low)) / (whole.cdf(high) - whole.cdf(low))
    assert share == pytest.approx(np.linspace(0.01, 0.99, 99), rel=1e-12)


@pytest.mark.parametrize("distribution", [Normal(0.5, 2.0, 0.0, 1.0), LogNormal(0.5, 5.0, 0.1, 1.0)])
def test_no_sample_lies_beyond_an_end(distribution):
    found = distribution.quantile(LEVELS)
    assert found.min() >= distribution.low
    assert found.max() <= distribution.high
    assert np.all(np.diff(found) >= 0)


def test_ends_that_no_sample_reaches_change_no_bit():
    for cut, whole in (
        (Normal(40.0, 0.1, 0.0, 80.0), Normal(40.0, 0.1)),
        (LogNormal(0.1, 1.3, 1e-9, 1e9), LogNormal(0.1, 1.3)),
    ):
        assert np.array_equal(cut.quantile(LEVELS), whole.quantile(LEVELS))


def test_within_cuts_where_a_bound_can_be_reached():
    info = Info("x", "a ratio", above=0.5, at_most=1)
    assert within(Normal(0.54, 0.001), info) == Normal(0.54, 0.001)
    cut = within(Normal(0.54, 0.02), info)
    assert cut.low > 0.5
    assert cut.low == pytest.approx(0.5, abs=1e-15)
    assert cut.high == math.inf
    assert within(Normal(0.9, 0.05), info).high == 1.0
    assert within(Uniform(0.52, 0.56), info) == Uniform(0.52, 0.56)
    assert within(LogNormal(0.1, 2.0), Info("x", "a positive number", above=0)) == LogNormal(0.1, 2.0)
    with pytest.raises(InputError, match="must leave the middle between its ends"):
        within(Normal(0.4, 0.1), info)


def test_words_of_ends():
    assert Normal(0.1, 0.02, low=0.0).describe("m") == "normal, mean 0.1 m, standard deviation 0.02 m, cut below 0.0 m"
    assert LogNormal(0.1, 1.3, 0.05, 0.5).describe("1").endswith("factor 1.3, cut below 0.05 and above 0.5")
