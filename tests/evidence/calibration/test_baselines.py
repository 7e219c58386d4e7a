"""Descriptions without physics find the coefficients of logs that follow them."""

import numpy as np
import pytest

from ballscrew.evidence.calibration.baselines import (
    STRIBECK_SHARES,
    Conditions,
    efficiency_pair,
    robust_linear,
    stribeck,
)

ROWS, ZERO_ERROR = 2000, 0.02


def conditions(seed=0):
    """A drive torque in both directions under loads that always pull one way."""
    random = np.random.default_rng(seed)
    load = random.uniform(200, 4000, ROWS)
    speed = np.exp(random.uniform(*np.log((1, 100)), ROWS))
    speed[0] = 100.0
    sign = np.where(random.random(ROWS) < 0.5, -1.0, 1.0)
    return Conditions(load, speed, 8e-4 * load, sign < 0, np.stack([np.ones(ROWS), sign]), np.ones((ROWS, 1)))


def spoilt(torque, noise=0.0, outliers=0.05, seed=1):
    random = np.random.default_rng(seed)
    torque = torque + random.normal(0, noise, torque.size)
    return np.where(random.random(torque.size) < outliers, torque + 3.0, torque)


def law_of_stribeck(at, coulomb, load, extra, viscous, fall):
    friction = coulomb + load * at.axial_load + extra * np.exp(-at.screw_speed / fall) + viscous * at.screw_speed
    return at.weights[0] * at.ideal_torque + at.weights[1] * friction + ZERO_ERROR


@pytest.mark.parametrize("place", [3, 12, 20])
def test_stribeck_finds_its_own_law(place):
    at, fall = conditions(), STRIBECK_SHARES[place] * 100.0
    true = 0.05, 3e-5, 0.04, 2e-3, fall
    found = stribeck(at, spoilt(law_of_stribeck(at, *true), noise=1e-4))
    assert list(found.coefficients) == [
        "coulomb_torque",
        "torque_per_load",
        "stribeck_torque",
        "viscous_torque_coefficient",
        "stribeck_speed",
    ]
    assert list(found.coefficients.values()) == pytest.approx(true, rel=0.02)
    np.testing.assert_allclose(found.torque(at), law_of_stribeck(at, *true), atol=2e-4)


def test_an_efficiency_pair_finds_its_own():
    at, driving, driven = conditions(), 0.93, 0.88
    share = np.where(at.helping, 1 - driven, 1 / driving - 1)
    torque = at.weights[0] * at.ideal_torque + at.weights[1] * share * at.ideal_torque
    found = efficiency_pair(at, spoilt(torque, noise=1e-4))
    assert found.coefficients["efficiency"] == pytest.approx(driving, abs=1e-4)
    assert found.coefficients["back_driving_efficiency"] == pytest.approx(driven, abs=1e-4)
    np.testing.assert_allclose(found.torque(at), torque, atol=1e-3)


def test_what_is_described_are_the_rows_asked_for():
    at = conditions()
    chosen = np.arange(ROWS) < 1500
    torque = law_of_stribeck(at, 0.05, 3e-5, 0.04, 2e-3, STRIBECK_SHARES[12] * at.rows(chosen).screw_speed.max())
    found = stribeck(at.rows(chosen), np.where(chosen, torque, 99.0)[chosen])
    np.testing.assert_allclose(found.torque(at), torque, atol=1e-6)


def test_robust_lines_do_not_depend_on_units_and_pass_by_outliers():
    random = np.random.default_rng(2)
    columns = random.standard_normal((500, 3)) * [1.0, 1e-6, 1e6]
    true = np.array([0.3, 2e6, -5e-6])
    values = spoilt(columns @ true, noise=0.01)
    found, cost = robust_linear(columns, values)
    np.testing.assert_allclose(found, true, rtol=0.02)
    again, larger = robust_linear(columns * [1e3, 1, 1], 1e3 * values)
    np.testing.assert_allclose(again, found * [1, 1e3, 1e3], rtol=1e-6)
    assert larger == pytest.approx(1e3 * cost, rel=1e-6)


def test_a_column_of_zeros_is_left_alone():
    columns = np.stack([np.ones(50), np.zeros(50)], axis=1)
    found, _ = robust_linear(columns, np.linspace(0.9, 1.1, 50))
    assert found == pytest.approx([1.0, 0.0])


def test_the_largest_floats_have_a_robust_line():
    found, cost = robust_linear(np.ones((50, 1)), 1e300 * np.linspace(0.9, 1.1, 50))
    assert found == pytest.approx([1e300], rel=1e-6)
    assert np.isfinite(cost)
