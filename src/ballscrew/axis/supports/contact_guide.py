"""Linear guides with balls from the contact core of the screw: rows that run straight, with two or four contacts."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Annotated

import numpy as np

from ballscrew.axis.supports.bearing import CONFORMITY, bearing_model, rows_of_balls
from ballscrew.axis.supports.guide import SEALS, Carriages
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.errors import Fault, accepts_units, faults_of, raise_if_any
from ballscrew.basis.quantities import Angle, Array, Count, Force, Info, Length, Mask, Power, Ratio, Speed, Temperature
from ballscrew.basis.records import Record
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut, OversizeBallNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult

#: Diameter of the circle that stands for a straight path, in balls: what is left of its curvature is a share of about
#: 1e-6 of the force.
STRAIGHT = 1e4


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class ContactGuide(ByValue):
    r"""The carriages of a table by their balls, which roll between rail and carriage at half its speed.

    A :class:`~ballscrew.physics.friction.element.FrictionElement` whose effort is a force along the rail, N, called as
    :class:`~ballscrew.LinearGuide`. The contacts are those of the screw on a path without curvature: two for each ball,
    in rows braced against each other (:math:`z Q \sin\alpha = P`, half of the rows against each direction of the load),
    or four, of balls too big for a pointed arch. With two contacts a ball rolls about an axis along its contacts'
    tangent and does not spin; with four it must slide. Under load the contacts climb the grooves.

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
    ball_roughness: Annotated[
        Length, Info(r"\sigma_b", "RMS roughness of the balls", "um", above=0, hint="0.02 um to 0.1 um")
    ] = 0.08e-6
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
