"""Sliding in the contact ellipse: the coefficient of friction, and the moments it leads to."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Force, Length, Ratio, Torque


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
