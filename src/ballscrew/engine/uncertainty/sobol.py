"""Sobol' indices: shares of the variance of any function of independent inputs.

The function takes shares, numbers between 0 and 1, of shape (inputs, samples), as
:mod:`ballscrew.engine.uncertainty.monte_carlo` makes them, and returns one number for each sample.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError
from ballscrew.engine.uncertainty.monte_carlo import sobol_sequence

#: One number for each sample of shares of shape (inputs, samples).
Function = Callable[[NDArray[np.float64]], NDArray[np.float64]]

#: Resamples of a bootstrap, and how many of its numbers are in memory at a time.
RESAMPLES = 999
_AT_A_TIME = 2**20
#: A result that varies by less than this, relative to its mean, is constant: what is left is rounding.
CONSTANT = 1e-12
#: The largest share of samples without a number that may be left out.
MAXIMUM_EXCLUDED_SHARE = 0.1
#: A first-order index S above this has the estimator that is better there. Of a sum of normal terms the variances of
#: the two, 2S + S² and 2(1 − S)² over the samples, are the same at 3 − √7.
LARGE_INDEX = 0.354
#: The inputs that are taken together explain at least this share of the variance, or are all there are.
EXPLAINED = 0.9


class Estimate(NamedTuple):
    """A number and the ends of its interval."""

    value: float
    low: float
    high: float


class KnownInputs(NamedTuple):
    """Some inputs by their places, and the share of the standard deviation that is left if they are known."""

    inputs: tuple[int, ...]
    left: float


@dataclasses.dataclass(frozen=True, eq=False)
class SobolIndices:
    """Result of :func:`sobol_indices`; inputs in the order of the shares."""

    first_order: Sequence[Estimate]
    total: Sequence[Estimate]
    mean: float
    deviation: float
    known: Sequence[KnownInputs]
    evaluations: int
    #: Samples that were left out, as they have no finite number somewhere.
    left_out: int


def sobol_indices(function: Function, inputs: int, samples: int, seed: int = 0, level: float = 0.95) -> SobolIndices:
    r"""First-order and total Sobol' indices, and what is left where the largest inputs are known.

    .. math::

        S_i = \frac{V[E(y|x_i)]}{V[y]}, \quad T_i = 1 - \frac{V[E(y|x_{\sim i})]}{V[y]}, \quad
        l_u = \sqrt{\frac{E[V(y|x_u)]}{V[y]}}

    By ``scipy.stats.sobol_indices`` (the estimators of Saltelli and others 2010, Computer Physics
    Communications 181, 259–270) on scrambled Sobol' points, ``samples`` (a power of two) for each of
    ``inputs + 2`` sets. Their first-order estimator is good where the index is small; where it is above a
    third, :math:`1 - l_i^2` by the estimator below is better and takes its place. The intervals hold with
    probability ``level``. They are percentiles of a bootstrap that takes the samples for random. Evenly spread
    ones are mostly better than that, so that intervals are too wide rather than too narrow; of less than
    some thousand samples small indices may be an exception.

    ``known`` takes the inputs by falling first-order index, one more each time. What a set :math:`u` of
    them leaves is estimated with the columns of the set frozen,
    :math:`l_u^2 = E[(f(B) - f(A_B^u))^2]/2V` (Jansen 1999, Computer Physics Communications 117, 35–43), so
    that what inputs do together counts.

    Samples without a finite number are left out. Raises :class:`~ballscrew.basis.errors.InputError` if they are
    more than a tenth.
    """
    shares = sobol_sequence(2 * inputs, samples, seed)
    a, b = shares[:inputs], shares[inputs:]
    every = [_frozen(a, b, [i]) for i in range(inputs)]
    values = function(np.concatenate([a, b, *every], axis=1)).reshape(inputs + 2, samples)
    kept = finite(values)
    mean, deviation = float(np.mean(values[:2, kept])), float(np.std(values[:2, kept]))
    left_out = int(np.sum(~kept))
    if is_constant(mean, deviation):
        none = [Estimate(0.0, 0.0, 0.0)] * inputs
        return SobolIndices(none, none, mean, 0.0, (), values.size, left_out)
    # the mean in place of what is left out counts for nothing in any sum about the mean
    centred = np.where(kept, values - mean, 0.0)
    result = _by_scipy(centred)
    large = result[0] > LARGE_INDEX
    result[0, large] = 1 - np.mean((centred[1] - centred[2:][large]) ** 2, axis=-1) / (2 * np.var(centred[:2]))
    ends = np.quantile(_resampled(centred, large, seed), [(1 - level) / 2, (1 + level) / 2], axis=0)
    order = [int(i) for i in np.argsort(-result[0], kind="stable") if result[1][i] > 0]
    if len(order) == 1:  # all variance is its own: nothing is to be estimated
        result[:, order] = ends[:, :, order] = 1.0
    first_order, total = (
        [Estimate(*map(float, row)) for row in zip(result[k], *ends[:, k], strict=True)] for k in range(2)
    )
    enough = int(np.searchsorted(np.cumsum(np.maximum(result[0][order], 0)), EXPLAINED)) + 1
    sets = [order[: k + 1] for k in range(min(enough, len(order)))]
    asked = [which for which in sets[1:] if len(which) < len(order)]
    frozen = function(np.concatenate([_frozen(a, b, which) for which in asked], axis=1)) if asked else np.empty(0)
    left = [np.sqrt(np.clip(1 - result[0][order[0]], 0, 1))] if order else []
    for row in frozen.reshape(len(asked), samples):
        here = kept & np.isfinite(row)
        left.append(np.sqrt(np.mean((values[1, here] - row[here]) ** 2) / 2) / deviation)
    left += [0.0] * (len(sets) - len(left))  # nothing is left where all are known
    # to know more never leaves more, but for the noise of the estimates
    known = [KnownInputs(tuple(w), float(share)) for w, share in zip(sets, np.minimum.accumulate(left), strict=True)]
    return SobolIndices(first_order, total, mean, deviation, known, values.size + frozen.size, left_out)


def is_constant(mean: float, deviation: float) -> bool:
    """Test whether a standard deviation is only rounding."""
    return deviation <= CONSTANT * abs(mean)


def finite(values: NDArray[np.float64]) -> NDArray[np.bool_]:
    """The samples that are finite in all rows; a fault if too many are not."""
    kept = np.all(np.isfinite(values), axis=0)
    lost = 1 - float(np.mean(kept))
    if lost > MAXIMUM_EXCLUDED_SHARE:
        remedy = "narrow the distributions, or choose another output"
        raise InputError(Fault("sensitivity.output", "has no finite value", f"{lost:.0%} of the samples", remedy))
    return kept


def resampled_means(terms: NDArray[np.float64], seed: int) -> NDArray[np.float64]:
    """The means of each row of ``terms`` over samples drawn with replacement: (resamples, rows)."""
    rows, samples = terms.shape
    rng = np.random.default_rng([seed, samples])
    at_a_time = max(1, _AT_A_TIME // samples)
    means: list[NDArray[np.float64]] = []
    for start in range(0, RESAMPLES, at_a_time):
        count = min(at_a_time, RESAMPLES - start)
        drawn = rng.integers(samples, size=(count, samples)) + samples * np.arange(count)[:, np.newaxis]
        weights = np.bincount(drawn.ravel(), minlength=count * samples).reshape(count, samples)
        means.append(weights @ terms.T / samples)
    return np.concatenate(means).reshape(RESAMPLES, rows)


def _frozen(a: NDArray[np.float64], b: NDArray[np.float64], which: Sequence[int]) -> NDArray[np.float64]:
    """The samples ``a`` with some inputs as in ``b``."""
    mixed = a.copy()
    mixed[list(which)] = b[list(which)]
    return mixed


def _by_scipy(centred: NDArray[np.float64]) -> NDArray[np.float64]:
    """First-order and total indices, (2, inputs), from values at A, B and all A with one input of B."""
    from scipy import stats  # half a second: for those only who ask for indices

    # an input without effect at the end: of one input alone SciPy makes scalars, which it then fails on
    pages = np.concatenate([centred[2:], centred[:1]])[:, np.newaxis]
    values: Any = {"f_A": centred[:1], "f_B": centred[1:2], "f_AB": pages}
    result = stats.sobol_indices(func=values, n=centred.shape[1])
    return np.array([result.first_order[:-1], result.total_order[:-1]])


def _resampled(centred: NDArray[np.float64], large: NDArray[np.bool_], seed: int) -> NDArray[np.float64]:
    """Both kinds of index of resamples, (resamples, 2, inputs).

    The estimators are ratios of means, so one product of matrices does it. SciPy's own bootstrap takes
    seconds and no seed.
    """
    f_a, f_b, f_ab = centred[0], centred[1], centred[2:]
    first = np.where(large[:, np.newaxis], (f_b - f_ab) ** 2 / 2, f_b * (f_ab - f_a))
    total = (f_a - f_ab) ** 2 / 2
    means = resampled_means(np.concatenate([first, total, [(f_a + f_b) / 2, (f_a**2 + f_b**2) / 2]]), seed)
    variance = means[:, -1] - means[:, -2] ** 2
    with np.errstate(invalid="ignore", divide="ignore"):
        indices = np.nan_to_num(means[:, :-2] / variance[:, np.newaxis]).reshape(len(means), 2, len(f_ab))
    indices[:, 0, large] = 1 - indices[:, 0, large]
    return indices
