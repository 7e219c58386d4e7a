"""Bands of a duty: torques and energies of a cycle with the uncertain inputs of its case."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping

from ballscrew.axis.duty_cycle.duty_band import DutyBand, duty_band
from ballscrew.axis.supports.element_laws import BEARING_LAWS, GUIDE_LAWS, fields_of_laws
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files.uncertain_inputs import GIVEN, NOTHING_GIVEN, Uncertain, all_of
from ballscrew.engine.uncertainty.uncertain_value import describe_distribution
from ballscrew.questions.duty.compute import DutyReport
from ballscrew.questions.shared.option_values import faults_named

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
    inputs = dict(all_of(report.case, only_given))
    uncertain = {name: one.distribution for name, one in inputs.items()}
    known = {**fields_of_laws(GUIDE_LAWS), **fields_of_laws(BEARING_LAWS)}
    for name, distribution in report.case.origins.uncertain_supports.items():
        words = describe_distribution(distribution, known[name.rpartition(".")[2]])
        inputs[name] = Uncertain(distribution, GIVEN, True, words)
    if only_given and not inputs:
        raise InputError(NOTHING_GIVEN)
    with faults_named({"band.": "--"}):
        result = duty_band(
            report.duty,
            distributions=uncertain,
            beside=report.case.origins.uncertain_supports,
            samples=SAMPLES if samples is None else samples,
            done=done,
        )
    return DutyBandReport(report, result, inputs)
