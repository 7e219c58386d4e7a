"""Slip on the line: two lines of pure rolling become one without a kink, and the ball it leaves is in balance."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.equations import slip
from ballscrew.physics.laws.frame import bearing_frame
from ballscrew.physics.solvers.line_slip import creep_of_lines, line_slip, pure_rolling_lines
from support.equations import line_traction_ratio

REFERENCE = bs.FrictionModel.reference()
LINE = dataclasses.replace(REFERENCE, slip=line_slip)
TRACTIONS = [-0.9, -0.3, 0.0, 0.2, 0.6, 0.95]


def coefficients(spin_parameter, traction_ratio):
    """Traction, curvature and spin coefficient of the lines that belong to a spin and a traction."""
    lines = pure_rolling_lines(spin_parameter, traction_ratio)
    return np.array(
        [
            line_traction_ratio(lines.lower, lines.upper),
            slip.line_curvature_coefficient(lines.lower, lines.upper),
            slip.line_spin_coefficient(lines.lower, lines.upper),
        ]
    )


def change_over(traction_ratio):
    """The spin parameter at which the lower line reaches the rim: 1 without a net force."""
    return 1 - slip.single_line(traction_ratio)


def test_the_change_over_without_force_is_at_one():
    assert change_over(0.0) == 1
    assert pure_rolling_lines(np.nextafter(1.0, 0), 0.0).are_two
    assert not pure_rolling_lines(1.0 + 1e-12, 0.0).are_two


@pytest.mark.parametrize("T", TRACTIONS)
def test_lines_carry_the_traction_on_both_sides(T):
    E_s = np.linspace(0, 3, 1201) * change_over(T)
    lines = pure_rolling_lines(E_s, T)
    assert np.all(lines.are_two[E_s < change_over(T) * (1 - 1e-9)])
    assert not np.any(lines.are_two[E_s > change_over(T) * (1 + 1e-9)])
    assert np.all((lines.lower >= -1) & (lines.lower <= lines.upper) & (lines.upper <= 1))
    assert coefficients(E_s, T)[0] == pytest.approx(T, rel=0, abs=1e-13)


@pytest.mark.parametrize("T", TRACTIONS)
def test_value_and_slope_are_the_same_on_both_sides(T):
    """Two lines become one: traction, curvature and spin coefficient are continuous with their slopes."""
    there = change_over(T)
    beyond = coefficients(there * 1.5, T)
    for step in (1e-2, 1e-3, 1e-4):
        before = coefficients(there - step, T)
        after = coefficients(there + step, T)
        # with one line nothing depends on the spin any more: slopes vanish, and so do those that lead there
        assert after == pytest.approx(beyond, rel=0, abs=1e-15)
        assert np.all(np.abs(before - after) <= 8 * step**2)


@pytest.mark.parametrize("T", TRACTIONS)
def test_pure_spin_beyond(T):
    E_s = np.array([2.0, 5.0, 1e3, 1e9])
    found = coefficients(E_s, T)
    single = slip.single_line(T)
    assert found[1] == pytest.approx(slip.line_curvature_coefficient(-1.0, single), rel=0, abs=1e-16)
    assert found[2] == pytest.approx(slip.line_spin_coefficient(-1.0, single), rel=0, abs=1e-16)
    if T == 0:
        assert found[1] == pytest.approx(0, abs=1e-16)
        assert np.all(found[2] == 1)


def test_without_spin_the_lines_lie_at_the_offset():
    T = np.linspace(-1, 1, 201)
    lines = pure_rolling_lines(np.zeros(201), T)
    assert np.all(lines.lower == -lines.upper)
    assert lines.upper == pytest.approx(slip.half_distance_of_lines(0.0, T), rel=1e-14)


def test_no_branch_spoils_the_other():
    """What is not chosen stays finite: no NaN, whatever spin and traction."""
    E_s, T = (
        x.ravel() for x in np.meshgrid(np.r_[0.0, np.geomspace(1e-12, 1e12, 200), 1.0, 2.0], np.linspace(-1, 1, 81))
    )
    lines = pure_rolling_lines(E_s, T)
    assert np.all(np.isfinite(lines.lower) & np.isfinite(lines.upper))
    # at the limit of the traction the slope of T over the lines vanishes
    assert coefficients(E_s, T)[0] == pytest.approx(T, rel=0, abs=1e-7)


def test_creep_puts_the_slip_to_zero_on_the_lines():
    for E_s, T in ((0.3, 0.1), (0.8, -0.1), (1.5, 0.2)):
        lines = pure_rolling_lines(E_s, T)
        creep = creep_of_lines(lines, 0.02, E_s * 0.02)
        for t in (lines.lower, lines.upper) if lines.are_two else (lines.upper,):
            assert slip.path_slip_speed(creep, E_s * 0.02, 0.02, t, t**2) == pytest.approx(0, abs=1e-15)


# -- the ball --------------------------------------------------------------------------------------


def screws(size, seed, conformity=(0.505, 0.56)):
    rng = np.random.default_rng(seed)
    d_m = rng.uniform(0.010, 0.125, size)
    d_w = d_m * rng.uniform(0.06, 0.25, size)
    z = rng.integers(5, 301, size).astype(float)
    alpha = np.radians(rng.uniform(20, 70, size))
    screw = bs.BallScrew(
        pitch_circle_diameter=d_m,
        lead=np.maximum(d_m * rng.uniform(0.05, 1.0, size), 1.05 * d_w),
        ball_diameter=d_w,
        loaded_balls=z,
        contact_angle=alpha,
        screw_conformity=rng.uniform(*conformity, size),
        nut_conformity=rng.uniform(*conformity, size),
    )
    load = np.exp(rng.uniform(math.log(1e4), math.log(1.5e8), size)) * d_w**2 * z * np.sin(alpha)
    oil = bs.Lubricant(np.exp(rng.uniform(math.log(0.005), 0, size)))
    return screw, oil, {"axial_load": load, "screw_speed": rng.uniform(0, 500, size)}


@pytest.fixture(scope="module")
def on_the_line():
    screw, oil, operation = screws(5000, seed=1)
    return LINE(screw, oil, **operation)


def test_energy_and_action(on_the_line):
    """Torque is power over speed, and screw and nut differ by what pushes the balls, skidding ones included."""
    r = on_the_line
    assert 0.05 < np.mean(r.rolling_share < 1) < 0.9
    assert np.all(np.isfinite(r.screw_torque))
    assert np.all(np.abs(r.screw_torque * r.screw_speed - r.friction_power) <= 1e-12 * np.abs(r.friction_power))
    pushing = r.ball_screw.loaded_balls * r.net_braking_force * r.frame.path_radius
    assert np.all(np.abs(r.screw_torque - r.nut_torque - pushing) <= 1e-12 * r.screw_torque)
    assert sum(r.contributions.values()) == pytest.approx(r.screw_torque, rel=1e-12)
    assert np.all(r.contributions["helix"] == 0)


def test_equilibrium_is_found(on_the_line):
    assert np.mean(~on_the_line.converged) < 0.002


@pytest.mark.parametrize(
    ("conformity", "least", "median"), [((0.505, 0.52), 0.88, 0.975), ((0.505, 0.56), 0.85, 0.955)]
)
def test_slip_torque_against_the_ellipse(conformity, least, median):
    """Without a helix the line lacks the slip along the minor axis: a few per cent, more for open grooves."""
    screw, oil, operation = screws(5000, seed=2, conformity=conformity)
    line, ellipse = (
        dataclasses.replace(model, frame=bearing_frame)(screw, oil, **operation) for model in (LINE, REFERENCE)
    )
    both = line.converged & ellipse.valid
    torque = [sum(r.contributions[part] for part in ("curvature", "spin", "helix")) for r in (line, ellipse)]
    ratio = (torque[0] / torque[1])[both]
    assert median - 0.02 < np.median(ratio) < median + 0.02
    assert np.quantile(ratio, 0.05) > least
    assert np.quantile(ratio, 0.99) < 1


def test_slip_torque_of_the_paper_against_the_ellipse(seed_screw, seed_oil):
    """At the paper's groove, 1 to 4 %."""
    load = np.array([400.0, 1000.0, 4000.0])
    line, ellipse = (
        dataclasses.replace(model, frame=bearing_frame)(seed_screw, seed_oil, axial_load=load, screw_speed=62.8)
        for model in (LINE, REFERENCE)
    )
    torque = [sum(r.contributions[part] for part in ("curvature", "spin", "helix")) for r in (line, ellipse)]
    assert np.all((torque[0] / torque[1] > 0.96) & (torque[0] / torque[1] < 0.995))
