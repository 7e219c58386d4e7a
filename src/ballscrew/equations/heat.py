"""Heat of a ball screw: convection of the shaft, conduction through the balls, growth, and what it does to preload."""

from __future__ import annotations

from ballscrew._arrays import namespace
from ballscrew.quantities import (
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

    .. math:: Re = \frac{d^2 \omega}{\nu}

    For a speed that is not negative.
    """
    d, omega, nu = shaft_diameter, screw_speed, air_viscosity
    return d**2 * omega / nu


def rotating_shaft_convection(
    rotational_reynolds: Ratio, prandtl: Ratio, air_conductivity: Conductivity, shaft_diameter: Length
) -> HeatTransfer:
    r"""Heat transfer of a shaft that turns in still air.

    .. math:: h = \frac{0.133 \lambda Re^{2/3} Pr^{1/3}}{d}

    As recalled from the literature on feed drives, where it is usual; no source was read. The speed there is taken with
    the diameter, and not with the radius. A factor of two either way is likely: fast air of a moving table, covers.
    """
    Re, Pr, lambda_, d = rotational_reynolds, prandtl, air_conductivity, shaft_diameter
    return 0.133 * lambda_ * Re ** (2 / 3) * Pr ** (1 / 3) / d


def spot_resistance(first_integral: Ratio, conductivity: Conductivity, semi_major_axis: Length) -> ThermalResistance:
    r"""Resistance of a half space to the heat that enters it through an elliptic spot.

    .. math:: R = \frac{K}{2 \pi \lambda a}

    Carslaw1959 §8.2 for the circle, where :math:`K = \pi/2` and :math:`R = 1/4 \lambda a`; for the ellipse the
    potential of a charged disc, with the complete integral of modulus :math:`1 - b^2/a^2`. Steady, a spot of one
    temperature; a contact that moves conducts more.
    """
    K, lambda_, a = first_integral, conductivity, semi_major_axis
    xp = namespace(K, lambda_, a)
    return K / (2 * xp.pi * lambda_ * a)


def film_resistance(
    film_thickness: Length, conductivity: Conductivity, semi_major_axis: Length, semi_minor_axis: Length
) -> ThermalResistance:
    r"""Resistance of the film in a contact.

    .. math:: R = \frac{h}{\pi \lambda a b}
    """
    h, lambda_, a, b = film_thickness, conductivity, semi_major_axis, semi_minor_axis
    xp = namespace(h, lambda_, a, b)
    return h / (xp.pi * lambda_ * a * b)


def gap_conductance(
    conductivity: Conductivity, pitch_circle_diameter: Length, length: Length, gap: Length
) -> Conductance:
    r"""Conductance of the grease between shaft and nut, a thin layer all around.

    .. math:: G = \frac{\pi \lambda d_m l_n}{s}
    """
    lambda_, d_m, l_n, s = conductivity, pitch_circle_diameter, length, gap
    xp = namespace(lambda_, d_m, l_n, s)
    return xp.pi * lambda_ * d_m * l_n / s


def thermal_approach(
    contact_angle: Angle,
    expansion: TemperatureCoefficient,
    temperature_excess: TemperatureDifference,
    pitch_circle_diameter: Length,
) -> Length:
    r"""Approach of screw and nut groove along the normals of a ball, of a shaft that is warmer than its nut.

    .. math:: \delta_T = \frac{(\cos\alpha) \alpha_T \Delta T d_m}{2}

    The shaft's radius grows more than the nut's; a ball of their mean temperature grows as its gap does. Bodies are
    free: what the press fit of a flange or the pull of a housing takes is left out.
    """
    alpha, alpha_T, dT, d_m = contact_angle, expansion, temperature_excess, pitch_circle_diameter
    xp = namespace(alpha, alpha_T, dT, d_m)
    return xp.cos(alpha) * alpha_T * dT * d_m / 2


def thermal_growth(
    expansion: TemperatureCoefficient, temperature_rise: TemperatureDifference, length: Length
) -> Length:
    r"""Growth of a bar of one temperature.

    .. math:: \Delta l = \alpha_T \Delta T l_0
    """
    alpha_T, dT, l_0 = expansion, temperature_rise, length
    return alpha_T * dT * l_0
