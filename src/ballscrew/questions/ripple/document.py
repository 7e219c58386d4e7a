"""``ballscrew ripple --json``: the document of a ripple; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis import units
from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.questions.ripple.answer import results
from ballscrew.questions.ripple.compute import RippleReport
from ballscrew.questions.shared import declared


def document(report: RippleReport) -> dict[str, Any]:
    """Inputs, torque over the angle, orders, faults, verdicts and provenance."""
    found = results(report)
    return {
        "inputs": case_file.inputs(report.case),
        "results": declared.document(found),
        "units": declared.units(found),
        "assumed": [units.filled(each) for each in report.assumed],
        "warnings": documents(report.case.implausible()),
        "verdicts": documents(report.verdicts),
        "checks": [],
        "provenance": provenance.of_case(report.case),
    }
