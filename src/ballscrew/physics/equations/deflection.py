"""Deflection of screw and nut under load: at the balls, whose contact angle changes with it, and in their bodies."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Force, Length, LoadDeflection, Pressure, Ratio


def groove_centre_distance(screw_conformity: Ratio, nut_conformity: Ratio, ball_diameter: Length) -> Length:
    r"""Distance of the centres of the two grooves that an unloaded ball just touches.

    .. math:: A = \left(f_s + f_n - 1\right) d_w

    Harris2001.
    """
    f_s, f_n, d_w = screw_conformity, nut_conformity, ball_diameter
    return (f_s + f_n - 1) * d_w


def loaded_centre_distance(groove_centre_distance: Length, contact_angle: Angle, flank_displacement: Length) -> Length:
    r"""Distance of the groove centres when screw and nut have moved against each other.

    .. math:: s = \sqrt{\left(A \cos\alpha\right)^2 + \left(A \sin\alpha + \xi\right)^2}

    Harris2001; the displacement lies across the path, :math:`\xi = x \cos\varphi` for an axial one of x.
    """
    A, alpha, xi = groove_centre_distance, contact_angle, flank_displacement
    xp = namespace(A, alpha, xi)
    return xp.sqrt((A * xp.cos(alpha)) ** 2 + (A * xp.sin(alpha) + xi) ** 2)


def ball_approach(
    groove_centre_distance: Length,
    contact_angle: Angle,
    flank_displacement: Length,
    loaded_centre_distance: Length,
    ball_excess: Length,
) -> Length:
    r"""Approach of screw and nut at a ball, both contacts together; negative where they do not touch.

    .. math:: \delta = \frac{\xi \left(2 A \sin\alpha + \xi\right)}{s + A} + e

    This is s - A + e without the difference of large numbers; e is what the ball is too big by.
    """
    A, alpha, xi, s, e = groove_centre_distance, contact_angle, flank_displacement, loaded_centre_distance, ball_excess
    xp = namespace(A, alpha, xi, s, e)
    return xi * (2 * A * xp.sin(alpha) + xi) / (s + A) + e


def loaded_contact_sine(
    groove_centre_distance: Length, contact_angle: Angle, flank_displacement: Length, loaded_centre_distance: Length
) -> Ratio:
    r"""Sine of the contact angle under load.

    .. math:: s_\alpha = \frac{A \sin\alpha + \xi}{s}

    Harris2001.
    """
    A, alpha, xi, s = groove_centre_distance, contact_angle, flank_displacement, loaded_centre_distance
    xp = namespace(A, alpha, xi, s)
    return (A * xp.sin(alpha) + xi) / s


def contact_load_deflection(
    approach_coefficient: Ratio, equivalent_modulus: Pressure, rolling_radius: Length
) -> LoadDeflection:
    r"""Load over approach to the power of one and a half, of one Hertz contact.

    .. math:: K = E \sqrt{R_x} \, c_d^{-3/2}

    Johnson1985 §4.2; the coefficient is that of :func:`~ballscrew.physics.equations.hertz.mutual_approach`.
    """
    c_d, E, R_x = approach_coefficient, equivalent_modulus, rolling_radius
    xp = namespace(c_d, E, R_x)
    return E * xp.sqrt(R_x) * c_d ** (-3 / 2)


def series_load_deflection(
    screw_load_deflection: LoadDeflection, nut_load_deflection: LoadDeflection
) -> LoadDeflection:
    r"""Load over approach to the power of one and a half, of the two contacts of a ball in series.

    .. math:: K = \left(K_s^{-2/3} + K_n^{-2/3}\right)^{-3/2}
    """
    K_s, K_n = screw_load_deflection, nut_load_deflection
    return (K_s ** (-2 / 3) + K_n ** (-2 / 3)) ** (-3 / 2)


def hertz_load(load_deflection: LoadDeflection, ball_approach: Length) -> Force:
    r"""Load of a ball that screw and nut approach.

    .. math:: Q = K \delta^{3/2}

    Johnson1985 §4.2. None where the approach is not positive.
    """
    K, delta = load_deflection, ball_approach
    xp = namespace(K, delta)
    return K * delta * xp.sqrt(delta)
