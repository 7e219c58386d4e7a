"""Bands of a duty: torques and energies of a cycle with the uncertain inputs of its case."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping

from ballscrew.axis.duty_band import DutyBand, duty_band
from ballscrew.axis_studies.duty import DutyReport
from ballscrew.cases.uncertain_inputs import Uncertain, all_of
from ballscrew.errors import InputError

#: Samples where none are asked for.
SAMPLES = 1024


@dataclasses.dataclass(frozen=True, eq=False)
class DutyBandReport:
    """The bands of a duty, and the inputs that they come from."""

    report: DutyReport
    bands: DutyBand
    inputs: Mapping[str, Uncertain]


def band(
    report: DutyReport,
    samples: int | None = None,
    *,
    only_given: bool = False,
    done: Callable[[int, int], None] | None = None,
) -> DutyBandReport:
    """The bands of a duty. Raises ``InputError`` that names options of the command line."""
    inputs = all_of(report.case, only_given)
    uncertain = {name: one.distribution for name, one in inputs.items()}
    try:
        found = duty_band(report.duty, uncertain=uncertain, samples=SAMPLES if samples is None else samples, done=done)
    except InputError as error:
        faults = (
            dataclasses.replace(f, where=f.where.replace("band.", "--", 1) if f.where.startswith("band.") else f.where)
            for f in error.faults
        )
        raise InputError(*faults) from None
    return DutyBandReport(report, found, inputs)
