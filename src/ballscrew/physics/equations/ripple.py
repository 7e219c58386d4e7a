r"""Orders at which the balls of a nut make themselves felt, in periods for each turn of the screw.

Pure rolling, nut at rest: all of them follow from the way of the balls along their path, and from their rotation.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Count, Length, Ratio


def loaded_ball_pitch(loaded_length: Length, circuit_length: Length, balls: Count, ball_diameter: Length) -> Length:
    r"""Mean distance of the loaded balls of a circuit.

    .. math:: p = \frac{L_l}{N - (S - L_l)/d_w}

    Balls in the return lie still until they are pushed, and touch then: the return is full, and the room that a circuit
    has is between its loaded balls. Without room it is the ball diameter.
    """
    L_l, S, N, d_w = loaded_length, circuit_length, balls, ball_diameter
    return L_l / (N - (S - L_l) / d_w)


def ball_pass_order(path_advance: Length, ball_pitch: Length) -> Ratio:
    r"""Balls that pass a place of the nut in a turn of the screw.

    .. math:: o_p = \frac{2 \pi s_o}{p}

    The pitch is that of the loaded balls (:func:`loaded_ball_pitch`).
    """
    s_o, p = path_advance, ball_pitch
    xp = namespace(s_o, p)
    return 2 * xp.pi * s_o / p


def cage_order(curvature_ratio: Ratio) -> Ratio:
    r"""Turns of the balls about the axis of the screw in a turn of the screw.

    .. math:: o_c = \frac{1 - \gamma}{2}

    The name is that of bearings; the balls of a screw have no cage. A ball that differs from the others has this order,
    for the time that it is under load.
    """
    gamma = curvature_ratio
    return (1 - gamma) / 2


def over_balls_order(curvature_ratio: Ratio) -> Ratio:
    r"""Turns of the screw over the balls in a turn of the screw.

    .. math:: o_s = \frac{1 + \gamma}{2}

    A ball meets a deviation of the groove of the screw once in each of them.
    """
    gamma = curvature_ratio
    return (1 + gamma) / 2


def ball_spot_order(ball_turns: Ratio) -> Ratio:
    r"""Contacts of a spot on a ball in a turn of the screw.

    .. math:: o_b = 2 i_b

    The spot meets either race once in a turn of the ball, if its axis of rotation does not wander.
    """
    i_b = ball_turns
    return 2 * i_b


def circulation_order(ball_pass_order: Ratio, balls: Count) -> Ratio:
    r"""Circulations of a ball in a turn of the screw.

    .. math:: o_u = \frac{o_p}{N}

    All balls of a circuit pass once in each of them. A ball that is missing, or differs, comes back as often.
    """
    o_p, N = ball_pass_order, balls
    return o_p / N


def ball_pass_harmonic(harmonic: Count, balls: Ratio) -> Ratio:
    r"""Harmonic of the number of loaded balls, over their mean number; its size is the amplitude.

    .. math:: N_m = \frac{2}{\pi m n} \sin(\pi m n)

    Balls at equal distances, n times their pitch the length of the loaded zone, whose ends are sharp: each ball counts
    from end to end. None where n is a whole number. Where the load rises in proportion along k balls at either end, n
    is less by k, and there is a factor :math:`\sin(\pi m k)/(\pi m k)` more: none where k is a whole number.
    """
    m, n = harmonic, balls
    xp = namespace(m, n)
    return 2 / (xp.pi * m * n) * xp.sin(xp.pi * m * n)
