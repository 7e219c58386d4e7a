"""Jackknife: the covariance of estimates of few rows, from fits that each leave one operating point out.

With few rows the residuals say little of the noise: a robust fit may take good rows for outliers, and a single row may
decide a number. Fits without one operating point show both.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ballscrew.evidence.calibration.problem import Problem
from ballscrew.evidence.calibration.robust import Prior, Vector, solve

#: Operating points are distinguished by this share of the largest load and speed.
CELL_WIDTH = 0.02


def operating_points(load: Vector, speed: Vector) -> NDArray[np.int64]:
    """The number of the operating point of each row, from 0: rows of the same direction, load and speed share one."""
    places = [np.sign(speed)]
    for values in (load, speed):
        largest = float(np.max(np.abs(values))) or 1.0
        places.append(np.round(values / (CELL_WIDTH * largest)))
    return np.unique(np.stack(places), axis=1, return_inverse=True)[1].reshape(-1)


def jackknife_covariance(
    problem: Problem, measured: Vector, groups: NDArray[np.int64], start: Vector, scale: Vector, prior: Prior
) -> Vector:
    r"""Covariance of the parameters by the jackknife over groups of rows; a negative group is in none of the fits.

    .. math:: V = \frac{G - 1}{G} \sum_g (\theta_g - \bar\theta)(\theta_g - \bar\theta)^T

    Tukey1958. G is the number of groups, θ_g the estimate without the rows of group g.
    """
    names = np.unique(groups[groups >= 0])
    vectors: list[Vector] = []
    for name in names:
        kept = (groups >= 0) & (groups != name)
        vectors.append(solve(problem.on(kept), measured[kept], start, scale, problem.bounds, prior).values)
    off = np.stack(vectors) - np.mean(vectors, axis=0)
    return np.asarray((names.size - 1) / names.size * off.T @ off, dtype=np.float64)
