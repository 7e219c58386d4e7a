"""Requirements of a need beyond what a case file says: annotated once, read from files, judged as checks."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, faults_of, nearest, raise_if_any
from ballscrew.basis.quantities import Count, Force, Info, Length, MomentOfInertia, Speed, Stiffness, Torque, fields_of

#: What the load may do with the screw: drive it or not, must drive it, must not.
ALLOWED, NEEDED, FORBIDDEN = "allowed", "needed", "forbidden"
BACK_DRIVING = (ALLOWED, NEEDED, FORBIDDEN)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Requirements(ByValue):
    """Requirements of a need. What is None is not asked for.

    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    feed: Annotated[
        Speed | None,
        Info("v", "speed of travel, in place of a screw speed", "m/min", hint="each lead then has a speed of its own"),
    ] = None
    stroke: Annotated[
        Length | None, Info("s", "travel of the nut", "mm", above=0, hint="lengths are positive", usual=(1e-3, 20.0))
    ] = None
    largest_drive_torque: Annotated[
        Torque | None, Info("M_{max}", "largest torque on the shaft", "N m", above=0, hint="that of the motor")
    ] = None
    largest_preload_torque: Annotated[
        Torque | None,
        Info("M_{p,max}", "largest drag torque of the nut, its seals included", "N m", above=0, hint="0.1 to 2 N m"),
    ] = None
    least_rigidity: Annotated[
        Stiffness | None,
        Info("R_{min}", "least rigidity of the nut under the load", "N/um", above=0, hint="200 N/um to 2000 N/um"),
    ] = None
    least_remaining_preload: Annotated[
        Force | None,
        Info("F_{r,min}", "least preload that the load leaves", "N", above=0, hint="some per cent of the load"),
    ] = None
    largest_inertia: Annotated[
        MomentOfInertia | None,
        Info("J_{max}", "largest moment of inertia of the shaft", "kg cm^2", above=0, hint="that of the motor"),
    ] = None
    counts_per_turn: Annotated[
        Count | None,
        Info("n_c", "counts of the encoder in one turn of the screw", at_least=1, whole=True, hint="4096 to 16777216"),
    ] = None
    largest_step: Annotated[
        Length | None,
        Info("x_{max}", "largest travel of one count of the encoder", "um", above=0, hint="0.01 um to 10 um"),
    ] = None
    #: Whether the load may turn the screw (``allowed``), must (``needed``), or must not (``forbidden``).
    back_driving: str = ALLOWED
    #: Grade of ISO 3408-3, as it is written. No row lists its grades: it is echoed and never judged.
    accuracy: str = ""

    def __post_init__(self) -> None:
        faults = faults_of("need", self, optional=tuple(fields_of(Requirements)))
        if self.back_driving not in BACK_DRIVING:
            given = str(self.back_driving)
            faults.append(Fault("need.back_driving", "unknown", given, nearest(given, BACK_DRIVING)))
        if not faults and self.largest_step is not None and self.counts_per_turn is None:
            remedy = "add counts_per_turn, those of the encoder"
            faults.append(Fault("need.largest_step", "cannot be judged alone", f"{self.largest_step:g} m", remedy))
        raise_if_any(faults)
