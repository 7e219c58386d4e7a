"""Truth: what the torque puts in is what the mechanisms take, for one ball with made-up forces."""

import math

import pytest

from ballscrew.physics.equations import heat, kinematics

from .numbers import SCREWS
from .test_equilibrium import F_B, F_RN, F_RS, M_B, M_CN, M_CS, M_ERN, M_ERS, race_torques


@pytest.mark.parametrize(("d_m", "d_w", "alpha", "f"), SCREWS.values(), ids=SCREWS)
@pytest.mark.equation("Olaru2005 §6 (28)", "Olaru2005 §6 (31)")
def test_power_in_is_power_dissipated(d_m, d_w, alpha, f):
    omega = 62.8
    gamma = d_w * math.cos(alpha) / d_m
    L, R_s, R_n = d_m / 2, d_m / 2 * (1 - gamma), d_m / 2 * (1 + gamma)
    v = omega * L / 2 * (1 - gamma**2)
    ball, screw, orbital = 2 * v / d_w, v / R_s, v / R_n
    at_screw = kinematics.screw_contact_rotation(ball, screw, math.cos(alpha))
    at_nut = kinematics.nut_contact_rotation(ball, orbital, math.cos(alpha))
    taken = (
        heat.hydrodynamic_rolling_power(F_RS, F_RN, v, v)
        + heat.contact_moment_power(M_CS, M_CN, at_screw, at_nut)
        + heat.contact_moment_power(M_ERS, M_ERN, at_screw, at_nut)
        + heat.ball_rubbing_power(M_B, ball)
        + heat.chain_braking_power(F_B, orbital * L)
    )
    braking = F_B + M_B * math.cos(alpha) / L
    torque, _ = race_torques(d_m, d_w, alpha, braking)
    assert torque * omega == pytest.approx(taken, rel=1e-12)


def test_powers_are_forces_times_speeds():
    assert heat.hydrodynamic_rolling_power(0.04, 0.05, 0.6, 0.7) == pytest.approx(0.118, rel=1e-14)
    assert heat.contact_moment_power(1e-4, 2e-4, 300.0, 200.0) == pytest.approx(0.07, rel=1e-14)
    assert heat.creep_power(0.3, 0.2, 1e-3, -2e-3) == pytest.approx(-1e-4, rel=1e-12)
    assert heat.spin_power(2e-4, 40.0) == pytest.approx(8e-3, rel=1e-14)
    assert heat.torsion_power(0.5, 4e-3) == pytest.approx(2e-3, rel=1e-14)
    assert heat.ball_rubbing_power(3e-6, 400.0) == pytest.approx(0.0012, rel=1e-14)
    assert heat.chain_braking_power(0.02, 0.5) == pytest.approx(0.01, rel=1e-14)
