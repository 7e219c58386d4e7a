"""Equilibrium of one ball, and the friction torque it puts on screw and nut.

Signs as in the paper's Figs 2 and 3: on the ball, the sliding force of the screw drives, those of
the nut and of the neighbouring balls brake. "Contact moments" are the sum of the curvature and the
elastic moments of both contacts.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Count, Force, Length, Ratio, Torque


def screw_sliding_force(
    contact_moments: Torque,
    ball_friction_moment: Torque,
    ball_diameter: Length,
    screw_rolling_force: Force,
    nut_rolling_force: Force,
    curvature_ratio: Ratio,
    ball_to_ball_force: Force,
) -> Force:
    r"""Sliding force at the ball–screw contact that keeps the ball in equilibrium.

    .. math:: F_{Ss} = \frac{M + M_B}{d_w} + F_{Rn} + (F_{Rs} + F_{Rn}) \gamma + \frac{F_B}{2}

    Olaru2005 §3 (24), the shear integral of Olaru2005 §2.1 (13) found without integrating.
    """
    M, M_B, d_w = contact_moments, ball_friction_moment, ball_diameter
    F_Rs, F_Rn, gamma, F_B = screw_rolling_force, nut_rolling_force, curvature_ratio, ball_to_ball_force
    return (M + M_B) / d_w + F_Rn + (F_Rs + F_Rn) * gamma + F_B / 2


def nut_sliding_force(
    contact_moments: Torque,
    ball_friction_moment: Torque,
    ball_diameter: Length,
    screw_rolling_force: Force,
    nut_rolling_force: Force,
    curvature_ratio: Ratio,
    ball_to_ball_force: Force,
) -> Force:
    r"""Sliding force at the ball–nut contact that keeps the ball in equilibrium.

    .. math:: F_{Sn} = \frac{M + M_B}{d_w} + F_{Rs} - (F_{Rs} + F_{Rn}) \gamma - \frac{F_B}{2}

    Olaru2005 §3 (25).
    """
    M, M_B, d_w = contact_moments, ball_friction_moment, ball_diameter
    F_Rs, F_Rn, gamma, F_B = screw_rolling_force, nut_rolling_force, curvature_ratio, ball_to_ball_force
    return (M + M_B) / d_w + F_Rs - (F_Rs + F_Rn) * gamma - F_B / 2


def force_imbalance(
    screw_sliding_force: Force,
    nut_sliding_force: Force,
    screw_rolling_force: Force,
    nut_rolling_force: Force,
    screw_pressure_force: Force,
    nut_pressure_force: Force,
    ball_to_ball_force: Force,
) -> Force:
    r"""Net force on the ball along its path; zero in equilibrium.

    .. math:: F_i = F_{Ss} - F_{Sn} - F_{Rs} + F_{Rn} + F_{Ps} - F_{Pn} - F_B

    Olaru2005 §3 (22).
    """
    F_Ss, F_Sn, F_Rs, F_Rn = screw_sliding_force, nut_sliding_force, screw_rolling_force, nut_rolling_force
    F_Ps, F_Pn, F_B = screw_pressure_force, nut_pressure_force, ball_to_ball_force
    return F_Ss - F_Sn - F_Rs + F_Rn + F_Ps - F_Pn - F_B


def moment_imbalance(
    screw_sliding_force: Force,
    nut_sliding_force: Force,
    screw_rolling_force: Force,
    nut_rolling_force: Force,
    contact_moments: Torque,
    ball_friction_moment: Torque,
    ball_diameter: Length,
) -> Torque:
    r"""Net moment on the ball about its centre; zero in equilibrium.

    .. math:: M_i = \left(F_{Ss} + F_{Sn} - F_{Rs} - F_{Rn}\right) \frac{d_w}{2} - M - M_B

    Olaru2005 §3 (23).
    """
    F_Ss, F_Sn, F_Rs, F_Rn = screw_sliding_force, nut_sliding_force, screw_rolling_force, nut_rolling_force
    M, M_B, d_w = contact_moments, ball_friction_moment, ball_diameter
    return (F_Ss + F_Sn - F_Rs - F_Rn) * d_w / 2 - M - M_B


def tangential_force(hydrodynamic_rolling_force: Force, sliding_force: Force) -> Force:
    r"""Tangential force between a ball and one race, in the rolling direction.

    .. math:: F_t = F_R + F_S

    Olaru2005 §6 (27) at the screw and Olaru2005 §6 (30) at the nut.
    """
    F_R, F_S = hydrodynamic_rolling_force, sliding_force
    return F_R + F_S


def race_torque(tangential_force: Force, contact_radius: Length) -> Torque:
    r"""Friction torque of one ball on one race, as the paper has it.

    .. math:: M_r = F_t R_r

    Olaru2005 §6 (28) for the screw and Olaru2005 §6 (31) for the nut. Incomplete: the race also
    takes the moments of the contact, see :func:`balanced_screw_torque`.
    """
    F_t, R_r = tangential_force, contact_radius
    return F_t * R_r


def balanced_screw_torque(
    tangential_force: Force, contact_radius: Length, contact_moment: Torque, rolling_plane_cosine: Ratio
) -> Torque:
    r"""Friction torque of one ball on the screw, moments of the contact included.

    .. math:: M_r = F_t R_r + M c_\alpha

    Completes Olaru2005 §6, so that action equals reaction and the torque's power is what is
    dissipated.
    """
    F_t, R_r, M, c_alpha = tangential_force, contact_radius, contact_moment, rolling_plane_cosine
    return F_t * R_r + M * c_alpha


def balanced_nut_torque(
    tangential_force: Force, contact_radius: Length, contact_moment: Torque, rolling_plane_cosine: Ratio
) -> Torque:
    r"""Friction torque of one ball on the nut, moments of the contact included.

    .. math:: M_r = F_t R_r - M c_\alpha

    Completes Olaru2005 §6; see :func:`balanced_screw_torque`.
    """
    F_t, R_r, M, c_alpha = tangential_force, contact_radius, contact_moment, rolling_plane_cosine
    return F_t * R_r - M * c_alpha


def spin_torque(spin_moment: Torque, rolling_plane_sine: Ratio) -> Torque:
    r"""Torque that the spin of one ball hands from the screw to the nut.

    .. math:: M_r = M_P s_\alpha

    The spin moments of the two contacts are equal and opposite, or the ball would spin up.
    """
    M_P, s_alpha = spin_moment, rolling_plane_sine
    return M_P * s_alpha


def torsion_torque(lateral_force: Force, ball_diameter: Length, lead_angle: Angle) -> Torque:
    r"""Torque that the lateral slip of one ball hands from the screw to the nut.

    .. math:: M_r = F_L \frac{d_w}{2} \sin\varphi

    The lateral forces of the two contacts hold each other's moment about the path.
    """
    F_L, d_w, phi = lateral_force, ball_diameter, lead_angle
    xp = namespace(F_L, d_w, phi)
    return F_L * d_w / 2 * xp.sin(phi)


def chain_braking_force(
    ball_to_ball_force: Force, ball_friction_moment: Torque, path_radius: Length, rolling_plane_cosine: Ratio
) -> Force:
    r"""Braking force of a curved chain: neighbours that rub also push the ball back.

    .. math:: F_{B2} = F_B + \frac{M_B c_\alpha}{L}

    The moment is that of both neighbours. A straight chain (:math:`L \to \infty`) adds nothing.
    """
    F_B, M_B, L, c_alpha = ball_to_ball_force, ball_friction_moment, path_radius, rolling_plane_cosine
    return F_B + M_B * c_alpha / L


def total_friction_torque(loaded_balls: Count, torque_per_ball: Torque) -> Torque:
    r"""Friction torque of all loaded balls under equal load.

    .. math:: M_t = z M_i

    Olaru2005 §6 (33) for the screw and Olaru2005 §6 (34) for the nut, whose sums have equal terms
    when all balls carry the same load.
    """
    z, M_i = loaded_balls, torque_per_ball
    return z * M_i
