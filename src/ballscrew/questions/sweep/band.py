"""The band over a sweep of a case: at each point that which the case has there."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.errors import overflow_as_input_error, raise_if_any
from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import OPERATION, inputs_of
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.band_evaluation import PointGroup, Values, bands_of, faults_of_options, tails
from ballscrew.engine.uncertainty.bands import ENDS, INNER_LEVELS, NUT_SAMPLES, SAMPLES, inner_end, with_ends
from ballscrew.engine.uncertainty.distributions import Distribution, scaled
from ballscrew.engine.uncertainty.monte_carlo import Joint
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.band import BandOptions, compute
from ballscrew.questions.band.compute import LEVEL
from ballscrew.questions.shared.option_values import faults_named
from ballscrew.questions.sweep.compute import FLOODED, Plan, given_of_oil, unvaried

#: Shares of the samples between the ends of the narrower intervals of a document, as far as they are below its level.
INNER = (0.5, 0.8)
#: The seed of the random numbers of a case.
_SEED = 0
#: The part of a case whose inputs change what other laws would give.
_MODEL = "model"


class _Inputs(NamedTuple):
    """Uncertain inputs at a point, and the case there, whose operating point does not count."""

    case: Case
    uncertain: Mapping[str, Distribution]
    joint: Joint | None


@overflow_as_input_error()
def with_band(
    case: Case,
    plan: Plan,
    dataset: xr.Dataset,
    options: BandOptions,
    done: Callable[[int, int], None] | None = None,
    *,
    recorded: bool = False,
    inner: Sequence[float] = (),
) -> xr.Dataset:
    """The dataset of a sweep with the ends of the band of each output, and of the validity, beside it.

    At each point they are those of :func:`~ballscrew.questions.band.compute.band` of the case with the point's values
    in place: an uncertain input that is varied has there what its default says of the new value. ``done`` gets the
    samples. Points that cannot be have no band. With ``inner`` levels the ends of an interval for each that is below
    the level of the band stand beside, as ``x_low_of_50`` and ``x_high_of_50`` for 0.5. For a file samples are
    ``recorded``: no bit depends on the kernels that are kept. Raises
    :class:`~ballscrew.basis.errors.InputError` that names options of the command line.
    """
    outputs = tuple(name for name in plan.outputs if name != FLOODED)
    count = options.samples
    if count is None:
        count = NUT_SAMPLES if case.screw.nut.one_by_one else SAMPLES
    level = LEVEL if options.level is None else options.level
    with faults_named(compute.FLAGS):
        raise_if_any(faults_of_options(outputs, count, _SEED, level, None))
    dims = tuple(plan.axes)
    shape = tuple(len(values) for values in plan.axes.values())
    points = _points(case, plan)
    possible = np.ravel(dataset["validity_inputs"].transpose(*dims).to_numpy())
    varied = {name.removeprefix("nut.") for name in plan.axes}
    groups = _groups(case, points, varied, np.flatnonzero(possible), only_given=options.only_given)
    ends = {name: (np.full(possible.size, np.nan), np.full(possible.size, np.nan)) for name in outputs}
    levels = [one for one in inner if one < level]
    within = {(name, one): np.full((len(ENDS), possible.size), np.nan) for name in outputs for one in levels}
    outside = np.ones(possible.size)
    before, total = 0, int(possible.sum()) * count
    for places, group in groups:

        def tell(finished: int, start: int = before) -> None:
            if done is not None:
                done(start + finished, total)

        result = bands_of(
            group,
            outputs,
            count=count,
            seed=_SEED,
            level=level,
            engine=None,
            done=tell,
            recorded=recorded,
            inner=levels,
        )
        for name, both in ends.items():
            for end, values in zip(both, result.both[name], strict=True):
                end[places] = values
        for name in outputs:
            for one, pair in zip(levels, result.inner[name], strict=True):
                within[name, one][:, places] = pair
        outside[places] = result.invalid_share
        before += len(places) * count
    complete = {name: (low.reshape(shape), high.reshape(shape)) for name, (low, high) in ends.items()}
    result = with_ends(dataset.transpose(*dims), complete, outside, level=level, count=count, seed=_SEED)
    # a mask has an interval, too: its least and its greatest value in as many of the samples
    attributes = dataset["valid"].attrs
    masks = {
        f"valid_{end}": (dims, outside.reshape(shape) < share, attributes)
        for end, share in zip(ENDS, tails(level), strict=True)
    }
    narrower = {
        inner_end(name, end, one): (dims, values.reshape(shape), result[f"{name}_{end}"].attrs)
        for (name, one), both in within.items()
        for end, values in zip(ENDS, both, strict=True)
    }
    return result.assign({**masks, **narrower}).assign_attrs({INNER_LEVELS: levels} if levels else {})


def _points(case: Case, plan: Plan) -> dict[str, Values]:
    """The values of the axes, the load and the speed at each point of the grid, in the order of the axes."""
    grid = np.meshgrid(*plan.axes.values(), indexing="ij")
    # fields of the nut have two names
    points = {name.removeprefix("nut."): np.ravel(values) for name, values in zip(plan.axes, grid, strict=True)}
    size = np.size(grid[0]) if grid else 1
    for name, value in unvaried(case, plan).items():
        if isinstance(value, xr.DataArray):  # the speed of a nut whose lead is varied
            of_lead = np.unravel_index(np.arange(size), [len(values) for values in plan.axes.values()])
            points[name] = value.to_numpy()[of_lead[list(plan.axes).index("lead")]]
        else:
            points[name] = np.full(size, float(value))
    return points


def _groups(
    case: Case,
    points: Mapping[str, Values],
    varied: set[str],
    places: NDArray[np.intp],
    *,
    only_given: bool,
) -> list[tuple[list[int], PointGroup]]:
    """The points in groups that one subject serves, with the places of each."""
    known = inputs_of(case.model, case.screw, case.lubricant)
    axes = [name for name in points if name not in OPERATION]
    of_model = [name for name in axes if known[name][0] == _MODEL]
    oil = given_of_oil(case) if TEMPERATURE.name in axes else {}
    # an oil of which numbers are given beside its temperature is another oil at each
    own = [*of_model, *([TEMPERATURE.name] if oil else [])]
    inputs: dict[tuple[float, ...], _Inputs] = {}
    members: dict[tuple[Any, ...], list[int]] = {}
    subjects: dict[tuple[float, ...], Configuration] = {}
    of_place: dict[int, _Inputs] = {}
    for place in places.tolist():
        here = {name: float(points[name][place]) for name in axes}
        at = tuple(here.values())
        if at not in inputs:
            inputs[at] = _inputs_at(case, here, oil, varied, only_given=only_given)
        of_place[place] = inputs[at]
        subject = tuple(here[name] for name in own)
        if subject not in subjects:
            base = Configuration(case.model, case.screw, case.lubricant)
            changes = {name: here[name] for name in own}
            subjects[subject] = base.changed({**changes, **oil}) if own else base
        joint = inputs[at].joint
        names = (tuple(inputs[at].uncertain), () if joint is None else joint.names)
        members.setdefault((subject, *names), []).append(place)
    return [
        (
            chosen,
            PointGroup(
                subjects[key[0]],
                compute.alternatives(of_place[chosen[0]].case),
                {name: values[chosen] for name, values in points.items() if name not in own},
                [of_place[place].uncertain for place in chosen],
                [of_place[place].joint for place in chosen],
            ),
        )
        for key, chosen in members.items()
    ]


def _inputs_at(
    case: Case,
    here: Mapping[str, float],
    given_of_oil: Mapping[str, float],
    varied: set[str],
    *,
    only_given: bool,
) -> _Inputs:
    """Uncertain inputs where inputs have other values: as of a case file that has them, and no ± beside them."""
    there = Configuration(case.model, case.screw, case.lubricant).changed({**here, **given_of_oil})
    uncertain = {name: distribution for name, distribution in case.origins.uncertain.items() if name not in varied}
    if case.origins.speed_of_nut and "lead" in here and "screw_speed" in uncertain:
        uncertain["screw_speed"] = scaled(uncertain["screw_speed"], case.screw.lead / here["lead"])
    calibrated = () if case.origins.calibration is None else case.origins.calibration.parameters.values()
    exact = (case.origins.exact - varied) | varied.intersection(calibrated)
    origins = dataclasses.replace(case.origins, uncertain=uncertain, exact=exact)
    at = dataclasses.replace(case, model=there.model, screw=there.screw, lubricant=there.lubricant, origins=origins)
    result = uncertain_inputs.all_of(at, only_given)
    return _Inputs(at, *compute.distributions(at, result))
