"""Least squares that outliers do not rule: MM estimation (Yohai1987).

First comes a loss that is a square near zero and a straight line far out, ``2 c² (√(1 + (r/c)²) − 1)``, with residuals
r in units of the scatter, which is found anew between fits: 1.4826 times the median of the absolute residuals, over
parts of the rows in the order of their torque, so that it may grow with the torque (:class:`Noise`).
From there Tukey's biweight goes on, ``(c²/3)(1 − (1 − (r/c)²)³)`` and constant beyond c: what is far out, to one side
or to both, then counts nothing. Both are 95 % efficient for normal noise.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
#: Of squared residuals in units of the scatter: the loss and its two derivatives.
Loss = Callable[[Vector], tuple[Vector, Vector, Vector]]

#: Where the first loss bends and where the second ends, in units of the scatter.
PSEUDO_HUBER_SCALE, BIWEIGHT_CUTOFF = 1.35, 4.685
#: From the median of absolute residuals to the standard deviation of normal noise.
MAD_TO_STANDARD_DEVIATION = 1.4826
#: How often the scatter is found anew, and when it has settled.
MAXIMUM_ROUNDS, SCATTER_TOLERANCE = 20, 5e-3
#: The scatter is looked at over so many parts, each of so many rows; with fewer it is the same everywhere.
MINIMUM_BINS, MAXIMUM_BINS, ROWS_PER_BIN = 3, 8, 15
_REWEIGHTINGS = 5
#: No scatter is smaller than this share of the torques themselves: sums of floats are not exact.
MINIMUM_SCATTER_SHARE = 1e-9
#: Rows further apart than this count as independent, and fewer rows than these tell nothing of each other.
MAXIMUM_LAG, MINIMUM_ROWS = 1000, 20


@dataclasses.dataclass(frozen=True, eq=False)
class Prior:
    """Prior knowledge of the parameters: residuals in standard deviations, and their derivatives."""

    residuals: Callable[[Vector], Vector]
    slopes: Callable[[Vector], Vector]


class Noise(NamedTuple):
    """Standard deviation of readings about a torque M: ``√(floor² + (share · M)²)``, in N m."""

    floor: float
    share: float

    def of(self, torques: Vector) -> Vector:
        """The scatter at some torques."""
        return np.hypot(self.floor, self.share * torques)


@dataclasses.dataclass(frozen=True, eq=False)
class Solution:
    """The solution of a fit: parameters, torques, residuals (model − measured), derivatives, and the noise."""

    values: Vector
    torques: Vector
    residuals: Vector
    slopes: Vector
    noise: Noise
    converged: bool

    @functools.cached_property
    def scatter(self) -> Vector:
        """The scatter at each row."""
        return self.noise.of(self.torques)

    @property
    def outlying(self) -> NDArray[np.bool_]:
        """The rows that count nothing."""
        return np.abs(self.residuals) > BIWEIGHT_CUTOFF * self.scatter

    @property
    def influence(self) -> Vector:
        """Half the derivative of the biweight by each residual in units of the scatter: ψ."""
        r = self.residuals / self.scatter
        return np.where(self.outlying, 0.0, r * (1 - (r / BIWEIGHT_CUTOFF) ** 2) ** 2)

    @property
    def curvature(self) -> float:
        """The mean of the derivative of ψ over the rows that count."""
        r2 = ((self.residuals / self.scatter / BIWEIGHT_CUTOFF) ** 2)[~self.outlying]
        # so many rows in the bend that the mean is near zero would be no fit
        return max(float(np.mean((1 - r2) * (1 - 5 * r2))), 0.1) if r2.size else 1.0


def scatter_of(residuals: Vector, torques: Vector) -> float:
    """The scatter of residuals; see the module."""
    return scatter_above(minimum_scatter(torques), residuals)


def scatter_above(least: float, residuals: Vector) -> float:
    """The scatter of residuals, not below the least of their torques."""
    return max(MAD_TO_STANDARD_DEVIATION * float(np.median(np.abs(residuals))), least)


def noise_of(residuals: Vector, torques: Vector) -> Noise:
    """The noise of residuals about torques, from the scatter over parts of the rows in the order of their size."""
    parts = min(MAXIMUM_BINS, residuals.size // ROWS_PER_BIN)
    least = minimum_scatter(torques)
    if parts < MINIMUM_BINS:
        return Noise(scatter_of(residuals, torques), 0.0)
    chosen = np.array_split(np.argsort(np.abs(torques), kind="stable"), parts)
    y = np.array([scatter_of(residuals[part], torques) ** 2 for part in chosen])
    x = np.array([np.mean(torques[part] ** 2) for part in chosen], dtype=np.float64)
    unit_y, unit_x = float(np.median(y)), float(np.max(x)) or 1.0
    if unit_y == 0:
        return Noise(scatter_of(residuals, torques), 0.0)
    y, x = np.asarray(y / unit_y), np.asarray(x / unit_x)
    floor, share = _line_through(x, y, np.ones(parts))
    for _ in range(_REWEIGHTINGS):
        expected = floor + share * x
        # squares of scatters are known to a share of what they are, not of what they came out as
        floor, share = _line_through(x, y, 1 / np.maximum(expected, 1e-3) ** 2)
    return Noise(max(float(np.sqrt(floor * unit_y)), least), float(np.sqrt(share * unit_y / unit_x)))


def _line_through(x: Vector, y: Vector, weights: Vector) -> tuple[float, float]:
    """``y = floor + share · x`` by weighted least squares, neither below zero."""
    mean_x, mean_y = np.average(x, weights=weights), np.average(y, weights=weights)
    spread = np.average((x - mean_x) ** 2, weights=weights)
    share = 0.0 if spread == 0 else float(np.average((x - mean_x) * (y - mean_y), weights=weights) / spread)
    share = max(share, 0.0)
    floor = float(mean_y - share * mean_x)
    if floor < 0:
        return 0.0, float(np.sum(weights * x * y) / np.sum(weights * x * x))
    return floor, share


def minimum_scatter(torques: Vector) -> float:
    """The least scatter of such torques."""
    return max(MINIMUM_SCATTER_SHARE * float(np.max(np.abs(torques), initial=0.0)), float(np.finfo(float).tiny))


def solve(
    model: Callable[[Vector], tuple[Vector, Vector]],
    measured: Vector,
    start: Vector,
    scale: Vector,
    bounds: tuple[Vector, Vector],
    prior: Prior,
    done: Callable[[int, int], None] | None = None,
) -> Solution:
    """Fit ``model(values) -> (torques, derivatives)`` to what was measured.

    Scatter and parameters are found in turn, each fit from where the last one ended. ``done`` is called after each.
    """
    known = _CachedModel(model)

    def fitted(values: Vector, scatter: Vector, loss: Callable[[Vector], Vector]) -> tuple[Vector, bool]:
        from scipy.optimize import least_squares  # 0.2 s: for those only who fit

        def residuals(x: Vector) -> Vector:
            return np.concatenate([(known(x)[0] - measured) / scatter, prior.residuals(x)])

        def slopes(x: Vector) -> Vector:
            return np.concatenate([known(x)[1] / scatter[:, np.newaxis], prior.slopes(x)])

        options: Any = {"jac": slopes, "loss": loss}  # SciPy's types know only names
        result = least_squares(
            residuals, values, x_scale=scale, bounds=bounds, xtol=1e-9, ftol=1e-10, gtol=1e-9, max_nfev=100, **options
        )
        return result.x, bool(result.status > 0)

    values = np.clip(start, *_inside(bounds))
    # far from the solution, misses are no noise that grows with the torque
    noise = Noise(scatter_of(known(values)[0] - measured, measured), 0.0)
    scatter = noise.of(measured)
    for turn in range(MAXIMUM_ROUNDS):
        values, _ = fitted(values, scatter, _loss(pseudo_huber, measured.size))
        torques = known(values)[0]
        noise = noise_of(torques - measured, torques)
        before, scatter = scatter, noise.of(torques)
        if done is not None:
            done(turn + 1, MAXIMUM_ROUNDS + 1)
        if np.max(np.abs(scatter - before) / before) <= SCATTER_TOLERANCE:
            break
    values, converged = fitted(np.clip(values, *_inside(bounds)), scatter, _loss(biweight, measured.size))
    if done is not None:
        done(MAXIMUM_ROUNDS + 1, MAXIMUM_ROUNDS + 1)
    torques, derivatives = known(values)
    return Solution(values, torques, torques - measured, derivatives, noise, converged)


def loss_of(residuals: Vector, scatter: Vector | float) -> float:
    """The sum of the biweight over rows."""
    return float(np.sum(biweight((residuals / scatter) ** 2)[0]))


def autocorrelation_lag(psi: Vector) -> int:
    """Bandwidth of the autocorrelation of residuals: twice the lag before the first insignificant correlation."""
    rows = psi.size
    centred = psi - psi.mean()
    power = float(centred @ centred)
    if power == 0 or rows < MINIMUM_ROWS:
        return 0
    longest = min(rows // 10, MAXIMUM_LAG)
    lost = 2 / np.sqrt(rows)
    for lag in range(1, longest + 1):
        if float(centred[lag:] @ centred[:-lag]) / power < lost:
            return 2 * (lag - 1)
    return longest


class _CachedModel:
    """A model that remembers its last values: the solver asks for torques and derivatives one after the other."""

    def __init__(self, model: Callable[[Vector], tuple[Vector, Vector]]) -> None:
        self._model = model
        self._at: Vector | None = None
        self._found: tuple[Vector, Vector] = (np.empty(0), np.empty((0, 0)))

    def __call__(self, values: Vector) -> tuple[Vector, Vector]:
        if self._at is None or not np.array_equal(self._at, values):
            self._found = self._model(values)
            self._at = values.copy()
        return self._found


def _inside(bounds: tuple[Vector, Vector]) -> tuple[Vector, Vector]:
    """Bounds a little narrower: the solver starts strictly between them."""
    low, high = bounds
    room = np.where(np.isfinite(high - low), high - low, np.maximum(np.abs(low), np.abs(high)))
    room = np.where(np.isfinite(room) & (room > 0), room, 1.0)
    return low + 1e-9 * room, high - 1e-9 * room


def pseudo_huber(z: Vector) -> tuple[Vector, Vector, Vector]:
    """The first loss of squared residuals, with its two derivatives."""
    root = np.sqrt(1 + z / PSEUDO_HUBER_SCALE**2)
    return 2 * PSEUDO_HUBER_SCALE**2 * (root - 1), 1 / root, -0.5 / (PSEUDO_HUBER_SCALE**2 * root**3)


def biweight(z: Vector) -> tuple[Vector, Vector, Vector]:
    """Tukey's biweight of squared residuals, with its two derivatives."""
    rest = np.maximum(1 - z / BIWEIGHT_CUTOFF**2, 0.0)
    return BIWEIGHT_CUTOFF**2 / 3 * (1 - rest**3), rest**2, -2 / BIWEIGHT_CUTOFF**2 * rest


def _loss(of_rows: Loss, rows: int) -> Callable[[Vector], Vector]:
    """A loss as SciPy wants it, of squared residuals: for rows of the log, and a plain square for the prior."""

    def loss(z: Vector) -> Vector:
        loss = np.array([z, np.ones_like(z), np.zeros_like(z)])
        loss[:, :rows] = of_rows(z[:rows])
        return loss

    return loss
