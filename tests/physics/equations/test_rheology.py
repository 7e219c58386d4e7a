"""Truth: the groups as the paper defines them, and published properties of oils."""

import math

import pytest

from ballscrew.physics.equations import rheology

from .numbers import CONTACT_LOAD, EQUIVALENT_MODULUS, PRESSURE_VISCOSITY, ROLLING_RADIUS, VISCOSITY

RELATIVE = 1e-13


@pytest.mark.equation("Olaru2005 §2.1 (6)")
def test_material_parameter():
    assert rheology.material_parameter(EQUIVALENT_MODULUS, PRESSURE_VISCOSITY) == pytest.approx(4972.0, rel=RELATIVE)


@pytest.mark.equation("Olaru2005 §2.1 (7)")
def test_speed_parameter_of_the_paper():
    # reference sheet: mpmath, 40 digits
    v = 6.26339204627734047e-1
    U = rheology.speed_parameter(VISCOSITY, v, EQUIVALENT_MODULUS, ROLLING_RADIUS)
    assert pytest.approx(1.84958236788959844e-10, rel=RELATIVE) == U
    assert pytest.approx(VISCOSITY * v / EQUIVALENT_MODULUS / ROLLING_RADIUS, rel=RELATIVE) == U


@pytest.mark.equation("Olaru2005 §2.1 (9)")
def test_load_parameter_of_the_paper():
    # reference sheet: mpmath, 40 digits
    W = rheology.load_parameter(CONTACT_LOAD, EQUIVALENT_MODULUS, ROLLING_RADIUS)
    assert pytest.approx(1.99078134111473684e-4, rel=RELATIVE) == W


def test_pressure_viscosity_estimate():
    # Jungnickel2010: nu in m2/s, evaluated through logarithms
    for nu in (1e-5, 1e-4, 5e-4):
        expected = math.exp(math.log(1.29e-7) + 0.204 * math.log(nu))
        assert rheology.pressure_viscosity_estimate(nu) == pytest.approx(expected, rel=RELATIVE)


#: StachowiakBatchelor2005, Table 2.3: viscosity (mPa s) and pressure–viscosity coefficient (1e-9 m²/N) of mineral oils
#: at 30, 60 and 100 °C.
MEASURED_OILS = [
    (153, 34, 9.1, 23.7, 20.5, 15.8), (250, 50.5, 12.6, 25.0, 21.3, 17.6), (810, 135, 26.8, 34, 28, 22),
    (18.6, 6.3, 2.4, 20, 16, 13), (45, 12, 3.9, 28, 20, 16), (107, 23.3, 6.4, 29.6, 22.8, 17.8),
    (122, 26.3, 7.3, 27.0, 21.6, 17.5), (171, 31, 7.5, 28, 23, 18), (30.7, 8.6, 3.1, 25.7, 20.3, 15.4),
    (165, 30.0, 6.8, 33.0, 23.8, 16.0), (310, 44.2, 9.4, 34.6, 26.3, 19.5), (2000, 180, 24, 41.5, 29.4, 25.0),
]  # fmt: skip


def test_pressure_viscosity_estimate_is_below_measured_oils():
    # for a density of 870 kg/m^3, which the power 0.204 hardly sees
    ratios = [
        rheology.pressure_viscosity_estimate(viscosity * 1e-3 / 870) / (measured * 1e-9)
        for oil in MEASURED_OILS
        for viscosity, measured in zip(oil[:3], oil[3:], strict=True)
    ]
    assert min(ratios) == pytest.approx(0.61, abs=0.01)
    assert max(ratios) == pytest.approx(0.98, abs=0.01)
    assert sum(ratios) / len(ratios) == pytest.approx(0.73, abs=0.01)


def test_barus_grows_by_e_over_one_inverse_coefficient():
    assert rheology.barus_viscosity(0.1, 2e-8, 0.0) == 0.1
    assert rheology.barus_viscosity(0.1, 2e-8, 5e7) == pytest.approx(0.1 * math.e, rel=RELATIVE)
    assert rheology.barus_viscosity(0.1, 2e-8, 1e9) == pytest.approx(0.1 * math.e**20, rel=RELATIVE)


@pytest.mark.parametrize("eta_0", [0.01, 0.1, 0.5])
def test_roelands_has_the_given_pressure_viscosity_coefficient(eta_0):
    # the coefficient is the slope of the logarithm at zero pressure, where Roelands and Barus touch
    Z = rheology.roelands_exponent(eta_0, 2.2e-8)
    step = 1e2
    slope = math.log(rheology.roelands_viscosity(eta_0, step, Z) / eta_0) / step
    assert slope == pytest.approx(2.2e-8, rel=1e-6)
    assert rheology.roelands_viscosity(eta_0, 0.0, Z) == eta_0
    assert rheology.roelands_viscosity(eta_0, 1e9, Z) < rheology.barus_viscosity(eta_0, 2.2e-8, 1e9) / 10


def test_roelands_lines_meet_at_the_pole():
    # Roelands1966: at -1/5.1e-9 Pa all isotherms meet at ln eta = -9.67
    for eta_0, Z in ((0.01, 0.5), (0.3, 0.7)):
        assert math.log(rheology.roelands_viscosity(eta_0, -1 / 5.1e-9, Z)) == pytest.approx(-9.67, rel=1e-12)


@pytest.mark.parametrize("celsius", [20.0, 40.0, 100.0])
def test_temperature_coefficient_is_the_slope_of_vogels_law(celsius):
    T, step = 273.15 + celsius, 1e-3
    law = (0.062e-3 / 887.6, 1021.7, 273.15 - 101.5517)  # Lubricants2023, Table A1
    above, below = (rheology.kinematic_viscosity_vogel(T + s, *law) for s in (step, -step))
    slope = -math.log(above / below) / (2 * step)
    assert rheology.vogel_temperature_coefficient(T, law[1], law[2]) == pytest.approx(slope, rel=1e-8)


def test_thermal_loading_parameter():
    # 0.04 1/K * 0.1 Pa s * (0.6 m/s)^2 / 0.144 W/(m K)
    assert rheology.thermal_loading_parameter(0.1, 0.04, 0.6, 0.144) == pytest.approx(0.01, rel=RELATIVE)
    assert rheology.thermal_loading_parameter(0.1, 0.04, 0.0, 0.144) == 0.0
