r"""Hertz contact of two elastic bodies: an ellipse, its size, its pressure, the mutual approach.

With :math:`W = Q/(E' R_x^2)` every Hertz theory reads :math:`a = c_a R_x W^{1/3}`,
:math:`b = c_b R_x W^{1/3}`, :math:`\delta = c_\delta R_x W^{2/3}`, where the coefficients depend on
the radii ratio k alone. The paper's fits and the exact solution differ in the coefficients only.
"""

from __future__ import annotations

from typing import NamedTuple

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Length, Pressure, Ratio, Stiffness

#: Steps of the arithmetic–geometric mean: full double precision for 1e-4 < ellipticity < 1e4.
AGM_STEPS = 7
#: Newton steps on the logarithm of the ellipticity, from Hamrock and Brewe's power law: the last
#: one changes nothing for radii ratios up to 1e5.
NEWTON_STEPS = 4


def equivalent_modulus(
    first_young_modulus: Pressure,
    first_poisson_ratio: Ratio,
    second_young_modulus: Pressure,
    second_poisson_ratio: Ratio,
) -> Pressure:
    r"""Equivalent modulus of two bodies in contact.

    .. math:: E' = \frac{2}{\frac{1 - \nu_1^2}{E_1} + \frac{1 - \nu_2^2}{E_2}}

    The E of Olaru2005 §2.1; the paper prints no value (2.26e11 Pa for steel on steel).
    """
    E_1, nu_1, E_2, nu_2 = first_young_modulus, first_poisson_ratio, second_young_modulus, second_poisson_ratio
    return 2 / ((1 - nu_1**2) / E_1 + (1 - nu_2**2) / E_2)


def semi_major_axis_coefficient_houpert(radii_ratio: Ratio) -> Ratio:
    r"""Coefficient of the semi-axis across the rolling direction, power-law fit.

    .. math:: c_a = 1.1552 k^{0.4676}

    Olaru2005 §2.2 (18), where :math:`a = c_a R_x W^{1/3}`. Against the exact solution the fit is
    0.9 % high at k = 1, 4.7 % at 20, 8.3 % at 36, 12 % at 60.
    """
    k = radii_ratio
    return 1.1552 * k**0.4676


def semi_minor_axis_coefficient_houpert(radii_ratio: Ratio) -> Ratio:
    r"""Coefficient of the semi-axis along the rolling direction, power-law fit.

    .. math:: c_b = 1.1502 k^{-0.1876}

    Olaru2005 §2.2 (19), where :math:`b = c_b R_x W^{1/3}`. Against the exact solution the fit is
    within 0.7 % for 1 ≤ k ≤ 10, 2.1 % high at 36, 2.5 % at 60.
    """
    k = radii_ratio
    return 1.1502 * k ** (-0.1876)


class EllipticIntegrals(NamedTuple):
    """Complete elliptic integrals of an ellipse with modulus m = 1 - 1/κ²."""

    K: Ratio
    E: Ratio
    B: Ratio
    D: Ratio
    C: Ratio


def elliptic_integrals(ellipticity: Ratio) -> EllipticIntegrals:
    r"""Complete elliptic integrals by the arithmetic–geometric mean, a fixed number of steps.

    :math:`K`, :math:`E`, :math:`D = (K-E)/m`, :math:`B = K-D`, :math:`C = (D-B)/m` with
    :math:`m = 1 - 1/\kappa^2`. D, B and C are summed directly, so that nothing cancels at
    κ = 1. Valid for 1e-4 < κ < 1e4 (below 1 the ellipse lies along the rolling direction).

    AbramowitzStegun1964 §17.6; the forms B, C, D after Bulirsch1965.
    """
    kappa = ellipticity
    xp = namespace(kappa)
    m = 1 - 1 / kappa**2
    a, g = (1 + 1 / kappa) / 2, 1 / xp.sqrt(kappa)
    # c_n and d_n = c_n/m of the recurrence; c_1 = m d_1 with d_1 regular at kappa = 1
    d = 1 / (2 * (1 + 1 / kappa))
    series, weight = 2 * d**2, 2
    for _ in range(AGM_STEPS - 1):
        d = m * d**2 / (2 * (a + g))
        a, g = (a + g) / 2, xp.sqrt(a * g)
        weight = 2 * weight
        series = series + weight * d**2
    K = xp.pi / (2 * a)
    C = K * series
    D = (K + m * C) / 2
    return EllipticIntegrals(K=K, E=K - m * D, B=(K - m * C) / 2, D=D, C=C)


def ellipticity(radii_ratio: Ratio) -> Ratio:
    r"""Exact ratio of the semi-axes a/b of a Hertz contact, by a fixed number of Newton steps.

    Solves :math:`k = \kappa^2 B/D` on :math:`\ln\kappa`, starting from :math:`k^{2/\pi}`, where the
    slope is :math:`1 + C/(\kappa^2 B) + C/D`. Full double precision for 1e-5 < k < 1e5.

    Johnson1985 §4.2; start after BreweHamrock1977.
    """
    k = radii_ratio
    xp = namespace(k)
    log_kappa = 2 / xp.pi * xp.log(k)
    for _ in range(NEWTON_STEPS):
        kappa = xp.exp(log_kappa)
        _, _, B, D, C = elliptic_integrals(kappa)
        slope = 1 + C / (kappa**2 * B) + C / D
        log_kappa = log_kappa - (xp.log(kappa**2 * B / D) - xp.log(k)) / slope
    return xp.exp(log_kappa)


def ellipticity_brewe_hamrock(radii_ratio: Ratio) -> Ratio:
    r"""Ratio of the semi-axes a/b of a Hertz contact, power law.

    .. math:: \kappa = k^{2/\pi}

    BreweHamrock1977. For 1 ≤ k ≤ 100: exact at k = 1, 3.7 % low at 10, 1.2 % at 36, 3.2 % high at
    100. The semi-axes that follow are within 2.6 %, at k = 36 within 0.9 %.
    """
    k = radii_ratio
    xp = namespace(k)
    return k ** (2 / xp.pi)


def second_integral_brewe_hamrock(radii_ratio: Ratio) -> Ratio:
    r"""Complete elliptic integral of the second kind, without solving for the ellipticity.

    .. math:: E = 1 + \frac{\frac{\pi}{2} - 1}{k}

    BreweHamrock1977. For 1 ≤ k ≤ 100: within 1 % there.
    """
    k = radii_ratio
    xp = namespace(k)
    return 1 + (xp.pi / 2 - 1) / k


def semi_major_axis_coefficient(radii_ratio: Ratio, ellipticity: Ratio, second_integral: Ratio) -> Ratio:
    r"""Coefficient of the semi-axis across the rolling direction, exact.

    .. math:: c_a = \left(\frac{6 \kappa^2 E k}{\pi (1 + k)}\right)^{1/3}

    Johnson1985 §4.2. E is the complete elliptic integral of the second kind.
    """
    k, kappa, E = radii_ratio, ellipticity, second_integral
    xp = namespace(k, kappa, E)
    return (6 * kappa**2 * E * k / (xp.pi * (1 + k))) ** (1 / 3)


def approach_coefficient(
    radii_ratio: Ratio, ellipticity: Ratio, first_integral: Ratio, second_integral: Ratio
) -> Ratio:
    r"""Coefficient of the mutual approach of the two bodies, exact.

    .. math:: c_d = K \left(\frac{9 (1 + k)}{2 \pi^2 \kappa^2 E k}\right)^{1/3}

    Johnson1985 §4.2. K and E are the complete elliptic integrals.
    """
    k, kappa, K, E = radii_ratio, ellipticity, first_integral, second_integral
    xp = namespace(k, kappa, K, E)
    return K * (9 * (1 + k) / (2 * xp.pi**2 * kappa**2 * E * k)) ** (1 / 3)


def semi_axis(axis_coefficient: Ratio, rolling_radius: Length, load_parameter: Ratio) -> Length:
    r"""Semi-axis of the contact ellipse.

    .. math:: a = c_a R_x W^{1/3}

    Olaru2005 §2.2, the common form of (18) and (19). Zero at zero load.
    """
    c_a, R_x, W = axis_coefficient, rolling_radius, load_parameter
    return c_a * R_x * W ** (1 / 3)


def maximum_pressure(
    major_coefficient: Ratio, minor_coefficient: Ratio, equivalent_modulus: Pressure, load_parameter: Ratio
) -> Pressure:
    r"""Pressure at the centre of the ellipse, 3Q/(2πab) written without dividing by the load.

    .. math:: p_0 = \frac{3 E' W^{1/3}}{2 \pi c_a c_b}

    Johnson1985 §4.2. Zero at zero load.
    """
    c_a, c_b, E, W = major_coefficient, minor_coefficient, equivalent_modulus, load_parameter
    xp = namespace(c_a, c_b, E, W)
    return 3 * E * W ** (1 / 3) / (2 * xp.pi * c_a * c_b)


def mutual_approach(approach_coefficient: Ratio, rolling_radius: Length, load_parameter: Ratio) -> Length:
    r"""Approach of two distant points of the bodies.

    .. math:: \delta = c_d R_x W^{2/3}

    Johnson1985 §4.2. Zero at zero load.
    """
    c_d, R_x, W = approach_coefficient, rolling_radius, load_parameter
    return c_d * R_x * W ** (2 / 3)


def contact_stiffness(
    approach_coefficient: Ratio, equivalent_modulus: Pressure, rolling_radius: Length, load_parameter: Ratio
) -> Stiffness:
    r"""Stiffness of the contact, 3Q/(2δ) written without dividing by the approach.

    .. math:: K_c = \frac{3 E' R_x W^{1/3}}{2 c_d}

    The derivative of the load by :func:`mutual_approach`; Johnson1985 §4.2. Zero at zero load.
    """
    c_d, E, R_x, W = approach_coefficient, equivalent_modulus, rolling_radius, load_parameter
    return 3 * E * R_x * W ** (1 / 3) / (2 * c_d)


def mean_pressure(maximum_pressure: Pressure) -> Pressure:
    r"""Load over area of the contact ellipse.

    .. math:: p_m = \frac{2 p_0}{3}

    Johnson1985 §4.2.
    """
    p_0 = maximum_pressure
    return 2 * p_0 / 3


def hertz_pressure(maximum_pressure: Pressure, across: Ratio, along: Ratio) -> Pressure:
    r"""Pressure at a point of the ellipse, given by its distances in units of the semi-axes.

    .. math:: p = p_0 \sqrt{1 - t^2 - s^2}

    Johnson1985 §3.5. Inside the ellipse only.
    """
    p_0, t, s = maximum_pressure, across, along
    xp = namespace(p_0, t, s)
    return p_0 * xp.sqrt(1 - t**2 - s**2)
