"""Friction of one ball on four contacts, as balls that are too big for their grooves have."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.quantities import Angle, AngularSpeed, Force, Mask, Power, Ratio, Torque
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import kinematics
from ballscrew.physics.friction.balls import MECHANISMS, BallFriction, BallModel, ball_contacts, ball_friction
from ballscrew.physics.laws.ball_chain import BallInCircuit, force_between_balls
from ballscrew.physics.laws.conditions import Motion
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.solvers.four_point_slip import FlankPair, FourPointBall, four_point_slip


class LoadedFlanks(NamedTuple):
    """A pair of flanks of a ball: its load, its angle, and the contacts with screw and nut."""

    load: Force
    angle: Angle
    screw: Contact
    nut: Contact


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class FourContactFriction:
    """Friction of one ball on four contacts in its equilibrium; on two where a flank pair is relieved."""

    #: The flank pair that carries the load, and the one that it relieves.
    flanks: tuple[LoadedFlanks, LoadedFlanks]
    screw_speed: AngularSpeed
    #: Torque on the screw by mechanism, N m.
    contributions: Mapping[str, Torque]
    nut_torque: Torque
    rolling_share: Ratio
    ball_to_ball_force: Force
    net_braking_force: Force
    skids: Mask
    converged: Mask

    @property
    def screw_torque(self) -> Torque:
        """Friction torque of the ball on the screw."""
        return sum(self.contributions.values())

    @property
    def screw(self) -> Contact:
        """The contact with the screw on the flank that carries the load."""
        return self.flanks[0].screw

    @property
    def nut(self) -> Contact:
        """The contact with the nut on the flank that carries the load."""
        return self.flanks[0].nut

    @property
    def contact_load(self) -> Force:
        """Load of the flank pair that carries the load."""
        return self.flanks[0].load

    @property
    def entrainment_speed(self) -> Any:
        """Entrainment speed on the flank pair that carries the load."""
        return self.screw.motion.entrainment_speed

    @property
    def dissipation(self) -> Mapping[str, Power]:
        """Power dissipated at the ball by mechanism, W: the torque is the least power over the speed."""
        return {mechanism: torque * self.screw_speed for mechanism, torque in self.contributions.items()}


def four_contact_friction(
    model: BallModel,
    screw: BallScrew,
    lubricant: Lubricant,
    flanks: tuple[tuple[Force, Angle], tuple[Force, Angle]],
    screw_speed: AngularSpeed,
    imposed_ball_force: Force,
) -> FourContactFriction:
    """Friction of a ball with these loads and angles of its flank pairs; a relieved flank takes no part."""
    laws, omega = model.laws, screw_speed
    xp = namespace(omega, screw.contact_angle, *flanks[0], *flanks[1])
    both = flanks[0][0] + flanks[1][0]
    pairs: list[LoadedFlanks] = []
    for load, angle in flanks:
        at_angle = dataclasses.replace(screw, contact_angle=where(load > 0, angle, screw.contact_angle))
        frame = laws.frame(at_angle)
        lateral = kinematics.torsion_speed(omega, screw.ball_diameter, frame.lead_angle) / 2
        v = frame.entrainment_speed(omega)
        # between equally loaded flanks the ball turns about the binormal; what of its rotation does not roll spins, at
        # the screw more than at the nut. The more one pair carries, the nearer its contacts are to those of a ball that
        # touches no other, which halves the relative spin between screw and nut.
        spin = kinematics.relative_spin(omega, frame.rolling_plane_sine)
        about_binormal = kinematics.ball_rotation(v, screw.ball_diameter) * xp.tan(at_angle.contact_angle)
        leaning = where(both > 0, xp.maximum(2 * load - both, 0.0) / where(both > 0, both, 1.0), 0.0)
        at_nut = (1 - leaning) * about_binormal - leaning * spin / 2
        motions = (Motion(v, at_nut + spin, lateral), Motion(v, abs(at_nut), lateral))
        # of a flank that is lifted off nothing is used, at a load at which it has derivatives
        computed = where(load == 0, both, load)
        contacts = ball_contacts(model.contact_laws, at_angle, lubricant, frame, computed, motions)
        pairs.append(LoadedFlanks(load, at_angle.contact_angle, *contacts))
    frame = laws.frame(screw)
    ball = _in_circuit(model, screw, frame, pairs, omega)
    F_B = force_between_balls(model.ball_force, laws.ball_force, imposed_ball_force, both, ball)
    chain = laws.ball_chain(model.ball_friction_coefficient, F_B, screw.ball_diameter, frame)
    one, other = (FlankPair(pair.screw, pair.nut, pair.angle) for pair in pairs)
    slip = four_point_slip(
        FourPointBall(
            one,
            other,
            chain.moment,
            chain.net_braking_force,
            screw.ball_diameter,
            frame.lead_angle,
            frame.path_radius,
        )
    )
    result = FourContactFriction(
        flanks=(pairs[0], pairs[1]),
        screw_speed=omega,
        contributions=slip.contributions,
        nut_torque=slip.nut_torque,
        rolling_share=slip.rolling_share,
        ball_to_ball_force=slip.rolling_share * F_B,
        net_braking_force=slip.rolling_share * chain.net_braking_force,
        skids=slip.rolling_share != 1,
        converged=slip.converged,
    )
    lifted = (flanks[0][0] == 0) | (flanks[1][0] == 0)
    if isinstance(lifted, bool | np.bool_ | np.ndarray) and not np.any(lifted):
        return result
    angle = where(flanks[0][0] > 0, flanks[0][1], flanks[1][1])
    angle = where(both > 0, angle, screw.contact_angle)
    two = two_contact_friction(model, screw, lubricant, both, angle, omega, imposed_ball_force)
    return _on_two_where(lifted, result, two)


def _in_circuit(
    model: BallModel, screw: BallScrew, frame: Frame, pairs: Sequence[LoadedFlanks], screw_speed: AngularSpeed
) -> BallInCircuit:
    """The ball as a law of the force between balls may read it, with the spin of the pair that carries the load."""
    one, other = pairs
    both = one.load + other.load
    xp = namespace(both, one.angle)
    forced = kinematics.relative_spin(1.0, frame.rolling_plane_sine)
    rotation = kinematics.ball_rotation(frame.entrainment_speed(1.0), screw.ball_diameter)
    share = where(both > 0, xp.maximum(one.load - other.load, 0.0) / where(both > 0, both, 1.0), 0.0)
    spin = forced + 2 * (1 - share) * rotation * xp.tan(screw.contact_angle)
    return BallInCircuit(screw, frame, one.screw, one.nut, spin, screw_speed, model.ball_friction_coefficient)


def two_contact_friction(
    model: BallModel,
    screw: BallScrew,
    lubricant: Lubricant,
    contact_load: Force,
    contact_angle: Angle,
    screw_speed: AngularSpeed,
    imposed_ball_force: Force,
) -> BallFriction:
    """Friction of a ball that touches one flank pair at this angle."""
    at_angle = dataclasses.replace(screw, contact_angle=contact_angle)
    frame = model.laws.frame(at_angle)
    return ball_friction(model, at_angle, lubricant, frame, contact_load, screw_speed, imposed_ball_force)


def _on_two_where(lifted: Mask, four: FourContactFriction, two: BallFriction) -> FourContactFriction:
    """The friction on four contacts, or on two where a flank pair has lifted off."""
    loaded_skid = (
        (two.contact_load > 0)
        & (abs(two.screw.sliding_force) <= two.screw.traction_limit)
        & (abs(two.nut.sliding_force) <= two.nut.traction_limit)
        & (two.rolling_share == 1)
    )

    def pick(of_two: Any, of_four: Any) -> Any:
        return where(lifted, of_two, of_four)

    return dataclasses.replace(
        four,
        contributions={name: pick(two.contributions[name], four.contributions[name]) for name in MECHANISMS},
        nut_torque=pick(two.nut_torque, four.nut_torque),
        rolling_share=pick(two.rolling_share, four.rolling_share),
        ball_to_ball_force=pick(two.ball_to_ball_force, four.ball_to_ball_force),
        net_braking_force=pick(two.net_braking_force, four.net_braking_force),
        skids=pick(~loaded_skid, four.skids),
        converged=pick(two.converged, four.converged),
    )
