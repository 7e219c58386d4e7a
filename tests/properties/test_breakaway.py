"""From rest: what holds, how stiffly, and whether the load starts by itself."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.equations import presliding
from ballscrew.physics.laws.friction import LoadSharing

REFERENCE = bs.FrictionModel.reference()


def test_stiffnesses_of_a_round_contact():
    """Mindlin's: 4 a G/(2 − ν) and 8 G a³/3 where both bodies are alike."""
    G, nu, a = 80e9, 0.3, 1e-4
    assert presliding.shear_modulus(2 * G * (1 + nu), nu) == pytest.approx(G, rel=1e-15)
    assert presliding.tangential_stiffness(a, G, nu, G, nu) == pytest.approx(4 * a * G / (2 - nu), rel=1e-14)
    assert presliding.torsional_stiffness(a, G, G) == pytest.approx(8 / 3 * G * a**3, rel=1e-14)
    assert presliding.tangential_stiffness(a, G, nu, math.inf, nu) == pytest.approx(8 * a * G / (2 - nu), rel=1e-14)


def test_the_steady_torque_goes_to_that_from_rest():
    """With one friction coefficient there is no jump: breakaway is the limit of the steady torque at rest."""
    steady = dataclasses.replace(REFERENCE, friction=LoadSharing(0.15, decay=0.0))
    started = bs.breakaway(REFERENCE, SCREW, OIL, axial_load=4000.0)
    crept = steady(SCREW, OIL, axial_load=4000.0, screw_speed=1e-9)
    assert crept.screw_torque == pytest.approx(started.torque, rel=1e-4)
    # as shipped, friction from rest is above that of creeping, and that above the one at speed
    creeping, turning = (REFERENCE(SCREW, OIL, axial_load=4000.0, screw_speed=w).screw_torque for w in (1e-9, 1.0))
    assert started.torque > creeping > turning


def test_more_static_friction_holds_more():
    found = [
        bs.breakaway(REFERENCE, SCREW, OIL, axial_load=4000.0, static_friction_coefficient=mu) for mu in (0.1, 0.2)
    ]
    assert found[0].torque < found[1].torque
    assert found[0].presliding_angle < found[1].presliding_angle
    assert found[0].stiffness == found[1].stiffness


def test_whether_the_load_starts():
    """A preload holds a small load at rest, of either sign, and not a large one."""
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=4326.0))
    found = bs.breakaway(REFERENCE, screw, OIL, axial_load=np.array([-5000.0, -100.0, 0.0, 100.0, 5000.0]))
    assert found.starts_to_back_drive.tolist() == [True, False, False, False, True]
    assert found.holding_torque[-1] == pytest.approx(-found.holding_torque[0], rel=1e-12)
    assert np.all(found.presliding_angle > 0)
    unloaded = bs.breakaway(REFERENCE, SCREW, OIL, axial_load=0.0)
    assert (unloaded.stiffness, bool(unloaded.starts_to_back_drive)) == (0, False)
    assert math.isnan(unloaded.presliding_angle)


@pytest.mark.parametrize(
    ("nut", "relative"), [(bs.DoubleNut(preload=3605.0), 1e-9), (bs.OversizeBallNut(preload=3605.0), 8e-3)]
)
def test_flanks_that_have_lifted_off_hold_nothing(nut, relative):
    """Far beyond lift-off one half carries the load alone; oversize balls do so at an angle of their own."""
    row = bs.catalogue()["rexroth-40x10x6-6-double"]
    preloaded, alone = (
        bs.breakaway(REFERENCE, row.screw(nut=each), OIL, axial_load=30e3)
        for each in (nut, bs.SingleNut(angle_under_load=True))
    )
    assert preloaded.stiffness == pytest.approx(alone.stiffness, rel=relative)


def test_a_model_without_spin_does_not_say_what_winds_up():
    found = bs.breakaway(bs.FrictionModel.olaru2005(), SCREW, OIL, axial_load=4000.0)
    assert math.isnan(found.presliding_angle)
    assert found.torque > 0


def test_a_coefficient_without_meaning_is_refused():
    with pytest.raises(bs.InputError, match=r"breakaway\.static_friction_coefficient: must be above zero \(0\.0\)"):
        bs.breakaway(REFERENCE, SCREW, OIL, axial_load=1.0, static_friction_coefficient=0.0)
