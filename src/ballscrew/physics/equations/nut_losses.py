"""Losses of a nut beside its loaded contacts: seals, churning, return of the balls, oil between them, spin-up.

Preload: drag torque of a nut without load, and the load on its halves.
"""

from __future__ import annotations

from typing import Annotated

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Angle,
    AngularSpeed,
    Array,
    Count,
    Density,
    Energy,
    Force,
    Length,
    Mass,
    Ratio,
    Speed,
    Torque,
    Unit,
    Viscosity,
)

LineForce = Annotated[Array, Unit("N/m")]


def seal_torque(lips: Count, lip_friction: LineForce, sealed_diameter: Length) -> Torque:
    r"""Torque of sealing lips that rub all around the screw.

    .. math:: T = \frac{n_l q \pi d^2}{2}

    A friction force on each length of lip, at the lever of half the diameter. The torques of two seals in
    Rexroth2006, 16 mm to 125 mm, follow it with 61 N/m to 109 N/m. Dry friction: any speed.
    """
    n_l, q, d = lips, lip_friction, sealed_diameter
    xp = namespace(n_l, q, d)
    return n_l * q * xp.pi * d**2 / 2


def path_advance(path_radius: Length, curvature_ratio: Ratio) -> Length:
    r"""Way of the balls along their path for each radian that the screw turns.

    .. math:: s_o = \frac{L}{2} (1 - \gamma)

    Pure rolling, nut at rest: the orbital speed over the speed of the screw.
    """
    L, gamma = path_radius, curvature_ratio
    return L / 2 * (1 - gamma)


def path_torque(path_forces: Count, path_force: Force, path_advance: Length) -> Torque:
    r"""Torque on the screw of equal forces against the motion of the balls along their path.

    .. math:: T = n F_p s_o

    Virtual work. The forces are one for each ball that something resists, or one for each return that the
    train of balls is pushed through: touching balls have the same speed in the return as in the thread.
    """
    n, F_p, s_o = path_forces, path_force, path_advance
    return n * F_p * s_o


def ball_reynolds_number(density: Density, orbital_speed: Speed, ball_diameter: Length, viscosity: Viscosity) -> Ratio:
    r"""Reynolds number of a ball that travels through oil at rest.

    .. math:: R_e = \frac{\rho v_o d_w}{\eta_0}
    """
    rho, v_o, d_w, eta_0 = density, orbital_speed, ball_diameter, viscosity
    return rho * v_o * d_w / eta_0


def ball_drag_force(
    oil_share: Ratio, viscosity: Viscosity, ball_diameter: Length, orbital_speed: Speed, ball_reynolds_number: Ratio
) -> Force:
    r"""Drag of a single sphere in oil at rest, times the share of the space that is oil.

    .. math:: F_D = 3 \pi X \eta_0 d_w v_o (1 + 0.15 R_e^{0.687})

    SchillerNaumann1933: Stokes' force and its growth with the Reynolds number, which holds up to 800 to 1000.
    Neighbours in the chain shield a ball, and the screw drags oil along: an upper bound for
    the drag itself. The shear of oil in narrow gaps around the balls is not in it.
    """
    X, eta_0, d_w, v_o, R_e = oil_share, viscosity, ball_diameter, orbital_speed, ball_reynolds_number
    xp = namespace(X, eta_0, d_w, v_o, R_e)
    return 3 * xp.pi * X * eta_0 * d_w * v_o * (1 + 0.15 * R_e**0.687)


def ball_drag_force_harris(
    oil_share: Ratio, drag_coefficient: Ratio, density: Density, ball_diameter: Length, orbital_speed: Speed
) -> Force:
    r"""Drag of a ball in a mixture of oil and air, as bearings have it at high speed.

    .. math:: F_D = \frac{\pi X C_v \rho d_w^2 (2 v_o)^{1.95}}{32}

    Harris2001, as recalled: exponent and denominator were not read. A dimensional fit (SI only), close to
    the pressure on the ball's cross-section. For Reynolds numbers above about 1000; thick oil in a ball
    screw has 1 to 100, for which :func:`ball_drag_force` is made.
    """
    X, C_v, rho, d_w, v_o = oil_share, drag_coefficient, density, ball_diameter, orbital_speed
    xp = namespace(X, C_v, rho, d_w, v_o)
    return xp.pi * X * C_v * rho * d_w**2 * (2 * v_o) ** 1.95 / 32


def ball_turns(path_radius: Length, curvature_ratio: Ratio, ball_diameter: Length) -> Ratio:
    r"""Turns of a ball, relative to its path, for each turn of the screw.

    .. math:: i_b = \frac{L (1 - \gamma^2)}{d_w}

    Pure rolling, nut at rest: :func:`~ballscrew.physics.equations.kinematics.ball_rotation` over the screw's speed.
    """
    L, gamma, d_w = path_radius, curvature_ratio, ball_diameter
    return L * (1 - gamma**2) / d_w


def sheared_oil_torque(
    gaps: Ratio,
    viscosity: Viscosity,
    ball_diameter: Length,
    oil_gap: Length,
    ball_turns: Ratio,
    screw_speed: AngularSpeed,
) -> Torque:
    r"""Torque on the screw of the oil in the gaps between balls that turn the same way.

    .. math:: T = \frac{\pi}{2} n \eta_0 d_w^3 i_b^2 \omega \ln\left(1 + \frac{d_w}{2 h}\right)

    Neighbours turn in the same sense, so that their surfaces meet in the gap with opposite speeds of
    :math:`\omega_b d_w/2`. What one draws in the other draws out: the oil is sheared and builds up no pressure. At the
    distance r from the line of centres the gap is :math:`h + 2r^2/d_w`, and the power
    :math:`\int \eta_0 (\omega_b d_w)^2 / (h + 2r^2/d_w)\, 2\pi r\, dr` up to the radius of the ball is
    :math:`\frac{\pi}{2} \eta_0 d_w^3 \omega_b^2 \ln(1 + d_w/2h)` a gap. For small gaps the moment on either ball is
    :math:`2\pi\eta_0 R^3\omega_b \ln(R/h)` with R their radius: the singular terms of the two moments of two equal
    spheres in JeffreyOnishi1984, 1/5 and 1/20 of :math:`8\pi\eta_0 R^3`, add up to the same. Newtonian oil that fills
    the gap. What is left out does not grow as the gap closes: the drag on a ball that turns alone in
    oil, :math:`8\pi\eta_0 R^3\omega_b`, is of the same size as a term of the logarithm.
    """
    n, eta_0, d_w, h, i_b, omega = gaps, viscosity, ball_diameter, oil_gap, ball_turns, screw_speed
    xp = namespace(n, eta_0, d_w, h, i_b, omega)
    return xp.pi / 2 * n * eta_0 * d_w**3 * i_b**2 * omega * xp.log(1 + d_w / (2 * h))


def entry_work(ball_mass: Mass, orbital_speed: Speed, surface_speed: Speed, lost_speed: Ratio) -> Energy:
    r"""Work that the screw does on a ball that comes out of the return without spin, and slower than the others.

    .. math:: E = m \left(\frac{2}{5} u_b^2 + \sigma v_o^2\right)

    Sliding contacts spin the ball up to the speed of its surface, :math:`u_b = \omega_b d_w/2`. Screw and nut go on at
    their speeds meanwhile: what they rub away is as much as the ball gains, so that the work is twice its energy
    of rotation, :math:`\frac{1}{2}\cdot\frac{2}{5} m u_b^2`, half heat now and half in the return. The share
    :math:`\sigma` of its speed along the path that the ball has lost, at an edge or in a bend, is made up by
    the push of the balls behind it, which go on at their speed: momentum times speed. 0.4 to 1.4 of :math:`m v_o^2`;
    the kinetic energy of a ball that rolls is 0.7 of it.
    """
    m, v_o, u_b, sigma = ball_mass, orbital_speed, surface_speed, lost_speed
    return m * (2 * u_b**2 / 5 + sigma * v_o**2)


def entry_torque(entries: Count, entry_work: Energy, path_advance: Length, ball_diameter: Length) -> Torque:
    r"""Torque on the screw of the work on each ball that enters the loaded turns.

    .. math:: T = \frac{n_r E s_o}{d_w}

    A ball enters each circuit whenever the chain has gone on by its diameter, :math:`s_o/d_w` balls a radian. Gaps
    between the balls make it as many fewer as there is more room than balls.
    """
    n_r, E, s_o, d_w = entries, entry_work, path_advance, ball_diameter
    return n_r * E * s_o / d_w


def preload_torque(preload_torque_coefficient: Ratio, preload: Force, lead: Length) -> Torque:
    r"""Drag torque of a preloaded nut without load, as a share of the torque that would lift the preload.

    .. math:: T = \frac{K_p F_{pr} P_h}{2 \pi}

    JISB1192, as THK514E prints it. Seals come on top.
    """
    K_p, F_pr, P_h = preload_torque_coefficient, preload, lead
    xp = namespace(K_p, F_pr, P_h)
    return K_p * F_pr * P_h / (2 * xp.pi)


def preload_torque_coefficient(lead_angle: Angle, drag_coefficient: Ratio, drag_exponent: Ratio) -> Ratio:
    r"""Share of the preload's ideal torque that is drag, from the lead angle alone.

    .. math:: K_p = \frac{k_p}{\left(\tan\varphi\right)^{m}}

    JISB1192, as THK514E prints it, with 0.05 and 0.5: then the torque is
    :math:`0.0141 F_{pr} \sqrt{d_m P_h}`. A rule for all nuts and oils; a catalogue's example allows 30 %
    on both sides. Without limit where the lead vanishes.
    """
    phi, k_p, m = lead_angle, drag_coefficient, drag_exponent
    xp = namespace(phi, k_p, m)
    return k_p / xp.tan(phi) ** m


def preload_torque_coefficient_of_halves(efficiency: Ratio, back_driving_efficiency: Ratio) -> Ratio:
    r"""Share of the preload's ideal torque that is drag, from the efficiency of each half of a double nut.

    .. math:: K_p = \frac{1}{\eta} - \eta_b

    One half is driven against the preload, the other is driven by it. With the same friction torque
    :math:`M_S` in both it is :math:`2 M_S` over the ideal torque. Both efficiencies at the preload.
    """
    eta, eta_b = efficiency, back_driving_efficiency
    return 1 / eta - eta_b


def diameter_drag_torque(preload: Force, nominal_diameter: Length, drag_coefficient: Ratio) -> Torque:
    r"""Drag torque of a preloaded nut without load, as a friction force on the nominal diameter.

    .. math:: T = c_p F_{pr} d_0

    The rule behind the tables of Rexroth2006, at 100 rpm and without seals: any lead from 5 mm to 40 mm,
    diameters from 16 mm to 125 mm. The coefficient is that of the kind of nut.
    """
    F_pr, d_0, c_p = preload, nominal_diameter, drag_coefficient
    return c_p * F_pr * d_0


def forward_half_load(preload: Force, relative_displacement: Ratio) -> Force:
    r"""Axial load of the half of a double nut that an external load presses on.

    .. math:: F_f = F_{pr} (1 + x)^{3/2}

    Hertz contacts only, all balls of a half alike; the displacement is in units of what the preload
    alone approaches either half. The external load is this less :func:`backward_half_load`.
    """
    F_pr, x = preload, relative_displacement
    return F_pr * (1 + x) ** 1.5


def backward_half_load(preload: Force, relative_displacement: Ratio) -> Force:
    r"""Axial load of the half of a double nut that an external load relieves.

    .. math:: F_b = F_{pr} \left(\max\left(1 - x, 0\right)\right)^{3/2}

    As :func:`forward_half_load`; zero from a displacement of one on, where the half lifts off. The same is left of a
    preload whose approach heat takes, by so much in units of it.
    """
    F_pr, x = preload, relative_displacement
    xp = namespace(F_pr, x)
    return F_pr * xp.maximum(1 - x, 0.0) ** 1.5


def lift_off_load(preload: Force) -> Force:
    r"""External load at which the relieved half of a double nut no longer carries anything.

    .. math:: F = 2^{3/2} F_{pr}

    What catalogues call about three times the preload (THK514E). Hertz contacts only.
    """
    F_pr = preload
    return 2**1.5 * F_pr
