"""Formulas of bearing makers: the numbers of the catalogue's units, and limits that any of them has."""

import math

import pytest

from ballscrew.axis.supports import formulas

#: A bearing 7205 in the units of the catalogue: mm, N, rpm, mm²/s.
BORE, OUTSIDE, LOAD, SPEED, VISCOSITY = 25.0, 52.0, 1560.0, 1000.0, 68.0
MEAN = (BORE + OUTSIDE) / 2
OIL, OMEGA = 1e-6 * VISCOSITY, SPEED * math.pi / 30


def test_rolling_in_the_units_of_the_catalogue():
    g_rr = 4.33e-7 * MEAN**1.97 * (40.0 + 2.02 * LOAD) ** 0.54
    expected = 1e-3 * g_rr * (VISCOSITY * SPEED) ** 0.6
    found = formulas.bearing_rolling_moment(LOAD, 40.0, OIL, OMEGA, 1e-3 * MEAN, 4.33e-7, 2.02)
    assert found == pytest.approx(expected, rel=1e-14)


def test_sliding_in_the_units_of_the_catalogue():
    expected = 1e-3 * 1.82e-2 * MEAN**0.26 * (40.0 ** (4 / 3) + 0.71 * LOAD ** (4 / 3)) * 0.1
    found = formulas.bearing_sliding_moment(LOAD, 40.0, 0.1, 1e-3 * MEAN, 1.82e-2, 0.71)
    assert found == pytest.approx(expected, rel=1e-14)


def test_centrifugal_load_in_the_units_of_the_catalogue():
    """The number of a public program's test: 61 mm, 20,000 rpm."""
    found = formulas.bearing_centrifugal_load(20000 * math.pi / 30, 0.061, 1.90e-12)
    assert found == pytest.approx(1.90e-12 * 61.0**4 * 20000.0**2, rel=1e-14)


def test_at_rest_nothing_is_taken_off_and_the_boundary_film_carries_all():
    assert formulas.inlet_heating_factor(OIL, 0.0, 0.04) == 1
    assert formulas.bearing_replenishment_factor(OIL, 0.0, 0.025, 0.052, 3e-8, 4.4) == 1
    assert formulas.bearing_boundary_share(OIL, 0.0, 0.04) == 1
    assert formulas.bearing_sliding_coefficient(1.0, 0.12, 0.05) == 0.12
    assert formulas.bearing_rolling_moment(LOAD, 0.0, OIL, 0.0, 0.04, 4.33e-7, 2.02) == 0


def test_palmgren_in_his_units():
    expected = 1e-3 * 1e-7 * 2.0 * (VISCOSITY * SPEED) ** (2 / 3) * MEAN**3
    assert formulas.palmgren_viscous_moment(OIL, OMEGA, 1e-3 * MEAN, 2.0) == pytest.approx(expected, rel=1e-14)
    least = 1e-3 * 160e-7 * 2.0 * MEAN**3
    assert formulas.palmgren_viscous_moment(OIL, 0.0, 1e-3 * MEAN, 2.0) == pytest.approx(least, rel=1e-14)
    assert formulas.palmgren_load_moment(LOAD, 1e-3 * MEAN, 0.001) == pytest.approx(0.001 * LOAD * 1e-3 * MEAN)
