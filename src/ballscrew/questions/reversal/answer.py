"""The results of a reversal, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from ballscrew.basis.quantities import Info, Torque, Unit, quantities_of
from ballscrew.physics.moving_balls.friction_states import DahlFit, LuGreFit, SlipElementsFit, WindingUp
from ballscrew.questions.reversal.compute import ANGLE, TORQUE, TRAVEL, Place, ReversalReport
from ballscrew.questions.shared.declared import from_attributes
from ballscrew.questions.shared.envelope import envelope

_CURVE = quantities_of(WindingUp)


@dataclasses.dataclass(frozen=True, eq=False)
class ReversalResults:
    """Friction over the angle of the screw after a reversal or from rest, and the models fitted to it."""

    #: True for a curve from rest.
    from_rest: bool
    screw_angle: Annotated[Sequence[float], Unit("rad"), ANGLE.info]
    travel: Annotated[Sequence[float], Unit("m"), TRAVEL.info]
    screw_torque: Annotated[
        Sequence[float], Unit("N m"), Info("M", "friction torque on the screw, against its new direction")
    ]
    contributions: Annotated[Mapping[str, Sequence[float]], Unit("N m"), Info("", "its parts by mechanism")]
    steady_torque: Annotated[Torque, TORQUE.info]
    steady_contributions: Annotated[Mapping[str, float], Unit("N m"), Info("", "its parts by mechanism")]
    coulomb_torque: Annotated[Torque, _CURVE["coulomb_torque"].info]
    at_once: Annotated[Torque, _CURVE["at_once"].info]
    #: Where 50, 63, 90 and 98 % of the swing are back.
    swing: Sequence[Place]
    #: The same by mechanism, of those that wind up.
    swing_by_mechanism: Mapping[str, Sequence[Place]]
    #: The model of Dahl for the first 0.02° alone; null where the curve has too few angles there.
    dahl_first: DahlFit | None
    #: The model of Dahl with the least squares over the travel.
    dahl: DahlFit
    #: The model LuGre with the same stiffness.
    lugre: LuGreFit
    #: Two, three and four Maxwell-slip elements, as far as they are of use.
    slip_elements: Sequence[SlipElementsFit]


def document(report: ReversalReport) -> dict[str, Any]:
    """The document of a reversal, in SI."""
    results = from_attributes(
        ReversalResults,
        report.reversal,
        coulomb_torque=report.curve.coulomb_torque,
        at_once=report.curve.at_once,
        swing=report.places,
        swing_by_mechanism=report.places_by_mechanism,
        dahl_first=report.first,
        dahl=report.tracking,
        lugre=report.lugre,
        slip_elements=report.elements,
    )
    return envelope(report.case, results, warnings=report.warnings, verdicts=report.verdicts)
