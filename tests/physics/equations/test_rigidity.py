"""Truth: Lamé's equation solved by differences, limits of the cylinders, a vendor's formulas of the shaft."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from ballscrew.physics.equations import rigidity

E, NU = 2.1e11, 0.3


def opened_by_integration(outer, inner, pressure, solid):
    """Radial displacement where a pressure acts: u'' + u'/r - u/r² = 0 with the stresses at both faces."""

    def slopes(r, y):
        return np.vstack([y[1], -y[1] / r + y[0] / r**2])

    def stress(r, y):
        return E / (1 - NU**2) * (y[1] + NU * y[0] / r)

    def faces(at_inner, at_outer):
        if solid:  # no displacement in the middle, the pressure outside
            return np.array([at_inner[0] * 1e12, stress(outer, at_outer) + pressure])
        return np.array([stress(inner, at_inner) + pressure, stress(outer, at_outer)])

    r = np.linspace(inner, outer, 200)
    found = solve_bvp(slopes, faces, r, np.vstack([1e-7 * r / outer, 1e-7 / outer + 0 * r]), tol=1e-8, max_nodes=20_000)
    assert found.success
    return found.sol(inner if not solid else outer)[0]


@pytest.mark.parametrize("outer", [0.050, 0.063, 0.125])
def test_widening_is_that_of_an_elastic_tube_and_a_solid_shaft(outer):
    """One radial force on both: u of the tube less u of the shaft, by integrating the equation of the cylinder."""
    D_c, d_c, L, force = 0.0442, 0.0358, 0.06, 1e4
    tube = opened_by_integration(outer / 2, D_c / 2, force / (math.pi * D_c * L), solid=False)
    shaft = opened_by_integration(d_c / 2, 1e-7, force / (math.pi * d_c * L), solid=True)
    compliance = rigidity.radial_compliance(outer, D_c, E, NU, E, NU)
    assert force / rigidity.radial_stiffness(compliance, L) == pytest.approx(tube - shaft, rel=1e-5)


def test_limits_of_the_wall():
    """A thick wall gives 2/E whatever Poisson's ratio; a thin one is a hoop, (D/2)/(E t)."""
    assert rigidity.radial_compliance(1e3, 0.04, E, NU, E, NU) == pytest.approx(2 / E, rel=1e-8)
    assert rigidity.radial_compliance(1e3, 0.04, E, 0.1, E, 0.1) == pytest.approx(2 / E, rel=1e-8)
    wall = 1e-7
    hoop = 0.04 / 2 / wall / E
    assert rigidity.radial_compliance(0.04 + 2 * wall, 0.04, E, NU, E, NU) == pytest.approx(hoop, rel=1e-4)
    outer = np.linspace(0.045, 0.2, 50)
    assert np.all(np.diff(rigidity.radial_compliance(outer, 0.0442, E, NU, E, NU)) < 0)


def test_a_gap_moves_the_nut_by_its_lever():
    """Work: F x = N u at any angle, as x = u/(tan α cos φ) and N = F/(tan α cos φ)."""
    k, alpha, phi, force = 3e9, math.radians(40), math.radians(12), 800.0
    lever = math.tan(alpha) * math.cos(phi)
    x = force / rigidity.widening_rigidity(k, alpha, phi)
    push = force / lever
    assert force * x == pytest.approx(push * (push / k), rel=1e-13)


def test_preloaded_halves_up_to_lift_off():
    """Two Hertz springs against each other: at 2^1.5 of the preload the moved half is relieved, and R is the secant."""
    K, preload = 4e12, 3000.0
    rest = (preload / K) ** (2 / 3)
    load = K * (2 * rest) ** 1.5
    assert load == pytest.approx(2**1.5 * preload, rel=1e-13)
    assert rigidity.preloaded_ball_track_rigidity(preload, rest) == pytest.approx(load / rest, rel=1e-13)
    # a small load moves it less for each newton
    tangent = 2 * 1.5 * K * math.sqrt(rest)
    assert tangent / rigidity.preloaded_ball_track_rigidity(preload, rest) == pytest.approx(3 / 2**1.5, rel=1e-13)


def test_shaft_as_hiwin_prints_it():
    """F 3.31 and 3.32 in mm, N and N/µm; four times in the middle of two bearings what the whole length has at one."""
    d_c, l_1, length = 35.8, 600.0, 1200.0
    one_end = math.pi * d_c**2 * 2.1e5 / (4 * l_1 * 1e3)
    assert rigidity.shaft_rigidity_held_at_one_end(E, 0.0358, 0.6) == pytest.approx(one_end * 1e6, rel=1e-13)
    both = rigidity.shaft_rigidity_held_at_both_ends(E, 0.0358, 0.6, 1.2)
    assert both == pytest.approx(one_end * 1e6 * length / (length - l_1), rel=1e-13)
    assert both == pytest.approx(4 * rigidity.shaft_rigidity_held_at_one_end(E, 0.0358, 1.2), rel=1e-13)
    places = np.linspace(0.01, 1.19, 119)
    along = rigidity.shaft_rigidity_held_at_both_ends(E, 0.0358, places, 1.2)
    assert places[np.argmin(along)] == pytest.approx(0.6)
    assert along == pytest.approx(along[::-1], rel=1e-12)


def test_springs_in_series():
    assert rigidity.series_rigidity(300.0, 600.0) == pytest.approx(200.0)
    assert rigidity.series_rigidity(300.0, math.inf) == 300.0
    assert rigidity.rigidity_corrected_for_accuracy(0.5, 1000.0) == 500.0
