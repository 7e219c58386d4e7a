"""Power dissipated at one ball, mechanism by mechanism, from local forces and local speeds."""

from __future__ import annotations

from ballscrew.basis.quantities import AngularSpeed, Force, Power, Speed, Torque


def hydrodynamic_rolling_power(
    screw_rolling_force: Force, nut_rolling_force: Force, screw_entrainment_speed: Speed, nut_entrainment_speed: Speed
) -> Power:
    r"""Power lost in the two contact inlets.

    .. math:: P = 2 (F_{Rs} v_s + F_{Rn} v_n)

    The mean of the surface speeds of ball and race, at each contact; without creep both are v.
    """
    F_Rs, F_Rn, v_s, v_n = screw_rolling_force, nut_rolling_force, screw_entrainment_speed, nut_entrainment_speed
    return 2 * (F_Rs * v_s + F_Rn * v_n)


def creep_power(
    screw_sliding_force: Force, nut_sliding_force: Force, screw_creep_speed: Speed, nut_creep_speed: Speed
) -> Power:
    r"""Power of the sliding forces, as the races creep ahead of the ball.

    .. math:: P = F_{Ss} A_s + F_{Sn} A_n
    """
    F_Ss, F_Sn, A_s, A_n = screw_sliding_force, nut_sliding_force, screw_creep_speed, nut_creep_speed
    return F_Ss * A_s + F_Sn * A_n


def spin_power(spin_moment: Torque, relative_spin: AngularSpeed) -> Power:
    r"""Power of the spin in both contacts.

    .. math:: P = M_P \Omega_P
    """
    M_P, Omega_P = spin_moment, relative_spin
    return M_P * Omega_P


def torsion_power(lateral_force: Force, torsion_speed: Speed) -> Power:
    r"""Power of the lateral slip in both contacts.

    .. math:: P = F_L D
    """
    F_L, D = lateral_force, torsion_speed
    return F_L * D


def contact_moment_power(
    screw_moment: Torque, nut_moment: Torque, screw_contact_rotation: AngularSpeed, nut_contact_rotation: AngularSpeed
) -> Power:
    r"""Power of a moment in each contact, elastic hysteresis or curvature friction.

    .. math:: P = M_s \Omega_s + M_n \Omega_n
    """
    M_s, M_n = screw_moment, nut_moment
    Omega_s, Omega_n = screw_contact_rotation, nut_contact_rotation
    return M_s * Omega_s + M_n * Omega_n


def ball_rubbing_power(ball_friction_moment: Torque, ball_rotation: AngularSpeed) -> Power:
    r"""Power lost between the rubbing surfaces of neighbouring balls.

    .. math:: P = M_B \omega_b
    """
    M_B, omega_b = ball_friction_moment, ball_rotation
    return M_B * omega_b


def chain_braking_power(net_braking_force: Force, orbital_speed: Speed) -> Power:
    r"""Power lost in pushing the chain of balls along.

    .. math:: P = F_B v_o
    """
    F_B, v_o = net_braking_force, orbital_speed
    return F_B * v_o
