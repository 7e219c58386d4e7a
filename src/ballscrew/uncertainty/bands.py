"""Bands: how far off a computed torque may be, because of its inputs and because of its laws.

Inputs are sampled from their distributions. Laws that could stand in a slot instead of the model's move the torque by
a factor, which is found once, at the central values; each sample draws a law for each slot.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.analyses.band_work import (
    FOLLOWING,
    POSITIVE,
    VALIDITY,
    Alternative,
    Drawn,
    Values,
    Work,
    computed_for,
    factor_of,
    faults_of_inputs,
    faults_of_options,
    faults_of_point,
    shares_of,
)
from ballscrew.analyses.comparison import Candidate
from ballscrew.analyses.distributions import Distribution
from ballscrew.analyses.engines import Engine
from ballscrew.analyses.nut_parts import NutParts
from ballscrew.analyses.plan import Subject
from ballscrew.analyses.sampling import JointNormal
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew
from ballscrew.faults import Fault, nearest, raise_if_any
from ballscrew.model import FrictionModel

#: How many samples are taken where nothing is said: of a screw, and of a whole nut, whose every ball is solved for.
SAMPLES, NUT_SAMPLES = 2**14, 2**10


class Interval(NamedTuple):
    """Two ends with a stated share of the samples between them, and as many below as above."""

    low: float
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


@dataclasses.dataclass(frozen=True, eq=False)
class Band:
    """What :func:`band` finds, by output."""

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


def band(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    uncertain: Mapping[str, Distribution],
    axial_load: float,
    screw_speed: float,
    alternatives: Sequence[Candidate] = (),
    joint: JointNormal | None = None,
    outputs: Sequence[str] = ("screw_torque",),
    samples: int | None = None,
    seed: int = 0,
    level: float = 0.95,
    nut: NutParts | None = None,
    engine: Engine | None = None,
    keep_samples: bool = False,
    done: Callable[[int, int], None] | None = None,
) -> Band:
    """Where outputs lie if inputs are uncertain and other laws could be the right ones.

    ``uncertain`` names inputs as :func:`~ballscrew.analyses.sweep.sweep` does; they are independent, but for those of
    ``joint``. Each distribution is cut at the bounds of its quantity. The load in N and the speed in rad/s are the
    central ones; either may be among the uncertain.

    ``alternatives`` are models with one law changed. Of those that count and are valid at the central values, each
    has as good a chance as the model's own law of the slot, slots are independent, and a law moves the torque by the
    same factor everywhere. Without alternatives the band is that of the inputs alone.

    ``outputs`` are of :data:`~ballscrew.analyses.band_work.BANDED`: friction torque and what follows from it.
    ``samples`` is 2^14, and 2^10 for a whole ``nut`` where nothing is said; a power of two is spread the most evenly.
    The same seed gives the same band.

    Raises :class:`~ballscrew.faults.InputError` for unknown names, numbers out of bounds and an engine that cannot
    be had.
    """
    count = samples if samples is not None else SAMPLES if nut is None else NUT_SAMPLES
    outputs = (outputs,) if isinstance(outputs, str) else tuple(dict.fromkeys(outputs))
    subject = Subject(model, screw, lubricant, nut)
    point = {"axial_load": axial_load, "screw_speed": screw_speed}
    raise_if_any(
        [
            *faults_of_options(outputs, count, seed, level, engine),
            *faults_of_point(point),
            *faults_of_inputs(subject, uncertain, joint),
        ]
    )
    work = Work.of(subject, uncertain, joint, point, alternatives, engine, computed_for(outputs))
    shares = shares_of(work.dimensions, count, seed)
    found = work.evaluated(shares, done)
    factor = factor_of(work.laws_at(0), shares[work.inputs :])
    both = Drawn(**{name: found[name] for name in computed_for(outputs)}, factor=factor)
    centre = Drawn(**{name: np.full(1, float(getattr(work.central, name))) for name in computed_for(outputs)})
    parameters = both._replace(factor=np.ones(1))
    model_form = centre._replace(factor=factor)
    values = {name: float(np.asarray(getattr(work.central, name))) for name in outputs}
    bands = {
        name: _band_of(name, values[name], [FOLLOWING[name](drawn) for drawn in (both, parameters, model_form)], level)
        for name in outputs
    }
    numbers = np.isfinite(both.torque)
    locks = (both.ideal_torque > 0) & (FOLLOWING["holding_torque"](both) <= 0)
    reasons = {name.removeprefix(VALIDITY): 1 - float(np.mean(found[name])) for name in work.masks}
    kept = {**work.sampler.drawn(shares[: work.inputs]), **{name: FOLLOWING[name](both) for name in outputs}}
    return Band(
        level=level,
        count=count,
        seed=seed,
        outputs=bands,
        alternatives=work.shifts_at(0),
        self_locking_share=float(np.mean(locks[numbers])) if np.any(numbers) else float("nan"),
        invalid_share=1 - float(np.mean(found["valid"])),
        reasons={reason: share for reason, share in reasons.items() if share > 0},
        samples=kept if keep_samples else None,
    )


def band_along(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    along: str,
    points: Sequence[float] | Values,
    uncertain: Mapping[str, Distribution],
    axial_load: float,
    screw_speed: float,
    alternatives: Sequence[Candidate] = (),
    joint: JointNormal | None = None,
    samples: int | None = None,
    seed: int = 0,
    level: float = 0.95,
    nut: NutParts | None = None,
    engine: Engine | None = None,
    done: Callable[[int, int], None] | None = None,
) -> BandCurve:
    """The friction torque with its bands at points ``along`` the load ("axial_load") or the speed ("screw_speed").

    As :func:`band`, with the same samples at all points; what it goes along is exact there. ``samples`` is an eighth
    of that of :func:`band` where nothing is said.

    Raises :class:`~ballscrew.faults.InputError` as :func:`band` does.
    """
    count = samples if samples is not None else (SAMPLES if nut is None else NUT_SAMPLES) // 8
    subject = Subject(model, screw, lubricant, nut)
    uncertain = {name: distribution for name, distribution in uncertain.items() if name != along}
    point: dict[str, Any] = {"axial_load": axial_load, "screw_speed": screw_speed}
    faults = [] if along in point else [Fault("band.along", "unknown", along, nearest(along, point))]
    faults += faults_of_options((), count, seed, level, engine) + faults_of_point(point)
    raise_if_any([*faults, *faults_of_inputs(subject, uncertain, joint)])
    point[along] = np.asarray(points, dtype=float)
    work = Work.of(subject, uncertain, joint, point, alternatives, engine, ("screw_torque",))
    shares = shares_of(work.dimensions, count, seed)
    torque = work.evaluated(shares, done)["screw_torque"].reshape(len(points), -1)
    factors = np.array([factor_of(work.laws_at(i), shares[work.inputs :]) for i in range(len(points))])
    below, above = _tails(level)
    every = np.array([_quantiles(row, (below, 0.5, above)) for row in torque * factors]).T
    alone = np.array([_quantiles(row, (below, above)) for row in torque]).T
    value = np.broadcast_to(np.asarray(work.central.screw_torque, dtype=float), (len(points),))
    return BandCurve(along, point[along], value, every[1], (every[0], every[2]), (alone[0], alone[1]), count)


def _band_of(name: str, value: float, drawn: Sequence[Values], level: float) -> OutputBand:
    """The band of an output from its samples: with both causes, with inputs alone, with laws alone."""
    both, parameters, model_form = drawn
    below, above = _tails(level)
    low, median, high = _quantiles(both, (below, 0.5, above))
    from_inputs, from_laws = (_variance(name, values) for values in (parameters, model_form))
    together = from_inputs + from_laws
    return OutputBand(
        value=value,
        median=median,
        both=Interval(low, high),
        parameters=Interval(*_quantiles(parameters, (below, above))),
        model_form=Interval(*_quantiles(model_form, (below, above))),
        share_of_parameters=from_inputs / together if together > 0 else float("nan"),
        missing_share=float(np.mean(np.isnan(both))),
    )


def _tails(level: float) -> tuple[float, float]:
    return (1 - level) / 2, (1 + level) / 2


def _quantiles(values: Values, shares: Sequence[float]) -> list[float]:
    """Values that occur, in their order; NaN where none is a number."""
    numbers = values[~np.isnan(values)]
    if not numbers.size:
        return [float("nan")] * len(shares)
    return [float(q) for q in np.quantile(numbers, shares, method="inverted_cdf")]


def _variance(name: str, values: Values) -> float:
    with np.errstate(all="ignore"):
        spread = np.log(values) if name in POSITIVE else values
    finite = spread[np.isfinite(spread)]
    if not finite.size:
        return float("nan")
    return float(np.var(finite)) if np.ptp(finite) else 0.0  # no roundings for a variance
