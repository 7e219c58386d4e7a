"""The torque of a nut over the angle: analytic orders and sums, laws of physics, and where a defect shows."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.physics.components.screw import SINGLE_NUT
from ballscrew.physics.equations.ball_chain import ball_pass_harmonic, ball_pass_order
from ballscrew.physics.moving_balls.chain import Circuit, chain_run
from ballscrew.physics.moving_balls.loaded_zone import loaded_zone
from ballscrew.physics.moving_balls.ripple import (
    FullCircuit,
    MissingBall,
    NutGroove,
    PreloadLeft,
    Spall,
    amplitudes_at,
    ball_torques,
    kinematic_orders,
    spectrum_of,
    torque_ripple,
    torques_of,
    with_defect,
)
from support.equations import amplitude_of, mirrored

MODEL = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("ISO VG 100")
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
OMEGA = 100 * math.pi / 30
#: A half of one circuit, some 20 balls of a turn: short enough for many runs.
SCREW = dataclasses.replace(ROW.screw(), loaded_balls=20, nut=bs.DoubleNut(preload=0.05 * 30e3))
POINT = {"axial_load": 0.0, "screw_speed": OMEGA, "gap": 0.7, "groove_deviation": 1e-6, "seed": 1, "return_balls": 10}


def ripple(screw=SCREW, **changes):
    return torque_ripple(MODEL, screw, OIL, **{**POINT, **changes})


def zone_of(screw=SCREW, **changes):
    given = {"axial_load": 0.0, "screw_speed": OMEGA, "groove_deviation": 0.0, "seed": 1}
    return loaded_zone(MODEL, screw, OIL, **{**given, **changes})


# -- tools ----------------------------------------------------------------------------------------


def test_amplitudes_at_known_orders_are_found():
    angle = 2 * math.pi * np.arange(0.0, 12.3, 0.013)
    values = 5.0 + 0.3 * np.cos(angle + 0.4) + 0.02 * np.sin(9.4 * angle) + 0.1 * np.cos(0.45 * angle)
    np.testing.assert_allclose(amplitudes_at(angle, values, [1.0, 9.4, 0.45, 2.0]), [0.3, 0.02, 0.1, 0.0], atol=1e-9)


def test_the_spectrum_has_the_amplitude_of_a_wave():
    angle = 2 * math.pi * np.arange(0.0, 20.0, 0.01)
    orders, amplitudes = spectrum_of(angle, 3.0 + 0.3 * np.cos(2 * angle))
    at = int(np.argmax(amplitudes))
    assert orders[at] == pytest.approx(2.0, rel=1e-9)
    assert amplitudes[at] == pytest.approx(0.3, rel=1e-6)


# -- the torque of balls --------------------------------------------------------------------------


def test_a_ball_has_the_friction_of_the_model():
    """A nut whose balls carry that load, without what neighbours do."""
    zone = zone_of()
    loads, torques = ball_torques(MODEL, SCREW, OIL, zone, OMEGA)
    assert (loads[0], torques[0]) == (0.0, 0.0)
    found = MODEL.parted(SCREW, OIL, axial_load=0.0, screw_speed=OMEGA)
    assert float(found.loads.forward_load[0]) == pytest.approx(zone.nominal_load, rel=1e-9)
    at_nominal = np.interp(zone.nominal_load, loads, torques)
    assert 2 * 20 * at_nominal == pytest.approx(float(found.screw_torque), rel=2e-3)


@pytest.mark.slow
def test_a_ball_on_four_contacts_has_the_friction_of_the_model():
    screw = dataclasses.replace(SCREW, nut=bs.OversizeBallNut(preload=900.0))
    zone = zone_of(screw)
    found = MODEL.parted(screw, OIL, axial_load=0.0, screw_speed=OMEGA)
    loads, torques = ball_torques(MODEL, screw, OIL, zone, OMEGA)
    both = float(found.loads.forward_load[0] + found.loads.backward_load[0])
    assert 20 * np.interp(both, loads, torques) == pytest.approx(float(found.screw_torque), rel=2e-3)


def row_of_balls(zone, pitch, balls=30):
    """Balls at equal distances that go by at the speed of a perfect nut, as a run that is looked at closely."""
    circuit = Circuit(zone, balls, balls * pitch, 0.0)
    run = chain_run(circuit, OMEGA, 0.5, 1.5)
    angle = 0.0123 * np.arange(12_000)
    places = (np.arange(balls) * pitch + float(zone.natural_speed) * angle[:, None]) % circuit.length
    loads = np.stack([zone.at(row, 0.0).load for row in places])
    return dataclasses.replace(run, angle=angle, places=places, loads=loads, forces=np.zeros_like(loads))


@pytest.mark.slow
def test_balls_at_equal_distances_make_the_harmonics_of_their_number():
    """Perfect grooves and sharp ends: each loaded ball has one torque, and their number goes up and down."""
    zone = zone_of(relief=1e-9)
    pitch = 1.04 * zone.ball_diameter
    run = row_of_balls(zone, pitch)
    torque = torques_of(MODEL, SCREW, OIL, run, OMEGA)
    assert not np.any(torque["rubbing"])
    assert not np.any(torque["return"])
    order = ball_pass_order(zone.natural_speed, pitch)
    found = amplitudes_at(run.angle, torque["balls"], [order, 2 * order]) / np.mean(torque["balls"])
    expected = [abs(ball_pass_harmonic(m, zone.length / pitch)) for m in (1, 2)]
    np.testing.assert_allclose(found, expected, rtol=0.01)


@pytest.mark.slow
def test_a_spall_takes_its_part_of_the_torque_once_a_ball_pass():
    """Each ball loses what its approach loses, over the width: a row of pulses."""
    zone, spall = zone_of(relief=1.0), Spall(2e-3, 1e-6)
    pitch = 1.04 * zone.ball_diameter
    usual, spalled = (row_of_balls(each, pitch) for each in (zone, with_defect(zone, spall)))
    drop = torques_of(MODEL, SCREW, OIL, usual, OMEGA)["balls"] - torques_of(MODEL, SCREW, OIL, spalled, OMEGA)["balls"]
    loads, torques = ball_torques(MODEL, SCREW, OIL, zone, OMEGA)
    left = zone.nominal_load * (1 - spall.depth / zone.nominal_approach) ** 1.5
    lost = float(np.interp(zone.nominal_load, loads, torques) - np.interp(left, loads, torques))
    assert np.mean(drop) == pytest.approx(lost * spall.width / pitch, rel=0.01)
    order = ball_pass_order(zone.natural_speed, pitch)
    pulses = [2 / (math.pi * m) * math.sin(math.pi * m * spall.width / pitch) * lost for m in (1, 2)]
    np.testing.assert_allclose(amplitudes_at(usual.angle, drop, [order, 2 * order]), pulses, rtol=0.01)


def test_rubbing_and_return_are_works_of_forces():
    """Neighbours that both roll rub at twice the speed of their surfaces; the return is pushed as fast as balls go."""
    zone = zone_of(groove_deviation=1e-6)
    run = chain_run(Circuit(zone, 30, 30.003 * zone.ball_diameter, 0.02), OMEGA, 0.1, 2.5)
    torque = torques_of(MODEL, SCREW, OIL, run, OMEGA)
    frame = MODEL.laws.frame(SCREW)
    surface = float(frame.entrainment_speed(1.0))  # m a radian
    between = np.where((run.loads > 0) & (np.roll(run.loads, -1, axis=1) > 0), run.forces, 0.0)
    least = MODEL.ball_friction_coefficient * 2 * surface * between.sum(axis=1)
    most = MODEL.ball_friction_coefficient * 2 * surface * run.forces.sum(axis=1)
    assert np.all(torque["rubbing"] >= 0.99 * least)
    assert np.all(torque["rubbing"] <= 1.01 * most)
    assert np.mean(torque["rubbing"]) > 0
    assert np.mean(torque["return"]) == pytest.approx(run.exit_push * float(zone.natural_speed), rel=0.05)


# -- a run ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_parts_sum_and_a_perfect_nut_has_the_drag_of_the_model():
    found = ripple(groove_deviation=0.0, relief=0.1)
    assert sum(found.parts.values()) == pytest.approx(found.mean, rel=1e-12)
    parted = MODEL.parted(SCREW, OIL, axial_load=0.0, screw_speed=OMEGA)
    # 30.7 balls' lengths, 20 of them loaded, of which the room and the two reliefs take 0.8
    assert found.parts["balls"] == pytest.approx(float(parted.screw_torque) * 19.2 / 20, rel=0.01)
    assert amplitude_of(found, "screw") < 0.01 * amplitude_of(ripple(), "screw")


@pytest.mark.slow
def test_the_greatest_order_of_a_perfect_nut_is_the_ball_pass():
    found = ripple(groove_deviation=0.0, relief=0.1, turns=20.0)
    orders, amplitudes = found.spectrum
    high = orders > 3
    peak = orders[high][np.argmax(amplitudes[high])]
    ball_pass = next(one.order for one in found.orders if one.name == "ball pass")
    assert peak == pytest.approx(ball_pass, abs=2 * float(orders[1]))


def test_names_of_a_circuit_are_those_of_its_kinematics():
    zone = zone_of()
    orders = kinematic_orders(zone, 30, 30.7 * zone.ball_diameter)
    L, advance = float(zone.path_radius), float(zone.natural_speed)
    assert orders["cage"] == pytest.approx(advance / L, rel=1e-12)  # turns of a ball about the axis
    assert orders["cage"] + orders["screw over balls"] == pytest.approx(1.0, rel=1e-12)
    pitch = zone.length / (30 - (30.7 * zone.ball_diameter - zone.length) / zone.ball_diameter)
    assert orders["ball pass"] == pytest.approx(2 * math.pi * advance / pitch, rel=1e-12)
    assert orders["circulation"] == pytest.approx(orders["ball pass"] / 30, rel=1e-12)
    assert (orders["screw"], orders["ball pass 2"]) == (1.0, 2 * orders["ball pass"])


@pytest.mark.slow
def test_half_the_step_and_twice_the_length_are_the_same_ripple():
    usual = ripple()
    for changed in (ripple(step=0.05), ripple(turns=24.0)):
        assert changed.mean == pytest.approx(usual.mean, rel=0.005)
        assert changed.deviation == pytest.approx(usual.deviation, rel=0.05)
        assert changed.peak_to_peak == pytest.approx(usual.peak_to_peak, rel=0.05)
        assert amplitude_of(changed, "screw") == pytest.approx(amplitude_of(usual, "screw"), rel=0.05)


@pytest.mark.slow
def test_a_mirror_changes_nothing():
    """Load and speed reversed in grooves that are seen in a mirror, a spall with them: the same torque."""
    part = dataclasses.replace(SCREW, nut=dataclasses.replace(SINGLE_NUT, angle_under_load=True))
    here, there = (
        zone_of(part, axial_load=sign * 800.0, screw_speed=sign * OMEGA, groove_deviation=1e-6, seed=3)
        for sign in (1, -1)
    )
    angle = here.length / here.path_radius
    there = dataclasses.replace(
        there, nut_groove=mirrored(here.nut_groove, angle), screw_groove=mirrored(here.screw_groove, angle)
    )
    spall = Spall(2e-3, 2e-6)
    torques = []
    for zone, speed in ((with_defect(here, spall), OMEGA), (with_defect(there, spall), -OMEGA)):
        run = chain_run(Circuit(zone, 30, 30.3 * zone.ball_diameter, 5e-3), OMEGA, 0.1, 2.0)
        torques.append(sum(torques_of(MODEL, part, OIL, run, speed).values()))
    np.testing.assert_allclose(*torques, rtol=1e-7)
    assert np.ptp(torques[0]) > 0.01 * np.mean(torques[0])


@pytest.mark.slow
def test_a_seed_is_a_nut():
    assert np.array_equal(ripple().torque, ripple().torque)
    assert not np.allclose(ripple().torque, ripple(seed=2).torque)


# -- defects --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_no_defect_is_a_defect_of_no_size():
    usual = ripple()
    for nothing in (Spall(2e-3, 0.0), PreloadLeft(1.0), NutGroove(1.0)):
        np.testing.assert_allclose(ripple(defect=nothing).torque, usual.torque, rtol=1e-9)


@pytest.mark.slow
def test_a_missing_ball_takes_its_friction_along():
    """Of the balls of one half, on the mean one in thirty is not there."""
    usual, missing = ripple(groove_deviation=0.0), ripple(groove_deviation=0.0, defect=MissingBall())
    lost = (usual.parts["balls"] - missing.parts["balls"]) / usual.parts["balls"]
    assert lost == pytest.approx(1 / 20 / 2, rel=0.25)  # the room is between the loaded balls


@pytest.mark.slow
def test_a_full_circuit_and_a_lost_preload_make_ripple_and_a_spall_does_not():
    usual = ripple()
    relative = usual.peak_to_peak / usual.mean
    full, spall = ripple(defect=FullCircuit()), ripple(defect=Spall(2e-3, 2e-6))
    assert full.peak_to_peak / full.mean > 2 * relative
    assert full.share > 10 * usual.share
    assert spall.peak_to_peak / spall.mean == pytest.approx(relative, rel=0.1)
    left = ripple(defect=PreloadLeft(0.35))
    assert left.mean < 0.6 * usual.mean
    assert left.peak_to_peak / left.mean > 1.3 * relative
    assert ripple(defect=NutGroove(3.0)).share > usual.share


@pytest.mark.slow
def test_braced_halves_move_and_others_keep_their_load():
    assert 1e-9 < ripple().displacement < 2e-6
    single = dataclasses.replace(SCREW, nut=bs.SingleNut(angle_under_load=True))
    assert math.isnan(ripple(single, axial_load=800.0).displacement)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"defect": PreloadLeft(1.5)}, "defect: must be a share of the preload"),
        ({"defect": Spall(0.0, 1e-6)}, "defect: must have a width and a depth"),
        ({"defect": NutGroove(-1.0)}, "defect: must not be negative"),
        ({"turns": 0.0}, "turns: must be positive"),
        ({"seed": -1}, "seed: must be a whole number"),
        ({"circuits": 8}, r"circuits: leaves too few balls to each \(8\)"),
        ({"relief": 11.0}, r"relief: leaves no ball its whole load \(11\)"),
    ],
)
def test_what_cannot_be_is_refused(changes, message):
    with pytest.raises(InputError, match=f"ripple.{message}"):
        ripple(**changes)


def test_a_nut_without_preload_loses_none():
    single = dataclasses.replace(SCREW, nut=bs.SingleNut(angle_under_load=True))
    with pytest.raises(InputError, match=r"ripple.defect: is for a nut whose preload is given"):
        ripple(single, axial_load=800.0, defect=PreloadLeft(0.5))
