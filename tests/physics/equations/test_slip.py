"""Truth: friction of Coulomb under the pressure of Hertz, integrated over the line and over the ellipse."""

import math

import mpmath
import numpy as np
import pytest

from ballscrew.physics.equations import friction, slip
from oracles.contact_patch import ContactPatch, Ellipse
from oracles.tractions import Coulomb
from support.equations import line_traction_ratio

RELATIVE = 1e-13

#: Spin parameters and traction ratios that leave two lines of pure rolling in the ellipse.
TWO_LINES = [(0.0, 0.0), (0.1, 0.0), (0.364, -0.3), (0.5, 0.2), (0.9, 0.05), (1.3, 0.6), (0.05, -0.9), (0.3, 0.97)]
TRACTIONS = [-0.95, -0.5, -0.05, 0.0, 1e-9, 0.3, 0.8, 0.99]


def lines(spin_parameter, traction_ratio):
    half = slip.half_distance_of_lines(spin_parameter, traction_ratio)
    return -spin_parameter / 2 - half, -spin_parameter / 2 + half


def along_the_line(t_1, t_2):
    """Force, curvature moment and spin moment of friction that points backwards between two heights."""
    with mpmath.workdps(30):

        def sums(lever):
            def pieces(low, high):
                return mpmath.quad(lambda t: mpmath.mpf(3) / 4 * (1 - t**2) * lever(t), [low, high])

            return pieces(-1, t_1) - pieces(t_1, t_2) + pieces(t_2, 1)

        return [float(sums(lever)) for lever in (lambda t: 1, lambda t: t**2 / 2, lambda t: t)]


# -- speeds ---------------------------------------------------------------------------------------


def test_curvature_slip_is_the_depth_of_a_circle_times_the_rotation():
    # 300 rad/s about an axis in the plane of the contact's top: speed is rotation times depth
    a, R_d, Omega = 2e-4, 3e-3, 300.0
    C = slip.curvature_slip_speed(a, R_d, Omega)
    assert pytest.approx(300.0 * 4e-8 / 6e-3, rel=RELATIVE) == C
    for t in (0.0, 0.3, -0.7, 1.0):
        depth = R_d - math.sqrt(R_d**2 - (a * t) ** 2)
        assert slip.surface_depth(t, a, R_d) * C == pytest.approx(Omega * depth, rel=1e-9)


@pytest.mark.parametrize("t", [-1.0, -0.4, 0.0, 0.2, 0.9])
@pytest.mark.parametrize("a", [1e-6, 1e-3, 2.9e-3])
def test_surface_depth_is_that_of_a_circle(t, a):
    R_d = 3e-3
    with mpmath.workdps(40):
        y, R = mpmath.mpf(a) * mpmath.mpf(t), mpmath.mpf(R_d)
        expected = float((R - mpmath.sqrt(R**2 - y**2)) / (mpmath.mpf(a) ** 2 / (2 * R)))
    assert slip.surface_depth(t, a, R_d) == pytest.approx(expected, rel=RELATIVE)


def test_surface_depth_of_small_and_of_impossible_contacts():
    assert slip.surface_depth(0.6, 1e-9, 3e-3) == pytest.approx(0.36, rel=1e-12)
    # wider than the circle: its rim, twice the depth of the parabola, and no NaN
    assert slip.surface_depth(1.0, 4e-3, 3e-3) == 2.0


def test_path_slip_adds_creep_spin_and_curvature():
    assert slip.path_slip_speed(-0.01, 0.04, 0.1, 0.5, 0.25) == pytest.approx(0.035, rel=RELATIVE)


@pytest.mark.parametrize("t", [-0.8, 0.0, 0.5])
def test_local_spin_is_the_slope_of_the_path_slip(t):
    A, beta, C, step = 0.02, 0.05, 0.08, 1e-6
    low, high = (slip.path_slip_speed(A, beta, C, t + d, (t + d) ** 2) for d in (-step, step))
    assert slip.local_spin_speed(beta, C, t) == pytest.approx((high - low) / (2 * step), rel=1e-8)


# -- on the line ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("E_s", "T"), TWO_LINES)
def test_the_slip_vanishes_on_both_lines_and_carries_the_traction(E_s, T):
    t_1, t_2 = lines(E_s, T)
    assert -1 <= t_1 < t_2 <= 1
    # with C = 1 the spin's rim speed is E_s, and there is a creep that puts both zeros there
    creep = t_1 * t_2
    for t in (t_1, t_2):
        assert slip.path_slip_speed(creep, E_s, 1.0, t, t**2) == pytest.approx(0, abs=1e-14)
    assert line_traction_ratio(t_1, t_2) == pytest.approx(T, rel=0, abs=1e-14)


@pytest.mark.parametrize(("E_s", "T"), TWO_LINES)
def test_forces_of_two_lines_are_integrals(E_s, T):
    t_1, t_2 = lines(E_s, T)
    force, curvature, spin = along_the_line(t_1, t_2)
    assert line_traction_ratio(t_1, t_2) == pytest.approx(force, rel=0, abs=1e-14)
    assert slip.line_curvature_coefficient(t_1, t_2) == pytest.approx(curvature, rel=0, abs=1e-15)
    assert 3 / 8 * slip.line_spin_coefficient(t_1, t_2) == pytest.approx(spin, rel=0, abs=1e-15)


@pytest.mark.parametrize("T", TRACTIONS)
def test_forces_of_a_single_line_are_integrals(T):
    t_1 = slip.single_line(T)
    force, curvature, spin = along_the_line(-1.0, t_1)
    assert force == pytest.approx(T, rel=0, abs=1e-14)
    assert line_traction_ratio(-1.0, t_1) == pytest.approx(T, rel=0, abs=1e-14)
    assert slip.line_curvature_coefficient(-1.0, t_1) == pytest.approx(curvature, rel=0, abs=1e-15)
    assert 3 / 8 * slip.line_spin_coefficient(-1.0, t_1) == pytest.approx(spin, rel=0, abs=1e-15)


@pytest.mark.parametrize("T", TRACTIONS)
@pytest.mark.equation("Olaru2005 §2.2 (15)", "Olaru2005 §2.2 (17)")
def test_without_spin_it_is_the_paper(T):
    Y = slip.half_distance_of_lines(0.0, T)
    assert friction.offset_from_traction(T) == Y
    assert line_traction_ratio(-Y, Y) == pytest.approx(friction.traction_ratio(Y), rel=0, abs=1e-15)
    expected = friction.curvature_friction_moment(1.0, 1.0, 1.0, 1.0, Y)
    assert slip.line_curvature_coefficient(-Y, Y) == pytest.approx(expected, rel=0, abs=2e-17)
    assert slip.line_spin_coefficient(-Y, Y) == 0


def test_pure_spin():
    # without net force the line lies in the middle: no curvature moment, and the spin moment of a disc
    assert slip.single_line(0.0) == 0
    assert slip.line_curvature_coefficient(-1.0, 0.0) == pytest.approx(0, abs=1e-16)
    assert slip.line_spin_coefficient(-1.0, 0.0) == 1


def test_slip_one_way_only():
    assert slip.single_line(1.0) == pytest.approx(-1, rel=RELATIVE)
    assert slip.single_line(-1.0) == pytest.approx(1, rel=RELATIVE)
    assert slip.line_curvature_coefficient(-1.0, -1.0) == pytest.approx(0.1, rel=RELATIVE)
    assert slip.line_curvature_coefficient(-1.0, 1.0) == pytest.approx(-0.1, rel=RELATIVE)


@pytest.mark.parametrize("T", TRACTIONS)
def test_two_lines_become_one_where_the_lower_leaves_the_ellipse(T):
    single = slip.single_line(T)
    E_s = 1 - single
    t_1, t_2 = lines(E_s, T)
    # the slope of T over the lower line vanishes at the rim, so rounding of T is seen as its root
    assert t_1 == pytest.approx(-1, rel=0, abs=1e-7)
    assert t_2 == pytest.approx(single, rel=0, abs=1e-7)


# -- Houpert's polynomials ------------------------------------------------------------------------


def test_polynomials_of_houpert_follow_the_closed_form():
    E_s = np.linspace(0, 1, 2001)
    t_1, t_2 = lines(E_s, 0.0)
    without_spin = slip.line_curvature_coefficient(t_1[0], t_2[0])
    off_curvature = slip.curvature_factor_polynomial(E_s) - slip.line_curvature_coefficient(t_1, t_2) / without_spin
    off_spin = slip.spin_factor_polynomial(E_s) - slip.line_spin_coefficient(t_1, t_2)
    assert 0.0090 < np.max(np.abs(off_curvature)) < 0.0093
    assert 0.0079 < np.max(np.abs(off_spin)) < 0.0082


def test_polynomials_of_houpert_are_useless_beyond_one():
    assert slip.curvature_factor_polynomial(2.0) > 5
    assert slip.spin_factor_polynomial(3.0) < -5


# -- over the ellipse -----------------------------------------------------------------------------


def test_cell_slip_is_the_root_of_the_mean_square():
    # slip that is linear in the cell: along s + g y, across D - g x, with what the cell's points scatter
    s, g, D = 0.03, -0.2, 0.01
    y, x = np.meshgrid(np.linspace(-0.11, 0.13, 7), np.linspace(-0.2, 0.4, 9))
    y, x = y - y.mean(), x - x.mean()
    variance = np.mean(x**2 + y**2)
    expected = math.sqrt(np.mean((s + g * y) ** 2 + (D - g * x) ** 2))
    assert slip.cell_slip_speed(s, g, D, variance) == pytest.approx(expected, rel=RELATIVE)


def test_cell_slip_is_convex_in_creep_spin_and_lateral_slip():
    rng = np.random.default_rng(5)
    C, t, V = 0.05, rng.uniform(-1, 1, 5000), rng.uniform(1e-4, 0.1, 5000)

    def speed(A, beta, D):
        return slip.cell_slip_speed(slip.path_slip_speed(A, beta, C, t, t**2), slip.local_spin_speed(beta, C, t), D, V)

    one, other = rng.normal(0, 0.1, (2, 3, 5000))
    for weight in (0.1, 0.5, 0.8):
        between = speed(*(weight * one + (1 - weight) * other))
        assert np.all(between <= weight * speed(*one) + (1 - weight) * speed(*other) + 1e-15)


def mean_slip(creep, rim, C, lateral, kappa, size):
    """Mean slip over the ellipse, weighted by pressure, with cells that are points of a quadrature."""
    x, w = np.polynomial.legendre.leggauss(size)
    # t = sin(angle) and x = sqrt(1 - t²) sin(other angle): smooth, also where the pressure ends
    t, along = np.sin(np.pi / 2 * x)[:, None], np.sin(np.pi / 2 * x)
    weight_t = np.pi / 2 * w[:, None] * np.cos(np.pi / 2 * x)[:, None]
    weight = weight_t * np.pi / 2 * w * np.cos(np.pi / 2 * x) ** 2 * (1 - t**2) * 3 / (2 * np.pi)
    assert weight.sum() == pytest.approx(1, rel=1e-9)
    g = slip.local_spin_speed(rim, C, t)
    across = lateral - along * np.sqrt(1 - t**2) / kappa * g
    s = slip.path_slip_speed(creep, rim, C, t, t**2)
    return np.sum(weight * np.hypot(s, across)), math.sqrt(np.sum(weight * (s**2 + across**2)))


def mean_slip_of_strips(creep, rim, C, lateral, kappa, number):
    """The same over strips of the ellipse, each one cell."""
    edges = np.linspace(-1, 1, number + 1)

    def moment(power):
        return np.diff(0.75 * (edges ** (power + 1) / (power + 1) - edges ** (power + 3) / (power + 3)))

    share, height = moment(0), moment(1) / moment(0)
    spread = moment(2) / share - height**2
    g = slip.local_spin_speed(rim, C, height)
    s = slip.path_slip_speed(creep, rim, C, height, height**2 + spread)
    variance = spread + (1 - height**2) / (4 * kappa**2)
    return np.sum(share * slip.cell_slip_speed(s, g, lateral, variance))


@pytest.mark.parametrize(
    ("creep", "rim", "lateral", "kappa"),
    [(-0.12, 0.0, 0.05, 10.0), (-0.05, 0.4, 0.02, 6.0), (0.1, 1.5, 0.0, 8.0), (-0.1, 0.2, 1.0, 12.0)],
)
def test_strips_sum_to_the_integral_over_the_ellipse(creep, rim, lateral, kappa):
    exact, _ = mean_slip(creep, rim, 1.0, lateral, kappa, 400)
    # a root of mean squares is never below the mean, and closes in on it as strips get narrow
    few, more, many = (mean_slip_of_strips(creep, rim, 1.0, lateral, kappa, n) for n in (6, 12, 96))
    assert exact * (1 - 1e-6) <= many <= more <= few
    assert more == pytest.approx(exact, rel=0.03)
    assert many == pytest.approx(exact, rel=0.02)


def test_nominal_sliding_speed_is_the_root_of_the_mean_square_over_the_ellipse():
    Y = 2 * math.sin(math.radians(10))
    for rim, lateral, kappa in ((0.0, 0.0, 9.0), (0.5, 0.0, 3.0), (0.3, 0.2, 9.0), (0.0, 1.0, 1.5)):
        # curvature alone, its lines at Y; the local spin that goes with curvature does not count
        found = slip.nominal_sliding_speed(1.0, rim, lateral, kappa)
        curvature = mean_slip(-(Y**2), 0.0, 1.0, 0.0, 1e9, 200)[1]
        others = mean_slip(0.0, rim, 0.0, lateral, kappa, 200)[1]
        assert found == pytest.approx(math.hypot(curvature, others), rel=3e-4)  # 0.052 is 0.0520163
    assert slip.nominal_sliding_speed(1.0, 0.0, 0.0, 9.0) ** 2 == pytest.approx(0.052, rel=1e-12)


@pytest.mark.parametrize("x", [-0.15, 0.0, 0.1])
def test_the_slip_is_that_of_a_turning_and_rolling_surface(x):
    # the patch of the contact integral has vectors in space: a twist of creep, lateral slip, spin and rolling
    a, R_d, creep, lateral, spin, rolling = 4e-4, 6e-3, -3e-3, 2e-3, 11.0, 150.0
    patch = ContactPatch.of(Ellipse(a, 0.2 * a, 1e9, R_d), Coulomb(0.1), (8, 5))
    s_t, s_c = patch.slip(np.array([creep, lateral, 0.0, -rolling, -spin]))
    t, place = patch.across / a, patch.along / a
    C = slip.curvature_slip_speed(a, R_d, rolling)
    along = slip.path_slip_speed(creep, spin * a, C, t, slip.surface_depth(t, a, R_d))
    assert along == pytest.approx(s_t, rel=1e-12)
    across = slip.across_slip_speed(lateral, slip.local_spin_speed(spin * a, C, t), place)
    # the normals lean: (a/R_d)² of it
    assert across == pytest.approx(s_c, abs=5e-3 * np.max(np.abs(s_c)))
    assert slip.across_slip_speed(lateral, 0.03, x) == pytest.approx(lateral - 0.03 * x, rel=RELATIVE)
