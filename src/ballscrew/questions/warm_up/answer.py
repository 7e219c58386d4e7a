"""Response models of the API for warming up."""

from __future__ import annotations

from typing import Any, Literal

from ballscrew.basis.quantities import Quantity
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
from ballscrew.questions.warm_up.compute import EQUILIBRIUM, SERIES


def _lists(quantity: Quantity) -> Any:
    return list[Number], field(f"{quantity.info.meaning} at each instant, SI", quantity.unit)


Equilibrium = model(
    "Equilibrium",
    "The steady state; null where there is none.",
    Open,
    exists=(bool, ...),
    margin=(Number, field("stability margin of the thermal loop: 1 less its gain; thermal runaway at 0")),
    **quantities(EQUILIBRIUM),
)


class Heat(Closed):
    """Heat until the end; generated is stored and lost."""

    generated: Number = field("heat of friction, SI", "J")
    stored: Number = field("heat stored, SI", "J")
    lost: Number = field("heat lost to the surroundings, SI", "J")


FullBath = model(
    "FullBath",
    "Numbers over time in a full bath of oil, and where they end.",
    Open,
    **{name: _lists(quantity) for name, quantity in SERIES.items() if not name.startswith("heat_")},
    equilibrium=(Equilibrium, ...),
)


WarmUpResults = model(
    "WarmUpResults",
    "Numbers over time, where they end, and what heat does at places.",
    Open,
    **{name: _lists(quantity) for name, quantity in SERIES.items() if not name.startswith("heat_")},
    flooded_torque=(Number, field("mean friction torque of the screw at the start, in a full bath of oil, SI", "N m")),
    full_bath=(FullBath | None, field("the same in a full bath of oil; null where nothing is starved of oil")),
    works=(list[bool], ...),
    stopped=(Number, field("time after which oil or preload are outside what is known, SI", "s")),
    source=(Literal["spread", "moving"], field("whether the heat is spread over the stroke, or goes with the nut")),
    equilibrium=(Equilibrium, ...),
    heat=(Heat, ...),
    drift=(Tables, ...),
    compensation=(Tables, ...),
    shaft=(Tables, ...),
    stretch_left=(list[Number] | None, field("stretch left of a shaft between fixed ends, SI", "m")),
    network=(dict[str, Number | list[Number]], ...),
)


class WarmUpBands(Open):
    """Bands over time and in the steady state."""

    level: float
    samples: int
    time: list[float] = field("instants, SI", "s")
    known_share: list[float] = field("share of the samples whose friction is known at each instant")
    equilibrium: Tables
    inputs: Tables


class WarmUp(Closed):
    """How a case warms up."""

    inputs: Tables
    results: WarmUpResults  # pyright: ignore[reportInvalidTypeForm]  (a model made from the annotations)
    units: Tables
    assumed: list[str]
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance
    band: WarmUpBands = field(optional=True)
