"""Heat of a ball screw: convection of the shaft, conduction through the balls, growth, and what it does to preload."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Angle,
    AngularSpeed,
    Conductance,
    Conductivity,
    HeatTransfer,
    KinematicViscosity,
    Length,
    Ratio,
    TemperatureCoefficient,
    TemperatureDifference,
    ThermalResistance,
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
