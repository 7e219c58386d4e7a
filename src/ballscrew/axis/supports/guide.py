"""Linear guides with rolling bodies, by the law of their makers."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.axis.supports import formulas
from ballscrew.axis.supports.bearing import CONFORMITY, BallRoughness, bearing_model, rows_of_balls
from ballscrew.axis.supports.makers_bearing import MakersFriction
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.errors import Fault, accepts_units, faults_of, raise_if_any
from ballscrew.basis.quantities import (
    Acceleration,
    Angle,
    Array,
    Count,
    Force,
    Info,
    Length,
    Mask,
    Mass,
    Power,
    Ratio,
    Speed,
    Temperature,
)
from ballscrew.basis.records import Record
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut, OversizeBallNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult

Carriages = Annotated[Count, Info("n", "carriages of the table", at_least=1, at_most=100, whole=True, hint="2 or 4")]
#: Names of the parts, as those of the torque of an axis.
GUIDES, SEALS = "guides", "guide seals"


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class LinearGuide(ByValue):
    r"""The carriages of a table on their rails: :math:`F = \sum \mu \left|P_i\right| + f`.

    A :class:`~ballscrew.physics.components.operating_state.FrictionElement` whose effort is a force along the rail, N.
    Called with a state, its load is that of all carriages, which share it evenly, and its ``screw_speed`` stands for
    the speed along the rail, m/s; :meth:`under` takes the load of each carriage, as
    :class:`~ballscrew.axis.supports.guide.GuidedTable` has them.

    The coefficient of catalogues is 0.002 to 0.003 with balls (Thomson2024, Rollon2020) and 0.001 to 0.002 with rollers
    (Thomson2024), at a load of a fifth of the dynamic rating and without preload (NB2024). Seals have 2 N to 5 N a
    carriage (NB2024), light ones 0.15 N to 1 N by size (Rollon2020;
    :func:`~ballscrew.axis.supports.element_laws.guide_rows`).
    Preload, oil, fresh grease and temperature are in neither number and add to both.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    friction_coefficient: Annotated[
        Ratio,
        Info(
            r"\mu",
            "friction coefficient of the rolling bodies",
            at_least=0,
            hint="0.002 to 0.003 with balls, 0.001 to 0.002 with rollers",
            usual=(0.0, 0.05),
        ),
    ]
    seal_force: Annotated[
        Force,
        Info("f", "force of the seals of one carriage", "N", at_least=0, hint="2 N to 5 N", usual=(0.0, 200.0)),
    ]
    carriages: Carriages = 4

    def __post_init__(self) -> None:
        raise_if_any(faults_of("guide", self))

    def __call__(self, state: OperatingState, /) -> MakersFriction:
        """Friction at a ``state``: the load of all carriages (N), shared evenly, and the speed along the rail (m/s).

        Returns :class:`~ballscrew.axis.supports.makers_bearing.MakersFriction`, whose effort is a force, N.
        """
        share = np.asarray(state.axial_load)[..., np.newaxis] / self.carriages
        return self.under(share * np.ones(int(self.carriages)), state.screw_speed)

    @accepts_units("guide")
    def under(
        self,
        loads: Force,
        speed: Speed = 0.0,
        temperature: Temperature | None = None,  # noqa: ARG002  (as the guides of an axis are called)
    ) -> MakersFriction:
        """Friction where the ``loads`` of the carriages are known, N, one for each along the last axis.

        Returns :class:`~ballscrew.axis.supports.makers_bearing.MakersFriction`. The force knows neither the ``speed``
        (m/s) nor the ``temperature`` (K). Raises :class:`~ballscrew.basis.errors.InputError` for units that do not fit.
        """
        carriages = np.shape(loads)[-1]
        rolling = np.sum(formulas.guide_friction(np.abs(loads), self.friction_coefficient, 0.0), axis=-1)
        return MakersFriction({GUIDES: rolling, SEALS: carriages * self.seal_force}, speed)


#: Sides of the carriages along the rails and across them, in the order of catalogues: round the table.
ALONG, ACROSS = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([1.0, 1.0, -1.0, -1.0])


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class CarriedMass(ByValue):
    """A mass on the table, and where its centre is from the middle of the carriages, at the height of the screw."""

    mass: Annotated[Mass, Info("m", "mass", "kg", at_least=0, hint="the table is one of them")]
    along: Annotated[Length, Info("x", "centre of the mass along the rails", "mm", hint="from the middle")] = 0.0
    across: Annotated[Length, Info("y", "centre of the mass across the rails", "mm", hint="from the screw")] = 0.0
    above: Annotated[Length, Info("z", "centre of the mass above the screw", "mm", hint="below it: negative")] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("mass", self))


class CarriageLoads(NamedTuple):
    """Loads of the four carriages, N, the carriages along the last axis; the first is behind on the left side.

    Round the table: behind left, ahead left, ahead right, behind right; ahead is the direction of positive motion.
    """

    #: Pressing on the rail; negative where the carriage is pulled off it.
    normal: Array
    #: Across the rail.
    lateral: Array

    @property
    def equivalent(self) -> Force:
        r"""Equivalent loads :math:`\left|P\right| + \left|T\right|`, of carriages that bear alike in all directions."""
        return np.abs(self.normal) + np.abs(self.lateral)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class GuidedTable(ByValue):
    r"""A stiff table on two rails with two carriages each, pushed by a screw in the middle between the rails.

    .. math:: P_i = \sum_k \frac{m_k g \cos\theta}{4} \left(1 + \frac{4 x_i x_k}{l_1^2} + \frac{4 y_i y_k}{l_2^2}\right)
        - m_k \left(a + g \sin\theta\right) \frac{x_i z_k}{l_1^2},
        \qquad T_i = -m_k \left(a + g \sin\theta\right) \frac{x_i y_k}{l_1^2}

    with carriages at :math:`x_i = \pm l_1/2`, :math:`y_i = \pm l_2/2`: equilibrium of a stiff body on four springs that
    are alike. Carriages do not hold moments themselves here, and rails are straight: long carriages and errors of the
    bed change the shares. PMI2008's example comes out to 0.1 N.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    masses: Sequence[CarriedMass]
    carriage_spacing: Annotated[
        Length, Info("l_1", "distance of the two carriages on a rail", "mm", above=0, hint="centre to centre")
    ]
    rail_spacing: Annotated[Length, Info("l_2", "distance of the two rails", "mm", above=0, hint="centre to centre")]
    inclination: Annotated[
        Angle,
        Info(
            r"\theta",
            "angle of positive motion above the horizontal",
            "deg",
            at_least=-math.pi / 2,
            at_most=math.pi / 2,
            hint="0 deg for a horizontal table",
        ),
    ] = 0.0
    gravity: Annotated[Acceleration, Info("g", "acceleration of free fall", at_least=0, hint="9.80665 m/s^2")] = 9.80665

    def __post_init__(self) -> None:
        raise_if_any(faults_of("table", self))

    @property
    def mass(self) -> Mass:
        """Mass that moves."""
        return sum(each.mass for each in self.masses)

    @accepts_units("table")
    def loads(self, acceleration: Acceleration = 0.0) -> CarriageLoads:
        """Loads of the carriages at an acceleration of the table, m/s², or at an array of them."""
        l_1, l_2, g = self.carriage_spacing, self.rail_spacing, self.gravity
        back: Any = (np.asarray(acceleration) + g * math.sin(self.inclination))[..., np.newaxis]
        down = g * math.cos(self.inclination)
        normal, lateral = 0.0 * back, 0.0 * back
        for each in self.masses:
            weight = each.mass * down * (0.25 + ALONG * each.along / (2 * l_1) + ACROSS * each.across / (2 * l_2))
            normal = normal + weight - each.mass * back * ALONG * each.above / (2 * l_1)
            lateral = lateral - each.mass * back * ALONG * each.across / (2 * l_1)
        return CarriageLoads(normal, lateral)


#: Diameter of the circle that stands for a straight path, in balls: what is left of its curvature is a share of about
#: 1e-6 of the force.
STRAIGHT = 1e4


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class ContactGuide(ByValue):
    r"""The carriages of a table by their balls, which roll between rail and carriage at half its speed.

    A :class:`~ballscrew.physics.components.operating_state.FrictionElement` whose effort is a force along the rail, N,
    called as :class:`~ballscrew.LinearGuide`. The contacts are those of the screw on a path without curvature: two for
    each ball, in rows braced against each other (:math:`z Q \sin\alpha = P`, half of the rows against each direction of
    the load), or four, of balls too big for a pointed arch. With two contacts a ball rolls about an axis along its
    contacts' tangent and does not spin; with four it must slide. Under load the contacts climb the grooves.

    What catalogues leave out is assumed: a conformity of 0.52, the roughness of the paper, and no rows that carry less
    than others. A load across the rail counts as one that presses. Left out: what the return path and fresh grease
    resist, and errors of the bed.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    ball_diameter: Annotated[
        Length, Info("d_w", "ball diameter", "mm", above=0, hint="3 mm to 10 mm", usual=(1e-3, 0.03))
    ]
    balls: Annotated[
        Count,
        Info("z_r", "loaded balls in one row of one carriage", at_least=1, at_most=1000, whole=True, hint="10 to 30"),
    ]
    #: The oil of the guides.
    lubricant: Lubricant
    rows: Annotated[
        Count, Info("i", "rows of balls of a carriage", at_least=2, at_most=8, whole=True, hint="2 or 4")
    ] = 4
    contacts_per_ball: Annotated[
        Count,
        Info("n_c", "contacts of a ball: 2 in circular arcs, 4 in pointed ones", at_least=2, at_most=4, whole=True),
    ] = 2
    contact_angle: Annotated[
        Angle,
        Info(
            r"\alpha",
            "angle of the contact normal against the plane of the rails",
            "deg",
            above=0,
            below=math.pi / 2,
            hint="45 deg for the same load in all directions",
            usual=(math.radians(20), math.radians(80)),
        ),
    ] = math.pi / 4
    preload: Annotated[
        Force,
        Info(
            "F_v",
            "preload of one carriage: how hard its upper and lower rows press against each other",
            "N",
            at_least=0,
            hint="2 % to 13 % of the dynamic load rating",
            usual=(0.0, 1e5),
        ),
    ] = 0.0
    conformity: Annotated[
        Ratio, Info("f", "groove radius / ball diameter, of rail and carriage", above=0.5, at_most=1, hint="0.52")
    ] = CONFORMITY
    groove_roughness: Annotated[
        Length, Info(r"\sigma_r", "RMS roughness of the grooves", "um", above=0, hint="0.1 um to 0.3 um")
    ] = 0.3e-6
    ball_roughness: BallRoughness = 0.08e-6
    seal_force: Annotated[
        Force,
        Info("f_s", "force of the seals of one carriage", "N", at_least=0, hint="2 N to 5 N", usual=(0.0, 200.0)),
    ] = 0.0
    carriages: Carriages = 4
    #: A model of the friction of screws, for its laws of contact; by default the reference.
    model: FrictionModel | None = None

    def __post_init__(self) -> None:
        faults = faults_of("guides", self)
        if not faults and self.rows % 2:
            faults.append(Fault("guides.rows", "must be even", f"{self.rows:g}", "give 2 or 4"))
        if not faults and self.contacts_per_ball % 2:
            faults.append(Fault("guides.contacts_per_ball", "must be 2 or 4", f"{self.contacts_per_ball:g}", "give 2"))
        raise_if_any(faults)

    @lazy
    def contacts(self) -> BallScrew:
        """The rows of one carriage as a screw without a lead, on a circle so large that its path is straight."""
        four = self.contacts_per_ball == 4
        return rows_of_balls(
            pitch_circle_diameter=STRAIGHT * self.ball_diameter,
            lead=1.5 * self.ball_diameter,
            ball_diameter=self.ball_diameter,
            loaded_balls=self.balls * (self.rows if four else self.rows // 2),
            contact_angle=self.contact_angle,
            screw_conformity=self.conformity,
            nut_conformity=self.conformity,
            ball_roughness=self.ball_roughness,
            screw_roughness=self.groove_roughness,
            nut_roughness=self.groove_roughness,
            nut=OversizeBallNut(preload=self.preload) if four else DoubleNut(preload=self.preload),
        )

    def __call__(self, state: OperatingState, /) -> GuideFriction:
        """Friction at a ``state``: the load of all carriages (N), shared evenly, and the speed along the rail (m/s).

        Raises what :meth:`under` raises.
        """
        share = np.asarray(state.axial_load)[..., np.newaxis] / self.carriages
        return self.under(share * np.ones(int(self.carriages)), state.screw_speed, state.temperature)

    @accepts_units("guides")
    def under(self, loads: Force, speed: Speed = 0.0, temperature: Temperature | None = None) -> GuideFriction:
        """Friction where the ``loads`` of the carriages are known, N, one for each along the last axis.

        ``speed`` (m/s) and ``temperature`` (K) have the other axes. Raises :class:`~ballscrew.basis.errors.InputError`
        as the model does.
        """
        radius = STRAIGHT * float(self.ball_diameter) / 2
        along = np.asarray(speed)[..., np.newaxis]
        warm = None if temperature is None else np.asarray(temperature)[..., np.newaxis]
        each, turning = np.broadcast_arrays(np.asarray(loads, dtype=float), along / radius)
        result = bearing_model(self.model)(
            self.contacts, self.lubricant, axial_load=each, screw_speed=turning, temperature=warm
        )
        return GuideFriction(self, result, radius, np.asarray(speed), int(np.shape(loads)[-1]))


@dataclasses.dataclass(frozen=True, eq=False)
class GuideFriction(ByValue):
    """Friction of guides by their balls, at an operating state or an array of them."""

    guide: ContactGuide
    #: The contacts of each carriage, along the last axis.
    balls: FrictionResult
    #: Radius of the circle that stands for the straight path, m.
    radius: Length
    speed: Array
    carriages: int

    @lazy
    def contributions(self) -> Mapping[str, Force]:
        """Friction force along the rails by mechanism, and of the seals, N; the parts sum to it."""
        balls = {name: np.sum(part, axis=-1) / self.radius for name, part in self.balls.contributions.items()}
        return {**balls, SEALS: self.carriages * self.guide.seal_force}

    @lazy
    def friction_effort(self) -> Force:
        """Friction force along the rails, its magnitude, seals included, N."""
        return np.sum(np.broadcast_arrays(*self.contributions.values()), axis=0)

    @property
    def friction_power(self) -> Power:
        """Power dissipated, W."""
        return self.friction_effort * np.abs(self.speed)

    @property
    def validity(self) -> Mapping[str, Mask]:
        """Masks of the conditions of the model, of all carriages."""
        return {name: np.all(mask, axis=-1) for name, mask in self.balls.validity.items()}

    @property
    def warning_records(self) -> list[Record]:
        """Warnings as records."""
        return self.balls.warning_records
