"""A fit stays where the parts accept its numbers, and ends with numbers wherever the data push."""

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.sizing.catalogue import catalogue

SCREW = catalogue()["rexroth-40x10x6-6-double"].screw()
OIL = bs.Lubricant(0.1)
MODEL = bs.FrictionModel.corrected()
LOADS = np.repeat([500.0, 2000.0, 5000.0, 9000.0], 5)
SPEEDS = np.tile([5.0, 20.0, 50.0, 100.0, 200.0], 4)
TORQUE = MODEL(SCREW, OIL, axial_load=LOADS, screw_speed=SPEEDS).screw_torque


@pytest.mark.slow
@pytest.mark.parametrize(
    ("free", "factor", "bounds"),
    [
        (["lead"], 0.01, {}),
        *[
            (free, factor, bounds)
            for free, factor in ((["ball_diameter"], 10.0), (["ball_diameter", "lead"], 30.0))
            for bounds in ({}, {"ball_diameter": (1e-3, 5e-2)})
        ],
    ],
)
def test_balls_keep_their_room(free, factor, bounds):
    data = {"axial_load": LOADS, "screw_speed": SPEEDS, "torque": factor * TORQUE}
    found = bs.fit(MODEL, SCREW, OIL, data, free, bounds=bounds, kind="friction", engine="numpy")
    assert found.screw.fits
    for name, estimate in found.estimates.items():
        assert estimate.bounds[0] <= estimate.value <= estimate.bounds[1]
        assert getattr(found.screw, name) == estimate.value
    assert found.screw.pitch_circle_diameter == SCREW.pitch_circle_diameter
