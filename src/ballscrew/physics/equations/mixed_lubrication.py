"""Film and asperities together: who carries how much of the load, and the friction that follows."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import ArealDensity, Length, Pressure, Ratio


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
