"""Olaru 2005 as a script would have it, on whole arrays, equation after equation: what benchmarks compare with."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

#: What the script returns, in order, by the names of the package.
OUTPUTS = (
    "screw_torque",
    "nut_torque",
    "efficiency",
    "screw_film_parameter",
    "nut_film_parameter",
    "screw_friction_coefficient",
    "nut_friction_coefficient",
)

#: The paper's screw, oil and coefficients, in SI; any of them may be an array.
PARAMETERS: dict[str, Any] = {
    "d_m": 0.040, "p": 0.005, "d_w": 3.175e-3, "z": 56.0, "alpha": np.pi / 4, "f_s": 0.515, "f_n": 0.515,
    "sigma_b": 0.08e-6, "sigma_s": 0.3e-6, "sigma_n": 0.3e-6, "alpha_p": 2.2e-8, "F_B": 1 / 56, "mu_b": 0.1, "Y": 0.34,
    "speed_exponent": 0.66, "mu_0": 0.2, "B": 1.42, "C": 0.8, "mu_f": 0.02,
}  # fmt: skip


def formulas_on_arrays(F: Any, omega: Any, eta_0: Any, **changed: Any) -> tuple[NDArray[Any], ...]:
    """Both torques, efficiency, and film parameter and friction coefficient at screw and nut."""
    d_m, p, d_w, z, alpha, f_s, f_n, sigma_b, sigma_s, sigma_n, alpha_p, F_B, mu_b, Y, e, mu_0, B, C, mu_f = (
        PARAMETERS | changed
    ).values()
    E = 2 / (2 * (1 - 0.3**2) / 2.06e11)
    gamma = d_w * np.cos(alpha) / d_m
    Q = F / (z * np.sin(alpha))
    v = omega * d_m / 4 * (1 - gamma**2)

    def contact(sign: float, f: Any, sigma_r: Any) -> tuple[Any, ...]:
        R_x = d_w / 2 * (1 + sign * gamma)
        R_y = f * d_w / (2 * f - 1)
        k = R_y / R_x
        G = alpha_p * E
        U = eta_0 * v / (E * R_x)
        W = Q / (E * R_x**2)
        F_R = 2.86 * E * R_x**2 * k**0.348 * G**0.022 * U**0.66 * W**0.47
        a = 1.1552 * R_x * k**0.4676 * (Q / (E * R_x**2)) ** (1 / 3)
        b = 1.1502 * R_x * k**-0.1876 * (Q / (E * R_x**2)) ** (1 / 3)
        h = 3.63 * R_x * U**e * G**0.49 * W**-0.073 * (1 - np.exp(-0.68 * a / b))
        lam = h / np.sqrt(sigma_b**2 + sigma_r**2)
        mu_a = mu_0 * np.exp(-B * lam**C)
        mu = np.where(mu_a >= mu_0, mu_0, np.where(mu_a >= mu_f, mu_a, mu_f))
        R_d = 2 * d_w * f / (2 * f + 1)
        M_C = 0.1 * mu * Q * a**2 / R_d * (1 - 5 * Y**3 + 3 * Y**5)
        M_ER = 7.48e-7 * (d_w / 2) ** 0.33 * Q**1.33 * (1 - 3.519e-3 * (k - 1) ** 0.806)
        return F_R, lam, mu, M_C + M_ER

    F_Rs, lam_s, mu_s, M_s = contact(-1, f_s, sigma_s)
    F_Rn, lam_n, mu_n, M_n = contact(+1, f_n, sigma_n)
    M_B = mu_b * F_B * d_w / 2
    F_Ss = (M_s + M_n + M_B) / d_w + F_Rn + (F_Rs + F_Rn) * gamma + F_B / 2
    F_Sn = (M_s + M_n + M_B) / d_w + F_Rs - (F_Rs + F_Rn) * gamma - F_B / 2
    R_s, R_n = d_m / 2 * (1 - gamma), d_m / 2 * (1 + gamma)
    M_S = z * (F_Rs + F_Ss) * R_s
    M_N = z * (F_Rn + F_Sn) * R_n
    M_Sa = F * R_s * p / (np.pi * d_m)
    return M_S, M_N, M_Sa / (M_Sa + M_S), lam_s, lam_n, mu_s, mu_n
