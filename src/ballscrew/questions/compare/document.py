"""``ballscrew compare --json``: the document of a comparison; all in SI."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.records import Record, documents
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import case_file
from ballscrew.engine.evaluation.comparison import ComparedRule, Comparison, OfBalls, Row, Spread
from ballscrew.physics.friction.validity import NUT_REASONS
from ballscrew.questions.compare.answer import ComparedLaw, by_rules, compared
from ballscrew.questions.shared import declared

_TORQUE = "screw_torque"
#: The units of the numbers by their names, which are the same in all rows.
_UNITS = {name: unit for cls in (ComparedLaw, ComparedRule, OfBalls) for name, unit in declared.units_of(cls).items()}
#: Components named in the verdict on what changes the torque most, and the least change that is shown.
_MOST_SHOWN, LEAST_SHOWN = 3, 0.005


def document(case: case_file.Case, found: Comparison) -> dict[str, Any]:
    """Inputs, all rows in SI, the spread, provenance."""
    failing = {reason for row in found.rows for reason in row.outside}
    return {
        "inputs": case_file.inputs(case),
        **declared.document(compared(found)),
        "units": dict(_UNITS),
        "reasons": {reason: text for reason, text in NUT_REASONS.items() if reason in failing},
        "verdicts": documents(verdicts(found)),
        "checks": [],
        "warnings": documents(warnings(case, found)),
        "provenance": {"version": __version__, "model": case.model.label, "references": case_file.references(case)},
        **declared.document(by_rules(found)),
    }


def warnings(case: case_file.Case, found: Comparison) -> list[Record]:
    """The warnings of the case itself."""
    return [*units.in_display_units_of(found.case.result.warning_records), *case.doubts]


def verdicts(found: Comparison) -> list[Record]:
    """The spread over models, the spread over valid laws, and the components that change the torque most."""
    records: list[Record] = []
    if found.spread_of_models is not None:
        outside = [row.candidate.name for row in found.models if row.outside]
        text = _spread(found.spread_of_models, found.models)
        if outside:
            text = f"{text}; not valid here: {', '.join(outside)}"
        records.append(_spread_record("compare.models", text, found.spread_of_models))
    if found.spread_of_laws is None:
        records.append(units.record("none is valid here", id="compare.laws", subject=_TORQUE, holds=False))
    else:
        valid = [row for row in (found.case, *found.laws) if row.candidate.counts and not row.outside]
        text = _spread(found.spread_of_laws, valid)
        records.append(_spread_record("compare.laws", text, found.spread_of_laws, holds=True))
    spans = {slot: span for slot, span in found.spans.items() if max(map(abs, span)) >= LEAST_SHOWN}
    if spans:
        most = list(spans.items())[:_MOST_SHOWN]
        effects = ", ".join(f"{_words(slot)} ({_span(span)})" for slot, span in most)
        slot, span = most[0]
        records.append(units.record(effects, id="compare.largest_effect", subject=slot, value=max(span, key=abs)))
    return records


def _spread_record(name: str, text: str, spread: Spread, holds: bool | None = None) -> Record:
    least, greatest = (row.torque for row in spread)
    return units.record(text, id=name, subject=_TORQUE, value=greatest - least, unit="N m", holds=holds)


def _spread(spread: Spread, rows: Sequence[Row]) -> str:
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
