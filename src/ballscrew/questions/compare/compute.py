"""Models and laws side by side: all models, and the model of a case with each other law of each slot."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, TypeVar

from ballscrew.basis import units
from ballscrew.basis.errors import overflow_as_input_error
from ballscrew.basis.quantities import Info, Ratio, Torque, Unit, quantities_of
from ballscrew.basis.records import Record, documents
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import inputs, of_case
from ballscrew.cases.case_files.named_calibration import subject_of
from ballscrew.cases.schema.case_schema import MODELS, coefficients_of, name_of_law
from ballscrew.engine.evaluation.comparison import Candidate, ComparedRule, Comparison, OfBalls, Row, compare, same_law
from ballscrew.engine.evaluation.comparison import Spread as TwoRows
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import NUT_REASONS
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.sizing.rules import RULES, Estimate
from ballscrew.physics.solvers.load_distribution import preload_of
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import LEFT_OUT, OneOf, from_attributes


def candidates(case: Case) -> tuple[list[Candidate], list[Candidate]]:
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
    other_laws: list[tuple[str, Any]] = []
    for name, law in LAWS[slot].items():
        if name != named:
            known = coefficients_of(slot, name)
            values = {field: value for field, value in kept.items() if field in known}
            other_laws.append((name, law(**values) if isinstance(law, type) else law))
    for name, model in MODELS.items():
        law = getattr(model, slot)
        if not any(same_law(law, other) for other in (present, *(other for _, other in other_laws))):
            other_laws.append((f"as in {name}", law))
    return other_laws


def _coefficients(law: Any) -> dict[str, Any]:
    """The coefficients of a law; another law takes those it has too, so that only the law differs."""
    if not dataclasses.is_dataclass(law):
        return {}
    return {field.name: getattr(law, field.name) for field in dataclasses.fields(law)}


@overflow_as_input_error()
def comparison(case: Case, done: Callable[[int, int], None] | None = None) -> Comparison:
    """The comparison of a case; ``done(finished, total)`` reports the progress by rows."""
    models, laws = candidates(case)
    result = compare(case.model, models, laws, case.screw, case.lubricant, case.operation, done)
    drag, lost = _drag_torque(case)
    balls = _of_balls(result.case, drag - lost)
    return dataclasses.replace(
        result, rules=_rules(case, balls), drag_torque=drag, of_balls=balls if balls.losses else None
    )


def _of_balls(row: Row, drag: float) -> OfBalls:
    """The case without seals and other losses, which no rule of one line has."""
    losses = {name: float(torque) for name, torque in row.result.losses.items()}
    torque, ideal = row.torque - sum(losses.values()), float(row.result.ideal_torque)
    return OfBalls(torque, Estimate(torque).efficiency(ideal), drag, losses)


def _drag_torque(case: Case) -> tuple[float, float]:
    """Torque of the preloaded nut without load, and what of it are seals and other losses; NaN without preload."""
    if not float(preload_of(case.screw, case.screw.nut)):
        return math.nan, math.nan
    speed = case.operation.screw_speed
    idle = case.model(case.screw, case.lubricant, axial_load=0.0, screw_speed=speed)
    return float(idle.screw_torque), float(sum(idle.losses.values()))


def _rules(case: Case, balls: OfBalls) -> list[ComparedRule]:
    """The rules of one line on the screw of the case, beside the torques of the balls of its model."""
    subject = subject_of(case)
    rows: list[ComparedRule] = []
    for rule in RULES.values():
        estimate = rule.estimate(subject)
        friction, idle = float(estimate.screw_torque), float(estimate.drag_torque)
        rows.append(
            ComparedRule(
                rule.name,
                rule.title,
                rule.formula,
                rule.source,
                friction,
                _change(friction, balls.screw_torque),
                estimate.efficiency(subject.ideal_torque),
                idle,
                _change(idle, balls.drag_torque),
            )
        )
    return rows


def _change(value: float, reference: float) -> float:
    """A value over another, less one; NaN where the other is zero."""
    return value / reference - 1 if reference else math.nan


def models_without_nut(case: Case) -> list[str]:
    """Names of the models that cannot compute the nut of the case, and are left out."""
    models, _ = candidates(case)
    return [c.name for c in models if not c.model.knows(case.screw.nut)]


T = TypeVar("T")
_KNOWN = quantities_of(FrictionResult)
_SLOTS = OneOf(tuple(LAWS))


@dataclasses.dataclass(frozen=True, kw_only=True)
class ComparedModel:
    """The case with one model."""

    #: Of the model, or of the law.
    name: str
    screw_torque: Annotated[Torque, _KNOWN["screw_torque"].info]
    #: Friction torque over that of the case, less one.
    change: Ratio
    #: Parts of the friction torque.
    contributions: Annotated[Mapping[str, float], Unit("N m")]
    efficiency: Annotated[Ratio, _KNOWN["efficiency"].info]
    back_driving_efficiency: Annotated[Ratio, _KNOWN["back_driving_efficiency"].info]
    holding_torque: Annotated[Torque, _KNOWN["holding_torque"].info]
    self_locking: Annotated[bool, _KNOWN["self_locking"].info]
    #: True where all conditions of the model hold.
    valid: bool
    #: The conditions that fail.
    not_valid_because: Sequence[str]


@dataclasses.dataclass(frozen=True, kw_only=True)
class ComparedLaw(ComparedModel):
    """The case with another law in one slot."""

    #: The slot of the law.
    slot: Annotated[str, _SLOTS]
    #: False for a printed form that breaks a balance: it is in no spread.
    counts: bool


@dataclasses.dataclass(frozen=True)
class SpreadEnd:
    """The least or the greatest torque of some models or laws."""

    #: The slot of the law; null of a model.
    slot: Annotated[str | None, _SLOTS]
    #: Of the model, or of the law.
    name: str
    screw_torque: Annotated[Torque, _KNOWN["screw_torque"].info]


@dataclasses.dataclass(frozen=True)
class Ends:
    """Least and greatest torque."""

    #: The least.
    least: SpreadEnd
    #: The greatest.
    greatest: SpreadEnd


@dataclasses.dataclass(frozen=True)
class Spread:
    """Spread of the torque over models and over laws."""

    #: Over all models; null where none has a torque.
    models: Ends | None
    #: Over the laws that count and are valid here; null where none is.
    valid_laws: Ends | None
    #: Changes of the torque by the laws of each slot: the ends.
    change_by_slot: Annotated[Mapping[str, Sequence[float]], Unit("1")]


@dataclasses.dataclass(frozen=True, eq=False)
class Compared:
    """All models and all laws side by side."""

    #: The case with its own model.
    case: ComparedModel
    #: The case with each model.
    models: Sequence[ComparedModel]
    #: The model of the case with another law in one slot.
    laws: Sequence[ComparedLaw]
    #: How far models and laws are apart.
    spread: Spread


@dataclasses.dataclass(frozen=True, eq=False)
class ByRules:
    """The torque by rules of one line, and what they are held against."""

    #: What people use in place of a model; in no spread.
    rules: Sequence[ComparedRule]
    drag_torque: Annotated[
        Torque, Info("M_d", "drag torque of the preloaded nut of the case, seals and other losses included")
    ]
    #: The case without its seals and other losses: what the rules are held against.
    of_balls: Annotated[OfBalls | None, LEFT_OUT]


def compared(result: Comparison) -> Compared:
    """A comparison as it is answered."""
    return Compared(
        case=_row(ComparedModel, result.case),
        models=[_row(ComparedModel, row) for row in result.models],
        laws=[_row(ComparedLaw, row, slot=row.candidate.slot, counts=row.candidate.counts) for row in result.laws],
        spread=Spread(_ends(result.spread_of_models), _ends(result.spread_of_laws), result.spans),
    )


def by_rules(result: Comparison) -> ByRules:
    """The rules of a comparison as they are answered."""
    return ByRules(result.rules, result.drag_torque, result.of_balls)


def _row(cls: type[T], row: Row, **of_law: Any) -> T:
    known = {"name": row.candidate.name, "change": row.change, "valid": not row.outside}
    return from_attributes(cls, row.result, **known, not_valid_because=row.outside, **of_law)


def _ends(spread: TwoRows | None) -> Ends | None:
    if spread is None:
        return None
    return Ends(*(SpreadEnd(row.candidate.slot or None, row.candidate.name, row.torque) for row in spread))


_TORQUE = "screw_torque"
#: The units of the numbers by their names, which are the same in all rows.
_UNITS = {name: unit for cls in (ComparedLaw, ComparedRule, OfBalls) for name, unit in declared.units_of(cls).items()}
#: Components named in the verdict on what changes the torque most, and the least change that is shown.
_MOST_SHOWN, LEAST_SHOWN = 3, 0.005


def document(case: Case, result: Comparison) -> dict[str, Any]:
    """Inputs, all rows in SI, the spread, provenance."""
    failing = {reason for row in result.rows for reason in row.outside}
    return {
        "inputs": inputs(case),
        **declared.document(compared(result)),
        "units": dict(_UNITS),
        "reasons": {reason: text for reason, text in NUT_REASONS.items() if reason in failing},
        "verdicts": documents(verdicts(result)),
        "checks": [],
        "warnings": documents(warnings(case, result)),
        "provenance": of_case(case),
        **declared.document(by_rules(result)),
    }


def warnings(case: Case, result: Comparison) -> list[Record]:
    """The warnings of the case itself."""
    return [*result.case.result.warning_records, *case.doubts]


def verdicts(result: Comparison) -> list[Record]:
    """The spread over models, the spread over valid laws, and the components that change the torque most."""
    records: list[Record] = []
    if result.spread_of_models is not None:
        outside = [row.candidate.name for row in result.models if row.outside]
        text = _spread(result.spread_of_models, result.models)
        if outside:
            text = f"{text}; not valid here: {', '.join(outside)}"
        records.append(_spread_record("compare.models", text, result.spread_of_models))
    if result.spread_of_laws is None:
        records.append(Record("compare.laws", _TORQUE, "none is valid here", holds=False))
    else:
        valid = [row for row in (result.case, *result.laws) if row.candidate.counts and not row.outside]
        text = _spread(result.spread_of_laws, valid)
        records.append(_spread_record("compare.laws", text, result.spread_of_laws, holds=True))
    spans = {slot: span for slot, span in result.spans.items() if max(map(abs, span)) >= LEAST_SHOWN}
    if spans:
        most = list(spans.items())[:_MOST_SHOWN]
        effects = ", ".join(f"{_words(slot)} ({_span(span)})" for slot, span in most)
        slot, span = most[0]
        records.append(Record("compare.largest_effect", slot, effects, value=max(span, key=abs)))
    return records


def _spread_record(name: str, text: str, spread: TwoRows, holds: bool | None = None) -> Record:
    least, greatest = (row.torque for row in spread)
    return Record(name, _TORQUE, text, value=greatest - least, unit="N m", holds=holds)


def _spread(spread: TwoRows, rows: Sequence[Row]) -> str:
    """``0.15 N m (one) to 0.23 N m (other); efficiency 0.934 to 0.952``."""
    low, high = (f"{units.in_unit(row.torque, 'N m')} ({_full_name(row)})" for row in spread)
    efficiencies = [float(row.result.efficiency) for row in rows if math.isfinite(float(row.result.efficiency))]
    if not efficiencies:
        return f"{low} to {high}"
    return f"{low} to {high}; efficiency {min(efficiencies):.3f} to {max(efficiencies):.3f}"


def _full_name(row: Row) -> str:
    name = row.candidate.name
    return f"{_words(row.candidate.slot)} {name}" if row.candidate.slot else name


def _words(name: str) -> str:
    """A component of the model in words."""
    return name.replace("_", " ")


def _span(span: tuple[float, float]) -> str:
    low, *high = [percent(end) for end in span if end]
    return f"{low} to {high[0]}" if high else low


def percent(of: float) -> str:
    """A change in per cent to a tenth; no sign before zero, a dash for what is not finite."""
    if not math.isfinite(of):
        return "–"
    text = f"{of:+.1%}"
    return units.percent(0.0, 1) if text in ("+0.0%", "-0.0%") else units.change(of, 1)
