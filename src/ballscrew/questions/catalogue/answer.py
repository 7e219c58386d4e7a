"""Response models of the API for rows of the catalogue."""

from __future__ import annotations

from pydantic import Field

from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.own_nut import RATED
from ballscrew.questions.shared.answer_parts import Closed, Record, Tables
from ballscrew.questions.shared.declared import table_of, with_answers

_LISTED, _ALL_OF_ROW = fields_of(CatalogueRow), quantities_of(CatalogueRow)


class ListedRow(table_of(_LISTED)):
    """Numbers that the catalogue lists."""


class DerivedRow(table_of({name: q for name, q in _ALL_OF_ROW.items() if name not in _LISTED})):
    """Numbers that follow from the listed ones."""


class ComputedRatings(table_of({name: _LISTED[name] for name in RATED})):
    """Load ratings by the geometry."""


class CatalogueEntry(with_answers(row=ListedRow, derived=DerivedRow, computed=ComputedRatings)):
    """A row of the catalogue."""

    name: str
    nut: str | None
    source: str
    seal_torque_source: str | None = Field(description="of whose seals the torque is, where it is not the row's own")
    ball_diameter_source: str | None = Field(description="where the ball diameter is from, if not from the row")
    family: str | None = Field(description="series of the maker")
    notes: list[str] = Field(description="ratings far from those by the geometry, and why no torque is computed")


class RowUnits(Closed):
    """SI units of the numbers of a row."""

    row: dict[str, str]
    derived: dict[str, str]
    computed: dict[str, str]


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


class NutEstimate(Closed):
    """A number that the catalogue does not print, with its band, in SI."""

    name: str = Field(description="field of the row or of the screw that it makes")
    value: float
    low: float
    high: float
    unit: str
    shown_in: str = Field(description="unit that people have for it")
    source: str = Field(description="where it is from")


class OwnNut(Closed):
    """A nut of few numbers as a case, what was estimated, and what does not go together."""

    name: str
    case: Tables
    estimates: list[NutEstimate]
    warnings: list[Record]
    provenance: Version
