"""The JSON document of a selection: the candidates of a need, the best first."""

from __future__ import annotations

from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.basis.records import Message, documents
from ballscrew.cases.case_files import provenance
from ballscrew.physics.friction.starvation import STARVED
from ballscrew.physics.sizing.checks import failing, judged, verdict_of
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.check import document as check_documents
from ballscrew.questions.duty import verdicts as duty_verdicts
from ballscrew.questions.select import case_text
from ballscrew.questions.select.answer import (
    OfMotion,
    OneCandidate,
    candidate,
    fails,
    objective,
    of_motion,
    worst,
)  # fmt: skip
from ballscrew.questions.select.candidates import Candidate
from ballscrew.questions.select.compute import Plan, Ranked, Selection
from ballscrew.questions.select.need import Need
from ballscrew.questions.select.requirements import Requirements
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.check_lines import with_unlikely

_LIFT_OFF = quantities_of(BallLoads)["lift_off_load"]
#: What is the same for all candidates, or too long for a list.
_LEFT_OUT = ("units", "provenance", "loads", "name", "checks", "judged", "holds", "verdict")


def document(found: Selection) -> dict[str, Any]:
    """The document in SI; ``results`` and ``checks`` of a candidate are those of ``ballscrew check --json``."""
    first = next((each.candidate for each in found.ranked if each.candidate.complete), None)
    known: dict[str, Any] = {} if first is None else check_documents.list_document([first.checked])[0]["units"]
    known.pop("loads", None)
    best, moves = found.best, found.need.moves
    return {
        "need": need_document(found.need),
        "objectives": objectives_document(found.objectives),
        "best": None if best is None else best.variant.label,
        "holding": len(found.holding),
        "ruled_out": sum(not each.candidate.complete for each in found.ranked),
        "candidates": [candidate_document(each, found.need, found.model) for each in found.ranked],
        "notes": list(found.notes),
        "warnings": documents(next((each.candidate.starved for each in found.ranked if each.candidate.starved), [])),
        "units": {
            **known,
            **declared.units_of(OneCandidate),
            **(declared.units_of(OfMotion) if moves else {}),
        },
        "provenance": provenance.of_case(found.ranked[0].candidate.case) if found.ranked else None,
    }


def plan_document(plan: Plan) -> dict[str, Any]:
    """What a selection would do, before it is done."""
    return declared.document(plan)


def row_document(found: Candidate) -> dict[str, Any]:
    """A candidate as it comes, before it has a rank: what is seen in the list."""
    return {
        "label": found.variant.label,
        "complete": found.complete,
        "fits": found.fits,
        "holds": found.holds,
        "worst": worst(found),
        "fails": declared.document(fails(found)),
        "objectives": dict(found.objectives),
    }


def need_document(need: Need) -> dict[str, Any]:
    """A need: its tables as they are written, what it requires in SI, and the choices that are open."""
    required = need.requirements
    numbers = {name: getattr(required, name) for name in fields_of(Requirements)}
    return {
        "name": need.name,
        "tables": dict(need.tables),
        "requirements": {
            **{name: value for name, value in numbers.items() if value is not None},
            "back_driving": required.back_driving,
            **({"accuracy": required.accuracy} if required.accuracy else {}),
        },
        "choices": {"nut": list(need.nuts), "preload": list(need.preloads), "oils": [dict(oil) for oil in need.oils]},
        "rows": need.rows,
        "assumed": list(need.notes),
    }


def objectives_document(names: Any) -> list[dict[str, Any]]:
    """Objectives with meaning, unit, and the direction that is better."""
    return [declared.document(objective(name)) for name in names]


def candidate_document(ranked: Ranked, need: Need, model: str | None = None) -> dict[str, Any]:
    """One candidate: the document of its check, with its rank, what fails, the numbers compared, and its case file."""
    found = ranked.candidate
    whole: dict[str, Any] = {"results": {}, "verdicts": [], "warnings": [], "assumed": []}
    if found.run is not None:
        whole = check_documents.list_document([found.run])[0]
        if found.duty is not None:  # of the cycle, and not of steady travel
            for name, more in (("verdicts", duty_verdicts.inertia), ("warnings", duty_verdicts.inertia_warnings)):
                whole[name] = [one for one in whole[name] if one["id"] != STARVED] + documents(more(found.duty))
        if not any(one["id"] == STARVED for name in ("verdicts", "warnings") for one in whole[name]):
            # of the cycle, or of the nut without load
            whole["warnings"] = [*documents(found.starved), *whole["warnings"]]
    return {
        **declared.document(candidate(ranked, verdict(found), case_text.tables(found, need, model))),
        "results": whole.pop("results"),
        **({} if found.duty is None else declared.document(of_motion(found.duty))),
        "checks": [check_documents.check_document(check) for check in found.checks],
        "judged": judged(found.checks),
        **{name: part for name, part in whole.items() if name not in (*_LEFT_OUT, "nut")},
    }


def verdict(found: Candidate) -> str:
    """All checks in a few words, with the utilisation of those that fail."""
    if found.complete:
        said = verdict_of(found.checks, passes=Message("holds"), by_how_much=True)
    else:
        said = Message("cannot hold: {names}", {"names": [failing(check) for check in found.failed]})
    text = units.filled(with_unlikely(said, found.case))
    limit = found.rigid_lift_off_load
    if limit is not None:
        text += f"; preload lost (rigid bodies: above {units.shown(limit, _LIFT_OFF)})"
    return text if found.valid else f"{text}; outside the model's validity"
