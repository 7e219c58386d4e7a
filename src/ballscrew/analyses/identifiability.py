"""What data can tell of numbers, and what they cannot.

The derivatives, in units of the scatter and of what one would like to know of each number (its *scale*), have singular
values s and directions v. A combination of the numbers along v is known to 1/s of the scale. Beyond :data:`LIMIT` the
combination is not identified: an error bar from derivatives would be a number, but no statement.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ballscrew.analyses.robust import Solution, Vector, memory

#: A combination counts as identified if its standard error is at most this share of the scale.
LIMIT = 0.5
#: Singular values below this share of the largest are rounding, whatever the scatter.
ROUNDING = 1e-7
#: A number has part in what is not identified if that leaves more than this share of its scale open,
PART = 0.05
#: and if it is there at all but for rounding.
PRESENT = 1e-5
#: A row that a fit follows all by itself says nothing of its noise.
MOST_LEVERAGE = 0.9


@dataclasses.dataclass(frozen=True, eq=False)
class Told:
    """Directions in the space of scaled numbers, as columns, with the singular values; which of them are told."""

    singular_values: Vector
    directions: Vector
    told: NDArray[np.bool_]

    @classmethod
    def of(cls, root: Vector) -> Told:
        """From derivatives of residuals in units of the scatter by scaled numbers, of shape (rows, numbers)."""
        numbers = root.shape[1]
        _, s, directions = np.linalg.svd(np.vstack([root, np.zeros((numbers, numbers))]), full_matrices=False)
        return cls(s, directions.T, (LIMIT * s >= 1) & (s > ROUNDING * s.max(initial=0.0)))

    @property
    def open(self) -> Vector:
        """The directions that are not told, as columns."""
        return self.directions[:, ~self.told]

    @property
    def measured(self) -> Vector:
        """All directions that are measured at all, as columns: what is not told well still leaks into other numbers.

        Of those that are not told, parts that are only rounding are left out.
        """
        cleaned = np.where(self.told | (np.abs(self.directions) > PRESENT), self.directions, 0.0)
        return cleaned[:, self.singular_values > ROUNDING * self.singular_values.max(initial=0.0)]

    @property
    def numbers_told(self) -> NDArray[np.bool_]:
        """The numbers that have no part in a direction that is not told, and are known well enough themselves."""
        parts = np.abs(self.directions)
        undecided = (parts > PRESENT) & (parts > PART * self.singular_values)
        own = np.sqrt(np.sum((parts[:, self.told] / self.singular_values[self.told]) ** 2, axis=1))
        return ~undecided[:, ~self.told].any(axis=1) & (own <= LIMIT)


@dataclasses.dataclass(frozen=True)
class Combination:
    """A product of powers of the numbers, ``Π x^power``, near the estimate; how well the data know it.

    ``relative_error`` is the standard error of its logarithm as the data alone give it.
    """

    powers: Mapping[str, float]
    relative_error: float
    identified: bool


@dataclasses.dataclass(frozen=True, eq=False)
class Identifiability:
    """What a log tells of the free numbers, with the drift of the sensor taken out and without priors."""

    names: tuple[str, ...]
    singular_values: Vector
    #: The numbers that the data tell.
    identified: Mapping[str, bool]
    #: The best known first.
    combinations: Sequence[Combination]

    @classmethod
    def of(cls, solution: Solution, names: Sequence[str], scale: Vector) -> Identifiability:
        """From a fit whose first parameters are the numbers; the others are taken out."""
        root = weighted(solution)
        count = len(names)
        alone, others = root[:, :count], root[:, count:]
        if others.shape[1]:
            basis, _ = np.linalg.qr(others)
            alone = alone - basis @ (basis.T @ alone)
        found = Told.of(alone * scale[:count])
        combinations = []
        for s, direction, told in zip(found.singular_values, found.directions.T, found.told, strict=True):
            powers = direction * np.sign(direction[np.argmax(np.abs(direction))])
            with np.errstate(divide="ignore"):
                error = float(1 / s)
            # by rounding a direction may have parts of numbers that are not in it
            seen = {n: float(power) for n, power in zip(names, powers, strict=True) if abs(power) > PRESENT}
            combinations.append(Combination(seen, error, bool(told)))
        told = dict(zip(names, found.numbers_told.tolist(), strict=True))
        return cls(tuple(names), found.singular_values, told, combinations)


def weighted(solution: Solution) -> Vector:
    """Derivatives in units of the scatter, as the loss counts them: rows that are outliers count nothing."""
    root = (np.sqrt(solution.curvature) / solution.scatter)[:, np.newaxis] * solution.slopes
    return np.where(solution.outlying[:, np.newaxis], 0.0, root)


@dataclasses.dataclass(frozen=True, eq=False)
class Uncertainty:
    """Covariance of the parameters of a fit within what data and priors measure, and what they do not tell."""

    covariance: Vector
    scale: Vector
    told: Told

    @classmethod
    def of(cls, solution: Solution, scale: Vector, prior_slopes: Vector) -> Uncertainty:
        """``H⁻¹ B H⁻¹`` within the directions that are measured; it holds whatever the noise is distributed like.

        H is the curvature of the loss with the information of the prior. B is the covariance of its slope: residuals
        over one less the leverage of their row (HC3, MacKinnonWhite1985), with the products of rows that follow each
        other as long as they are alike (NeweyWest1987). In no direction is it less than equal noise in all rows would
        make it: with few rows that matter, their own residuals say little.
        """
        root, known = weighted(solution) * scale, prior_slopes * scale
        told = Told.of(np.vstack([root, known]))
        inside = told.measured
        slopes = root @ inside
        rows, parameters = slopes.shape
        prior = inside.T @ (known.T @ known) @ inside
        inverse = np.linalg.inv(slopes.T @ slopes + prior)
        leverage = np.minimum(np.einsum("ri,ij,rj->r", slopes, inverse, slopes), MOST_LEVERAGE)
        psi, weight = solution.pull, np.sqrt(solution.curvature)
        scores = (psi / (1 - leverage) / weight)[:, np.newaxis] * slopes
        spread = _long_run(scores, memory(psi)) + prior
        even = float(psi @ psi) / solution.curvature / max(rows - parameters, 1) * (slopes.T @ slopes) + prior
        outside = scale[:, np.newaxis] * inside @ inverse
        return cls(outside @ _at_least(spread, even) @ outside.T, scale, told)

    def variance_of(self, gradients: Vector) -> Vector:
        """Variance of what has these derivatives by the parameters, along the last axis; NaN where it is not told."""
        scaled = gradients * self.scale
        length = np.linalg.norm(scaled, axis=-1)
        astray = np.linalg.norm(scaled @ self.told.open, axis=-1)
        variance = np.einsum("...i,ij,...j", gradients, self.covariance, gradients)
        return np.where(astray > PART * length, np.nan, variance)


def _at_least(one: Vector, other: Vector) -> Vector:
    """A covariance that is in every direction what one of two is, and no less than the other."""
    root = np.linalg.cholesky(other + 1e-14 * np.trace(other) * np.eye(other.shape[0]))
    ratios, directions = np.linalg.eigh(np.linalg.solve(root, np.linalg.solve(root, one).T))
    back = root @ directions
    return np.asarray(back * np.maximum(ratios, 1.0) @ back.T, dtype=np.float64)


def _long_run(scores: Vector, reach: int) -> Vector:
    """Sum of products of scores, with those of rows up to ``reach`` apart, weighted as in NeweyWest1987."""
    spread = scores.T @ scores
    for lag in range(1, reach + 1):
        crossed = scores[lag:].T @ scores[:-lag]
        spread = spread + (1 - lag / (reach + 1)) * (crossed + crossed.T)
    return spread
