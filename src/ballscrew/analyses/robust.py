"""Least squares that outliers do not rule.

The loss is the pseudo-Huber one, ``ρ(r) = 2 c² (√(1 + (r/c)²) − 1)`` in units of the scatter: a square near
zero, a straight line far out. The scatter is 1.4826 times the median of the absolute residuals, found anew between
fits.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

#: Where the loss bends, in units of the scatter: little is lost on normal noise (95 % efficient).
BEND = 1.35
#: From the median of absolute residuals to the standard deviation of normal noise.
MEDIAN_TO_DEVIATION = 1.4826
#: Residuals beyond this many times the scatter are counted as outliers.
OUTLYING = 4.0
#: How often the scatter is found anew, and when it has settled.
ROUNDS, SETTLED = 20, 1e-3
#: Rows further apart than this count as independent.
LONGEST_MEMORY = 1000
#: No scatter is smaller than this share of the torques themselves: sums of floats are not exact.
LEAST_SCATTER = 1e-9


@dataclasses.dataclass(frozen=True, eq=False)
class Prior:
    """What is known of the parameters beforehand: residuals in standard deviations, and their derivatives."""

    residuals: Callable[[Vector], Vector]
    slopes: Callable[[Vector], Vector]


@dataclasses.dataclass(frozen=True, eq=False)
class Solution:
    """Where the fit came to rest: parameters, residuals (model − measured), derivatives, and the scatter."""

    values: Vector
    residuals: Vector
    slopes: Vector
    scatter: float
    converged: bool

    @property
    def outlying(self) -> NDArray[np.bool_]:
        """The rows that are outliers."""
        return np.abs(self.residuals) > OUTLYING * self.scatter

    @property
    def rms(self) -> float:
        """Root mean square of the residuals, outliers left out."""
        kept = self.residuals[~self.outlying]
        return float(np.sqrt(np.mean(kept**2))) if kept.size else float("nan")


def scatter_of(residuals: Vector, torques: Vector) -> float:
    """The scatter of residuals; see the module."""
    least = LEAST_SCATTER * float(np.max(np.abs(torques), initial=0.0))
    return max(MEDIAN_TO_DEVIATION * float(np.median(np.abs(residuals))), least, np.finfo(float).tiny)


def pull(residuals: Vector, scatter: float) -> tuple[Vector, Vector]:
    """Derivative of half the loss by the residual in units of the scatter, and its own derivative."""
    r = residuals / scatter
    bent = np.sqrt(1 + (r / BEND) ** 2)
    return r / bent, bent**-3


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

    Scatter and parameters are found in turn, each fit from where the last one ended. ``done`` is told after each.
    """
    from scipy.optimize import least_squares  # 0.2 s: for those only who fit

    known, loss = _Remembered(model), cast("Any", _loss(measured.size))
    values = np.clip(start, *_inside(bounds))
    scatter = scatter_of(known(values)[0] - measured, measured)
    converged = False
    for turn in range(ROUNDS):

        def residuals(x: Vector, scatter: float = scatter) -> Vector:
            return np.concatenate([(known(x)[0] - measured) / scatter, prior.residuals(x)])

        def slopes(x: Vector, scatter: float = scatter) -> Vector:
            return np.concatenate([known(x)[1] / scatter, prior.slopes(x)])

        jac: Any = slopes  # SciPy's types know only names of methods
        found = least_squares(
            residuals, values, jac, x_scale=scale, bounds=bounds, loss=loss,
            xtol=1e-9, ftol=1e-10, gtol=1e-9, max_nfev=100,
        )  # fmt: skip
        values, converged = found.x, bool(found.status > 0)
        before, scatter = scatter, scatter_of(known(values)[0] - measured, measured)
        if done is not None:
            done(turn + 1, ROUNDS)
        if abs(scatter - before) <= SETTLED * before:
            break
    torques, derivatives = known(values)
    return Solution(values, torques - measured, derivatives, scatter, converged)


def memory(psi: Vector) -> int:
    """How many rows on residuals are still alike: twice the lag of the first correlation that is lost in the noise."""
    rows = psi.size
    centred = psi - psi.mean()
    power = float(centred @ centred)
    if power == 0 or rows < 20:
        return 0
    longest = min(rows // 10, LONGEST_MEMORY)
    lost = 2 / np.sqrt(rows)
    for lag in range(1, longest + 1):
        if float(centred[lag:] @ centred[:-lag]) / power < lost:
            return 2 * (lag - 1)
    return longest


class _Remembered:
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


def _loss(rows: int) -> Callable[[Vector], Vector]:
    """The loss as SciPy wants it, of squared residuals: bent for rows of the log, a plain square for the prior."""

    def loss(z: Vector) -> Vector:
        root = np.sqrt(1 + z[:rows] / BEND**2)
        found = np.array([z, np.ones_like(z), np.zeros_like(z)])
        found[0, :rows] = 2 * BEND**2 * (root - 1)
        found[1, :rows] = 1 / root
        found[2, :rows] = -0.5 / (BEND**2 * root**3)
        return found

    return loss
