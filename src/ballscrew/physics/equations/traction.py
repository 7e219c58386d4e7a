"""Friction of the film itself: how much shear an oil bears under the pressure of the contact."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Length, Pressure, PressureCoefficient, Ratio, ShearRate, Speed, Viscosity


def film_shear_rate(sliding_speed: Speed, central_film_thickness: Length) -> ShearRate:
    r"""Shear rate across the film, linear from one surface to the other.

    .. math:: \Gamma = \frac{u_s}{h_c}

    Grows without limit as the film vanishes; the laws below stay finite but Eyring's.
    """
    u_s, h_c = sliding_speed, central_film_thickness
    return u_s / h_c


def limiting_shear_stress(pressure: Pressure, limiting_shear_coefficient: Ratio) -> Pressure:
    r"""The greatest shear stress an oil bears under pressure.

    .. math:: \tau_L = \Lambda p

    BairWiner1979. Oils have 0.035 (PAO) to 0.053 (naphthenic), the ether 5P4E 0.088 (Arana2019), at Hertz pressures.
    """
    p, Lambda = pressure, limiting_shear_coefficient
    return Lambda * p


def arana_eyring_stress(
    limiting_shear_coefficient: Ratio, pressure_viscosity_coefficient: PressureCoefficient
) -> Pressure:
    r"""Eyring stress of an oil by its limit of shear.

    .. math:: \tau_E = \frac{2 \Lambda}{\alpha}

    Arana2019, with the coefficient at the greatest pressure of the contact, as
    :func:`~ballscrew.physics.equations.rheology.secant_pressure_viscosity_coefficient` has it: 5.8 MPa and 6.6 MPa for
    a paraffinic oil of ISO VG 100 at 25 °C and 40 °C and 1.2 GPa.
    """
    Lambda, alpha = limiting_shear_coefficient, pressure_viscosity_coefficient
    return 2 * Lambda / alpha


def eyring_shear_stress(film_viscosity: Viscosity, film_shear_rate: ShearRate, eyring_stress: Pressure) -> Pressure:
    r"""Shear stress of an oil that thins with the rate of shear.

    .. math:: \tau = \tau_E \sinh^{-1}\left(\frac{\eta \Gamma}{\tau_E}\right)

    Eyring1936; JohnsonTevaarwerk1977 for films. The viscosity is that under the pressure of the
    contact. Newtonian at low rates; odd in the rate. Mineral oils have an Eyring stress of 2 to 10 MPa.
    Without a limit: compare :func:`limiting_shear_stress`.
    """
    eta, Gamma, tau_E = film_viscosity, film_shear_rate, eyring_stress
    xp = namespace(eta, Gamma, tau_E)
    return tau_E * xp.arcsinh(eta * Gamma / tau_E)


def bair_winer_shear_stress(
    film_viscosity: Viscosity, film_shear_rate: ShearRate, limiting_shear_stress: Pressure
) -> Pressure:
    r"""Shear stress of an oil that yields at a limit, steady flow.

    .. math:: \tau = \tau_L \left(1 - \exp\left(-\frac{\eta \Gamma}{\tau_L}\right)\right)

    BairWiner1979, without the elastic part. The viscosity is that under the pressure of the contact.
    For rates without a sign and limits above zero.
    """
    eta, Gamma, tau_L = film_viscosity, film_shear_rate, limiting_shear_stress
    xp = namespace(eta, Gamma, tau_L)
    return -tau_L * xp.expm1(-eta * Gamma / tau_L)


def film_friction_coefficient(film_shear_stress: Pressure, mean_pressure: Pressure) -> Ratio:
    r"""Friction coefficient of a full film from the means of stress and pressure.

    .. math:: \mu_f = \frac{\tau}{p_m}

    JohnsonTevaarwerk1977. A mean-value estimate: with shear that varies over the ellipse it is
    rough. Undefined without load.
    """
    tau, p_m = film_shear_stress, mean_pressure
    return tau / p_m
