"""``ballscrew hand-over --json``: the document of an export; all in SI."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ballscrew.cases import case_file
from ballscrew.cases.case import Case
from ballscrew.exports.export import Export
from ballscrew.records import documents


def document(export: Export, case: Case, written: Sequence[Path]) -> dict[str, Any]:
    """The document of an export that was written."""
    return {
        "inputs": case_file.inputs(case),
        "results": {
            "target": export.target,
            "files": [str(path) for path in written],
            "valid_range": {name: list(ends) for name, ends in export.valid_range.items()},
            "measured_range": {name: list(ends) for name, ends in export.measured_range.items()},
            "worst_error": {one.output: one.document() for one in export.worst_error},
        },
        "units": {one.output: one.unit for one in export.worst_error},
        "warnings": documents([*case.implausible(), *export.warnings]),
        "verdicts": [],
        "checks": [],
        "provenance": dict(export.provenance),
    }
