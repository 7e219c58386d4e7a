"""The stiffness chain of an axis: what it is the sum of, and the shaft on three supports against exact roots."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

import ballscrew as bs
from ballscrew.axis.supports.element_laws import support_units
from ballscrew.axis.supports.stiffness import buckling_root, stiffness_over_stroke, whirling_root
from ballscrew.physics.sizing.installation import Ends, Installation

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
SCREW = ROW.screw(nut=bs.DoubleNut(preload=3605.0))
LENGTH = 1.2
MOUNTED = Installation(
    unsupported_length=LENGTH, ends=Ends.FIXED_SUPPORTED, bearing_rigidity=support_units()["BK40"].rigidity
)
FOUND = stiffness_over_stroke(SCREW, installation=MOUNTED, mount_rigidity=8e8, accuracy_factor=0.5)


def test_compliances_of_the_parts_sum_to_the_whole():
    np.testing.assert_allclose(1 / FOUND.total, sum(1 / part for part in FOUND.parts.values()), rtol=1e-14)
    np.testing.assert_allclose(sum(FOUND.shares.values()), 1.0, rtol=1e-14)


def test_nut_shaft_and_bearings_are_those_of_the_drive():
    drives = [
        bs.rigidity_iso3408(SCREW, installation=MOUNTED, accuracy_factor=0.5, distance_to_bearing=float(place)).drive
        for place in FOUND.position
    ]
    parts = (FOUND.nut, FOUND.shaft, FOUND.bearings)
    np.testing.assert_allclose(1 / sum(1 / part for part in parts), drives, rtol=1e-12)


def test_twist_of_the_shaft_stores_the_work_of_the_force():
    """Half of F u is half of T θ, of a bar twisted by F P/2π."""
    force, place = 5000.0, FOUND.position[3]
    torque = force * SCREW.lead / (2 * math.pi)
    diameter = SCREW.pitch_circle_diameter - SCREW.ball_diameter * math.cos(SCREW.contact_angle)
    shear = SCREW.screw_material.young_modulus / (2 * (1 + SCREW.screw_material.poisson_ratio))
    angle = torque * place / (shear * math.pi * diameter**4 / 32)
    assert force * (force / FOUND.torsion[3]) == pytest.approx(torque * angle, rel=1e-12)


def test_lost_motion_is_twice_the_wind_up():
    np.testing.assert_allclose(FOUND.lost_motion(60.0), 120.0 / FOUND.total, rtol=1e-15)
    assert np.all(np.diff(FOUND.lost_motion(60.0)) > 0)


def test_two_fixed_bearings_are_softest_between_them_but_for_the_twist():
    both = stiffness_over_stroke(SCREW, installation=dataclasses.replace(MOUNTED, ends=Ends.FIXED_FIXED))
    np.testing.assert_allclose(both.shaft, both.shaft[::-1], rtol=1e-12)
    np.testing.assert_allclose(both.bearings, both.bearings[::-1], rtol=1e-9)
    assert np.argmin(both.shaft) == len(both.shaft) // 2
    assert both.total[0] > both.total[-1]
    assert np.all(both.total >= stiffness_over_stroke(SCREW, installation=MOUNTED).total * (1 - 1e-12))


def test_a_nut_at_a_bearing_changes_nothing_that_the_bearing_does_not():
    for ends in (Ends.FIXED_FIXED, Ends.FIXED_SUPPORTED, Ends.SUPPORTED_SUPPORTED):
        assert whirling_root(ends, 1.0) == pytest.approx(ends.whirling_root, rel=1e-6)
        assert whirling_root(ends, 0.0) == pytest.approx(ends.whirling_root, rel=1e-6)
    assert whirling_root(Ends.FIXED_FREE, 0.0) == pytest.approx(Ends.FIXED_FREE.whirling_root, rel=1e-6)
    assert whirling_root(Ends.FIXED_FREE, 1.0) == pytest.approx(Ends.FIXED_SUPPORTED.whirling_root, rel=1e-6)
    for ends in (Ends.FIXED_SUPPORTED, Ends.SUPPORTED_SUPPORTED):
        assert buckling_root(ends, 1.0) == pytest.approx(ends.buckling_root, rel=1e-6)


def test_a_nut_in_the_middle_of_alike_halves():
    """The shaft swings as two halves that are hinged there."""
    supported, fixed = Ends.SUPPORTED_SUPPORTED, Ends.FIXED_FIXED
    assert whirling_root(supported, 0.5) == pytest.approx(2 * math.pi, rel=1e-6)
    assert whirling_root(fixed, 0.5) == pytest.approx(2 * Ends.FIXED_SUPPORTED.whirling_root, rel=1e-6)


def test_a_nut_that_clamps_parts_the_shaft_in_two():
    share = 0.4
    clamped = {"nut_holds_slope": True}
    found = whirling_root(Ends.FIXED_SUPPORTED, share, **clamped)
    assert found == pytest.approx(Ends.FIXED_SUPPORTED.whirling_root / (1 - share), rel=1e-6)
    assert buckling_root(Ends.FIXED_SUPPORTED, share, **clamped) == pytest.approx(2 * math.pi / share, rel=1e-5)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_buckling_between_a_fixed_bearing_and_the_nut(share):
    """A column clamped at one end whose other is held by the bending of the rest of the shaft, a beam on a hinge."""
    beyond = 3 / (1 - share)

    def restraint(beta):
        u = beta * share
        own = u * (math.sin(u) - u * math.cos(u)) / (2 * (1 - math.cos(u)) - u * math.sin(u))
        return own / share + beyond

    lowest = brentq(restraint, Ends.FIXED_SUPPORTED.buckling_root / share + 1e-9, 2 * math.pi / share - 1e-9)
    assert buckling_root(Ends.FIXED_SUPPORTED, share) == pytest.approx(lowest, rel=1e-5)


def test_speed_and_load_are_those_of_the_roots():
    found = stiffness_over_stroke(SCREW, installation=MOUNTED, positions=[0.6], root_diameter=0.034)
    E, root = SCREW.screw_material.young_modulus, whirling_root(Ends.FIXED_SUPPORTED, 0.5)
    expected = root**2 * 0.034 / (4 * LENGTH**2) * math.sqrt(E / MOUNTED.shaft_density)
    assert found.critical_speed[0] == pytest.approx(expected, rel=1e-12)
    bent = E * math.pi * 0.034**4 / 64
    expected = buckling_root(Ends.FIXED_SUPPORTED, 0.5) ** 2 * bent / LENGTH**2
    assert found.buckling_load[0] == pytest.approx(expected, rel=1e-12)


def test_what_is_assumed_is_said():
    bare = stiffness_over_stroke(SCREW, installation=dataclasses.replace(MOUNTED, bearing_rigidity=None))
    said = " ".join(bare.assumed)
    for words in ("mount rigid", "support bearings rigid", "lets it turn", "not R_nu,ar"):
        assert words in said
    assert np.all(np.isinf(bare.bearings))
    assert np.all(bare.total > FOUND.total)


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"positions": [0.2, 1.3]}, "stiffness.positions"),
        ({"mount_rigidity": 0.0}, "stiffness.mount_rigidity"),
        ({"root_diameter": -1.0}, "stiffness.root_diameter"),
    ],
)
def test_faults_name_the_field(given, field):
    with pytest.raises(bs.InputError) as raised:
        stiffness_over_stroke(SCREW, installation=MOUNTED, **given)
    assert [fault.field for fault in raised.value.faults] == [field]
