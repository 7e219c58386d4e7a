"""The documents of a duty, without and with its bands; results, units and schema are those of ``compute``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.duty import verdicts
from ballscrew.questions.duty.compute import DutyReport
from ballscrew.questions.shared.check_lines import source_document
from ballscrew.questions.shared.envelope import envelope

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
