"""Truth: the two equilibria solved as linear equations, and the paper's printed forms."""

import math

import numpy as np
import pytest

from ballscrew.physics.equations import equilibrium, geometry, kinematics, rolling

from .numbers import SCREWS

every_screw = pytest.mark.parametrize(("d_m", "d_w", "alpha", "f"), SCREWS.values(), ids=SCREWS)

#: Rolling forces, curvature and elastic moments of screw and nut, ball friction, force between balls.
F_RS, F_RN = 4.198e-2, 4.222e-2
M_CS, M_CN, M_ERS, M_ERN = 9.241e-5, 8.509e-5, 3.873e-5, 3.896e-5
M_B, F_B = 2.835e-6, 1 / 56
MOMENTS = M_CS + M_CN + M_ERS + M_ERN


def sliding_forces(d_m, d_w, alpha):
    gamma = d_w * math.cos(alpha) / d_m
    arguments = (MOMENTS, M_B, d_w, F_RS, F_RN, gamma, F_B)
    return equilibrium.screw_sliding_force(*arguments), equilibrium.nut_sliding_force(*arguments)


@every_screw
@pytest.mark.equation("Olaru2005 §3 (22)", "Olaru2005 §3 (24)", "Olaru2005 §3 (25)")
def test_the_sliding_forces_balance_the_forces(d_m, d_w, alpha, f):
    gamma = d_w * math.cos(alpha) / d_m
    F_Ps, F_Pn = rolling.screw_pressure_force(F_RS, gamma), rolling.nut_pressure_force(F_RN, gamma)
    F_Ss, F_Sn = sliding_forces(d_m, d_w, alpha)
    assert equilibrium.force_imbalance(F_Ss, F_Sn, F_RS, F_RN, F_Ps, F_Pn, F_B) == pytest.approx(0.0, abs=1e-15)
    # not by chance: a newton more at the screw is a newton of imbalance
    assert equilibrium.force_imbalance(F_Ss + 1, F_Sn, F_RS, F_RN, F_Ps, F_Pn, F_B) == pytest.approx(1.0, rel=1e-13)


@every_screw
@pytest.mark.equation("Olaru2005 §3 (23)", "Olaru2005 §3 (24)", "Olaru2005 §3 (25)")
def test_the_sliding_forces_balance_the_moments(d_m, d_w, alpha, f):
    F_Ss, F_Sn = sliding_forces(d_m, d_w, alpha)
    assert equilibrium.moment_imbalance(F_Ss, F_Sn, F_RS, F_RN, MOMENTS, M_B, d_w) == pytest.approx(0.0, abs=1e-18)
    more = equilibrium.moment_imbalance(F_Ss, F_Sn + 1, F_RS, F_RN, MOMENTS, M_B, d_w)
    assert more == pytest.approx(d_w / 2, rel=1e-12)


@every_screw
@pytest.mark.equation(
    "Olaru2005 §2.1 (13)", "Olaru2005 §3 (22)", "Olaru2005 §3 (23)", "Olaru2005 §3 (24)", "Olaru2005 §3 (25)"
)
def test_the_sliding_forces_are_the_only_solution(d_m, d_w, alpha, f):
    # Two equations for the two integrals of shear (13), solved without them. Along the path, the screw
    # driving: T_s - T_n = F_Rs - F_Rn - F_Ps + F_Pn + F_B. About the ball's centre, with the lever d_w/2 of
    # all four surface forces: T_s + T_n = F_Rs + F_Rn + (moments)/(d_w/2).
    gamma = d_w * math.cos(alpha) / d_m
    F_Ps, F_Pn = 2 * F_RS * (1 - gamma), 2 * F_RN * (1 + gamma)
    solution = np.linalg.solve(
        [[1.0, -1.0], [1.0, 1.0]], [F_RS - F_RN - F_Ps + F_Pn + F_B, F_RS + F_RN + (MOMENTS + M_B) / (d_w / 2)]
    )
    np.testing.assert_allclose(sliding_forces(d_m, d_w, alpha), solution, rtol=1e-12)


@pytest.mark.equation("Olaru2005 §6 (28)", "Olaru2005 §6 (33)")
def test_screw_torque_of_the_paper():
    # reference sheet: mpmath, 40 digits
    torque = equilibrium.race_torque(1.79123022090863937e-1, 1.88774679848663558e-2)
    assert equilibrium.total_friction_torque(56, torque) == pytest.approx(1.89357790432876407e-1, rel=1e-13)


@pytest.mark.equation("Olaru2005 §6 (31)", "Olaru2005 §6 (34)")
def test_nut_torque_of_the_paper():
    # reference sheet: mpmath, 40 digits
    torque = equilibrium.race_torque(1.51813928789248841e-1, 2.11225320151336442e-2)
    assert equilibrium.total_friction_torque(56, torque) == pytest.approx(1.79574895986871162e-1, rel=1e-13)


@pytest.mark.equation("Olaru2005 §6 (33)", "Olaru2005 §6 (34)")
def test_the_total_is_the_sum_over_equal_balls():
    assert equilibrium.total_friction_torque(56, 3.38e-3) == pytest.approx(math.fsum([3.38e-3] * 56), rel=1e-14)


def race_torques(d_m, d_w, alpha, braking):
    """Torques of one ball with the contact moments, the ball in equilibrium with a braking force."""
    gamma = d_w * math.cos(alpha) / d_m
    arguments = (MOMENTS, M_B, d_w, F_RS, F_RN, gamma, braking)
    F_s = equilibrium.tangential_force(F_RS, equilibrium.screw_sliding_force(*arguments))
    F_n = equilibrium.tangential_force(F_RN, equilibrium.nut_sliding_force(*arguments))
    R_s, R_n = d_m / 2 * (1 - gamma), d_m / 2 * (1 + gamma)
    cosine = math.cos(alpha)
    return (
        equilibrium.balanced_screw_torque(F_s, R_s, M_CS + M_ERS, cosine),
        equilibrium.balanced_nut_torque(F_n, R_n, M_CN + M_ERN, cosine),
    )


@every_screw
@pytest.mark.equation("Olaru2005 §6 (27)", "Olaru2005 §6 (28)", "Olaru2005 §6 (30)", "Olaru2005 §6 (31)")
def test_with_the_contact_moments_action_is_reaction(d_m, d_w, alpha, f):
    # Seen from outside, screw and nut differ by the moment of the chain's force about the screw's axis alone.
    braking = equilibrium.chain_braking_force(F_B, M_B, d_m / 2, math.cos(alpha))
    screw, nut = race_torques(d_m, d_w, alpha, braking)
    assert screw - nut == pytest.approx(F_B * d_m / 2, rel=1e-10)


def test_a_straight_chain_does_not_brake():
    assert equilibrium.chain_braking_force(F_B, M_B, 1e12, 0.7) == pytest.approx(F_B, rel=1e-14)
    # Two neighbours each with M_B/2: their friction forces meet at the angle the chain makes at the ball.
    assert equilibrium.chain_braking_force(0.0, M_B, 0.02, 1.0) == pytest.approx(M_B / 0.02, rel=1e-14)


@pytest.mark.parametrize("phi", [0.0, 0.04, 0.3])
def test_spin_and_torsion_torques_are_virtual_work(phi):
    # the torque's power is that of the moment in the spin, and of the force in the lateral slip
    omega, alpha, d_w, M_P, F_L = 62.8, 0.7, 6.35e-3, 2e-4, 0.3
    s_alpha = geometry.rolling_plane_sine(alpha, phi)
    spin = equilibrium.spin_torque(M_P, s_alpha) * omega
    assert spin == pytest.approx(M_P * kinematics.relative_spin(omega, s_alpha), rel=1e-13)
    torsion = equilibrium.torsion_torque(F_L, d_w, phi) * omega
    assert torsion == pytest.approx(F_L * kinematics.torsion_speed(omega, d_w, phi), rel=1e-13)
