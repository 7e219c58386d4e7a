"""Response models of the API for the stiffness of an axis over its stroke."""

from __future__ import annotations

from ballscrew.questions.axis.compute import FRICTION, LOAD, SERIES, SPEED
from ballscrew.questions.shared.answer_parts import (
    Closed,
    Number,
    Open,
    Provenance,
    Record,
    Tables,
    field,
    model,
    quantities,
)

ChainResults = model(
    "ChainResults",
    "Rigidity, lost motion, critical speed and buckling load over the place of the nut.",
    Open,
    **{name: (list[Number], field(f"{q.info.meaning}, SI", q.unit)) for name, q in SERIES.items()},
    shares=(dict[str, list[Number]], field("share of each spring in what gives way")),
    travel=(list[float], field("places of the nut at the ends of its travel, SI", "m")),
    **quantities({q.name: q for q in (LOAD, SPEED, FRICTION)}),
)


class Chain(Closed):
    """What gives way between the motor and the table of an axis, over its stroke."""

    inputs: Tables
    results: ChainResults  # pyright: ignore[reportInvalidTypeForm]  (a model made from the annotations)
    units: Tables
    assumed: list[str]
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance
