"""The most loaded ball and the flanks it touches: of all balls, whatever the nut, alike on numbers and on arrays."""

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.friction.ball_section import most_loaded_ball, touched

SCREW = bs.catalogue()["rexroth-40x10x6-6-double"]
NUTS = {
    "double": bs.DoubleNut(preload=3000.0),
    "oversize": bs.OversizeBallNut(preload=3000.0),
    "elastic": bs.DoubleNut(preload=3000.0, bodies=bs.Bodies()),
}
OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)


def result_of(nut, load):
    model = bs.FrictionModel.reference()
    return model(SCREW.screw(nut=nut), OIL, axial_load=load, screw_speed=20.0)


@pytest.mark.parametrize("name", NUTS)
@pytest.mark.parametrize("load", [5000.0, -5000.0, 25000.0])
def test_it_carries_the_greatest_load_of_all(name, load):
    result = result_of(NUTS[name], load)
    ball = most_loaded_ball(result.loads)
    assert max(ball.forward_load, ball.backward_load) == pytest.approx(float(result.largest_contact_load), rel=1e-12)
    carrying, relieved = touched(ball, load, 0.7)
    assert carrying.touches
    assert carrying.load >= relieved.load
    assert carrying.load == (ball.forward_load if load > 0 else ball.backward_load)
    assert bool(relieved.touches) is (name == "oversize" and abs(load) < 10000)


def test_a_ball_that_touches_nothing_would_touch_at_its_nominal_angle():
    result = result_of(bs.DoubleNut(preload=0.0), 0.0)
    carrying, relieved = touched(most_loaded_ball(result.loads), 0.0, 0.7)
    assert (carrying.touches, carrying.load, carrying.angle) == (True, 0.0, 0.7)
    assert not relieved.touches


@pytest.mark.parametrize("name", NUTS)
def test_many_points_are_as_each_by_itself(name):
    loads = np.array([-20000.0, -100.0, 3000.0, 20000.0])
    whole = touched(most_loaded_ball(result_of(NUTS[name], loads).loads), loads, 0.7)
    for place, load in enumerate(loads):
        alone = touched(most_loaded_ball(result_of(NUTS[name], load).loads), load, 0.7)
        for one, other in zip(whole, alone, strict=True):
            for field in one._fields:
                many, single = getattr(one, field), getattr(other, field)
                there = np.broadcast_to(many, loads.shape)[place]
                assert there == pytest.approx(single, rel=1e-9, nan_ok=True), (field, load)
