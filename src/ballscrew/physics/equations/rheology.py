"""The lubricant: viscosity, and the dimensionless groups of elastohydrodynamic lubrication.

The viscosity of an oil over temperature by Vogel and by Walther, its viscosity index, its density.
"""

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


def vogel_temperature_coefficient(
    temperature: Temperature, vogel_constant: TemperatureDifference, vogel_temperature: Temperature
) -> TemperatureCoefficient:
    r"""Relative fall of the viscosity per kelvin, by Vogel's law.

    .. math:: \beta = \frac{B}{(T - T_0)^2}

    The slope of :func:`kinematic_viscosity_vogel`, Vogel1921; the density's own slope is left out.
    """
    T, B, T_0 = temperature, vogel_constant, vogel_temperature
    return B / (T - T_0) ** 2


def walther_number(kinematic_viscosity: KinematicViscosity) -> Ratio:
    r"""Number whose doubled logarithm is a straight line over the logarithm of the temperature.

    .. math:: Z = 10^6 \nu + 0.7 + \exp\left(-1.47 - 1.84 \cdot 10^6 \nu - 0.51 \left(10^6 \nu\right)^2\right)

    ASTMD341, the full form, for 0.21 mm²/s and more. SI only: the standard has the viscosity in mm²/s. The exponential
    is 0.03 % of Z at 2 mm²/s, 0.2 % at 1.5 mm²/s and 1.3 % at 1 mm²/s; above 2 mm²/s the standard leaves it out.
    """
    nu = kinematic_viscosity
    xp = namespace(nu)
    return 1e6 * nu + 0.7 + xp.exp(-1.47 - 1.84e6 * nu - 0.51 * (1e6 * nu) ** 2)


def walther_slope(
    low_temperature: Temperature, low_number: Ratio, high_temperature: Temperature, high_number: Ratio
) -> Ratio:
    r"""Slope of the line through two points.

    .. math:: B = \frac{\ln\left(\frac{\ln Z_1}{\ln Z_2}\right)}{\ln\left(T_2 / T_1\right)}

    ASTMD341. The numbers are those of :func:`walther_number`; 3 to 4 for mineral oils.
    """
    T_1, Z_1, T_2, Z_2 = low_temperature, low_number, high_temperature, high_number
    xp = namespace(T_1, Z_1, T_2, Z_2)
    return xp.log(xp.log(Z_1) / xp.log(Z_2)) / xp.log(T_2 / T_1)


def walther_number_at(
    temperature: Temperature, low_temperature: Temperature, low_number: Ratio, walther_slope: Ratio
) -> Ratio:
    r"""Number at another temperature: the line :math:`\log\log Z = A - B \log T` through a point.

    .. math:: Z = \exp\left(\ln Z_1 \exp\left(B \ln\left(T_1 / T\right)\right)\right)

    ASTMD341. For a homogeneous liquid, that is between cloud point and initial boiling point.
    """
    T, T_1, Z_1, B = temperature, low_temperature, low_number, walther_slope
    xp = namespace(T, T_1, Z_1, B)
    return xp.exp(xp.log(Z_1) * xp.exp(B * xp.log(T_1 / T)))


def kinematic_viscosity_of_walther_number(walther_number: Ratio) -> KinematicViscosity:
    r"""Kinematic viscosity of a number: the inverse of :func:`walther_number` as the standard approximates it.

    .. math:: \nu = 10^{-6} \left(Z - 0.7 - \exp\left(-0.7487 - 3.295 \left(Z - 0.7\right)
        + 0.6119 \left(Z - 0.7\right)^2 - 0.3193 \left(Z - 0.7\right)^3\right)\right)

    ASTMD341. SI only. Within 0.03 % of the inverse at 1 to 2 mm²/s and exact above 5 mm²/s;
    :func:`refined_kinematic_viscosity` removes the rest.
    """
    Z = walther_number
    xp = namespace(Z)
    return 1e-6 * (Z - 0.7 - xp.exp(-0.7487 - 3.295 * (Z - 0.7) + 0.6119 * (Z - 0.7) ** 2 - 0.3193 * (Z - 0.7) ** 3))


def walther_number_slope(kinematic_viscosity: KinematicViscosity) -> Ratio:
    r"""Growth of the number with the viscosity in mm²/s, the slope of :func:`walther_number`; 1 above 5 mm²/s.

    .. math:: D = 1 - \left(1.84 + 1.02 \cdot 10^6 \nu\right)
        \exp\left(-1.47 - 1.84 \cdot 10^6 \nu - 0.51 \left(10^6 \nu\right)^2\right)

    ASTMD341. SI only.
    """
    nu = kinematic_viscosity
    xp = namespace(nu)
    return 1 - (1.84 + 1.02e6 * nu) * xp.exp(-1.47 - 1.84e6 * nu - 0.51 * (1e6 * nu) ** 2)


def refined_kinematic_viscosity(
    estimate: KinematicViscosity, wanted_number: Ratio, estimated_number: Ratio, walther_number_slope: Ratio
) -> KinematicViscosity:
    r"""Kinematic viscosity of a number after one step of Newton from an estimate.

    .. math:: \nu = \nu_0 + 10^{-6} \frac{Z - Z_0}{D}

    Two steps from the estimate of the standard (:func:`kinematic_viscosity_of_walther_number`) invert
    :func:`walther_number` to the last digit from 0.3 mm²/s on. SI only.
    """
    nu_0, Z, Z_0, D = estimate, wanted_number, estimated_number, walther_number_slope
    return nu_0 + 1e-6 * (Z - Z_0) / D


def walther_temperature_coefficient(
    temperature: Temperature,
    kinematic_viscosity: KinematicViscosity,
    walther_number: Ratio,
    walther_slope: Ratio,
    walther_number_slope: Ratio,
) -> TemperatureCoefficient:
    r"""Relative fall of the viscosity per kelvin on the line of ASTMD341.

    .. math:: \beta = \frac{B Z \ln Z}{10^6 \nu T D}

    SI only. The slope of the line, with :math:`D` of :func:`walther_number_slope`; the density's own slope is left out.
    """
    T, nu, Z, B, D = temperature, kinematic_viscosity, walther_number, walther_slope, walther_number_slope
    xp = namespace(T, nu, Z, B, D)
    return B * Z * xp.log(Z) / (1e6 * nu * T * D)


def reference_viscosity(
    kinematic_viscosity_100: KinematicViscosity, quadratic: Ratio, linear: Ratio, constant: Ratio
) -> KinematicViscosity:
    r"""Kinematic viscosity at 40 °C of the reference oil that has the same one at 100 °C.

    .. math:: H = 10^{-6} \left(a \left(10^6 Y\right)^2 + b \cdot 10^6 Y + c\right)

    ASTMD2270. SI only: the standard has mm²/s. The three coefficients hold over a range of :math:`Y`
    (``data/viscosity_index.toml``), one set for the reference oils of index 0 (L) and one for those of index 100 (H).
    """
    Y, a, b, c = kinematic_viscosity_100, quadratic, linear, constant
    return 1e-6 * (a * (1e6 * Y) ** 2 + b * 1e6 * Y + c)


def viscosity_index_up_to_100(
    kinematic_viscosity_40: KinematicViscosity,
    viscosity_of_index_0: KinematicViscosity,
    viscosity_of_index_100: KinematicViscosity,
) -> Ratio:
    r"""Viscosity index, procedure A: for an index up to 100.

    .. math:: V = 100 \frac{L - U}{L - H}

    ASTMD2270 (ISO 2909). All viscosities at 40 °C. Of an oil with 2 mm²/s and more at 100 °C.
    """
    U, L, H = kinematic_viscosity_40, viscosity_of_index_0, viscosity_of_index_100
    return 100 * (L - U) / (L - H)


def viscosity_index_above_100(
    kinematic_viscosity_40: KinematicViscosity,
    kinematic_viscosity_100: KinematicViscosity,
    viscosity_of_index_100: KinematicViscosity,
) -> Ratio:
    r"""Viscosity index, procedure B: for an index of 100 and more.

    .. math:: V = 100 + \frac{10^{\ln\left(H / U\right) / \ln\left(10^6 Y\right)} - 1}{0.00715}

    ASTMD2270 (ISO 2909). SI only: a logarithm is that of the viscosity at 100 °C in mm²/s, which must be 2 and more.
    """
    U, Y, H = kinematic_viscosity_40, kinematic_viscosity_100, viscosity_of_index_100
    xp = namespace(U, Y, H)
    return 100 + (10 ** (xp.log(H / U) / xp.log(1e6 * Y)) - 1) / 0.00715


def oil_expansion_coefficient(density_15: Density) -> TemperatureCoefficient:
    r"""Thermal expansion of a mineral lubricating oil at 15 °C.

    .. math:: \alpha = \frac{0.6278}{\rho_{15}}

    ASTMD1250, the group of lubricating oils, 801 to 1164 kg/m³. SI only: the number is in kg/(m³ K).
    """
    rho_15 = density_15
    return 0.6278 / rho_15


def oil_density(
    density_15: Density,
    expansion_coefficient: TemperatureCoefficient,
    temperature: Temperature,
    reference_temperature: Temperature,
) -> Density:
    r"""Density of an oil at a temperature.

    .. math:: \rho = \rho_{15} \exp\left(-\alpha \left(T - T_{15}\right)
        \left(1 + 0.8 \alpha \left(T - T_{15}\right)\right)\right)

    ASTMD1250, at ambient pressure; the reference temperature is 288.15 K.
    """
    rho_15, alpha, T, T_15 = density_15, expansion_coefficient, temperature, reference_temperature
    xp = namespace(rho_15, alpha, T, T_15)
    return rho_15 * xp.exp(-alpha * (T - T_15) * (1 + 0.8 * alpha * (T - T_15)))
