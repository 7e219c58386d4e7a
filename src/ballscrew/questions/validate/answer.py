"""``ballscrew validate --json``: the documents of a validation; all in SI."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Sequence
from typing import Any

from ballscrew.basis import records, units
from ballscrew.basis.records import Record
from ballscrew.evidence.validation.entries import Entry, Point, ValidationSet
from ballscrew.questions.shared.declared import attributes


def documents(entries: Sequence[Entry]) -> list[dict[str, Any]]:
    """A document for each set and model, uncalibrated first."""
    return [_document(entry) for entry in sorted(entries, key=lambda entry: entry.calibration is not None)]


def _document(entry: Entry) -> dict[str, Any]:
    return {
        "set": entry.data.name,
        "model": entry.model.name,
        "calibration": entry.calibration,
        "n": len(entry.counted),
        **attributes(entry, "mean_ratio", "std_ratio", "share_in_band"),
        **_more(entry),
        "used_for": entry.used_for,
        **({"groups": groups} if (groups := _groups(entry)) else {}),
        **_rules(entry),
        **({"alternatives": True, "range_ratio": list(entry.range_ratio)} if entry.data.alternatives else {}),
        **({"upper_bound": True} if entry.data.bound else {}),
        **({} if entry.data.card is None else {"card": dict(entry.data.card)}),
        "verdicts": [],
        "checks": records.documents(checks(entry)),
        "warnings": records.documents(warnings(entry)),
        "rows": [_row(point, entry.data) for point in entry.points],
    }


def _more(entry: Entry) -> dict[str, Any]:
    """Statistics of rows beyond the ratio and its scatter: own uncertainty bands, exponents, other definitions."""
    share, means = entry.share_in_uncertainty_band, entry.mean_definitions
    return {
        **({} if share is None else {"share_in_uncertainty_band": share, "uncertainty_width": entry.uncertainty_width}),
        "exponents": dict(entry.exponents),
        **{f"{name}_mean_ratio": means[name] for name in entry.data.ratio_names if name in means},
        **({"definitions": dict(means)} if means else {}),
    }


def _groups(entry: Entry) -> dict[str, Any]:
    """The statistics of the rows of each kind of nut, or of each maker, and the rules over them."""
    return {
        name: {
            "n": len(group.counted),
            **attributes(group, "mean_ratio", "std_ratio", "range_ratio", "share_in_band"),
            **_more(group),
            **_rules(group),
        }
        for name, group in entry.groups.items()
    }


def _rules(entry: Entry) -> dict[str, Any]:
    return {"rules": rules} if (rules := [dataclasses.asdict(rule) for rule in entry.rules]) else {}


def _row(point: Point, data: ValidationSet) -> dict[str, Any]:
    low, high, certain = point.band.low, point.band.high, point.uncertainty
    named = {key: point.definitions.get(name) if name else point.ratio for name, key in data.ratio_names.items()}
    apart = [{**limit._asdict(), "ratio": limit.ratio} for limit in point.upper_limits]
    of_others = {**attributes(point, "definitions", "laws"), "apart": apart}
    return {
        "name": point.name,
        "unit": data.quantity.unit,
        **({"group": point.group} if point.group else {}),
        "value": point.value,
        **point.band._asdict(),
        "band": None if low is None or high is None else [low, high],
        **attributes(point, "ratio", "in_band", "residual"),
        "residual_in_half_bands": point.deviation,
        **({} if certain is None else {"uncertainty_band": list(certain), **attributes(point, "in_uncertainty_band")}),
        **{key: ratio for key, ratio in named.items() if ratio is not None},
        **{name: ratios for name, ratios in of_others.items() if ratios},
        "descriptors": dict(point.descriptors),
        "warnings": [f"{record.name}: {record.text}" for record in point.warnings],
    }


def checks(entry: Entry) -> list[Record]:
    """The share of rows in the vendor's band; nothing where no row has a band."""
    share = entry.share_in_band
    if share is None:
        return []
    message = f"{units.percent(share)} of the rows lie in their band"
    return [
        Record(
            "validation.share_in_band",
            entry.data.name,
            message,
            severity="info" if share == 1 else "warning",
            holds=share == 1,
            value=share,
            limit=1.0,
        )
    ]


def warnings(entry: Entry) -> list[Record]:
    """The conditions of the model that fail, each with its number of rows; rows without a number."""
    every = [record for point in entry.points for record in point.warnings]
    rows = Counter(record.id for record in every)
    first = {record.id: record for record in reversed(every)}
    records = [
        _rows_record(first[name].name, first[name].subject, first[name].text, count) for name, count in rows.items()
    ]
    missing = len(entry.points) - len(entry.counted)
    if missing:
        records.append(_rows_record("no_number", entry.data.name, "the model gives no number", missing))
    return records


def _rows_record(name: str, subject: str, message: str, rows: int) -> Record:
    return Record.warning(
        f"validation.{name}", subject, f"{units.fixed(rows)} rows: {message}", value=float(rows), limit=0.0
    )
