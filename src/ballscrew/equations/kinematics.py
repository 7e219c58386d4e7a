"""Speeds of a ball that rolls between screw and nut, nut at rest, screw turning."""

from __future__ import annotations

from ballscrew.quantities import AngularSpeed, Length, Ratio, Speed


def entrainment_speed(screw_speed: AngularSpeed, path_radius: Length, curvature_ratio: Ratio) -> Speed:
    r"""Mean speed at which the surfaces draw lubricant in, the same at both contacts.

    .. math:: v = \frac{\omega L}{2} (1 - \gamma^2)

    Olaru2005 §2.1 (8), with :math:`\omega = \pi n/30` and :math:`L = d_m/2` there. Pure rolling.
    """
    omega, L, gamma = screw_speed, path_radius, curvature_ratio
    return omega * L / 2 * (1 - gamma**2)


def ball_rotation(entrainment_speed: Speed, ball_diameter: Length) -> AngularSpeed:
    r"""Rotation of the ball about the direction across its path, relative to its path.

    .. math:: \omega_b = \frac{2 v}{d_w}

    Pure rolling at both contacts.
    """
    v, d_w = entrainment_speed, ball_diameter
    return 2 * v / d_w


def screw_relative_rotation(entrainment_speed: Speed, screw_contact_radius: Length) -> AngularSpeed:
    r"""Rotation of the screw relative to the travelling ball.

    .. math:: \omega_s = \frac{v}{R_s}

    Together with :func:`orbital_rotation` it makes up the speed of the screw.
    """
    v, R_s = entrainment_speed, screw_contact_radius
    return v / R_s


def orbital_rotation(entrainment_speed: Speed, nut_contact_radius: Length) -> AngularSpeed:
    r"""Rotation of the ball about the screw axis.

    .. math:: \omega_c = \frac{v}{R_n}

    Pure rolling on a nut at rest.
    """
    v, R_n = entrainment_speed, nut_contact_radius
    return v / R_n


def orbital_speed(orbital_rotation: AngularSpeed, path_radius: Length) -> Speed:
    r"""Speed of the ball centre along its path.

    .. math:: v_o = \omega_c L
    """
    omega_c, L = orbital_rotation, path_radius
    return omega_c * L


def screw_contact_rotation(
    ball_rotation: AngularSpeed, screw_relative_rotation: AngularSpeed, rolling_plane_cosine: Ratio
) -> AngularSpeed:
    r"""Rotation of ball against screw that a moment in their contact works on.

    .. math:: \Omega_s = \omega_b + \omega_s c_\alpha
    """
    omega_b, omega_s, c_alpha = ball_rotation, screw_relative_rotation, rolling_plane_cosine
    return omega_b + omega_s * c_alpha


def nut_contact_rotation(
    ball_rotation: AngularSpeed, orbital_rotation: AngularSpeed, rolling_plane_cosine: Ratio
) -> AngularSpeed:
    r"""Rotation of ball against nut that a moment in their contact works on.

    .. math:: \Omega_n = \omega_b - \omega_c c_\alpha
    """
    omega_b, omega_c, c_alpha = ball_rotation, orbital_rotation, rolling_plane_cosine
    return omega_b - omega_c * c_alpha


def curvature_sliding_speed(
    entrainment_speed: Speed,
    rolling_radius: Length,
    deformed_radius: Length,
    position: Length,
    pure_rolling_distance: Length,
) -> Speed:
    r"""Sliding speed across the contact ellipse that the curvature of the contact forces.

    .. math:: u_s = \frac{v}{R_x} \frac{c^2 - y^2}{2 R_d}

    Olaru2005 §2.2, Fig. 4: zero on the two lines of pure rolling at :math:`y = \pm c`. No spin.
    """
    v, R_x, R_d = entrainment_speed, rolling_radius, deformed_radius
    y, c = position, pure_rolling_distance
    return v / R_x * (c**2 - y**2) / (2 * R_d)
