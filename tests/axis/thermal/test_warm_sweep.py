"""Sweeps of a screw that warms itself: each point is its own steady state, whatever else is in the sweep."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.makers_bearing import KnownBearing
from ballscrew.axis.thermal.warm_sweep import HEAT
from ballscrew.basis.errors import InputError

SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=3500.0))
OIL = bs.Lubricant.from_grade("ISO VG 100", 293.15)
MODEL = bs.FrictionModel.reference()
AIR = bs.Surroundings(shaft_length=1.2)


def steady(screw=SCREW, surroundings=AIR, **point):
    return bs.steady_heat(bs.to_and_fro(MODEL, screw, OIL, **point, stroke=0.5), surroundings)


def swept(surroundings=AIR, screw=SCREW, **varied):
    return bs.warm_sweep(MODEL, screw, OIL, surroundings=surroundings, stroke=0.5, **varied)


@pytest.mark.slow
def test_each_point_is_its_own_steady_state():
    """Of speeds with their signs, loads, and designs; the torque is that of the model at the oil and preload there."""
    found = swept(axial_load=[0.0, 3000.0], screw_speed=[-200.0, 0.0, 60.0], **{"nut.preload": [2000.0, 3500.0]})
    assert set(HEAT) <= set(found.data_vars)
    assert found["valid"].dims == ("axial_load", "screw_speed", "nut.preload")
    for place in ({"axial_load": 0.0, "screw_speed": -200.0}, {"axial_load": 3000.0, "screw_speed": 60.0}):
        for preload in (2000.0, 3500.0):
            one = found.sel({**place, "nut.preload": preload})
            screw = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=preload))
            end = steady(screw, **place)
            assert float(one["oil_temperature"]) == pytest.approx(end.oil_temperature, abs=1e-9)
            assert float(one["warm_preload"]) == pytest.approx(end.preload, rel=1e-9)
            assert float(one["shaft_growth"]) == pytest.approx(end.growth, rel=1e-9)
            assert float(one["heat_margin"]) == pytest.approx(end.margin, rel=1e-9)
            warm = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=end.preload))
            assert float(one["screw_torque"]) == pytest.approx(
                float(MODEL(warm, OIL.at(end.oil_temperature), **place).screw_torque), rel=1e-6
            )
    still = found.sel(screw_speed=0.0)
    assert np.all(still["oil_temperature"] == AIR.ambient)
    assert np.all(still["warm_preload"] == still["nut.preload"])
    assert np.all(still["shaft_growth"] == 0.0)  # what stands is as warm as the air, and no loop runs away
    assert np.all(still["heat_margin"] == 1.0)


@pytest.mark.slow
def test_a_point_that_runs_away_has_no_numbers():
    sunk = dataclasses.replace(AIR, nut_conductance=80.0, ball_conductance=2.0)
    found = swept(sunk, axial_load=0.0, screw_speed=[50.0, 314.0])
    assert found["validity_steady_state"].to_numpy().tolist() == [True, False]
    assert found["valid"].to_numpy().tolist() == [True, False]
    assert math.isnan(float(found["screw_torque"][1]))
    assert math.isnan(float(found["oil_temperature"][1]))
    assert float(found["heat_margin"][1]) < 0
    with pytest.raises(InputError, match="no point has a steady state"):
        swept(sunk, axial_load=0.0, screw_speed=[314.0])


def test_bearings_heat_each_point():
    """By the speed of the point itself, as for the point alone."""
    bearing = MountedBearing(place="fixed", element=KnownBearing(torque=0.5), load_share=0.0)
    also, speeds = {bearing.name: bearing}, [40.0, 200.0]
    found = swept(axial_load=0.0, screw_speed=speeds, also=also)
    ends = [
        bs.steady_heat(
            bs.to_and_fro(MODEL, SCREW, OIL, axial_load=0.0, screw_speed=speed, stroke=0.5, also=also), AIR
        ).growth
        for speed in speeds
    ]
    assert found["shaft_growth"].to_numpy() == pytest.approx(ends, rel=1e-9)
    assert np.all(found["shaft_growth"] > swept(axial_load=0.0, screw_speed=speeds)["shaft_growth"])


def test_a_nut_without_preload():
    screw = dataclasses.replace(SCREW, nut=bs.SingleNut())
    found = swept(screw=screw, axial_load=[1000.0, 4000.0], screw_speed=100.0)
    ends = [steady(screw, axial_load=load, screw_speed=100.0).oil_temperature for load in (1000.0, 4000.0)]
    assert found["oil_temperature"].to_numpy() == pytest.approx(ends, abs=1e-9)
    assert np.all(found["warm_preload"] == 0)


@pytest.mark.parametrize(
    ("varied", "named"),
    [
        ({"temperature": [300.0]}, "sweep.temperature: is not free"),
        ({"viscosity": [0.1]}, "sweep.viscosity: is not free"),
        ({"nut.preloa": [1.0]}, "preloa"),
    ],
)
def test_inputs_that_are_refused(varied, named):
    with pytest.raises(InputError, match=named):
        swept(axial_load=0.0, screw_speed=10.0, **varied)


def test_an_oil_without_a_temperature():
    with pytest.raises(InputError, match="has no temperature"):
        bs.warm_sweep(MODEL, SCREW, bs.Lubricant(viscosity=0.1), stroke=0.5, axial_load=0.0, screw_speed=10.0)
