"""The results of a compensation of positions, declared once; verdicts are those of the warm-up behind it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

from ballscrew.basis.quantities import Length, Unit
from ballscrew.questions.compensation.compute import PositionCompensation
from ballscrew.questions.shared.envelope import envelope
from ballscrew.questions.warm_up import verdicts
from ballscrew.questions.warm_up.compute import WarmUpReport


class CompensationResults(NamedTuple):
    """Positions of an axis, and by how much the nut is farther along there than its encoder says."""

    position: Annotated[Sequence[float], Unit("m")]
    error: Annotated[Sequence[float], Unit("m")]
    #: What straight lines between the positions miss of the computed growth.
    worst_error: Length
    #: Length of the cells of the shaft.
    cell: Length
    hours: Annotated[float, Unit("h")]
    #: Positions grow away from the fixed bearing, or towards it.
    direction: str


def document(found: PositionCompensation, report: WarmUpReport) -> dict[str, Any]:
    """The document of a compensation of positions, in SI."""
    return envelope(
        report.case,
        CompensationResults(
            found.positions.tolist(), found.errors.tolist(), found.worst_error, found.cell, found.hours, found.direction
        ),
        assumed=report.assumed,
        warnings=verdicts.warnings(report),
        verdicts=verdicts.verdicts(report),
    )
