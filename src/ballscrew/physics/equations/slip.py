r"""Slip in a contact that rolls on a curved ellipse, spins, carries a net force and is dragged sideways.

Along the path, race against ball, the slip at the height :math:`t = y/a` across the ellipse is
:math:`s = A + \beta t + C H`: a creep A, the spin about the normal (:math:`\beta` at the rim), and
what the curvature of the common surface forces (C at the rim). Across the path it is
:math:`D - x \mathrm{d}s/\mathrm{d}y`: what the helix forces, and the other component of the spin.

Two ways lead from there to forces. On the *line* y alone, without D, everything is closed: the slip
changes sign at two heights or at one. Over the *ellipse* with D, it is summed over a few cells.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Ratio, Speed, Torque


def curvature_slip_speed(semi_major_axis: Length, deformed_radius: Length, contact_rotation: AngularSpeed) -> Speed:
    r"""Slip at the rim of the ellipse, against its middle, that the curvature of the contact forces.

    .. math:: C = \frac{\Omega a^2}{2 R_d}

    Olaru2005 §2.2, Fig. 4. The rotation is that of ball against race.
    """
    a, R_d, Omega = semi_major_axis, deformed_radius, contact_rotation
    return Omega * a**2 / (2 * R_d)


def surface_depth(height: Ratio, semi_major_axis: Length, deformed_radius: Length) -> Ratio:
    r"""Depth of the common surface below its top, in units of :math:`a^2/2R_d`.

    .. math:: H = \frac{2 t^2}{1 + \sqrt{\max\left(1 - \left(a t/R_d\right)^2, 0\right)}}

    The surface is a circle of radius :math:`R_d` (Harris2001); :math:`t^2` where the contact is small.
    """
    t, a, R_d = height, semi_major_axis, deformed_radius
    xp = namespace(t, a, R_d)
    return 2 * t**2 / (1 + xp.sqrt(xp.maximum(1 - (a * t / R_d) ** 2, 0)))


# -- on the line ----------------------------------------------------------------------------------


def half_distance_of_lines(spin_parameter: Ratio, traction_ratio: Ratio) -> Ratio:
    r"""Half the distance of the two lines of pure rolling; their middle lies at :math:`-E_s/2`.

    .. math:: h = 2 \sqrt{1 - E_s^2/4}
        \sin\left(\frac{1}{3} \arcsin\left(\frac{1 - T}{2 \left(1 - E_s^2/4\right)^{3/2}}\right)\right)

    With :math:`E_s = \beta/C` and the net force T in units of friction times load; zero spin gives
    the Y of Olaru2005 §2.2 (17), see :func:`~ballscrew.physics.equations.friction.offset_from_traction`.
    Holds while both lines lie in the ellipse and the argument of the arcsine within 1; else
    :func:`single_line`. After Houpert2002, solved in closed form here.
    """
    E_s, T = spin_parameter, traction_ratio
    xp = namespace(E_s, T)
    return 2 * xp.sqrt(1 - E_s**2 / 4) * xp.sin(xp.arcsin((1 - T) / (2 * (1 - E_s**2 / 4) ** (3 / 2))) / 3)


def single_line(traction_ratio: Ratio) -> Ratio:
    r"""Height of the line of pure rolling where there is but one, as the spin has pushed the other out.

    .. math:: t_1 = -2 \sin\left(\frac{1}{3} \arcsin T\right)
    """
    T = traction_ratio
    xp = namespace(T)
    return -2 * xp.sin(xp.arcsin(T) / 3)


def line_curvature_coefficient(lower_line: Ratio, upper_line: Ratio) -> Ratio:
    r"""Curvature moment of a contact that slips backwards between two lines: :math:`M_C = c_C \mu Q a^2/R_d`.

    .. math:: c_C = \frac{3}{8} \left(\frac{4}{15} - 2 \left(\frac{t_2^3 - t_1^3}{3} - \frac{t_2^5 - t_1^5}{5}\right)
        \right)

    With lines at :math:`\pm Y` this is Olaru2005 §2.2 (15).
    """
    t_1, t_2 = lower_line, upper_line
    return 3 / 8 * (4 / 15 - 2 * ((t_2**3 - t_1**3) / 3 - (t_2**5 - t_1**5) / 5))


def line_spin_coefficient(lower_line: Ratio, upper_line: Ratio) -> Ratio:
    r"""Spin moment of a contact that slips backwards between two lines: :math:`M_P = \frac{3}{8} f_P \mu Q a`.

    .. math:: f_P = -4 \left(\frac{t_2^2 - t_1^2}{2} - \frac{t_2^4 - t_1^4}{4}\right)

    One for pure spin.
    """
    t_1, t_2 = lower_line, upper_line
    return -4 * ((t_2**2 - t_1**2) / 2 - (t_2**4 - t_1**4) / 4)


def pure_spin_moment(traction_limit: Force, semi_major_axis: Length) -> Torque:
    r"""Spin moment of a slender contact that does nothing but spin.

    .. math:: M_P = \frac{3}{8} F_\mu a

    Houpert2002. The traction limit is friction coefficient times load; a circular contact has
    3π/16 in place of 3/8.
    """
    F_mu, a = traction_limit, semi_major_axis
    return 3 / 8 * F_mu * a


def curvature_factor_polynomial(spin_parameter: Ratio) -> Ratio:
    r"""Reduction factor of the curvature moment by spin, as a polynomial.

    .. math:: f_C = 1.0026 - 0.1653 E_s - 0.2638 E_s^2 - 2.5521 E_s^3 + 1.9749 E_s^4

    Houpert1999, as public code quotes it; the paper itself was not seen. For 0 ≤ E_s ≤ 1 without
    net force, within 0.0093 of the closed form :func:`line_curvature_coefficient`; useless beyond.
    """
    E_s = spin_parameter
    return 1.0026 - 0.1653 * E_s - 0.2638 * E_s**2 - 2.5521 * E_s**3 + 1.9749 * E_s**4


def spin_factor_polynomial(spin_parameter: Ratio) -> Ratio:
    r"""Spin moment against that of pure spin, as a polynomial.

    .. math:: f_P = 0.0042 + 1.1045 E_s + 0.4625 E_s^2 - 0.5648 E_s^3

    Houpert1999, as public code quotes it; the paper itself was not seen. For 0 ≤ E_s ≤ 1 without
    net force, within 0.0082 of the closed form :func:`line_spin_coefficient`; useless beyond.
    """
    E_s = spin_parameter
    return 0.0042 + 1.1045 * E_s + 0.4625 * E_s**2 - 0.5648 * E_s**3


# -- over the ellipse -----------------------------------------------------------------------------


def path_slip_speed(
    creep_speed: Speed, spin_rim_speed: Speed, curvature_slip_speed: Speed, height: Ratio, surface_depth: Ratio
) -> Speed:
    r"""Slip along the path, race against ball.

    .. math:: s = A + \beta t + C H
    """
    A, beta, C, t, H = creep_speed, spin_rim_speed, curvature_slip_speed, height, surface_depth
    return A + beta * t + C * H


def local_spin_speed(spin_rim_speed: Speed, curvature_slip_speed: Speed, height: Ratio) -> Speed:
    r"""Change of the path slip across the ellipse: what the local spin makes of one semi-axis.

    .. math:: g = \beta + 2 C t

    The second term is the share of the rolling about the local normal (Heathcote).
    """
    beta, C, t = spin_rim_speed, curvature_slip_speed, height
    return beta + 2 * C * t


def across_slip_speed(lateral_slip_speed: Speed, local_spin_speed: Speed, position_along: Ratio) -> Speed:
    r"""Slip across the path, race against ball, at a place of the ellipse.

    .. math:: s_c = D - x g

    The position x along the path is in units of a, the semi-axis across it: from -b/a to b/a. With
    :func:`path_slip_speed` it is the slip that :func:`cell_slip_speed` is the root-mean-square of.
    """
    D, g, x = lateral_slip_speed, local_spin_speed, position_along
    return D - x * g


def cell_slip_speed(
    path_slip_speed: Speed, local_spin_speed: Speed, lateral_slip_speed: Speed, cell_variance: Ratio
) -> Speed:
    r"""Root-mean-square slip in a cell of the ellipse.

    .. math:: r = \sqrt{s^2 + V g^2 + D^2}

    V is the variance of the distance from the middle of the cell, along and across, in units of a².
    Convex in creep, spin and lateral slip, and smooth: the sum over the cells of friction, load and
    r is a potential whose slopes are the forces of the contact.
    """
    s, g, D, V = path_slip_speed, local_spin_speed, lateral_slip_speed, cell_variance
    xp = namespace(s, g, D, V)
    return xp.sqrt(s**2 + V * g**2 + D**2)


def nominal_sliding_speed(
    curvature_slip_speed: Speed, spin_rim_speed: Speed, lateral_slip_speed: Speed, ellipticity: Ratio
) -> Speed:
    r"""Root-mean-square slip over the ellipse, weighted by pressure, without a net force.

    .. math:: u_s = \sqrt{0.052 C^2 + \frac{1 + \kappa^{-2}}{5} \beta^2 + D^2}

    A measure for heating and shear rate, before the equilibrium is known. The 0.052 is the mean of
    :math:`(t^2 - Y^2)^2` with Y = 0.347.
    """
    C, beta, D, kappa = curvature_slip_speed, spin_rim_speed, lateral_slip_speed, ellipticity
    xp = namespace(C, beta, D, kappa)
    return xp.sqrt(0.052 * C**2 + (1 + kappa ** (-2)) / 5 * beta**2 + D**2)
