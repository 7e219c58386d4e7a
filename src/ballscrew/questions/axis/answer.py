"""The results of the stiffness of an axis over its stroke, declared once: JSON, units and schema follow from them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from ballscrew.basis.quantities import AngularSpeed, Force, Info, Unit
from ballscrew.questions.axis.compute import FRICTION, LOAD, SERIES, SPEED, ChainReport
from ballscrew.questions.shared.declared import FINITE, from_attributes, table_of
from ballscrew.questions.shared.envelope import envelope


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


def document(report: ChainReport) -> dict[str, Any]:
    """The document of a chain, in SI; a spring that is not known is null."""
    softest = AtPlace(**{name: values[report.softest] for name, values in report.series.items()})
    results = from_attributes(ChainResults, report, **report.series, shares=report.chain.shares, softest=softest)
    return envelope(
        report.case,
        results,
        assumed=report.assumed,
        warnings=report.case.implausible(),
        verdicts=report.verdicts,
    )
