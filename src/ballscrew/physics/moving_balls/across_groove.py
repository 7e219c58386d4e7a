"""Where the balls of two contacts lie across their grooves in motion, and what that changes.

Friction of the helix pushes them off the line of the groove centres (:mod:`ballscrew.physics.equations.across_groove`).
Their contact angles at screw and nut then differ, the one way where the load is lifted and the other where it is
lowered; the spin of both contacts is less there and more here, as both normals lean towards the same side; and the nut
lies nearer to the screw by what the ball has moved out of its line, so that it steps axially when the direction of
rotation changes.

The models of the package leave this out: it is exact mechanics that no published measurement of a ball screw has
shown. What it makes of a preload that was set at rest is in :mod:`ballscrew.physics.friction.across_groove`.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any
from ballscrew.basis.quantities import Angle, AngularSpeed, Force, Info, Length, Ratio
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import across_groove, kinematics
from ballscrew.physics.friction.across_groove import arms_of
from ballscrew.physics.friction.balls import BallFriction, ball_friction
from ballscrew.physics.friction.loaded_balls import LoadedBalls
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult

#: Rounds of spin and lateral force: each changes the other by a tenth at most.
ROUNDS = 6


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class OffLineBalls:
    """The balls of one kind where they lie in steady motion, with their ``friction`` there; elementwise."""

    lateral_friction_angle: Annotated[
        Angle, Info(r"\beta", "lean of each normal; above zero where the load is lifted", "deg")
    ]
    screw_contact_angle: Annotated[Angle, Info(r"\alpha_s", "contact angle at the screw", "deg")]
    nut_contact_angle: Annotated[Angle, Info(r"\alpha_n", "contact angle at the nut", "deg")]
    distance: Annotated[Length, Info(r"\eta", "distance of the balls from the line of the groove centres", "um")]
    axial_step: Annotated[
        Length, Info("x_r", "axial step of the nut while the balls cross the line, at a constant load", "um")
    ]
    spin_share: Annotated[Ratio, Info(r"\Omega_P'/\Omega_P", "spin over that of balls on the line")]
    torque_ratio: Annotated[Ratio, Info("M'/M", "friction torque of a ball over that of one on the line")]
    friction: BallFriction


@accepts_units("operation")
def off_line_balls(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, *, axial_load: Force, screw_speed: AngularSpeed
) -> tuple[OffLineBalls, ...]:
    """The balls of each kind off the line of their grooves, those that carry the load first: :class:`OffLineBalls`.

    ``model`` gives the friction of ``screw`` with ``lubricant`` under ``axial_load`` (N) at ``screw_speed`` (rad/s);
    spin and lateral force are found together. Balls that differ are taken as alike, between rigid bodies. Balls without
    load are left out where the whole kind has none.

    Raises :class:`~ballscrew.basis.errors.InputError` as the model, and for balls on four contacts, which stay on their
    line.
    """
    result = of_balls_alike(model, screw, lubricant, axial_load=axial_load, screw_speed=screw_speed)
    four = [kind for kind in result.kinds if not isinstance(kind.friction, BallFriction)]
    if four:
        remedy = "ask for a nut whose balls have two"
        raise_if_any(
            [Fault("nut.type", "has balls on four contacts, which stay on the line of their grooves", "", remedy)]
        )
    lifts = where(axial_load * screw_speed >= 0, 1.0, -1.0)
    return tuple(
        _of_kind(model, result, lubricant, kind, way) for kind, way in zip(result.kinds, (lifts, -lifts), strict=False)
    )


def of_balls_alike(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, *, axial_load: Force, screw_speed: AngularSpeed
) -> FrictionResult:
    """The friction of a nut with all balls of a kind alike, between rigid bodies and without losses beside them.

    Raises :class:`~ballscrew.basis.errors.InputError` as the model.
    """
    if screw.nut.one_by_one or screw.nut.losses:
        screw = dataclasses.replace(screw, nut=dataclasses.replace(screw.nut, bodies=None, deviations=None, losses={}))
    return model(screw, lubricant, axial_load=axial_load, screw_speed=screw_speed)


def _of_kind(
    model: FrictionModel, friction_result: FrictionResult, lubricant: Lubricant, kind: LoadedBalls, way: Ratio
) -> OffLineBalls:
    at_line = kind.friction
    assert isinstance(at_line, BallFriction), "four contacts are refused"
    screw = dataclasses.replace(friction_result.ball_screw, contact_angle=kind.contact_angle)
    frame, Q, omega = at_line.frame, at_line.contact_load, abs(friction_result.screw_speed)
    v = frame.entrainment_speed(1.0)
    rotations = v / at_line.screw.rolling_radius, v / at_line.nut.rolling_radius
    total = kinematics.relative_spin(1.0, frame.rolling_plane_sine)
    here, spin = at_line, total
    beta = 0.0 * Q
    for _ in range(ROUNDS):
        beta = way * across_groove.lateral_friction_angle(here.lateral_force, Q)
        spin = across_groove.off_line_spin(total, *rotations, beta)
        leaning = dataclasses.replace(frame, rolling_plane_sine=abs(spin))
        here = ball_friction(model, screw, lubricant, leaning, Q, omega, model.imposed_ball_force(screw))
    arms = arms_of(screw, here.screw, here.nut)
    s = across_groove.off_line_centre_distance(*arms, beta)
    xp = namespace(kind.contact_angle, screw.lead_angle)
    growth = across_groove.off_line_growth(s, *arms, beta)
    return OffLineBalls(
        lateral_friction_angle=beta,
        screw_contact_angle=kind.contact_angle - beta,
        nut_contact_angle=kind.contact_angle + beta,
        distance=across_groove.off_line_distance(*arms, beta),
        axial_step=growth / (xp.sin(kind.contact_angle) * xp.cos(screw.lead_angle)),
        spin_share=spin / total,
        torque_ratio=here.screw_torque / at_line.screw_torque,
        friction=here,
    )
