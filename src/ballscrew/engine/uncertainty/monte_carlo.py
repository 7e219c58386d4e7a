"""Monte Carlo: what the uncertainty of the inputs makes of the results.

Random numbers are those of NumPy's Philox, whose state follows from the seed and the number of a block: blocks may be
drawn in any order, on any thread.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.arrays import map_blocks
from ballscrew.basis.errors import MISSING, Fault, raise_if_any
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import OPERATION, attributes_of
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import Engine, SweepEngine, engine_faults
from ballscrew.engine.uncertainty.distributions import (
    Distribution,
    allowed,
    distribution_fault,
    standard_normal_quantile,
    within,
)
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel


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


#: Samples of a block, which is drawn and evaluated on one thread.
BLOCK = 2**16
#: Seeds are less than this.
SEEDS = 2**63
#: No share is less: that of zero is no number for most distributions.
LEAST_SHARE = 2.0**-54


def monte_carlo(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    distributions: Mapping[str, Distribution],
    samples: int,
    seed: int = 0,
    outputs: Sequence[str] | None = None,
    quantiles: Sequence[float] = (0.025, 0.5, 0.975),
    engine: Engine | None = None,
    threads: int | None = None,
    done: Callable[[int, int], None] | None = None,
    **fixed: Any,
) -> xr.Dataset:
    """Evaluate a model over random samples of its inputs, and return how its results are distributed, as a dataset.

    ``model``, ``screw`` and ``lubricant`` have the values of all other inputs. ``distributions`` names uncertain inputs
    as :func:`~ballscrew.engine.sweeps.sweep.sweep` names what it varies, ``fixed`` gives single numbers to others;
    between them they have ``axial_load`` and ``screw_speed``. Inputs are independent of each other. Of ``samples``
    samples, sample i of input j, in the order of the mapping, is the quantile of a uniform number that depends on i, j
    and the ``seed`` alone: the dataset is the same to the last bit for any number of ``threads``, and engines agree to
    rounding. ``outputs`` are named as those of a sweep.

    Of each output ``x`` that is a number the dataset has ``x_mean``, ``x_standard_deviation``, ``x_minimum``,
    ``x_maximum``, ``x_quantiles`` along ``quantile`` (the shares ``quantiles``) and ``x_missing_share``, that of
    samples which are NaN and left out of the others; of each that is true or not, ``x_share``, where it is true.
    ``invalid_share`` is that of samples that are not valid; an input beyond its bounds is a reason too. They are
    counted in all the same. The values of the outputs are in memory until all are known.

    The ``engine`` is chosen by the size of the work; ``done(finished, total)`` is told the progress.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, missing or bad values, and an
    engine that cannot be had.
    """
    subject = Configuration(model, screw, lubricant)
    faults = _faults_of_options(samples, seed, quantiles, engine, threads)
    raise_if_any(faults + _faults_of_inputs(subject, distributions, fixed))
    plan = _planned(subject, outputs, distributions, fixed)
    evaluation = Evaluation.of(plan, engine, max(1, samples // plan.total), section="monte_carlo")
    results = evaluation.empty(samples)

    def evaluate(block: slice) -> None:
        drawn = zip(distributions.items(), shares(block, len(distributions), seed), strict=True)
        points = {name: np.asarray(distribution.quantile(share)) for (name, distribution), share in drawn}
        here = {name: values[block] for name, values in results.items()}
        evaluation.at(points).fill(here, slice(0, block.stop - block.start), threads=1)

    map_blocks(
        evaluate,
        samples,
        block_size=BLOCK,
        threads=threads,
        done=None if done is None else lambda finished: done(finished, samples),
    )
    known = subject.inputs
    words = {
        f"distribution_{known[name][0]}_{name.replace('.', '_')}": distribution.describe(known[name][1].unit)
        for name, distribution in distributions.items()
    }
    of_quantile = {"long_name": "share of the samples that lies below", "units": "1"}
    coordinates = {name: ((), value, attributes_of(known[name][1])) for name, value in plan.fixed.items()}
    variables: dict[str, Any] = {}
    for name, values in results.items():
        attributes = attributes_of(plan.wanted[name].quantity)
        if values.dtype == bool:
            variables |= _truths(name, attributes["long_name"], values)
        else:
            variables |= _numbers(name, attributes, Statistics.of(values, quantiles))
    return xr.Dataset(
        variables,
        {"quantile": ("quantile", np.asarray(quantiles, dtype=float), of_quantile), **coordinates},
        plan.attributes | {"samples": samples, "seed": seed, **words} | evaluation.attributes,
    )


def shares(block: slice, inputs: int, seed: int) -> NDArray[np.float64]:
    """Uniform random numbers between 0 and 1, ends excluded, of shape (inputs, samples), for the samples of a block.

    They are the same however long the block is; it begins at a multiple of ``BLOCK``.
    """
    random = np.random.Generator(np.random.Philox(key=seed, counter=[0, 0, block.start // BLOCK, 0]))
    drawn = random.random((block.stop - block.start, inputs))
    return np.ascontiguousarray(np.maximum(drawn, LEAST_SHARE).T)


class Statistics(NamedTuple):
    """Distribution of numbers; NaN where there are none, and infinite where some are."""

    mean: float
    #: √(Σ(x − x̄)²/(n − 1)); NaN of one number, and of infinite ones.
    standard_deviation: float
    minimum: float
    maximum: float
    quantiles: NDArray[np.float64]
    #: The share of the values that are NaN, which are left out of the others.
    missing_share: float

    @classmethod
    def of(cls, values: NDArray[np.float64], quantiles: Sequence[float]) -> Statistics:
        """The statistics of values, at least one, with quantiles as ``numpy.quantile`` has them."""
        missing = np.isnan(values)
        there = values[~missing]
        share = np.count_nonzero(missing) / values.size
        if not there.size:
            return cls(np.nan, np.nan, np.nan, np.nan, np.full(len(quantiles), np.nan), share)
        least, greatest = float(there.min()), float(there.max())
        with np.errstate(all="ignore"):  # infinities
            if least == greatest:  # the sums of equal numbers are rounded
                mean, deviation = least, 0.0 if there.size > 1 and np.isfinite(least) else np.nan
            else:
                mean, deviation = float(there.mean()), float(there.std(ddof=1))
            # between infinities there is nothing to interpolate
            method = "linear" if math.isfinite(greatest - least) else "higher"
            by_share = np.quantile(there, quantiles, method=method, overwrite_input=True)
        return cls(mean, deviation, least, greatest, by_share, share)


#: The names of statistics with their words.
_STATISTICS = {
    "mean": "mean of",
    "standard_deviation": "standard deviation of",
    "minimum": "least",
    "maximum": "largest",
}


def _numbers(name: str, attributes: Mapping[str, str], statistics: Statistics) -> dict[str, tuple[Any, ...]]:
    """The variables of an output that is a number."""
    meaning = attributes["long_name"]
    variables: dict[str, tuple[Any, ...]] = {}
    for statistic, words in _STATISTICS.items():
        of_this = {**attributes, "long_name": f"{words} {meaning}", "cell_methods": f"realization: {statistic}"}
        variables[f"{name}_{statistic}"] = ((), getattr(statistics, statistic), of_this)
    of_quantiles = {**attributes, "long_name": f"quantiles of {meaning}"}
    of_missing = {"long_name": f"share of samples without a value of {meaning}", "units": "1"}
    variables[f"{name}_quantiles"] = ("quantile", statistics.quantiles, of_quantiles)
    variables[f"{name}_missing_share"] = ((), statistics.missing_share, of_missing)
    return variables


def _truths(name: str, meaning: str, values: NDArray[np.bool_]) -> dict[str, tuple[Any, ...]]:
    """The variable of an output that is true or not: the share where it is; of ``valid``, where it is not."""
    share, words = float(np.mean(values)), f"share of samples with {meaning}"
    if name == "valid":
        name, share = "invalid", np.count_nonzero(~values) / values.size
        words = "share of samples where the model is not to be trusted"
    return {f"{name}_share": ((), share, {"long_name": words, "units": "1"})}


def _faults_of_options(samples: Any, seed: Any, quantiles: Any, engine: Any, threads: Any) -> list[Fault]:
    faults = [
        Fault(f"monte_carlo.{name}", "must be a whole number, 1 or more", str(value))
        for name, value in {"samples": samples, "threads": 1 if threads is None else threads}.items()
        if not isinstance(value, int | np.integer) or value < 1
    ]
    if not isinstance(seed, int | np.integer) or not 0 <= seed < SEEDS:
        faults.append(Fault("monte_carlo.seed", "must be a whole number from 0 to 2^63 − 1", str(seed)))
    faults += [
        Fault("monte_carlo.quantiles", "must lie between 0 and 1", str(share), "0.5 is the median")
        for share in quantiles
        if not 0 <= share <= 1
    ]
    return faults + engine_faults("monte_carlo", engine)


def _faults_of_inputs(
    subject: Configuration, distributions: Mapping[str, Any], fixed: Mapping[str, Any]
) -> list[Fault]:
    """Faults that a sweep would not find, or would not put in these words."""
    known = subject.inputs
    given = {*distributions, *fixed}
    faults: list[Fault] = []
    if not distributions:
        faults.append(Fault("monte_carlo.distributions", "is empty", "", "name at least one uncertain input"))
    for name in OPERATION:
        if name not in given:
            remedy = f"give {name}=… or a distribution of it"
            faults.append(Fault(f"monte_carlo.{name}", MISSING, "", remedy))
    for name, distribution in distributions.items():
        where = f"monte_carlo.distributions.{name}"
        fault = distribution_fault(where, name, distribution, known, f"give {name}=…")
        faults += [] if fault is None else [fault]
        if name in fixed:
            faults.append(Fault(where, "is given as one number too", str(fixed[name]), "leave one of them out"))
    for name, value in fixed.items():
        if isinstance(value, Distribution):
            remedy = f'distributions={{"{name}": …}}'
            faults.append(Fault(f"monte_carlo.{name}", "is a distribution", str(value), remedy))
        elif np.ndim(value):
            faults.append(Fault(f"monte_carlo.{name}", "must be one number", "", "for several, call again for each"))
    for name, (part, _) in known.items():
        if part != "operation" and name not in given and np.ndim(subject.value_of(name)):
            faults.append(Fault(f"{part}.{name}", "is an array", "", "give one number, or a distribution of it"))
    return faults


def _planned(
    subject: Configuration,
    outputs: Sequence[str] | None,
    distributions: Mapping[str, Distribution],
    fixed: Mapping[str, Any],
) -> Plan:
    """Plan of a sweep over the ends or the middles of the distributions.

    So names, bounds and outputs are checked as they are there; whether samples are valid is always asked for.
    """
    named = (outputs,) if isinstance(outputs, str) else outputs or ()
    samples = {
        name: xr.DataArray(
            [distribution.characteristic_values[0], distribution.characteristic_values[-1]], dims="sample"
        )
        for name, distribution in distributions.items()
    }
    plan = Plan.of(subject, [*named, "valid"] if named else None, {**samples, **fixed}, "monte_carlo")
    known = subject.inputs
    bounded = all(
        within(distribution, known[name][1].info) == distribution for name, distribution in distributions.items()
    )
    return dataclasses.replace(plan, bounded=bounded)
