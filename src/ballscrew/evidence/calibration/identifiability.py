"""Identifiability: the combinations of parameters that data determine, and the covariance within them.

The derivatives, in units of the scatter and of the *scale* of each parameter (the change of it that matters), have
singular values s and directions v. The combination along v has a standard error of 1/s of the scale. Beyond
:data:`MAXIMUM_RELATIVE_ERROR` it is not identified: an error bar from derivatives would be a number without meaning.

Jackknife: the covariance of estimates of few rows, from fits that each leave one operating point out.

With few rows the residuals say little of the noise: a robust fit may take good rows for outliers, and a single row may
decide a number. Fits without one operating point show both.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ballscrew.evidence.calibration.problem import Problem
from ballscrew.evidence.calibration.robust import Prior, Solution, Vector, autocorrelation_lag, solve

#: A combination is identified if its standard error is at most this share of the scale.
MAXIMUM_RELATIVE_ERROR = 0.5
#: Singular values below this share of the largest are rounding, whatever the scatter.
ROUNDING_SHARE = 1e-7
#: A parameter is part of an unidentifiable direction if that leaves more than this share of its scale undetermined,
UNIDENTIFIABLE_SHARE = 0.05
#: and if its component is more than rounding.
ROUNDING_COMPONENT = 1e-5
#: The residual of a row with more leverage than this says nothing about its noise.
MAXIMUM_LEVERAGE = 0.9


@dataclasses.dataclass(frozen=True, eq=False)
class IdentifiableDirections:
    """Directions in the space of scaled parameters, as columns, with their singular values."""

    singular_values: Vector
    directions: Vector
    #: Which of the directions are identifiable.
    identifiable: NDArray[np.bool_]

    @classmethod
    def of(cls, root: Vector) -> IdentifiableDirections:
        """Decompose derivatives by scaled parameters of residuals over their scatter, of shape (rows, parameters)."""
        count = root.shape[1]
        _, s, directions = np.linalg.svd(np.vstack([root, np.zeros((count, count))]), full_matrices=False)
        identifiable = (MAXIMUM_RELATIVE_ERROR * s >= 1) & (s > ROUNDING_SHARE * s.max(initial=0.0))
        return cls(s, directions.T, identifiable)

    @property
    def unidentifiable_directions(self) -> Vector:
        """The directions that are not identifiable, as columns."""
        return self.directions[:, ~self.identifiable]

    @property
    def measured_directions(self) -> Vector:
        """All directions that the data depend on, as columns: those hardly identified still correlate with others.

        Of those that are not identifiable, components that are only rounding are left out.
        """
        cleaned = np.where(self.identifiable | (np.abs(self.directions) > ROUNDING_COMPONENT), self.directions, 0.0)
        return cleaned[:, self.singular_values > ROUNDING_SHARE * self.singular_values.max(initial=0.0)]

    @property
    def identifiable_parameters(self) -> NDArray[np.bool_]:
        """The parameters without a component in an unidentifiable direction, and with a small enough error."""
        components = np.abs(self.directions)
        involved = (components > ROUNDING_COMPONENT) & (components > UNIDENTIFIABLE_SHARE * self.singular_values)
        scaled = components[:, self.identifiable] / self.singular_values[self.identifiable]
        error = np.sqrt(np.sum(scaled**2, axis=1))
        return ~involved[:, ~self.identifiable].any(axis=1) & (error <= MAXIMUM_RELATIVE_ERROR)


@dataclasses.dataclass(frozen=True)
class Combination:
    """A product of powers of the parameters, ``Π x^power``, near the estimate, and how well the data determine it."""

    #: By parameter, its power.
    powers: Mapping[str, float]
    #: Standard error of its logarithm from the data alone.
    relative_error: float
    #: True where the data determine it.
    identified: bool


@dataclasses.dataclass(frozen=True, eq=False)
class Identifiability:
    """Identifiability of the free parameters, with the errors of the sensor eliminated and without priors."""

    names: tuple[str, ...]
    singular_values: Vector
    #: The parameters that the data identify.
    identified: Mapping[str, bool]
    #: The best known first.
    combinations: Sequence[Combination]

    @classmethod
    def of(cls, solution: Solution, names: Sequence[str], scale: Vector) -> Identifiability:
        """Judge a fit whose first parameters are the named ones; the others are projected out."""
        root = weighted_derivatives(solution)
        count = len(names)
        alone, others = root[:, :count], root[:, count:]
        if others.shape[1]:
            basis, _ = np.linalg.qr(others)
            alone = alone - basis @ (basis.T @ alone)
        directions = IdentifiableDirections.of(alone * scale[:count])
        combinations = []
        for s, direction, identifiable in zip(
            directions.singular_values, directions.directions.T, directions.identifiable, strict=True
        ):
            powers = direction * np.sign(direction[np.argmax(np.abs(direction))])
            with np.errstate(divide="ignore", over="ignore"):
                error = float(1 / s)
            # rounding gives a direction components of parameters that are not in it
            kept = {n: float(power) for n, power in zip(names, powers, strict=True) if abs(power) > ROUNDING_COMPONENT}
            combinations.append(Combination(kept, error, bool(identifiable)))
        identified = dict(zip(names, directions.identifiable_parameters.tolist(), strict=True))
        return cls(tuple(names), directions.singular_values, identified, combinations)


def weighted_derivatives(solution: Solution) -> Vector:
    """Derivatives in units of the scatter, weighted as the loss weights them: rows that are outliers are zero."""
    root = (np.sqrt(solution.curvature) / solution.scatter)[:, np.newaxis] * solution.slopes
    return np.where(solution.outlying[:, np.newaxis], 0.0, root)


@dataclasses.dataclass(frozen=True, eq=False)
class Uncertainty:
    """Covariance of the parameters of a fit within the directions that data and priors measure."""

    covariance: Vector
    scale: Vector
    directions: IdentifiableDirections

    @classmethod
    def of(cls, solution: Solution, scale: Vector, prior_slopes: Vector) -> Uncertainty:
        """``H⁻¹ B H⁻¹`` within the directions that are measured; it holds for noise of any distribution.

        H is the curvature of the loss plus the information of the prior. B is the covariance of its gradient:
        residuals over one less the leverage of their row (HC3, MacKinnonWhite1985), with the products of rows up to
        the autocorrelation lag (NeweyWest1987). In no direction is it less than homoscedastic noise would give: with
        few influential rows, their own residuals say little.
        """
        root, known = weighted_derivatives(solution) * scale, prior_slopes * scale
        directions = IdentifiableDirections.of(np.vstack([root, known]))
        inside = directions.measured_directions
        slopes, prior, inverse = _within(inside, root, known)
        rows, parameters = slopes.shape
        leverage = np.minimum(np.einsum("ri,ij,rj->r", slopes, inverse, slopes), MAXIMUM_LEVERAGE)
        psi, weight = solution.influence, np.sqrt(solution.curvature)
        scores = (psi / (1 - leverage) / weight)[:, np.newaxis] * slopes
        spread = long_run_covariance(scores, autocorrelation_lag(psi)) + prior
        even = float(psi @ psi) / solution.curvature / max(rows - parameters, 1) * (slopes.T @ slopes) + prior
        outside = scale[:, np.newaxis] * inside @ inverse
        return cls(outside @ _at_least(spread, even) @ outside.T, scale, directions)

    def at_least(self, covariance: Vector) -> Uncertainty:
        """The same with another covariance, where that is the larger, within the directions that are measured."""
        inside = self.directions.measured_directions
        scales = np.outer(self.scale, self.scale)
        own, other = (inside.T @ (one / scales) @ inside for one in (self.covariance, covariance))
        outside = self.scale[:, np.newaxis] * inside
        return dataclasses.replace(self, covariance=outside @ _at_least(other, own) @ outside.T)

    def plus(self, covariance: Vector) -> Uncertainty:
        """The same with the covariance of an error that is not in the residuals besides."""
        return dataclasses.replace(self, covariance=self.covariance + covariance)

    def shift_by(self, solution: Solution, prior_slopes: Vector, torques: Vector) -> Vector:
        """Changes of the parameters that make up for changes of the torques of the model at the rows that were fitted.

        ``−H⁻¹ Xᵀ t``, within the directions that are measured: X and t are in units of the scatter, as in H.
        """
        root, known = weighted_derivatives(solution) * self.scale, prior_slopes * self.scale
        inside = self.directions.measured_directions
        slopes, _, inverse = _within(inside, root, known)
        changes = np.where(solution.outlying, 0.0, np.sqrt(solution.curvature) / solution.scatter * torques)
        return np.asarray(-self.scale * (inside @ (inverse @ (slopes.T @ changes))), dtype=np.float64)

    def variance_of(self, gradients: Vector) -> Vector:
        """Variance of a quantity with these derivatives by the parameters, along the last axis.

        NaN where the quantity depends on an unidentifiable direction.
        """
        scaled = gradients * self.scale
        length = np.linalg.norm(scaled, axis=-1)
        unidentifiable = np.linalg.norm(scaled @ self.directions.unidentifiable_directions, axis=-1)
        variance = np.einsum("...i,ij,...j", gradients, self.covariance, gradients)
        return np.where(unidentifiable > UNIDENTIFIABLE_SHARE * length, np.nan, variance)


def _within(inside: Vector, root: Vector, known: Vector) -> tuple[Vector, Vector, Vector]:
    """Derivatives of rows by directions, what priors know of these, and the inverse of what both know."""
    slopes = root @ inside
    prior = inside.T @ (known.T @ known) @ inside
    return slopes, prior, np.asarray(np.linalg.inv(slopes.T @ slopes + prior), dtype=np.float64)


def _at_least(one: Vector, other: Vector) -> Vector:
    """The first covariance, raised in every direction to at least the second."""
    if not other.any():  # no residuals: as many numbers as rows, or rows followed exactly
        return one
    root = np.linalg.cholesky(other + 1e-14 * np.trace(other) * np.eye(other.shape[0]))
    ratios, directions = np.linalg.eigh(np.linalg.solve(root, np.linalg.solve(root, one).T))
    back = root @ directions
    return np.asarray(back * np.maximum(ratios, 1.0) @ back.T, dtype=np.float64)


def long_run_covariance(scores: Vector, longest_lag: int) -> Vector:
    """Sum of products of scores, with those of rows up to a lag apart, weighted as in NeweyWest1987."""
    spread = scores.T @ scores
    for lag in range(1, longest_lag + 1):
        crossed = scores[lag:].T @ scores[:-lag]
        spread = spread + (1 - lag / (longest_lag + 1)) * (crossed + crossed.T)
    return spread


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
