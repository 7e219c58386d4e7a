"""``ballscrew fit --json``: the document of a fit; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, fitted_case
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.fit.answer import results
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.shared import declared


def document(case: Case, report: FitReport) -> dict[str, Any]:
    """Estimates, residuals, what cannot be identified, the next test, warnings and provenance."""
    model, found = report.model, results(report)
    return {
        **declared.document(found),
        "units": declared.units(found),
        "verdicts": documents(model.verdict_records),
        "checks": [],
        "warnings": documents(model.warning_records),
        "inputs": case_file.inputs(case),
        "provenance": fitted_case.provenance_of(case, model),
        **({"assumed": list(report.assumed)} if report.assumed else {}),
    }
