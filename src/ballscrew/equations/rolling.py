"""Rolling resistance: the lubricant in the inlet, and the elastic losses of the bodies."""

from __future__ import annotations

from ballscrew.quantities import Force, Length, Pressure, Ratio, Torque


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
    r"""How far a contact is on the elastic side of the lubrication regimes.

    .. math:: M = \frac{0.5549 k^{-0.6029} W}{U^{3/4}}

    BibouletHoupert2010: large in the piezoviscous-elastic regime, small in the isoviscous-rigid
    one; at 6.6 the rolling force lies half-way between its two asymptotes.
    """
    k, W, U = radii_ratio, load_parameter, speed_parameter
    return 0.5549 * k ** (-0.6029) * W / U**0.75
