"""The results of a band, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, NamedTuple

from ballscrew.basis.quantities import Info, Ratio, Unit, quantities_of
from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.engine.uncertainty.bands import Interval, OutputBand
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.band.compute import BandReport
from ballscrew.questions.shared.declared import FINITE, LEFT_OUT, from_attributes, table_of

_KNOWN = quantities_of(FrictionResult)


class BandedOutput(NamedTuple):
    """One output and its intervals."""

    #: With the model's own laws, at the central values of the inputs.
    value: float
    #: Median of the samples.
    median: float
    #: Lower end of the band of inputs and laws together.
    low: float
    #: Upper end of the band of inputs and laws together.
    high: float
    #: What uncertain inputs alone make, with the model's own laws.
    parameters: Interval
    #: What other laws alone make, at the central values.
    model_form: Interval
    #: Share of the variance that is from the inputs.
    share_of_parameters: float
    #: Share of the samples that are no number, and left out.
    missing_share: float


class AlternativeLaw(NamedTuple):
    """A law that could stand in place of the model's."""

    #: Of the law.
    name: str
    #: Torque with it over torque with the model's own law.
    factor: float


class UncertainInput(NamedTuple):
    """Distribution of an input, and where it comes from."""

    #: The distribution in words, SI.
    distribution: str
    #: A key of the bibliography, "judgement", "given" or the name of a calibration.
    source: str
    #: The reason of a default.
    reason: Annotated[str | None, LEFT_OUT]


@dataclasses.dataclass(frozen=True, eq=False)
class BandResults(table_of({name: _KNOWN[name] for name in BAND_OUTPUTS}, of=BandedOutput)):
    """Intervals of all outputs, and what they come from."""

    #: Share of the samples in the band.
    level: Annotated[float, FINITE]
    #: Number of samples.
    samples: int
    #: Seed of the random numbers.
    seed: int
    self_locking_share: Annotated[Ratio, Info("", "share of the samples where no load can turn the screw by itself")]
    invalid_share: Annotated[Ratio, Info("", "share of the samples outside the validity of the model")]
    reasons: Annotated[Mapping[str, float], Unit("1"), Info("", "that share by reason, the greatest first")]
    #: The laws that were exchanged, by slot.
    laws: Mapping[str, Sequence[AlternativeLaw]]
    #: The uncertain inputs, by name.
    inputs: Mapping[str, UncertainInput]


def results(case: Case, report: BandReport) -> BandResults:
    """The results of a band."""
    band = report.band
    return from_attributes(
        BandResults,
        band,
        **{name: _output(one) for name, one in band.outputs.items()},
        samples=band.count,
        reasons=report.reasons_by_share,
        laws={
            slot: [AlternativeLaw(law.name, math.exp(law.shift)) for law in laws]
            for slot, laws in band.alternatives.items()
        },
        inputs={name: _input(case, name, one) for name, one in report.inputs.items()},
    )


def _output(one: OutputBand) -> BandedOutput:
    return from_attributes(BandedOutput, one, low=one.both.low, high=one.both.high)


def _input(case: Case, name: str, one: Uncertain) -> UncertainInput:
    unit = uncertain_inputs.quantity_of(case, name).unit
    return UncertainInput(one.distribution.describe(unit), one.source, one.reason or None)
