"""Self-heating in the documents of a run and of checks: what was taken in place of what."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.questions.shared import declared

if TYPE_CHECKING:  # its solvers are slow to import, and seldom asked for
    from ballscrew.questions.warm_up.self_heating import SelfHeating


def with_self_heating(document: Mapping[str, Any], heating: SelfHeating | None) -> dict[str, Any]:
    """A document with the numbers of self-heating; its inputs are those of the case as it was given."""
    if heating is None:
        return dict(document)
    return {
        **document,
        "inputs": inputs(heating.given),
        "results": {**document.get("results", {}), "self_heating": declared.document(heating.numbers)},
        "units": {**document.get("units", {}), "self_heating": declared.units(heating.numbers)},
        "assumed": [*document.get("assumed", ()), *heating.assumed],
        "verdicts": [*documents(heating.records), *document["verdicts"]],
    }
