"""Life of a ball screw, with preload and without, and static safety.

The formulas of ISO3408-5 are as recalled: the standard itself was not read.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import AngularSpeed, Duration, Force, Ratio


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
