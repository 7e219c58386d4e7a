"""Morris screening: elementary effects of any function of independent inputs, for few evaluations.

The function takes shares, as in :mod:`ballscrew.engine.uncertainty.sobol`.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from ballscrew.engine.uncertainty.sampling import sobol_sequence
from ballscrew.engine.uncertainty.sobol import (
    Estimate,
    Function,
    finite,
    resampled_means,
)

#: The levels of an input, in the middles of as many equal shares: an even number. A step is half of them.
LEVELS = 8


@dataclasses.dataclass(frozen=True, eq=False)
class Effects:
    """Result of :func:`elementary_effects`; inputs in the order of the shares."""

    #: µ*: the mean of the absolute effects. It ranks the inputs.
    mean_absolute: Sequence[Estimate]
    #: σ: the standard deviation of the effects. Zero where the effect is the same everywhere.
    deviation: Sequence[Estimate]
    mean: float
    evaluations: int
    #: Trajectories that were left out, as they have no finite number somewhere.
    left_out: int


def elementary_effects(
    function: Function,
    in_deviations: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    inputs: int,
    trajectories: int,
    seed: int = 0,
    level: float = 0.95,
) -> Effects:
    r"""Morris' screening: effects of one input at a time along random trajectories.

    .. math::

        e_i = \frac{f(x + \Delta_i) - f(x)}{\Delta_i/\sigma_i}, \quad \mu^*_i = E|e_i|

    Morris 1991, Technometrics 33, 161–174; :math:`\mu^*` after Campolongo and others 2007, Environmental
    Modelling & Software 22, 1509–1518. Each trajectory starts on a grid of shares and moves each input
    once, in random order, by half of all shares. An effect is the change of the result for a change of
    the input by its standard deviation :math:`\sigma_i`; ``in_deviations`` turns shares into values of
    the inputs in that unit. So effects have the unit of the result, whatever the inputs are, and those of
    a linear function are its slopes times the deviations.

    Intervals hold with probability ``level``, by a bootstrap of the trajectories. Trajectories without a
    finite number are left out. Raises :class:`~ballscrew.basis.errors.InputError` if they are more than a tenth.
    """
    rng = np.random.default_rng([seed, inputs])
    start = np.minimum((sobol_sequence(inputs, trajectories, seed) * LEVELS).astype(int), LEVELS - 1)
    end = (start + LEVELS // 2) % LEVELS
    turn = rng.permuted(np.tile(np.arange(inputs)[:, np.newaxis], trajectories), axis=0)
    moved = turn[..., np.newaxis] < np.arange(inputs + 1)  # inputs, trajectories, points of each
    levels = np.where(moved, end[..., np.newaxis], start[..., np.newaxis])
    values = function(((levels + 0.5) / LEVELS).reshape(inputs, -1)).reshape(trajectories, inputs + 1)
    kept = finite(values.T)
    change = np.take_along_axis(np.diff(values[kept], axis=1).T, turn[:, kept], axis=0)
    step = (in_deviations((end + 0.5) / LEVELS) - in_deviations((start + 0.5) / LEVELS))[:, kept]
    # an input that is kept where it is by its bounds has no effect
    effects = np.divide(change, step, out=np.zeros_like(change), where=step != 0)
    about_mean = effects - np.mean(effects, axis=1, keepdims=True)
    means = resampled_means(np.concatenate([np.abs(effects), about_mean, about_mean**2]), seed)
    absolute, signed, squared = np.split(means, 3, axis=1)
    spread = np.sqrt(np.maximum(squared - signed**2, 0) * effects.shape[1] / (effects.shape[1] - 1))
    return Effects(
        _estimates(np.mean(np.abs(effects), axis=1), absolute, level),
        _estimates(np.std(effects, axis=1, ddof=1), spread, level),
        float(np.mean(values[kept])),
        values.size,
        int(np.sum(~kept)),
    )


def _estimates(values: NDArray[np.float64], resampled: NDArray[np.float64], level: float) -> list[Estimate]:
    low, high = np.quantile(resampled, [(1 - level) / 2, (1 + level) / 2], axis=0)
    return [Estimate(*map(float, row)) for row in zip(values, low, high, strict=True)]
