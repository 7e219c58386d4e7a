"""Truth: a published table of an oil over temperature, the examples of ASTM D2270, and inverses that must meet."""

import math

import pytest

from ballscrew.physics.components.oil_grades import DataSheet, viscosity_index
from ballscrew.physics.equations import rheology

#: SHC 230 (SharpFluids): kinematic viscosity, mm²/s, by °C, to one decimal.
SHC_230 = {
    -30: 75984.3, -20: 22001.9, -10: 7604.5, 0: 3042.5, 10: 1374.9, 20: 688.0, 30: 375.2, 40: 220.0, 50: 137.2,
    60: 90.2, 70: 62.1, 80: 44.4, 90: 32.8, 100: 25.0, 110: 19.5, 120: 15.6,
}  # fmt: skip


@pytest.mark.parametrize("celsius", SHC_230)
def test_a_published_table_to_its_last_digit(celsius):
    sheet = DataSheet(kinematic_viscosity_40=220e-6, kinematic_viscosity_100=25e-6)
    oil = sheet.at(celsius + 273.15)
    assert 1e6 * oil.viscosity / oil.density == pytest.approx(SHC_230[celsius], abs=0.051)


@pytest.mark.parametrize(
    ("thick", "thin"),
    # ordinary, thick, and so thin that the exponential of the full form counts
    [(100e-6, 11.1e-6), (680e-6, 76.1e-6), (10e-6, 2.6e-6), (2e-6, 0.9e-6), (1e-6, 0.6e-6)],
)
def test_the_line_goes_through_its_points(thick, thin):
    sheet = DataSheet(kinematic_viscosity_40=thick, kinematic_viscosity_100=thin)
    for temperature, viscosity in ((313.15, thick), (373.15, thin)):
        oil = sheet.at(temperature)
        assert oil.viscosity / oil.density == pytest.approx(viscosity, rel=1e-12)


#: StachowiakBatchelor2005, Table 2.3: viscosity, mPa s, at 30, 60 and 100 °C. The first, a light machine oil, is off
#: any line.
MEASURED = [
    (38, 12.1, 5.3), (153, 34, 9.1), (250, 50.5, 12.6), (810, 135, 26.8), (18.6, 6.3, 2.4), (45, 12, 3.9),
    (107, 23.3, 6.4), (122, 26.3, 7.3), (171, 31, 7.5), (30.7, 8.6, 3.1), (165, 30.0, 6.8), (310, 44.2, 9.4),
    (2000, 180, 24),
]  # fmt: skip


def misses(at, low, high):
    """Deviations from the viscosities at one temperature of the lines through those at two others."""
    found = []
    for oil in MEASURED:
        numbers = {}
        for celsius, viscosity in zip((30, 60, 100), oil, strict=True):
            density = rheology.oil_density(870, rheology.oil_expansion_coefficient(870), celsius + 273.15, 288.15)
            numbers[celsius] = rheology.walther_number(viscosity * 1e-3 / density)
        slope = rheology.walther_slope(low + 273.15, numbers[low], high + 273.15, numbers[high])
        line = rheology.walther_number_at(at + 273.15, low + 273.15, numbers[low], slope)
        viscosities = [rheology.kinematic_viscosity_of_walther_number(number) for number in (line, numbers[at])]
        found.append(viscosities[0] / viscosities[1] - 1)
    return found


def test_measured_oils_between_and_beyond_two_points():
    between, beyond = misses(60, 30, 100), misses(30, 60, 100)
    assert max(map(abs, between[1:])) == pytest.approx(0.05, abs=0.005)
    assert max(map(abs, beyond[1:])) == pytest.approx(0.15, abs=0.005)
    assert (between[0], beyond[0]) == pytest.approx((0.12, -0.24), abs=0.005)


def test_the_exponential_is_as_large_as_the_docstring_says():
    for viscosity, share in ((2e-6, 0.0003), (1.5e-6, 0.002), (1e-6, 0.013)):
        number = rheology.walther_number(viscosity)
        assert 1 - (1e6 * viscosity + 0.7) / number == pytest.approx(share, rel=0.1)


@pytest.mark.parametrize("viscosity", [1e-6, 1.5e-6, 2e-6, 5e-6])
def test_the_inverse_of_the_standard(viscosity):
    estimate = rheology.kinematic_viscosity_of_walther_number(rheology.walther_number(viscosity))
    assert estimate == pytest.approx(viscosity, rel=1e-10 if viscosity >= 5e-6 else 3e-4)


@pytest.mark.parametrize("celsius", [-20.0, 40.0, 150.0])
def test_temperature_coefficient_is_the_slope_of_the_line(celsius):
    sheet, step = DataSheet(kinematic_viscosity_40=5e-6, kinematic_viscosity_100=1.7e-6), 1e-3

    def viscosity(temperature):
        oil = sheet.at(temperature)
        return oil.viscosity / oil.density

    T = celsius + 273.15
    slope = -math.log(viscosity(T + step) / viscosity(T - step)) / (2 * step)
    assert sheet.at(T).temperature_coefficient == pytest.approx(slope, rel=1e-7)


def test_viscosity_index_of_the_examples():
    # ASTM D2270, 5.1.4 and 6.1.4: L = 119.94, H = 69.48 and VI = 92.43; H = 28.97 and VI = 156.37
    L = rheology.reference_viscosity(8.86e-6, 0.41858, 16.1558, -56.04)
    H = rheology.reference_viscosity(8.86e-6, 0.05794, 10.5156, -28.24)
    assert pytest.approx(119.94, abs=0.02) == 1e6 * L
    assert pytest.approx(69.48, abs=0.005) == 1e6 * H
    assert viscosity_index(73.30e-6, 8.86e-6) == pytest.approx(92.43, abs=0.005)
    assert round(viscosity_index(22.83e-6, 5.05e-6)) == 156
    # with the H of Table 1 itself, to the digits that the standard prints
    assert rheology.viscosity_index_above_100(22.83e-6, 5.05e-6, 28.97e-6) == pytest.approx(156.37, abs=0.01)


@pytest.mark.parametrize(
    ("thin", "of_index_0", "of_index_100"),
    # rows of Table 1 of ASTM D2270
    [(2.0e-6, 7.994, 6.394), (5.0e-6, 40.23, 28.49), (10.0e-6, 147.7, 82.87), (70.0e-6, 4905.0, 1558.0)],
)
def test_the_reference_oils_of_the_table(thin, of_index_0, of_index_100):
    assert viscosity_index(of_index_0 * 1e-6, thin) == pytest.approx(0.0, abs=0.2)
    assert viscosity_index(of_index_100 * 1e-6, thin) == pytest.approx(100.0, abs=0.2)


def test_no_index_below_2_cst():
    assert math.isnan(viscosity_index(4e-6, 1.9e-6))


@pytest.mark.parametrize("celsius", [-40.0, 15.0, 40.0, 100.0])
def test_density_as_in_degrees_fahrenheit(celsius):
    # API MPMS 11.1, lubricating oils: K1 = 0.34878 about 60 °F; 15 °C is 0.56 K below it
    fahrenheit = 1.8 * celsius + 32
    alpha = 0.34878 / 880.0
    there = 880.0 * math.exp(-alpha * (fahrenheit - 60) * (1 + 0.8 * alpha * (fahrenheit - 60)))
    at_15 = 880.0 * math.exp(-alpha * -1.0 * (1 - 0.8 * alpha))
    expansion = rheology.oil_expansion_coefficient(at_15)
    assert rheology.oil_density(at_15, expansion, celsius + 273.15, 288.15) == pytest.approx(there, rel=1e-4)
