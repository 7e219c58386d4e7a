"""Response models of the API for rows of the catalogue."""

from __future__ import annotations

from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.questions.shared.answer_parts import (
    Closed,
    Tables,
    model,
    quantities,
)

_LISTED, _ALL_OF_ROW = fields_of(CatalogueRow), quantities_of(CatalogueRow)
ListedRow = model("ListedRow", "Numbers that the catalogue lists.", Closed, **quantities(_LISTED))
DerivedRow = model(
    "DerivedRow",
    "Numbers that follow from the listed ones.",
    Closed,
    **quantities({name: q for name, q in _ALL_OF_ROW.items() if name not in _LISTED}),
)


class CatalogueEntry(Closed):
    """A row of the catalogue."""

    name: str
    nut: str | None
    source: str
    row: ListedRow  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    derived: DerivedRow  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)


class RowUnits(Closed):
    """SI units of the numbers of a row."""

    row: dict[str, str]
    derived: dict[str, str]


class Version(Closed):
    """Version of the program."""

    version: str


class Catalogue(Closed):
    """Rows of the catalogue."""

    rows: list[CatalogueEntry]
    units: RowUnits
    provenance: Version


class Row(CatalogueEntry):
    """One row, and a case that starts from it."""

    assumed: dict[str, str]
    units: RowUnits
    provenance: Version
    case: Tables
