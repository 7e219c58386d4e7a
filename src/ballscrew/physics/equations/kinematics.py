"""Speeds of a ball that rolls between screw and nut, nut at rest, screw turning."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, AngularSpeed, Length, Ratio, Speed


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


def ball_surface_speed(
    entrainment_speed: Speed,
    screw_creep_speed: Speed,
    nut_creep_speed: Speed,
    screw_contact_radius: Length,
    nut_contact_radius: Length,
    path_radius: Length,
) -> Speed:
    r"""Speed of the ball's surface in its contacts when the races creep ahead of it.

    .. math:: w = v - \frac{A_s R_n + A_n R_s}{2 L}

    From :math:`\omega_s + \omega_c = \omega` with :math:`\omega_s = (w + A_s)/R_s` and
    :math:`\omega_c = (w + A_n)/R_n`; without creep it is the entrainment speed.
    """
    v, A_s, A_n = entrainment_speed, screw_creep_speed, nut_creep_speed
    R_s, R_n, L = screw_contact_radius, nut_contact_radius, path_radius
    return v - (A_s * R_n + A_n * R_s) / (2 * L)


def relative_spin(screw_speed: AngularSpeed, rolling_plane_sine: Ratio) -> AngularSpeed:
    r"""Rotation of screw against nut about the normal of a contact: what both contacts must spin.

    .. math:: \Omega_P = \omega s_\alpha

    Harris2001 §8.3 for a bearing; with a helix, :math:`s_\alpha = \sin\alpha\cos\varphi`.
    """
    omega, s_alpha = screw_speed, rolling_plane_sine
    return omega * s_alpha


def torsion_speed(screw_speed: AngularSpeed, ball_diameter: Length, lead_angle: Angle) -> Speed:
    r"""Lateral slip that the helix forces on both contacts together.

    .. math:: D = \omega \frac{d_w}{2} \sin\varphi

    The screw turns against the nut about the ball's path at :math:`\omega\sin\varphi`; whatever
    the ball does, its two contacts share that slip. None in a bearing.
    """
    omega, d_w, phi = screw_speed, ball_diameter, lead_angle
    xp = namespace(omega, d_w, phi)
    return omega * d_w / 2 * xp.sin(phi)
