"""An oil of a grade has a temperature: with another one it is another oil, however that is said."""

import dataclasses
import pickle

import numpy as np
import pytest

import ballscrew as bs

OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
WARM = bs.Lubricant.from_grade("ISO VG 100", 353.15)
NUMBERS = ("viscosity", "pressure_viscosity_coefficient", "temperature_coefficient", "density")


def assert_same_oil(one, other):
    assert (one.grade, one.temperature) == (other.grade, other.temperature)
    for name in NUMBERS:
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-14)


def test_replace_changes_the_viscosity_with_the_temperature():
    assert_same_oil(dataclasses.replace(OIL, temperature=353.15), WARM)
    assert_same_oil(OIL.at(353.15), WARM)
    assert_same_oil(dataclasses.replace(dataclasses.replace(OIL, temperature=353.15), temperature=313.15), OIL)


def test_replace_changes_the_viscosity_with_the_grade():
    other = bs.Lubricant.from_grade("ISO VG 220", 313.15)
    assert_same_oil(dataclasses.replace(OIL, grade="VG 220"), other)
    with pytest.raises(bs.InputError, match=r"lubricant.grade: unknown grade"):
        dataclasses.replace(OIL, grade="butter")


def test_a_number_given_anew_stays_and_a_measured_one_keeps_its_ratio():
    assert dataclasses.replace(OIL, temperature=353.15, viscosity=0.02).viscosity == 0.02
    measured = dataclasses.replace(OIL, viscosity=1.1 * OIL.viscosity)
    assert measured.viscosity == 1.1 * OIL.viscosity
    np.testing.assert_allclose(measured.at(353.15).viscosity, 1.1 * WARM.viscosity, rtol=1e-14)
    conducting = dataclasses.replace(OIL, thermal_conductivity=0.15, temperature=353.15)
    assert_same_oil(conducting, WARM)
    assert conducting.thermal_conductivity == 0.15


def test_arrays_of_temperatures():
    temperatures = np.array([313.15, 353.15, 500.0])
    oil = dataclasses.replace(OIL, temperature=temperatures)
    np.testing.assert_allclose(oil.viscosity, [OIL.viscosity, WARM.viscosity, np.nan], rtol=1e-14)
    kept = dataclasses.replace(oil, density=880.0)
    np.testing.assert_array_equal(kept.viscosity, oil.viscosity)


def test_after_a_copy_in_another_process():
    copied = pickle.loads(pickle.dumps(OIL))
    assert copied == OIL
    assert_same_oil(dataclasses.replace(copied, temperature=353.15), WARM)


@pytest.mark.parametrize("given", [{"temperature": 313.15}, {"grade": "ISO VG 100"}])
def test_grade_and_temperature_go_together(given):
    with pytest.raises(bs.InputError, match=r"lubricant\.\w+: needs a (grade|temperature)"):
        bs.Lubricant(viscosity=0.1, **given)
    with pytest.raises(bs.InputError, match="needs a grade"):
        dataclasses.replace(bs.Lubricant(viscosity=0.1), temperature=313.15)


def test_a_temperature_out_of_range():
    with pytest.raises(bs.InputError, match=r"lubricant.temperature: must be at least 253.15 K"):
        dataclasses.replace(OIL, temperature=40.0)


@pytest.mark.parametrize(
    ("written", "meant"),
    [("ISO VG 95", 100), ("VG 90", 100), ("VG47", 46), ("ISO VG 5", 10), ("95", 100), ("ISO VG 1000", 460)],
)
def test_an_unknown_grade_is_answered_with_the_nearest_number(written, meant):
    with pytest.raises(bs.InputError, match=f'did you mean "ISO VG {meant}"'):
        bs.Lubricant.from_grade(written)
