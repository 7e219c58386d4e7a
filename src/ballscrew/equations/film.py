"""Film thickness between ball and race, and what it means against the roughness."""

from __future__ import annotations

from ballscrew._arrays import namespace
from ballscrew.quantities import InverseLength, Length, Ratio


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
