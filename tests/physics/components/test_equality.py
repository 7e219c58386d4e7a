"""Screws, oils, nuts and models of equal numbers are equal; arrays count element by element."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.sizing.catalogue import catalogue

ROW = catalogue()["rexroth-40x10x6-6-double"]
MAKERS = {
    "screw": lambda: ROW.screw(),
    "screw of arrays": lambda: ROW.screw(lead=np.array([0.01, 0.02])),
    "oil": lambda: bs.Lubricant.from_grade("ISO VG 100"),
    "oil by numbers": lambda: bs.Lubricant(0.1),
    "material": lambda: bs.Material(2e11),
    "olaru2005": bs.FrictionModel.olaru2005,
    "corrected": bs.FrictionModel.corrected,
    "reference": bs.FrictionModel.reference,
    "nut": lambda: bs.DoubleNut(1000.0),
    "nut with losses": lambda: bs.DoubleNut(1000.0, losses={"seals": bs.Seals(0.1)}),
    "screw with a nut": lambda: ROW.screw(nut=bs.DoubleNut(1000.0)),
    "bodies": lambda: bs.Bodies.of(ROW.screw()),
}


@pytest.mark.parametrize("name", MAKERS)
def test_equal_values_are_equal(name):
    one, other = MAKERS[name](), MAKERS[name]()
    assert one == other
    assert hash(one) == hash(other)
    assert one is other or len({one, other}) == 1


def test_different_values_are_different():
    made = [maker() for maker in MAKERS.values()]
    assert [[one == other for other in made].count(True) for one in made] == [1] * len(made)
    screw = ROW.screw()
    assert screw != dataclasses.replace(screw, lead=0.0101)
    assert screw != dataclasses.replace(screw, screw_material=bs.Material(2e11))
    assert ROW.screw(lead=np.array([0.01, 0.02])) != ROW.screw(lead=np.array([0.01, 0.021]))
    assert bs.FrictionModel.reference() != dataclasses.replace(bs.FrictionModel.reference(), ball_to_ball_force=0.1)
    assert bs.DoubleNut(1000.0) != bs.OffsetLeadNut(1000.0)
    assert screw != "screw"
