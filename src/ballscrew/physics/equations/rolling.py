"""Rolling resistance: the lubricant in the inlet, and the elastic losses of the bodies."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Force,
    KinematicViscosity,
    Length,
    Pressure,
    PressureCoefficient,
    Ratio,
    Speed,
    Torque,
)

#: Takes the place of a zero below a fraction: at rest and without load a share, 0/0, becomes zero.
SMALLEST = 1e-300


def hydrodynamic_rolling_force(
    equivalent_modulus: Pressure,
    rolling_radius: Length,
    radii_ratio: Ratio,
    material_parameter: Ratio,
    speed_parameter: Ratio,
    load_parameter: Ratio,
) -> Force:
    r"""Rolling resistance of the Poiseuille flow in the contact inlet.

    .. math:: F_R = 2.86 E' R_x^2 k^{0.348} G^{0.022} U^{0.66} W^{0.47}

    Olaru2005 §2.1 (1), after Houpert1985. Fully flooded, isothermal, piezoviscous-elastic contact;
    10 to 12 % below the unrounded fit, and 2.3 times too low at the paper's screw at 5 N, where
    the contact is no longer elastic.
    """
    E, R_x, k = equivalent_modulus, rolling_radius, radii_ratio
    G, U, W = material_parameter, speed_parameter, load_parameter
    return 2.86 * E * R_x**2 * k**0.348 * G**0.022 * U**0.66 * W**0.47


def pressure_force(hydrodynamic_rolling_force: Force, ring_radius: Length, ball_radius: Length) -> Force:
    r"""Force of the inlet pressure through the centre of a ball on a ring.

    .. math:: F_P = 2 F_R \frac{R_R}{R_R + R_b}

    Olaru2005 §2.1 (10). For a concave ring the ball radius counts negative.
    """
    F_R, R_R, R_b = hydrodynamic_rolling_force, ring_radius, ball_radius
    return 2 * F_R * R_R / (R_R + R_b)


def nut_pressure_force(hydrodynamic_rolling_force: Force, curvature_ratio: Ratio) -> Force:
    r"""Force of the inlet pressure through the ball centre, ball–nut contact.

    .. math:: F_P = 2 F_R (1 + \gamma)

    Olaru2005 §2.1 (11).
    """
    F_R, gamma = hydrodynamic_rolling_force, curvature_ratio
    return 2 * F_R * (1 + gamma)


def screw_pressure_force(hydrodynamic_rolling_force: Force, curvature_ratio: Ratio) -> Force:
    r"""Force of the inlet pressure through the ball centre, ball–screw contact.

    .. math:: F_P = 2 F_R (1 - \gamma)

    Olaru2005 §2.1 (12).
    """
    F_R, gamma = hydrodynamic_rolling_force, curvature_ratio
    return 2 * F_R * (1 - gamma)


def elastic_resistance_moment(ball_diameter: Length, contact_load: Force, radii_ratio: Ratio) -> Torque:
    r"""Moment of the elastic resistance to pure rolling, at one contact.

    .. math:: M_{ER} = 7.48 \cdot 10^{-7} \left(\frac{d_w}{2}\right)^{0.33} Q^{1.33}
        \left(1 - 3.519 \cdot 10^{-3} (k - 1)^{0.806}\right)

    Olaru2005 §2.2 (20), after Snare. A dimensional fit for steel on steel: SI only (m and N in,
    N m out). Needs k ≥ 1; the bracket vanishes at k ≈ 1100.
    """
    d_w, Q, k = ball_diameter, contact_load, radii_ratio
    return 7.48e-7 * (d_w / 2) ** 0.33 * Q**1.33 * (1 - 3.519e-3 * (k - 1) ** 0.806)


def elastic_regime_parameter(radii_ratio: Ratio, load_parameter: Ratio, speed_parameter: Ratio) -> Ratio:
    r"""Parameter of the elastic side of the lubrication regimes.

    .. math:: M = \frac{0.5549 k^{-0.6029} W}{U^{3/4}}

    BibouletHoupert2010: large in the piezoviscous-elastic regime, small in the isoviscous-rigid
    one; at 6.6 the rolling force lies half-way between its two asymptotes.
    """
    k, W, U = radii_ratio, load_parameter, speed_parameter
    return 0.5549 * k ** (-0.6029) * W / U**0.75


def rigid_rolling_force(
    equivalent_modulus: Pressure,
    rolling_radius: Length,
    radii_ratio: Ratio,
    load_parameter: Ratio,
    speed_parameter: Ratio,
) -> Force:
    r"""Rolling resistance of the inlet flow when load and pressure neither deform nor thicken.

    .. math:: F_I = 2.9766 E' R_x^2 k^{0.3316} W^{1/3} U^{2/3}

    Balan2015, the power law of :func:`rigid_rolling_force_ellipse`, which is BibouletHoupert2010.
    Fully flooded, isothermal, isoviscous-rigid: light load, high speed.
    """
    E, R_x, k, W, U = equivalent_modulus, rolling_radius, radii_ratio, load_parameter, speed_parameter
    return 2.9766 * E * R_x**2 * k**0.3316 * W ** (1 / 3) * U ** (2 / 3)


def elastic_rolling_force(
    equivalent_modulus: Pressure,
    rolling_radius: Length,
    radii_ratio: Ratio,
    load_parameter: Ratio,
    speed_parameter: Ratio,
) -> Force:
    r"""Rolling resistance of the inlet flow when the bodies deform and pressure thickens the oil.

    .. math:: F_E = 7.5826 E' R_x^2 k^{0.4055} W^{1/3} U^{3/4}

    Balan2015, the power law of :func:`elastic_rolling_force_ellipse`, which is BibouletHoupert2010.
    Fully flooded, isothermal; heavy load, low speed. The oil's pressure coefficient does not matter.
    """
    E, R_x, k, W, U = equivalent_modulus, rolling_radius, radii_ratio, load_parameter, speed_parameter
    return 7.5826 * E * R_x**2 * k**0.4055 * W ** (1 / 3) * U**0.75


def rigid_regime_share(radii_ratio: Ratio, load_parameter: Ratio, speed_parameter: Ratio) -> Ratio:
    r"""Share of the rolling force that follows the isoviscous-rigid asymptote.

    .. math:: s = \frac{6.6 U^{3/4}}{6.6 U^{3/4} + 0.5549 k^{-0.6029} W}

    Balan2015, that is 1/(1 + M/6.6) with :func:`elastic_regime_parameter`, written without dividing
    by the speed. One without load, zero at rest, and zero by definition where both hold.
    """
    k, W, U = radii_ratio, load_parameter, speed_parameter
    xp = namespace(k, W, U)
    return 6.6 * U**0.75 / xp.maximum(6.6 * U**0.75 + 0.5549 * k ** (-0.6029) * W, SMALLEST)


def blended_rolling_force(rigid_rolling_force: Force, elastic_rolling_force: Force, rigid_regime_share: Ratio) -> Force:
    r"""Rolling resistance of the inlet flow in all regimes between the two asymptotes.

    .. math:: F_R = F_E + (F_I - F_E) s

    BibouletHoupert2010, who computed contacts with U from 3e-13 to 8e-11 (as defined here), Hertz
    pressures from 0.06 to 4 GPa, and ellipticities from 1 to 60; 1.4 to 1.6 times the older laws.
    """
    F_I, F_E, s = rigid_rolling_force, elastic_rolling_force, rigid_regime_share
    return F_E + (F_I - F_E) * s


def ellipse_shape_parameter(major_coefficient: Ratio, minor_coefficient: Ratio) -> Ratio:
    r"""Shape parameter of the contact ellipse in the rolling force.

    .. math:: \beta = \frac{2 c_a c_b^2}{3}

    BibouletHoupert2010 (14), :math:`b E'/(\pi p_0 R_x)` there: 1 for a circle, 4/π for a slender
    ellipse, independent of the load.
    """
    c_a, c_b = major_coefficient, minor_coefficient
    return 2 * c_a * c_b**2 / 3


def rigid_rolling_force_ellipse(
    equivalent_modulus: Pressure,
    rolling_radius: Length,
    semi_major_axis: Length,
    ellipse_shape_parameter: Ratio,
    ellipticity: Ratio,
    speed_parameter: Ratio,
) -> Force:
    r"""Rolling resistance of a rigid contact with a constant viscosity, by its Hertz ellipse.

    .. math:: F_I = 1.54 E' R_x a \beta^{-1/3} \kappa^{-0.12} (2 U)^{2/3}

    BibouletHoupert2010 (30), where κ is b/a and U has the factor 2.
    """
    E, R_x, a, beta = equivalent_modulus, rolling_radius, semi_major_axis, ellipse_shape_parameter
    kappa, U = ellipticity, speed_parameter
    return 1.54 * E * R_x * a * beta ** (-1 / 3) * kappa ** (-0.12) * (2 * U) ** (2 / 3)


def elastic_rolling_force_ellipse(
    equivalent_modulus: Pressure,
    rolling_radius: Length,
    semi_major_axis: Length,
    ellipse_shape_parameter: Ratio,
    speed_parameter: Ratio,
) -> Force:
    r"""Rolling resistance of a piezoviscous-elastic contact by its Hertz ellipse.

    .. math:: F_E = 3.6 E' R_x a \beta^{-1/4} (2 U)^{3/4}

    BibouletHoupert2010 (31), where U has the factor 2.
    """
    E, R_x, a, beta = equivalent_modulus, rolling_radius, semi_major_axis, ellipse_shape_parameter
    U = speed_parameter
    return 3.6 * E * R_x * a * beta ** (-1 / 4) * (2 * U) ** 0.75


def elastic_rolling_force_houpert(
    equivalent_modulus: Pressure,
    rolling_radius: Length,
    ellipse_shape_parameter: Ratio,
    ellipticity: Ratio,
    material_parameter: Ratio,
    load_parameter: Ratio,
    speed_parameter: Ratio,
) -> Force:
    r"""Rolling resistance of the inlet flow, piezoviscous-elastic, with a moderate supply of oil.

    .. math:: F_E = 1.544 E' R_x^2 \beta^{1/3} \kappa^{0.577} G^{0.022} (2 U)^{0.656} W^{0.466}

    Houpert1987, as BibouletHoupert2010 (29) restates it: the fit that
    :func:`hydrodynamic_rolling_force` rounds. Balan2015: an inlet that starts three half-widths
    ahead of the contact; 0.7 times the fully flooded force.
    """
    E, R_x, beta, kappa = equivalent_modulus, rolling_radius, ellipse_shape_parameter, ellipticity
    G, W, U = material_parameter, load_parameter, speed_parameter
    return 1.544 * E * R_x**2 * beta ** (1 / 3) * kappa**0.577 * G**0.022 * (2 * U) ** 0.656 * W**0.466


def line_load_parameter(major_coefficient: Ratio, load_parameter: Ratio) -> Ratio:
    r"""Load parameter of a line contact as long as the ellipse, Q/(2a E' R_x).

    .. math:: W_l = \frac{W^{2/3}}{2 c_a}

    Written without dividing by the axis. Zero at zero load.
    """
    c_a, W = major_coefficient, load_parameter
    return W ** (2 / 3) / (2 * c_a)


def rolling_force_aihara(
    rolling_radius: Length,
    semi_major_axis: Length,
    pressure_viscosity_coefficient: PressureCoefficient,
    material_parameter: Ratio,
    speed_parameter: Ratio,
    line_load_parameter: Ratio,
    thermal_loading_parameter: Ratio,
) -> Force:
    r"""Rolling resistance of the inlet flow with its own heating, measured on rollers.

    .. math:: F_R = \frac{176 R_x a}{\alpha_p (1 + 0.29 L^{0.78})} (G U)^{0.658} W_l^{0.31}

    Aihara1987, who gives the moment :math:`2 F_R R_x` of a roller of length l; here l = 2a. Made for
    the piezoviscous-elastic line contacts of tapered roller bearings: for balls an extrapolation.
    """
    R_x, a, alpha_p = rolling_radius, semi_major_axis, pressure_viscosity_coefficient
    G, U, W_l, L = material_parameter, speed_parameter, line_load_parameter, thermal_loading_parameter
    return 176 * R_x * a / (alpha_p * (1 + 0.29 * L**0.78)) * (G * U) ** 0.658 * W_l**0.31


def rolling_starvation_factor(inlet_film_ratio: Ratio) -> Ratio:
    r"""Reduction factor of the rolling force by starvation of the inlet.

    .. math:: \phi_S = \frac{S^2 + 162.8 S}{S^2 + 193.1 S + 1257}

    BibouletHoupertLines2010 (44). S is the film where the inlet begins over the fully flooded
    minimum film. Line contacts, rigid to elastic, S ≥ 2; BibouletHoupert2010 suggests it as a first
    estimate for points. Tends to 1 for S → ∞: 0.2 at S = 2, 0.86 at S = 100.
    """
    S = inlet_film_ratio
    return (S**2 + 162.8 * S) / (S**2 + 193.1 * S + 1257)


def inlet_film_ratio(rolling_starvation_factor: Ratio) -> Ratio:
    r"""Film where the inlet begins over the fully flooded one, of an inlet that leaves this share of the rolling force.

    .. math:: S = \frac{2514 \phi_S}{162.8 - 193.1 \phi_S
        + \sqrt{\left(162.8 - 193.1 \phi_S\right)^2 + 5028 \phi_S \left(1 - \phi_S\right)}}

    The inverse of :func:`rolling_starvation_factor`, BibouletHoupertLines2010 (44): 0.24 where 0.03 of the force is
    left. Without limit for a full inlet.
    """
    phi_S = rolling_starvation_factor
    xp = namespace(phi_S)
    b = 162.8 - 193.1 * phi_S
    return 2514 * phi_S / (b + xp.sqrt(b**2 + 5028 * phi_S * (1 - phi_S)))


def replenishment_factor(
    kinematic_viscosity: KinematicViscosity,
    entrainment_speed: Speed,
    ball_diameter: Length,
    replenishment_constant: Ratio,
) -> Ratio:
    r"""Reduction factor of the rolling force by oil that flows back into the track too late.

    .. math:: \phi_{rs} = \exp\left(-1.963 \cdot 10^{9} K_{rs} \frac{\nu v}{\sqrt{d_w}}\right)

    SKF2018 for bearings, :math:`\exp(-K_{rs} \nu n (d + D) \sqrt{K_Z / (2 (D - d))})` in mm²/s, rpm, mm, as recalled;
    K_rs and K_Z = 4.4, that of single-row angular-contact ball bearings, are as public programs have them from its
    tables. A bearing's n (d + D) is 240 v/π of its entrainment speed v, and its D − d is taken as d_w/0.3. One at rest.
    """
    nu, v, d_w, K_rs = kinematic_viscosity, entrainment_speed, ball_diameter, replenishment_constant
    xp = namespace(nu, v, d_w, K_rs)
    return xp.exp(-1.963e9 * K_rs * nu * v / xp.sqrt(d_w))


def hysteresis_moment(loss_factor: Ratio, contact_load: Force, semi_minor_axis: Length) -> Torque:
    r"""Moment of the elastic resistance to pure rolling, from the work the material keeps.

    .. math:: M_{ER} = \frac{3}{16} \alpha Q b

    Johnson1985 §9.3: the share α of the elastic work of the front half of the contact is lost. Any
    material; the fit of :func:`elastic_resistance_moment` corresponds to 0.02 to 0.04.
    """
    alpha, Q, b = loss_factor, contact_load, semi_minor_axis
    return 3 / 16 * alpha * Q * b
