"""Bearings by formulas of makers, as elements: rows, pairs, temperature."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.supports.makers_bearing import PalmgrenBearing, SKFBearing

SIZES = {"bore": 0.025, "outside_diameter": 0.052}
OIL = bs.Lubricant.from_grade("ISO VG 68")
PAIR = SKFBearing(**SIZES, lubricant=OIL, preload=500.0, seal_torque=0.02)
ROW = dataclasses.replace(PAIR, rows=1, preload=0.0)
STATE = bs.OperatingState(np.array([-3000.0, 0.0, 400.0]), np.array([10.0, -100.0, 100.0]))


def test_parts_sum_and_make_heat():
    found = PAIR(STATE)
    np.testing.assert_allclose(sum(found.contributions.values()), found.friction_effort, rtol=1e-14)
    np.testing.assert_allclose(found.friction_power, found.friction_effort * [10, 100, 100], rtol=1e-14)
    assert np.all(found.validity["inputs"])
    assert found.warning_records == []


def test_a_row_of_series_72_in_the_units_of_the_catalogue():
    """R1 4.33e-7, R2 2.02, S1 1.82e-2, S2 0.71: mm, N, rpm, mm²/s and N mm; in motion with 0.12 and 0.05."""
    load, omega, mean = 1200.0, 100.0, 38.5
    nu_n = 1e6 * float(OIL.viscosity / OIL.density) * omega * 30 / np.pi
    found = ROW(bs.OperatingState(load, omega)).contributions
    boundary = np.exp(-2.6e-8 * nu_n**1.4 * mean)
    sliding = 1.82e-2 * mean**0.26 * 0.71 * load ** (4 / 3) * (boundary * 0.12 + (1 - boundary) * 0.05)
    assert found["sliding"] == pytest.approx(1e-3 * sliding, rel=1e-9)
    n, nu = omega * 30 / np.pi, nu_n / (omega * 30 / np.pi)
    left = 1 / (1 + 1.84e-9 * (n * mean) ** 1.28 * nu**0.64)
    left *= np.exp(-3e-8 * nu_n * (25 + 52) * np.sqrt(4.4 / (2 * (52 - 25))))
    rolling = left * 4.33e-7 * mean**1.97 * (2.02 * load) ** 0.54 * nu_n**0.6
    assert found["rolling"] == pytest.approx(1e-3 * rolling, rel=1e-9)


def test_a_preloaded_pair_without_load_is_two_rows_at_the_preload():
    pair, row = PAIR(bs.OperatingState(0.0, 100.0)), ROW(bs.OperatingState(500.0, 100.0))
    for part in ("rolling", "sliding"):
        assert pair.contributions[part] == pytest.approx(2 * row.contributions[part], rel=1e-12)


def test_rows_of_one_side_share_its_load():
    """Four rows under twice the load and the preload are two pairs."""
    four = dataclasses.replace(PAIR, rows=4, preload=1000.0)
    pair, both = PAIR(bs.OperatingState(400.0, 100.0)), four(bs.OperatingState(800.0, 100.0))
    for part in ("rolling", "sliding"):
        assert both.contributions[part] == pytest.approx(2 * pair.contributions[part], rel=1e-12)


def test_a_released_pair_is_one_row():
    """Beyond 2.83 times the preload the other side carries nothing."""
    load = bs.OperatingState(3000.0, 100.0)
    assert PAIR(load).friction_effort == pytest.approx(float(ROW(load).friction_effort), rel=1e-12)


def test_balls_press_outwards_at_speed():
    """Nothing at rest; more rolling and more sliding the faster, most under a light load."""
    thrown = dataclasses.replace(ROW, constants=dataclasses.replace(ROW.constants, centrifugal=1.9e-12))
    states = [bs.OperatingState(200.0, speed) for speed in (1e-6, 100.0, 300.0)]
    more = [float(thrown(state).friction_effort / ROW(state).friction_effort) - 1 for state in states]
    assert more[0] < 1e-12
    assert 0 < more[1] < more[2]
    heavy = bs.OperatingState(2000.0, 300.0)
    assert thrown(heavy).friction_effort / ROW(heavy).friction_effort - 1 < more[2] / 3


def test_oil_is_taken_at_the_temperature_of_the_state():
    warm, cold = (ROW(bs.OperatingState(500.0, 100.0, temperature=T)).contributions for T in (340.0, 290.0))
    assert cold["rolling"] > 2 * warm["rolling"]
    assert cold["sliding"] < warm["sliding"]


def test_what_is_not_a_number_is_said():
    found = PAIR(bs.OperatingState(np.array([1.0, np.nan]), 10.0))
    assert list(found.validity["inputs"]) == [True, False]
    assert found.warning_records[0].id == "validity.inputs"


def test_palmgren_has_no_factors_of_its_own():
    with pytest.raises(TypeError):
        PalmgrenBearing(**SIZES, lubricant=OIL)
    bearing = PalmgrenBearing(**SIZES, lubricant=OIL, viscous_factor=2.0, load_factor=0.001, preload=500.0)
    found = bearing(bs.OperatingState(0.0, 0.0))
    assert found.contributions["by load"] == pytest.approx(2 * 0.001 * 500.0 * 0.0385)
    assert found.contributions["without load"] == pytest.approx(2 * 1.6e-5 * 2.0 * 38.5**3 * 1e-3)


@pytest.mark.parametrize(
    ("change", "field"),
    [({"rows": 5}, "rows"), ({"rows": 1, "preload": 0.1}, "preload"), ({"outside_diameter": 0.01}, "outside_diameter")],
)
def test_faults_name_the_field(change, field):
    with pytest.raises(bs.InputError) as raised:
        dataclasses.replace(PAIR, **change)
    assert [fault.field for fault in raised.value.faults] == [f"skf_bearing.{field}"]
