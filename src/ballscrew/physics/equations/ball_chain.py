r"""The balls of a circuit behind one another: their natural speeds, what holds them together, and what they press.

A ball that rolls freely has a natural speed along its path. It follows from the contact angle at its place, and so from
where the two grooves are there. A ball that is pushed from that speed slips a little more, and its contacts resist by
:math:`c \epsilon`, with a deviation :math:`\epsilon` of its speed and a creep coefficient c. Neighbours that touch
press on each other by what the balls behind them would gain, and balls in the return, which no race drives, are pushed
by all of them. How much of that comes about is a matter of the gap of the circuit: balls with room do not touch.

Forces and speeds along the path; a circuit is the loaded balls with their return.

Orders at which the balls of a nut make themselves felt, in periods for each turn of the screw.

Pure rolling, nut at rest: all of them follow from the way of the balls along their path, and from their rotation.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Acceleration,
    Angle,
    AngularSpeed,
    Count,
    Density,
    Force,
    Length,
    Mass,
    Ratio,
    Speed,
    Torque,
    Viscosity,
)

# -- natural speeds -------------------------------------------------------------------------------


def contact_angle_change(
    axial_deviation: Length, radial_deviation: Length, contact_angle: Angle, groove_centre_distance: Length
) -> Angle:
    r"""Change of the contact angle where the centres of the two grooves lie off their nominal places.

    .. math:: \Delta_\alpha = \frac{e_a \cos\alpha - e_r \sin\alpha}{A}

    The deviations are those of nut against screw, along the axis in the direction of the flank and outwards. First
    order in deviation over distance.
    """
    e_a, e_r, alpha, A = axial_deviation, radial_deviation, contact_angle, groove_centre_distance
    xp = namespace(e_a, e_r, alpha, A)
    return (e_a * xp.cos(alpha) - e_r * xp.sin(alpha)) / A


def rms_speed_deviation(
    curvature_ratio: Ratio, contact_angle: Angle, groove_deviation: Length, groove_centre_distance: Length
) -> Ratio:
    r"""Root-mean-square deviation of the natural speed along a path, from that of the places of the grooves.

    .. math:: \epsilon = \frac{\gamma}{1 - \gamma} \tan(\alpha) \frac{e}{A}

    With :func:`contact_angle_change` for grooves that lie off their places against each other by e, in either direction
    independently; the shift of the path, a tenth of it in most screws, is left out.
    """
    gamma, alpha, e, A = curvature_ratio, contact_angle, groove_deviation, groove_centre_distance
    xp = namespace(gamma, alpha, e, A)
    return gamma / (1 - gamma) * xp.tan(alpha) * e / A


def natural_speed_range(rms_speed_deviation: Ratio) -> Ratio:
    r"""Range of the natural speeds, over their mean, that deviate as a sine does.

    .. math:: R = 2 \sqrt{2} \epsilon
    """
    epsilon = rms_speed_deviation
    return 2 * 2**0.5 * epsilon


# -- what holds a ball at another speed -----------------------------------------------------------


def creep_coefficient(
    friction_coefficient: Ratio,
    lateral_slip_speed: Speed,
    spin: AngularSpeed,
    semi_major_axis: Length,
    ball_speed: Speed,
) -> Ratio:
    r"""Force along the path over the load of a ball, for each unit by which its speed deviates from the natural one.

    .. math:: c = \frac{0.95 \mu}{\sqrt{\left(\frac{D}{4 v}\right)^2 + \left(\frac{\Omega a}{6 v}\right)^2}}

    D and Ω are the lateral slip and the spin that both contacts share, v the speed of the ball along its path. Dry
    friction of contacts that slip anyhow turns with the slip, so that creep meets no threshold. Between the limits
    :func:`creep_coefficient_of_lateral_slip` and :func:`creep_coefficient_of_spin`; the 0.95 is fitted to the slip over
    the ellipse, within 2 % at 5 % of the dynamic rating, and too large where curvature rules. Linear to a twentieth of
    the load; the force ends at :math:`2 \mu`.
    """
    mu, D, Omega, a, v = friction_coefficient, lateral_slip_speed, spin, semi_major_axis, ball_speed
    xp = namespace(mu, D, Omega, a, v)
    return 0.95 * mu / xp.sqrt((D / (4 * v)) ** 2 + (Omega * a / (6 * v)) ** 2)


def creep_coefficient_of_lateral_slip(
    friction_coefficient: Ratio, lateral_slip_speed: Speed, ball_speed: Speed
) -> Ratio:
    r"""Creep coefficient of contacts that slip across the path and nothing else.

    .. math:: c = \frac{4 \mu v}{D}

    Each contact has half of the lateral slip D and turns its friction by the angle of creep over slip; the speed of the
    ball changes by the mean of the creeps of both.
    """
    mu, D, v = friction_coefficient, lateral_slip_speed, ball_speed
    return 4 * mu * v / D


def creep_coefficient_of_spin(
    friction_coefficient: Ratio, spin: AngularSpeed, semi_major_axis: Length, ball_speed: Speed
) -> Ratio:
    r"""Creep coefficient of slender contacts that spin and nothing else.

    .. math:: c = \frac{6 \mu v}{\Omega a}

    Creep moves the one line of pure rolling; the pressure there is that of the middle.
    """
    mu, Omega, a, v = friction_coefficient, spin, semi_major_axis, ball_speed
    return 6 * mu * v / (Omega * a)


# -- the return -----------------------------------------------------------------------------------


def ball_mass(ball_diameter: Length, density: Density) -> Mass:
    r"""Mass of a ball.

    .. math:: m = \frac{\pi}{6} \rho d_w^3
    """
    d_w, rho = ball_diameter, density
    xp = namespace(d_w, rho)
    return xp.pi / 6 * rho * d_w**3


def return_resistance(
    friction_coefficient: Ratio,
    ball_mass: Mass,
    gravity: Acceleration,
    viscosity: Viscosity,
    ball_diameter: Length,
    ball_speed: Speed,
    wall_factor: Ratio,
) -> Force:
    r"""Force that a ball needs along its return, where no race drives it.

    .. math:: f = \mu_b m g + 3 \pi \eta d_w v k

    Its weight slides, and it is dragged through oil by Stokes' law, with a factor for the walls near it. That factor is
    assumed, of order ten.
    """
    mu_b, m, g, eta, d_w, v, k = (
        friction_coefficient, ball_mass, gravity, viscosity, ball_diameter, ball_speed, wall_factor,
    )  # fmt: skip
    xp = namespace(mu_b, m, g, eta, d_w, v, k)
    return mu_b * m * g + 3 * xp.pi * eta * d_w * v * k


def return_torque(return_force: Force, path_radius: Length, curvature_ratio: Ratio) -> Torque:
    r"""Torque on the screw of a force that the loaded balls of a circuit push their return with.

    .. math:: T = F L \frac{1 - \gamma}{2}

    The power of the force at the speed of the balls, over the speed of the screw.
    """
    F, L, gamma = return_force, path_radius, curvature_ratio
    return F * L * (1 - gamma) / 2


def mean_return_push(return_force: Force, pushing_contacts: Ratio, loaded_balls: Count) -> Force:
    r"""Force between neighbours, on the mean of the loaded balls, from what the last of them push the return with.

    .. math:: F = \frac{n F_r}{z}
    """
    F_r, n, z = return_force, pushing_contacts, loaded_balls
    return n * F_r / z


# -- the push of neighbours -----------------------------------------------------------------------


def balls_of_a_turn(path_radius: Length, ball_diameter: Length) -> Ratio:
    r"""Balls that find room in a turn of the path, one touching the next.

    .. math:: z_1 = \frac{2 \pi L}{d_w}
    """
    L, d_w = path_radius, ball_diameter
    xp = namespace(L, d_w)
    return 2 * xp.pi * L / d_w


def relative_gap(gap_in_balls: Ratio, balls: Count, natural_speed_range: Ratio) -> Ratio:
    r"""Gap of a circuit, over its length, against the range of the natural speeds.

    .. math:: x = \frac{G}{(N + G) R}

    The gap G in balls, beside N balls of the circuit. Below a tenth the balls are jammed; above a half they are free:
    balls that have passed the slowest place one after the other have gained more room than they lose at any other.
    """
    G, N, R = gap_in_balls, balls, natural_speed_range
    return G / ((N + G) * R)


def pushing_share(relative_gap: Ratio) -> Ratio:
    r"""Share of the force of a jammed circuit that is left where its balls have a gap.

    .. math:: Y = \exp\left(-\frac{x^2}{0.1 (x + 0.1)}\right)
        + \left(1 - \exp\left(-\frac{x^2}{0.1 (x + 0.1)}\right)\right) \frac{0.03}{1 + x^2}

    A fit to runs of :func:`ballscrew.moving_chain` with a 40×10, a 63×10 and a 16×5 and deviations of 0.7 and 1.5 µm,
    means of four seeds of grooves: within a factor of 2.1 of all of them up to one. Beyond, where hardly anything is
    left, they scatter by ten either way: what is left there is that of balls which an error of their grooves unloads.
    """
    x = relative_gap
    xp = namespace(x)
    jammed = xp.exp(-(x**2) / (0.1 * (x + 0.1)))
    return jammed + (1 - jammed) * 0.03 / (1 + x**2)


def chain_force_share(
    creep_coefficient: Ratio, rms_speed_deviation: Ratio, balls_of_a_turn: Ratio, pushing_share: Ratio
) -> Ratio:
    r"""Force between neighbours over the load of a ball, by deviating grooves.

    .. math:: F = c \epsilon \frac{z_1}{2 \pi} Y

    Without a gap, and with speeds that deviate once a turn, the pushes add up over a half-turn: the sum of
    :math:`c \epsilon` is its integral over the balls.
    """
    c, epsilon, z_1, Y = creep_coefficient, rms_speed_deviation, balls_of_a_turn, pushing_share
    xp = namespace(c, epsilon, z_1, Y)
    return c * epsilon * z_1 / (2 * xp.pi) * Y


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
