"""The JSON document of an optimisation: the front, each member by the full model."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.quantities import fields_of
from ballscrew.basis.records import documents
from ballscrew.physics.sizing.checks import judged
from ballscrew.questions.check import document as check_documents
from ballscrew.questions.optimise.compute import Member, Optimisation
from ballscrew.questions.optimise.design_space import VARIABLES
from ballscrew.questions.select.candidates import Starved
from ballscrew.questions.select.document import need_document, objectives_document
from ballscrew.questions.select.objectives import OBJECTIVES

#: What is the same for all members, or too long for a list.
_LEFT_OUT = ("units", "provenance", "loads", "name", "nut", "results", "checks", "judged", "holds", "verdict")


def document(found: Optimisation) -> dict[str, Any]:
    """The document in SI; ``results`` and ``checks`` of a member are those of ``ballscrew check --json``."""
    space = found.space
    first = check_documents.list_document([found.members[0].checked])[0] if found.members else {}
    units = dict(first.get("units", {}))
    units.pop("loads", None)
    return {
        "need": need_document(found.need),
        "nut": space.nut,
        "objectives": objectives_document(space.objectives),
        "bounds": {name: list(span) for name, span in space.bounds.items()},
        "ratios": {name: list(span) for name, span in space.ratios.items()},
        "search": {
            **{name: getattr(space.options, name) for name in fields_of(type(space.options))},
            "evaluations": found.evaluations,
            "front": len(found.front.designs),
            "engine": found.engine[0],
            "engine_reason": found.engine[1],
            "largest_change": dict(found.largest_change),
        },
        "candidates": [_member(each) for each in found.members],
        "notes": list(found.notes),
        "warnings": documents(
            next(filter(None, (Starved.of(each.checked, None).records for each in found.members)), [])
        ),
        "units": {
            **units,
            "variables": {name: quantity.unit for name, quantity in VARIABLES.items()},
            "objectives": {name: each.quantity.unit for name, each in OBJECTIVES.items()},
        },
        "provenance": first.get("provenance"),
    }


def _member(found: Member) -> dict[str, Any]:
    whole = check_documents.list_document([found.checked])[0]
    return {
        "name": found.checked.name,
        "variables": dict(found.variables),
        "holds": found.holds,
        "valid": found.valid,
        "pareto": found.pareto,
        "searched": dict(found.searched),
        "objectives": dict(found.objectives),
        "results": whole["results"],
        "checks": [check_documents.check_document(check) for check in found.checks],
        "judged": judged(found.checks),
        **{name: part for name, part in whole.items() if name not in _LEFT_OUT},
        "case": dict(found.case),
    }
