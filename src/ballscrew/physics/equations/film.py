"""Film thickness between ball and race, and what it means against the roughness."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import InverseLength, Length, Pressure, Ratio, Speed


def minimum_film_thickness(
    rolling_radius: Length,
    speed_parameter: Ratio,
    material_parameter: Ratio,
    load_parameter: Ratio,
    ellipticity: Ratio,
    speed_exponent: Ratio,
) -> Length:
    r"""Minimum film thickness of a fully flooded, isothermal, piezoviscous-elastic contact.

    .. math:: h = 3.63 R_x U^m G^{0.49} W^{-0.073} (1 - \exp(-0.68\kappa))

    Olaru2005 §4 (26), printed with m = 0.66. HamrockDowson1977 has m = 0.68: the misprint makes
    films 1.55 to 1.70 times too thick. Zero at rest; grows without limit as the load vanishes,
    where the contact is no longer elastic and the law does not hold.
    """
    R_x, U, G, W = rolling_radius, speed_parameter, material_parameter, load_parameter
    kappa, m = ellipticity, speed_exponent
    xp = namespace(R_x, U, G, W, kappa, m)
    return 3.63 * R_x * U**m * G**0.49 * W ** (-0.073) * (1 - xp.exp(-0.68 * kappa))


def central_film_thickness(
    rolling_radius: Length,
    speed_parameter: Ratio,
    material_parameter: Ratio,
    load_parameter: Ratio,
    ellipticity: Ratio,
) -> Length:
    r"""Film thickness in the middle of a fully flooded, isothermal, piezoviscous-elastic contact.

    .. math:: h_c = 2.69 R_x U^{0.67} G^{0.53} W^{-0.067} (1 - 0.61 \exp(-0.73\kappa))

    HamrockDowson1977. Zero at rest; grows without limit as the load vanishes, where the contact is
    no longer elastic and the law does not hold.
    """
    R_x, U, G, W = rolling_radius, speed_parameter, material_parameter, load_parameter
    kappa = ellipticity
    xp = namespace(R_x, U, G, W, kappa)
    return 2.69 * R_x * U**0.67 * G**0.53 * W ** (-0.067) * (1 - 0.61 * xp.exp(-0.73 * kappa))


def minimum_film_thickness_chittenden(
    rolling_radius: Length,
    speed_parameter: Ratio,
    material_parameter: Ratio,
    load_parameter: Ratio,
    radii_ratio: Ratio,
) -> Length:
    r"""Minimum film thickness of a fully flooded, isothermal, piezoviscous-elastic contact, from its radii alone.

    .. math:: h = 3.68 R_x U^{0.68} G^{0.49} W^{-0.073} (1 - \exp(-0.67 k^{2/3}))

    Chittenden1985, for entrainment along a principal axis of the ellipse: k is the equivalent radius across the
    entrainment over that along it. A ball in a groove is entrained along the minor axis of its ellipse, so k = R_y/R_x
    is above one, and U and W are counted in R_x, as those of HamrockDowson1977. Zero at rest; grows without limit as
    the load vanishes, where the law does not hold.
    """
    R_x, U, G, W, k = rolling_radius, speed_parameter, material_parameter, load_parameter, radii_ratio
    xp = namespace(R_x, U, G, W, k)
    return 3.68 * R_x * U**0.68 * G**0.49 * W ** (-0.073) * (1 - xp.exp(-0.67 * k ** (2 / 3)))


def slide_to_roll_ratio(sliding_speed: Speed, entrainment_speed: Speed) -> Ratio:
    r"""Sliding speed in units of the mean speed of the two surfaces.

    .. math:: S = \frac{u_s}{v}

    Undefined at rest.
    """
    u_s, v = sliding_speed, entrainment_speed
    return u_s / v


def inlet_heating_factor(
    maximum_pressure: Pressure,
    equivalent_modulus: Pressure,
    thermal_loading_parameter: Ratio,
    slide_to_roll_ratio: Ratio,
) -> Ratio:
    r"""Reduction factor of the film by shear heating in the inlet.

    .. math:: \phi_T = \frac{\max\left(0, 1 - 13.2 \frac{p_0}{E'} L^{0.42}\right)}
        {1 + 0.213 (1 + 2.23 S^{0.83}) L^{0.64}}

    Gupta1992. Sliding counts without its sign. One at rest. Its numerator would turn negative at
    high pressure and L (at 1.7 GPa on steel from L = 245 on), where it no longer holds: zero there.
    """
    p_0, E, L, S = maximum_pressure, equivalent_modulus, thermal_loading_parameter, slide_to_roll_ratio
    xp = namespace(p_0, E, L, S)
    return xp.maximum(0, 1 - 13.2 * p_0 / E * L**0.42) / (1 + 0.213 * (1 + 2.23 * S**0.83) * L**0.64)


def film_parameter(minimum_film_thickness: Length, ball_roughness: Length, race_roughness: Length) -> Ratio:
    r"""Film thickness in units of the combined roughness of the two surfaces.

    .. math:: \lambda = \frac{h}{\sqrt{\sigma_b^2 + \sigma_R^2}}

    Olaru2005 §4 (22), with the square root that the print lost.
    """
    h, sigma_b, sigma_R = minimum_film_thickness, ball_roughness, race_roughness
    xp = namespace(h, sigma_b, sigma_R)
    return h / xp.sqrt(sigma_b**2 + sigma_R**2)


def literal_film_parameter(
    minimum_film_thickness: Length, ball_roughness: Length, race_roughness: Length
) -> InverseLength:
    r"""The film parameter as the paper prints it: no square root, and so a unit of 1/m.

    .. math:: \lambda = \frac{h}{\sigma_b^2 + \sigma_R^2}

    Olaru2005 §4 (22), to the letter. In SI it is of the order of a million, every contact counts as
    fully lubricated, and the torque is some 20 % low.
    """
    h, sigma_b, sigma_R = minimum_film_thickness, ball_roughness, race_roughness
    return h / (sigma_b**2 + sigma_R**2)


def combined_roughness(ball_roughness: Length, race_roughness: Length) -> Length:
    r"""Roughness of the gap between two rough surfaces.

    .. math:: \sigma = \sqrt{\sigma_b^2 + \sigma_R^2}

    The denominator of :func:`film_parameter`, Olaru2005 §4 (22).
    """
    sigma_b, sigma_R = ball_roughness, race_roughness
    xp = namespace(sigma_b, sigma_R)
    return xp.sqrt(sigma_b**2 + sigma_R**2)
