"""Rows of catalogues and own nuts on the terminal: a list of them, and one with what follows from it."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

import tomlkit

from ballscrew.basis import units
from ballscrew.basis.output.text import aligned
from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.basis.records import documents
from ballscrew.basis.version import __version__
from ballscrew.cases.screw_tables.catalogue import DERIVED, FIELDS, assumed, case_text, notes
from ballscrew.physics.sizing.catalogue import CONFORMITY_DOUBT, CatalogueRow
from ballscrew.physics.sizing.own_nut import RATED, Estimate, OwnNut
from ballscrew.physics.sizing.ratings import ratings_of

_COLUMNS = ("estimated", "value", "from", "to", "where it is from")


def own_nut_document(own_nut: OwnNut) -> dict[str, Any]:
    """The nut as the tables of a case, what was estimated with its band in SI, and what does not go together."""
    return {
        "name": own_nut.row.name,
        "case": tomlkit.parse(case_text(own_nut.row, own_nut.estimates)).unwrap(),
        "estimates": [_estimate(one) for one in own_nut.estimates],
        "warnings": documents(own_nut.warnings),
        "provenance": {"version": __version__},
    }


def _estimate(one: Estimate) -> dict[str, Any]:
    return {
        "name": one.name,
        "value": one.value,
        "low": one.low,
        "high": one.high,
        "unit": one.quantity.unit,
        "shown_in": one.quantity.shown_in,
        "source": one.source,
    }


def own_nut_text(own_nut: OwnNut) -> str:
    """Estimates, one line each, and what does not go together."""
    rows = [
        (
            one.name.replace("_", " "),
            *(units.shown(value, one.quantity, digits=4) for value in _values(one)),
            one.source,
        )
        for one in own_nut.estimates
    ]
    lines = aligned([_COLUMNS, *rows], (0, len(_COLUMNS) - 1))
    return "\n".join([*lines, *(f"warning: {line}" for line in warnings(own_nut))])


def warnings(own_nut: OwnNut) -> list[str]:
    """Contradictions, in words."""
    return [one.text for one in own_nut.warnings]


def _values(one: Estimate) -> tuple[float, float, float]:
    return one.value, one.low, one.high


#: Columns of the list: a row of the catalogue in the units people think in.
_LIST = ("name", "d0 x lead [mm]", "ball [mm]", "turns", "balls/turn", "loaded", "C_a [kN]", "C_0a [kN]", "source", "")
_TEXTS = (0, len(_LIST) - 2, len(_LIST) - 1)


def list_text(rows: Sequence[CatalogueRow]) -> str:
    """One line a row."""
    return "\n".join(aligned([_LIST, *map(_cells, rows)], _TEXTS))


def _cells(row: CatalogueRow) -> list[str]:
    size = " x ".join(_number(row, name) for name in ("nominal_diameter", "lead"))
    numbers = [
        _number(row, name)
        for name in (
            "ball_diameter",
            "turns",
            "balls_per_turn",
            "loaded_balls",
            "dynamic_load_rating",
            "static_load_rating",
        )
    ]
    return [row.name, size, *numbers, row.source, _mark(row)]


def _mark(row: CatalogueRow) -> str:
    """Remark on the ratings and the torque of a row of a list, in few words."""
    texts = notes(row)
    differs = any(note.startswith(("dynamic", "static")) for note in texts)
    ball = "ball estimated" * bool(row.ball_diameter_source)
    return ", ".join(filter(None, [ball, "ratings differ" * differs, "no torque" * bool(row.refusal)]))


def _number(row: CatalogueRow, name: str) -> str:
    value = getattr(row, name)
    return "-" if value is None else f"{units.from_si(float(value), quantities_of(CatalogueRow)[name]):.5g}"


def show_text(row: CatalogueRow) -> str:
    """Catalogue row of a screw, the values that follow from it, and the assumptions."""
    kind = f", nut: {row.nut}" if row.nut else ""
    lines = [f"{row.name} ({row.source}){kind}", "", "Listed"]
    unlisted = assumed(row)
    lines += [
        _line(q, getattr(row, n)) + _source(row, n)
        for n, q in FIELDS.items()
        if n not in unlisted and getattr(row, n) is not None
    ]
    lines += ["", "Derived"]
    lines += [
        _line(q, getattr(row, n)) + (_root_doubt(row) if n == "groove_root_diameter" else "")
        for n, q in DERIVED.items()
    ]
    ratings = ratings_of(row)
    lines += [_line(FIELDS[n], value, " by the geometry") for n, value in zip(RATED, ratings, strict=True)]
    lines += ["", "Assumed", *(f"  {words}" for words in (*unlisted.values(), *notes(row)))]
    return "\n".join(lines)


def _source(row: CatalogueRow, name: str) -> str:
    """Source of a number that is not the row's own."""
    source = getattr(row, f"{name}_source", "")
    return f" ({source})" if source else ""


def _line(quantity: Quantity, value: Any, by: str = "") -> str:
    return f"  {quantity.info.meaning + by:<58} {units.shown(value, quantity, digits=5)}"


def _root_doubt(row: CatalogueRow) -> str:
    """Change of the root diameter with the conformity, and the value of the catalogue."""
    quantity = DERIVED["groove_root_diameter"]
    around = [
        dataclasses.replace(row, conformity=row.conformity + doubt).groove_root_diameter
        for doubt in (CONFORMITY_DOUBT, -CONFORMITY_DOUBT)
        if 0.5 < row.conformity + doubt <= 1
    ]
    span = " to ".join(units.shown(value, quantity, digits=5) for value in around)
    listed = "" if row.root_diameter is None else f"; listed: {units.shown(row.root_diameter, quantity, digits=5)}"
    return f" ({span} for a conformity of {row.conformity:g} ± {CONFORMITY_DOUBT:g}{listed})"
