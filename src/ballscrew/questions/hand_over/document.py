"""``ballscrew hand-over --json``: the document of an export; all in SI."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import Any

from ballscrew.basis import units
from ballscrew.cases.case_files.case import Case
from ballscrew.exports.export import Export, Option, WorstError
from ballscrew.exports.targets import TARGETS, options_of
from ballscrew.questions.shared.declared import from_attributes, parts_like
from ballscrew.questions.shared.envelope import envelope


@dataclasses.dataclass(frozen=True, eq=False)
class HandOverResults(parts_like(Export, "target", "files", "valid_range", "measured_range", "worst_error")):
    """The files of an export, their range and their worst error."""

    #: The files that were written.
    files: Sequence[str]
    #: The worst error of each output over the range.
    worst_error: Mapping[str, WorstError]


def document(export: Export, case: Case, written: Sequence[PurePath]) -> dict[str, Any]:
    """The document of an export that was written."""
    errors = {error.output: error for error in export.worst_error}
    results = from_attributes(HandOverResults, export, files=list(map(str, written)), worst_error=errors)
    units = {name: error.unit for name, error in errors.items()}
    whole = envelope(case, results, units=units, warnings=[*case.implausible(), *export.warnings])
    return {**whole, "provenance": dict(export.provenance)}


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
