r"""The paper as code: Olaru, Puiu, Balan & Puiu 2005, "A new model to estimate friction torque in a ball screw system".

Equations (1) to (36) in the paper's order and letters, as printed, on floats and arrays in SI (N, m, rad, Pa), to be
read with the paper in the other hand. The paper uses (22) to (26) twice. Where a correction is known, it stands below
the printed form with the suffix ``_corrected``, and says why. :func:`printed` and :func:`corrected` put them together:
the presets ``olaru2005`` and ``corrected`` of :class:`ballscrew.FrictionModel`, whose oracle in the tests this file is.

The suffixes ``s`` and ``n`` are screw and nut. What the paper leaves open is chosen here as in the presets:
:math:`Q = F/(z \sin\alpha)`, :math:`\mu_b = 0.1`, :math:`Y = 0.34`; :math:`F_B` is imposed, in the paper 1/z and 2/z N.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

# -- 2.1 Tangential forces on ball-race contact ellipses --------------------------------------------------------------


def F_R(E: Any, R_x: Any, k: Any, G: Any, U: Any, W: Any) -> Any:
    """(1) Hydrodynamic rolling force."""
    return 2.86 * E * R_x**2 * k**0.348 * G**0.022 * U**0.66 * W**0.47


def R_xn(d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(2) Radius in the rolling direction, ball and nut."""
    return 1 / (2 / d_w - 2 * np.cos(alpha) / (d_m + d_w * np.cos(alpha)))


def R_xs(d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(3) Radius in the rolling direction, ball and screw."""
    return 1 / (2 / d_w + 2 * np.cos(alpha) / (d_m - d_w * np.cos(alpha)))


def k(R_y: Any, R_x: Any) -> Any:
    """(4) Radii ratio."""
    return R_y / R_x


def R_y(f: Any, d_w: Any) -> Any:
    """(5) Radius across the rolling direction; f above 0.5."""
    return f * d_w / (2 * f - 1)


def G(E: Any, alpha_p: Any) -> Any:
    """(6) Material parameter."""
    return E * alpha_p


def U(eta_0: Any, v: Any, E: Any, R_x: Any) -> Any:
    """(7) Speed parameter."""
    return eta_0 * v / (E * R_x)


def v(n: Any, d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(8) Speed of the surfaces in both contacts; n in revolutions per minute, as the paper has it."""
    return np.pi * n / 30 * (1 - (d_w * np.cos(alpha) / d_m) ** 2) * d_m / 4


def W(Q: Any, E: Any, R_x: Any) -> Any:
    """(9) Load parameter."""
    return Q / (E * R_x**2)


def F_Pb(F_R: Any, R_R: Any, R_b: Any) -> Any:
    """(10) Pressure force through the centre of a ball on a ring; R_b counts negative in a concave ring."""
    return 2 * F_R * R_R / (R_R + R_b)


def F_Pnb(F_Rn: Any, d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(11) Pressure force, ball and nut."""
    return 2 * F_Rn * (1 + d_w * np.cos(alpha) / d_m)


def F_Psb(F_Rs: Any, d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(12) Pressure force, ball and screw."""
    return 2 * F_Rs * (1 - d_w * np.cos(alpha) / d_m)


def F_S(tau: Any, dA: Any) -> Any:
    """(13) Sliding force as the integral of the shear stress; the paper finds it from equilibrium instead."""
    return np.sum(tau * dA)


# -- 2.2 The moments developed in the ball-race contact ellipses ------------------------------------------------------


def M_C_integral(mu: Any, p: Any, z: Any, dA: Any) -> Any:
    """(14) Curvature friction moment as an integral; z counts from the line of pure rolling."""
    return np.sum(mu * p * z * dA)


def M_C(mu_m: Any, Q: Any, a: Any, R_d: Any, Y: Any) -> Any:
    """(15) Curvature friction moment; without spin, for 0 <= Y < 0.643."""
    return 0.1 * mu_m * Q * a**2 / R_d * (1 - 5 * Y**3 + 3 * Y**5)


def R_d(d_w: Any, f: Any) -> Any:
    """(16) Deformed radius."""
    return 2 * d_w * f / (2 * f + 1)


def Y(c: Any, a: Any) -> Any:
    """(17) Offset of the lines of pure rolling in units of the semi-major axis; the paper imposes 0.34."""
    return c / a


def a(R_x: Any, k: Any, W: Any) -> Any:
    """(18) Semi-major axis; a fit, 8.3 % long at the paper's screw."""
    return 1.1552 * R_x * k**0.4676 * W ** (1 / 3)


def b(R_x: Any, k: Any, W: Any) -> Any:
    """(19) Semi-minor axis; a fit, 2.1 % long at the paper's screw."""
    return 1.1502 * R_x * k ** (-0.1876) * W ** (1 / 3)


def a_b_corrected(R_x: Any, k: Any, W: Any) -> tuple[Any, Any]:
    """(18), (19) corrected: the ellipse of Hertz, whose ratio kappa solves k = kappa^2 B/D (Johnson1985 4.2); k > 1."""
    low, high = np.log(k) / 4, np.log(k)
    for _ in range(60):  # halves what is left of the interval
        middle = (low + high) / 2
        K, E = elliptic_integrals(np.exp(middle))
        D = (K - E) / (1 - np.exp(-2 * middle))
        is_below = np.exp(2 * middle) * (K - D) / D < k
        low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
    kappa = np.exp(low)
    a = R_x * (6 * kappa**2 * elliptic_integrals(kappa)[1] * k / (np.pi * (1 + k)) * W) ** (1 / 3)
    return a, a / kappa


def elliptic_integrals(kappa: Any) -> tuple[Any, Any]:
    """Complete elliptic integrals K and E of an ellipse of ratio kappa, by the arithmetic-geometric mean."""
    x, y, weight = np.ones_like(kappa), 1 / kappa, 0.5
    rest = weight * (1 - y**2)
    for _ in range(7):
        x, y, c = (x + y) / 2, np.sqrt(x * y), (x - y) / 2
        weight = 2 * weight
        rest = rest + weight * c**2
    return np.pi / (2 * x), np.pi / (2 * x) * (1 - rest)


def M_ER(d_w: Any, Q: Any, k: Any) -> Any:
    """(20) Elastic resistance to pure rolling; a fit for steel, in SI only."""
    return 7.48e-7 * (d_w / 2) ** 0.33 * Q**1.33 * (1 - 3.519e-3 * (k - 1) ** 0.806)


def M_B(mu_b: Any, F_B: Any, d_w: Any) -> Any:
    """(21) Braking moment between balls, of one neighbour."""
    return mu_b * F_B * d_w / 2


def M_B_corrected(mu_b: Any, F_B: Any, d_w: Any) -> Any:
    """(21) corrected: a ball in a chain touches two neighbours."""
    return 2 * M_B(mu_b, F_B, d_w)


def F_B_corrected(F_B: Any, M_B: Any, d_m: Any, alpha: Any) -> Any:
    """Net braking force in a chain that is as curved as the path: the rubbing of the neighbours has a lever there."""
    return F_B + 2 * M_B * np.cos(alpha) / d_m


# -- 3. Determination of sliding forces -------------------------------------------------------------------------------


def sum_of_forces(F_Ss: Any, F_Sn: Any, F_Rs: Any, F_Rn: Any, F_Psb: Any, F_Pnb: Any, F_B: Any) -> Any:
    """(22) of 3: forces on the ball along its path; zero in equilibrium."""
    return F_Ss - F_Sn - F_Rs + F_Rn + F_Psb - F_Pnb - F_B


def sum_of_moments(F_Ss: Any, F_Sn: Any, F_Rs: Any, F_Rn: Any, M: Any, M_B: Any, d_w: Any) -> Any:
    """(23) of 3: moments about the centre of the ball, M those of both contacts; zero in equilibrium."""
    return (F_Ss + F_Sn - F_Rs - F_Rn) * d_w / 2 - M - M_B


def F_Ss(M: Any, M_B: Any, F_Rs: Any, F_Rn: Any, F_B: Any, d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(24) of 3: sliding force at the screw, M = M_Cn + M_Cs + M_ERn + M_ERs; the text calls it F_Sc."""
    return (M + M_B) / d_w + F_Rn + (F_Rs + F_Rn) * d_w * np.cos(alpha) / d_m + F_B / 2


def F_Sn(M: Any, M_B: Any, F_Rs: Any, F_Rn: Any, F_B: Any, d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(25) of 3: sliding force at the nut; the text calls it F_Sg."""
    return (M + M_B) / d_w + F_Rs - (F_Rs + F_Rn) * d_w * np.cos(alpha) / d_m - F_B / 2


def Y_corrected(F_S: Any, mu_m: Any, Q: Any) -> Any:
    """(17) corrected: no choice, but where F_S = mu_m Q (1 - 3 Y + Y^3); at its end where the ball skids."""
    return 2 * np.sin(np.arcsin((1 - np.clip(F_S / (mu_m * Q), -1, 1)) / 2) / 3)


# -- 4. Film thickness in balls-races contacts ------------------------------------------------------------------------


def h(R_x: Any, U: Any, G: Any, W: Any, a: Any, b: Any, exponent: float = 0.66) -> Any:
    """(26) of 4: minimum film thickness; printed with the exponent 0.66 of U."""
    return 3.63 * R_x * U**exponent * G**0.49 * W**-0.073 * (1 - np.exp(-0.68 * a / b))


def h_corrected(R_x: Any, U: Any, G: Any, W: Any, a: Any, b: Any) -> Any:
    """(26) of 4 corrected: HamrockDowson1977 has the exponent 0.68; printed films are 1.55 to 1.70 times too thick."""
    return h(R_x, U, G, W, a, b, 0.68)


def lambda_(h: Any, sigma_b: Any, sigma_R: Any) -> Any:
    """(22) of 4: lubricant parameter as printed, without the square root: its unit is 1/m."""
    return h / (sigma_b**2 + sigma_R**2)


def lambda_corrected(h: Any, sigma_b: Any, sigma_R: Any) -> Any:
    """(22) of 4 corrected: with the square root."""
    return h / np.sqrt(sigma_b**2 + sigma_R**2)


# -- 5. Friction coefficient in contact ellipses ----------------------------------------------------------------------


def mu_a(lambda_: Any, mu_0: float = 0.2, B: float = 1.42, C: float = 0.8) -> Any:
    """(23) of 5: friction coefficient by asperities."""
    return mu_0 * np.exp(-B * lambda_**C)


def mu_m(mu_a: Any, mu_0: float = 0.2) -> Any:
    """(24), (25), (26) of 5: the coefficient between 0.02 and mu_0; the branch of (24) is reached at rest only."""
    return np.where(mu_a >= mu_0, mu_0, np.where(mu_a >= 0.02, mu_a, 0.02))


# -- 6. Friction torque developed in ball-screw and ball-nut contacts -------------------------------------------------


def F_s(M: Any, M_B: Any, F_Rs: Any, F_Rn: Any, F_B: Any, d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(27) Tangential force of a ball on the screw, F_Rs + F_Ss."""
    return (M + M_B) / d_w + F_Rn + F_Rs + (F_Rs + F_Rn) * d_w * np.cos(alpha) / d_m + F_B / 2


def M_s(F_s: Any, R_s: Any) -> Any:
    """(28) Friction torque of a ball on the screw."""
    return F_s * R_s


def M_s_corrected(F_s: Any, R_s: Any, M_s: Any, alpha: Any) -> Any:
    """(28) corrected: the screw also takes the moments of its contact, M_s = M_Cs + M_ERs."""
    return F_s * R_s + M_s * np.cos(alpha)


def R_s(d_m: Any, d_w: Any, alpha: Any) -> Any:
    """(29) Radius of the contact at the screw."""
    return d_m / 2 - d_w * np.cos(alpha) / 2


def F_n(M: Any, M_B: Any, F_Rs: Any, F_Rn: Any, F_B: Any, d_w: Any, d_m: Any, alpha: Any) -> Any:
    """(30) Tangential force of a ball on the nut, F_Rn + F_Sn."""
    return (M + M_B) / d_w + F_Rn + F_Rs - (F_Rs + F_Rn) * d_w * np.cos(alpha) / d_m - F_B / 2


def M_n(F_n: Any, R_n: Any) -> Any:
    """(31) Friction torque of a ball on the nut."""
    return F_n * R_n


def M_n_corrected(F_n: Any, R_n: Any, M_n: Any, alpha: Any) -> Any:
    """(31) corrected: the nut also takes the moments of its contact, M_n = M_Cn + M_ERn."""
    return F_n * R_n - M_n * np.cos(alpha)


def R_n(d_m: Any, d_w: Any, alpha: Any) -> Any:
    """(32) Radius of the contact at the nut."""
    return d_m / 2 + d_w * np.cos(alpha) / 2


def M_S(z: Any, M_s: Any) -> Any:
    """(33) Friction torque on the screw, of z balls alike."""
    return z * M_s


def M_N(z: Any, M_n: Any) -> Any:
    """(34) Friction torque on the nut, of z balls alike: the reaction, not a further loss."""
    return z * M_n


# -- 7. Estimation of the efficiency ----------------------------------------------------------------------------------


def M_Sa(F: Any, R_s: Any, p: Any, d_m: Any) -> Any:
    """(35) Torque without friction; low by the factor 1 - d_w cos(alpha)/d_m."""
    return F * R_s * p / (np.pi * d_m)


def M_Sa_corrected(F: Any, p: Any) -> Any:
    """(35) corrected: by virtual work."""
    return F * p / (2 * np.pi)


def eta(M_Sa: Any, M_S: Any) -> Any:
    """(36) Efficiency."""
    return M_Sa / (M_Sa + M_S)


# -- put together -----------------------------------------------------------------------------------------------------


class Case(NamedTuple):
    """A screw, its oil and its operating point, in SI but for the speed."""

    #: Diameter of the pitch circle, lead and ball diameter, m.
    d_m: Any
    p: Any
    d_w: Any
    #: Loaded balls.
    z: Any
    #: Contact angle, rad.
    alpha: Any
    #: Curvature parameters of screw and nut.
    f_s: Any
    f_n: Any
    #: Roughness of ball, screw and nut, m.
    sigma_b: Any
    sigma_s: Any
    sigma_n: Any
    #: Equivalent modulus, Pa.
    E: Any
    #: Viscosity, Pa s, and pressure-viscosity coefficient, 1/Pa.
    eta_0: Any
    alpha_p: Any
    #: Axial load, N, and speed, revolutions per minute.
    F: Any
    n: Any
    #: Force between balls, N, and its friction coefficient.
    F_B: Any
    mu_b: Any = 0.1


class Torques(NamedTuple):
    """Friction torques on screw and nut, the torque without friction (N m), and the efficiency."""

    M_S: Any
    M_N: Any
    M_Sa: Any
    eta: Any


def printed(case: Case, *, Y: Any = 0.34, literal_lambda: bool = False) -> Torques:
    """The paper as printed; with ``literal_lambda`` to the letter, without the square root that (22) of 4 needs."""
    d_m, p, d_w, z, alpha, f_s, f_n, sigma_b, sigma_s, sigma_n, E, eta_0, alpha_p, F, n, F_B, mu_b = case
    Q, speed = F / (z * np.sin(alpha)), v(n, d_w, d_m, alpha)
    F_r, M = {}, {}
    for race, R_x, f, sigma in (("s", R_xs, f_s, sigma_s), ("n", R_xn, f_n, sigma_n)):
        R = R_x(d_w, d_m, alpha)
        ratio = k(R_y(f, d_w), R)
        g, u, w = G(E, alpha_p), U(eta_0, speed, E, R), W(Q, E, R)
        F_r[race] = F_R(E, R, ratio, g, u, w)
        axes = a(R, ratio, w), b(R, ratio, w)
        film = h(R, u, g, w, *axes)
        mu = mu_m(mu_a((lambda_ if literal_lambda else lambda_corrected)(film, sigma_b, sigma)))
        M[race] = M_C(mu, Q, axes[0], R_d(d_w, f), Y) + M_ER(d_w, Q, ratio)
    ball = M["s"] + M["n"], M_B(mu_b, F_B, d_w), F_r["s"], F_r["n"], F_B, d_w, d_m, alpha
    radius = R_s(d_m, d_w, alpha)
    screw = M_S(z, M_s(F_s(*ball), radius))
    nut = M_N(z, M_n(F_n(*ball), R_n(d_m, d_w, alpha)))
    ideal = M_Sa(F, radius, p, d_m)
    return Torques(screw, nut, ideal, eta(ideal, screw))


def corrected(case: Case) -> Torques:
    """The paper with its misprints and missing reactions put right, and nothing added.

    The balls roll in the plane that touches their helix: all equations hold there with the diameter d_m/cos(phi) and
    the contact angle of cosine cos(alpha) cos(phi), phi the lead angle.
    """
    d_m, p, d_w, z, alpha, f_s, f_n, sigma_b, sigma_s, sigma_n, E, eta_0, alpha_p, F, n, F_B, mu_b = case
    phi = np.arctan(p / (np.pi * d_m))
    Q = F / (z * np.sin(alpha) * np.cos(phi))
    d_m, alpha = d_m / np.cos(phi), np.arccos(np.cos(alpha) * np.cos(phi))
    speed, M_b = v(n, d_w, d_m, alpha), M_B_corrected(mu_b, F_B, d_w)
    force = F_B_corrected(F_B, M_b, d_m, alpha)
    F_r, M_e, mu, axis, radius = {}, {}, {}, {}, {}
    for race, R_x, f, sigma in (("s", R_xs, f_s, sigma_s), ("n", R_xn, f_n, sigma_n)):
        R = R_x(d_w, d_m, alpha)
        ratio = k(R_y(f, d_w), R)
        g, u, w = G(E, alpha_p), U(eta_0, speed, E, R), W(Q, E, R)
        F_r[race] = F_R(E, R, ratio, g, u, w)
        axes = a_b_corrected(R, ratio, w)
        film = h_corrected(R, u, g, w, *axes)
        mu[race] = mu_m(mu_a(lambda_corrected(film, sigma_b, sigma)))
        M_e[race], axis[race], radius[race] = M_ER(d_w, Q, ratio), axes[0], R_d(d_w, f)
    M = dict(M_e)
    for _ in range(12):  # each step leaves less than a hundredth of the error
        ball = M["s"] + M["n"], M_b, F_r["s"], F_r["n"], force, d_w, d_m, alpha
        for race, F_slide in (("s", F_Ss(*ball)), ("n", F_Sn(*ball))):
            offset = Y_corrected(F_slide, mu[race], Q)
            M[race] = M_e[race] + M_C(mu[race], Q, axis[race], radius[race], offset)
    ball = M["s"] + M["n"], M_b, F_r["s"], F_r["n"], force, d_w, d_m, alpha
    screw = M_S(z, M_s_corrected(F_s(*ball), R_s(d_m, d_w, alpha), M["s"], alpha))
    nut = M_N(z, M_n_corrected(F_n(*ball), R_n(d_m, d_w, alpha), M["n"], alpha))
    ideal = M_Sa_corrected(F, p)
    return Torques(screw, nut, ideal, eta(ideal, screw))
