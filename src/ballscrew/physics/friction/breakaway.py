"""Breakaway from rest: the torque at which a ball screw breaks away, and how far it gives way before."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from typing import Annotated, Any

import numpy as np

from ballscrew.basis.arrays import as_array, lazy, namespace, where
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any
from ballscrew.basis.quantities import Angle, Force, Info, Length, Mask, Ratio, RotationalStiffness, Stiffness, Torque
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew, Raceway
from ballscrew.physics.equations import across_groove, kinematics, presliding
from ballscrew.physics.friction import directions
from ballscrew.physics.friction.across_groove import arms_of, in_motion
from ballscrew.physics.friction.loaded_balls import LoadedPair
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.friction import LoadSharing
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

    @property
    def stiffness(
        self,
    ) -> Annotated[RotationalStiffness, Info(r"k_\theta", "torsional stiffness of the sticking contacts")]:
        """Stiffness of all sticking contacts against rotation of the screw: of their spin, and of what holds them
        across.

        Zero without load.
        """
        return self.spin_stiffness + self.lateral_stiffness

    @lazy
    def spin_stiffness(
        self,
    ) -> Annotated[RotationalStiffness, Info("k_P", "torsional stiffness of the sticking contacts by their spin")]:
        """Stiffness by the spin of the contacts, :func:`~ballscrew.physics.equations.presliding.spin_stiffness`."""
        return self._sum_of(_spin_stiffness)

    @lazy
    def lateral_stiffness(
        self,
    ) -> Annotated[
        RotationalStiffness, Info("k_L", "torsional stiffness of the balls by what holds them across their path")
    ]:
        """Stiffness by what holds the balls across their path: their contacts, and on two of them the grooves, in
        series.

        :func:`~ballscrew.physics.equations.presliding.lateral_stiffness`.
        """
        return self._sum_of(_lateral_stiffness)

    def _sum_of(self, stiffness: Callable[[BallScrew, Frame, LoadedPair, Force], RotationalStiffness]) -> Any:
        """The stiffness of all flank pairs of all balls; a pair that has lifted off holds nothing."""
        screw, frame = self.at_rest.ball_screw, self.at_rest.frame
        values: list[Any] = []
        for kind in self.at_rest.kinds:
            for pair in kind.pairs:
                values.append(kind.total(where(pair.load > 0, stiffness(screw, frame, pair, kind.load), 0.0)))
        return sum(values)

    @lazy
    def presliding_angle(self) -> Annotated[Angle, Info(r"\theta_b", "rotation before the contacts slip", "deg")]:
        r"""Rotation of the screw before all contacts slip: torque over stiffness, of spin or of lateral slip; NaN
        without load.

        NaN as well for a model without spin and lateral slip, which does not say what winds up. On two contacts lateral
        slip is the one that takes degrees, as the balls roll off the line of their grooves before they slip.

        The parameter :math:`\sigma_0` of the friction models of Dahl and LuGre is a stiffness, of which there are two.
        """
        parts = ((self.spin_stiffness, "spin"), (self.lateral_stiffness, "helix"))
        angles: list[Any] = []
        for k, name in parts:
            held = self.at_rest.contributions[name]
            winds_up = (k > 0) & (held > 0)
            angles.append(where(winds_up, held / where(winds_up, k, 1.0), 0.0))
        largest = namespace(*angles).maximum(*angles)
        return where(largest > 0, largest, float("nan"))


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
    if loads is None:  # the balls lie where friction in motion has left them, and not that from rest
        screw = in_motion(model, screw, lubricant, OperatingState(as_array(axial_load), 0.0).settled)
    return Breakaway(
        at_rest=at_rest(screw, lubricant, axial_load=axial_load, screw_speed=0.0, loads=loads),
        static_friction_coefficient=static_friction_coefficient,
    )


def _spin_stiffness(screw: BallScrew, frame: Frame, pair: LoadedPair, of_ball: Force) -> RotationalStiffness:
    """Stiffness of one flank pair of a ball by the spin of its two contacts.

    On two contacts the ball turns so that both share the spin: they are in series. Between two flank pairs it turns
    about the binormal, and spins each contact by what of that does not roll, as in
    :mod:`~ballscrew.physics.friction.four_contact_balls`.
    """
    on_screw, on_nut = (torsional for _, torsional in _of_sides(screw, pair))
    s_alpha, xp = frame.rolling_plane_sine, namespace(pair.angle)
    about_binormal = kinematics.ball_rotation(frame.entrainment_speed(1.0), screw.ball_diameter) * xp.tan(pair.angle)
    leaning = namespace(pair.load, of_ball).maximum(2 * pair.load - of_ball, 0.0) / where(of_ball > 0, of_ball, 1.0)
    at_nut = (1 - leaning) * about_binormal - leaning * s_alpha / 2
    held = presliding.spin_stiffness(on_screw, at_nut + s_alpha) + presliding.spin_stiffness(on_nut, at_nut)
    return where(pair.load < of_ball, held, presliding.spin_stiffness(_series(on_screw, on_nut), s_alpha))


def _lateral_stiffness(screw: BallScrew, frame: Frame, pair: LoadedPair, of_ball: Force) -> RotationalStiffness:
    """Stiffness of one flank pair of a ball across its path; a ball that another pair braces cannot leave its line."""
    tangential = _series(*(across for across, _ in _of_sides(screw, pair)))
    leans = (pair.load > 0) & (pair.load >= of_ball)
    compliance = across_groove.groove_compliance(where(leans, pair.load, 1.0), *arms_of(screw, pair.screw, pair.nut))
    return presliding.lateral_stiffness(
        tangential, where(leans, compliance, 0.0), screw.ball_diameter, frame.lead_angle
    )


def _of_sides(screw: BallScrew, pair: LoadedPair) -> Iterator[tuple[Stiffness, RotationalStiffness]]:
    """Tangential and torsional stiffness of the contacts of a flank pair with screw and nut."""
    for contact, race in ((pair.screw, screw.screw_raceway), (pair.nut, screw.nut_raceway)):
        yield _of_contact(screw, contact, race)


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
