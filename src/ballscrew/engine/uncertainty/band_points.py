"""Bands at many points: the same random numbers at all of them, and one evaluation of the samples of many points."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.engine.evaluation.comparison import Candidate
from ballscrew.engine.evaluation.engines import SweepEngine
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.uncertainty.band_evaluation import (
    DERIVED_OUTPUTS,
    BandEvaluator,
    Sample,
    Values,
    evaluated_outputs,
    quantiles,
    sample_law_factors,
    sample_probabilities,
    tails,
)
from ballscrew.engine.uncertainty.distributions import Distribution, within
from ballscrew.engine.uncertainty.monte_carlo import Joint

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
