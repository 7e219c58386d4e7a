"""Conversion of axial load to contact load, torque and efficiency."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, AngularSpeed, Count, Force, Length, Ratio, Speed, Torque


def contact_load(axial_load: Force, loaded_balls: Count, contact_angle: Angle, lead_angle: Angle) -> Force:
    r"""Normal load of each ball when all share the axial load equally.

    .. math:: Q = \frac{F}{z (\sin\alpha) (\cos\varphi)}

    Never printed in the paper, which needs it for Olaru2005 §2.1 (9); with :math:`\varphi = 0` the
    reading closest to its text.
    """
    F, z, alpha, phi = axial_load, loaded_balls, contact_angle, lead_angle
    xp = namespace(F, z, alpha, phi)
    return F / (z * xp.sin(alpha) * xp.cos(phi))


def ideal_torque(axial_load: Force, lead: Length) -> Torque:
    r"""Drive torque of a screw without friction, from the virtual work of one turn.

    .. math:: M_{Sa} = \frac{F P_h}{2 \pi}
    """
    F, P_h = axial_load, lead
    xp = namespace(F, P_h)
    return F * P_h / (2 * xp.pi)


def nut_speed(screw_speed: AngularSpeed, lead: Length) -> Speed:
    r"""Speed of the nut along the screw, which moves it by its lead in each turn.

    .. math:: v_n = \frac{\omega P_h}{2 \pi}
    """
    omega, P_h = screw_speed, lead
    xp = namespace(omega, P_h)
    return omega * P_h / (2 * xp.pi)


def ideal_torque_printed(
    axial_load: Force, screw_contact_radius: Length, lead: Length, pitch_circle_diameter: Length
) -> Torque:
    r"""Drive torque of a screw without friction, as the paper has it.

    .. math:: M_{Sa} = \frac{F R_s P_h}{\pi d_m}

    Olaru2005 §7 (35). Low by the factor 1 - γ (5.6 % at the paper's screw): it breaks virtual work.
    """
    F, R_s, P_h, d_m = axial_load, screw_contact_radius, lead, pitch_circle_diameter
    xp = namespace(F, R_s, P_h, d_m)
    return F * R_s * P_h / (xp.pi * d_m)


def efficiency(ideal_torque: Torque, screw_torque: Torque) -> Ratio:
    r"""Efficiency when the screw drives the nut against the load.

    .. math:: \eta = \frac{M_{Sa}}{M_{Sa} + M_S}

    Olaru2005 §7 (36). Zero without load; undefined where both torques vanish.
    """
    M_Sa, M_S = ideal_torque, screw_torque
    return M_Sa / (M_Sa + M_S)


def back_driving_efficiency(efficiency: Ratio) -> Ratio:
    r"""Efficiency when the load drives the screw; at or below zero the screw locks itself.

    .. math:: \eta_b = 2 - \frac{1}{\eta}

    Same friction torque in both directions. Falls without limit as the direct efficiency vanishes.
    """
    eta = efficiency
    return 2 - 1 / eta


def holding_torque(ideal_torque: Torque, screw_torque: Torque) -> Torque:
    r"""Torque that must be held against a load that drives the screw.

    .. math:: M_h = M_{Sa} - M_S

    With the same friction torque in both directions. Where it is negative the screw locks itself,
    and it is minus the torque that turns the screw with the load.
    """
    M_Sa, M_S = ideal_torque, screw_torque
    return M_Sa - M_S


def classical_efficiency(lead_angle: Angle, friction_angle: Angle) -> Ratio:
    r"""Efficiency of a screw as an inclined plane, screw drives the nut.

    .. math:: \eta = \frac{\tan\varphi}{\tan\left(\varphi + \rho\right)}

    Equals :func:`efficiency` where :math:`\tan(\varphi + \rho) = \tan\varphi + 2 M_S/(F d_m)`.
    """
    phi, rho = lead_angle, friction_angle
    xp = namespace(phi, rho)
    return xp.tan(phi) / xp.tan(phi + rho)


def classical_back_driving_efficiency(lead_angle: Angle, friction_angle: Angle) -> Ratio:
    r"""Efficiency of a screw as an inclined plane, the load drives the screw.

    .. math:: \eta_b = \frac{\tan\left(\varphi - \rho\right)}{\tan\varphi}

    Its friction grows with the force of the thread, not with the load alone, so it lies a little
    above :func:`back_driving_efficiency`.
    """
    phi, rho = lead_angle, friction_angle
    xp = namespace(phi, rho)
    return xp.tan(phi - rho) / xp.tan(phi)


def friction_coefficient(lead_angle: Angle, efficiency: Ratio) -> Ratio:
    r"""Friction coefficient of the inclined plane that has this efficiency, screw drives the nut.

    .. math:: \mu = \frac{(1 - \eta) \tan\varphi}{\eta + \left(\tan\varphi\right)^2}

    The inverse of :func:`classical_efficiency` with :math:`\tan\rho = \mu`, as the charts of THKGeneral and HIWIN2017
    have it: 0.003 to 0.01 for ball screws. It refers to the force of the thread on the pitch circle, and is no
    friction coefficient of a contact.
    """
    phi, eta = lead_angle, efficiency
    xp = namespace(phi, eta)
    return (1 - eta) * xp.tan(phi) / (eta + xp.tan(phi) ** 2)


def friction_angle(friction_coefficient: Ratio) -> Angle:
    r"""Friction angle of a friction coefficient.

    .. math:: \rho = \arctan\mu
    """
    mu = friction_coefficient
    xp = namespace(mu)
    return xp.arctan(mu)
