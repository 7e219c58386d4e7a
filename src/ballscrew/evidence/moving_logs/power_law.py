"""Friction as a free power of the speed, F0 + c·vⁿ, and an interval of n that does not flatter.

The exponent of one fit has three digits, few of which mean anything: they move with the part of the log that is used,
with the filter, and with the slowest speed that counts. The interval here holds the moving-block bootstrap and the
exponents under all these choices.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ballscrew.evidence.moving_logs.equation import Equation
from ballscrew.evidence.moving_logs.regression import LeastSquares, bootstrap_sums, relative_error
from ballscrew.files.torque_logs.motion import Floats

#: Exponents that are tried, between which a parabola finds the best.
EXPONENTS = np.round(np.arange(0.2, 2.01, 0.1), 10)
#: Columns beside the power: acceleration, offset, direction; in one direction the last two are one.
LINEAR, ONE_WAY = (0, 1, 2), (0, 2)
#: Resampled logs.
REPLICATES = 400
#: Factors of the cutoffs, and slowest speeds as shares of the largest, under which the exponent is found again.
CUTOFF_FACTORS = (0.5, 2.0)
SLOWEST_SHARES = (0.02, 0.05, 0.1, 0.15)
#: The error of a fit must fall by so much, as a share, from one end of the exponents to the best, or n is not told.
_SHARPNESS = 1e-3


@dataclasses.dataclass(frozen=True)
class PowerLaw:
    """The fit of F0 + c·vⁿ: exponent, its intervals (95 %), the other numbers, the relative error."""

    exponent: float
    #: Of the moving-block bootstrap.
    bootstrap: tuple[float, float]
    #: Exponents under other choices of filter, slowest speed, direction and part of the log, by name.
    choices: Mapping[str, float]
    mass: float
    offset: float
    constant_force: float
    coefficient: float
    relative_error: float

    @property
    def interval(self) -> tuple[float, float]:
        """The bootstrap's interval and all choices together."""
        values = [value for value in self.choices.values() if np.isfinite(value)]
        return min([self.bootstrap[0], *values]), max([self.bootstrap[1], *values])

    def friction(self, speed: Floats) -> Floats:
        """Friction force at speeds, N, with the sign of the speed."""
        return np.sign(speed) * (self.constant_force + self.coefficient * np.abs(speed) ** self.exponent)

    def force(self, equation: Equation) -> Floats:
        """The force of the model at the rows that an equation uses."""
        whole = self.mass * equation.acceleration + self.offset + equation.direction**2 * self.friction(equation.speed)
        return equation.filtered(whole)


def power_law(equation: Equation, *, replicates: int = REPLICATES, seed: int = 0) -> PowerLaw | None:
    """The free power law of a log; None where its speeds do not tell an exponent."""
    sides = _sides(equation)
    rows = np.arange(equation.used.size)
    exponent = _best(sides, equation.force, rows)
    if not np.isfinite(exponent):
        return None
    solved = LeastSquares.of(_columns(equation, exponent), equation.force)
    mass, offset, constant, coefficient = solved.values.tolist()
    return PowerLaw(
        exponent,
        _bootstrap(sides, equation.force, solved, exponent, replicates, seed),
        _choices(equation, sides),
        mass,
        offset,
        constant,
        coefficient,
        relative_error(solved.residuals, equation.force),
    )


def _columns(equation: Equation, exponent: float) -> Floats:
    speed, direction = equation.speed, equation.direction
    ones = np.ones(speed.size)
    return equation.filtered(
        np.stack([equation.acceleration, ones, direction, direction * np.abs(speed) ** exponent], axis=1)
    )


def _sides(equation: Equation) -> Floats:
    """The columns of the linear part, then those of each exponent, at the rows used."""
    speed, direction = equation.speed, equation.direction
    size = np.abs(speed) / float(np.max(np.abs(speed)))
    powers = [direction * size**n for n in EXPONENTS]
    return equation.filtered(np.stack([equation.acceleration, np.ones(speed.size), direction, *powers], axis=1))


def _lowest(losses: Floats) -> Floats:
    """The exponent of the lowest loss along the last axis, by a parabola through it and its neighbours."""
    best = np.clip(np.argmin(losses, axis=-1), 1, EXPONENTS.size - 2)[..., np.newaxis]
    before, here, after = (np.take_along_axis(losses, best + off, axis=-1)[..., 0] for off in (-1, 0, 1))
    bend = before - 2 * here + after
    with np.errstate(divide="ignore", invalid="ignore"):
        off = np.where(bend > 0, 0.5 * (before - after) / bend, np.sign(before - after))
    step = EXPONENTS[1] - EXPONENTS[0]
    return np.asarray(EXPONENTS[best[..., 0]] + step * np.clip(off, -1.0, 1.0), dtype=np.float64)


def _losses(products: Floats, linear: tuple[int, ...] = LINEAR) -> Floats:
    """Sums of squares that are left, for each exponent, of products of (columns, measured) summed over rows."""
    count = EXPONENTS.size
    losses = np.empty((*products.shape[:-2], count))
    for place in range(count):
        chosen = [*linear, len(LINEAR) + place]
        matrix = products[..., chosen, :][..., chosen]
        right = products[..., chosen, -1]
        values = np.linalg.solve(matrix, right[..., np.newaxis])[..., 0]
        losses[..., place] = products[..., -1, -1] - np.sum(values * right, axis=-1)
    return losses


def _products(sides: Floats, force: Floats) -> Floats:
    both = np.column_stack([sides / np.maximum(np.linalg.norm(sides, axis=0), np.finfo(float).tiny), force])
    return both[:, :, np.newaxis] * both[:, np.newaxis, :]


def _best(sides: Floats, force: Floats, rows: NDArray[np.int64], linear: tuple[int, ...] = LINEAR) -> float:
    """The best exponent of some rows; NaN where they do not tell one."""
    if rows.size < sides.shape[1]:
        return np.nan
    chosen = np.column_stack([sides[rows], force[rows]])
    chosen = chosen / np.maximum(np.linalg.norm(chosen, axis=0), np.finfo(float).tiny)
    try:
        losses = _losses(chosen.T @ chosen, linear)
    except np.linalg.LinAlgError:
        return np.nan
    if not np.isfinite(losses).all() or np.ptp(losses) < _SHARPNESS * max(float(losses.min()), 0.0):
        return np.nan
    return float(_lowest(losses))


def _bootstrap(
    sides: Floats, force: Floats, solved: LeastSquares, exponent: float, replicates: int, seed: int
) -> tuple[float, float]:
    """The 95 % interval of the exponent by the moving-block bootstrap.

    Resampled quantiles are too narrow for few blocks: they are widened about the estimate by Student's distribution and
    by the degrees of freedom that the numbers take.
    """
    sums = bootstrap_sums(_products(sides, force), solved.block, replicates, seed)
    try:
        lowest = _lowest(_losses(sums))
    except np.linalg.LinAlgError:
        return np.nan, np.nan
    low, high = np.quantile(lowest, [0.025, 0.975]) - exponent
    wider = solved.few_blocks(len(LINEAR) + 2)
    return float(exponent + wider * low), float(exponent + wider * high)


def _choices(equation: Equation, sides: Floats) -> dict[str, float]:
    """The exponent under other choices, by name."""
    log, motion, force = equation.log, equation.kinematics, equation.force

    def again(name: str, **changed: float) -> tuple[str, float]:
        options = {"cutoff": equation.cutoff, "path_cutoff": motion.cutoff, "shift": equation.shift, **changed}
        other = Equation.of(log, **options)
        return name, _best(_sides(other), other.force, np.arange(other.used.size))

    largest = float(np.max(np.abs(equation.speed)))
    values = [again(f"both sides at {f:g} × the cutoff", cutoff=f * equation.cutoff) for f in CUTOFF_FACTORS]
    values += [again(f"position at {f:g} × the cutoff", path_cutoff=f * motion.cutoff) for f in CUTOFF_FACTORS]
    values += [again(f"without speeds below {share:.0%}", slowest=share * largest) for share in SLOWEST_SHARES]
    half = equation.used.size // 2
    direction = equation.direction[equation.used]
    parts = {
        "first half": np.arange(half), "second half": np.arange(half, equation.used.size),
        "forward": np.flatnonzero(direction > 0), "backward": np.flatnonzero(direction < 0),
    }  # fmt: skip
    # in one direction the offset and the constant part are one column
    values += [(name, _best(sides, force, rows, ONE_WAY if "ward" in name else LINEAR)) for name, rows in parts.items()]
    return dict(values)
