"""Bearings of two makers against the contacts of the screw: rows as printed, one row by hand, how rigidity grows."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.validate import compute

BEARINGS = SETS["support-bearings"]


@pytest.fixture(scope="module")
def points():
    rows = compute.shipped_rows(BEARINGS)
    return [BEARINGS.evaluate(FrictionModel.reference(), values, BEARINGS.conditions)[0] for values in rows]


@pytest.mark.parametrize(
    ("name", "rigidity"),
    [
        ("NSK TAC B 15x47, 2150 N", 750e6),
        ("NSK TAC B 50x100, 3010 N", 1210e6),
        ("IBC BS 17x47, 875 N", 460e6),
        ("IBC BS 45x75, 6800 N", 1390e6),
    ],
)
def test_published_numbers(points, name, rigidity):
    assert {point.name: point.band.middle for point in points}[name] == pytest.approx(rigidity, rel=1e-12)


def test_all_rows_have_a_name_of_their_own(points):
    assert len({point.name for point in points}) == len(points) == 19
    assert [point.group for point in points] == ["NSK"] * 10 + ["IBC"] * 9


def test_a_row_is_a_pair_of_bearings(points):
    """NSK TAC B 30x62, preload C10: 3350 N, 1030 N/µm, 0.24 N m."""
    pair = bs.SupportBearing(
        bore=0.030,
        outside_diameter=0.062,
        contact_angle=math.radians(60),
        lubricant=bs.Lubricant.from_grade("ISO VG 68", 298.15),
        preload=3350.0,
    )
    found = {point.name: point for point in points}["NSK TAC B 30x62, 3350 N"]
    assert found.ratio == pytest.approx(float(pair.rigidity()) / 1030e6, rel=1e-12)
    for name, rpm in (("torque", 100), ("torque_at_10_rpm", 10)):
        torque = float(pair(bs.OperatingState(0.0, rpm * math.pi / 30)).friction_effort)
        assert found.definitions[name] == pytest.approx(torque / 0.24, rel=1e-12)


def test_rigidity_grows_faster_than_the_cube_root_of_the_preload(points):
    """Property: R ∝ Q^(1/3) sin²α of Hertz, and the angle α opens with the load, from 60° to 90° at most."""
    by_name = {point.name: point.value for point in points}
    most = 1 / 3 + math.log2(1 / math.sin(math.radians(60)) ** 2)
    for sizes, loads in (("17x47", (875, 1750, 3500)), ("30x72", (1700, 3400, 6800)), ("45x75", (1700, 3400, 6800))):
        exponents = np.diff(np.log2([by_name[f"IBC BS {sizes}, {load} N"] for load in loads]))
        assert np.all((exponents > 1 / 3) & (exponents < most))
