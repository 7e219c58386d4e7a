"""Contacts that stick: how stiffly they hold before they slide."""

from __future__ import annotations

import math

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Angle,
    Compliance,
    Length,
    Pressure,
    Ratio,
    RotationalStiffness,
    Stiffness,
    StiffnessDensity,
)


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


def bristle_stiffness(
    half_width: Length, ball_shear_modulus: Pressure, race_shear_modulus: Pressure
) -> StiffnessDensity:
    r"""Stiffness for each area of a strip of bristles that gives way as the elastic strip does when it rolls.

    .. math:: k = \frac{\pi}{4 w} \frac{2}{1/G_b + 1/G_r}

    A strip of the half width w that rolls without slip under a creepage :math:`\xi` across its path carries
    :math:`(\pi/2) G w \xi` on each length, Carter's solution with the shear modulus in place of :math:`G/(1 - \nu)`;
    bristles carry :math:`2 k w^2 \xi`. Summed over the strips of a slender ellipse the force is :math:`(\pi^2/4) G a b
    \xi`, Kalker's for such a contact (Kalker1967).
    """
    w, G_b, G_r = half_width, ball_shear_modulus, race_shear_modulus
    return math.pi / (4 * w) * 2 / (1 / G_b + 1 / G_r)


def lateral_stiffness(
    tangential_stiffness: Stiffness, groove_compliance: Compliance, ball_diameter: Length, lead_angle: Angle
) -> RotationalStiffness:
    r"""Stiffness of a ball against rotation of the screw, by what holds it across its path.

    .. math:: k_L = \frac{k_t}{1 + k_t c_\eta} \left(\frac{d_w}{2} \sin\varphi\right)^2

    For each radian of the screw a ball that rolls is taken :math:`(d_w / 2) \sin\varphi` across its path. Its sticking
    contacts, both in series, give way, and long before that the ball rolls off the line of its grooves
    (:func:`~ballscrew.physics.equations.across_groove.groove_compliance`); on four contacts it cannot.
    """
    k_t, c_eta, d_w, phi = tangential_stiffness, groove_compliance, ball_diameter, lead_angle
    xp = namespace(k_t, c_eta, d_w, phi)
    return k_t / (1 + k_t * c_eta) * (d_w / 2 * xp.sin(phi)) ** 2


def spin_stiffness(torsional_stiffness: RotationalStiffness, rolling_plane_sine: Ratio) -> RotationalStiffness:
    r"""Stiffness of a ball against rotation of the screw, by the spin of its sticking contacts.

    .. math:: k_\theta = k_s s_\alpha^2

    The torsional stiffness is that of both contacts in series: for each radian of the screw they are spun by
    :math:`s_\alpha` between the races. The differential slip of the curved contact is left out.
    """
    k_s, s_alpha = torsional_stiffness, rolling_plane_sine
    return k_s * s_alpha**2
