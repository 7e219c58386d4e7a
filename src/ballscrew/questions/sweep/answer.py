"""Response models of the API for a sweep."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from ballscrew.questions.shared.answer_parts import (
    Closed,
    Provenance,
    Record,
)


class Values(Closed):
    """Values along the axes of a sweep, in their order, one array in the other."""

    values: list[Any]
    unit: str = Field(description="SI")
    meaning: str


class Swept(Values):
    """Values of an output, with the ends of its band where bands were asked for."""

    low: list[Any] | None = None
    high: list[Any] | None = None


class SweepBand(Closed):
    """What the bands of a sweep are of."""

    level: float
    samples: int = Field(description="of each point")
    seed: int


class Sweep(Closed):
    """Results over ranges of the operating point or of other fields."""

    axes: dict[str, Values]
    outputs: dict[str, Swept]
    band: SweepBand | None = None
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance
