"""The results of the stiffness of an axis over its stroke, declared once: JSON, units and schema follow from them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated

from ballscrew.basis.quantities import AngularSpeed, Force, Info, Unit
from ballscrew.questions.axis.compute import FRICTION, LOAD, SERIES, SPEED, ChainReport
from ballscrew.questions.shared.declared import FINITE, table_of


class AtPlace(table_of(SERIES)):
    """Numbers at one place of the nut."""


@dataclasses.dataclass(frozen=True, eq=False)
class ChainResults(table_of(SERIES, of=Sequence[float])):
    """Rigidity, lost motion, critical speed and buckling load over the place of the nut."""

    shares: Annotated[Mapping[str, Sequence[float]], Unit("1"), Info("", "share of each spring in the compliance")]
    travel: Annotated[Sequence[float], Unit("m"), Info("", "places of the nut at the ends of its travel", "mm"), FINITE]
    #: False where the places are those of the whole shaft.
    travel_is_known: bool
    #: The place in the travel where the chain gives way most.
    softest: AtPlace
    largest_load: Annotated[Force, LOAD.info]
    largest_speed: Annotated[AngularSpeed, SPEED.info]
    guide_friction: Annotated[Force, FRICTION.info]


def results(report: ChainReport) -> ChainResults:
    """The results of a chain; a spring that is not known is null."""
    return ChainResults(
        **report.series,
        shares=report.chain.shares,
        travel=report.travel,
        travel_is_known=report.travel_is_known,
        softest=AtPlace(**{name: values[report.softest] for name, values in report.series.items()}),
        largest_load=report.largest_load,
        largest_speed=report.largest_speed,
        guide_friction=report.guide_friction,
    )
