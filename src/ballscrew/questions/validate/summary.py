"""No-load torques by maker and kind of nut in one table: the model, its calibrations, and rules of one line."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ballscrew.evidence.validation.entries import Entry, RuleEntry, may_be_fitted
from ballscrew.physics.friction.calibrations import calibrated, calibrations
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.sizing.rules import DRAG_RULES
from ballscrew.questions.validate.compute import Request, entries_of

#: What the rows of the table are of.
MODEL, CALIBRATION, RULE = "model", "calibration", "rule"
_CHOSEN_MODEL = FrictionModel.reference().name
_BEHIND = "rule {rule}: the values stated are computed by it"


@dataclasses.dataclass(frozen=True, kw_only=True)
class SummaryRow:
    """A model or a rule against the no-load torques of one maker for one kind of nut."""

    maker: str
    nut: str
    #: The set that the rows are of.
    set: str
    #: One of ``model``, ``calibration`` and ``rule``.
    kind: str
    name: str
    n: int
    mean_ratio: float
    #: Standard deviation of a sample, divided by n − 1; NaN of one row.
    std_ratio: float
    share_in_band: float | None
    #: Exponents of the ratio over diameter and lead, of one fit of both; empty where the rows do not tell them.
    exponents: Mapping[str, float]
    #: What was chosen with these rows in sight; empty where they were never used.
    chosen_on: Sequence[str]


def summary(request: Request, result: Sequence[Sequence[Entry]] = ()) -> tuple[list[SummaryRow], list[str]]:
    """The table of the sets of a request that are torques of known nuts, and notes on rows left out.

    ``found`` has entries that were computed before, whose notes were said then.
    """
    known = {(entry.data.name, entry.calibration): entry for entries in result for entry in entries}
    rows: list[SummaryRow] = []
    notes: list[str] = []
    for entries, of_rows in _entries(request, known):
        rows += _of_groups(entries)
        notes += of_rows if not result else []
    return rows, notes


def _entries(
    request: Request, known: Mapping[tuple[str, str | None], Entry]
) -> Iterator[tuple[list[Entry], list[str]]]:
    """Each set with the model, and with every calibration of it, and notes on its rows."""
    fits = [each for each in calibrations().values() if each.model == request.model.name]
    for data in request.sets:
        if not data.of_screws or not data.calibratable or data.loaded or data.alternatives or data.bound:
            continue
        models = [(request.model, None), *((calibrated(request.model, fit), fit.name) for fit in fits)]
        missing = [(model, name) for model, name in models if (data.name, name) not in known]
        computed, notes = entries_of(data, missing, request) if missing else ([], [])
        every = {**known, **{(data.name, entry.calibration): entry for entry in computed}}
        yield [every[data.name, name] for _, name in models], notes


def _of_groups(entries: Sequence[Entry]) -> Iterator[SummaryRow]:
    """The rows of a set: its models and rules, one kind of nut after the other."""
    for group in entries[0].groups:
        of_group = [entry.groups[group] for entry in entries]
        for entry in of_group:
            name = entry.calibration or entry.model.name
            fitted = _fitted(entry, name)
            # what was chosen is of the reference; other models have none of it
            chosen = [*(entry.data.used_for if entry.model.name == _CHOSEN_MODEL else ()), *fitted]
            yield _row(entry, group, CALIBRATION if entry.calibration else MODEL, name, entry, chosen)
        for rule in of_group[0].rules:
            if rule.rule in DRAG_RULES:
                behind = [_BEHIND.format(rule=rule.rule)] if rule.rule in of_group[0].data.rules_behind else []
                yield _row(of_group[0], group, RULE, rule.rule, rule, behind)


def _fitted(entry: Entry, calibration: str) -> list[str]:
    """That a calibration was fitted to rows of a group: to all of its file, or to those that are declared."""
    if calibration not in entry.data.calibrations:
        return []
    if not calibrations()[calibration].declared_rows:
        return [f"calibration {calibration}, fitted"]
    of = sum(may_be_fitted(entry.data.name, point) for point in entry.points)
    return [f"calibration {calibration}, fitted to {of} of {len(entry.points)} rows"] if of else []


def _row(entry: Entry, group: str, kind: str, name: str, of: Entry | RuleEntry, chosen: Sequence[str]) -> SummaryRow:
    return SummaryRow(
        maker=entry.data.maker,
        nut=group,
        set=entry.data.name,
        kind=kind,
        name=name,
        n=len(entry.counted) if isinstance(of, Entry) else of.n,
        mean_ratio=of.mean_ratio,
        std_ratio=of.std_ratio,
        share_in_band=of.share_in_band,
        exponents=of.exponents,
        chosen_on=chosen,
    )


def document(rows: Sequence[SummaryRow]) -> dict[str, Any]:
    """The table as a document."""
    return {"summary": [dataclasses.asdict(row) for row in rows]}
