r"""Contacts that stick: how stiffly they hold before they slide.

Friction with a state, as control engineering writes it: what the torque is after so much rotation.

The state is a deflection that winds up. Dahl and LuGre have one stiffness :math:`\sigma_0`, which wears off as the
torque comes near its limit; a Maxwell-slip element is a spring in series with a block that slides, and several of them
side by side have a stiffness for each range of the rotation.
"""

from __future__ import annotations

import math

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Angle,
    AngularSpeed,
    Compliance,
    Length,
    MomentOfInertia,
    Pressure,
    Ratio,
    RotationalDamping,
    RotationalStiffness,
    Stiffness,
    StiffnessDensity,
    Torque,
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


def dahl_torque(
    presliding_stiffness: RotationalStiffness, coulomb_torque: Torque, initial_torque: Torque, screw_angle: Angle
) -> Torque:
    r"""Torque of the model of Dahl after a rotation in one direction.

    .. math:: M = M_c - (M_c - M_0) \exp\left(-\frac{\sigma_0 \theta}{M_c}\right)

    Dahl1968, with the exponent one: the solution of
    :math:`\mathrm{d}M/\mathrm{d}\theta = \sigma_0 (1 - M/M_c)` from the torque :math:`M_0` at the start, which is
    :math:`-M_c` after a long way in the other direction, and zero from rest. For a rotation of zero or more.
    """
    sigma_0, M_c, M_0, theta = presliding_stiffness, coulomb_torque, initial_torque, screw_angle
    xp = namespace(sigma_0, M_c, M_0, theta)
    return M_c - (M_c - M_0) * xp.exp(-sigma_0 * theta / M_c)


def lugre_torque(
    elastic_torque: Torque,
    coulomb_torque: Torque,
    micro_damping: RotationalDamping,
    viscous_slope: RotationalDamping,
    screw_speed: AngularSpeed,
) -> Torque:
    r"""Torque of the model LuGre at a steady speed.

    .. math:: M = M_z + \sigma_1 \omega \left(1 - \frac{M_z}{M_c}\right) + \sigma_2 \omega

    CanudasDeWit1995. The bristles hold :math:`M_z = \sigma_0 z`, and their deflection z grows by
    :math:`\omega (1 - M_z/M_c)`, where :math:`M_c` is what they hold at this speed. So at a steady speed
    :math:`M_z` is the torque of Dahl (:func:`dahl_torque`), however slow it is. For a speed above zero.
    """
    M_z, M_c, sigma_1, sigma_2, omega = elastic_torque, coulomb_torque, micro_damping, viscous_slope, screw_speed
    return M_z + sigma_1 * omega * (1 - M_z / M_c) + sigma_2 * omega


def micro_damping(
    presliding_stiffness: RotationalStiffness, moment_of_inertia: MomentOfInertia, damping_ratio: Ratio
) -> RotationalDamping:
    r"""Damping of the bristles with which an inertia that sticks on them swings with a damping ratio.

    .. math:: \sigma_1 = 2 \zeta \sqrt{\sigma_0 J}

    A choice and no property of the contact: the example of CanudasDeWit1995 has :math:`\zeta = 1/2`.
    """
    sigma_0, J, zeta = presliding_stiffness, moment_of_inertia, damping_ratio
    xp = namespace(sigma_0, J, zeta)
    return 2 * zeta * xp.sqrt(sigma_0 * J)


def slip_element_torque(
    element_stiffness: RotationalStiffness, slip_torque: Torque, initial_torque: Torque, screw_angle: Angle
) -> Torque:
    r"""Torque of a Maxwell-slip element, a spring in series with a block that slides, after a rotation.

    .. math:: M = \min\left(\max\left(M_0 + k \theta, -M_s\right), M_s\right)

    Lampaert2003, below the speeds at which the sliding torque depends on the speed. Exact for a rotation
    :math:`\theta` of either sign that does not turn back on its way.
    """
    k, M_s, M_0, theta = element_stiffness, slip_torque, initial_torque, screw_angle
    xp = namespace(k, M_s, M_0, theta)
    return xp.minimum(xp.maximum(M_0 + k * theta, -M_s), M_s)
