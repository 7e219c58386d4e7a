"""Text of rows of catalogues on the terminal: a list of them, and one with what follows from it."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned
from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.cases.screw_tables.catalogue import DERIVED, FIELDS, assumed, notes
from ballscrew.physics.sizing.catalogue import CONFORMITY_DOUBT, CatalogueRow
from ballscrew.physics.sizing.own_nut import RATED
from ballscrew.physics.sizing.ratings import ratings_of

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
    """What the row of a list says of its ratings and its torque, in few words."""
    texts = notes(row)
    differs = any(note.startswith(("dynamic", "static")) for note in texts)
    return ", ".join(filter(None, ["ratings differ" * differs, "no torque" * bool(row.refusal)]))


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
    """Where a number is from that is not the row's own."""
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
