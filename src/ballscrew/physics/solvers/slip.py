"""Protocol of slip laws: contact input, and the slip at which the ball is in balance."""

from __future__ import annotations

import dataclasses
from typing import NamedTuple, Protocol

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Mask, Ratio, Speed, Torque
from ballscrew.physics.laws.balance import Resistances, ball_forces
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.frame import Frame


class BallProblem(NamedTuple):
    """One ball under load, all that resists it but the slip, and the speed of the screw."""

    screw: Contact
    nut: Contact
    resistances: Resistances
    ball_diameter: Length
    frame: Frame
    screw_speed: AngularSpeed
    pure_rolling_offset: Ratio | None


class ContactSlip(NamedTuple):
    """Slip of one contact, and the moment about the ball that its curvature causes."""

    pure_rolling_offset: Ratio
    curvature_moment: Torque
    creep_speed: Speed
    spin: AngularSpeed
    lateral_slip_speed: Speed


@dataclasses.dataclass(frozen=True, eq=False)
class Slip:
    """Outcome: the slip at both contacts, what they hand through the ball, and how well it closes.

    ``rolling_share`` is the share of the other resistances that friction can carry: below one the
    ball skids, and they fall until it is in balance.
    """

    screw: ContactSlip
    nut: ContactSlip
    spin_moment: Torque
    lateral_force: Force
    rolling_share: Ratio
    residual: Ratio
    tolerance: float

    @property
    def converged(self) -> Mask:
        """Mask: the slip balance converged."""
        return self.residual <= self.tolerance

    @property
    def advice(self) -> str:
        """Remedy where the balance did not converge."""
        return (
            "the contact is too large for its groove (check contact_load, ball_diameter and conformity), "
            "or the ball is about to skid (more load or less speed)"
        )


class SlipLaw(Protocol):
    """Slip of the contacts of a ball."""

    def __call__(self, ball: BallProblem, /) -> Slip:
        """The slip with which the ball is in balance."""
        ...


def contact_rotation(ball: BallProblem, contact: Contact) -> Ratio:
    """Rotation of ball against race in the contact, for one rad/s of the screw."""
    return ball.frame.entrainment_speed(1.0) / contact.rolling_radius


def sliding_forces(ball: BallProblem, rolling_share: Ratio) -> tuple[Force, Force]:
    """Sliding forces at screw and nut that hold what resists the ball, without the curvature moments."""
    forces = ball_forces(ball.resistances.scaled(rolling_share), ball.ball_diameter, ball.frame)
    return forces.screw_sliding_force, forces.nut_sliding_force


def carried_share(ball: BallProblem) -> Ratio:
    """Share of the resistances, slip aside, that the friction of both contacts can carry; one at most.

    What friction can carry is its coefficient times the load, less what the curvature moments may
    ask of it at most, 0.1 µQa²/R_d at each contact.
    """
    limits = [contact.friction_coefficient * contact.contact_load for contact in (ball.screw, ball.nut)]
    curvature = sum(
        0.1 * limit * contact.semi_major_axis**2 / (contact.deformed_radius * ball.ball_diameter)
        for limit, contact in zip(limits, (ball.screw, ball.nut), strict=True)
    )
    forces = sliding_forces(ball, 1.0)
    xp = namespace(curvature, *limits, *forces)
    share = 1.0
    for limit, force in zip(limits, forces, strict=True):
        needed = xp.abs(force)
        left = xp.maximum(limit - curvature, 0.0)
        share = xp.minimum(share, xp.where(needed > left, left / xp.where(needed > left, needed, 1.0), 1.0))
    return share
