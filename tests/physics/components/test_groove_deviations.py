"""Grooves that deviate once a turn: analytic loads of rigid halves, and what a given preload leaves of it."""

import dataclasses
import math

import numpy as np
import pint
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.physics.friction.loaded_balls import ball_angles, loads_of

U = pint.UnitRegistry()
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
PRELOAD = 0.05 * ROW.dynamic_load_rating
OIL = bs.Lubricant.from_grade("ISO VG 100")


def screw_with(deviations, make=bs.DoubleNut, **fields):
    return dataclasses.replace(ROW.screw(), nut=make(PRELOAD, deviations=deviations, **fields))


def test_the_place_of_a_groove_goes_round_once_a_turn():
    angles = 2 * math.pi * np.array([0.0, 0.25, 0.5, 1.0, 3.5])
    found = bs.Deviations.once_a_turn(angles, 2e-6)
    np.testing.assert_allclose(found.lead, 2e-6 * np.array([1, 0, -1, 1, -1]), atol=1e-20)
    assert found.ball_diameter == 0.0
    shifted = bs.Deviations.once_a_turn(angles, 2e-6, math.pi / 2)
    np.testing.assert_allclose(shifted.lead, 2e-6 * np.array([0, -1, 0, 0, 0]), atol=1e-20)
    with pytest.raises(InputError, match="groove"):
        bs.Deviations.once_a_turn(angles, U.Quantity(1.0, "N"))


def test_angles_fill_the_loaded_turns():
    screw = ROW.screw()
    angles = ball_angles(screw)
    assert len(angles) == screw.loaded_balls
    along = math.hypot(screw.pitch_circle_diameter / 2, screw.lead / (2 * math.pi))  # helix for each radian
    assert (angles[-1] + angles[1]) * along == pytest.approx(screw.loaded_balls * screw.ball_diameter, rel=1e-12)
    # balls that carry have a spacer between them
    parted = ball_angles(dataclasses.replace(screw, nut=bs.SingleNut(spacer_balls=True)))
    np.testing.assert_allclose(parted, 2 * angles[1] * np.arange(len(parted)), rtol=1e-13)
    # two starts: neighbours in the axis are on opposite sides
    two = ball_angles(dataclasses.replace(screw, lead=0.020, starts=2))
    np.testing.assert_allclose(two[1::2] - two[:-1:2], math.pi, rtol=1e-12)


def test_halves_follow_each_other_along_one_helix():
    screw = screw_with(None, spacing=ROW.lead / 4)
    balls = int(screw.loaded_balls)
    angles = ball_angles(screw)
    assert angles[balls] - angles[balls - 1] == pytest.approx(math.pi / 2, rel=1e-12)
    np.testing.assert_allclose(np.diff(angles)[balls:], angles[1], rtol=1e-9)


@pytest.mark.parametrize("groove", [0.5e-6, 1.5e-6])
def test_loads_between_rigid_bodies_follow_the_groove(groove):
    """Q_i = K (δ - e_i sin α cos φ)^1.5 to the first order in the change of the angle."""
    plain, wavy = (loads_of(screw_with(bs.Scatter(groove=one)), 0.0) for one in (0.0, groove))
    screw, balls = ROW.screw(), int(ROW.screw().loaded_balls)
    phase = np.random.default_rng((1, 1)).uniform(0, 2 * math.pi)
    share = groove * np.cos(ball_angles(screw) + phase)
    K = float(plain.forward_load[0]) / (delta := approach(plain)) ** 1.5
    mean = plain.forward_load[0]
    expected = K * (delta - share * math.sin(plain.forward_angle[0]) * math.cos(screw.lead_angle)) ** 1.5
    expected *= mean / expected.mean()  # the preload is given
    np.testing.assert_allclose(wavy.forward_load[:balls], expected, rtol=0.015)
    assert wavy.forward_load.max() > 1.1 * mean


def approach(loads):
    """The approach of a ball under its load, m."""
    from ballscrew.physics.solvers.load_distribution import pair_load_deflection

    return float((loads.forward_load[0] / pair_load_deflection(ROW.screw())) ** (2 / 3))


@pytest.mark.parametrize("bodies", [None, bs.Bodies()], ids=["rigid", "elastic"])
def test_a_given_preload_leaves_the_drag_as_it_was(bodies):
    """What some balls carry more others carry less: friction is nearly proportional to load."""
    model = bs.FrictionModel.reference()
    torque = {
        groove: float(
            model(
                screw_with(bs.Scatter(groove=groove), bodies=bodies), OIL, axial_load=0.0, screw_speed=10.47
            ).screw_torque
        )
        for groove in (0.0, 1.5e-6)
    }
    assert torque[1.5e-6] / torque[0.0] == pytest.approx(1.001, abs=5e-4)


def test_a_seed_keeps_its_balls():
    plain, wavy = bs.Scatter(1e-6, 2e-6, 3), bs.Scatter(1e-6, 2e-6, 3, groove=1e-6)
    angles = np.linspace(0.0, 20.0, 30)
    one, other = plain.of(30, angles), wavy.of(30, angles)
    np.testing.assert_array_equal(one.ball_diameter, other.ball_diameter)
    assert np.ptp(other.lead - one.lead) == pytest.approx(2e-6, rel=0.01)
    np.testing.assert_array_equal(other.lead, wavy.of(30, angles).lead)
    assert not np.allclose(other.lead - one.lead, bs.Scatter(1e-6, 2e-6, 4, groove=1e-6).of(30, angles).lead)


def test_several_screws_at_once_are_refused():
    screw = screw_with(bs.Scatter(groove=1e-6))
    several = dataclasses.replace(screw, ball_diameter=np.array([5.9e-3, 6e-3]))
    with pytest.raises(InputError, match=r"deviations.groove: must be of one screw"):
        loads_of(several, 0.0)


def test_grooves_of_a_case_file():
    tables = {
        "screw": {"catalogue": ROW.name},
        "nut": {"type": "double", "preload": "5 %"},
        "deviations": {"groove": "1.5 um", "seed": 3},
        "lubricant": {"grade": "ISO VG 100"},
        "operation": {"axial_load": "0 N", "screw_speed": "100 rpm"},
    }
    case = case_file.build(tables)
    assert case.nut.deviations == bs.Scatter(seed=3, groove=1.5e-6)
    assert inputs(case)["deviations"]["groove"] == 1.5e-6
    with pytest.raises(InputError, match=r"deviations.groove: must not be negative"):
        case_file.build({**tables, "deviations": {"groove": "-1 um"}})
