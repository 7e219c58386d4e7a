"""Samples of uncertain inputs, evenly spread, and what a model makes of them.

A sample is one number between 0 and 1 for each input: the share of its distribution that lies below.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.engine.evaluation.engines import SweepEngine
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.uncertainty.distributions import Distribution, allowed, standard_normal_quantile


@dataclasses.dataclass(frozen=True, eq=False)
class JointNormal:
    """Inputs that are normal and correlated, as a fit leaves them: their means and their covariance."""

    names: tuple[str, ...]
    mean: NDArray[np.float64]
    covariance: NDArray[np.float64]

    def quantiles(self, shares: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """The values for independent shares of shape (inputs, samples): mean + L Φ⁻¹(share), L Lᵀ the covariance.

        A covariance of less than full rank is as good as any.
        """
        variances, directions = np.linalg.eigh(self.covariance)
        root = directions * np.sqrt(np.maximum(variances, 0.0))
        drawn = self.mean[:, np.newaxis] + root @ standard_normal_quantile(shares)
        return dict(zip(self.names, drawn, strict=True))


@dataclasses.dataclass(frozen=True, eq=False)
class JointSamples:
    """Inputs that depend on each other, known by samples of both: names, and their values by samples."""

    names: tuple[str, ...]
    values: NDArray[np.float64]

    def quantiles(self, shares: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """The samples whose first input has the first of the shares below it; the other shares are not needed."""
        order = np.argsort(self.values[0])
        chosen = order[np.minimum((shares[0] * order.size).astype(int), order.size - 1)]
        return dict(zip(self.names, self.values[:, chosen], strict=True))


@dataclasses.dataclass(frozen=True, eq=False)
class JointParts:
    """Groups of inputs that depend on each other within a group alone."""

    parts: tuple[JointNormal | JointSamples, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The inputs of all groups."""
        return tuple(name for part in self.parts for name in part.names)

    def quantiles(self, shares: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """The values of all groups for independent shares."""
        quantiles: dict[str, NDArray[np.float64]] = {}
        for part in self.parts:
            quantiles |= part.quantiles(shares[len(quantiles) : len(quantiles) + len(part.names)])
        return quantiles


Joint: TypeAlias = JointNormal | JointSamples | JointParts


@dataclasses.dataclass(frozen=True, eq=False)
class Sampler:
    """A model on a screw, its uncertain inputs, the numbers given to others, and what is wanted of it.

    Inputs are named as in :func:`~ballscrew.engine.sweeps.sweep.sweep`. Those of ``joint`` depend on each other.
    """

    subject: Configuration
    inputs: Mapping[str, Distribution]
    fixed: Mapping[str, Any]
    outputs: Sequence[str]
    joint: Joint | None = None
    engine: SweepEngine | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The uncertain inputs, in the order of the shares; those that depend on each other come last."""
        return (*self.inputs, *(() if self.joint is None else self.joint.names))

    def inputs_at(self, shares: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """The values of the inputs for shares of shape (inputs, samples), within the bounds of each."""
        alone = len(self.inputs)
        values = {
            name: np.asarray(distribution.quantile(row))
            for (name, distribution), row in zip(self.inputs.items(), shares[:alone], strict=True)
        }
        values |= {} if self.joint is None else self.joint.quantiles(shares[alone:])
        known = self.subject.inputs
        return {name: np.clip(drawn, *allowed(known[name][1].info)) for name, drawn in values.items()}

    def evaluate(
        self, shares: NDArray[np.float64], done: Callable[[int, int], None] | None = None
    ) -> dict[str, NDArray[Any]]:
        """The outputs for shares of shape (inputs, samples), by name.

        Raises :class:`~ballscrew.basis.errors.InputError` for unknown names and values that are refused.
        """
        axes = {name: xr.DataArray(drawn, dims="sample") for name, drawn in self.inputs_at(shares).items()}
        plan = Plan.of(self.subject, self.outputs, {**self.fixed, **axes}, "samples")
        evaluation = Evaluation.of(plan, self.engine)
        results = evaluation.empty(plan.total)
        evaluation.fill(results, slice(0, plan.total), done=done)
        return {name: np.asarray(values) for name, values in results.items()}


def sobol_sequence(inputs: int, samples: int, seed: int = 0) -> NDArray[np.float64]:
    """Shares of shape (inputs, samples) from a scrambled Sobol' sequence, strictly between 0 and 1.

    A power of two of samples is spread the most evenly. The same seed gives the same shares.
    """
    from scipy.stats import qmc  # half a second: for those only who sample

    sequence = qmc.Sobol(inputs, rng=np.random.default_rng(seed))
    exponent = max(0, int(np.ceil(np.log2(samples))))
    shares = sequence.random_base2(exponent)[:samples].T
    least = 0.5**32  # beyond it there are no points, and at 0 and 1 no quantiles
    return np.clip(np.ascontiguousarray(shares), least, 1 - least)
