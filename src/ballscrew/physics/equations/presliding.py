"""Contacts that stick: how stiffly they hold before they slide."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Length, Pressure, Ratio, RotationalStiffness, Stiffness


def shear_modulus(young_modulus: Pressure, poisson_ratio: Ratio) -> Pressure:
    r"""Shear modulus of an isotropic body.

    .. math:: G = \frac{E}{2 (1 + \nu)}
    """
    E, nu = young_modulus, poisson_ratio
    return E / (2 * (1 + nu))


def tangential_stiffness(
    contact_radius: Length,
    ball_shear_modulus: Pressure,
    ball_poisson_ratio: Ratio,
    race_shear_modulus: Pressure,
    race_poisson_ratio: Ratio,
) -> Stiffness:
    r"""Tangential stiffness of a round contact that sticks all over.

    .. math:: k_t = \frac{8 a}{\frac{2 - \nu_b}{G_b} + \frac{2 - \nu_r}{G_r}}

    Mindlin1949. An ellipse is taken as the circle of its area; its own stiffness depends on the direction.
    """
    a, G_b, nu_b, G_r, nu_r = (
        contact_radius, ball_shear_modulus, ball_poisson_ratio, race_shear_modulus, race_poisson_ratio,
    )  # fmt: skip
    return 8 * a / ((2 - nu_b) / G_b + (2 - nu_r) / G_r)


def torsional_stiffness(
    contact_radius: Length, ball_shear_modulus: Pressure, race_shear_modulus: Pressure
) -> RotationalStiffness:
    r"""Stiffness of a round contact against spin, sticking all over.

    .. math:: k_s = \frac{16 a^3}{3 \left(\frac{1}{G_b} + \frac{1}{G_r}\right)}

    Mindlin1949. An ellipse is taken as the circle of its area.
    """
    a, G_b, G_r = contact_radius, ball_shear_modulus, race_shear_modulus
    return 16 * a**3 / (3 * (1 / G_b + 1 / G_r))


def sticking_stiffness(
    tangential_stiffness: Stiffness,
    torsional_stiffness: RotationalStiffness,
    ball_diameter: Length,
    lead_angle: Angle,
    rolling_plane_sine: Ratio,
) -> RotationalStiffness:
    r"""Stiffness that a ball with sticking contacts has against rotation of the screw.

    .. math:: k_\theta = k_t \left(\frac{d_w}{2} \sin\varphi\right)^2 + k_s s_\alpha^2

    The stiffnesses are those of both contacts in series. For each radian of the screw a ball that rolls is taken
    :math:`(d_w / 2) \sin\varphi` across its path and spun by :math:`s_\alpha` between the races; what later slips is
    elastic work first. The differential slip of the curved contact is left out.
    """
    k_t, k_s, d_w, phi, s_alpha = (
        tangential_stiffness, torsional_stiffness, ball_diameter, lead_angle, rolling_plane_sine,
    )  # fmt: skip
    xp = namespace(k_t, k_s, d_w, phi, s_alpha)
    return k_t * (d_w / 2 * xp.sin(phi)) ** 2 + k_s * s_alpha**2
