"""Support bearings from the contact core of the screw: rows of balls that roll in a plane, alone or braced."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.errors import Fault, accepts_units, faults_of, nearest, raise_if_any, shown
from ballscrew.basis.quantities import Angle, Count, Force, Info, Length, Mask, Power, Ratio, Stiffness, Torque
from ballscrew.basis.records import Record
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut, SingleNut
from ballscrew.physics.components.operating_state import ElementFriction, FrictionElement, OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.loaded_balls import loads_of
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.ball_chain import ProportionalBallForce
from ballscrew.physics.laws.frame import bearing_frame
from ballscrew.physics.laws.nut_losses import Seals

#: Ball diameter over (D − d), how much of the circle the balls fill, and the conformity: usual, of no catalogue.
BALL_SHARE, FILLED, CONFORMITY = 0.3, 0.9, 0.52
#: The one condition that a bearing has beside those of its balls.
DIRECTION = "direction"

Bore = Annotated[
    Length, Info("d", "bore of the bearing", "mm", above=0, hint="lengths are positive", usual=(1e-3, 0.5))
]
OutsideDiameter = Annotated[
    Length, Info("D", "outside diameter of the bearing", "mm", above=0, hint="lengths are positive", usual=(3e-3, 1.0))
]
Rows = Annotated[
    Count,
    Info("i", "rows of balls, half of them against each direction", at_least=1, whole=True, hint="1, 2 or 4"),
]
PairPreload = Annotated[
    Force,
    Info("F_v", "axial preload of the pair without load", "N", at_least=0, hint="0 N for none", usual=(0.0, 1e5)),
]
BallRoughness = Annotated[
    Length, Info(r"\sigma_b", "RMS roughness of the balls", "um", above=0, hint="0.02 um to 0.1 um")
]
SealTorque = Annotated[
    Torque,
    Info("M_W", "torque of the seals of the bearing", "N m", at_least=0, hint="0 N m without", usual=(0.0, 10.0)),
]


class _Rows(BallScrew):
    """Rows of balls without a lead: the screw whose helix is a circle. Its lead is a number that nothing reads."""

    @property
    def lead_angle(self) -> Angle:  # pyright: ignore[reportIncompatibleVariableOverride]  (no lead)
        """Zero: the balls run in a plane."""
        return 0.0


def rows_of_balls(**sizes: Any) -> BallScrew:
    """Rows of balls in a plane, for the model: a screw without a lead, of the sizes of one that has it."""
    return _Rows(**sizes)


def bearing_model(model: FrictionModel | None = None) -> FrictionModel:
    """The model of a screw, by default the reference, for a bearing: no helix, and a cage that parts the balls."""
    screw_model = FrictionModel.reference() if model is None else model
    return dataclasses.replace(screw_model, frame=bearing_frame, ball_force=ProportionalBallForce(0.0))


def faults_of_arrays(section: str, part: Any, *names: str) -> list[Fault]:
    """Faults of fields that have to be one number, and are an array."""
    return [
        Fault(f"{section}.{name}", "must be one number", "an array", "make one bearing for each")
        for name in names
        if np.ndim(getattr(part, name)) > 0
    ]


def faults_of_sizes(section: str, bearing: Any) -> list[Fault]:
    """Faults of an outside diameter that does not exceed the bore, and of rows that are no pairs."""
    faults: list[Fault] = []
    if not bearing.outside_diameter > bearing.bore:
        given, remedy = shown(bearing.outside_diameter, "m"), "give bore and outside diameter"
        faults.append(Fault(f"{section}.outside_diameter", "must exceed the bore", given, remedy))
    if bearing.rows > 1 and bearing.rows % 2:
        faults.append(Fault(f"{section}.rows", "must be one or even", f"{bearing.rows:g}", "give 1, 2 or 4"))
    return faults


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class SupportBearing(ByValue):
    r"""An angular-contact or axial angular-contact ball bearing on the shaft: one row, or a preloaded pair of rows.

    A :class:`~ballscrew.physics.components.operating_state.FrictionElement`: called with an operating state, whose load
    is the axial one of the bearing, it returns the friction torque about the shaft, by mechanism. The contacts are
    those of the screw, in a plane: :math:`z Q \sin\alpha = F` for one row; the two sides of a preloaded pair are braced
    as the halves of a double nut. ``rows`` is one, or an even number, half of them on each side.

    What catalogues leave out is assumed, and no source stands behind it: balls of 0.3 (D − d) that fill 0.9 of the
    circle (of axial angular-contact bearings they are smaller and more: give them where they are known), a conformity
    of 0.52 at both races, the roughness of the paper. Left out: a radial load, centrifugal forces and the cage's drag.
    Against the formula of a maker: :class:`~ballscrew.axis.supports.makers_bearing.SKFBearing` and the page on
    validation. Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, balls that do not fit, and
    a preload of one row alone.
    """

    bore: Bore
    outside_diameter: OutsideDiameter
    contact_angle: Annotated[
        Angle,
        Info(
            r"\alpha",
            "angle of the contact normal against the radial plane",
            "deg",
            above=0,
            below=math.pi / 2,
            hint='"40 deg", in Python math.radians(40); bearings made for screws have 60 deg',
            usual=(math.radians(10), math.radians(70)),
        ),
    ]
    #: The oil of the bearing.
    lubricant: Lubricant
    rows: Rows = 2
    preload: PairPreload = 0.0
    ball_diameter: Annotated[
        Length | None,
        Info("d_w", "ball diameter", "mm", above=0, hint="0.3 (D - d) where it is not known", usual=(5e-4, 0.1)),
    ] = None
    balls: Annotated[
        Count | None, Info("z_r", "balls in one row", at_least=3, whole=True, hint="left out, 0.9 of a full circle")
    ] = None
    conformity: Annotated[
        Ratio | None,
        Info("f", "groove radius / ball diameter, of both races", above=0.5, at_most=1, hint="left out, 0.52"),
    ] = None
    race_roughness: Annotated[
        Length, Info(r"\sigma_r", "RMS roughness of the races", "um", above=0, hint="0.05 um to 0.3 um")
    ] = 0.3e-6
    ball_roughness: BallRoughness = 0.08e-6
    seal_torque: SealTorque = 0.0
    #: A model of the friction of screws, for its laws of contact; by default the reference.
    model: FrictionModel | None = None

    def __post_init__(self) -> None:
        faults = faults_of("bearing", self, optional=("ball_diameter", "balls", "conformity"))
        faults = faults or faults_of_arrays(
            "bearing", self, "bore", "outside_diameter", "rows", "ball_diameter", "balls"
        )
        if not faults:
            faults += faults_of_sizes("bearing", self)
            if self.rows == 1 and np.any(self.preload > 0):
                remedy = "give rows = 2, or the spring's force as a load"
                faults.append(Fault("bearing.preload", "one row braces nothing", shown(self.preload, "N"), remedy))
        raise_if_any(faults)
        raise_if_any(self._misfits())

    def _misfits(self) -> list[Fault]:
        room = math.pi * self.mean_diameter
        if self.balls_of_a_row * self.balls_size < room and self.balls_size < self.mean_diameter / 2:
            return []
        given = f"{self.balls_of_a_row:g} of {1e3 * self.balls_size:.4g} mm"
        return [
            Fault(
                "bearing.balls",
                "do not fit on their circle",
                given,
                f"{units.to_significant(1000.0 * room, 4)} mm are all there is",
            )
        ]

    @property
    def mean_diameter(self) -> Length:
        """Diameter of the circle of the balls, (d + D)/2, m."""
        return (self.bore + self.outside_diameter) / 2

    @property
    def balls_size(self) -> Length:
        """Ball diameter given, or 0.3 (D − d), m."""
        assumed = BALL_SHARE * (self.outside_diameter - self.bore)
        return assumed if self.ball_diameter is None else self.ball_diameter

    @property
    def balls_of_a_row(self) -> int:
        """Number of balls in a row given, or those that fill 0.9 of the circle."""
        full = FILLED * math.pi * self.mean_diameter / self.balls_size
        return math.floor(full) if self.balls is None else int(self.balls)

    @property
    def assumed(self) -> tuple[str, ...]:
        """Values that stand for sizes that were not given, in words."""
        words = {
            f"balls of {BALL_SHARE} (D − d)": self.ball_diameter,
            f"balls that fill {FILLED} of the circle": self.balls,
            f"a conformity of {CONFORMITY}": self.conformity,
        }
        return tuple(text for text, given in words.items() if given is None)

    @lazy
    def contacts(self) -> BallScrew:
        """The rows as a screw without a lead, for the model."""
        seals = {"seals": Seals(self.seal_torque)}
        conformity = CONFORMITY if self.conformity is None else self.conformity
        nut = SingleNut(losses=seals) if self.rows == 1 else DoubleNut(preload=self.preload, losses=seals)
        return rows_of_balls(
            pitch_circle_diameter=self.mean_diameter,
            lead=1.5 * self.balls_size,
            ball_diameter=self.balls_size,
            loaded_balls=self.balls_of_a_row * max(int(self.rows) // 2, 1),
            contact_angle=self.contact_angle,
            screw_conformity=conformity,
            nut_conformity=conformity,
            ball_roughness=self.ball_roughness,
            screw_roughness=self.race_roughness,
            nut_roughness=self.race_roughness,
            nut=nut,
        )

    @lazy
    def _model(self) -> FrictionModel:
        return bearing_model(self.model)

    def __call__(self, state: OperatingState, /) -> BearingFriction:
        """Friction at a ``state``: axial load (N), of either sign for a pair, speed (rad/s), temperature (K).

        Raises :class:`~ballscrew.basis.errors.InputError` as the model does.
        """
        given: dict[str, Any] = {"axial_load": state.axial_load, "screw_speed": state.screw_speed}
        balls = self._model(self.contacts, self.lubricant, **given, temperature=state.temperature)
        return BearingFriction(self, balls)

    @accepts_units("bearing")
    def rigidity(self, axial_load: Force = 0.0) -> Stiffness:
        """Axial rigidity of balls and races at ``axial_load`` (N), N/m, rings rigid: slope of load over displacement.

        A row alone has none without load. Catalogues print less: their rings and seats give way, too.
        Raises :class:`~ballscrew.basis.errors.InputError` for a unit that is none of a force.
        """
        contacts = self.contacts
        if self.rows == 1:
            contacts = dataclasses.replace(contacts, nut=SingleNut(angle_under_load=True))
        return loads_of(contacts, axial_load).rigidity


@dataclasses.dataclass(frozen=True, eq=False)
class BearingFriction(ByValue):
    """Friction of a support bearing at an operating state, or an array of them."""

    bearing: SupportBearing
    #: The result of the contacts; of a preloaded pair the side that carries the load comes first.
    balls: FrictionResult

    @property
    def friction_effort(self) -> Torque:
        """Friction torque about the shaft, its magnitude, seals included, N m."""
        return self.balls.screw_torque

    @property
    def contributions(self) -> Mapping[str, Torque]:
        """Friction torque by mechanism, and of the seals, N m; the parts sum to it."""
        return self.balls.contributions

    @property
    def friction_power(self) -> Power:
        """Power dissipated, W."""
        return self.balls.friction_power

    @lazy
    def validity(self) -> Mapping[str, Mask]:
        """Masks of the conditions of the model, and that one row is pressed, not pulled off."""
        holds = (np.asarray(self.balls.axial_load) >= 0) | (self.bearing.rows > 1)
        return {**self.balls.validity, DIRECTION: holds}

    @property
    def warning_records(self) -> list[Record]:
        """Warnings as records."""
        if np.all(self.validity[DIRECTION]):
            return self.balls.warning_records
        message = (
            "one row carries no load in the other direction: it was computed for the size of the load; take a pair"
        )
        lifted = Record.warning(f"validity.{DIRECTION}", "bearing.rows", message)
        return [*self.balls.warning_records, lifted]


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

    A :class:`~ballscrew.physics.components.operating_state.FrictionElement`, called with the load of the whole screw.
    What a shaft is stretched with loads both ends and is no part of that: it belongs into the preload.
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
