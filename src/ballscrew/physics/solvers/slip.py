"""Protocol of slip laws: contact input, and the slip at which the ball is in balance."""

from __future__ import annotations

import dataclasses
from typing import NamedTuple, Protocol

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Mask, Ratio, Speed, Torque
from ballscrew.physics.equations import friction
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.torque import Resistances, ball_forces
from ballscrew.physics.laws.traits import law_traits


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


#: A fixed number of steps: block sizes and neighbours in an array cannot change a result.
NEWTON_STEPS = 5
#: The relative change of the last step that still counts as converged.
TOLERANCE = 1e-12


@law_traits(
    excluded="leaves spin and lateral slip out: a known error, and no doubt", curvature_alone=True, lateral_slip=False
)
def curvature_slip(ball: BallProblem) -> Slip:
    """The paper's slip law: curvature alone, its lines imposed at a given offset or found from equilibrium.

    No spin, no lateral slip, and the ball rolls as if the races did not creep. A ball that would
    skid keeps its resistances; the result's ``skid`` validity tells.
    """
    if ball.pure_rolling_offset is not None:
        offsets = (ball.pure_rolling_offset, ball.pure_rolling_offset)
        residual: Ratio = 0.0
    else:
        screw_force, nut_force = sliding_forces(ball, 1.0)
        *offsets, residual = solve(ball.screw, ball.nut, screw_force, nut_force, ball.ball_diameter)
    screw, nut = (
        ContactSlip(offset, contact.curvature_moment_at(offset), 0.0, 0.0, 0.0)
        for contact, offset in zip((ball.screw, ball.nut), offsets, strict=True)
    )
    return Slip(screw, nut, 0.0, 0.0, 1.0, residual, TOLERANCE)


def solve(
    screw: Contact, nut: Contact, screw_force_at_rest: Force, nut_force_at_rest: Force, ball_diameter: Length
) -> tuple[Ratio, Ratio, Ratio]:
    """Offsets for which the traction of each contact is the sliding force that equilibrium asks for.

    ``screw_force_at_rest`` and ``nut_force_at_rest`` are the sliding forces without the curvature
    moments. Where a sliding force exceeds µQ the ball skids: no offset satisfies equilibrium, the
    traction saturates at its limit, and the result is flagged by its ``skid`` validity. Without
    load the traction ratio is undefined; it is taken as saturated, and the moments vanish. Returns
    the offsets at screw and nut, and the relative imbalance that is left.
    """
    xp = namespace(screw.friction_coefficient, nut.friction_coefficient, screw_force_at_rest, nut_force_at_rest)
    zero = 0 * screw.contact_load
    sides = ((screw, screw_force_at_rest), (nut, nut_force_at_rest))

    def sums(total: Torque) -> tuple[Torque, Ratio, list[Ratio]]:
        moments, slope, offsets = zero, zero, []
        for contact, force_at_rest in sides:
            limit = contact.friction_coefficient * contact.contact_load
            force = force_at_rest + total / ball_diameter
            ratio = xp.where(limit > 0, force / xp.where(limit > 0, limit, 1.0), xp.where(force < 0, -1.0, 1.0))
            bounded = xp.minimum(xp.maximum(ratio, -1.0), 1.0)
            offset = friction.offset_from_traction(bounded)
            sliding_freely = xp.abs(ratio) < 1
            moments = moments + contact.curvature_moment_at(offset)
            slope = slope + xp.where(
                sliding_freely,
                contact.semi_major_axis**2 * offset**2 / (2 * contact.deformed_radius * ball_diameter),
                0.0,
            )
            offsets.append(offset)
        return moments, slope, offsets

    total = zero
    for _ in range(NEWTON_STEPS):
        moments, slope, _ = sums(total)
        total = total + (moments - total) / (1 - slope)
    moments, _, (screw_offset, nut_offset) = sums(total)
    scale = xp.abs(moments) + xp.abs(total)
    residual = xp.abs(moments - total) / xp.where(scale > 0, scale, 1.0)
    return screw_offset, nut_offset, residual
