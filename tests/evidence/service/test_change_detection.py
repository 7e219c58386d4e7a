"""The CUSUM with an estimated mean and scatter, and the trend: rates of false alarms, and values worked out by hand."""

import math

import numpy as np
import pytest
from scipy.stats import binom

from ballscrew.evidence.service.condition_means import ALLOWANCE, chart, limits, scatter_of, trend

#: Healthy series, and how often a right rate fails the test.
MANY, FALSE_ALARM = 2000, 1e-4
RATE, BASELINE, TESTS = 0.002, 5, 30


def alarms(series, besides=0.0):
    return sum(chart(one, BASELINE, np.full(one.size, besides), RATE).alarm is not None for one in series)


@pytest.mark.parametrize(("mean", "scatter"), [(0.0, 1.0), (-0.9, 0.013)])
def test_the_rate_of_false_alarms_is_the_stated_one(mean, scatter):
    series = np.random.default_rng(11).normal(mean, scatter, (MANY, TESTS))
    stated = 1 - (1 - RATE) ** (TESTS - BASELINE)
    low, high = binom.ppf([FALSE_ALARM / 2, 1 - FALSE_ALARM / 2], MANY, stated)
    # the limits are from 50 000 series of their own: a tenth of the rate is theirs
    assert 0.9 * low <= alarms(series) <= 1.1 * high


def test_the_limits_are_those_of_healthy_series_simulated_test_by_test():
    """200 000 series of another seed, as written down: each against the mean and the scatter of its own values."""
    series = np.random.default_rng(17).standard_normal((200_000, 7))
    worst, sums, healthy = [], np.zeros((2, len(series))), np.ones(len(series), dtype=bool)
    for last in (5, 6):
        scatter = np.sqrt(np.sum(np.diff(series[:, : last + 1]) ** 2, axis=1) / (2 * last))
        score = np.clip((series[:, last] - series[:, :5].mean(axis=1)) / scatter, -4, 4)
        sums = np.maximum(0, sums + np.stack([score, -score]) - ALLOWANCE)
        largest = sums.max(axis=0)
        worst.append(np.quantile(largest[healthy], 0.95))
        healthy &= largest <= worst[-1]
    # 5 % of 50 000 series are known to 2 % of themselves, and the limit the better
    assert limits(5, 2, 0.05) == pytest.approx(worst, rel=0.015)


def test_scatter_besides_makes_alarms_rarer():
    series = np.random.default_rng(12).normal(0.0, 1.0, (200, TESTS))
    assert alarms(series, besides=1.0) < alarms(series)


def test_the_sums_by_hand():
    values = np.array([0.0, 1.0, 0.0, 1.0, 3.0])
    found = chart(values, 3, np.zeros(5), 0.01)
    scatter = scatter_of(values)
    # differences 1, -1, 1, 2
    assert scatter[1:] == pytest.approx(np.sqrt([1 / 2, 2 / 4, 3 / 6, 7 / 8]))
    first = max(0.0, (1 - 1 / 3) / scatter[3] - ALLOWANCE)
    assert found.rise[3:] == pytest.approx([first, first + (3 - 1 / 3) / scatter[4] - ALLOWANCE])
    assert found.fall[3:] == pytest.approx([0.0, 0.0])
    assert np.isnan(found.rise[:3]).all()
    assert np.isnan(found.limit[:3]).all()


def test_a_slow_drift_is_not_in_the_scatter():
    noise = np.random.default_rng(13).normal(0.0, 1.0, 400)
    drifted = noise + 0.05 * np.arange(400)
    assert scatter_of(drifted)[-1] == pytest.approx(scatter_of(noise)[-1], rel=0.02)
    assert np.std(drifted) > 5 * np.std(noise)


def test_a_fall_and_a_rise_are_told_apart():
    step = np.where(np.arange(20) < 8, 0.0, 1.0) + np.random.default_rng(14).normal(0, 0.05, 20)
    for sign, falls in ((1, False), (-1, True)):
        found = chart(sign * step, BASELINE, np.zeros(20), RATE)
        assert found.alarm is not None
        assert 8 <= found.alarm <= 11
        assert found.falls is falls


@pytest.mark.parametrize("place", [5, 12, 29])
def test_one_wild_test_is_no_alarm(place):
    values = np.random.default_rng(15).normal(0, 0.01, 30)
    values[place] -= 0.7
    assert chart(values, BASELINE, np.full(30, 0.02), RATE).alarm is None


@pytest.mark.parametrize("first", [(0.05, 0, 0, 0, 0), (0.028, -0.006, 0.001, 0.024, -0.048)])
def test_scatter_of_few_digits_and_of_wild_values_seldom_gives_an_alarm(first):
    """Series drawn from few values, most of them equal, as torques of few digits are, or uneven ones."""
    random = np.random.default_rng(16)
    found = sum(
        chart(random.choice(first, TESTS), BASELINE, np.full(TESTS, 0.02), RATE).alarm is not None for _ in range(400)
    )
    assert found <= binom.ppf(1 - FALSE_ALARM, 400, 0.05)


def test_values_that_never_change_give_no_alarm():
    assert chart(np.zeros(30), BASELINE, np.zeros(30), RATE).alarm is None


def test_a_series_that_grows_keeps_its_limits():
    assert limits(BASELINE, 12, RATE).tolist() == limits(BASELINE, 30, RATE)[:12].tolist()


def test_the_slope_of_a_line_with_wild_points():
    times = np.arange(21.0)
    values = 3.0 - 0.25 * times
    values[[3, 11, 16]] += 40.0
    found = trend(times, values)
    assert found.slope == pytest.approx(-0.25)
    assert found.low <= -0.25 <= found.high
    assert found.told


def test_no_slope_of_fewer_than_three_times():
    assert math.isnan(trend(np.array([1.0, 1.0, 2.0]), np.zeros(3)).slope)
    assert not trend(np.array([1.0, 1.0, 2.0]), np.zeros(3)).told
