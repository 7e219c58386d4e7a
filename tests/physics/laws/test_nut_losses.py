"""The laws of what a nut loses without load: nothing by default, a torque with its parts when asked."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.laws.nut_losses import (
    DOUBLE_NUT_DRAG,
    OVERSIZE_BALL_DRAG,
    Churning,
    EfficiencyDrag,
    HarrisChurning,
    JISDrag,
    LipSeals,
    Recirculation,
    ReturnBraking,
    RexrothDrag,
    Seals,
    ShearedOil,
    SpinUp,
    seal_table,
)

SPEED = 20 * math.pi
PARASITIC = [Seals, LipSeals, Churning, HarrisChurning, Recirculation, ReturnBraking, ShearedOil, SpinUp]
#: One of each that loses something.
ACTIVE = [
    Seals(0.4),
    LipSeals(80.0),
    Churning(oil_share=0.5),
    HarrisChurning(oil_share=0.5),
    Recirculation(return_force=0.4, returns=3),
    ReturnBraking(return_balls=8, returns=3),
    ShearedOil(oil_share=0.5),
    SpinUp(entries=3),
]
ROW = {"preload_force": 3000.0, "nominal_diameter": 0.040, "pitch_circle_diameter": 0.04175, "lead": 0.010}


def torque_of(law, **changes):
    return law(*(ROW | changes).values())


# -- drag of the preload --------------------------------------------------------------------------


def test_drag_laws_take_the_size_they_are_made_for():
    assert torque_of(JISDrag()) * 1e3 == pytest.approx(865, abs=0.5)
    assert torque_of(JISDrag(), nominal_diameter=1.0) == torque_of(JISDrag())
    assert torque_of(RexrothDrag()) == pytest.approx(DOUBLE_NUT_DRAG * 3000.0 * 0.040, rel=1e-14)
    assert torque_of(RexrothDrag(), lead=1.0, pitch_circle_diameter=1.0) == torque_of(RexrothDrag())
    assert torque_of(RexrothDrag(OVERSIZE_BALL_DRAG)) == pytest.approx(2.5 * torque_of(RexrothDrag()), rel=1e-14)


def test_drag_of_halves_is_twice_the_loss_of_one():
    ideal = 3000.0 * 0.010 / (2 * math.pi)
    assert torque_of(EfficiencyDrag(0.9)) == pytest.approx(2 * ideal * (1 / 0.9 - 1), rel=1e-13)
    assert torque_of(EfficiencyDrag(1.0)) == 0.0


@pytest.mark.parametrize("law", [JISDrag(), RexrothDrag(), EfficiencyDrag(0.93)])
def test_drag_laws_take_arrays_and_grow_with_the_preload(law):
    preloads = np.array([0.0, 1000.0, 2000.0])
    torque = torque_of(law, preload_force=preloads)
    np.testing.assert_allclose(torque, torque[1] * np.array([0.0, 1.0, 2.0]), rtol=1e-14)
    assert torque[1] > 0


# -- parasitic terms ------------------------------------------------------------------------------


@pytest.mark.parametrize("law", PARASITIC)
def test_nothing_by_default(law, seed_screw, seed_oil):
    assert law()(seed_screw, seed_oil, SPEED) == 0.0


@pytest.mark.parametrize("law", ACTIVE, ids=lambda law: type(law).__name__)
def test_parts_sum_with_those_of_arrays_of_speeds(law, seed_screw, seed_oil):
    speeds = np.array([0.0, SPEED, 2 * SPEED])
    torque = np.broadcast_to(law(seed_screw, seed_oil, speeds), speeds.shape)
    assert np.all(np.isfinite(torque))
    assert np.all(np.diff(torque) >= 0)
    assert torque[1] == pytest.approx(law(seed_screw, seed_oil, SPEED), rel=1e-14)
    assert torque[1] > 0


@pytest.mark.parametrize("law", [Churning(1.0), HarrisChurning(1.0)], ids=lambda law: type(law).__name__)
def test_balls_at_rest_churn_nothing(law, seed_screw, seed_oil):
    assert law(seed_screw, seed_oil, 0.0) == 0.0


def test_churning_counts_the_balls_it_is_given(seed_screw, seed_oil):
    one = Churning(1.0, balls=1)(seed_screw, seed_oil, SPEED)
    assert Churning(1.0)(seed_screw, seed_oil, SPEED) == pytest.approx(seed_screw.loaded_balls * one, rel=1e-14)
    assert Churning(0.5, balls=1)(seed_screw, seed_oil, SPEED) == pytest.approx(one / 2, rel=1e-14)


@pytest.mark.implausible
def test_churning_is_that_of_stokes_in_thick_oil(seed_screw, seed_oil):
    # the torque of one ball is then quadratic in its way per radian, linear in viscosity and speed
    thick = dataclasses.replace(seed_oil, viscosity=1e4)
    way = Recirculation(return_force=1.0)(seed_screw, thick, SPEED)
    stokes = 3 * math.pi * 1e4 * seed_screw.ball_diameter * SPEED * way**2
    assert Churning(1.0, balls=1)(seed_screw, thick, SPEED) == pytest.approx(stokes, rel=1e-2)


def test_thin_oil_brings_both_laws_of_churning_together(seed_screw, seed_oil):
    # a Reynolds number of 1000, where the one ends and the other begins
    thin = dataclasses.replace(seed_oil, viscosity=seed_oil.density * 0.6 * seed_screw.ball_diameter / 1000)
    sphere = Churning(1.0)(seed_screw, thin, SPEED)
    assert HarrisChurning(1.0)(seed_screw, thin, SPEED) == pytest.approx(sphere, rel=0.05)


@pytest.mark.implausible
def test_work_of_a_return_is_force_times_way(seed_screw, seed_oil):
    # far bigger than its balls, the screw turns once while they go half a circumference
    big = dataclasses.replace(seed_screw, pitch_circle_diameter=100.0)
    work = 2 * math.pi * Recirculation(return_force=0.4, returns=3)(big, seed_oil, SPEED)
    assert work == pytest.approx(3 * 0.4 * math.pi * 100.0 / 2, rel=1e-4)


def test_braking_of_the_return_is_its_force_along_the_path(seed_screw, seed_oil):
    law = ReturnBraking(return_balls=8, returns=3)
    force = law.force(seed_screw, seed_oil, SPEED)
    expected = Recirculation(return_force=force, returns=3)(seed_screw, seed_oil, SPEED)
    assert law(seed_screw, seed_oil, SPEED) == pytest.approx(expected, rel=1e-14)
    twice = dataclasses.replace(law, return_balls=16).force(seed_screw, seed_oil, SPEED)
    assert twice == pytest.approx(2 * force, rel=1e-14)


def test_braking_of_the_return_is_dry_at_rest_and_viscous_in_motion(seed_screw, seed_oil):
    law = ReturnBraking(return_balls=8, ball_density=7850.0, return_friction=0.1)
    mass = 7850.0 * math.pi / 6 * seed_screw.ball_diameter**3
    assert law.force(seed_screw, seed_oil, 0.0) == pytest.approx(0.1 * 8 * mass * 9.80665, rel=1e-12)
    smooth = dataclasses.replace(law, return_friction=0.0)
    stokes = Churning(1.0, balls=8)(seed_screw, dataclasses.replace(seed_oil, density=500.0), 1e-6)
    assert smooth(seed_screw, seed_oil, 1e-6) == pytest.approx(10 * stokes, rel=1e-3)


def test_sheared_oil_counts_the_gaps_it_is_given(seed_screw, seed_oil):
    one = ShearedOil(1.0, balls=1)(seed_screw, seed_oil, SPEED)
    assert ShearedOil(1.0)(seed_screw, seed_oil, SPEED) == pytest.approx(seed_screw.loaded_balls * one, rel=1e-14)
    assert ShearedOil(0.5, balls=1)(seed_screw, seed_oil, SPEED) == pytest.approx(one / 2, rel=1e-14)
    # in a rather small gap as two spheres of JeffreyOnishi1984 on both sides of it
    rotation = bs.FrictionModel.reference()(seed_screw, seed_oil, axial_load=1e3, screw_speed=SPEED).frame
    rotation = 2 * rotation.entrainment_speed(SPEED) / seed_screw.ball_diameter
    size = 8 * math.pi * seed_oil.viscosity * (seed_screw.ball_diameter / 2) ** 3 * rotation
    tiny = ShearedOil(1.0, 1e-6, balls=1)(seed_screw, seed_oil, SPEED)
    tinier = ShearedOil(1.0, 1e-7, balls=1)(seed_screw, seed_oil, SPEED)
    expected = 2 * size * (1 / 5 + 1 / 20) * math.log(10) * rotation / SPEED
    assert tinier - tiny == pytest.approx(expected, rel=1e-3)


def test_a_spacer_turns_where_its_neighbours_leave_it_without_moment(seed_screw, seed_oil):
    # moments by own rotation and by that of a neighbour, 1/5 and 1/20: a free spacer turns by a quarter, and back
    own, other = 1 / 5, 1 / 20
    spacer = -other / own
    ratio = (own + other * spacer) * 1 / (2 * (own + other))
    parted = dataclasses.replace(seed_screw, nut=bs.SingleNut(spacer_balls=True))
    law = ShearedOil(1.0)
    found = law(parted, seed_oil, SPEED) / law(seed_screw, seed_oil, SPEED)
    assert found == pytest.approx(ratio, rel=1e-14)


def test_balls_that_enter_cost_the_cube_of_the_speed(seed_screw, seed_oil):
    power = SPEED * SpinUp(entries=1)(seed_screw, seed_oil, SPEED)
    assert 2 * SPEED * SpinUp(entries=1)(seed_screw, seed_oil, 2 * SPEED) == pytest.approx(8 * power, rel=1e-14)
    # a ball that rolls has 0.7 m v^2, of which 0.2 is its rotation: spun up, it costs twice that, to the curvature
    advance = Recirculation(return_force=1.0)(seed_screw, seed_oil, SPEED)
    mass, speed = 7850.0 * math.pi / 6 * seed_screw.ball_diameter**3, advance * SPEED
    rate = speed / seed_screw.ball_diameter
    gamma = 1 - 2 * advance / math.hypot(seed_screw.pitch_circle_diameter / 2, seed_screw.lead / 2 / math.pi)
    assert power == pytest.approx(0.4 * mass * (speed * (1 + gamma)) ** 2 * rate, rel=0.01)
    stopped = SPEED * SpinUp(entries=1, lost_speed=1.0)(seed_screw, seed_oil, SPEED)
    assert stopped - power == pytest.approx(mass * speed**2 * rate, rel=1e-12)


# -- the table of seals ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("diameter", "lead", "torque"),
    [
        # Rexroth R310RU 3301 (2006.02), two standard seals, in mm and N m
        (16, 5, 0.08), (16, 10, 0.08), (20, 5, 0.10), (20, 20, 0.12), (25, 5, 0.12), (25, 10, 0.15), (25, 25, 0.20),
        (32, 10, 0.25), (40, 40, 0.40), (50, 5, 0.5), (50, 10, 0.6), (50, 16, 0.6), (50, 20, 0.6), (63, 20, 1.2),
        (80, 10, 1.4), (80, 20, 2.2), (100, 10, 2.2), (100, 20, 2.8), (125, 10, 3.6), (125, 20, 5.0),
    ],
)  # fmt: skip
def test_seals_of_the_table(diameter, lead, torque, seed_screw, seed_oil):
    assert Seals.of_table(diameter * 1e-3, lead * 1e-3)(seed_screw, seed_oil, SPEED) == torque


def test_the_table_is_whole():
    assert len(seal_table()) == 17


@pytest.mark.parametrize(
    ("diameter", "lead", "nearest"),
    [
        (0.019, 0.005, "20 mm, lead 5 mm"),
        (0.012, 0.005, "16 mm, any lead"),
        (0.025, 0.011, "25 mm, lead 10 mm"),
        (0.050, 0.025, "50 mm, lead 10 mm to 20 mm"),
        (0.040, -0.005, "40 mm, any lead"),
        (0.040, math.nan, "40 mm, any lead"),
    ],
)
def test_outside_the_table_the_nearest_row_is_named(diameter, lead, nearest):
    with pytest.raises(bs.InputError, match=f"nearest: {nearest}"):
        Seals.of_table(diameter, lead)


# -- bad input ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("law", "field", "bad"),
    [
        (JISDrag, "drag_coefficient", -0.05),
        (JISDrag, "drag_exponent", math.nan),
        (RexrothDrag, "drag_coefficient", -0.004),
        (EfficiencyDrag, "efficiency", 0.0),
        (EfficiencyDrag, "efficiency", 1.1),
        (Seals, "seal_torque", -0.1),
        (LipSeals, "lip_friction", -80.0),
        (LipSeals, "lips", 1.5),
        (Churning, "oil_share", 1.1),
        (Churning, "balls", -1),
        (HarrisChurning, "drag_coefficient", -0.4),
        (Recirculation, "return_force", math.inf),
        (Recirculation, "returns", 0.5),
        (ReturnBraking, "return_balls", 7.5),
        (ReturnBraking, "wall_factor", -1.0),
        (ShearedOil, "oil_gap", 0.0),
        (ShearedOil, "oil_share", 1.1),
        (SpinUp, "entries", -1),
        (SpinUp, "lost_speed", 1.1),
    ],
)
def test_bad_input_is_refused(law, field, bad):
    with pytest.raises(bs.InputError, match=field):
        law(**{field: bad})
