"""Sketches: laws that hold whatever the numbers, the pieces they come in and who counts."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ballscrew.compiler.kernels.sketch import RELATIVE_ERROR, UNIT, Sketch

TINY = 2.2250738585072014e-308
SHARES = (0.0, 0.025, 0.3, 0.5, 0.975, 1.0)

#: Numbers of any size that have squares.
of_any_size = st.floats(min_value=-1e150, max_value=1e150)
finite = st.lists(of_any_size | st.sampled_from([0.0, -0.0, 1.0, 5e-324, TINY]), min_size=1, max_size=60)
anything = st.lists(of_any_size | st.sampled_from([math.nan, math.inf, -math.inf, 0.0]), max_size=40)


@pytest.fixture(
    params=[False, pytest.param(True, marks=pytest.mark.compiles)], ids=["numpy", "compiled"], scope="module"
)
def compiled(request):
    return request.param


def sketch_of(*pieces, compiled=False):
    sketch = Sketch(compiled=compiled)
    for piece in pieces:
        sketch.add(np.asarray(piece, dtype=float))
    return sketch


def told(sketch):
    """What does not depend on the order."""
    quantiles = [sketch.quantile(share) for share in SHARES]
    return np.concatenate([sketch.count, sketch.missing, sketch.minimum, sketch.maximum, *quantiles])


def some_numbers(size, seed=36):
    """Of both signs, over many powers of ten, some of them zero, infinite or missing."""
    rng = np.random.default_rng(seed)
    values = rng.normal(size=size) * 10.0 ** rng.uniform(-12, 12, size)
    values[rng.random(size) < 0.01] = 0.0
    values[rng.random(size) < 0.01] = np.nan
    values[rng.random(size) < 0.001] = np.inf
    return values


@given(values=finite, share=st.floats(0, 1))
def test_quantiles_are_close(compiled, values, share):
    """Each of the two numbers next to the rank is found to the relative error; the ends exactly."""
    values = np.sort(values)
    position = share * (values.size - 1)
    below, above = values[math.floor(position)], values[math.ceil(position)]
    (found,) = sketch_of(values, compiled=compiled).quantile(share)
    exact = below + (above - below) * (position - math.floor(position))
    rounding = 4 * np.spacing(max(abs(below), abs(above)))
    assert abs(found - exact) <= RELATIVE_ERROR * max(abs(below), abs(above)) + TINY + rounding


@given(values=finite)
def test_the_ends_are_exact(compiled, values):
    sketch = sketch_of(values, compiled=compiled)
    assert (sketch.minimum, sketch.maximum) == (min(values), max(values))
    assert (sketch.quantile(0.0), sketch.quantile(1.0)) == (min(values), max(values))
    assert sketch.count == len(values)


@given(values=finite)
def test_quantiles_rise(compiled, values):
    sketch = sketch_of(values, compiled=compiled)
    assert np.all(np.diff([sketch.quantile(share)[0] for share in np.linspace(0, 1, 41)]) >= 0)


@given(values=anything, cuts=st.lists(st.integers(0, 40), max_size=3), turned=st.booleans())
def test_merging_is_exact(compiled, values, cuts, turned):
    """Whatever the pieces and their order."""
    pieces = np.split(np.array(values, dtype=float), sorted(min(cut, len(values)) for cut in cuts))
    total = Sketch()
    for piece in reversed(pieces) if turned else pieces:
        total.merge(sketch_of(piece, compiled=compiled))
    assert np.array_equal(told(total), told(sketch_of(values, compiled=compiled)), equal_nan=True)


@given(values=anything)
def test_special_numbers_are_counted_apart(compiled, values):
    values = np.array(values, dtype=float)
    sketch = sketch_of(values, compiled=compiled)
    assert sketch.missing == np.isnan(values).sum()
    kept = values[~np.isnan(values)]
    assert sketch.count == kept.size
    with np.errstate(invalid="ignore"):
        expected = kept.mean() if kept.size else np.nan
    if not np.all(np.isfinite(kept)):
        assert np.array_equal(sketch.mean, [expected], equal_nan=True)
        assert np.isnan(sketch.deviation)
    if not kept.size:
        assert np.all(np.isnan([sketch.mean, sketch.minimum, sketch.maximum, sketch.quantile(0.5)]))


@given(values=st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=50), offset=st.sampled_from([0.0, 1e3, 1e9]))
def test_mean_and_deviation(compiled, values, offset):
    """Against exact fractions; a large mean takes nothing from a small deviation."""
    values = np.array(values) + offset
    exact = [Fraction(float(value)) for value in values]
    mean = sum(exact) / len(exact)
    squares = sum((value - mean) ** 2 for value in exact)
    sketch = sketch_of(values, compiled=compiled)
    spread = float(max(exact) - min(exact))
    largest = float(max(abs(value) for value in exact))
    assert abs(float(sketch.mean[0]) - mean) <= 16 * np.spacing(largest)
    # what the mean is off adds its square, and differences round
    expected = math.sqrt(squares / (len(exact) - 1))
    assert abs(float(sketch.deviation[0]) - expected) <= 1e-14 * spread + 16 * np.spacing(largest)


@given(value=st.floats(-1e100, 1e100), count=st.integers(2, 100))
def test_equal_numbers_have_no_deviation(compiled, value, count):
    sketch = sketch_of(np.full(count, value), np.full(count, value), compiled=compiled)
    assert sketch.deviation == 0
    assert sketch.mean == value
    found = sketch.quantile(0.4)
    assert found == value


def test_what_overflows_is_infinite(compiled):
    """Quietly; ends and quantiles do not care."""
    sketch = sketch_of([1e200, 3e200, 1.7e308, 1.6e308], compiled=compiled)
    assert sketch.maximum == 1.7e308
    assert sketch.quantile(0.1) == pytest.approx(1e200 + 0.3 * 2e200, rel=RELATIVE_ERROR)
    assert not np.isfinite(sketch.deviation)


def test_many_units(compiled):
    """Sums over several units are those of all numbers, with a large mean and a small deviation.

    The means of units are rounded to 1.5e-8 and differ by some 0.02, so the variance is off by less than
    their product; sums of squares would lose every digit.
    """
    values = 1e8 + np.random.default_rng(1).normal(size=5 * UNIT + 17)
    sketch = sketch_of(values, compiled=compiled)
    mean = math.fsum(values) / values.size
    deviation = math.sqrt(math.fsum((values - mean) ** 2) / (values.size - 1))
    assert sketch.mean[0] == pytest.approx(mean, rel=1e-15)
    assert sketch.deviation[0] == pytest.approx(deviation, rel=3e-10)


def test_pieces_of_whole_units_give_the_same_bits(compiled):
    values = some_numbers(7 * UNIT + 100)
    whole = sketch_of(values, compiled=compiled)
    for size in (1, 2, 3):
        cuts = range(size * UNIT, values.size, size * UNIT)
        pieces = sketch_of(*np.split(values, cuts), compiled=compiled)
        assert np.array_equal(told(pieces), told(whole))
        for one, other in zip(pieces.moments, whole.moments, strict=True):
            assert np.array_equal(one, other)


def test_series_do_not_know_each_other(compiled):
    """Side by side or each by itself: the same bits."""
    values = np.stack([some_numbers(2 * UNIT + 5, seed) for seed in (1, 2, 3)])
    values[1] = np.abs(values[1])
    together = Sketch(3, compiled=compiled)
    together.add(values)
    alone = [sketch_of(row, compiled=compiled) for row in values]
    for name in ("count", "missing", "minimum", "maximum", "mean", "deviation"):
        assert np.array_equal(getattr(together, name), [getattr(one, name)[0] for one in alone], equal_nan=True)
    for share in SHARES:
        assert np.array_equal(together.quantile(share), [one.quantile(share)[0] for one in alone])


def test_sums_handed_over_in_order(compiled):
    """A sketch that counts parts of a whole: its sums go, its counts stay."""
    values = some_numbers(4 * UNIT)
    sketch, total = Sketch(compiled=compiled), Sketch()
    for part in np.split(values, 4):
        sketch.add(part)
        total.moments = total.moments.merged(sketch.take_moments())
    total.merge(sketch)
    assert np.array_equal(told(total), told(sketch_of(values, compiled=compiled)))


def test_memory_does_not_grow_with_the_numbers(compiled):
    """16 KiB for each power of two and sign, however many numbers there are."""
    sketch = Sketch(compiled=compiled)
    rng = np.random.default_rng(5)
    for _ in range(50):
        sketch.add(rng.uniform(1.0, 16.0, UNIT))
    assert sum(a.nbytes for a in vars(sketch).values() if isinstance(a, np.ndarray)) < 250_000


@pytest.mark.compiles
def test_kernels_count_as_numpy_does():
    """The same bins; sums to rounding."""
    values = some_numbers(3 * UNIT + 11)
    plain, fast = sketch_of(values), sketch_of(values, compiled=True)
    assert np.array_equal(told(plain), told(fast))
    finite_only = values[np.isfinite(values)]
    plain, fast = sketch_of(finite_only), sketch_of(finite_only, compiled=True)
    assert abs(plain.mean - fast.mean) <= 1e-13 * np.abs(finite_only).mean()
    assert fast.deviation == pytest.approx(plain.deviation, rel=1e-13)
