"""Bands: how far off a computed torque may be, because of its inputs and because of its laws.

Inputs are sampled from their distributions. Laws that could stand in a slot instead of the model's move the torque by
a factor, which is found once, at the central values; each sample draws a law for each slot.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, overload

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.displayed import Displayed
from ballscrew.basis.errors import Fault, accepts_units, nearest, raise_if_any, renamed_keyword
from ballscrew.basis.quantities import AngularSpeed, Force
from ballscrew.engine.evaluation.comparison import Candidate
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import Engine
from ballscrew.engine.uncertainty.band_evaluation import (
    DERIVED_OUTPUTS,
    POSITIVE,
    VALIDITY,
    Alternative,
    BandEvaluator,
    PointGroup,
    Sample,
    Values,
    bands_of,
    evaluated_outputs,
    faults_of_inputs,
    faults_of_options,
    quantiles,
    sample_law_factors,
    sample_probabilities,
    tails,
)
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.engine.uncertainty.monte_carlo import Joint
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction import directions
from ballscrew.physics.friction.model import (
    FrictionModel,
)

#: The ends of an interval, as the names of variables in a dataset end.
ENDS = ("low", "high")
#: The attribute of a dataset with the levels of its narrower intervals.
INNER_LEVELS = "band_inner_levels"
#: Default number of samples, and for a nut whose balls differ, every one of which is solved for.
SAMPLES, NUT_SAMPLES = 2**14, 2**10


class Interval(NamedTuple):
    """Two ends with a stated share of the samples between them, and as many below as above."""

    #: Lower end.
    low: float
    #: Upper end.
    high: float


@dataclasses.dataclass(frozen=True)
class OutputBand:
    """One output: its value at the central inputs, and where it lies if they and the laws are uncertain."""

    #: With the model's own laws, at the central values of the inputs.
    value: float
    median: float
    both: Interval
    #: What uncertain inputs alone make, with the model's own laws.
    parameters: Interval
    #: What other laws alone make, at the central values.
    model_form: Interval
    #: Share of the variance that is from the inputs: of the logarithm, or of the value where it may be negative.
    share_of_parameters: float
    #: Share of the samples that are no number, and left out.
    missing_share: float


class Narrowing(NamedTuple):
    """The band of the first output if one cause were known: an input by its name, or the law of a slot."""

    name: str
    #: Whether the cause is a slot of laws.
    of_laws: bool
    low: float
    high: float


@dataclasses.dataclass(frozen=True, eq=False)
class Band(Displayed):
    """Result of :func:`band`, by output."""

    level: float
    count: int
    seed: int
    outputs: Mapping[str, OutputBand]
    #: The laws that count, by slot; besides each, the model's own.
    alternatives: Mapping[str, Sequence[Alternative]]
    #: Share of the samples where a load cannot turn the screw by itself.
    self_locking_share: float
    #: Share of the samples that lie outside the validity of the model, and of each reason that occurs.
    invalid_share: float
    reasons: Mapping[str, float]
    #: Of the first output, what narrows its band the most where it is known; None for one that may be negative or where
    #: nothing is uncertain.
    narrowing: Narrowing | None = None
    #: The samples themselves, where they were asked for: inputs and outputs by name.
    samples: Mapping[str, Values] | None = None

    def __getitem__(self, output: str) -> OutputBand:
        """The band of an output."""
        return self.outputs[output]


@dataclasses.dataclass(frozen=True, eq=False)
class BandCurve:
    """The friction torque along a load or a speed, with its bands."""

    along: str
    points: Values
    value: Values
    median: Values
    both: tuple[Values, Values]
    parameters: tuple[Values, Values]
    count: int


@overload
def band(  # pyright: ignore[reportOverlappingOverload]  (numbers are no axes)
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    distributions: Mapping[str, Distribution],
    axial_load: float,
    screw_speed: float,
    alternatives: Sequence[Candidate] = (),
    joint: Joint | None = None,
    outputs: Sequence[str] = ("screw_torque",),
    samples: int | None = None,
    seed: int = 0,
    level: float = 0.95,
    engine: Engine | None = None,
    keep_samples: bool = False,
    done: Callable[[int, int], None] | None = None,
) -> Band: ...
@overload
def band(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    distributions: Mapping[str, Distribution],
    axial_load: Force,
    screw_speed: AngularSpeed,
    alternatives: Sequence[Candidate] = (),
    joint: Joint | None = None,
    outputs: Sequence[str] = ("screw_torque",),
    samples: int | None = None,
    seed: int = 0,
    level: float = 0.95,
    engine: Engine | None = None,
    keep_samples: bool = False,
    done: Callable[[int, int], None] | None = None,
    **varied: Any,
) -> xr.Dataset: ...
@renamed_keyword("uncertain", "distributions")
@accepts_units("band")
def band(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    distributions: Mapping[str, Distribution],
    axial_load: Force,
    screw_speed: AngularSpeed,
    alternatives: Sequence[Candidate] = (),
    joint: Joint | None = None,
    outputs: Sequence[str] = ("screw_torque",),
    samples: int | None = None,
    seed: int = 0,
    level: float = 0.95,
    engine: Engine | None = None,
    keep_samples: bool = False,
    done: Callable[[int, int], None] | None = None,
    **varied: Any,
) -> Band | xr.Dataset:
    """Intervals of outputs for uncertain inputs and alternative laws: a :class:`Band`, or a dataset over axes.

    ``model``, ``screw`` and ``lubricant`` have the central values. ``distributions`` names inputs as
    :func:`~ballscrew.engine.sweeps.sweep.sweep` does; they are independent, but for those of ``joint``. Each
    distribution is cut at the bounds of its quantity. ``axial_load`` (N) and ``screw_speed`` (rad/s) are the central
    ones; either may be among the uncertain.

    ``alternatives`` are models with one law changed. Of those that count and are valid at the central values, each
    has as good a chance as the model's own law of the slot, slots are independent, and a law moves the torque by the
    same factor everywhere. Without alternatives the band is that of the inputs alone.

    ``outputs`` are of :data:`~ballscrew.engine.uncertainty.band_evaluation.BAND_OUTPUTS`: the friction torque and
    quantities that follow from it. ``samples`` is 2^14, and 2^10 for a nut whose balls differ by default; a power of
    two is spread the most evenly. The same ``seed`` gives the same band. ``level`` is the share of the samples between
    the ends of an interval. ``engine`` is ``"numpy"`` or ``"compiled"``; without it the size of the work decides.
    ``done(finished, total)`` is told the samples evaluated. With ``keep_samples`` the :class:`Band` has the inputs and
    outputs of all samples.

    A load, a speed or ``varied`` inputs of several values are axes, as of
    :func:`~ballscrew.engine.sweeps.sweep.sweep`. Then the result is a dataset over them that has of each output ``x``
    the value ``x`` and the ends ``x_low`` and ``x_high``, the ``invalid_share`` of the samples, and its attributes
    ``band_level``, ``band_samples`` and ``band_seed``. At each point they are those of the band there: all points have
    the same random numbers. What is an axis is exact there.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, numbers out of bounds and an engine that
    cannot be had.
    """
    count = samples if samples is not None else NUT_SAMPLES if screw.nut.one_by_one else SAMPLES
    outputs = (outputs,) if isinstance(outputs, str) else tuple(dict.fromkeys(outputs))
    subject = Configuration(model, screw, lubricant)
    point = {"axial_load": axial_load, "screw_speed": screw_speed}
    faults = faults_of_options(outputs, count, seed, level, engine)
    if varied or any(map(np.ndim, point.values())):
        if keep_samples:
            faults.append(Fault("band.keep_samples", "is of one point", "True", "leave it out"))
        raise_if_any(faults)
        axes = Plan.of(subject, outputs, {**point, **varied}, "band")
        return _band_over(axes, distributions, joint, alternatives, count, seed, level, engine, done)
    raise_if_any([*faults, *faults_of_inputs(subject, distributions, joint)])
    evaluator = BandEvaluator.of(subject, distributions, joint, point, alternatives, engine, evaluated_outputs(outputs))
    shares = sample_probabilities(evaluator.dimensions, count, seed)
    result = evaluator.evaluate(shares, done)
    factor = sample_law_factors(evaluator.law_factors_at(0), shares[evaluator.inputs :])
    both = Sample(**{name: result[name] for name in evaluated_outputs(outputs)}, factor=factor)
    centre = Sample(
        **{name: np.full(1, float(getattr(evaluator.central, name))) for name in evaluated_outputs(outputs)}
    )
    parameters = both._replace(factor=np.ones(1))
    model_form = centre._replace(factor=factor)
    values = {name: float(np.asarray(getattr(evaluator.central, name))) for name in outputs}
    bands = {
        name: _band_of(
            name, values[name], [DERIVED_OUTPUTS[name](drawn) for drawn in (both, parameters, model_form)], level
        )
        for name in outputs
    }
    numbers = np.isfinite(both.torque)
    locks = directions.locks_itself(both.ideal_torque, both.torque)
    reasons = {name.removeprefix(VALIDITY): 1 - float(np.mean(result[name])) for name in evaluator.masks}
    kept = {
        **evaluator.sampler.inputs_at(shares[: evaluator.inputs]),
        **{name: DERIVED_OUTPUTS[name](both) for name in outputs},
    }
    return Band(
        level=level,
        count=count,
        seed=seed,
        outputs=bands,
        alternatives=evaluator.alternatives_at(0),
        self_locking_share=float(np.mean(locks[numbers])) if np.any(numbers) else float("nan"),
        invalid_share=1 - float(np.mean(result["valid"])),
        reasons={reason: share for reason, share in reasons.items() if share > 0},
        narrowing=_narrowing(evaluator, outputs[0], result, shares, level) if outputs else None,
        samples=kept if keep_samples else None,
    )


#: Samples are put into classes by the rank of an input, at most so many and of at least so many samples each: the mean
#: of a class is what the input explains. Fewer samples than two classes say nothing.
_CLASSES, _IN_A_CLASS = 32, 128


def _narrowing(
    evaluator: BandEvaluator, output: str, result: Mapping[str, NDArray[Any]], shares: Values, level: float
) -> Narrowing | None:
    """The narrowest of the bands that are left when one cause is known, and is as the model has it.

    A slot is known by the model's own law. What an input explains is the mean of the logarithm over its rank; without
    it the rest is left about the mean at its median.
    """
    classes = min(_CLASSES, shares.shape[1] // _IN_A_CLASS)
    if output not in POSITIVE or classes < 2:
        return None
    laws = evaluator.law_factors_at(0)
    drawn = Sample(**{name: result[name] for name in Sample._fields if name in result})
    of_laws = shares[evaluator.inputs :]
    values = DERIVED_OUTPUTS[output](drawn._replace(factor=sample_law_factors(laws, of_laws)))
    if not np.all(values > 0):
        return None
    ends: list[Narrowing] = []
    for place, name in enumerate(evaluator.ratios):
        kept = [np.ones(1) if i == place else factors for i, factors in enumerate(laws)]
        left = DERIVED_OUTPUTS[output](drawn._replace(factor=sample_law_factors(kept, of_laws)))
        ends.append(Narrowing(name, True, *quantiles(left, tails(level))))
    inputs = evaluator.sampler.inputs_at(shares[: evaluator.inputs])
    ends += [Narrowing(name, False, *_without(own, values, classes, level)) for name, own in inputs.items()]
    return min(ends, key=lambda one: one.high - one.low, default=None)


def _without(own: Values, values: Values, classes: int, level: float) -> list[float]:
    """The ends that are left of a positive output without what an input explains of its logarithm."""
    logs, ranks = np.log(values), np.argsort(np.argsort(own, kind="stable"), kind="stable")
    of_sample = ranks * classes // len(ranks)
    means = np.bincount(of_sample, logs) / np.bincount(of_sample)
    middle = (means[(classes - 1) // 2] + means[classes // 2]) / 2
    return [float(np.exp(end)) for end in quantiles(logs - means[of_sample] + middle, tails(level))]


def _band_over(
    axes: Plan,
    uncertain: Mapping[str, Distribution],
    joint: Joint | None,
    alternatives: Sequence[Candidate],
    count: int,
    seed: int,
    level: float,
    engine: Engine | None,
    done: Callable[[int, int], None] | None,
) -> xr.Dataset:
    """The bands over the axes of a plan, whose outputs are those that have a band."""
    alone = {name: distribution for name, distribution in uncertain.items() if name not in axes.varying}
    together = () if joint is None else joint.names
    remedy = "leave it out of one of them"
    faults = [Fault(f"band.{n}", "is an axis and among the joint ones", "", remedy) for n in axes.axes if n in together]
    raise_if_any([*faults, *faults_of_inputs(axes.subject, alone, joint)])
    values = {name: np.full(axes.total, float(value)) for name, value in axes.fixed.items()}
    values |= axes.points_at(np.arange(axes.total))
    group = PointGroup(axes.subject, alternatives, values, [alone] * axes.total, [joint] * axes.total)
    told = _told(done, axes.total * count)
    bands = bands_of(group, axes.outputs, count=count, seed=seed, level=level, engine=engine, done=told)
    ends = {name: bands.both[name] for name in axes.outputs}
    dataset = axes.dataset({name: np.array(bands.value[name]) for name in axes.outputs})
    return with_ends(dataset, ends, bands.invalid_share, level=level, count=count, seed=seed)


def with_ends(
    dataset: xr.Dataset,
    ends: Mapping[str, tuple[Values, Values]],
    invalid_share: Values,
    *,
    level: float,
    count: int,
    seed: int,
) -> xr.Dataset:
    """A dataset with the ends of the intervals of its variables beside them, as ``x_low`` and ``x_high``.

    ``invalid_share`` is, at each point, the share of the samples that lie outside the validity of the model.
    """
    result = dict[str, Any]()
    for name, both in ends.items():
        variable = dataset[name]
        for end, values in zip(ENDS, both, strict=True):
            words = f"{variable.attrs['long_name']}, {end} end of the band"
            attributes = {**variable.attrs, "long_name": words}
            result[f"{name}_{end}"] = (variable.dims, np.asarray(values).reshape(variable.shape), attributes)
    any_of_them = dataset[next(iter(ends))]
    words = "share of the samples outside the validity of the model"
    result["invalid_share"] = (
        any_of_them.dims, np.asarray(invalid_share).reshape(any_of_them.shape), {"units": "1", "long_name": words}
    )  # fmt: skip
    return dataset.assign(result).assign_attrs(band_level=level, band_samples=count, band_seed=seed)


def inner_end(name: str, end: str, level: float) -> str:
    """The variable with an end, "low" or "high", of the interval of an output with a share of the samples in it."""
    return f"{name}_{end}_of_{100 * level:g}"


def inner_levels(dataset: xr.Dataset) -> Sequence[float]:
    """The levels of the narrower intervals of a dataset; none where there are none."""
    return dataset.attrs.get(INNER_LEVELS, ())


@accepts_units("band")
def band_along(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    along: str,
    points: Sequence[float] | Values,
    distributions: Mapping[str, Distribution],
    axial_load: Force,
    screw_speed: AngularSpeed,
    alternatives: Sequence[Candidate] = (),
    joint: Joint | None = None,
    samples: int | None = None,
    seed: int = 0,
    level: float = 0.95,
    engine: Engine | None = None,
    done: Callable[[int, int], None] | None = None,
) -> BandCurve:
    """The friction torque with its bands at points ``along`` the load ("axial_load") or the speed ("screw_speed").

    As :func:`band`, with the same samples at all points; what it goes along is exact there. ``samples`` is an eighth
    of that of :func:`band` by default.

    Raises :class:`~ballscrew.basis.errors.InputError` as :func:`band` does.
    """
    count = samples if samples is not None else (NUT_SAMPLES if screw.nut.one_by_one else SAMPLES) // 8
    subject = Configuration(model, screw, lubricant)
    distributions = {name: distribution for name, distribution in distributions.items() if name != along}
    point: dict[str, Any] = {"axial_load": axial_load, "screw_speed": screw_speed}
    faults = [] if along in point else [Fault("band.along", "unknown", along, nearest(along, point))]
    faults += faults_of_options((), count, seed, level, engine)
    faults += [_not_one(name) for name, value in point.items() if np.ndim(value)]
    raise_if_any([*faults, *faults_of_inputs(subject, distributions, joint)])
    number = len(points)
    values = {name: np.full(number, float(value)) for name, value in point.items()}
    values[along] = np.asarray(points, dtype=float)
    group = PointGroup(subject, alternatives, values, [distributions] * number, [joint] * number)
    name, told = "screw_torque", _told(done, number * count)
    bands = bands_of(group, [name], count=count, seed=seed, level=level, engine=engine, done=told)
    return BandCurve(
        along, values[along], bands.value[name], bands.median[name], bands.both[name], bands.parameters[name], count
    )


def _told(done: Callable[[int, int], None] | None, total: int) -> Callable[[int], None] | None:
    return None if done is None else lambda finished: done(finished, total)


def _not_one(name: str) -> Fault:
    return Fault(f"band.{name}", "must be one number", "", "a curve goes along one of them")


def _band_of(name: str, value: float, drawn: Sequence[Values], level: float) -> OutputBand:
    """The band of an output from its samples: with both causes, with inputs alone, with laws alone."""
    both, parameters, model_form = drawn
    below, above = tails(level)
    low, median, high = quantiles(both, (below, 0.5, above))
    from_inputs, from_laws = (_variance(name, values) for values in (parameters, model_form))
    together = from_inputs + from_laws
    return OutputBand(
        value=value,
        median=median,
        both=Interval(low, high),
        parameters=Interval(*quantiles(parameters, (below, above))),
        model_form=Interval(*quantiles(model_form, (below, above))),
        share_of_parameters=from_inputs / together if together > 0 else float("nan"),
        missing_share=float(np.mean(np.isnan(both))),
    )


def _variance(name: str, values: Values) -> float:
    with np.errstate(all="ignore"):
        spread = np.log(values) if name in POSITIVE and np.all(values > 0) else values
        finite = spread[np.isfinite(spread)]
        if not finite.size:
            return float("nan")
        return float(np.var(finite)) if np.ptp(finite) else 0.0  # no roundings for a variance
