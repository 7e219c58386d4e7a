"""The law of the chain: the share that it derives, its parts, and laws that read the ball."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.uncertainty.uncertain_value import default_distributions
from ballscrew.physics.equations import ball_chain
from ballscrew.physics.laws.ball_chain import ChainBallForce
from ballscrew.physics.laws.traits import law_traits
from ballscrew.physics.moving_balls.loaded_zone import creep

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
REFERENCE = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
OMEGA = 100 * 2 * math.pi / 60
DOUBLE = ROW.screw(nut=bs.DoubleNut(preload=0.05 * ROW.dynamic_load_rating))
OVERSIZE = ROW.screw(nut=bs.OversizeBallNut(preload=0.05 * ROW.dynamic_load_rating))


def share_of(law, screw=DOUBLE, load=0.0, speed=OMEGA, oil=OIL):
    found = dataclasses.replace(REFERENCE, ball_force=law)(screw, oil, axial_load=load, screw_speed=speed)
    return found.kinds[0].friction.ball_to_ball_force / found.kinds[0].load


def test_a_jammed_circuit_has_the_share_of_the_reference():
    # nothing fitted: grooves of 1 um (±2 um along the axis), no gap, a 40x10 at 5 % of its rating: 0.00752
    assert share_of(ChainBallForce(gap=0.0, return_turns=0.0)) == pytest.approx(0.0075, rel=0.01)


def test_the_share_goes_with_the_deviation_where_jammed_and_vanishes_with_it():
    one, two = (share_of(ChainBallForce(gap=0.0, groove_deviation=e, return_turns=0.0)) for e in (1e-6, 2e-6))
    assert two == pytest.approx(2 * one, rel=1e-12)
    assert share_of(ChainBallForce(groove_deviation=0.0, return_turns=0.0)) == 0


def test_what_is_left_of_perfect_grooves_is_the_push_of_the_return():
    law = ChainBallForce(groove_deviation=0.0)
    found = dataclasses.replace(REFERENCE, ball_force=law)(DOUBLE, OIL, axial_load=0.0, screw_speed=OMEGA)
    ball, frame = found.kinds[0].friction, found.kinds[0].friction.frame
    speed = OMEGA * frame.path_radius * (1 - frame.curvature_ratio) / 2
    f = ball_chain.return_resistance(
        REFERENCE.ball_friction_coefficient,
        ball_chain.ball_mass(6e-3, 7850.0),
        9.80665,
        OIL.viscosity,
        6e-3,
        speed,
        10.0,
    )
    resting = 0.5 * ball_chain.balls_of_a_turn(frame.path_radius, 6e-3)
    assert ball.ball_to_ball_force == pytest.approx(0.5 * resting * f / DOUBLE.loaded_balls, rel=1e-12)


def test_the_gap_frees_the_balls():
    # all balls in one circuit: 0.0075 at none, 1.1e-3 at 0.03 and below 1e-4 at 0.55 balls
    shares = [share_of(ChainBallForce(gap=gap)) for gap in (0.0, 0.03, 0.1, 0.55)]
    assert np.all(np.diff(shares) < 0)
    assert shares[1] < 0.3 * shares[0]
    assert shares[3] < 1e-4


def test_the_share_is_one_of_geometry_and_friction():
    # at rest and slowly, with a return that brakes by its weight alone: creep is a matter of distance
    law = ChainBallForce(gap=0.0, wall_factor=0.0, return_turns=0.0)
    at_rest, slow = (share_of(law, speed=speed) for speed in (0.0, 1e-15))
    assert at_rest == pytest.approx(slow, rel=1e-6)
    assert at_rest > 0


def test_four_contacts_creep_as_their_solver_says():
    # 1.4 in place of 9.1 at 42 N on each pair of flanks: a seventh; the solver of the slip has 1.7
    law = ChainBallForce(gap=0.0, return_turns=0.0)
    found = dataclasses.replace(REFERENCE, ball_force=law)(OVERSIZE, OIL, axial_load=0.0, screw_speed=OMEGA)
    ball = found.kinds[0].friction
    frame = REFERENCE.laws.frame(OVERSIZE)
    epsilon = ball_chain.rms_speed_deviation(frame.curvature_ratio, OVERSIZE.contact_angle, 1e-6, 0.08 * 6e-3)
    z_1 = ball_chain.balls_of_a_turn(frame.path_radius, 6e-3)
    load = ball.flanks[0].load + ball.flanks[1].load
    c = creep(REFERENCE, OVERSIZE, OIL, load, OMEGA, four_contacts=True).coefficient[0]
    expected = ball_chain.chain_force_share(c, epsilon, z_1, 1.0)
    assert ball.ball_to_ball_force / load == pytest.approx(expected, rel=0.10)
    assert ball.ball_to_ball_force / load < 0.25 * share_of(law)


def test_a_flank_that_lifts_off_changes_nothing_at_once():
    law = ChainBallForce(gap=0.0)
    model = dataclasses.replace(REFERENCE, ball_force=law)
    off = float(model(OVERSIZE, OIL, axial_load=1.0, screw_speed=OMEGA).solved_loads.lift_off_load)
    below, above = (
        model(OVERSIZE, OIL, axial_load=off * part, screw_speed=OMEGA).ball_to_ball_force for part in (0.99999, 1.00001)
    )
    assert below == pytest.approx(above, rel=0.02)


def test_balls_without_load_do_not_press():
    model = dataclasses.replace(REFERENCE, ball_force=ChainBallForce(gap=0.0))
    loads = np.array([0.0, 4e4])  # the second lifts the balls of one half off
    found = model(DOUBLE, OIL, axial_load=loads, screw_speed=OMEGA)
    assert np.all(np.isfinite(found.screw_torque))
    assert found.kinds[1].load[1] == 0
    assert found.kinds[1].sum_of(lambda ball: ball.contributions["ball_to_ball"])[1] == 0
    alone = dataclasses.replace(DOUBLE, nut=bs.SingleNut())
    assert model(alone, OIL, axial_load=0.0, screw_speed=OMEGA).ball_to_ball_force == 0


def test_torque_and_power_are_balanced():
    model = dataclasses.replace(REFERENCE, ball_force=ChainBallForce(gap=0.01))
    for screw in (DOUBLE, OVERSIZE):
        found = model(screw, OIL, axial_load=500.0, screw_speed=OMEGA)
        assert sum(found.contributions.values()) == pytest.approx(found.screw_torque, rel=1e-12)
        assert sum(found.dissipation.values()) == pytest.approx(found.screw_torque * OMEGA, rel=1e-9)


def test_a_sweep_gives_what_the_model_gives():
    model = dataclasses.replace(REFERENCE, ball_force=ChainBallForce(gap=0.05))
    gaps, speeds = [0.0, 0.05, 0.5], [0.0, 5.0, 60.0]
    for engine in ("numpy", "compiled"):
        found = bs.sweep(
            model,
            DOUBLE,
            OIL,
            axial_load=300.0,
            screw_speed=speeds,
            outputs=["screw_torque"],
            engine=engine,
            **{"ball_force.gap": gaps},
        )["screw_torque"]
        for gap in gaps:
            law = dataclasses.replace(model, ball_force=ChainBallForce(gap=gap))
            expected = law(DOUBLE, OIL, axial_load=300.0, screw_speed=np.array(speeds)).screw_torque
            here = found.sel({"ball_force.gap": gap}).to_numpy()
            assert here == pytest.approx(expected, rel=1e-10)


def two_arguments(ball_to_ball_force, contact_load):
    return 0.001 * contact_load


@law_traits(excluded="of a test", uses_imposed_force=False, reads_ball=True)
def three_arguments(ball_to_ball_force, contact_load, ball):
    return 0.002 * contact_load * (ball.spin > 0)


def test_laws_from_outside_take_two_arguments_or_three():
    for screw in (DOUBLE, OVERSIZE):
        assert share_of(two_arguments, screw) == pytest.approx(0.001, rel=1e-12)
        assert share_of(three_arguments, screw) == pytest.approx(0.002, rel=1e-12)


@pytest.mark.parametrize("name", ["gap", "groove_deviation", "circuits", "return_turns", "wall_factor"])
def test_a_coefficient_below_its_bound_is_refused(name):
    with pytest.raises(bs.InputError, match=rf"model\.ball_force\.{name}"):
        ChainBallForce(**{name: -0.1})


def test_gap_deviation_and_walls_are_uncertain():
    model = dataclasses.replace(REFERENCE, ball_force=ChainBallForce())
    usual = {name: distribution for name, (distribution, _) in default_distributions(model, DOUBLE, OIL).items()}
    ends = {
        name: [float(usual[f"ball_force.{name}"].quantile(q)) for q in (0.025, 0.975)]
        for name in ("gap", "groove_deviation", "wall_factor")
    }
    assert ends["gap"] == pytest.approx([0.05 + 0.025, 1.05 - 0.025], abs=1e-3)
    assert ends["groove_deviation"] == pytest.approx([0.5e-6, 2e-6], rel=1e-6)
    assert ends["wall_factor"] == pytest.approx([10 / 3, 30], rel=1e-6)
    assert "ball_force.share_of_load" not in usual
    assert "ball_to_ball_force" not in usual


def test_slopes_at_no_gap_and_at_no_deviation_are_numbers():
    # jammed, the gap changes nothing at first; in perfect grooves a deviation does not where there is room for it
    for law in (ChainBallForce(gap=0.0), ChainBallForce(groove_deviation=0.0)):
        model = dataclasses.replace(REFERENCE, ball_force=law)
        found = bs.derivatives(
            model, DOUBLE, OIL, by=["ball_force.gap", "ball_force.groove_deviation"], axial_load=0.0, screw_speed=OMEGA
        )
        assert float(found["d_screw_torque_d_ball_force_gap"]) == pytest.approx(0.0, abs=1e-12)
        by_deviation = float(found["d_screw_torque_d_ball_force_groove_deviation"])
        if law.gap == 0:
            assert by_deviation * 1e-6 == pytest.approx(float(found["screw_torque"]) * 0.332, rel=0.01)
        else:
            assert abs(by_deviation * 1e-6) < 1e-6 * float(found["screw_torque"])
