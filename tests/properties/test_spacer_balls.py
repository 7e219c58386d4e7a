"""Spacer balls: every second ball carries nothing and parts the others, in each kind of nut and on every path."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.evidence.calibration.fit import fit
from ballscrew.physics.components.nut import Bodies, DoubleNut, OffsetLeadNut, OversizeBallNut, SingleNut
from ballscrew.physics.laws.ball_chain import ProportionalBallForce, parted_neighbours
from ballscrew.physics.laws.nut_losses import Churning
from support.strategies import MODELS

REFERENCE = MODELS["reference"]
PARTED = dataclasses.replace(REFERENCE, ball_chain=parted_neighbours, ball_force=ProportionalBallForce(0.0))
OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
ROW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(loaded_balls=120)
NUTS = {
    "row": SingleNut(),
    "single": SingleNut(axial_play=1e-5, angle_under_load=True),
    "double": DoubleNut(3000.0),
    "offset": OffsetLeadNut(3000.0),
    "oversize": OversizeBallNut(preload=2000.0),
    "size of the balls": OversizeBallNut(oversize=3e-6),
}
POINTS = {"axial_load": np.array([-4000.0, 0.0, 500.0, 9000.0]), "screw_speed": np.array([20.0, 30.0, -5.0, 60.0])}


def with_nut(nut, **changes):
    return dataclasses.replace(ROW, nut=nut, **changes)


def spaced(nut):
    return dataclasses.replace(nut, spacer_balls=True)


def same(one, other):
    for name in ("screw_torque", "nut_torque", "largest_contact_load", "maximum_pressure"):
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-13)
    for name, part in one.contributions.items():
        np.testing.assert_allclose(part, other.contributions[name], rtol=1e-13)


@pytest.mark.parametrize("kind", NUTS)
def test_they_leave_half_of_the_balls_none_of_which_touch(kind):
    """The nut is one with half the balls, whose neighbours are parted."""
    found = REFERENCE(with_nut(spaced(NUTS[kind])), OIL, **POINTS)
    same(found, PARTED(with_nut(NUTS[kind], loaded_balls=60), OIL, **POINTS))
    assert np.all(found.contributions["ball_to_ball"] == 0)
    assert np.all(found.contributions["chain_braking"] == 0)


@pytest.mark.parametrize("kind", ["double", "oversize", "size of the balls"])
def test_elastic_bodies_carry_half_of_the_balls_twice_as_far_apart(kind):
    """The balls fill as long a thread: two starts side by side have each half of the balls on the same length."""
    nut = dataclasses.replace(NUTS[kind], bodies=Bodies(nut_outer_diameter=0.07))
    found = REFERENCE(with_nut(spaced(nut), starts=2, lead=0.02), OIL, **POINTS)
    same(found, PARTED(with_nut(nut, loaded_balls=60, lead=0.02), OIL, **POINTS))


@pytest.mark.parametrize("kind", NUTS)
def test_power_is_in_balance(kind):
    found = REFERENCE(with_nut(spaced(NUTS[kind])), OIL, **POINTS)
    np.testing.assert_allclose(
        sum(found.dissipation.values()), found.screw_torque * abs(POINTS["screw_speed"]), rtol=1e-9
    )


@pytest.mark.parametrize("name", MODELS)
def test_every_model_knows_them(name):
    few = dataclasses.replace(MODELS[name], ball_chain=parted_neighbours)
    found = MODELS[name](with_nut(SingleNut(spacer_balls=True)), OIL, **POINTS)
    np.testing.assert_allclose(
        found.screw_torque, few(with_nut(SingleNut(), loaded_balls=60), OIL, **POINTS).screw_torque
    )


def test_an_odd_number_is_the_mean_of_its_neighbours():
    assert with_nut(SingleNut(spacer_balls=True), loaded_balls=121).carrying_balls == 60.5
    found = [
        REFERENCE(with_nut(DoubleNut(3000.0, spacer_balls=True), loaded_balls=z), OIL, axial_load=0.0, screw_speed=10.0)
        for z in (120, 121, 122)
    ]
    torques = [float(each.screw_torque) for each in found]
    assert torques[1] == pytest.approx((torques[0] + torques[2]) / 2, rel=1e-4)
    assert torques[0] != torques[1]


def test_losses_are_of_all_balls():
    """Spacer balls are moved through the oil, too."""
    nut = dataclasses.replace(NUTS["double"], losses={"churning": Churning(oil_share=0.5)})
    one, other = (REFERENCE(with_nut(each), OIL, **POINTS).contributions["churning"] for each in (nut, spaced(nut)))
    np.testing.assert_array_equal(one, other)
    assert np.all(one > 0)


def test_one_ball_has_no_room_for_a_spacer():
    with pytest.raises(InputError, match=r"screw\.loaded_balls: leaves no ball beside the spacer .1."):
        with_nut(SingleNut(spacer_balls=True), loaded_balls=1)


@pytest.mark.parametrize("engine", ["numpy", pytest.param("compiled", marks=[pytest.mark.compiles, pytest.mark.long])])
@pytest.mark.parametrize("elastic", [False, True])
def test_a_recorded_sweep_has_the_numbers_of_the_model(elastic, engine):
    bodies = Bodies(nut_outer_diameter=0.07) if elastic else None
    screw = with_nut(DoubleNut(3000.0, spacer_balls=True, bodies=bodies), loaded_balls=12)
    axes = {"axial_load": [0.0, 2000.0], "screw_speed": [10.0, 60.0], "nut.preload": [2000.0, 4000.0]}
    recorded, model = (
        bs.sweep(REFERENCE, screw, OIL, outputs=["screw_torque"], engine=each, **axes) for each in (engine, "model")
    )
    assert recorded.engine == engine
    np.testing.assert_allclose(recorded["screw_torque"], model["screw_torque"], rtol=1e-9)


def test_a_fit_finds_the_preload_of_a_nut_that_has_them():
    olaru, speed = MODELS["olaru2005"], np.linspace(5.0, 100.0, 24) * np.where(np.arange(24) % 2, 1, -1)
    truth = with_nut(DoubleNut(3000.0, spacer_balls=True))
    torque = olaru(truth, OIL, axial_load=np.zeros(24), screw_speed=speed).drive_torque
    log = {"axial_load": np.zeros(24), "screw_speed": speed, "torque": torque * (1 + 1e-4 * (-1) ** np.arange(24))}
    start = with_nut(DoubleNut(4000.0, spacer_balls=True))
    assert fit(olaru, start, OIL, log, ["nut.preload"]).estimates["nut.preload"].value == pytest.approx(3000, rel=1e-3)
    wrong = fit(olaru, with_nut(DoubleNut(4000.0)), OIL, log, ["nut.preload"]).estimates["nut.preload"].value
    assert abs(wrong / 3000 - 1) > 0.05
