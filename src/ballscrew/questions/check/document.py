"""The JSON documents of checks: one screw, or a list of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.cases.screw_tables.nut_kinds import kind_of
from ballscrew.physics.sizing.checks import Check, judged
from ballscrew.questions.check.compute import Checked
from ballscrew.questions.run import answer as run
from ballscrew.questions.run.answer import results
from ballscrew.questions.shared.check_lines import source_document
from ballscrew.questions.shared.envelope import numbers
from ballscrew.questions.warm_up.self_heating_document import with_self_heating


def document(checked: Checked) -> dict[str, Any]:
    """The document of one screw, in SI."""
    return with_self_heating(_document(checked), checked.heating)


def _document(checked: Checked) -> dict[str, Any]:
    case, beside = checked.case, {**run.beside(checked.run), "geometry": checked.geometry, "ratings": checked.ratings}
    return {
        "name": checked.name,
        "nut": kind_of(checked.nut.nut),
        "inputs": case_file.inputs(case),
        **numbers(results=results(checked.run), **beside),
        "checks": [check_document(check) for check in checked.checks],
        "judged": judged(checked.checks),
        "holds": checked.holds,
        "verdict": checked.verdict,
        "verdicts": documents(checked.verdicts),
        "assumed": list(checked.assumed),
        "warnings": documents(checked.run.warnings),
        "provenance": provenance.of_case(case),
    }


def list_document(results: Sequence[Checked]) -> list[dict[str, Any]]:
    """The documents of many screws, without the loads ball by ball."""
    listed = [document(screw) for screw in results]
    for each in listed:
        del each["loads"]["balls"], each["units"]["loads"]["balls"]
    return listed


def check_document(check: Check) -> dict[str, Any]:
    """A check as a record, what it lacks, its source, and ``name``, ``utilisation``, ``passes`` and ``words``."""
    older = {"name": check.name, "utilisation": check.utilisation, "passes": check.holds, "words": check.text}
    return {**check.record.document(), "missing": check.missing, **source_document(check), **older}
