"""A bearing at its end of the shaft: its share of the load, and how far it gives way."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any

from ballscrew.axis.supports.bearing import SupportBearing
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, faults_of, nearest, raise_if_any
from ballscrew.basis.quantities import Force, Info, Ratio, Stiffness
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.element import ElementFriction, FrictionElement

#: Ends of the shaft and the names of the bearings there. The fixed one holds the shaft along its axis, at the motor,
#: and positions count from it; the others are at the far end.
PLACES: Mapping[str, str] = {
    "fixed": "fixed bearing",
    "floating": "floating bearing",
    "second_fixed": "second fixed bearing",
}


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class MountedBearing(ByValue):
    """The bearing, or the set of bearings, at one end of the shaft, with its share of the axial load of the screw.

    A :class:`~ballscrew.physics.friction.element.FrictionElement`, called with the load of the whole screw. What a
    shaft is stretched with loads both ends and is no part of that: it belongs into the preload.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, and for an unknown place.
    """

    place: str
    element: FrictionElement
    load_share: Annotated[
        Ratio,
        Info(
            "s_L",
            "share of the axial load of the screw that the bearing takes",
            at_least=0,
            at_most=1,
            hint="1 of the only fixed bearing, about 0.5 of one of two, 0 of a floating one",
        ),
    ]
    rigidity: Annotated[
        Stiffness | None,
        Info(
            "R_b",
            "axial rigidity of the bearing with its rings, as its maker prints it",
            "N/um",
            above=0,
            hint="300 N/um to 3000 N/um",
            usual=(1e6, 1e11),
        ),
    ] = None

    def __post_init__(self) -> None:
        faults = faults_of("bearing", self, optional=("rigidity",))
        if self.place not in PLACES:
            faults.append(Fault("bearing.place", "unknown end of the shaft", self.place, nearest(self.place, PLACES)))
        raise_if_any(faults)

    @property
    def name(self) -> str:
        """Name in results: ``fixed bearing``."""
        return PLACES[self.place]

    @property
    def at_far_end(self) -> bool:
        """True of a bearing that is not the one at the motor."""
        return self.place != "fixed"

    def __call__(self, state: OperatingState, /) -> ElementFriction:
        """Friction at a state of the screw."""
        load: Any = self.load_share * state.axial_load
        return self.element(OperatingState(load, state.screw_speed, state.temperature))

    def axial_rigidity(self, axial_load: Force = 0.0) -> tuple[Stiffness | None, str]:
        """Axial rigidity at a load of the screw, N/m, and in words what it is of; None where it is not known.

        That of the maker, or that of balls and races, whose rings are rigid: more than a catalogue prints.
        """
        if self.rigidity is not None:
            return float(self.rigidity), "as given"
        if isinstance(self.element, SupportBearing):
            result = float(self.element.rigidity(self.load_share * axial_load))
            return (result, "of balls and races, its rings rigid") if result > 0 else (None, "")
        return None, ""
