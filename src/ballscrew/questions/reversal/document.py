"""``ballscrew reversal --json``: the document of a reversal; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.questions.reversal.answer import results
from ballscrew.questions.reversal.compute import ReversalReport
from ballscrew.questions.shared import declared


def document(report: ReversalReport) -> dict[str, Any]:
    """The document of a reversal, in SI."""
    found = results(report)
    return {
        "inputs": case_file.inputs(report.case),
        "results": declared.document(found),
        "units": declared.units(found),
        "warnings": documents(report.warnings),
        "verdicts": documents(report.verdicts),
        "checks": [],
        "provenance": provenance.of_case(report.case),
    }
