"""From rest: the torque at which a ball screw breaks away, and how far it gives way before."""

from __future__ import annotations

import dataclasses
from typing import Annotated

import numpy as np

from ballscrew.basis.arrays import lazy, where
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any
from ballscrew.basis.quantities import Angle, Force, Info, Length, Mask, Ratio, RotationalStiffness, Stiffness, Torque
from ballscrew.physics.components.contact import Contact
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.mixed_friction import LoadSharing
from ballscrew.physics.components.screw import BallScrew, Raceway
from ballscrew.physics.equations import presliding
from ballscrew.physics.friction import directions
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.solvers.load_distribution import BallLoads

#: Boundary friction at the start, SKF2018; in motion it has 0.12.
STATIC_FRICTION_COEFFICIENT = 0.15


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Breakaway:
    """The state at rest just before the balls slip.

    ``at_rest`` is the limit of the friction model for a speed of zero with the static friction coefficient at all
    contacts: its ``contributions`` say what holds. Rolling has no part in it.
    """

    at_rest: FrictionResult
    static_friction_coefficient: Annotated[Ratio, Info(r"\mu_s", "friction coefficient from rest")]

    @property
    def torque(self) -> Annotated[Torque, Info("M_b", "friction torque to overcome from rest")]:
        """Friction torque to overcome from rest, either way."""
        return self.at_rest.screw_torque

    @property
    def holding_torque(
        self,
    ) -> Annotated[Torque, Info("M_h", "torque that holds the load at rest")]:
        """Torque on the shaft that holds the load at rest; zero or less: the load does not start by itself.

        For a load below zero all signs are reversed.
        """
        return directions.holding_torque(self.at_rest.ideal_torque, self.torque)

    @property
    def starts_to_back_drive(self) -> Annotated[Mask, Info("starts", "the load alone starts to turn the screw")]:
        """True where the load alone starts to turn the screw."""
        return abs(self.at_rest.ideal_torque) > self.torque

    @lazy
    def stiffness(
        self,
    ) -> Annotated[RotationalStiffness, Info(r"k_\theta", "torsional stiffness of the sticking contacts")]:
        """Stiffness of all sticking contacts against rotation of the screw,
        :mod:`~ballscrew.physics.equations.presliding`.

        Zero without load.
        """
        screw, frame = self.at_rest.ball_screw, self.at_rest.frame
        return sum(
            # a flank pair that has lifted off holds nothing
            kind.total(
                where(
                    pair.load > 0,
                    _stiffness(screw, pair.screw, pair.nut, frame.lead_angle, frame.rolling_plane_sine),
                    0.0,
                )
            )
            for kind in self.at_rest.kinds
            for pair in kind.pairs
        )

    @lazy
    def slip_torque(self) -> Annotated[Torque, Info("M_slip", "part of the torque that sliding contacts hold")]:
        """The part of the torque that spin and lateral slip hold: what the stiffness winds up to."""
        return self.at_rest.contributions["spin"] + self.at_rest.contributions["helix"]

    @lazy
    def presliding_angle(self) -> Annotated[Angle, Info(r"\theta_b", "rotation before the contacts slip", "deg")]:
        r"""Rotation of the screw before the contacts slip, slip torque over stiffness; NaN without load.

        NaN as well for a model without spin and lateral slip, which does not say what winds up.

        The parameter :math:`\sigma_0` of the friction models of Dahl and LuGre is the stiffness.
        """
        k, slip = self.stiffness, self.slip_torque
        winds_up = (k > 0) & (slip > 0)
        return where(winds_up, slip / where(winds_up, k, 1.0), float("nan"))


@accepts_units("operation")
def breakaway(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    static_friction_coefficient: Ratio = STATIC_FRICTION_COEFFICIENT,
    loads: BallLoads | None = None,
) -> Breakaway:
    """Friction from rest under an axial load: a :class:`Breakaway`.

    ``model`` gives the limit at rest of ``screw`` with ``lubricant`` under ``axial_load`` (N, of either sign); arrays
    are evaluated element by element. All contacts have the ``static_friction_coefficient`` (SKF2018 has 0.15 at the
    start, 0.12 in motion). Grease that has set, seals that stick and a run-in surface may change it. ``loads`` are
    those of the balls, where they are known.

    Raises :class:`~ballscrew.basis.errors.InputError` for a coefficient that is not above zero.
    """
    if np.any(~(np.asarray(static_friction_coefficient) > 0)):
        given = str(static_friction_coefficient)
        raise_if_any([Fault("breakaway.static_friction_coefficient", "must be above zero", given, "usual: 0.1 to 0.2")])
    sticking = LoadSharing(static_friction_coefficient, decay=0.0)
    at_rest = dataclasses.replace(model, friction=sticking, full_film=None)
    return Breakaway(
        at_rest=at_rest(screw, lubricant, axial_load=axial_load, screw_speed=0.0, loads=loads),
        static_friction_coefficient=static_friction_coefficient,
    )


def _stiffness(
    screw: BallScrew, on_screw: Contact, on_nut: Contact, lead_angle: Angle, rolling_plane_sine: Ratio
) -> RotationalStiffness:
    """Stiffness of one flank pair of a ball: its two contacts in series."""
    sides = [
        _of_contact(screw, contact, race)
        for contact, race in ((on_screw, screw.screw_raceway), (on_nut, screw.nut_raceway))
    ]
    tangential, torsional = (_series(*both) for both in zip(*sides, strict=True))
    return presliding.sticking_stiffness(tangential, torsional, screw.ball_diameter, lead_angle, rolling_plane_sine)


def _of_contact(screw: BallScrew, contact: Contact, race: Raceway) -> tuple[Stiffness, RotationalStiffness]:
    ball, other = screw.ball_material, race.material
    radius: Length = (contact.semi_major_axis * contact.semi_minor_axis) ** 0.5
    moduli = [presliding.shear_modulus(one.young_modulus, one.poisson_ratio) for one in (ball, other)]
    return (
        presliding.tangential_stiffness(radius, moduli[0], ball.poisson_ratio, moduli[1], other.poisson_ratio),
        presliding.torsional_stiffness(radius, *moduli),
    )


def _series(one: Stiffness, other: Stiffness) -> Stiffness:
    """Two springs in series; zero where both are."""
    both = one + other
    return where(both > 0, one * other / where(both > 0, both, 1.0), 0.0)
