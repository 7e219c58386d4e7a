"""Life of a ball screw, with preload and without, and static safety.

The formulas of ISO3408-5 are as recalled: the standard itself was not read.

Load ratings of a ball screw, by its geometry alone.

The formulas are those of ISO3408-5 as recalled, corroborated on 12 of 14 rows of a catalogue (HIWIN2016): 1.0 % in the
dynamic and 0.2 % in the static rating, if the conformity is 0.52, which is that of the rating and not of the groove,
and if 0.24 turns of each nut carry no load. The standard itself was not read.
The numbers hold for hardened bearing steel.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, AngularSpeed, Count, Duration, Force, Length, Pressure, Ratio


def basic_life(dynamic_load_rating: Force, axial_load: Force) -> Ratio:
    r"""Basic rating life L10: revolutions that 90 % of screws reach.

    .. math:: L = 10^6 \left(\frac{C_a}{F}\right)^3

    ISO3408-5, as recalled. Steady load, clean oil. Without limit as the load vanishes.
    """
    C_a, F = dynamic_load_rating, axial_load
    return 1e6 * (C_a / F) ** 3


def preload_release(axial_load: Force, preload: Force) -> Ratio:
    r"""Share of its preload deflection that an axial load takes from the half it relieves; one sets that half free.

    .. math:: x = \min\left(1, \frac{F}{2 \sqrt{2} P}\right)

    ISO3408-5, as recalled, with the 2.83 there as the 2√2 of Hertz: at twice the deflection a ball carries 2√2 times
    its load. In between the deflection is taken as proportional to the load. Needs a preload above zero.
    """
    F, P = axial_load, preload
    xp = namespace(F, P)
    return xp.minimum(1, F / (2**1.5 * P))


def relieved_half_load(preload: Force, preload_release: Ratio) -> Force:
    r"""Load that is left on the half which an axial load relieves.

    .. math:: F_2 = P \left((1 + x)^{3/2} - 2 \sqrt{2} x\right)

    ISO3408-5, as recalled: the other half carries :math:`P (1 + x)^{3/2}`, and the two differ by the axial load. The
    preload without a load, zero where the half is free.
    """
    P, x = preload, preload_release
    return P * ((1 + x) ** 1.5 - 2**1.5 * x)


def combined_life(first_life: Ratio, second_life: Ratio) -> Ratio:
    r"""Basic rating life L10 of a pair, in revolutions, when either of two may fail.

    .. math:: L = \left(L_1^{-10/9} + L_2^{-10/9}\right)^{-9/10}

    ISO3408-5, as recalled: Weibull's product of probabilities with a slope of 10/9. A life without limit adds nothing.
    """
    L_1, L_2 = first_life, second_life
    return (L_1 ** (-10 / 9) + L_2 ** (-10 / 9)) ** (-9 / 10)


def running_time(life: Ratio, screw_speed: AngularSpeed) -> Duration:
    r"""Time that a number of revolutions takes at a steady speed.

    .. math:: t = \frac{2 \pi L}{\omega}

    Any life; without limit at rest.
    """
    L, omega = life, screw_speed
    xp = namespace(L, omega)
    return 2 * xp.pi * L / omega


def static_safety(static_load_rating: Force, axial_load: Force) -> Ratio:
    r"""Static safety: the static rating over the greatest axial load.

    .. math:: S_0 = \frac{C_{0a}}{F}

    THK514E asks for 2 where loads are smooth and 5 where there are shocks. Without limit as the load vanishes.
    """
    C_0a, F = static_load_rating, axial_load
    return C_0a / F


def contact_angle_factor(contact_angle: Angle) -> Ratio:
    r"""Factor of the contact angle in the dynamic rating.

    .. math:: f_1 = 10 \left(1 - \frac{\sin\alpha}{3}\right)

    ISO3408-5, as recalled. Corroborated at 45° only.
    """
    alpha = contact_angle
    xp = namespace(alpha)
    return 10 * (1 - xp.sin(alpha) / 3)


def curvature_factor(curvature_ratio: Ratio) -> Ratio:
    r"""Factor of the size of the balls against their circle in the dynamic rating.

    .. math:: f_2 = \frac{\gamma^{0.3} (1 - \gamma)^{1.39}}{(1 + \gamma)^{1/3}}

    ISO3408-5, as recalled; its :math:`\gamma = d_w \cos\alpha/d_m` is without the lead. Needs 0 < γ < 1; corroborated
    from 0.05 to 0.16.
    """
    gamma = curvature_ratio
    return gamma**0.3 * (1 - gamma) ** 1.39 / (1 + gamma) ** (1 / 3)


def geometry_factor(contact_angle_factor: Ratio, curvature_factor: Ratio, screw_conformity: Ratio) -> Ratio:
    r"""Factor of all that is shape and not size in the dynamic rating.

    .. math:: f_c = 9.32 f_1 f_2 \left(\frac{2 f_s}{2 f_s - 1}\right)^{0.41}

    ISO3408-5, as recalled. Needs a conformity above 0.5; ratings are made with 0.52.
    """
    f_1, f_2, f_s = contact_angle_factor, curvature_factor, screw_conformity
    return 9.32 * f_1 * f_2 * (2 * f_s / (2 * f_s - 1)) ** 0.41


def screw_turn_rating(
    geometry_factor: Ratio, contact_angle: Angle, balls_per_turn: Count, ball_diameter: Length, lead_angle: Angle
) -> Force:
    r"""Dynamic rating of one turn of balls, if only the screw grew tired.

    .. math:: C_s = f_c \left(\cos\alpha\right)^{0.86} z_1^{2/3} \left(1000 d_w\right)^{1.8}
        \left(\tan\alpha\right) \left(\cos\varphi\right)^{1.3}

    ISO3408-5, as recalled. A dimensional fit for steel: the standard has the ball diameter in millimetres and the
    rating in newtons, so the 1000 is millimetres in a metre. SI in, SI out. Corroborated for balls of 3 to 10 mm.
    """
    f_c, alpha, z_1, d_w, phi = geometry_factor, contact_angle, balls_per_turn, ball_diameter, lead_angle
    xp = namespace(f_c, alpha, z_1, d_w, phi)
    size = z_1 ** (2 / 3) * (1000 * d_w) ** 1.8
    return f_c * size * xp.cos(alpha) ** 0.86 * xp.tan(alpha) * xp.cos(phi) ** 1.3


def turn_rating_ratio(curvature_ratio: Ratio, screw_conformity: Ratio, nut_conformity: Ratio) -> Ratio:
    r"""Dynamic rating of a turn at the screw against that at the nut.

    .. math:: q = \left(\frac{1 - \gamma}{1 + \gamma}\right)^{1.723}
        \left(\frac{f_s (2 f_n - 1)}{f_n (2 f_s - 1)}\right)^{0.41}

    ISO3408-5, as recalled. Below one in equal grooves: the screw, convex where the nut is concave, tires first.
    """
    gamma, f_s, f_n = curvature_ratio, screw_conformity, nut_conformity
    return ((1 - gamma) / (1 + gamma)) ** 1.723 * (f_s * (2 * f_n - 1) / (f_n * (2 * f_s - 1))) ** 0.41


def turn_rating(screw_turn_rating: Force, turn_rating_ratio: Ratio) -> Force:
    r"""Dynamic rating of one turn of balls, where screw and nut both may fail.

    .. math:: C_i = \frac{C_s}{\left(1 + q^{10/3}\right)^{0.3}}

    ISO3408-5, as recalled: two lives with the exponents of :func:`~ballscrew.physics.equations.life.combined_life`.
    """
    C_s, q = screw_turn_rating, turn_rating_ratio
    return C_s / (1 + q ** (10 / 3)) ** 0.3


def dynamic_load_rating(turn_rating: Force, loaded_turns: Ratio) -> Force:
    r"""Axial load at which 90 % of screws reach a million revolutions.

    .. math:: C_a = C_i i^{0.86}

    ISO3408-5, as recalled. Less than proportional: of more turns, more may fail.
    """
    C_i, i = turn_rating, loaded_turns
    return C_i * i**0.86


def static_load_factor(curvature_ratio: Ratio, screw_conformity: Ratio) -> Pressure:
    r"""Static rating for each ball, against the square of its diameter.

    .. math:: k_0 = \frac{27.74 \cdot 10^6}{\sqrt{\frac{2}{1 - \gamma} \left(2 - \frac{1}{f_s}\right)}}

    ISO3408-5, as recalled. The 27.74 is in N/mm², so this is right in SI only: it belongs to hardened steel, whose dent
    in mm is 1.3e-7 Q²/d_w times both sums of curvatures (Harris2001), and is here 1e-4 of the ball diameter.
    Needs a conformity above 0.5; ratings are made with 0.52.
    """
    gamma, f_s = curvature_ratio, screw_conformity
    xp = namespace(gamma, f_s)
    return 27.74e6 / xp.sqrt(2 / (1 - gamma) * (2 - 1 / f_s))


def static_load_rating(
    static_load_factor: Pressure,
    balls_per_turn: Count,
    loaded_turns: Ratio,
    ball_diameter: Length,
    contact_angle: Angle,
    lead_angle: Angle,
) -> Force:
    r"""Axial load that leaves a dent of 1e-4 of the ball diameter at the worst contact.

    .. math:: C_{0a} = k_0 z_1 i d_w^2 \left(\sin\alpha\right) \left(\cos\varphi\right)

    ISO3408-5, as recalled. All balls share the load. Some catalogues (Rexroth2006) rate by another criterion.
    """
    k_0, z_1, i, d_w = static_load_factor, balls_per_turn, loaded_turns, ball_diameter
    alpha, phi = contact_angle, lead_angle
    xp = namespace(k_0, z_1, i, d_w, alpha, phi)
    return k_0 * z_1 * i * d_w**2 * xp.sin(alpha) * xp.cos(phi)
