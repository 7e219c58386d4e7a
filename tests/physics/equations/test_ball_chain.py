"""The chain of balls in closed form: limits, slopes of the kinematics, and the runs that the fit is of."""

import math

import numpy as np
import pytest

from ballscrew.physics.equations import ball_chain, geometry, kinematics
from support.equations import speed_deviation

#: A 40×10 with balls of 6 mm, in SI: curvature ratio, contact angle, distance of the groove centres, path radius.
GAMMA, ALPHA, DISTANCE, RADIUS = 0.1054, math.pi / 4, 480e-6, 0.02006


def test_a_micrometre_turns_the_contact_by_a_twelfth_of_a_degree():
    # ±1 µm of groove place at f = 0.54 and 6 mm: 0.085°, and 1.7e-4 of the speed; 2.1e-3 a degree
    change = ball_chain.contact_angle_change(1e-6, 0.0, ALPHA, DISTANCE)
    assert math.degrees(change) == pytest.approx(0.0844, abs=1e-4)
    assert speed_deviation(GAMMA, ALPHA, change, 0.0, RADIUS) == pytest.approx(1.74e-4, rel=5e-3)
    assert speed_deviation(GAMMA, ALPHA, math.radians(1), 0.0, RADIUS) == pytest.approx(2.06e-3, rel=5e-3)


@pytest.mark.parametrize("alpha", [0.5, 0.8, 1.1])
def test_the_deviation_is_the_slope_of_the_kinematics(alpha):
    d_w, d_m, phi, step = 6e-3, 0.04, 0.08, 1e-6

    def speed(angle, shift, ball=d_w):
        wide = d_m + 2 * shift
        L, gamma = geometry.path_radius(wide, phi), geometry.curvature_ratio(ball, wide, angle, phi)
        v = kinematics.entrainment_speed(1.0, L, gamma)
        return kinematics.orbital_speed(kinematics.orbital_rotation(v, geometry.nut_contact_radius(L, gamma)), L)

    gamma, L = geometry.curvature_ratio(d_w, d_m, alpha, phi), geometry.path_radius(d_m, phi)
    by_angle = (speed(alpha + step, 0.0) - speed(alpha - step, 0.0)) / (2 * step * speed(alpha, 0.0))
    assert by_angle == pytest.approx(speed_deviation(gamma, alpha, 1.0, 0.0, L), rel=1e-7)
    far = 1e-7
    by_shift = (speed(alpha, far) - speed(alpha, -far)) / (2 * far * speed(alpha, 0.0))
    # the shift of the path is along the helix, where the pitch circle is wider by twice it times the cosine
    assert by_shift / math.cos(phi) == pytest.approx(speed_deviation(gamma, alpha, 0.0, 1.0, L), rel=1e-2)


def test_creep_is_between_its_limits():
    mu, v, a = 0.0735, 0.094, 0.5e-3
    lateral = ball_chain.creep_coefficient_of_lateral_slip(mu, 2.26e-3, v)
    spin = ball_chain.creep_coefficient_of_spin(mu, 4.4, a, v)
    both = ball_chain.creep_coefficient(mu, 2.26e-3, 4.4, a, v)
    assert both == pytest.approx(0.95 / math.hypot(1 / lateral, 1 / spin), rel=1e-14)
    assert ball_chain.creep_coefficient(mu, 2.26e-3, 0.0, a, v) == pytest.approx(0.95 * lateral, rel=1e-14)
    assert ball_chain.creep_coefficient(mu, 0.0, 4.4, a, v) == pytest.approx(0.95 * spin, rel=1e-14)


#: Means over four seeds of grooves, two circuits a half at 5 % of the rating and 100 rpm, 0.7 and 1.5 um, gaps of 0.003
#: to 0.06 balls: relative gap, and share of the force without a gap.
RUNS = {
    "40x10x6": [(0.041, 1.04), (0.087, 0.859), (0.135, 0.625), (0.290, 0.186), (0.406, 0.053), (0.812, 0.0094)],
    "63x10x6": [(0.060, 0.894), (0.128, 0.657), (0.199, 0.383), (0.426, 0.0551), (0.597, 0.027)],
    "16x5x3": [(0.029, 0.931), (0.096, 0.628), (0.206, 0.335), (0.288, 0.144), (0.576, 0.0544), (0.617, 0.0426)],
}


@pytest.mark.parametrize("size", RUNS)
def test_the_fit_goes_through_the_runs_it_is_of(size):
    x, found = np.array(RUNS[size]).T
    assert np.max(np.abs(np.log(ball_chain.pushing_share(x) / found))) < math.log(2.1)


def test_a_gap_only_ever_frees():
    assert ball_chain.pushing_share(0.0) == 1
    assert np.all(np.diff(ball_chain.pushing_share(np.linspace(0, 5, 1000))) < 0)


def test_the_default_share_is_that_of_a_jammed_circuit_with_grooves_of_two_micrometres():
    # 40x10: ±2 µm along the axis turn the contacts as 1 µm root mean square in both directions does; c/Q 9.2, no gap
    assert 2e-6 / math.sqrt(2) * math.cos(ALPHA) == pytest.approx(1e-6)
    epsilon = ball_chain.rms_speed_deviation(GAMMA, ALPHA, 1e-6, DISTANCE)
    share = ball_chain.chain_force_share(9.2, epsilon, ball_chain.balls_of_a_turn(RADIUS, 6e-3), 1.0)
    assert share == pytest.approx(0.0075, rel=0.02)


def test_the_return_of_a_free_circuit_brakes():
    # eleven balls of 6 mm at 100 rpm in VG 100 at 40 °C, walls tenfold: some 0.06 N, and 0.54 N mm on the screw
    mass = ball_chain.ball_mass(6e-3, 7850.0)
    assert mass == pytest.approx(0.888e-3, rel=1e-3)
    f = ball_chain.return_resistance(0.1, mass, 9.80665, 0.0886, 6e-3, 0.094, 10.0)
    assert f == pytest.approx(0.1 * mass * 9.80665 + 3 * math.pi * 0.0886 * 6e-3 * 0.94, rel=1e-12)
    torque = ball_chain.return_torque(11 * f, RADIUS, GAMMA)
    assert torque == pytest.approx(11 * f * 0.094 / (0.094 / (RADIUS * (1 - GAMMA) / 2)), rel=1e-12)
    assert ball_chain.mean_return_push(11 * f, 2.0, 60.0) == pytest.approx(22 * f / 60, rel=1e-14)


def test_a_gap_is_measured_by_what_the_balls_could_lose():
    # 71 balls, 0.3 balls of gap, speeds that deviate by 1.2e-4: x is 12.4
    spread = ball_chain.natural_speed_range(1.2e-4)
    assert spread == pytest.approx(3.394e-4, rel=1e-3)
    assert ball_chain.relative_gap(0.3, 71, spread) == pytest.approx(0.3 / 71.3 / spread, rel=1e-14)
