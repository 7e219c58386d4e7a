"""Models and laws side by side: all models, and the model of a case with each other law of each slot."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

from ballscrew.basis.overflow import overflow_as_input_error
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.makers_rules import subject_of
from ballscrew.cases.schema.case_schema import LAWS, MODELS, coefficients_of, name_of_law
from ballscrew.engine.evaluation.comparison import Candidate, ComparedRule, Comparison, OfBalls, Row, compare, same_law
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.sizing.rules import RULES, Estimate
from ballscrew.physics.solvers.load_distribution import preload_of


def candidates(case: case_file.Case) -> tuple[list[Candidate], list[Candidate]]:
    """All models, and the case's model with each other law of each slot.

    A law has its own coefficients, but keeps what the case has changed if it has that coefficient, too.
    """
    own = case.model
    # a model changed by nothing is the preset: one row stands for both
    models = [Candidate(name, own if own.label == name else model) for name, model in MODELS.items()]
    laws: list[Candidate] = []
    for slot in LAWS:
        for name, law in _other_laws(slot, own):
            counts = not traits_of(law).printed_form
            laws.append(Candidate(name, case_file.changed(own, {slot: law}), slot, counts))
    return models, laws


def _other_laws(slot: str, own: Any) -> list[tuple[str, Any]]:
    """The laws that a slot could have instead, by name; then other coefficients that a model has for them."""
    present = getattr(own, slot)
    named = name_of_law(slot, present)
    kept = _coefficients(present)
    found: list[tuple[str, Any]] = []
    for name, law in LAWS[slot].items():
        if name != named:
            known = coefficients_of(slot, name)
            values = {field: value for field, value in kept.items() if field in known}
            found.append((name, law(**values) if isinstance(law, type) else law))
    for name, model in MODELS.items():
        law = getattr(model, slot)
        if not any(same_law(law, other) for other in (present, *(other for _, other in found))):
            found.append((f"as in {name}", law))
    return found


def _coefficients(law: Any) -> dict[str, Any]:
    """The coefficients of a law; another law takes those it has too, so that only the law differs."""
    if not dataclasses.is_dataclass(law):
        return {}
    return {field.name: getattr(law, field.name) for field in dataclasses.fields(law)}


@overflow_as_input_error()
def comparison(case: case_file.Case, done: Callable[[int, int], None] | None = None) -> Comparison:
    """The comparison of a case; ``done(finished, total)`` reports the progress by rows."""
    models, laws = candidates(case)
    found = compare(case.model, models, laws, case.screw, case.lubricant, case.operation, done)
    drag, lost = _drag_torque(case)
    balls = _of_balls(found.case, drag - lost)
    return dataclasses.replace(
        found, rules=_rules(case, balls), drag_torque=drag, of_balls=balls if balls.losses else None
    )


def _of_balls(row: Row, drag: float) -> OfBalls:
    """The case without seals and other losses, which no rule of one line has."""
    losses = {name: float(torque) for name, torque in row.result.losses.items()}
    torque, ideal = row.torque - sum(losses.values()), float(row.result.ideal_torque)
    return OfBalls(torque, Estimate(torque).efficiency(ideal), drag, losses)


def _drag_torque(case: case_file.Case) -> tuple[float, float]:
    """Torque of the preloaded nut without load, and what of it are seals and other losses; NaN without preload."""
    if not float(preload_of(case.screw, case.screw.nut)):
        return math.nan, math.nan
    speed = case.operation.screw_speed
    idle = case.model(case.screw, case.lubricant, axial_load=0.0, screw_speed=speed)
    return float(idle.screw_torque), float(sum(idle.losses.values()))


def _rules(case: case_file.Case, balls: OfBalls) -> list[ComparedRule]:
    """The rules of one line on the screw of the case, beside the torques of the balls of its model."""
    subject = subject_of(case)
    rows: list[ComparedRule] = []
    for rule in RULES.values():
        found = rule.estimate(subject)
        friction, idle = float(found.screw_torque), float(found.drag_torque)
        rows.append(
            ComparedRule(
                rule.name,
                rule.title,
                rule.formula,
                rule.source,
                friction,
                _change(friction, balls.screw_torque),
                found.efficiency(subject.ideal_torque),
                idle,
                _change(idle, balls.drag_torque),
            )
        )
    return rows


def _change(value: float, reference: float) -> float:
    """A value over another, less one; NaN where the other is zero."""
    return value / reference - 1 if reference else math.nan


def models_without_nut(case: case_file.Case) -> list[str]:
    """Names of the models that cannot compute the nut of the case, and are left out."""
    models, _ = candidates(case)
    return [c.name for c in models if not c.model.knows(case.screw.nut)]
