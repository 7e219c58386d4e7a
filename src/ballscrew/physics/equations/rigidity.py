"""Axial rigidity of a ball screw as ISO 3408-4 splits it: balls and tracks, widening of nut and shaft, shaft.

ISO3408-4 was not read. Its table of contents names the parts (shaft held at one end or at both, nut with backlash or
symmetrically preloaded, correction for accuracy); HIWIN2017 calculates "in accordance with DIN ISO 3408" and prints the
sums and the shaft; Steinmeyer2019 says in words what R_b/t, R_nu and R_nu,ar are. The widening is derived here.

Deflection of screw and nut under load: at the balls, whose contact angle changes with it, and in their bodies.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Angle,
    Force,
    Length,
    LoadDeflection,
    Pressure,
    PressureCoefficient,
    Ratio,
    Stiffness,
)


def shaft_force_diameter(pitch_circle_diameter: Length, ball_diameter: Length, contact_angle: Angle) -> Length:
    r"""Diameter at which the balls press on the shaft; that of the bar which stands for it.

    .. math:: d_c = d_m - d_w \cos\alpha

    HIWIN2017 F 3.31.
    """
    d_m, d_w, alpha = pitch_circle_diameter, ball_diameter, contact_angle
    xp = namespace(d_m, d_w, alpha)
    return d_m - d_w * xp.cos(alpha)


def nut_force_diameter(pitch_circle_diameter: Length, ball_diameter: Length, contact_angle: Angle) -> Length:
    r"""Diameter at which the balls press on the nut.

    .. math:: D_c = d_m + d_w \cos\alpha

    The other side of :func:`shaft_force_diameter`.
    """
    d_m, d_w, alpha = pitch_circle_diameter, ball_diameter, contact_angle
    xp = namespace(d_m, d_w, alpha)
    return d_m + d_w * xp.cos(alpha)


def radial_compliance(
    nut_outer_diameter: Length,
    nut_force_diameter: Length,
    nut_young_modulus: Pressure,
    nut_poisson_ratio: Ratio,
    screw_young_modulus: Pressure,
    screw_poisson_ratio: Ratio,
) -> PressureCoefficient:
    r"""Widening of the nut and shrinking of the shaft by one radial force, times :math:`2 \pi L` over that force.

    .. math:: c_r = \frac{1}{E_n} \left(\frac{D_1^2 + D_c^2}{D_1^2 - D_c^2} + \nu_n\right) + \frac{1 - \nu_s}{E_s}

    Derived from Lamé's cylinders (TimoshenkoGoodier1970), whose ends are free: a tube with the pressure p inside at
    :math:`D_c`, a solid shaft with p' outside at :math:`d_c`. The balls press on both with the same force, so that
    :math:`p D_c = p' d_c`. For one material Poisson's ratio cancels. Without limit where the wall has no thickness.
    """
    D_1, D_c, E_n, nu_n, E_s, nu_s = (
        nut_outer_diameter,
        nut_force_diameter,
        nut_young_modulus,
        nut_poisson_ratio,
        screw_young_modulus,
        screw_poisson_ratio,
    )
    return ((D_1**2 + D_c**2) / (D_1**2 - D_c**2) + nu_n) / E_n + (1 - nu_s) / E_s


def radial_stiffness(radial_compliance: PressureCoefficient, loaded_length: Length) -> Stiffness:
    r"""Radial force of all balls of a nut body, evenly round it and along it, over the gap that it opens.

    .. math:: k_r = \frac{2 \pi L}{c_r}

    See :func:`radial_compliance`: the force N makes a pressure of :math:`N / (\pi D_c L)`.
    """
    c_r, L = radial_compliance, loaded_length
    xp = namespace(c_r, L)
    return 2 * xp.pi * L / c_r


def widening_rigidity(radial_stiffness: Stiffness, contact_angle: Angle, lead_angle: Angle) -> Stiffness:
    r"""Axial rigidity of one nut body by the widening of nut and shaft, R_n/s.

    .. math:: R_{n/s} = k_r \left(\tan\alpha \cos\varphi\right)^2

    Derived: an axial force F presses radially with :math:`F / (\tan\alpha \cos\varphi)`, and a gap u that opens lets
    the flanks move axially by :math:`u / (\tan\alpha \cos\varphi)`. Both halves of a preloaded nut are springs side
    by side: twice that. The formula of ISO3408-4, as recalled, is the same for one material without the lead angle.
    """
    k_r, alpha, phi = radial_stiffness, contact_angle, lead_angle
    xp = namespace(k_r, alpha, phi)
    return k_r * (xp.tan(alpha) * xp.cos(phi)) ** 2


def preloaded_ball_track_rigidity(preload: Force, preload_deflection: Length) -> Stiffness:
    r"""Axial rigidity of the balls and tracks of a preloaded nut, R_b/t, up to the load that relieves one half.

    .. math:: R_{b/t} = \frac{2^{3/2} F_{pr}}{\delta_{pr}}

    Derived: at a constant contact angle that load is :math:`2^{3/2} F_{pr}` (HIWIN2017 prints it in 3.7.2), and it
    moves the nut by the deflection :math:`\delta_{pr}` that the preload has given each half. That ISO3408-4 takes this
    load, and not a small one (the tangent is :math:`3 F_{pr} / \delta_{pr}`, 6 % more), is as recalled.
    """
    F_pr, delta_pr = preload, preload_deflection
    return 2**1.5 * F_pr / delta_pr


def ball_track_rigidity(axial_load: Force, axial_deflection: Length) -> Stiffness:
    r"""Axial rigidity of the balls and tracks of a nut without preload, R_b/t, load over deflection.

    .. math:: R_{b/t} = \frac{F}{x}
    """
    F, x = axial_load, axial_deflection
    return F / x


def series_rigidity(first_rigidity: Stiffness, second_rigidity: Stiffness) -> Stiffness:
    r"""Rigidity of two springs in series.

    .. math:: R = \frac{1}{1 / R_1 + 1 / R_2}

    HIWIN2017 F 3.30 for shaft and nut; zero of one is zero of both.
    """
    R_1, R_2 = first_rigidity, second_rigidity
    return 1 / (1 / R_1 + 1 / R_2)


def rigidity_corrected_for_accuracy(accuracy_factor: Ratio, rigidity: Stiffness) -> Stiffness:
    r"""Rigidity of a nut as catalogues print it, R_nu,ar of R_nu.

    .. math:: R_a = f_a R

    ISO3408-4 5.5.3, as Steinmeyer2019 says in words: not all balls carry alike, and the factor goes with the accuracy
    grade. Its values (0.6, 0.55 and 0.5) are as recalled, so that none is the default of anything.
    """
    f_a, R = accuracy_factor, rigidity
    return f_a * R


def shaft_rigidity_held_at_one_end(
    young_modulus: Pressure, shaft_force_diameter: Length, distance_to_bearing: Length
) -> Stiffness:
    r"""Axial rigidity of a solid shaft between the nut and the only bearing that holds it axially.

    .. math:: R_s = \frac{\pi d_c^2 E}{4 l_1}

    HIWIN2017 F 3.31 (fixed and floating).
    """
    E, d_c, l_1 = young_modulus, shaft_force_diameter, distance_to_bearing
    xp = namespace(E, d_c, l_1)
    return xp.pi * d_c**2 * E / (4 * l_1)


def shaft_rigidity_held_at_both_ends(
    young_modulus: Pressure, shaft_force_diameter: Length, distance_to_bearing: Length, unsupported_length: Length
) -> Stiffness:
    r"""Axial rigidity of a solid shaft that two bearings hold axially, at a nut between them.

    .. math:: R_s = \frac{\pi d_c^2 E}{4 l_1} \frac{l}{l - l_1}

    HIWIN2017 F 3.32 (fixed and fixed): the two stretches side by side. Least in the middle, four times that of
    the whole length held at one end.
    """
    E, d_c, l_1, l = young_modulus, shaft_force_diameter, distance_to_bearing, unsupported_length  # noqa: E741  (l is the formula's letter)
    xp = namespace(E, d_c, l_1, l)
    return xp.pi * d_c**2 * E / (4 * l_1) * l / (l - l_1)


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
