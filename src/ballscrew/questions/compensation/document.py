"""The JSON document of a compensation of positions, with verdicts and assumptions of the warm-up behind it."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.questions.compensation.compute import PositionCompensation
from ballscrew.questions.warm_up import verdicts as warm_up_verdicts
from ballscrew.questions.warm_up.compute import WarmUpReport


def document(found: PositionCompensation, report: WarmUpReport) -> dict[str, Any]:
    """The document of a compensation of positions, in SI."""
    return {
        "inputs": case_file.inputs(report.case),
        "results": {
            "position": list(found.positions),
            "error": list(found.errors),
            "worst_error": found.worst_error,
            "cell": found.cell,
            "hours": found.hours,
            "direction": found.direction,
        },
        "units": {"position": "m", "error": "m", "worst_error": "m", "cell": "m", "hours": "h"},
        "assumed": list(report.assumed),
        "warnings": documents(warm_up_verdicts.warnings(report)),
        "verdicts": documents(warm_up_verdicts.verdicts(report)),
        "checks": [],
        "provenance": provenance.of_case(report.case),
    }
