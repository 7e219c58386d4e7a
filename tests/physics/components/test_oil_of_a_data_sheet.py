"""An oil of a data sheet: two points, what follows from them at a temperature, and warnings beyond them."""

import dataclasses
import math
import pickle
from pathlib import Path

import numpy as np
import pint
import pytest

import ballscrew as bs
from ballscrew.physics.friction.validity import beyond_data_sheet

SHEET = {"kinematic_viscosity_40": 100e-6, "kinematic_viscosity_100": 11.1e-6, "density_15": 880.0}
OIL = bs.Lubricant.from_data_sheet(**SHEET, temperature=313.15)
NUMBERS = ("viscosity", "pressure_viscosity_coefficient", "temperature_coefficient", "density")
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw()
MODEL = bs.FrictionModel.reference()
COLD = -40 + 273.15


def assert_same_oil(one, other):
    assert one.temperature == other.temperature
    for name in NUMBERS:
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-13)


def test_the_two_points_and_the_cold():
    assert OIL.kinematic_viscosity == pytest.approx(100e-6, rel=1e-12)
    assert OIL.at(373.15).kinematic_viscosity == pytest.approx(11.1e-6, rel=1e-12)
    # by hand, ASTM D341 without its terms for thin oils: 18933 mm²/s; Vogel's law of ISO VG 100 has 35772 mm²/s
    cold = bs.Lubricant.from_data_sheet(**SHEET, temperature=-20 + 273.15)
    assert 1e6 * cold.kinematic_viscosity == pytest.approx(18933, abs=1)
    assert 1e6 * bs.Lubricant.from_grade("ISO VG 100", -20 + 273.15).kinematic_viscosity == pytest.approx(35772, abs=1)


def test_the_table_of_the_page():
    page = (Path(__file__).parents[3] / "docs" / "oils.md").read_text(encoding="utf-8")
    rows = [line.strip("| ").split(" | ") for line in page.splitlines() if line.startswith("|")]
    celsius = next(row for row in rows if row[0] == "°C")[1:]
    of_grade, of_sheet = (next(row for row in rows if words in row[0])[1:] for words in ("grade =", "ASTM D341"))
    for degrees, by_grade, by_sheet in zip(map(float, celsius), of_grade, of_sheet, strict=True):
        graded = bs.Lubricant.from_grade("ISO VG 100", degrees + 273.15)
        for oil, written in ((graded, by_grade), (OIL.at(degrees + 273.15), by_sheet)):
            digits = len(written.partition(".")[2])
            assert f"{1e6 * oil.kinematic_viscosity:.{digits}f}" == written


def test_viscosity_index():
    assert round(bs.Lubricant.from_data_sheet(73.3e-6, 8.86e-6).viscosity_index) == 92
    assert round(bs.Lubricant.from_data_sheet(22.83e-6, 5.05e-6).viscosity_index) == 156
    assert 80 < bs.Lubricant.from_grade("ISO VG 100").viscosity_index < 100
    assert math.isnan(bs.Lubricant(viscosity=0.1).viscosity_index)
    several = bs.Lubricant.from_data_sheet(np.array([73.3e-6, 22.83e-6, 4e-6]), np.array([8.86e-6, 5.05e-6, 1.9e-6]))
    np.testing.assert_allclose(several.viscosity_index, [92.43, 156.46, np.nan], atol=0.01)


@pytest.mark.parametrize("celsius", [-20, 150])
def test_a_grade_at_its_bounds(celsius):
    assert bs.Lubricant.from_grade("ISO VG 100", celsius + 273.15).viscosity > 0
    assert np.isfinite(bs.Lubricant.from_grade("ISO VG 100", np.array([celsius + 273.15])).viscosity).all()
    with pytest.raises(bs.InputError, match=r"lubricant\.temperature"):
        bs.Lubricant.from_grade("ISO VG 100", celsius + 273.15 + math.copysign(0.001, celsius))


@pytest.mark.parametrize("celsius", [-80, 200])
def test_a_data_sheet_at_its_bounds(celsius):
    assert OIL.at(celsius + 273.15).viscosity > 0
    with pytest.raises(bs.InputError, match=r"lubricant\.temperature"):
        OIL.at(celsius + 273.15 + math.copysign(0.001, celsius))
    assert np.isnan(OIL.at(np.array([celsius + 273.15 + math.copysign(1.0, celsius)])).viscosity).all()


def test_another_temperature_or_sheet_is_another_oil():
    warm = bs.Lubricant.from_data_sheet(**SHEET, temperature=353.15)
    assert_same_oil(dataclasses.replace(OIL, temperature=353.15), warm)
    assert_same_oil(OIL.at(353.15), warm)
    thinner = bs.Lubricant.from_data_sheet(**{**SHEET, "kinematic_viscosity_40": 68e-6}, temperature=353.15)
    sheet = dataclasses.replace(OIL.sheet, kinematic_viscosity_40=68e-6)
    assert_same_oil(dataclasses.replace(OIL, sheet=sheet, temperature=353.15), thinner)
    measured = dataclasses.replace(OIL, viscosity=1.1 * OIL.viscosity)
    assert measured.at(353.15).viscosity == pytest.approx(1.1 * warm.viscosity, rel=1e-13)
    assert_same_oil(pickle.loads(pickle.dumps(OIL)).at(353.15), warm)


def test_values_that_contradict():
    with pytest.raises(bs.InputError, match="kinematic_viscosity_100: must be below"):
        bs.Lubricant.from_data_sheet(11.1e-6, 100e-6)
    with pytest.raises(bs.InputError, match="sheet: contradicts the grade"):
        dataclasses.replace(OIL, grade="ISO VG 100")
    with pytest.raises(bs.InputError, match="kinematic_viscosity_40: must be at least"):
        bs.Lubricant.from_data_sheet(0.0, 1e-6)
    with pytest.raises(bs.InputError, match=r"must be below 1 m\^2/s .* 1 cSt is 1e-6 m\^2/s"):
        bs.Lubricant.from_data_sheet(100.0, 11.1)  # in cSt, as people have it
    with pytest.raises(bs.InputError, match="sheet: needs a temperature"):
        bs.Lubricant(viscosity=0.1, sheet=OIL.sheet)


def test_quantities_of_pint():
    unit = pint.UnitRegistry()
    oil = bs.Lubricant.from_data_sheet(
        unit.Quantity(100.0, "mm^2/s"),
        unit.Quantity(11.1, "mm^2/s"),
        unit.Quantity(0.88, "g/cm^3"),
        unit.Quantity(40.0, "degC"),
        pour_point=unit.Quantity(-15.0, "degC"),
    )
    assert_same_oil(oil, OIL)
    assert oil.sheet.pour_point == pytest.approx(258.15)


@pytest.mark.parametrize(
    ("stated", "celsius", "expected"),
    [
        ({}, 20, []),
        ({}, -1, ["extrapolated_cold"]),
        ({}, 121, ["extrapolated_hot"]),
        ({"pour_point": 258.15}, -14, []),
        ({"pour_point": 258.15}, -16, ["below_pour_point"]),
        ({"lowest_temperature": 253.15, "highest_temperature": 393.15}, -21, ["below_range"]),
        ({"lowest_temperature": 253.15, "highest_temperature": 393.15}, 121, ["above_range"]),
        ({"lowest_temperature": 253.15, "highest_temperature": 393.15}, 120, []),
    ],
)
def test_warnings_beyond_the_sheet(stated, celsius, expected):
    oil = bs.Lubricant.from_data_sheet(**SHEET, temperature=celsius + 273.15, **stated)
    assert [record.name for record in beyond_data_sheet(oil)] == expected


def test_results_carry_the_warning_of_the_coldest_point():
    oil = bs.Lubricant.from_data_sheet(**SHEET, pour_point=258.15)
    result = MODEL(SCREW, oil, axial_load=5e3, screw_speed=60.0, temperature=np.array([313.15, 250.0, 255.0]))
    (record,) = (r for r in result.warning_records if r.id == "lubricant.below_pour_point")
    assert (record.value, record.limit, record.unit) == (250.0, 258.15, "K")


POINTS = {"axial_load": [4e3], "screw_speed": [30.0, 90.0], "temperature": np.linspace(COLD, 393.15, 5)}


def test_compiled_sweeps_over_the_oil_are_those_of_numpy_and_of_the_model():
    varied = {**POINTS, "kinematic_viscosity_40": [50e-6, 200e-6]}
    found = {
        engine: bs.sweep(MODEL, SCREW, OIL, outputs=["screw_torque"], engine=engine, **varied)["screw_torque"]
        for engine in ("compiled", "numpy", "model")
    }
    np.testing.assert_allclose(found["compiled"], found["numpy"], rtol=1e-11)
    np.testing.assert_allclose(found["compiled"], found["model"], rtol=1e-9)
    oil = bs.Lubricant.from_data_sheet(**{**SHEET, "kinematic_viscosity_40": 50e-6}, temperature=COLD)
    at = {"axial_load": 4e3, "screw_speed": 30.0}
    torque = found["compiled"].sel(**at, temperature=COLD, kinematic_viscosity_40=50e-6)
    assert float(torque) == pytest.approx(float(MODEL(SCREW, oil, **at).screw_torque), rel=1e-9)


def test_derivatives_by_the_two_points():
    names = ["temperature", "kinematic_viscosity_40", "kinematic_viscosity_100"]
    at = {"axial_load": 4e3, "screw_speed": 60.0}
    found = bs.derivatives(MODEL, SCREW, OIL, by=names, engine="numpy", **at)
    for name, value, step in zip(names, (313.15, 100e-6, 11.1e-6), (1e-2, 1e-8, 1e-9), strict=True):
        ends = [float(MODEL(SCREW, OIL.changed({name: value + s}), **at).screw_torque) for s in (step, -step)]
        assert float(found[f"d_screw_torque_d_{name}"]) == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=1e-4)
