"""Sobol' indices of functions whose indices are known in closed form.

Ishigami and Homma 1990 with a = 7, b = 0.1, and the g-function (Saltelli and Sobol' 1995), both as in
Saltelli and others 2008, Global Sensitivity Analysis: The Primer, Wiley.
"""

import math

import numpy as np
import pytest

from ballscrew.engine.uncertainty import sobol
from ballscrew.engine.uncertainty.sensitivity import LEVELS, elementary_effects
from ballscrew.engine.uncertainty.sobol import sobol_indices


class Ishigami:
    """sin x₁ + 7 sin² x₂ + 0.1 x₃⁴ sin x₁ on (−π, π)."""

    first = 0.5 * (1 + 0.1 * math.pi**4 / 5) ** 2
    second = 7**2 / 8
    both = 0.1**2 * math.pi**8 * (1 / 18 - 1 / 50)
    variance = first + second + both
    mean = 7 / 2
    first_order = np.array([first, second, 0]) / variance
    total = np.array([first + both, second, both]) / variance

    def __call__(self, shares):
        x = math.pi * (2 * shares - 1)
        return np.sin(x[0]) + 7 * np.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * np.sin(x[0])

    def explained(self, known):
        parts = {(0,): self.first, (1,): self.second, (0, 2): self.both}
        return sum(part for which, part in parts.items() if set(which) <= set(known)) / self.variance


class GFunction:
    """The product of (|4u − 2| + a)/(1 + a)."""

    a = np.array([0, 1, 4.5, 9, 99, 99, 99, 99])
    alone = 1 / (3 * (1 + a) ** 2)
    variance = np.prod(1 + alone) - 1
    mean = 1.0
    first_order = alone / variance
    total = alone * np.prod(1 + alone) / (1 + alone) / variance

    def __call__(self, shares):
        a = self.a[:, np.newaxis]
        return np.prod((np.abs(4 * shares - 2) + a) / (1 + a), axis=0)

    def explained(self, known):
        return (np.prod(1 + self.alone[list(known)]) - 1) / self.variance


FUNCTIONS = {"ishigami": Ishigami(), "g": GFunction()}


@pytest.fixture(params=FUNCTIONS)
def function(request):
    return FUNCTIONS[request.param]


def inputs_of(function):
    return len(function.first_order)


def errors(function, found):
    """Differences from the closed form, each over the standard error that its interval means."""
    for exact, estimates in ((function.first_order, found.first_order), (function.total, found.total)):
        for value, estimate in zip(exact, estimates, strict=True):
            yield (estimate.value - value) / ((estimate.high - estimate.low) / (2 * 1.96))


@pytest.mark.parametrize(("samples", "most"), [(2**10, 3), (2**12, 1.96), (2**14, 1.96)])
def test_indices_are_those_of_the_closed_form(samples, most, function):
    """Within the intervals, and of few samples, of which there are 22 estimates here, within three standard errors."""
    found = sobol_indices(function, inputs_of(function), samples, seed=3)
    assert max(map(abs, errors(function, found))) < most
    widest = max(e.high - e.low for e in (*found.first_order, *found.total))
    assert widest < 9 / math.sqrt(samples)


@pytest.mark.slow
def test_many_samples_give_three_digits(function):
    found = sobol_indices(function, inputs_of(function), 2**16)
    for exact, estimates in ((function.first_order, found.first_order), (function.total, found.total)):
        assert [estimate.value for estimate in estimates] == pytest.approx(exact, abs=1e-3)
    assert found.mean == pytest.approx(function.mean, rel=1e-4)
    assert found.deviation == pytest.approx(math.sqrt(function.variance), rel=1e-3)


def test_what_is_left_is_that_of_the_closed_form(function):
    """Of sets of inputs: what they explain together is more than the sum of their first-order indices."""
    found = sobol_indices(function, inputs_of(function), 2**14)
    assert len(found.known) >= 2
    for known, left in found.known:
        assert left == pytest.approx(math.sqrt(max(1 - function.explained(known), 0)), abs=0.01)
    assert [len(known) for known, _ in found.known] == list(range(1, len(found.known) + 1))


def coverage(function, samples, seeds):
    """The share of seeds whose interval has the closed form in it: first-order and total, by input."""
    inside = np.zeros((2, inputs_of(function)))
    for seed in range(seeds):
        found = sobol_indices(function, inputs_of(function), samples, seed=seed)
        for k, (exact, estimates) in enumerate(
            [(function.first_order, found.first_order), (function.total, found.total)]
        ):
            inside[k] += [e.low <= value <= e.high for value, e in zip(exact, estimates, strict=True)]
    return inside / seeds


def test_intervals_cover_the_closed_form_as_often_as_they_say(monkeypatch):
    """What a bootstrap takes samples for is random: of random samples its intervals hold as often as stated.

    Of 200 seeds 95 % are 190 ± 3 (one standard deviation). Percentiles of few samples hold a little less often.
    """
    monkeypatch.setattr(sobol, "sobol_sequence", lambda d, n, seed: np.random.default_rng(seed).random((d, n)))
    found = coverage(FUNCTIONS["ishigami"], 512, 200)
    assert np.mean(found) == pytest.approx(0.945, abs=0.025)
    assert np.min(found) > 0.88


@pytest.mark.slow
def test_intervals_of_evenly_spread_samples_cover_more(function):
    """From 4096 on all do. Of fewer some pairs of columns of a Sobol' sequence are no better than random."""
    assert np.min(coverage(function, 2**12, 20)) >= 0.95
    few = coverage(function, 2**8, 100)
    assert np.mean(few) >= 0.95
    assert np.min(few) > 0.75


# -- elementary effects ---------------------------------------------------------------------------


def in_deviations(shares):
    """Uniform inputs in units of their standard deviation, 1/√12."""
    return shares * math.sqrt(12)


def test_effects_of_a_linear_function_are_its_slopes():
    slopes = np.array([3.0, -2.0, 0.5, 0.0])
    found = elementary_effects(lambda shares: slopes @ shares, in_deviations, 4, 10)
    assert [e.value for e in found.mean_absolute] == pytest.approx(np.abs(slopes) / math.sqrt(12), rel=1e-12)
    assert [e.value for e in found.deviation] == pytest.approx(np.zeros(4), abs=1e-12)
    assert all(e.high - e.low < 1e-12 for e in found.mean_absolute)
    assert found.evaluations == 10 * 5


def test_effects_of_a_product():
    """The effect of one factor is the other one, on the grid: mean 1/2, variance (L² − 1)/12L², in deviations."""
    found = elementary_effects(lambda shares: shares[0] * shares[1], in_deviations, 2, 2**12)
    spread = math.sqrt((LEVELS**2 - 1) / 12) / LEVELS
    for effect, deviation in zip(found.mean_absolute, found.deviation, strict=True):
        assert effect.value == pytest.approx(0.5 / math.sqrt(12), rel=0.01)
        assert deviation.value == pytest.approx(spread / math.sqrt(12), rel=0.02)
        assert effect.low <= 0.5 / math.sqrt(12) <= effect.high
        assert deviation.low <= spread / math.sqrt(12) <= deviation.high


def test_effects_rank_the_inputs_of_the_g_function():
    found = elementary_effects(FUNCTIONS["g"], in_deviations, 8, 64)
    effects = [e.value for e in found.mean_absolute]
    assert effects[:4] == sorted(effects[:4], reverse=True)
    assert max(effects[4:]) < effects[3]
