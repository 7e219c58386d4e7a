"""Screws that are a part of an axis whose torque is known: rows as printed, one by hand, order, and the bound."""

import math

import pytest

from ballscrew.evidence.validation.entries import Entry
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.questions.validate import compute

REFERENCE = FrictionModel.reference()
WHOLES = {name: data for name, data in SETS.items() if data.bound and data.alternatives}


def entry(name):
    data = WHOLES[name]
    rows = compute.shipped_rows(data)
    points = [point for values in rows for point in data.evaluate(REFERENCE, values, data.conditions)]
    return Entry(data=data, model=REFERENCE, calibration=None, points=points)


@pytest.fixture(scope="module")
def axis():
    return entry("emps")


@pytest.fixture(scope="module")
def actuator():
    return entry("thk-kr4620a")


def test_published_numbers(axis, actuator):
    stated = {point.name: point.band for point in (*axis.points, *actuator.points)}
    assert stated["double, VG 32 at 40 °C, 120 rpm"] == (0.0073, 0.0, 0.0073)
    assert stated["oversize, VG 100 at 25 °C, 2880 rpm"] == (0.01707, 0.0, 0.01707)
    assert stated["base oil 130 cSt, 4000 rpm"] == (0.4312, 0.0, 0.4312)
    assert stated["oil VG 32, 1000 rpm"] == (0.1078, 0.0, 0.1078)
    assert (len(axis.points), len(actuator.points)) == (32, 16)


def test_a_row_by_hand(axis):
    """A double nut on 8x2.5 with 136 N: its torque over that of the axis, and how both grow from 120 rpm on."""
    values = next(one for one in compute.shipped_rows(axis.data) if one["nut"] == "double")
    screw = screw_of(values).screw(nut=DoubleNut(preload=136.0))
    oil = Lubricant.from_grade("ISO VG 32", 313.15)

    def torque(rpm):
        return float(REFERENCE(screw, oil, axial_load=0.0, screw_speed=rpm * math.pi / 30).screw_torque)

    found = {point.name: point for point in axis.points}["double, VG 32 at 40 °C, 1440 rpm"]
    assert found.ratio == pytest.approx(torque(1440) / 0.01353, rel=1e-12)
    growth = torque(1440) / torque(120) / (0.01353 / 0.0073)
    assert found.definitions["growth"] == pytest.approx(growth, rel=1e-12)


def test_what_is_assumed_of_the_screws():
    """Preloads are 5 % of the rating by geometry, in whole newtons; balls of 3.175 mm have the root that is printed."""
    for data in WHOLES.values():
        for values in compute.shipped_rows(data):
            assert abs(values["preload"] - 0.05 * ratings_of(screw_of(values)).dynamic) <= 0.5
    row = screw_of(compute.shipped_rows(WHOLES["thk-kr4620a"])[0])
    # 12.5 mm, to a digit
    assert abs(row.groove_root_diameter - row.root_diameter) < 0.05e-3


def test_lubricants_are_in_the_order_of_the_actuator(actuator):
    """By the growth of the torque from 100 to 4000 rpm, in which the share of the screw does not count."""
    at = {point.name: point for point in actuator.points}
    of_screw, of_unit = {}, {}
    for oil in actuator.groups:
        slow, fast = at[f"{oil}, 100 rpm"], at[f"{oil}, 4000 rpm"]
        of_screw[oil], of_unit[oil] = fast.value / slow.value, fast.band.middle / slow.band.middle
        assert fast.definitions["growth"] == pytest.approx(of_screw[oil] / of_unit[oil], rel=1e-12)
        assert slow.definitions["growth"] == pytest.approx(1, rel=1e-12)
    assert sorted(of_screw, key=of_screw.get) == sorted(of_unit, key=of_unit.get)


def test_the_part_is_less_than_the_whole(axis, actuator):
    """Each screw of the actuator, and of the axis those with two contacts a ball; others may be none that was in it."""
    assert actuator.share_in_band == 1
    double = [group for name, group in axis.groups.items() if name.startswith("double")]
    assert [group.share_in_band for group in double] == [1, 1]


def test_stocked_nuts_of_an_unknown_preload_have_an_upper_bound():
    """As printed; each row at a medium preload over the greatest drag of its range."""
    data = SETS["thk-stock"]
    rows = {values["name"].partition(" ")[0]: values for values in compute.shipped_rows(data)}
    assert len(rows) == 19
    assert sum(values["spacer_balls"] == "yes" for values in rows.values()) == 10
    (point,) = data.evaluate(REFERENCE, rows["BNK1510-5.6"], data.conditions)
    assert (point.band, point.group) == ((0.098, 0.0, 0.098), "single, spacer balls")
    (in_range,) = SETS["hiwin-stock"].evaluate(REFERENCE, rows["BNK1510-5.6"], data.conditions)
    assert in_range.band[1:] == (0.02, 0.098)
    assert point.definitions["at_5_percent"] == pytest.approx(in_range.definitions["at_5_percent"] * 0.059 / 0.098)
    assert point.definitions["at_5_percent"] < point.ratio < point.definitions["at_8_percent"] < 1


def test_a_whole_is_a_bound_and_no_mean():
    assert list(WHOLES) == ["emps", "thk-kr4620a"]
    assert all(data.alternatives and not data.used_for for data in WHOLES.values())
