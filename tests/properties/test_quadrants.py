"""Laws of physics of load and motion of either sign: mirror symmetry, and power in is power out and lost."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from support import screws
from support.strategies import MODELS

OIL = bs.Lubricant(viscosity=0.1, pressure_viscosity_coefficient=2e-8)
KINDS = {
    "row": lambda force: bs.SingleNut(),
    "single": lambda force: bs.SingleNut(angle_under_load=True),
    "double": lambda force: bs.DoubleNut(force),
    "offset": lambda force: bs.OffsetLeadNut(force),
    "oversize": lambda force: bs.OversizeBallNut(force),
}
NUMBER = 10_000


def random_screws(kind, seed, number):
    """So many screws with a nut of a kind, as arrays, and a load and a speed of either sign for each."""
    rng = np.random.default_rng(seed)
    ball = rng.uniform(2e-3, 8e-3, number)
    pitch = ball * rng.uniform(5, 9, number)
    screw = bs.BallScrew(
        pitch_circle_diameter=pitch,
        lead=ball * rng.uniform(1.3, 4, number),
        ball_diameter=ball,
        loaded_balls=rng.integers(10, 200, number).astype(float),
        contact_angle=rng.uniform(math.radians(35), math.radians(55), number),
        screw_conformity=rng.uniform(0.515, 0.56, number),
        nut_conformity=rng.uniform(0.515, 0.56, number),
        nut=KINDS[kind](rng.uniform(10, 3000, number)),
    )
    return screw, rng.uniform(-1e4, 1e4, number), rng.uniform(-100, 100, number)


def names_of(kind):
    return [name for name, model in MODELS.items() if model.knows(KINDS[kind](1500.0))]


@pytest.mark.parametrize(("kind", "name"), [(kind, name) for kind in KINDS for name in names_of(kind)])
def test_load_and_speed_reversed_reverse_the_torque(kind, name):
    """A symmetric nut is the same from both sides, to the last bit."""
    screw, load, speed = random_screws(kind, seed=11, number=NUMBER // 10)
    there = MODELS[name](screw, OIL, axial_load=load, screw_speed=speed)
    back = MODELS[name](screw, OIL, axial_load=-load, screw_speed=-speed)
    for output in ("drive_torque", "ideal_torque", "holding_torque"):
        np.testing.assert_array_equal(getattr(there, output), -getattr(back, output))
    for output in ("screw_torque", "nut_torque", "efficiency", "back_driving_efficiency", "friction_power", "valid"):
        np.testing.assert_array_equal(getattr(there, output), getattr(back, output))
    assert np.isfinite(there.screw_torque).all()


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_power_in_is_power_out_and_lost(kind):
    """Of the shaft, the load and the contacts, in each quadrant, over random nuts of the reference model."""
    number = NUMBER if kind in ("row", "double") else NUMBER // 5
    screw, load, speed = random_screws(kind, seed=12, number=number)
    r = MODELS["reference"](screw, OIL, axial_load=load, screw_speed=speed)
    shaft = r.drive_torque * speed
    of_load = load * screw.lead * speed / math.tau
    lost = r.friction_power
    imbalance = np.abs(shaft - of_load - lost) / (np.abs(shaft) + np.abs(of_load) + lost)
    # the sum of local dissipations of a ball is as far from its torque's power as its slip is from balance
    settled = np.broadcast_to(r.converged, imbalance.shape) & (imbalance < np.inf)
    assert np.mean(settled) > 0.95
    assert np.max(imbalance[settled]) < 1e-12
    for up in (True, False):
        for forward in (True, False):
            assert np.sum(settled & ((load > 0) == up) & ((speed > 0) == forward)) > number // 10


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("load", [-4000.0, 0.0, 4000.0])
def test_through_rest(kind, load):
    """Finite where it has a meaning, NaN everywhere else, at speeds of both signs and at rest."""
    speed = np.linspace(-50, 50, 11) * math.tau / 60
    screw, *_ = random_screws(kind, seed=13, number=1)
    one = dataclasses.replace(
        screw,
        **{
            field.name: float(value[0])
            for field in dataclasses.fields(screw)
            if isinstance(value := getattr(screw, field.name), np.ndarray)
        },
        nut=KINDS[kind](1500.0),
    )
    r = MODELS["reference"](one, OIL, axial_load=load, screw_speed=speed)
    for output in ("screw_torque", "nut_torque", "drive_torque", "holding_torque", "friction_power"):
        assert np.isfinite(getattr(r, output)).all(), output
    rest = speed == 0
    assert (r.drive_torque[rest] == r.ideal_torque).all()
    assert (r.friction_power[rest] == 0).all()
    drives = speed * load >= 0 if load else np.zeros_like(rest)
    np.testing.assert_array_equal(np.isfinite(r.efficiency), drives)
    np.testing.assert_array_equal(np.isfinite(r.back_driving_efficiency), np.full_like(rest, load != 0))
    # without load and preload there is nothing to rub
    rubs = bool(load) or kind not in ("row", "single")
    assert set(np.sign(r.drive_torque[speed > 0] - r.ideal_torque)) == {float(rubs)}
    assert set(np.sign(r.drive_torque[speed < 0] - r.ideal_torque)) == {-float(rubs)}
    assert (r.holding_torque * np.sign(load) <= np.abs(r.ideal_torque)).all()


def test_the_temperature_of_the_state_is_that_of_the_oil():
    oil = bs.Lubricant.from_grade("ISO VG 100", 313.15)
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(4326.0))
    temperatures = np.array([313.15, 343.15])
    warm = MODELS["reference"](screw, oil, axial_load=0.0, screw_speed=50.0, temperature=temperatures)
    assert warm.screw_torque[0] == MODELS["reference"](screw, oil, axial_load=0.0, screw_speed=50.0).screw_torque
    other = MODELS["reference"](screw, oil.at(343.15), axial_load=0.0, screw_speed=50.0)
    assert warm.screw_torque[1] == pytest.approx(other.screw_torque, rel=1e-13)
    assert warm.friction_effort is warm.screw_torque
    fixed = bs.Lubricant(viscosity=0.1, pressure_viscosity_coefficient=2e-8)
    with pytest.raises(bs.InputError, match="needs an oil made from a grade"):
        MODELS["reference"](screw, fixed, axial_load=0.0, screw_speed=50.0, temperature=320.0)


@pytest.mark.slow
@pytest.mark.parametrize("set_at_rest", [False, True])
def test_quadrants_between_elastic_bodies_are_those_of_the_model_at_either_load(set_at_rest):
    """A load of the other sign enters at the other end, and is carried by other balls: friction is another one."""
    nut = bs.DoubleNut(preload=900.0, bodies=bs.Bodies(), set_at_rest=set_at_rest)
    screw = screws.screw(pitch_circle_diameter=0.0258, lead=0.005, ball_diameter=3.175e-3, nut=nut)
    model, loads = bs.FrictionModel.reference(), np.array([-1500.0, 0.0, 1500.0])
    found = model(screw, OIL, axial_load=loads, screw_speed=10.0)
    assert found.screw_torque[0] < 0.99 * found.screw_torque[2]
    for quadrant in found.quadrants.values():
        there = model(screw, OIL, axial_load=quadrant.load_sign * abs(loads), screw_speed=quadrant.speed_sign * 10.0)
        np.testing.assert_allclose(quadrant.shaft_torque, there.drive_torque, rtol=1e-12)
        np.testing.assert_allclose(quadrant.shaft_power, there.drive_torque * there.screw_speed, rtol=1e-12)
        drives = quadrant.load_sign == quadrant.speed_sign
        expected = there.efficiency if drives else there.back_driving_efficiency
        np.testing.assert_allclose(quadrant.efficiency, expected, rtol=1e-12)
