"""The uncertainty band of the model at each row of a set, as ``ballscrew run --band`` makes it, of fewer samples."""

from __future__ import annotations

import dataclasses
from collections.abc import Hashable, Mapping, Sequence

import numpy as np

from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case, Origins
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.band_evaluation import PointGroup, bands_of
from ballscrew.evidence.validation.entries import Entry, OperatingPoint
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.calibrations import calibrations
from ballscrew.questions.band import compute

#: Samples of a row. The ends of a band of so many scatter by some per cent, which the width of the band hides.
SAMPLES = 256
_TORQUE = "screw_torque"


def with_bands(entry: Entry, samples: int = SAMPLES) -> Entry:
    """The entry with the ends of the uncertainty band of each of its points that is one state of one screw.

    Inputs have their usual distributions, laws their alternatives, as in a case without uncertainties of its own.
    Rows with nuts of one kind are evaluated together.
    """
    cases = {place: _case(entry, point.computed_at) for place, point in enumerate(entry.points) if point.computed_at}
    drawn = {place: uncertain_inputs.all_of(case) for place, case in cases.items()}
    alike: dict[Hashable, list[int]] = {}
    for place, case in cases.items():
        alike.setdefault(_kind(case, drawn[place]), []).append(place)
    points = list(entry.points)
    for places in alike.values():
        result = _bands([cases[place] for place in places], [drawn[place] for place in places], samples)
        for place, ends in zip(places, result, strict=True):
            points[place] = dataclasses.replace(points[place], uncertainty=ends)
    return dataclasses.replace(entry, points=points)


def _case(entry: Entry, at: OperatingPoint) -> Case:
    return Case(
        model=entry.model,
        screw=at.screw,
        lubricant=at.lubricant,
        operation=OperatingState(at.axial_load, at.screw_speed),
        origins=Origins(calibration=None if entry.calibration is None else calibrations()[entry.calibration]),
    )


def _kind(case: Case, inputs: Mapping[str, Uncertain]) -> Hashable:
    """What must be the same in cases that are evaluated together."""
    nut = case.screw.nut
    return type(nut), nut.spacer_balls, tuple(nut.losses), case.lubricant, tuple(inputs)


def _bands(cases: Sequence[Case], inputs: Sequence[Mapping[str, Uncertain]], samples: int) -> list[tuple[float, float]]:
    """The ends of the bands of cases of one kind."""
    first = cases[0]
    distributions = [compute.distributions(case, one) for case, one in zip(cases, inputs, strict=True)]
    # other than the first in nothing but numbers
    numbers = {name: [getattr(case.screw, name) for case in cases] for name in fields_of(BallScrew)}
    values = {name: np.array(of, dtype=float) for name, of in numbers.items() if any(one != of[0] for one in of)}
    values["preload"] = np.array([case.screw.nut.value_of("preload") for case in cases], dtype=float)
    values |= {
        name: np.array([getattr(case.operation, name) for case in cases], dtype=float)
        for name in fields_of(OperatingState)
    }
    group = PointGroup(
        Configuration(first.model, first.screw, first.lubricant),
        compute.alternatives(first),
        values,
        [independent for independent, _ in distributions],
        [joint for _, joint in distributions],
    )
    # so few points are sooner computed by the model itself than recorded
    both = bands_of(group, [_TORQUE], count=samples, seed=0, level=compute.LEVEL, engine="model").both[_TORQUE]
    return [(float(low), float(high)) for low, high in zip(*both, strict=True)]
