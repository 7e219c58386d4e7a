"""Parts of a band: evaluated samples, the factors of other laws, outputs derived from a torque, and faults.

At many points the random numbers are the same, and the samples of many points are evaluated at once.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.errors import (
    Fault,
    fault_of,
    nearest,
)
from ballscrew.engine.evaluation.comparison import Candidate
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import OPERATION, known_outputs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import SweepEngine, engine_faults
from ballscrew.engine.uncertainty.distributions import Distribution, distribution_fault, within
from ballscrew.engine.uncertainty.monte_carlo import Joint, Sampler, sobol_sequence
from ballscrew.physics.equations import transmission
from ballscrew.physics.friction import directions

#: How the outputs begin that say for which reason a sample is not valid.
VALIDITY = "validity_"
#: Slots whose laws are drawn wherever they give a torque: whether a track is full of oil is not measured, and answers
#: name the torque of a full bath whatever balls do in it.
NOT_MEASURED = frozenset({"inlet"})
#: Points that a Sobol' sequence of 30 bits has.
_MOST_SAMPLES = 2**30
Values = NDArray[np.float64]


class Sample(NamedTuple):
    """Outputs of the engine for each sample, and the factor of the laws drawn."""

    screw_torque: Values
    ideal_torque: Values
    drive_torque: Values
    #: Computed where it is wanted.
    friction_power: Values = np.full(1, np.nan)
    #: The torque with the laws drawn over that with the model's.
    factor: Values = np.ones(1)

    @property
    def torque(self) -> Values:
        """The friction torque with the laws drawn."""
        return self.screw_torque * self.factor

    @property
    def direction(self) -> Values:
        """The sign of the speed, by that of the friction in the torque on the shaft."""
        return directions.direction_of(self.drive_torque - self.ideal_torque)

    @property
    def back_driving_efficiency(self) -> Values:
        """Efficiency if the load drives the screw."""
        return transmission.back_driving_efficiency(directions.direct_efficiency(self.ideal_torque, self.torque))


#: What has a band: all of it follows from the friction torque.
DERIVED_OUTPUTS: Mapping[str, Callable[[Sample], Values]] = {
    "screw_torque": lambda drawn: drawn.torque,
    "drive_torque": lambda drawn: drawn.ideal_torque + drawn.direction * drawn.torque,
    "holding_torque": lambda drawn: directions.holding_torque(drawn.ideal_torque, drawn.torque),
    "friction_power": lambda drawn: drawn.friction_power * drawn.factor,
    "efficiency": lambda drawn: directions.efficiency(drawn.ideal_torque, drawn.torque, drawn.direction),
    "back_driving_efficiency": lambda drawn: drawn.back_driving_efficiency,
}
#: The outputs that may have a band.
BAND_OUTPUTS = tuple(DERIVED_OUTPUTS)
#: Those whose spread is that of their logarithm where they are positive.
POSITIVE = frozenset({"screw_torque", "drive_torque", "friction_power"})


@dataclasses.dataclass(frozen=True)
class Alternative:
    """A law that could stand in a slot instead: by how much it moves the torque, as a natural logarithm."""

    slot: str
    name: str
    shift: float


def evaluated_outputs(outputs: Sequence[str]) -> tuple[str, ...]:
    """Outputs that the engine evaluates for each sample, besides validity."""
    return (
        "screw_torque",
        "ideal_torque",
        "drive_torque",
        *(["friction_power"] if "friction_power" in outputs else []),
    )


@dataclasses.dataclass(frozen=True, eq=False)
class BandEvaluator:
    """Samples to evaluate, and the factors of the laws that may be drawn."""

    sampler: Sampler
    #: The result at the central values.
    central: Any
    #: By slot the laws that could be in it, with the torque of each over the model's; NaN where it is not valid.
    ratios: Mapping[str, Sequence[tuple[str, Values]]]

    @classmethod
    def of(
        cls,
        subject: Configuration,
        uncertain: Mapping[str, Distribution],
        joint: Joint | None,
        point: Mapping[str, Any],
        alternatives: Sequence[Candidate],
        engine: SweepEngine | None,
        computed: Sequence[str],
    ) -> BandEvaluator:
        """Evaluate the model and the alternatives at the central values."""
        known = subject.inputs
        inputs = {name: within(distribution, known[name][1].info) for name, distribution in uncertain.items()}
        fixed = {name: value for name, value in point.items() if name not in inputs}
        masks = [name for name in known_outputs(subject.nut) if name.startswith(VALIDITY)]
        sampler = Sampler(subject, inputs, fixed, (*computed, "valid", *masks), joint, engine)
        central = subject.at(point)
        ratios: dict[str, list[tuple[str, Values]]] = {}
        for candidate in alternatives:
            if candidate.counts and candidate.slot and candidate.model.knows(subject.nut):
                result = dataclasses.replace(subject, model=candidate.model).at(point)
                with np.errstate(all="ignore"):
                    ratio = np.asarray(result.screw_torque, dtype=float) / central.screw_torque
                    holds = _as_valid(result.validity, central.validity) | (candidate.slot in NOT_MEASURED)
                    usable = holds & np.isfinite(ratio) & (ratio > 0)
                ratios.setdefault(candidate.slot, []).append((candidate.name, np.where(usable, ratio, np.nan)))
        return cls(sampler, central, ratios)

    @property
    def masks(self) -> list[str]:
        """The outputs that say for which reason a sample is not valid."""
        return [name for name in self.sampler.outputs if name.startswith(VALIDITY)]

    @property
    def inputs(self) -> int:
        """Number of uncertain inputs."""
        return len(self.sampler.names)

    @property
    def dimensions(self) -> int:
        """Number of dimensions of a sample: one for each input, and one for each slot."""
        return self.inputs + len(self.ratios)

    def evaluate(self, shares: Values, done: Callable[[int, int], None] | None) -> dict[str, NDArray[Any]]:
        """The outputs of each sample; where no input is uncertain, all alike."""
        if self.inputs:
            return self.sampler.evaluate(shares[: self.inputs], done)
        wanted = known_outputs(self.sampler.subject.nut)
        central = {name: np.asarray(wanted[name].read(self.central)) for name in self.sampler.outputs}
        shape = np.shape(self.central.screw_torque)
        return {
            name: np.broadcast_to(np.broadcast_to(value, shape)[..., np.newaxis], (*shape, shares.shape[1])).ravel()
            for name, value in central.items()
        }

    def law_factors_at(self, place: int) -> list[Values]:
        """Factors, by slot, of the torque of the laws that are valid at one of the points; 1 is the model's own."""
        values = [np.array([np.ravel(ratio)[place] for _, ratio in laws]) for laws in self.ratios.values()]
        return [np.array([1.0, *ratios[np.isfinite(ratios)]]) for ratios in values]

    def alternatives_at(self, place: int) -> dict[str, list[Alternative]]:
        """The laws that are valid at one of the points, by slot."""
        values = {
            slot: [
                Alternative(slot, name, float(np.log(np.ravel(ratio)[place])))
                for name, ratio in laws
                if np.isfinite(np.ravel(ratio)[place])
            ]
            for slot, laws in self.ratios.items()
        }
        return {slot: laws for slot, laws in values.items() if laws}


def _as_valid(validity: Mapping[str, Any], of_model: Mapping[str, Any]) -> Any:
    """Mask: where a law holds wherever the model's own does; conditions that fail with both tell neither apart."""
    return np.all(
        np.broadcast_arrays(*(np.asarray(holds) | ~np.asarray(of_model[name]) for name, holds in validity.items())),
        axis=0,
    )


def tails(level: float) -> tuple[float, float]:
    """The shares of the samples below the two ends of an interval, as many below as above."""
    return (1 - level) / 2, (1 + level) / 2


def quantiles(values: Values, shares: Sequence[float]) -> list[float]:
    """Values that occur, in their order; NaN where none is a number."""
    numbers = values[~np.isnan(values)]
    if not numbers.size:
        return [float("nan")] * len(shares)
    return [float(q) for q in np.quantile(numbers, shares, method="inverted_cdf")]


def sample_probabilities(dimensions: int, count: int, seed: int) -> Values:
    """Shares of shape (dimensions, samples), evenly spread; none where nothing is drawn."""
    return sobol_sequence(dimensions, count, seed) if dimensions else np.empty((0, count))


def sample_law_factors(laws: Sequence[Values], shares: Values) -> Values:
    """The factor of the torque for each sample: one law of each slot, all equally likely."""
    factor = np.ones(shares.shape[1])
    for ratios, row in zip(laws, shares, strict=True):
        factor *= ratios[np.minimum((row * len(ratios)).astype(int), len(ratios) - 1)]
    return factor


# -- faults ---------------------------------------------------------------------------------------


def faults_of_options(outputs: Sequence[str], count: Any, seed: Any, level: Any, engine: Any) -> list[Fault]:
    """Faults of the options of a band."""
    faults = [
        Fault("band.outputs", "has no band", str(name), nearest(str(name), BAND_OUTPUTS))
        for name in outputs
        if name not in BAND_OUTPUTS
    ]
    if isinstance(count, bool) or not isinstance(count, int | np.integer) or not 2 <= count <= _MOST_SAMPLES:
        faults.append(Fault("band.samples", "must be a whole number from 2 to 2^30", str(count), "such as 2**14"))
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or seed < 0:
        faults.append(Fault("band.seed", "must be a whole number of 0 or more", str(seed)))
    if not isinstance(level, int | float) or not 0 < level < 1:
        faults.append(Fault("band.level", "must lie between 0 and 1", str(level), "0.95 is usual"))
    return faults + engine_faults("band", engine)


def faults_of_inputs(subject: Configuration, uncertain: Mapping[str, Any], joint: Joint | None) -> list[Fault]:
    """Faults of the uncertain inputs."""
    known, faults = subject.inputs, list[Fault]()
    for name, distribution in uncertain.items():
        where = f"band.distributions.{name}"
        if fault := distribution_fault(where, name, distribution, known, "leave it out"):
            faults.append(fault)
        else:
            part, quantity = known[name]
            ends = (fault_of(part, quantity, float(end)) for end in distribution.characteristic_values)
            faults += list(dict.fromkeys(fault for fault in ends if fault is not None))
    for name in () if joint is None else joint.names:
        if name in uncertain:
            faults.append(
                Fault(f"band.distributions.{name}", "is among the joint ones, too", "", "leave one of them out")
            )
        elif name not in known or name in OPERATION:
            faults.append(Fault(f"band.joint.{name}", "unknown name", "", nearest(name, known)))
    return faults


#: Samples of all points that are evaluated at a time: with twenty inputs they take about forty megabytes.
_AT_A_TIME = 2**18


@dataclasses.dataclass(frozen=True, eq=False)
class PointGroup:
    """Points that share a subject, the laws that could replace its own, and the names of what is uncertain."""

    subject: Configuration
    alternatives: Sequence[Candidate]
    #: By input its central value at each point; load and speed are among them.
    values: Mapping[str, Values]
    #: The uncertain inputs of each point; distributions may differ from point to point, names may not.
    uncertain: Sequence[Mapping[str, Distribution]]
    joints: Sequence[Joint | None]


@dataclasses.dataclass(frozen=True, eq=False)
class PointBands:
    """The bands of outputs at the points of a group, in their order."""

    value: Mapping[str, Values]
    median: Mapping[str, Values]
    #: Inputs and laws together.
    both: Mapping[str, tuple[Values, Values]]
    #: The inputs alone, with the model's own laws.
    parameters: Mapping[str, tuple[Values, Values]]
    #: Share of the samples of each point that lie outside the validity of the model.
    invalid_share: Values
    #: Narrower intervals of inputs and laws together by output, one for each inner level.
    inner: Mapping[str, Sequence[tuple[Values, Values]]] = dataclasses.field(default_factory=dict)


def bands_of(
    group: PointGroup,
    outputs: Sequence[str],
    *,
    count: int,
    seed: int,
    level: float,
    engine: SweepEngine | None,
    done: Callable[[int], None] | None = None,
    recorded: bool = False,
    inner: Sequence[float] = (),
) -> PointBands:
    """The bands of :func:`~ballscrew.engine.uncertainty.bands.band` at the points of a group; ``done`` gets the
    samples, and ``recorded`` is as of :meth:`~ballscrew.engine.evaluation.evaluation.Evaluation.of`. Besides that of
    ``level`` there is an interval of the same samples for each of the ``inner`` levels.
    """
    computed = evaluated_outputs(outputs)
    evaluator = BandEvaluator.of(
        group.subject, group.uncertain[0], group.joints[0], group.values, group.alternatives, engine, computed
    )
    shares = sample_probabilities(evaluator.dimensions, count, seed)
    below, above = tails(level)
    points = len(group.uncertain)
    within = [share for one in inner for share in tails(one)]
    ends = {name: np.full((5 + len(within), points), np.nan) for name in outputs}
    invalid = np.empty(points)
    for place, result in enumerate(_samples(group, evaluator, shares, engine, done, recorded=recorded)):
        factor = sample_law_factors(evaluator.law_factors_at(place), shares[evaluator.inputs :])
        both = Sample(**{name: result[name] for name in computed}, factor=factor)
        alone = both._replace(factor=np.ones(1))
        for name, rows in ends.items():
            found_of_both = quantiles(DERIVED_OUTPUTS[name](both), (below, 0.5, above, *within))
            rows[:3, place], rows[5:, place] = found_of_both[:3], found_of_both[3:]
            rows[3:5, place] = quantiles(DERIVED_OUTPUTS[name](alone), (below, above))
        invalid[place] = 1 - float(np.mean(result["valid"]))
    central = {name: np.asarray(getattr(evaluator.central, name), dtype=float) for name in outputs}
    return PointBands(
        value={name: np.broadcast_to(value, (points,)) for name, value in central.items()},
        median={name: rows[1] for name, rows in ends.items()},
        both={name: (rows[0], rows[2]) for name, rows in ends.items()},
        parameters={name: (rows[3], rows[4]) for name, rows in ends.items()},
        invalid_share=invalid,
        inner={name: list(zip(rows[5::2], rows[6::2], strict=True)) for name, rows in ends.items()},
    )


def _samples(
    group: PointGroup,
    evaluator: BandEvaluator,
    shares: Values,
    engine: SweepEngine | None,
    done: Callable[[int], None] | None,
    *,
    recorded: bool,
) -> Iterator[dict[str, NDArray[Any]]]:
    """The outputs of the samples of each point."""
    points, count = len(group.uncertain), shares.shape[1]
    if not evaluator.inputs:
        result = evaluator.evaluate(shares, None)
        for place in range(points):
            yield {name: np.broadcast_to(v.reshape(-1, count), (points, count))[place] for name, v in result.items()}
        return
    at_a_time = min(points, max(1, _AT_A_TIME // count))
    evaluation: Evaluation | None = None
    drawn = _Drawn(group, evaluator, shares)
    for start in range(0, points, at_a_time):
        places = range(start, min(start + at_a_time, points))
        axes = {name: xr.DataArray(values, dims="sample") for name, values in drawn.at(places).items()}
        if evaluation is None:
            plan = Plan.of(group.subject, evaluator.sampler.outputs, {**drawn.constant, **axes}, "samples")
            evaluation = Evaluation.of(plan, engine, math.ceil(points / at_a_time), recorded=recorded)
        else:
            evaluation = evaluation.at(axes)
        total = len(places) * count
        results = evaluation.empty(total)

        def tell(finished: int, _: int, before: int = start * count) -> None:
            if done is not None:
                done(before + finished)

        evaluation.fill(results, slice(0, total), done=tell)
        for place in range(len(places)):
            yield {name: np.asarray(values)[place * count : (place + 1) * count] for name, values in results.items()}


class _Drawn:
    """The inputs of the samples of points: those drawn, and those that differ from point to point."""

    def __init__(self, group: PointGroup, evaluator: BandEvaluator, shares: Values) -> None:
        self.group = group
        self.sampler = evaluator.sampler
        self.shares = shares[: evaluator.inputs]
        fixed = {name: values for name, values in group.values.items() if name not in self.sampler.names}
        #: Of the others, those that are the same at all points.
        self.constant = {name: float(v[0]) for name, v in fixed.items() if np.all(v == v[0])}
        self.varying = {name: values for name, values in fixed.items() if name not in self.constant}
        self._last: tuple[Any, dict[str, Values]] | None = None

    def at(self, places: range) -> dict[str, Values]:
        """The inputs at some of the points, point after point."""
        drawn = [self._inputs(place) for place in places]
        count = self.shares.shape[1]
        result = {name: np.concatenate([one[name] for one in drawn]) for name in self.sampler.names}
        chosen = slice(places.start, places.stop)
        return result | {name: np.repeat(values[chosen], count) for name, values in self.varying.items()}

    def _inputs(self, place: int) -> dict[str, Values]:
        """The inputs drawn for a point; those of the point before where they have the same distributions."""
        key = (self.group.uncertain[place], self.group.joints[place])
        if self._last is None or self._last[0][0] != key[0] or self._last[0][1] is not key[1]:
            known = self.group.subject.inputs
            inputs = {name: within(distribution, known[name][1].info) for name, distribution in key[0].items()}
            sampler = dataclasses.replace(self.sampler, inputs=inputs, joint=key[1])
            self._last = (key, sampler.inputs_at(self.shares))
        return self._last[1]
