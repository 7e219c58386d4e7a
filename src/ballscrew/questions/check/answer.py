"""Response models of the API for the checks of a screw."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.check.compute import BothRatings, Geometry
from ballscrew.questions.run.answer import Loads, Results
from ballscrew.questions.shared.answer_parts import (
    Closed,
    JudgedCheck,
    Provenance,
    Record,
    Tables,
    Template,
    VendorRows,
    field,
)  # fmt: skip
from ballscrew.questions.shared.declared import schema


class OneCheck(JudgedCheck):
    """A check with its text for people."""

    passes: bool | None = Field(description="as ``holds``")
    words: str = Field(description="as ``text``")
    display: Template


class Checks(Closed):
    """The checks of a case, with its results."""

    checks: list[OneCheck]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    holds: bool = Field(description="true where all checks were judged and hold")
    verdict: str
    verdicts: list[Record]
    nut: str = Field(description="kind of the nut; a case without one is checked with a single nut")
    inputs: Tables
    geometry: schema(Geometry)  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    results: Results  # pyright: ignore[reportInvalidTypeForm]  (a model made from the annotations)
    loads: Loads  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    vendor_rows: VendorRows = field(optional=True)
    ratings: schema(BothRatings)  # pyright: ignore[reportInvalidTypeForm]  (made from annotations)
    assumed: list[str]
    units: Tables
    warnings: list[Record]
    provenance: Provenance
