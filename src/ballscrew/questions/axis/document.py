"""The JSON document of the chain of an axis: rigidity, lost motion, critical speed and buckling over its stroke."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.questions.axis.answer import results
from ballscrew.questions.axis.compute import ChainReport
from ballscrew.questions.shared import declared


def document(report: ChainReport) -> dict[str, Any]:
    """The document of a chain, in SI."""
    found = results(report)
    return {
        "inputs": case_file.inputs(report.case),
        "results": declared.document(found),
        "units": declared.units(found),
        "assumed": list(report.assumed),
        "warnings": documents(report.case.implausible()),
        "verdicts": documents(report.verdicts),
        "checks": [],
        "provenance": provenance.of_case(report.case),
    }
