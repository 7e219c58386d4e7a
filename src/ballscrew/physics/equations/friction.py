"""Sliding in the contact ellipse: the coefficient of friction, and the moments it leads to.

Friction of the film itself: how much shear an oil bears under the pressure of the contact.

Film and asperities together: who carries how much of the load, and the friction that follows.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    ArealDensity,
    Force,
    Length,
    Pressure,
    PressureCoefficient,
    Ratio,
    ShearRate,
    Speed,
    Torque,
    Viscosity,
)


def asperity_friction_coefficient(
    film_parameter: Ratio, boundary_friction_coefficient: Ratio, decay: Ratio, exponent: Ratio
) -> Ratio:
    r"""Friction of the asperities that still touch through the film.

    .. math:: \mu_a = \mu_0 \exp\left(-B \lambda^C\right)

    Olaru2005 §5 (23), after ZhouHoeprich1991, where the exponential is the share of the load that
    asperities carry. B and C belong to the surfaces.
    """
    lam, mu_0, B, C = film_parameter, boundary_friction_coefficient, decay, exponent
    xp = namespace(lam, mu_0, B, C)
    return mu_0 * xp.exp(-B * lam**C)


def clamped_friction_coefficient(
    asperity_friction_coefficient: Ratio,
    boundary_friction_coefficient: Ratio,
    full_film_friction_coefficient: Ratio,
) -> Ratio:
    r"""Friction coefficient of the contact: the asperities' share, held between two limits.

    .. math:: \mu_m = \min\left(\max\left(\mu_a, \mu_f\right), \mu_0\right)

    The three branches Olaru2005 §5 (24), Olaru2005 §5 (25) and Olaru2005 §5 (26), with 0.02 for
    :math:`\mu_f`. The first branch is never reached but at rest. Continuous, with a kink where the
    asperities' share meets the full-film value.
    """
    mu_a, mu_0, mu_f = asperity_friction_coefficient, boundary_friction_coefficient, full_film_friction_coefficient
    xp = namespace(mu_a, mu_0, mu_f)
    return xp.minimum(xp.maximum(mu_a, mu_f), mu_0)


def curvature_friction_moment(
    friction_coefficient: Ratio,
    contact_load: Force,
    semi_major_axis: Length,
    deformed_radius: Length,
    pure_rolling_offset: Ratio,
) -> Torque:
    r"""Moment about the ball of the friction that the curvature of the contact causes.

    .. math:: M_C = 0.1 \mu_m \frac{Q a^2}{R_d} (1 - 5 Y^3 + 3 Y^5)

    Olaru2005 §2.2 (15): the integral of friction times pressure times height over the ellipse,
    Olaru2005 §2.2 (14), for Hertz pressure, constant friction and sliding that changes sign at
    :math:`y = \pm Y a`. Exact without spin; positive for 0 ≤ Y < 0.643.
    """
    mu_m, Q, a = friction_coefficient, contact_load, semi_major_axis
    R_d, Y = deformed_radius, pure_rolling_offset
    return 0.1 * mu_m * Q * a**2 / R_d * (1 - 5 * Y**3 + 3 * Y**5)


def pure_rolling_offset(pure_rolling_distance: Length, semi_major_axis: Length) -> Ratio:
    r"""Distance of the lines of pure rolling from the centre, in units of the semi-major axis.

    .. math:: Y = \frac{c}{a}

    Olaru2005 §2.2 (17). The paper imposes 0.34.
    """
    c, a = pure_rolling_distance, semi_major_axis
    return c / a


def traction_ratio(pure_rolling_offset: Ratio) -> Ratio:
    r"""Net sliding force as a share of its greatest possible value, without spin.

    .. math:: T = 1 - 3 Y + Y^3

    Follows from the same integral as :func:`curvature_friction_moment`; zero at
    Y = 2 sin 10° = 0.347296.
    """
    Y = pure_rolling_offset
    return 1 - 3 * Y + Y**3


def offset_from_traction(traction_ratio: Ratio) -> Ratio:
    r"""Offset of the lines of pure rolling that carries a given net sliding force.

    .. math:: Y = 2 \sin\left(\frac{1}{3} \arcsin\left(\frac{1 - T}{2}\right)\right)

    Inverse of :func:`traction_ratio` for -1 ≤ T ≤ 1: one line of pure rolling at the centre for
    T = 1 (the ball is about to skid), both at the rim for T = -1.
    """
    T = traction_ratio
    xp = namespace(T)
    return 2 * xp.sin(xp.arcsin((1 - T) / 2) / 3)


def ball_friction_moment(ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length) -> Torque:
    r"""Braking moment of one neighbouring ball.

    .. math:: M_B = \mu_b F_B \frac{d_w}{2}

    Olaru2005 §2.2 (21). A ball in a chain touches two neighbours.
    """
    mu_b, F_B, d_w = ball_friction_coefficient, ball_to_ball_force, ball_diameter
    return mu_b * F_B * d_w / 2


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


def asperity_load_share_zhou_hoeprich(film_parameter: Ratio, decay: Ratio, exponent: Ratio) -> Ratio:
    r"""Share of the load that asperities carry, exponential.

    .. math:: w = \exp\left(-B \lambda^C\right)

    ZhouHoeprich1991. B and C belong to the surfaces. One at rest, zero in thick films.
    """
    lam, B, C = film_parameter, decay, exponent
    xp = namespace(lam, B, C)
    return xp.exp(-B * lam**C)


def run_in_film_parameter(film_parameter: Ratio, worn_film_parameter: Ratio, lost_film_parameter: Ratio) -> Ratio:
    r"""Film parameter of surfaces that have run in.

    .. math:: \lambda_e = \left(\lambda^4 + \lambda_r^4\right)^{1/4} \frac{\lambda}{\lambda + \lambda_0}

    A closure of this package, not a published law: asperities wear until the film parameter is λ_r, and no
    further; where next to no film is left, λ ≪ λ_0, the worn surfaces touch as any others. λ for thick films, about λ_r
    for thin ones, zero at rest; it never falls with λ. For a finite λ.
    """
    lam, lam_r, lam_0 = film_parameter, worn_film_parameter, lost_film_parameter
    return (lam**4 + lam_r**4) ** 0.25 * lam / (lam + lam_0)


def asperity_load_share_balan(film_parameter: Ratio) -> Ratio:
    r"""Share of the load that asperities carry, a fraction of powers.

    .. math:: w = \max\left(0, \min\left(1 - \frac{1.21 \lambda^{0.64}}{1 + 0.37 \lambda^{1.26}},
        2 - \lambda\right)\right)

    Balan2015 (A2). As printed it is 2.9e-4 at λ = 2, negative from 2.013 to 2.533, and grows again
    beyond; here it is zero from λ = 2 on, without a step, and as printed up to 1.9996.
    """
    lam = film_parameter
    xp = namespace(lam)
    return xp.maximum(0, xp.minimum(1 - 1.21 * lam**0.64 / (1 + 0.37 * lam**1.26), 2 - lam))


def asperity_contact_integral(film_parameter: Ratio) -> Ratio:
    r"""Mean overlap of two rough surfaces with Gaussian heights, to the power 5/2.

    .. math:: F_{5/2} = 4.4068 \cdot 10^{-5} \max\left(0, 4 - \lambda\right)^{6.804}

    Hu1994, a fit of the integral of GreenwoodTripp1970: 11 % low at λ = 0, 2 % at 1.5, 9 % at 2;
    beyond it falls too fast, 35 % low at 2.5 and 74 % at 3. Zero from λ = 4 on.
    """
    lam = film_parameter
    xp = namespace(lam)
    return 4.4068e-5 * xp.maximum(0, 4 - lam) ** 6.804


def asperity_pressure(
    asperity_contact_integral: Ratio,
    equivalent_modulus: Pressure,
    asperity_density: ArealDensity,
    asperity_radius: Length,
    combined_roughness: Length,
) -> Pressure:
    r"""Mean pressure between the asperities of two rough surfaces, elastic.

    .. math:: p_a = \frac{8 \sqrt{2} \pi}{15} \left(N \beta \sigma\right)^2 \sqrt{\frac{\sigma}{\beta}} E' F

    GreenwoodTripp1970, whose modulus is half the equivalent modulus of this package, hence 8 for
    their 16. Steel surfaces: Nβσ of 0.03 to 0.05, σ/β of 1e-4 to 1e-2.
    """
    F, E, N = asperity_contact_integral, equivalent_modulus, asperity_density
    beta, sigma = asperity_radius, combined_roughness
    xp = namespace(F, E, N, beta, sigma)
    return 8 * 2**0.5 * xp.pi / 15 * (N * beta * sigma) ** 2 * (sigma / beta) ** 0.5 * E * F


def asperity_load_share_greenwood_tripp(asperity_pressure: Pressure, mean_pressure: Pressure) -> Ratio:
    r"""Share of the load that asperities carry when they press with a given mean pressure.

    .. math:: w = \frac{p_a}{\max\left(p_a, p_m\right)}

    JohnsonGreenwoodPoon1972: the film takes the rest. At most one; one without load, and undefined
    only where neither load nor asperities are left.
    """
    p_a, p_m = asperity_pressure, mean_pressure
    xp = namespace(p_a, p_m)
    return p_a / xp.maximum(p_a, p_m)


def load_sharing_friction_coefficient(
    asperity_load_share: Ratio, boundary_friction_coefficient: Ratio, full_film_friction_coefficient: Ratio
) -> Ratio:
    r"""Friction coefficient when asperities and film carry the load between them.

    .. math:: \mu_m = \mu_0 w + \mu_f (1 - w)

    Balan2015 (A1), after ZhouHoeprich1991. Smooth, unlike the clamp of the paper.
    """
    w, mu_0, mu_f = asperity_load_share, boundary_friction_coefficient, full_film_friction_coefficient
    return mu_0 * w + mu_f * (1 - w)
