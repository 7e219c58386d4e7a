"""The nut: how its balls are arranged and preloaded, and the bodies that carry their loads on."""

from __future__ import annotations

import dataclasses
from typing import Annotated, NamedTuple, TypeAlias

import numpy as np

from ballscrew._arrays import ByValue
from ballscrew.components.screw import BallScrew
from ballscrew.errors import Fault, accepts_units, faults_of, raise_if_any
from ballscrew.quantities import Force, Info, Length

Preload = Annotated[
    Force,
    Info(
        "F_pr",
        "axial preload without external load",
        at_least=0,
        hint="2 to 10 % of the dynamic load rating",
        usual=(0.0, 1e6),
    ),
]
Spacing = Annotated[
    Length,
    Info(
        "l",
        "axial distance between the two halves, last ball to first ball",
        "mm",
        at_least=0,
        hint="about a lead",
        usual=(0.0, 1.0),
    ),
]


@dataclasses.dataclass(frozen=True, eq=False)
class SingleNut(ByValue):
    """One nut body without preload: each ball touches one flank of screw and nut, and there may be play.

    Raises :class:`~ballscrew.errors.InputError` for a negative play.
    """

    axial_play: Annotated[
        Length,
        Info("S_a", "axial play between screw and nut", "um", at_least=0, hint="5 um to 100 um", usual=(0.0, 1e-3)),
    ] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


@dataclasses.dataclass(frozen=True, eq=False)
class OversizeBallNut(ByValue):
    """One nut body, preloaded by balls too big for its grooves: each touches both flanks of both, four contacts.

    The preload is the axial force that each flank would carry by itself: that of the balls on one
    flank of the nut, which those on the other hold.
    Raises :class:`~ballscrew.errors.InputError` for a negative preload.
    """

    preload: Preload

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


@dataclasses.dataclass(frozen=True, eq=False)
class DoubleNut(ByValue):
    """Two nut bodies braced against each other: the balls of each touch one flank, opposite to the other's.

    The loaded balls of the screw are those of one body; the other has as many.
    Raises :class:`~ballscrew.errors.InputError` for a negative preload or spacing.
    """

    preload: Preload
    spacing: Spacing = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


@dataclasses.dataclass(frozen=True, eq=False)
class OffsetLeadNut(ByValue):
    """One nut body whose lead has an offset in its middle, which braces the balls before and behind it.

    It works like a :class:`DoubleNut`; the loaded balls of the screw are those of one half.
    Raises :class:`~ballscrew.errors.InputError` for a negative preload or spacing.
    """

    preload: Preload
    spacing: Spacing = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("nut", self))


Nut: TypeAlias = SingleNut | OversizeBallNut | DoubleNut | OffsetLeadNut


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Bodies(ByValue):
    """The bodies of screw and nut between the balls, as bars, and where the load enters them.

    Raises :class:`~ballscrew.errors.InputError` for diameters that are not positive or do not fit.
    """

    screw_diameter: Annotated[
        Length,
        Info(
            "d_c", "diameter of the screw's bar, its root diameter", "mm", above=0, hint="d_m - d_w", usual=(5e-4, 0.5)
        ),
    ]
    nut_outer_diameter: Annotated[
        Length, Info("D_o", "outer diameter of the nut's tube", "mm", above=0, hint="about 1.5 d_m", usual=(1e-3, 2.0))
    ]
    nut_inner_diameter: Annotated[
        Length,
        Info("D_i", "inner diameter of the nut's tube", "mm", above=0, hint="about d_m + d_w", usual=(1e-3, 1.0)),
    ]
    #: Whether screw and nut are held on the same side of the balls: one is pulled where the other is pushed.
    same_side: bool = True

    def __post_init__(self) -> None:
        faults = faults_of("bodies", self)
        if not faults and np.any(self.nut_outer_diameter <= self.nut_inner_diameter):
            remedy = "give the outer diameter of the nut, not that of its bore"
            faults.append(Fault("bodies.nut_outer_diameter", "must exceed the inner diameter", "", remedy))
        raise_if_any(faults)

    @classmethod
    def of(cls, screw: BallScrew, *, same_side: bool = True) -> Bodies:
        """Bodies of a usual size: the core of the screw, and a nut one and a half pitch circles wide."""
        d_m, d_w = screw.pitch_circle_diameter, screw.ball_diameter
        return cls(
            screw_diameter=d_m - d_w, nut_outer_diameter=1.5 * d_m, nut_inner_diameter=d_m + d_w, same_side=same_side
        )


class Deviations(NamedTuple):
    """Deviations of each ball and of the lead at its place from the nominal ones, the ball axis last.

    Of a double nut both halves in a row, the one that carries the load first.
    """

    ball_diameter: Length = 0.0
    lead: Length = 0.0

    @classmethod
    @accepts_units("deviations")
    def scattered(cls, balls: int, *, seed: int, ball_diameter: Length = 0.0, lead: Length = 0.0) -> Deviations:
        """Normal scatter with these standard deviations; the same seed gives the same balls."""
        generator = np.random.default_rng(seed)
        return cls(ball_diameter * generator.standard_normal(balls), lead * generator.standard_normal(balls))
