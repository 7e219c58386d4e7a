"""``ballscrew hand-over --json``: the document of an export; all in SI."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import PurePath
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.exports.export import Export
from ballscrew.exports.targets import TARGETS, Option, options_of


def document(export: Export, case: Case, written: Sequence[PurePath]) -> dict[str, Any]:
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


def targets() -> dict[str, Any]:
    """The targets, and the choices that each has."""
    return {
        "targets": [
            {
                "name": name,
                "meaning": target.meaning,
                "options": [
                    {"name": choice, "default": _written(option), "meaning": option.meaning}
                    for choice, option in options_of(name).items()
                ],
            }
            for name, target in TARGETS.items()
        ]
    }


def _written(option: Option) -> str:
    """The usual value of a choice as it is written; empty where the case gives it."""
    value = option.default
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and not math.isfinite(value):
        return ""
    return str(value) if option.quantity is None else units.shown(value, option.quantity)
