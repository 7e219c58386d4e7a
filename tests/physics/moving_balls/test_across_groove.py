"""Balls off the line of their grooves: two derivations, limits, and what a preload set at rest becomes."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import SCREW
from ballscrew.physics.equations import across_groove, rigidity
from ballscrew.physics.friction.across_groove import friction_across, preload_off_line
from ballscrew.physics.laws.frame import helix_frame
from ballscrew.physics.moving_balls.brush import BallContacts, Brush
from ballscrew.physics.moving_balls.reversal import off_line_balls
from ballscrew.physics.moving_balls.ripple import torque_ripple
from oracles.ball_in_grooves import HalfNut
from support.screws import with_grooves

REFERENCE = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("VG 100", temperature=313.15)
SPEED = 2 * math.pi * 100 / 60


def screw_of(d_m, lead, d_w, balls, conformity=0.54):
    """A screw by its sizes in millimetres."""
    sizes = {"pitch_circle_diameter": d_m * 1e-3, "lead": lead * 1e-3, "ball_diameter": d_w * 1e-3}
    return with_grooves(conformity, loaded_balls=balls, **sizes)


#: Screws from 6×1 to 125×20, and the load of a ball, N, at some 5 % of the dynamic rating.
SCREWS = {
    "6x1": (screw_of(6.2, 1, 0.8, 24), 1.4),
    "20x5": (screw_of(20.5, 5, 3, 24), 12.0),
    "paper": (dataclasses.replace(SCREW, loaded_balls=24), 12.0),
    "40x10": (screw_of(41, 10, 6, 30), 41.0),
    "63x10": (screw_of(64, 10, 6, 36), 33.0),
    "125x20": (screw_of(128, 20, 12.7, 36), 128.0),
}


def half(screw, load):
    """The friction of a single nut under a ball load."""
    axial = load * screw.loaded_balls * math.sin(screw.contact_angle) * math.cos(screw.lead_angle)
    return axial, REFERENCE(screw, OIL, axial_load=axial, screw_speed=SPEED)


def bristles_in_motion(screw, found):
    """The bristles of a ball after they have settled in steady motion, and their last step."""
    ball = found.kinds[0].friction
    brush = Brush(BallContacts.of(screw, found.frame, ball.screw, ball.nut))
    cell = brush.ball.cell / brush.ball.rolled
    crossing = float(ball.lateral_force) / brush.ball.hold / (brush.ball.lateral / 2)
    step = None
    for _ in range(math.ceil(max(4 * crossing / cell, 100))):
        step = brush.turn(cell)
    return brush, step


@pytest.mark.slow
@pytest.mark.parametrize("name", SCREWS)
@pytest.mark.parametrize("elastic", [False, True], ids=["rigid", "elastic"])
def test_two_derivations_of_the_angles_and_of_the_load(name, elastic):
    """Strips and a closed triangle against bristles with the ball's freedom and a balance of vectors.

    Measured: angles within 1.5 %, loads within 0.7 %; of them the two statics alone agree within 0.02 %.
    """
    screw, load = SCREWS[name]
    axial, found = half(screw, load)
    ball = found.kinds[0].friction
    difference = 2 * float(ball.lateral_force / ball.contact_load)
    _, step = bristles_in_motion(screw, found)
    by_bristles = 2 * step.lateral_force / load
    assert by_bristles == pytest.approx(difference, rel=0.05)
    bodies = bs.Bodies(swelling=False) if elastic else None
    nut = bs.DoubleNut(preload=axial, bodies=bodies)
    braced = dataclasses.replace(screw, nut=nut)
    ratio = preload_off_line(braced, math.atan(difference / 2)) / axial
    _, at_rest, moving = HalfNut.of(braced, bodies).preload_in_motion(axial, by_bristles / 2)
    assert np.mean(moving) / np.mean(at_rest) == pytest.approx(ratio, rel=0.05)
    # the statics by themselves, at one angle
    _, at_rest, moving = HalfNut.of(braced, bodies).preload_in_motion(axial, difference / 2)
    assert np.mean(moving) / np.mean(at_rest) == pytest.approx(ratio, rel=2e-3)


def test_the_ball_lies_where_its_normals_hold_it():
    """The distance of bristles in motion is that of the triangle: arm times lateral force over load."""
    screw, load = SCREWS["40x10"]
    _, found = half(screw, load)
    ball = found.kinds[0].friction
    brush, step = bristles_in_motion(screw, found)
    arm = 0.04 * 6e-3 + float(ball.screw.mutual_approach)
    beta = across_groove.lateral_friction_angle(step.lateral_force, load)
    assert abs(brush.distance) == pytest.approx(across_groove.off_line_distance(arm, arm, beta), rel=5e-3)


def test_the_triangle_of_the_centres():
    """Three sides and the angle between two of them: exact, whatever the arms."""
    rng = np.random.default_rng(4)
    a, b, beta = 1e-4 + 5e-4 * rng.random(50), 1e-4 + 5e-4 * rng.random(50), 0.3 * rng.random(50)
    screw, nut = a * np.exp(1j * (np.pi - beta)), b * np.exp(1j * beta)  # from the ball to both centres
    s = across_groove.off_line_centre_distance(a, b, beta)
    np.testing.assert_allclose(abs(screw - nut), s, rtol=1e-14)
    height = abs((np.conj(screw) * nut).imag) / abs(screw - nut)
    np.testing.assert_allclose(across_groove.off_line_distance(a, b, beta), height, rtol=1e-12)
    np.testing.assert_allclose(across_groove.off_line_growth(s, a, b, beta), a + b - s, atol=1e-18)


def test_without_friction_across_nothing_moves():
    screw, _ = SCREWS["40x10"]
    braced = dataclasses.replace(screw, nut=bs.DoubleNut(preload=3000.0))
    assert preload_off_line(braced, 0.0) == 3000.0
    elastic = dataclasses.replace(screw, nut=bs.DoubleNut(preload=3000.0, bodies=bs.Bodies()))
    assert preload_off_line(elastic, 0.0) == pytest.approx(3000.0, rel=1e-9)


def test_a_preload_set_at_rest_is_a_larger_one_in_motion():
    """Balls press 1.4 to 1.6 times as hard in a 40×10, and friction grows with them."""
    screw, _ = SCREWS["40x10"]
    nuts = {rest: bs.DoubleNut(preload=900.0, set_at_rest=rest) for rest in (False, True)}
    found = {
        rest: REFERENCE(dataclasses.replace(screw, nut=nut), OIL, axial_load=np.array([0.0, 500.0]), screw_speed=SPEED)
        for rest, nut in nuts.items()
    }
    ratio = found[True].loads.remaining_preload[0] / 900.0
    assert 1.4 < ratio < 1.6
    torque = found[True].screw_torque / found[False].screw_torque
    assert 1 < torque[1] < torque[0] < ratio
    same = dataclasses.replace(screw, nut=bs.DoubleNut(preload=float(ratio) * 900.0))
    given = REFERENCE(same, OIL, axial_load=np.array([0.0, 500.0]), screw_speed=SPEED)
    np.testing.assert_allclose(given.screw_torque, found[True].screw_torque, rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("bodies", [None, bs.Bodies()], ids=["rigid", "elastic"])
def test_rest_is_the_limit_of_a_vanishing_speed_and_a_first_start_its_own_state(bodies):
    """Friction holds the balls off their line where the nut stops; one that was never turned has its preload as set."""
    screw, _ = SCREWS["40x10"]

    def torque(speed, *, set_at_rest=True):
        nut = bs.DoubleNut(preload=900.0, bodies=bodies, set_at_rest=set_at_rest)
        braced = dataclasses.replace(screw, nut=nut)
        return float(REFERENCE(braced, OIL, axial_load=100.0, screw_speed=speed).screw_torque)

    assert torque(0.0) == pytest.approx(torque(1e-12), rel=1e-5)
    assert torque(0.0) > 2 * torque(0.0, set_at_rest=False)
    stopped = dataclasses.replace(screw, nut=bs.DoubleNut(preload=900.0, bodies=bodies, set_at_rest=True))
    from_rest = bs.breakaway(REFERENCE, stopped, OIL, axial_load=100.0)
    moving = REFERENCE(stopped, OIL, axial_load=100.0, screw_speed=1e-12)
    left = float(moving.loads.remaining_preload)
    assert float(from_rest.at_rest.loads.remaining_preload) == pytest.approx(left, rel=1e-5)
    assert 1 < float(from_rest.torque) / torque(0.0) < 0.15 / 0.12  # the balls also rub each other


@pytest.mark.slow
def test_a_set_preload_is_swept_as_it_is_evaluated():
    """Recorded between rigid bodies, by the model itself between elastic ones."""
    screw, _ = SCREWS["20x5"]
    for bodies in (None, bs.Bodies()):
        set_at_rest = dataclasses.replace(screw, nut=bs.DoubleNut(preload=500.0, bodies=bodies, set_at_rest=True))
        direct = REFERENCE(set_at_rest, OIL, axial_load=200.0, screw_speed=SPEED).screw_torque
        swept = bs.sweep(
            REFERENCE,
            set_at_rest,
            OIL,
            outputs=["screw_torque"],
            preload=[400.0, 500.0],
            axial_load=[200.0],
            screw_speed=[SPEED],
        )
        assert float(swept.screw_torque[1, 0, 0]) == pytest.approx(float(direct), rel=1e-9)
        assert float(swept.screw_torque[0, 0, 0]) < float(direct)


def test_four_contacts_keep_the_ball_on_its_line():
    """The other flanks are far stiffer across than the leaning normals: the slope of Hertz against Q over an arm."""
    screw, load = SCREWS["40x10"]
    A = rigidity.groove_centre_distance(0.54, 0.54, 6e-3)
    approach = 3.4e-6
    of_flanks = 1.5 * load / approach
    leaning = 2 / across_groove.groove_compliance(load, A / 2, A / 2) * 2
    assert leaning == pytest.approx(2 * load / (A / 2), rel=1e-12)
    assert of_flanks > 50 * leaning
    oversize, double = (
        bs.breakaway(REFERENCE, dataclasses.replace(screw, nut=nut), OIL, axial_load=0.0)
        for nut in (bs.OversizeBallNut(preload=3000.0), bs.DoubleNut(preload=3000.0))
    )
    assert oversize.lateral_stiffness > 50 * double.lateral_stiffness


def test_without_lateral_slip_the_ball_stays_near_its_line():
    """What is left is the thrust of the spin, which elastic contacts have: a seventh of what the helix does."""
    screw, load = SCREWS["40x10"]
    _, found = half(screw, load)
    ball = found.kinds[0].friction
    contacts = BallContacts.of(screw, found.frame, ball.screw, ball.nut)
    without, with_it = Brush(dataclasses.replace(contacts, lateral=0.0)), Brush(contacts)
    for _ in range(900):
        thrust, dragged = (brush.turn(contacts.cell / contacts.rolled) for brush in (without, with_it))
    assert 0 < abs(without.distance) < abs(with_it.distance) / 5
    assert abs(thrust.lateral_force) < abs(dragged.lateral_force) / 5


@pytest.mark.parametrize(("preload", "rpm"), [(900.0, 100), (100.0, 100), (900.0, 1), (50.0, 1000)])
def test_friction_and_load_settle(preload, rpm):
    """The preload in motion is that of balls whose friction is that of the preload in motion."""
    screw, _ = SCREWS["40x10"]
    nut = bs.DoubleNut(preload=preload, set_at_rest=True)
    at_rest, speed = dataclasses.replace(screw, nut=nut), 2 * math.pi * rpm / 60
    found = REFERENCE(at_rest, OIL, axial_load=0.0, screw_speed=speed)
    share = np.mean([friction_across(kind) for kind in found.kinds])
    settled = preload_off_line(dataclasses.replace(screw, nut=bs.DoubleNut(preload=preload)), math.atan(share))
    assert found.ball_screw.nut.preload == pytest.approx(float(settled), rel=2e-3)


def test_without_preload_nothing_grows_and_the_flag_is_true_or_false():
    screw, _ = SCREWS["40x10"]
    nothing = bs.DoubleNut(preload=0.0, bodies=bs.Bodies(), set_at_rest=True)
    idle = REFERENCE(dataclasses.replace(screw, nut=nothing), OIL, axial_load=100.0, screw_speed=SPEED)
    assert idle.ball_screw.nut.preload == 0
    with pytest.raises(bs.InputError, match=r"nut\.set_at_rest: must be true or false"):
        bs.DoubleNut(preload=900.0, set_at_rest="no")


@pytest.mark.slow
def test_the_chain_and_the_ripple_are_of_the_nut_in_motion():
    """As of a nut that is given the preload which it has there."""
    screw, _ = SCREWS["40x10"]
    point = {"axial_load": 100.0, "screw_speed": SPEED}
    circuit = {**point, "gap": 0.5, "groove_deviation": 1e-6, "seed": 1}
    set_at_rest = dataclasses.replace(screw, nut=bs.DoubleNut(preload=900.0, set_at_rest=True))
    preload = float(REFERENCE(set_at_rest, OIL, **point).ball_screw.nut.preload)
    assert preload > 1.3 * 900
    in_motion = dataclasses.replace(screw, nut=bs.DoubleNut(preload=preload))
    one, other = (bs.moving_chain(REFERENCE, each, OIL, **circuit) for each in (set_at_rest, in_motion))
    np.testing.assert_allclose(one.loads, other.loads, rtol=1e-9)
    torques = [torque_ripple(REFERENCE, each, OIL, **circuit, turns=2).torque for each in (set_at_rest, in_motion)]
    np.testing.assert_allclose(*torques, rtol=1e-9)


@pytest.mark.slow
def test_a_dataset_says_that_the_preload_was_set_at_rest():
    screw, _ = SCREWS["20x5"]
    of = {
        rest: bs.sweep(
            REFERENCE,
            dataclasses.replace(screw, nut=bs.DoubleNut(preload=500.0, set_at_rest=rest)),
            OIL,
            outputs=["screw_torque"],
            axial_load=[200.0],
            screw_speed=[SPEED],
        )
        for rest in (True, False)
    }
    assert of[True].attrs["nut_set_at_rest"] == "true"
    assert "nut_set_at_rest" not in of[False].attrs


def test_the_stiffness_from_rest_is_that_of_the_leaning_normals():
    """That of stiff contacts: twice the load over the arm, on a quarter of the diameter for each radian."""
    screw, load = SCREWS["40x10"]
    axial, _ = half(screw, load)
    found = bs.breakaway(REFERENCE, screw, OIL, axial_load=axial)
    Q, A_1, rho = load, 0.04 * 6e-3, 3e-3
    lever = rho * math.sin(screw.lead_angle) / 2
    assert found.lateral_stiffness == pytest.approx(screw.loaded_balls * 2 * Q / A_1 * lever**2, rel=0.02)
    assert math.degrees(found.presliding_angle) > 5


@pytest.mark.parametrize("way", [1, -1], ids=["lifted", "lowered"])
def test_the_spin_of_leaning_normals_is_that_of_bodies_in_space(way):
    """Rotations as vectors along the path, across it and along the normal on the line, of a ball that rolls on both
    races.
    """
    screw, _ = SCREWS["40x10"]
    frame, rho, beta = helix_frame(screw), 3e-3, way * 0.07
    alpha, phi, L = math.pi / 4, float(screw.lead_angle), float(frame.path_radius)
    axis = np.array([math.sin(phi), math.cos(phi) * math.cos(alpha), math.cos(phi) * math.sin(alpha)]) * way
    at_nut = np.array([0.0, math.sin(beta), math.cos(beta)])
    at_screw = np.array([0.0, math.sin(beta), -math.cos(beta)])

    def sliding(unknowns):
        """Slip along the path, race against ball, at screw and nut."""
        speed, rotation = np.array([unknowns[0], 0, 0]), np.array([0, unknowns[1], 0])
        of_screw = way * np.array([L, 0, 0]) + np.cross(axis, rho * at_screw)
        return np.array(
            [(of_screw - speed - np.cross(rotation, rho * at_screw))[0], (-speed - np.cross(rotation, rho * at_nut))[0]]
        )

    slope = np.column_stack([sliding([1, 0]) - sliding([0, 0]), sliding([0, 1]) - sliding([0, 0])])
    speed, rolling = np.linalg.solve(slope, -sliding([0, 0]))
    rotation = np.array([0, rolling, 0])
    spun = (axis - rotation) @ at_screw - rotation @ at_nut
    v = float(frame.entrainment_speed(1.0))
    radii = rho * (1 - frame.curvature_ratio), rho * (1 + frame.curvature_ratio)
    total = float(frame.rolling_plane_sine)
    expected = across_groove.off_line_spin(total, v / radii[0], v / radii[1], beta)
    # the equation leaves out what is of the second order in the lean
    assert -way * spun == pytest.approx(expected, abs=1e-2 * total)
    assert way * speed > 0


def test_the_spin_falls_where_the_load_is_lifted():
    """And friction with it: some 3 % less than of balls on their line, and 4 % more where the load is lowered."""
    screw, load = SCREWS["40x10"]
    axial, _ = half(screw, load)
    (up,), (down,) = (off_line_balls(REFERENCE, screw, OIL, axial_load=axial, screw_speed=w) for w in (SPEED, -SPEED))
    assert 0.2 < up.spin_share < 0.4 < 1.5 < down.spin_share < 1.7
    assert 0.95 < up.torque_ratio < 1 < down.torque_ratio < 1.06
    assert up.nut_contact_angle - up.screw_contact_angle == pytest.approx(2 * up.lateral_friction_angle, rel=1e-12)
    assert down.lateral_friction_angle < 0 < up.lateral_friction_angle
    assert 1e-6 < down.axial_step < up.axial_step < 2.5e-6


def test_one_half_of_a_double_nut_lifts_and_the_other_lowers():
    screw, _ = SCREWS["40x10"]
    braced = dataclasses.replace(screw, nut=bs.DoubleNut(preload=900.0, bodies=bs.Bodies()))
    one, other = off_line_balls(REFERENCE, braced, OIL, axial_load=np.array([0.0, 100.0]), screw_speed=SPEED)
    assert np.all(one.spin_share < 1)
    assert np.all(other.spin_share > 1)
    oversize = dataclasses.replace(screw, nut=bs.OversizeBallNut(preload=900.0))
    with pytest.raises(bs.InputError, match=r"nut\.type: has balls on four contacts"):
        off_line_balls(REFERENCE, oversize, OIL, axial_load=0.0, screw_speed=SPEED)
