"""The documents of a duty, without and with its bands; results, units and schema are those of ``compute``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ballscrew.cases.schema.duty_schema import TRAJECTORY
from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.duty import DutyOptions, TraceOptions, compute, verdicts
from ballscrew.questions.duty.compute import DutyReport
from ballscrew.questions.duty.sheet import sheet
from ballscrew.questions.shared.check_lines import source_document
from ballscrew.questions.shared.declared import envelope
from ballscrew.questions.shared.question import Answer, Done, Request, Work

if TYPE_CHECKING:  # loads xarray
    from ballscrew.questions.duty.band import DutyBandReport


def document(report: DutyReport) -> dict[str, Any]:
    """The document of a duty, in SI."""
    return envelope(
        report.case,
        report,
        warnings=verdicts.warnings(report),
        verdicts=verdicts.verdicts(report),
        checks=map(_check, report.checks),
    )


def with_band(duty_band_report: DutyBandReport) -> dict[str, Any]:
    """The document of a duty with its bands."""
    bands = duty_band_report.bands
    return {
        **document(duty_band_report.report),
        "band": {
            "level": bands.level,
            "samples": bands.count,
            **{
                name: {"value": one.value, "median": one.median, **one.band._asdict()}
                for name, one in bands.numbers.items()
            },
            "inputs": {
                name: {"source": one.source, "given": one.given} for name, one in duty_band_report.inputs.items()
            },
        },
    }


def _check(check: Check) -> dict[str, Any]:
    """A check as a record, with the share of its limit that is used, what it lacks and its source."""
    beside = {"name": check.name, "utilisation": check.utilisation, "missing": check.missing}
    return {**check.record.document(), **beside, **source_document(check)}


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    options, trace = request.options(DutyOptions), request.options(TraceOptions).trace
    assert request.case is not None
    tables = request.case.tables()
    if trace is not None:
        tables["motion"] = {"kind": TRAJECTORY, "file": str(Path(trace).absolute())}
    case = request.case.build(tables, moves=True)

    def answer(done: Done) -> Answer:
        report = compute.duty(case)
        size = f"{len(report.duty.states.time)} states"
        if not options.is_banded:
            return Answer(sheet(report), lambda: document(report), size)
        from ballscrew.questions.duty.band import band  # loads xarray

        bands = band(report, options.samples, only_given=options.only_given, done=done)
        return Answer(sheet(report, bands), lambda: with_band(bands), size)

    return Work(answer, "band" if options.is_banded else "")
