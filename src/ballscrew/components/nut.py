"""The nut: how its balls are arranged and preloaded, and the bodies that carry their loads on."""

from __future__ import annotations

import dataclasses
from typing import Annotated, TypeAlias

from ballscrew.faults import faults_of, raise_if_any
from ballscrew.quantities import Force, Info, Length

Preload = Annotated[
    Force, Info("F_pr", "axial preload without external load", at_least=0, hint="2 to 10 % of the dynamic load rating")
]
Spacing = Annotated[
    Length,
    Info("l", "axial distance between the two halves, last ball to first ball", "mm", at_least=0, hint="about a lead"),
]


@dataclasses.dataclass(frozen=True, eq=False)
class SingleNut:
    """One nut body without preload: each ball touches one flank of screw and nut, and there may be play.

    Raises :class:`~ballscrew.faults.InputError` for a negative play.
    """

    axial_play: Annotated[
        Length, Info("S_a", "axial play between screw and nut", "um", at_least=0, hint="5 um to 100 um")
    ] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


@dataclasses.dataclass(frozen=True, eq=False)
class OversizeBallNut:
    """One nut body, preloaded by balls too big for its grooves: each touches both flanks of both, four contacts.

    The preload is the axial force that each flank would carry by itself: that of the balls on one
    flank of the nut, which those on the other hold.
    Raises :class:`~ballscrew.faults.InputError` for a negative preload.
    """

    preload: Preload

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


@dataclasses.dataclass(frozen=True, eq=False)
class DoubleNut:
    """Two nut bodies braced against each other: the balls of each touch one flank, opposite to the other's.

    The loaded balls of the screw are those of one body; the other has as many.
    Raises :class:`~ballscrew.faults.InputError` for a negative preload or spacing.
    """

    preload: Preload
    spacing: Spacing = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


@dataclasses.dataclass(frozen=True, eq=False)
class OffsetLeadNut:
    """One nut body whose lead has an offset in its middle, which braces the balls before and behind it.

    It works like a :class:`DoubleNut`; the loaded balls of the screw are those of one half.
    Raises :class:`~ballscrew.faults.InputError` for a negative preload or spacing.
    """

    preload: Preload
    spacing: Spacing = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


Nut: TypeAlias = SingleNut | OversizeBallNut | DoubleNut | OffsetLeadNut
