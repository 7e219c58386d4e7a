"""``ballscrew run --band --json``: the document of a band; all in SI."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import Info, Quantity, Ratio, Unit, quantities_of
from ballscrew.basis.records import Record, documents
from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.named_calibration import by_rules
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.engine.uncertainty.bands import Interval, OutputBand
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import NUT_CONDITIONS
from ballscrew.questions.band.compute import OF_MAKERS, BandReport
from ballscrew.questions.run.answer import document as run_document
from ballscrew.questions.run.compute import Run
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import FINITE, LEFT_OUT, from_attributes, table_of

_OUTPUTS = quantities_of(FrictionResult)


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
class BandResults(table_of({name: _OUTPUTS[name] for name in BAND_OUTPUTS}, of=BandedOutput)):
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


_TORQUE = "screw_torque"
_KNOWN = quantities_of(FrictionResult)[_TORQUE]
#: A cause is named where the band is so much narrower without it, as a share of its width.
_WORTH_SAYING = 0.9


def document(run: Run, report: BandReport) -> dict[str, Any]:
    """The document of a run with its band."""
    case, answer, result = run.case, results(run.case, report), run_document(run)
    return {
        **result,
        "band": declared.document(answer),
        "units": {**result["units"], "band": declared.units(answer)},
        "verdicts": [*result["verdicts"], *documents(verdicts(case, report))],
        "warnings": [*result["warnings"], *documents(warnings(report))],
    }


def verdicts(case: Case, report: BandReport) -> list[Record]:
    """The friction torque with its band, a full bath beside it, the log of a fit, the share that locks itself."""
    band, torque = report.band, report.band[_TORQUE]
    quantity = known_outputs(case.screw.nut)[_TORQUE].quantity
    if not math.isfinite(torque.median):
        message = "no band: the friction torque is no number here"
        return [Record("band.no_torque", _TORQUE, message, severity="warning", unit=quantity.unit)]
    if float(case.operation.axial_load) == 0 and torque.both == (0.0, 0.0):
        message = "no band: without load there is no friction torque"
        return [Record("band.no_load", "axial_load", message, value=0.0, unit="N")]
    low, high = units.ends(*torque.both, quantity)
    causes = "inputs and laws" if band.alternatives else "the inputs alone"
    message = (
        f"friction torque {units.shown(torque.value, quantity)} at the values of the case, median "
        f"{units.shown(torque.median, quantity)}, {units.number(100 * band.level)} % of the samples of {causes} "
        f"between {low} and {high}"
    )
    records = [Record("band.torque", _TORQUE, message, value=torque.median, unit=quantity.unit)]
    records += beside_laws(torque, quantity)
    records += _narrowing(report, case, quantity)
    records += _full_bath(report)
    records += _rules(case, report)
    if case.origins.fit:
        log, off = case.origins.fit.get("log"), case.origins.fit.get("holdout_rms")
        message = (
            f"calibrated to {log if log else 'a log'}: what the fit held counts as known, no law is exchanged; on "
            f"rows held out the model was off by {_torque_in_file(off, quantity)}"
        )
        records.append(Record("band.calibrated", "model", message))
    if float(case.operation.axial_load) != 0:
        share = band.self_locking_share
        message = (
            f"self-locking in {units.number(100 * share)}% of the samples"
            if share
            else "self-locking in none of the samples"
        )
        records.append(Record("band.self_locking_share", "self_locking", message, value=share))
    return records


def _narrowing(report: BandReport, case: Case, quantity: Quantity) -> list[Record]:
    """Inputs that narrow the band the most where it is known, and how far; empty where nothing does by a tenth."""
    result, both = report.band.narrowing, report.band[_TORQUE].both
    if result is None or not both.low > 0 or not both.high / both.low > 1:
        return []
    share = (result.high - result.low) / (both.high - both.low)
    if not share < _WORTH_SAYING:
        return []
    if result.name == OF_MAKERS:
        cause = "whose nut it is like, by a maker's calibration or a torque that was measured"
    elif result.of_laws:
        cause = f"which law of the {result.name.replace('_', ' ')} holds"
    else:
        known = Configuration(case.model, case.screw, case.lubricant).inputs
        cause = known[result.name][1].info.meaning
    low = units.shown(result.low, quantity, toward=-1)
    high = units.shown(result.high, quantity, toward=1)
    message = (
        f"the band would narrow the most, to {units.number(100 * share, 2)} % of its width ({low} to {high}), if "
        f"this were known and as the model has it: {cause}"
    )
    return [Record("band.narrowing", _TORQUE, message, value=share)]


def _full_bath(report: BandReport) -> list[Record]:
    """Record of the torque of the full bath: within a band of both tracks, or beside one of the starved track only."""
    high, flooded = report.band[_TORQUE].both.high, report.flooded_torque
    if flooded is None:
        return []
    torque = units.shown(flooded, _KNOWN)
    if "inlet" in report.band.alternatives:
        message = (
            "the band holds oil that comes back into the track late, as in bearings, and a full bath of oil, "
            f"{torque}: which of them a ball screw has is not measured"
        )
    else:
        message = (
            "the band takes oil to come back into the track late, as in bearings; a full bath of oil gives "
            f"{torque}: {'above' if flooded > high else 'within'} it"
        )
    return [
        Record(
            "band.flooded",
            _TORQUE,
            message,
            severity="warning",
            holds=flooded <= high,
            value=flooded,
            limit=high,
            unit=_KNOWN.unit,
        )
    ]


def _rules(case: Case, report: BandReport) -> list[Record]:
    """Records of whether the band of a preloaded nut holds each maker's rule; only without load, as rules have none."""
    if float(case.operation.axial_load) != 0:
        return []
    low, high = report.band[_TORQUE].both
    least, most = units.ends(low, high, _KNOWN)
    rules: list[Record] = []
    for one in by_rules(case):
        torque = float(one.torque) + report.losses
        within = low <= torque <= high
        side = "within the band" if within else f"outside the band of {least} to {most}"
        message = (
            f"the rule of {one.rule.label} gives {units.shown(torque, _KNOWN)} with the losses of the case: {side}"
        )
        rules.append(
            Record(f"band.rule_{one.rule.name}", "preload_drag", message, holds=within, value=torque, unit=_KNOWN.unit)
        )
    return rules


def beside_laws(torque: OutputBand, quantity: Quantity) -> list[Record]:
    """Reasons why the band of inputs and laws ends within that of the inputs, or the case lies outside the laws alone.

    One line for each, with the number to use. Ends that are written alike count as the same.
    """
    both, inputs, laws = torque.both, torque.parameters, torque.model_form
    greatest = max(both.high, inputs.high)
    if not all(map(math.isfinite, (torque.value, torque.median, greatest, *both, *inputs, *laws))):
        return []
    (low, high), (inputs_low, inputs_high), (laws_low, laws_high) = (
        units.ends(*ends, quantity) for ends in (both, inputs, laws)
    )
    value, median = units.shown(torque.value, quantity), units.shown(torque.median, quantity)
    most = units.shown(greatest, quantity, toward=1)
    advice = f"expect the median {median} and for a motor take {most}"

    def of_laws(name: str, text: str, number: float) -> Record:
        return Record(f"band.{name}", _TORQUE, text, value=number, unit=quantity.unit)

    records: list[Record] = []
    if both.high < inputs.high and high != inputs_high:
        text = (
            f"inputs and laws together end at {high}, below the {inputs_high} of the inputs alone: most other laws "
            f"give less torque than the model's; for a motor take {inputs_high}"
        )
        records.append(of_laws("laws_lower_it", text, inputs.high))
    if both.low > inputs.low and low != inputs_low:
        text = (
            f"inputs and laws together begin at {low}, above the {inputs_low} of the inputs alone: most other laws "
            f"give more torque than the model's; for a brake take {inputs_low}, for a motor {most}"
        )
        records.append(of_laws("laws_raise_it", text, inputs.low))
    if torque.value > laws.high and value != laws_high:
        text = (
            f"the case lies at {value}, above the laws alone ({laws_low} to {laws_high}): most other laws give less "
            f"torque than the model's; {advice}"
        )
        records.append(of_laws("above_laws", text, torque.median))
    if torque.value < laws.low and value != laws_low:
        text = (
            f"the case lies at {value}, below the laws alone ({laws_low} to {laws_high}): most other laws give more "
            f"torque than the model's; {advice}"
        )
        records.append(of_laws("below_laws", text, torque.median))
    return records


def warnings(report: BandReport) -> list[Record]:
    """Samples outside the model's validity, and samples that are no number."""
    records: list[Record] = []
    outside, missing = report.band.invalid_share, report.band[_TORQUE].missing_share
    if outside > 0:
        reasons = [
            f"{units.number(100 * share)}% {reason}: {NUT_CONDITIONS[reason].text}"
            for reason, share in report.reasons_by_share.items()
        ]
        message = (
            f"{units.number(100 * outside)}% of the samples lie outside the model's validity ({', '.join(reasons)})"
        )
        records.append(Record.warning("band.not_valid_share", "valid", message, outside, 0.0))
    if missing > 0:
        message = f"{units.number(100 * missing)}% of the samples are no number, and left out"
        records.append(Record.warning("band.missing_share", _TORQUE, message, missing, 0.0))
    return records


def _torque_in_file(text: Any, quantity: Quantity) -> str:
    """A torque as a calibrated case has it, with its digits; what is no torque stays as it is written."""
    if text is None:
        return "an unknown torque"
    result = units.parse("calibration.holdout_rms", text, quantity)
    return str(text) if isinstance(result, Fault) else units.shown(result, quantity, 6)
