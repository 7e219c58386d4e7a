"""Geometry of the ball, the helix and the grooves."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Length, Ratio


def lead_angle(lead: Length, pitch_circle_diameter: Length) -> Angle:
    r"""Angle of the helix of the ball centres against the plane normal to the axis.

    .. math:: \varphi = \arctan\frac{P_h}{\pi d_m}

    ISO3408-1. Any lead; a lead of zero gives a plain thrust bearing.
    """
    P_h, d_m = lead, pitch_circle_diameter
    xp = namespace(P_h, d_m)
    return xp.arctan(P_h / (xp.pi * d_m))


def path_radius(pitch_circle_diameter: Length, lead_angle: Angle) -> Length:
    r"""Lever of the friction forces: half the pitch circle diameter, measured along the helix.

    .. math:: L = \frac{d_m}{2\cos\varphi}

    With :math:`\varphi = 0` this is the :math:`d_m/2` of the paper.
    """
    d_m, phi = pitch_circle_diameter, lead_angle
    xp = namespace(d_m, phi)
    return d_m / (2 * xp.cos(phi))


def ball_pitch_angle(ball_diameter: Length, pitch_circle_diameter: Length, lead_angle: Angle) -> Angle:
    r"""Angle about the axis between the centres of balls that touch.

    .. math:: \psi_w = \frac{2 d_w \cos\varphi}{d_m}

    Along the helix, for balls much smaller than its radius: the arc in place of the chord.
    """
    d_w, d_m, phi = ball_diameter, pitch_circle_diameter, lead_angle
    xp = namespace(d_w, d_m, phi)
    return 2 * d_w * xp.cos(phi) / d_m


def curvature_ratio(
    ball_diameter: Length, pitch_circle_diameter: Length, contact_angle: Angle, lead_angle: Angle
) -> Ratio:
    r"""Ball diameter, seen in the rolling plane, against the diameter of its path.

    .. math:: \gamma = \frac{d_w \cos\alpha}{d_m} \left(\cos\varphi\right)^2

    With :math:`\varphi = 0` this is the :math:`d_w\cos\alpha/d_m` of the paper; the helix enters
    because the radius of curvature of the path is :math:`d_m/(2\cos^2\varphi)`.
    """
    d_w, d_m, alpha, phi = ball_diameter, pitch_circle_diameter, contact_angle, lead_angle
    xp = namespace(d_w, d_m, alpha, phi)
    return d_w * xp.cos(alpha) / d_m * xp.cos(phi) ** 2


def rolling_plane_cosine(contact_angle: Angle, lead_angle: Angle) -> Ratio:
    r"""Share of a moment about the direction of rolling that turns about the screw axis.

    .. math:: c_\alpha = \cos\alpha \cos\varphi

    With :math:`\varphi = 0` this is the :math:`\cos\alpha` of the paper.
    """
    alpha, phi = contact_angle, lead_angle
    xp = namespace(alpha, phi)
    return xp.cos(alpha) * xp.cos(phi)


def rolling_plane_sine(contact_angle: Angle, lead_angle: Angle) -> Ratio:
    r"""Share of a moment about the contact normal that turns about the screw axis.

    .. math:: s_\alpha = \sin\alpha \cos\varphi
    """
    alpha, phi = contact_angle, lead_angle
    xp = namespace(alpha, phi)
    return xp.sin(alpha) * xp.cos(phi)


def nut_rolling_radius(ball_diameter: Length, curvature_ratio: Ratio) -> Length:
    r"""Equivalent radius in the rolling direction at the ball–nut contact.

    .. math:: R_x = \frac{d_w}{2} (1 + \gamma)

    Olaru2005 §2.1 (2), whose two fractions collapse to this product exactly.
    """
    d_w, gamma = ball_diameter, curvature_ratio
    return d_w / 2 * (1 + gamma)


def screw_rolling_radius(ball_diameter: Length, curvature_ratio: Ratio) -> Length:
    r"""Equivalent radius in the rolling direction at the ball–screw contact.

    .. math:: R_x = \frac{d_w}{2} (1 - \gamma)

    Olaru2005 §2.1 (3), whose two fractions collapse to this product exactly.
    """
    d_w, gamma = ball_diameter, curvature_ratio
    return d_w / 2 * (1 - gamma)


def radii_ratio(transverse_radius: Length, rolling_radius: Length) -> Ratio:
    r"""Ratio of the equivalent radii across and along the rolling direction.

    .. math:: k = \frac{R_y}{R_x}

    Olaru2005 §2.1 (4). Not the ellipticity: that is the ratio of the semi-axes.
    """
    R_y, R_x = transverse_radius, rolling_radius
    return R_y / R_x


def transverse_radius(ball_diameter: Length, conformity: Ratio) -> Length:
    r"""Equivalent radius across the rolling direction, ball in a groove of radius f d_w.

    .. math:: R_y = \frac{f d_w}{2 f - 1}

    Olaru2005 §2.1 (5). Needs f > 0.5: at 0.5 the groove closes on the ball.
    """
    d_w, f = ball_diameter, conformity
    return f * d_w / (2 * f - 1)


def deformed_radius(ball_diameter: Length, conformity: Ratio) -> Length:
    r"""Radius of the common surface of ball and groove, the mean of the two curvatures.

    .. math:: R_d = \frac{2 d_w f}{2 f + 1}

    Olaru2005 §2.2 (16).
    """
    d_w, f = ball_diameter, conformity
    return 2 * d_w * f / (2 * f + 1)


def screw_contact_radius(path_radius: Length, curvature_ratio: Ratio) -> Length:
    r"""Lever of the tangential force at the ball–screw contact.

    .. math:: R_s = L (1 - \gamma)

    Olaru2005 §6 (29), with :math:`L = d_m/2` there.
    """
    L, gamma = path_radius, curvature_ratio
    return L * (1 - gamma)


def nut_contact_radius(path_radius: Length, curvature_ratio: Ratio) -> Length:
    r"""Lever of the tangential force at the ball–nut contact.

    .. math:: R_n = L (1 + \gamma)

    Olaru2005 §6 (32), with :math:`L = d_m/2` there.
    """
    L, gamma = path_radius, curvature_ratio
    return L * (1 + gamma)


def groove_root_diameter(
    pitch_circle_diameter: Length, ball_diameter: Length, conformity: Ratio, contact_angle: Angle
) -> Length:
    r"""Diameter of the screw at the bottom of its groove, a gothic arch of two circles of radius f d_w.

    .. math:: d_r = d_m + d_w \left[(2 f - 1) \cos\alpha - \sqrt{4 f^2 - (2 f - 1)^2 (\sin\alpha)^2}\right]

    Each circle touches the ball at the contact angle; they meet at the bottom. Measured across the
    groove, as drawings show it. With :math:`f = 0.5` it is :math:`d_m - d_w`.
    """
    d_m, d_w, f, alpha = pitch_circle_diameter, ball_diameter, conformity, contact_angle
    xp = namespace(d_m, d_w, f, alpha)
    return d_m + d_w * ((2 * f - 1) * xp.cos(alpha) - xp.sqrt(4 * f**2 - (2 * f - 1) ** 2 * xp.sin(alpha) ** 2))
