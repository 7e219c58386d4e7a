"""Heat of a ball screw: convection of the shaft, conduction through the balls, growth, and what it does to preload.

Power dissipated at one ball, mechanism by mechanism, from local forces and local speeds.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Angle,
    AngularSpeed,
    Conductance,
    Conductivity,
    Force,
    HeatTransfer,
    KinematicViscosity,
    Length,
    Power,
    Ratio,
    Speed,
    TemperatureCoefficient,
    TemperatureDifference,
    ThermalResistance,
    Torque,
)


def rotational_reynolds(shaft_diameter: Length, screw_speed: AngularSpeed, air_viscosity: KinematicViscosity) -> Ratio:
    r"""Reynolds number of a shaft that turns in still air.

    .. math:: R_e = \frac{d^2 \omega}{\nu}

    For a speed that is not negative.
    """
    d, omega, nu = shaft_diameter, screw_speed, air_viscosity
    return d**2 * omega / nu


def rotating_shaft_convection(
    rotational_reynolds: Ratio, prandtl: Ratio, air_conductivity: Conductivity, shaft_diameter: Length
) -> HeatTransfer:
    r"""Heat transfer of a shaft that turns in still air.

    .. math:: h = \frac{0.133 k R_e^{2/3} P_r^{1/3}}{d}

    As recalled from the literature on feed drives, where it is usual; no source was read. The speed there is taken with
    the diameter, and not with the radius. A factor of two either way is likely: fast air of a moving table, covers.
    """
    R_e, P_r, k, d = rotational_reynolds, prandtl, air_conductivity, shaft_diameter
    return 0.133 * k * R_e ** (2 / 3) * P_r ** (1 / 3) / d


def spot_resistance(first_integral: Ratio, conductivity: Conductivity, semi_major_axis: Length) -> ThermalResistance:
    r"""Resistance of a half space to the heat that enters it through an elliptic spot.

    .. math:: R = \frac{K}{2 \pi k a}

    Carslaw1959 §8.2 for the circle, where :math:`K = \pi/2` and :math:`R = 1/4 k a`; for the ellipse the
    potential of a charged disc, with the complete integral of modulus :math:`1 - b^2/a^2`. Steady, a spot of one
    temperature; a contact that moves conducts more.
    """
    K, k, a = first_integral, conductivity, semi_major_axis
    xp = namespace(K, k, a)
    return K / (2 * xp.pi * k * a)


def film_resistance(
    film_thickness: Length, conductivity: Conductivity, semi_major_axis: Length, semi_minor_axis: Length
) -> ThermalResistance:
    r"""Resistance of the film in a contact.

    .. math:: R = \frac{h}{\pi k a b}
    """
    h, k, a, b = film_thickness, conductivity, semi_major_axis, semi_minor_axis
    xp = namespace(h, k, a, b)
    return h / (xp.pi * k * a * b)


def gap_conductance(
    conductivity: Conductivity, pitch_circle_diameter: Length, length: Length, gap: Length
) -> Conductance:
    r"""Conductance of the grease between shaft and nut, a thin layer all around.

    .. math:: G = \frac{\pi k d_m l_n}{s}
    """
    k, d_m, l_n, s = conductivity, pitch_circle_diameter, length, gap
    xp = namespace(k, d_m, l_n, s)
    return xp.pi * k * d_m * l_n / s


def thermal_approach_along(
    contact_angle: Angle,
    expansion: TemperatureCoefficient,
    temperature_excess: TemperatureDifference,
    distance: Length,
) -> Length:
    r"""Approach along the normals of a ball by the shaft that grows between two halves of a nut braced together.

    .. math:: \delta = \frac{\beta \theta s (\sin\alpha)}{2}

    Of halves a distance s apart, for a shaft warmer than its nut: what halves that are pulled together gain, and halves
    that are pushed apart lose. Bodies are free, as in :func:`thermal_approach`.
    """
    alpha, beta, theta, s = contact_angle, expansion, temperature_excess, distance
    xp = namespace(alpha, beta, theta, s)
    return beta * theta * s * xp.sin(alpha) / 2


def thermal_approach(
    contact_angle: Angle,
    expansion: TemperatureCoefficient,
    temperature_excess: TemperatureDifference,
    pitch_circle_diameter: Length,
) -> Length:
    r"""Approach of screw and nut groove along the normals of a ball, of a shaft that is warmer than its nut.

    .. math:: \delta = \frac{\beta \theta d_m (\cos\alpha)}{2}

    The shaft's radius grows more than the nut's; a ball of their mean temperature grows as its gap does. Bodies are
    free: what the press fit of a flange or the pull of a housing takes is left out.
    """
    alpha, beta, theta, d_m = contact_angle, expansion, temperature_excess, pitch_circle_diameter
    xp = namespace(alpha, beta, theta, d_m)
    return beta * theta * d_m * xp.cos(alpha) / 2


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
