"""Losses of a nut beside its loaded contacts: seals, churning, return of the balls."""

from __future__ import annotations

from typing import Annotated

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Array, Count, Density, Force, Length, Ratio, Speed, Torque, Unit, Viscosity

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
