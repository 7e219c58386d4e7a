r"""Position of the lines of pure rolling: the offset Y at both contacts from the ball's equilibrium.

The curvature moments enter the sliding forces, (24) and (25); each sliding force fixes its offset,
:math:`F_S = \mu Q (1 - 3Y + Y^3)`; each offset fixes its curvature moment, (15). One unknown is
enough: the sum S of both moments, with :math:`S = \sum_i M_{C,i}(Y_i(S))`. The slope of the right
side is :math:`\sum_i a_i^2 Y_i^2/(2 R_{d,i} d_w)`, whatever friction and load are: below 0.01 for a
screw and below 0.5 for any contact that fits its groove, so Newton's method cannot fail.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Force, Length, Ratio, Torque
from ballscrew.physics.equations import friction
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.traits import law_traits
from ballscrew.physics.solvers.slip import BallProblem, ContactSlip, Slip, sliding_forces

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
