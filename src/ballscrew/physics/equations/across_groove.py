r"""A ball off the line of its grooves: friction across the path pushes it there in motion.

The helix drags the ball across its path at screw and nut towards the same side: the moments of the two forces about the
path hold each other, and the forces add. What holds them are the contact normals, which no longer lie in one line. The
ball with its two contacts is a body under two forces, so that both resultants lie on the chord between its contacts,
and each normal leans from it by the angle of friction across the path.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, AngularSpeed, Compliance, Force, Length


def lateral_friction_angle(lateral_force: Force, contact_load: Force) -> Angle:
    r"""Angle by which each contact normal leans from the chord between both contacts.

    .. math:: \beta = \arctan\left(\frac{F_L}{Q}\right)

    The contact angles at screw and nut differ by twice that. Balls on two contacts; on four the other flanks hold the
    ball.
    """
    F_L, Q = lateral_force, contact_load
    xp = namespace(F_L, Q)
    return xp.arctan(F_L / Q)


def off_line_centre_distance(screw_arm: Length, nut_arm: Length, lateral_friction_angle: Angle) -> Length:
    r"""Distance of the groove centres around a ball that lies off their line.

    .. math:: s = \sqrt{\left(a_s + a_n\right)^2 - 4 a_s a_n \sin^2\beta}

    The arms are those from the centre of the ball to the centres of the grooves: groove radius less ball radius, and
    the approach. Exact: the triangle of the three centres.
    """
    a_s, a_n, beta = screw_arm, nut_arm, lateral_friction_angle
    xp = namespace(a_s, a_n, beta)
    return xp.sqrt((a_s + a_n) ** 2 - 4 * a_s * a_n * xp.sin(beta) ** 2)


def off_line_distance(screw_arm: Length, nut_arm: Length, lateral_friction_angle: Angle) -> Length:
    r"""Distance of the ball's centre from the line of the groove centres.

    .. math:: \eta = \frac{a_s a_n \sin(2 \beta)}{\sqrt{\left(a_s + a_n\right)^2 - 4 a_s a_n \sin^2\beta}}

    The height of the triangle of the three centres; :math:`a F_L/Q` where both arms are a and the angle is small.
    """
    a_s, a_n, beta = screw_arm, nut_arm, lateral_friction_angle
    xp = namespace(a_s, a_n, beta)
    return a_s * a_n * xp.sin(2 * beta) / xp.sqrt((a_s + a_n) ** 2 - 4 * a_s * a_n * xp.sin(beta) ** 2)


def off_line_growth(
    centre_distance: Length, screw_arm: Length, nut_arm: Length, lateral_friction_angle: Angle
) -> Length:
    r"""Further approach of a ball that is pushed off the line of groove centres which stay where they are.

    .. math:: g = \frac{4 a_s a_n \sin^2\beta}{a_s + a_n + s}

    This is :math:`a_s + a_n - s`, the arms as they are off the line; a ball that is larger by as much presses as hard.
    """
    s, a_s, a_n, beta = centre_distance, screw_arm, nut_arm, lateral_friction_angle
    xp = namespace(s, a_s, a_n, beta)
    return 4 * a_s * a_n * xp.sin(beta) ** 2 / (a_s + a_n + s)


def off_line_spin(
    relative_spin: AngularSpeed, screw_rotation: AngularSpeed, nut_rotation: AngularSpeed, lateral_friction_angle: Angle
) -> AngularSpeed:
    r"""Spin that both contacts of a ball off the line of its grooves share.

    .. math:: \Omega_l = \Omega_P \cos\beta - \left(\Omega_s + \Omega_n\right) \sin\beta

    The rotations are those of the ball's rolling against screw and nut: as both normals lean towards the side to which
    friction drags the ball, the rolling has a component about each. The angle counts as positive where the screw pushes
    the balls the way that it moves against the nut (the load is lifted, the spin becomes less), and as negative where
    the load is lowered.
    """
    Omega_P, Omega_s, Omega_n, beta = relative_spin, screw_rotation, nut_rotation, lateral_friction_angle
    xp = namespace(Omega_P, Omega_s, Omega_n, beta)
    return Omega_P * xp.cos(beta) - (Omega_s + Omega_n) * xp.sin(beta)


def groove_compliance(contact_load: Force, screw_arm: Length, nut_arm: Length) -> Compliance:
    r"""Compliance with which the grooves hold a ball on two contacts against friction across its path.

    .. math:: c_\eta = \frac{4 a_s a_n}{Q \left(a_s + a_n\right)}

    Twice the distance :math:`\eta` from the line of the groove centres over the lateral force at each contact, for
    small angles: a ball that rolls without slipping sideways takes up both contacts' share of the slip by moving across
    half as far.
    """
    Q, a_s, a_n = contact_load, screw_arm, nut_arm
    return 4 * a_s * a_n / (Q * (a_s + a_n))
