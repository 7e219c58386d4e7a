"""Sensitivity of an output to its uncertain inputs: by variance, by screening, and by derivatives."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.displayed import LINES_OF_REPR, Displayed, shortened
from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any, renamed_keyword
from ballscrew.basis.quantities import AngularSpeed, Force, Quantity
from ballscrew.engine.evaluation.derivatives import JAX_INSTEAD, derivatives
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution, distribution_fault, within
from ballscrew.engine.uncertainty.monte_carlo import Sampler, sobol_sequence
from ballscrew.engine.uncertainty.sobol import EXPLAINED, Estimate, Function, finite, resampled_means, sobol_indices
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

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


class Swing(NamedTuple):
    """An output with one input at the lower and at the upper end of its distribution, all others at their medians."""

    input: str
    at_lower: float
    at_upper: float

    @property
    def ends(self) -> tuple[float, float]:
        """The lesser and the greater of the two."""
        return min(self.at_lower, self.at_upper), max(self.at_lower, self.at_upper)

    @property
    def width(self) -> float:
        """Distance between the two; NaN where either is no number."""
        return abs(self.at_upper - self.at_lower)


def one_at_a_time(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    uncertain: Mapping[str, Distribution],
    axial_load: Force,
    screw_speed: AngularSpeed,
    output: str = "screw_torque",
    level: float = 0.95,
) -> Sequence[Swing]:
    """The swing of an ``output`` for each of the ``uncertain`` inputs, the widest first.

    The ends of an input leave ``(1 - level) / 2`` of its distribution below and above. It costs two evaluations for
    each input. What inputs do together, and the correlation that a fit leaves, is not in it: their sum is no band.
    Swings without a number come last. Raises :class:`~ballscrew.basis.errors.InputError` for unknown names.
    """
    if not uncertain:
        return ()
    subject = Configuration(model, screw, lubricant)
    known = subject.inputs
    inputs = {name: within(distribution, known[name][1].info) for name, distribution in uncertain.items()}
    point = {"axial_load": axial_load, "screw_speed": screw_speed}
    fixed = {name: value for name, value in point.items() if name not in inputs}
    shares = np.full((len(inputs), 2 * len(inputs)), 0.5)
    for place in range(len(inputs)):
        shares[place, 2 * place : 2 * place + 2] = (1 - level) / 2, (1 + level) / 2
    values = Sampler(subject, inputs, fixed, (output,)).evaluate(shares)[output]
    swings = [Swing(name, *map(float, values[2 * i : 2 * i + 2])) for i, name in enumerate(inputs)]
    return sorted(swings, key=lambda swing: (-np.nan_to_num(swing.width, nan=-1.0), swing.input))


#: How sensitivities can be had.
Method = Literal["sobol", "morris", "local"]
METHODS: tuple[Method, ...] = get_args(Method)
#: Default samples: of each of the inputs + 2 sets, and trajectories. Whole nuts take their time.
SAMPLES: Mapping[Method, int] = {"sobol": 2**12, "morris": 2**6}
NUT_SAMPLES: Mapping[Method, int] = {"sobol": 2**9, "morris": 2**5}
MINIMUM_SAMPLES: Mapping[Method, int] = {"sobol": 2**4, "morris": 2**2}
#: All samples of all sets are in memory.
MAXIMUM_SAMPLES = 2**18
#: What each method says of an input; the first ranks the inputs.
MEASURES: Mapping[Method, tuple[str, ...]] = {
    "sobol": ("total", "first_order"),
    "morris": ("effect", "effect_deviation"),
    "local": ("effect", "share"),
}
#: A band is halved where this much of the standard deviation is left.
HALF = 0.5
#: Standard normal numbers over which means and deviations of inputs are found: the rule of equal steps, which
#: converges faster than any power of the step where the quantile is smooth.
_REACH, _STEP = 7.5, 0.01
#: What to do where there are no derivatives.
ANOTHER_METHOD = 'take method="sobol" or "morris"'


class ExplainedVariance(NamedTuple):
    """Some inputs, and the share of the standard deviation of the output that remains if they are known exactly."""

    inputs: tuple[str, ...]
    remaining: float


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Sensitivity(Displayed):
    """Result of :func:`sensitivity` for one output, in SI."""

    method: Method
    output: str
    quantity: Quantity
    #: The uncertain inputs, the one that matters most first.
    inputs: tuple[str, ...]
    #: What the method says of each input, by measure and input: see :data:`MEASURES`.
    measures: Mapping[str, Mapping[str, Estimate]]
    #: Mean of the output over all samples; with ``"local"`` its value at the medians of the inputs.
    mean: float
    #: Standard deviation of the output; with ``"local"`` that of the tangent; NaN with ``"morris"``.
    deviation: float
    #: The largest inputs by first-order index (share), one more each time. Nothing with ``"morris"``.
    explained_variance: tuple[ExplainedVariance, ...]
    level: float
    samples: int
    seed: int
    evaluations: int
    #: Samples (trajectories) that were left out, as they have no finite number somewhere.
    left_out: int = 0

    def __repr__(self) -> str:
        """The inputs, the one that matters most first, in ten lines at most."""
        unit = "" if self.quantity.unit == "1" else f" {self.quantity.unit}"
        deviation = "" if math.isnan(self.deviation) else f", standard deviation {self.deviation:.3g}{unit}"
        heading = f"Sensitivity of {self.output}, {self.method}: mean {self.mean:.6g}{unit}{deviation}"
        lines = [
            f"{name}: " + ", ".join(f"{measure} {of[name].value:.3g}" for measure, of in self.measures.items())
            for name in self.inputs
        ]
        return "\n".join([heading, *shortened(lines, LINES_OF_REPR - 1)])

    @property
    def first_order(self) -> Mapping[str, Estimate]:
        """The share of the variance that each input has by itself. Nothing with ``"morris"``."""
        return self.measures.get("first_order", self.measures.get("share", {}))

    @property
    def total(self) -> Mapping[str, Estimate]:
        """The share of the variance in which each input has a part. Only with ``"sobol"``."""
        return self.measures.get("total", {})

    @property
    def effect(self) -> Mapping[str, Estimate]:
        """The change of the output for a change of each input by its standard deviation. Not with ``"sobol"``."""
        return self.measures.get("effect", {})

    @property
    def is_constant(self) -> bool:
        """True where no input has any effect."""
        return all(estimate.value == 0 for estimate in self.measures[MEASURES[self.method][0]].values())

    def left_if_known(self, name: str) -> float:
        """The share √(1 − S) of the standard deviation that is left, on average, where one input is known exactly.

        NaN with ``"morris"``, which says nothing of variances, and where the output is constant.
        """
        if not self.first_order or self.is_constant:
            return math.nan
        return math.sqrt(min(max(1 - self.first_order[name].value, 0.0), 1.0))

    @property
    def to_halve(self) -> ExplainedVariance | None:
        """The inputs to find out, from the largest, so that half of the standard deviation is left, or less.

        None with ``"morris"``, and where the output is constant.
        """
        return next((known for known in self.explained_variance if known.remaining <= HALF), None)


@renamed_keyword("uncertain", "distributions")
def sensitivity(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    distributions: Mapping[str, Distribution],
    output: str = "screw_torque",
    method: Method = "sobol",
    samples: int | None = None,
    seed: int = 0,
    level: float = 0.95,
    done: Callable[[int, int], None] | None = None,
    **fixed: Any,
) -> Sensitivity:
    r"""Sensitivity of an ``output`` to its uncertain inputs: a :class:`Sensitivity`.

    ``model``, ``screw`` and ``lubricant`` have the values of all other inputs. ``distributions`` names inputs as
    :func:`~ballscrew.engine.sweeps.sweep.sweep` does, ``fixed`` gives numbers to others; between them they have
    ``axial_load`` and ``screw_speed``. Inputs are independent of each other and stay within their bounds. The
    ``method`` is one of three:

    * ``"sobol"``: shares of the variance of the output, first-order and total
      (:func:`~ballscrew.engine.uncertainty.sobol.sobol_indices`), from ``samples`` (inputs + 2) evaluations and at
      most as many again for ``explained_variance``; ``samples`` is a power of two.
    * ``"morris"``: the mean absolute effect of an input along ``samples`` trajectories, and the
      deviation of its effects (:func:`~ballscrew.engine.uncertainty.sensitivity.elementary_effects`), from ``samples``
      (inputs + 1) evaluations.
    * ``"local"``: exact derivatives (:func:`~ballscrew.engine.evaluation.derivatives.derivatives`) at the medians
      of the inputs times their standard deviations, :math:`e_i = \sigma_i\,\partial y/\partial x_i`, and
      the shares :math:`e_i^2/\sum_j e_j^2` they would have if the output were its tangent.

    Effects are in the unit of the output for one standard deviation of the input, so that of a linear model
    all methods say the same. The same ``seed`` gives the same numbers. Intervals hold with
    probability ``level``. ``done(finished, total)`` is told the evaluations.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, bad values, an output that is true or
    false or that has no finite value in more than a tenth of the samples, and where there are no derivatives.
    """
    subject = Configuration(model, screw, lubricant)
    usual = NUT_SAMPLES if screw.nut.one_by_one else SAMPLES
    count = usual.get(method, 1) if samples is None else samples
    raise_if_any(_faults(subject, distributions, output, method, samples, seed, level))
    sampler = Sampler(subject, distributions, {n: v for n, v in fixed.items() if n not in distributions}, (output,))
    if method == "local":
        return _local(sampler, output, level, seed)

    def function(shares: NDArray[np.float64]) -> NDArray[np.float64]:
        return sampler.evaluate(shares, done)[output]

    names = sampler.names
    estimates: Sequence[Sequence[Estimate]]
    if method == "sobol":
        of_variance = sobol_indices(function, len(names), count, seed, level)
        estimates, result = (of_variance.total, of_variance.first_order), of_variance
        deviation = of_variance.deviation
        explained_variance = tuple(
            ExplainedVariance(tuple(names[i] for i in known), left) for known, left in of_variance.known
        )
    else:
        in_deviations = functools.partial(_in_deviations, sampler, _deviations(sampler))
        screened = elementary_effects(function, in_deviations, len(names), count, seed, level)
        estimates, result = (screened.mean_absolute, screened.deviation), screened
        deviation, explained_variance = math.nan, ()
    by_name = [dict(zip(names, of_measure, strict=True)) for of_measure in estimates]
    return Sensitivity(
        method=method,
        output=output,
        quantity=known_outputs(screw.nut)[output].quantity,
        inputs=_ranked(by_name[0]),
        measures=dict(zip(MEASURES[method], by_name, strict=True)),
        mean=result.mean,
        deviation=deviation,
        explained_variance=explained_variance,
        level=level,
        samples=count,
        seed=seed,
        evaluations=result.evaluations,
        left_out=result.left_out,
    )


def _faults(
    subject: Configuration,
    uncertain: Mapping[str, Distribution],
    output: str,
    method: Any,
    samples: Any,
    seed: Any,
    level: Any,
) -> list[Fault]:
    """Faults of the arguments, except for the values of inputs."""
    known, wanted = subject.inputs, known_outputs(subject.nut)
    result = (
        distribution_fault(f"sensitivity.distributions.{name}", name, given, known, "leave it out")
        for name, given in uncertain.items()
    )
    faults = [fault for fault in result if fault is not None]
    if not uncertain:
        remedy = 'give a distribution to an input: {"viscosity": LogNormal(0.1, 1.3)}'
        faults.append(Fault("sensitivity.distributions", "no input is uncertain", "", remedy))
    if output not in wanted:
        faults.append(Fault("sensitivity.output", "unknown output", output, nearest(output, wanted)))
    elif wanted[output].dtype is bool:
        faults.append(Fault("sensitivity.output", "is true or false, and has no variance", output, "choose a number"))
    if method not in METHODS:
        faults.append(Fault("sensitivity.method", "unknown method", str(method), f"one of {', '.join(METHODS)}"))
    elif method == "local" and subject.nut.one_by_one:
        faults.append(Fault("sensitivity.method", "has no derivatives where balls differ", method, ANOTHER_METHOD))
    if not isinstance(seed, int | np.integer) or seed < 0:
        faults.append(Fault("sensitivity.seed", "must be a whole number, 0 or more", str(seed)))
    if not 0 < level < 1:
        faults.append(Fault("sensitivity.level", "must lie between 0 and 1", str(level), "0.95 is usual"))
    if samples is not None and method in METHODS:
        faults += _faults_of_samples(samples, method)
    return faults


def _faults_of_samples(samples: Any, method: Method) -> list[Fault]:
    where = "sensitivity.samples"
    if method == "local":
        return [Fault(where, "does not count with local, which takes no samples", str(samples), "leave it out")]
    if not isinstance(samples, int | np.integer) or samples < MINIMUM_SAMPLES[method]:
        return [Fault(where, f"must be a whole number, {MINIMUM_SAMPLES[method]} or more", str(samples))]
    if samples > MAXIMUM_SAMPLES:
        return [Fault(where, f"must be at most {MAXIMUM_SAMPLES}", str(samples), "all are in memory")]
    if method == "sobol" and samples & (samples - 1):
        below = 2 ** (int(samples).bit_length() - 1)
        return [Fault(where, "must be a power of two", str(samples), f"take {below} or {2 * below}")]
    return []


def _local(sampler: Sampler, output: str, level: float, seed: int) -> Sensitivity:
    names, subject = sampler.names, sampler.subject
    medians = {name: float(v[0]) for name, v in sampler.inputs_at(np.full((len(names), 1), 0.5)).items()}
    points: dict[str, Any] = {**sampler.fixed, **medians}
    try:
        slopes = derivatives(subject.model, subject.screw, subject.lubricant, by=names, outputs=(output,), **points)
    except InputError as error:  # there, JAX is another way to derivatives; here, there are ways without
        changed = (
            dataclasses.replace(f, remedy=ANOTHER_METHOD) if f.remedy == JAX_INSTEAD else f for f in error.faults
        )
        raise InputError(*changed) from None
    deviations = _deviations(sampler)
    effects = {n: float(slopes[f"d_{output}_d_{n.replace('.', '_')}"]) * deviations[n] for n in names}
    raise_if_any(
        [
            Fault(f"sensitivity.distributions.{name}", "has no slope here", output, ANOTHER_METHOD)
            for name, effect in effects.items()
            if not math.isfinite(effect)
        ]
    )
    deviation = math.hypot(*effects.values())
    shares = {name: (effect / deviation) ** 2 if deviation else 0.0 for name, effect in effects.items()}
    by_name = [{name: Estimate(v, v, v) for name, v in of_measure.items()} for of_measure in (effects, shares)]
    ranked = _ranked(by_name[0])
    effective = sum(share > 0 for share in shares.values())
    explained = np.cumsum([shares[name] for name in ranked])
    explained[effective - 1 :] = 1.0  # but for rounding it is
    enough = min(int(np.searchsorted(explained, EXPLAINED)) + 1, effective)
    explained_variance = [
        ExplainedVariance(ranked[: k + 1], math.sqrt(max(1 - explained[k], 0.0))) for k in range(enough)
    ]
    return Sensitivity(
        method="local",
        output=output,
        quantity=known_outputs(subject.nut)[output].quantity,
        inputs=ranked,
        measures=dict(zip(MEASURES["local"], by_name, strict=True)),
        mean=float(slopes[output]),
        deviation=deviation,
        explained_variance=tuple(explained_variance),
        level=level,
        samples=1,
        seed=seed,
        evaluations=1,
    )


def _ranked(estimates: Mapping[str, Estimate]) -> tuple[str, ...]:
    return tuple(sorted(estimates, key=lambda name: -abs(estimates[name].value)))


def _deviations(sampler: Sampler) -> dict[str, float]:
    """The standard deviations of the inputs within their bounds, whatever their distributions."""
    from scipy.special import ndtr

    normal = np.arange(-_REACH, _REACH + _STEP, _STEP)
    weights = np.exp(-(normal**2) / 2)
    weights /= np.sum(weights)
    shares = np.tile(ndtr(normal), (len(sampler.names), 1))
    drawn = sampler.inputs_at(shares)
    return {n: math.sqrt(float(weights @ (v - weights @ v) ** 2)) for n, v in drawn.items()}


def _in_deviations(
    sampler: Sampler, deviations: Mapping[str, float], shares: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The values of the inputs for shares, in standard deviations of each."""
    drawn = sampler.inputs_at(shares)
    return np.array([drawn[name] / deviations[name] for name in sampler.names])
