"""The lubricant: viscosity, and the dimensionless groups of elastohydrodynamic lubrication."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Conductivity,
    Density,
    Force,
    KinematicViscosity,
    Length,
    Pressure,
    PressureCoefficient,
    Ratio,
    Speed,
    Temperature,
    TemperatureCoefficient,
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


def dynamic_viscosity(kinematic_viscosity: KinematicViscosity, density: Density) -> Viscosity:
    r"""Dynamic viscosity from the kinematic one.

    .. math:: \eta_0 = \nu \rho
    """
    nu, rho = kinematic_viscosity, density
    return nu * rho


def pressure_viscosity_estimate(kinematic_viscosity: KinematicViscosity) -> PressureCoefficient:
    r"""Pressure–viscosity coefficient of a mineral oil from its kinematic viscosity.

    .. math:: \alpha_p = 1.29 \cdot 10^{-7} \nu^{0.204}

    A dimensional fit: SI only (m²/s in, 1/Pa out). Jungnickel2010, mineral oils; 2 to 39 % below those of the twelve
    mineral oils of StachowiakBatchelor2005, Table 2.3.
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


def pressure_modulus_slope_linear(
    temperature: Temperature, slope_at_zero: Ratio, slope_per_degree: TemperatureCoefficient
) -> Ratio:
    r"""Growth of the pressure modulus with the pressure, linear with temperature.

    .. math:: B = b_1 + b_2 \left(T - 273.15\right)

    SI only: the second number is per degree above 0 °C. Mann, as Arana2019 has it for three oils from 25 to 60 °C.
    """
    T, b_1, b_2 = temperature, slope_at_zero, slope_per_degree
    return b_1 + b_2 * (T - 273.15)


def barus_viscosity(
    viscosity: Viscosity, pressure_viscosity_coefficient: PressureCoefficient, pressure: Pressure
) -> Viscosity:
    r"""Viscosity under pressure, exponential.

    .. math:: \eta = \eta_0 \exp\left(\alpha_p p\right)

    Barus1893. Good to some 0.1 GPa; at 1 GPa an oil of 0.1 Pa s has thousands of times the viscosity
    of :func:`roelands_viscosity`.
    """
    eta_0, alpha_p, p = viscosity, pressure_viscosity_coefficient, pressure
    xp = namespace(eta_0, alpha_p, p)
    return eta_0 * xp.exp(alpha_p * p)


def roelands_exponent(viscosity: Viscosity, pressure_viscosity_coefficient: PressureCoefficient) -> Ratio:
    r"""Pressure exponent of Roelands' law that has the given pressure–viscosity coefficient.

    .. math:: Z = \frac{\alpha_p}{5.1 \cdot 10^{-9} \left(\ln \eta_0 + 9.67\right)}

    Roelands1966. SI only: the logarithm is that of the viscosity in Pa s, above 6.3e-5 Pa s. Mineral
    oils have 0.5 to 0.7.
    """
    eta_0, alpha_p = viscosity, pressure_viscosity_coefficient
    xp = namespace(eta_0, alpha_p)
    return alpha_p / (5.1e-9 * (xp.log(eta_0) + 9.67))


def roelands_viscosity(viscosity: Viscosity, pressure: Pressure, roelands_exponent: Ratio) -> Viscosity:
    r"""Viscosity under pressure, flatter than exponential.

    .. math:: \eta = \eta_0 \exp\left(\left(\ln \eta_0 + 9.67\right)
        \left(\left(1 + 5.1 \cdot 10^{-9} p\right)^Z - 1\right)\right)

    Roelands1966. SI only: the numbers are in Pa s and 1/Pa. Measured to 0.5 GPa or so, used to some
    GPa; real oils thicken faster there, and it tells nothing about the glass.
    """
    eta_0, p, Z = viscosity, pressure, roelands_exponent
    xp = namespace(eta_0, p, Z)
    return eta_0 * xp.exp((xp.log(eta_0) + 9.67) * ((1 + 5.1e-9 * p) ** Z - 1))


def pressure_modulus_viscosity(
    viscosity: Viscosity,
    pressure: Pressure,
    pressure_viscosity_coefficient: PressureCoefficient,
    pressure_modulus_slope: Ratio,
) -> Viscosity:
    r"""Viscosity under pressure of an oil whose pressure modulus grows with the pressure.

    .. math:: \eta = \eta_0 \exp\left(\frac{p}{1/\alpha_p + B p}\right)

    Mann, as Arana2019 has it, fitted to measurements to 1 GPa. The inverse of the coefficient is the modulus without
    pressure; without a slope it is :func:`barus_viscosity`.
    """
    eta_0, p, alpha_p, B = viscosity, pressure, pressure_viscosity_coefficient, pressure_modulus_slope
    xp = namespace(eta_0, p, alpha_p, B)
    return eta_0 * xp.exp(p / (1 / alpha_p + B * p))


def secant_pressure_viscosity_coefficient(
    viscosity: Viscosity, viscosity_under_pressure: Viscosity, pressure: Pressure
) -> PressureCoefficient:
    r"""Pressure–viscosity coefficient of a law by its viscosity at a pressure.

    .. math:: \alpha = \frac{1}{p} \ln\left(\frac{\eta}{\eta_0}\right)

    That of :func:`barus_viscosity` with the same viscosity at this pressure; above zero pressure.
    """
    eta_0, eta, p = viscosity, viscosity_under_pressure, pressure
    xp = namespace(eta_0, eta, p)
    return xp.log(eta / eta_0) / p


def thermal_loading_parameter(
    viscosity: Viscosity,
    temperature_coefficient: TemperatureCoefficient,
    entrainment_speed: Speed,
    thermal_conductivity: Conductivity,
) -> Ratio:
    r"""Heat of the shear in the inlet against what the oil conducts away.

    .. math:: L = \frac{\beta \eta_0 v^2}{k_f}

    Gupta1992. Zero at rest.
    """
    eta_0, beta, v, k_f = viscosity, temperature_coefficient, entrainment_speed, thermal_conductivity
    return beta * eta_0 * v**2 / k_f
