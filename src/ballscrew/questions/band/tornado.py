"""Which inputs make the band of a case: the friction torque with each at either end of its distribution."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.engine.uncertainty.bands import OutputBand
from ballscrew.engine.uncertainty.one_at_a_time import Swing, one_at_a_time
from ballscrew.questions.band.compute import BandReport


@dataclasses.dataclass(frozen=True, eq=False)
class Tornado:
    """The friction torque of a case with one uncertain input at a time at either end, and its band."""

    swings: Sequence[Swing]
    torque: OutputBand
    level: float
    inputs: Mapping[str, Uncertain]


def tornado(case: Case, report: BandReport) -> Tornado:
    """The tornado of a case with the inputs and the level of its band."""
    swings = one_at_a_time(
        case.model,
        case.screw,
        case.lubricant,
        uncertain={name: one.distribution for name, one in report.inputs.items()},
        axial_load=case.operation.axial_load,
        screw_speed=case.operation.screw_speed,
        level=report.band.level,
    )
    return Tornado(swings, report.band["screw_torque"], report.band.level, report.inputs)
