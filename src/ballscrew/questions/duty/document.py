"""The JSON document of a duty: the numbers of a cycle, its parts, life, brake, motor and the rule of catalogues."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.duty import verdicts as duty_verdicts
from ballscrew.questions.duty.answer import DutyResults
from ballscrew.questions.duty.compute import DutyReport
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.check_lines import source_document

if TYPE_CHECKING:  # loads xarray
    from ballscrew.questions.duty.band import DutyBandReport


def document(report: DutyReport) -> dict[str, Any]:
    """The document of a duty, in SI."""
    results = DutyResults(report)
    return {
        "inputs": case_file.inputs(report.case),
        "results": declared.document(results),
        "units": declared.units(results),
        "warnings": documents(duty_verdicts.warnings(report)),
        "verdicts": documents(duty_verdicts.verdicts(report)),
        "checks": [_check(check) for check in report.checks],
        "provenance": provenance.of_case(report.case),
    }


def with_band(found: DutyBandReport) -> dict[str, Any]:
    """The document of a duty with its bands."""
    bands = found.bands
    return {
        **document(found.report),
        "band": {
            "level": bands.level,
            "samples": bands.count,
            **{
                name: {"value": one.value, "median": one.median, **one.band._asdict()}
                for name, one in bands.numbers.items()
            },
            "inputs": {name: {"source": one.source, "given": one.given} for name, one in found.inputs.items()},
        },
    }


def _check(check: Check) -> dict[str, Any]:
    """A check as a record, with the share of its limit that is used, what it lacks and its source."""
    beside = {"name": check.name, "utilisation": check.utilisation, "missing": check.missing}
    return {**check.record.document(), **beside, **source_document(check)}
