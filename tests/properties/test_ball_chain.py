"""Neighbouring balls: rubbing and net braking are two mechanisms, and each can be switched off, in every nut."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.laws import ball_chain
from ballscrew.physics.sizing.ratings import ratings_of

REFERENCE = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("ISO VG 100", 298.15)
SPEED = 100 * np.pi / 30
NUTS = {
    "row": bs.SingleNut(),
    "single": bs.SingleNut(angle_under_load=True),
    "double": bs.DoubleNut(preload=3000.0),
    "oversize": bs.OversizeBallNut(preload=2000.0),
}
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]


def friction(nut, **changed):
    model = dataclasses.replace(REFERENCE, **changed)
    return model(ROW.screw(nut=NUTS[nut]), OIL, axial_load=1500.0, screw_speed=SPEED)


@pytest.mark.parametrize("nut", NUTS)
def test_opposed_neighbours_rub_and_do_not_brake(nut):
    """What one neighbour pushes, the other holds: both races feel the same torque."""
    r = friction(nut)
    assert r.contributions["ball_to_ball"] > 0
    assert r.contributions["chain_braking"] == 0
    assert r.screw_torque == pytest.approx(r.nut_torque, rel=1e-12)
    assert friction(nut, ball_friction_coefficient=0.0).contributions["ball_to_ball"] == 0


@pytest.mark.parametrize("nut", NUTS)
def test_two_neighbours_rub_and_brake(nut):
    """Screw and nut torque differ by what pushes the balls along, of which the orbit takes a little under half."""
    opposed, r = friction(nut), friction(nut, ball_chain=ball_chain.two_neighbours)
    assert r.contributions["ball_to_ball"] == pytest.approx(opposed.contributions["ball_to_ball"], rel=0.05)
    assert 0.4 < r.contributions["chain_braking"] / (r.screw_torque - r.nut_torque) < 0.5
    assert sum(r.dissipation.values()) == pytest.approx(r.screw_torque * SPEED, rel=1e-9)
    if nut in ("row", "single"):
        pushed = r.ball_screw.loaded_balls * r.net_braking_force * r.frame.path_radius
        assert r.screw_torque - r.nut_torque == pytest.approx(pushed, rel=1e-11)


@pytest.mark.parametrize("nut", NUTS)
def test_parted_balls_do_neither(nut):
    """A law of the chain that is zero is a force of zero, with two contacts and with four."""
    parted = friction(nut, ball_chain=ball_chain.parted_neighbours)
    without = friction(nut, ball_force=ball_chain.ProportionalBallForce(0.0))
    assert parted.contributions["ball_to_ball"] == parted.contributions["chain_braking"] == 0
    assert parted.screw_torque == pytest.approx(without.screw_torque, rel=1e-12)
    assert parted.screw_torque < friction(nut).screw_torque


@pytest.mark.parametrize(
    "sizes", [(6, 1, 0.8), (16, 5, 3.0), (40, 10, 6.0), (63, 20, 6.5), (125, 20, 12.7)], ids="{0[0]}x{0[1]}".format
)
def test_rubbing_is_a_like_share_at_all_sizes(sizes):
    """The force between balls scales with their load: some 15 to 36 % of the drag of double nuts preloaded by 5 %."""
    d, lead, ball = (1e-3 * size for size in sizes)
    row = dataclasses.replace(
        ROW,
        nominal_diameter=d,
        lead=lead,
        ball_diameter=ball,
        turns=3.0,
        pitch_circle_diameter=None,
        nut_outer_diameter=None,
    )
    screw = row.screw(nut=bs.DoubleNut(preload=0.05 * float(ratings_of(row).dynamic)))
    found = REFERENCE(screw, OIL, axial_load=0.0, screw_speed=SPEED)
    assert 0.15 <= found.contributions["ball_to_ball"] / found.screw_torque <= 0.36
