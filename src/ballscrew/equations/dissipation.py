"""Power dissipated at one ball, mechanism by mechanism, from local forces and local speeds."""

from __future__ import annotations

from ballscrew.quantities import AngularSpeed, Force, Power, Speed, Torque


def hydrodynamic_rolling_power(screw_rolling_force: Force, nut_rolling_force: Force, entrainment_speed: Speed) -> Power:
    r"""Power lost in the two contact inlets.

    .. math:: P = 2 v (F_{Rs} + F_{Rn})
    """
    F_Rs, F_Rn, v = screw_rolling_force, nut_rolling_force, entrainment_speed
    return 2 * v * (F_Rs + F_Rn)


def contact_moment_power(
    screw_moment: Torque, nut_moment: Torque, screw_contact_rotation: AngularSpeed, nut_contact_rotation: AngularSpeed
) -> Power:
    r"""Power of a moment in each contact, elastic hysteresis or curvature friction.

    .. math:: P = M_s \Omega_s + M_n \Omega_n
    """
    M_s, M_n = screw_moment, nut_moment
    Omega_s, Omega_n = screw_contact_rotation, nut_contact_rotation
    return M_s * Omega_s + M_n * Omega_n


def ball_chain_power(
    ball_friction_moment: Torque, ball_rotation: AngularSpeed, ball_to_ball_force: Force, orbital_speed: Speed
) -> Power:
    r"""Power lost between balls, and in pushing the chain along.

    .. math:: P = M_B \omega_b + F_B v_o
    """
    M_B, omega_b, F_B, v_o = ball_friction_moment, ball_rotation, ball_to_ball_force, orbital_speed
    return M_B * omega_b + F_B * v_o
