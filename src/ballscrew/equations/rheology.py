"""The lubricant: viscosity, and the dimensionless groups of elastohydrodynamic lubrication."""

from __future__ import annotations

from ballscrew._arrays import namespace
from ballscrew.quantities import (
    Density,
    Force,
    KinematicViscosity,
    Length,
    Pressure,
    PressureCoefficient,
    Ratio,
    Speed,
    Temperature,
    TemperatureDifference,
    Viscosity,
)


def material_parameter(equivalent_modulus: Pressure, pressure_viscosity_coefficient: PressureCoefficient) -> Ratio:
    r"""Dimensionless material parameter.

    .. math:: G = E' \alpha_p

    Olaru2005 §2.1 (6). The paper prints no value of the coefficient.
    """
    E, alpha_p = equivalent_modulus, pressure_viscosity_coefficient
    return E * alpha_p


def speed_parameter(
    viscosity: Viscosity, entrainment_speed: Speed, equivalent_modulus: Pressure, rolling_radius: Length
) -> Ratio:
    r"""Dimensionless speed parameter.

    .. math:: U = \frac{\eta_0 v}{E' R_x}

    Olaru2005 §2.1 (7). Viscosity at ambient pressure and contact temperature.
    """
    eta_0, v, E, R_x = viscosity, entrainment_speed, equivalent_modulus, rolling_radius
    return eta_0 * v / (E * R_x)


def load_parameter(contact_load: Force, equivalent_modulus: Pressure, rolling_radius: Length) -> Ratio:
    r"""Dimensionless load parameter.

    .. math:: W = \frac{Q}{E' R_x^2}

    Olaru2005 §2.1 (9).
    """
    Q, E, R_x = contact_load, equivalent_modulus, rolling_radius
    return Q / (E * R_x**2)


def kinematic_viscosity_vogel(
    temperature: Temperature,
    viscosity_at_infinity: KinematicViscosity,
    vogel_constant: TemperatureDifference,
    vogel_temperature: Temperature,
) -> KinematicViscosity:
    r"""Kinematic viscosity against temperature, Vogel's law.

    .. math:: \nu = \nu_A \exp\left(\frac{B}{T - T_0}\right)

    Vogel1921. Above the pole :math:`T_0` only; a fit, good between the temperatures it was made for.
    """
    T, nu_A, B, T_0 = temperature, viscosity_at_infinity, vogel_constant, vogel_temperature
    xp = namespace(T, nu_A, B, T_0)
    return nu_A * xp.exp(B / (T - T_0))


def dynamic_viscosity(kinematic_viscosity: KinematicViscosity, density: Density) -> Viscosity:
    r"""Dynamic viscosity from the kinematic one.

    .. math:: \eta_0 = \nu \rho
    """
    nu, rho = kinematic_viscosity, density
    return nu * rho


def pressure_viscosity_estimate(kinematic_viscosity: KinematicViscosity) -> PressureCoefficient:
    r"""Pressure–viscosity coefficient of a mineral oil from its kinematic viscosity.

    .. math:: \alpha_p = 1.29 \cdot 10^{-7} \nu^{0.204}

    A dimensional fit: SI only (m²/s in, 1/Pa out). Jungnickel2010, mineral oils.
    """
    nu = kinematic_viscosity
    return 1.29e-7 * nu**0.204


def pressure_viscosity_linear(
    temperature: Temperature, pressure_at_zero: Pressure, pressure_slope: Pressure
) -> PressureCoefficient:
    r"""Pressure–viscosity coefficient whose inverse grows linearly with temperature.

    .. math:: \alpha_p = \frac{1}{a_1 + a_2 \left(T - 273.15\right)}

    SI only: the slope is per degree above 0 °C. Lubricants2023, Table A1, the limit of zero
    pressure of its law for the reference oil FVA 3.
    """
    T, a_1, a_2 = temperature, pressure_at_zero, pressure_slope
    return 1 / (a_1 + a_2 * (T - 273.15))
