"""Truth: closed forms of Dahl, LuGre and Maxwell-slip elements, from which curves are made; and the rules of Masing."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate

from ballscrew.basis.errors import InputError
from ballscrew.physics.equations import presliding
from ballscrew.physics.moving_balls.friction_states import (
    Dahl,
    FitError,
    SlipElement,
    WindingUp,
    error_of,
    fit_dahl,
    fit_dahl_first,
    fit_lugre,
    fit_slip_elements,
    gms_torque,
    work_share,
)
from ballscrew.physics.moving_balls.reversal import STROKES, Loop
from support.reversals import STEADY, closed_form

#: Metres of travel for each radian, of a lead of 10 mm.
PER_RADIAN = 0.01 / (2 * math.pi)
#: Three elements: the contacts, which slide within hundredths of a degree, and the balls across their grooves.
THREE = (
    SlipElement(stiffness=0.03 / math.radians(0.015), slip_torque=0.03),
    SlipElement(stiffness=0.02 / math.radians(1.0), slip_torque=0.02),
    SlipElement(stiffness=0.05 / math.radians(3.0), slip_torque=0.05),
)


def curve_of(torque_at, coulomb_torque, *, from_rest=False, at_once=0.0):
    """A curve over 60° of a closed form of the angle."""
    angles = np.concatenate([[0.0], np.geomspace(math.radians(1e-4), math.radians(60), 400)])
    return WindingUp(
        screw_angle=angles,
        travel=angles * PER_RADIAN,
        torque=torque_at(angles),
        coulomb_torque=coulomb_torque,
        at_once=at_once,
        from_rest=from_rest,
    )


def of_elements(elements, *, from_rest=False, at_once=0.0):
    """The curve of elements, by the definition of each one."""
    start = 0.0 if from_rest else -1.0

    def torque_at(angles):
        return sum(np.minimum(start * one.slip_torque + one.stiffness * angles, one.slip_torque) for one in elements)

    return curve_of(torque_at, sum(one.slip_torque for one in elements), from_rest=from_rest, at_once=at_once)


# -- models ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("initial_torque", [-0.2, 0.0, 0.05])
def test_dahl_solves_its_equation(initial_torque):
    """dM/dθ = σ₀ (1 − M/M_c), by central differences."""
    sigma_0, M_c = 4.0, 0.2
    angles = np.linspace(0.0, 0.3, 31)
    step = 1e-6
    here, less, more = (
        presliding.dahl_torque(sigma_0, M_c, initial_torque, angles + shift) for shift in (0.0, -step, step)
    )
    assert (more - less) / (2 * step) == pytest.approx(sigma_0 * (1 - here / M_c), rel=1e-8, abs=1e-9)
    assert here[0] == pytest.approx(initial_torque, abs=1e-16)


def test_lugre_at_a_steady_speed():
    """The state of the bristles, integrated over the time, has the torque of Dahl, with damping on top."""
    sigma_0, M_c, sigma_1, sigma_2, omega, time = 5.0, 0.3, 0.02, 0.004, 0.5, 0.2
    done = integrate.solve_ivp(
        lambda _, z: omega * (1 - sigma_0 * z / M_c), (0.0, time), [-M_c / sigma_0], rtol=1e-12, atol=1e-15
    )
    z = done.y[0, -1]
    rate = omega * (1 - sigma_0 * z / M_c)
    wound = presliding.dahl_torque(sigma_0, M_c, -M_c, omega * time)
    assert sigma_0 * z == pytest.approx(wound, rel=1e-9)
    found = presliding.lugre_torque(wound, M_c, sigma_1, sigma_2, omega)
    assert found == pytest.approx(sigma_0 * z + sigma_1 * rate + sigma_2 * omega, rel=1e-9)


# -- fits -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("from_rest", [False, True])
@pytest.mark.parametrize("stiffness", [0.05, 3.0, 400.0])
def test_dahl_finds_its_own_stiffness(stiffness, from_rest):
    start = 0.0 if from_rest else -0.2
    curve = curve_of(lambda at: presliding.dahl_torque(stiffness, 0.2, start, at), 0.2, from_rest=from_rest)
    found = fit_dahl(curve)
    assert found.model.presliding_stiffness == pytest.approx(stiffness, rel=1e-6)
    assert found.error.largest < 1e-6
    first = fit_dahl_first(curve)
    assert first.model.presliding_stiffness == pytest.approx(stiffness, rel=1e-6)


@pytest.mark.parametrize("from_rest", [False, True])
def test_elements_are_found_again(from_rest):
    found = fit_slip_elements(of_elements(THREE, from_rest=from_rest), 3)
    assert [one.slip_torque for one in found.elements] == pytest.approx([0.03, 0.02, 0.05], rel=1e-6)
    assert [one.stiffness for one in found.elements] == pytest.approx([one.stiffness for one in THREE], rel=1e-6)
    assert found.error.largest < 1e-6


@pytest.mark.parametrize("from_rest", [False, True])
def test_elements_are_found_again_from_curve_and_loops(from_rest):
    curve = of_elements(THREE, from_rest=from_rest, at_once=0.05)
    loops = [Loop(stroke, work_share(THREE, stroke, at_once=0.05)) for stroke in STROKES]
    found = fit_slip_elements(dataclasses.replace(curve, loops=loops), 3)
    assert [one.slip_torque for one in found.elements] == pytest.approx([0.03, 0.02, 0.05], rel=1e-5)
    assert [loop.work_ratio for loop in found.loops] == pytest.approx([1.0] * len(loops), rel=1e-6)
    assert found.work_error < 1e-6
    assert math.isnan(fit_slip_elements(curve, 3).work_error)


def test_loops_without_the_memory_of_elements_count():
    """Friction that loses on short strokes twice what elements of the curve do: the fit to both has less error there,
    says how much, and is farther from the curve.
    """
    curve = of_elements(THREE, at_once=0.02)
    loops = [Loop(stroke, 2 * work_share(THREE, stroke, at_once=0.02)) for stroke in STROKES[:3]]
    alone, both = fit_slip_elements(curve, 3), fit_slip_elements(dataclasses.replace(curve, loops=loops), 3)
    assert both.work_error == max(abs(loop.work_ratio - 1) for loop in both.loops)
    assert 0.02 < both.work_error < 0.4  # half is missing without
    assert alone.error.largest < 1e-6 < both.error.largest
    for loop in both.loops:
        way = np.linspace(-loop.stroke / 2, loop.stroke / 2, 4001)
        path = np.concatenate([way, way[-2::-1], way[1:], way[-2::-1]])
        torque = gms_torque(both.elements, path)
        lost = np.trapezoid(torque[-8001:], path[-8001:]) / (2 * loop.stroke) + curve.at_once
        assert lost == pytest.approx(loop.work_ratio * loop.work_share * curve.steady_torque, rel=1e-3)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_torques_of_elements_sum_to_the_steady_torque(count):
    """Also where they cannot hold the curve, and no more elements are made than there are."""
    curve = of_elements(THREE)
    found = fit_slip_elements(curve, count)
    assert len(found.elements) == min(count, 3)
    assert sum(one.slip_torque for one in found.elements) == pytest.approx(0.1, rel=1e-5)
    assert all(one.slip_torque > 0 and one.stiffness > 0 for one in found.elements)


def test_more_elements_are_no_worse():
    """By the squares that they are fitted with: of a curve that none holds, from a smooth law."""
    curve = curve_of(lambda at: 0.1 * (1 - 2 / (1 + at / 0.02)), 0.1 * (1 - 2 / (1 + math.radians(60) / 0.02)))
    errors = [fit_slip_elements(curve, count).error.largest for count in (1, 2, 3, 4)]
    assert errors == sorted(errors, reverse=True)
    assert errors[3] < 0.2 * errors[0]


def test_one_stiffness_cannot_hold_both_ranges():
    """The stiffness of the contacts is a hundred times that for tracking, and each is far off where it was not fitted;
    two elements hold both.
    """
    two = THREE[0], THREE[2]
    curve = of_elements(two)
    first, tracking = fit_dahl_first(curve), fit_dahl(curve)
    assert first.model.presliding_stiffness > 20 * tracking.model.presliding_stiffness
    # after the contacts have slid, Dahl with their stiffness is at the steady torque: half of the swing is missing
    assert first.error.largest > 0.9
    # when the contacts have slid, Dahl for tracking has hardly begun
    slid = 2 * two[0].slip_angle
    before = tracking.model.torque(slid, curve.initial_torque) - np.interp(slid, curve.screw_angle, curve.torque)
    assert before < -0.6 * curve.coulomb_torque
    assert tracking.error.largest >= 0.6
    assert first.error.rms > 3 * tracking.error.rms
    assert fit_slip_elements(curve, 2).error.largest < 1e-6


def test_tracking_is_free_of_the_way_that_it_is_sampled():
    """The squares are over the travel: ten times as many angles at the start change nothing."""
    curve = of_elements(THREE)
    dense = np.unique(np.concatenate([curve.screw_angle, np.linspace(0, math.radians(0.05), 4000)]))
    again = WindingUp(
        screw_angle=dense,
        travel=dense * PER_RADIAN,
        torque=np.interp(dense, curve.screw_angle, curve.torque),
        coulomb_torque=curve.coulomb_torque,
    )
    one, other = (fit_dahl(each).model.presliding_stiffness for each in (curve, again))
    assert other == pytest.approx(one, rel=1e-4)


def test_lugre_has_the_stiffness_of_dahl():
    curve = of_elements(THREE, at_once=0.04)
    found = fit_lugre(curve, screw_speed=-8.0, viscous_slope=0.002, moment_of_inertia=2e-3)
    model = found.model
    assert model.presliding_stiffness == fit_dahl(curve).model.presliding_stiffness
    # of the 0.04 N m that follow at once, 0.016 are viscous at this speed
    assert model.dry_torque == pytest.approx(0.024, rel=1e-12)
    # an inertia on a spring: the logarithmic decrement of a damping ratio of a half
    assert model.micro_damping == pytest.approx(math.sqrt(model.presliding_stiffness * 2e-3), rel=1e-12)
    assert fit_lugre(curve, screw_speed=8.0).model.micro_damping == 0
    assert model.torque(math.radians(1e4), curve.initial_torque, 8.0) == pytest.approx(curve.steady_torque, rel=1e-12)


@pytest.mark.parametrize("from_rest", [False, True])
def test_a_reversal_in_its_parts(from_rest):
    """What follows at once is beside what winds up: rolling, losses, and half of what parts at once and presses later.

    From rest balls press later on all of it.
    """
    curve = WindingUp.of(closed_form(from_rest=from_rest))
    at_once = STEADY["rolling"] + STEADY["losses"] + (0.0 if from_rest else STEADY["ball_to_ball"] / 2)
    assert curve.at_once == pytest.approx(at_once, rel=1e-5)
    assert curve.steady_torque == pytest.approx(sum(STEADY.values()), rel=1e-14)
    assert curve.torque[0] == pytest.approx(curve.initial_torque, abs=1e-14)
    assert curve.share_of_swing[[0, -1]] == pytest.approx([0.0, 1.0], abs=1e-14)
    # no step is left: the first 1e-4 degrees wind up the contacts, which slide at 0.02 degrees from rest
    swing = curve.coulomb_torque - curve.initial_torque
    assert np.diff(curve.share_of_swing)[0] == pytest.approx(0.06 * 1e-4 / 0.02 / swing, rel=2e-2)


def test_elements_of_mechanisms():
    """Three mechanisms wind up on straight lines, an element each; of the balls that close up it has the half."""
    found = fit_slip_elements(WindingUp.of(closed_form()), 4)
    assert [one.slip_torque for one in found.elements] == pytest.approx([0.06, 0.1, 0.01], rel=1e-4)
    angles = [math.degrees(2 * one.slip_angle) for one in found.elements]
    assert angles == pytest.approx([0.04, 10.0, 30.0], rel=1e-4)


def test_errors_are_shares_of_all_friction():
    """A stiffness of next to nothing never leaves the start: twice the Coulomb torque is missing in the end."""
    curve = of_elements(THREE, at_once=0.1)
    slow = Dahl(presliding_stiffness=1e-9, coulomb_torque=curve.coulomb_torque)
    assert error_of(curve, slow.torque(curve.screw_angle, curve.initial_torque)).largest == pytest.approx(1, rel=1e-6)
    assert error_of(curve, curve.torque) == FitError(largest=0.0, rms=0.0)
    assert error_of(curve, np.asarray(curve.torque) + 0.02).rms == pytest.approx(0.1, rel=1e-12)


# -- along any path -------------------------------------------------------------------------------


def every_kink(elements, path):
    """A path with all angles at which an element begins to slide, so that straight lines between them are exact."""
    places = [path[0]]
    held = np.zeros(len(elements))
    for low, high in itertools.pairwise(path):
        direction = math.copysign(1.0, high - low)
        ways = [(one.slip_torque - direction * at) / one.stiffness for one, at in zip(elements, held, strict=True)]
        places += [low + direction * way for way in sorted(ways) if 0 < way < abs(high - low)]
        places.append(high)
        held = np.array(
            [
                max(-one.slip_torque, min(one.slip_torque, at + one.stiffness * (high - low)))
                for one, at in zip(elements, held, strict=True)
            ]
        )
    return np.array(places)


def area(angles, torques):
    """Work done on straight lines."""
    return float(np.sum((torques[1:] + torques[:-1]) / 2 * np.diff(angles)))


element = st.builds(SlipElement, stiffness=st.floats(0.1, 100.0), slip_torque=st.floats(1e-3, 1.0))
elements_of = st.lists(element, min_size=1, max_size=4)
turns = st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=12)


@given(elements_of, st.floats(-1.0, 1.0), st.floats(0.01, 2.0))
def test_loops_close_with_the_work_of_their_elements(elements, low, width):
    """After one turn a loop repeats, and its area is 4 M (A − M/k) for each element that slides (A half the width)."""
    path = [0.0, low, low + width, low, low + width]
    angles = every_kink(elements, path)
    torques = gms_torque(elements, angles)
    second = gms_torque(elements, [*path, low, low + width])
    assert second[2:5:2] == pytest.approx(second[4::2], abs=1e-12)
    assert second[3] == pytest.approx(second[5], abs=1e-12)
    begin, end = (np.flatnonzero(angles == low + width)[i] for i in (0, -1))
    slid = sum(4 * one.slip_torque * max(width / 2 - one.slip_angle, 0.0) for one in elements)
    stiffest = sum(one.stiffness for one in elements) * width**2
    assert area(angles[begin : end + 1], torques[begin : end + 1]) == pytest.approx(
        slid, rel=1e-9, abs=1e-12 * stiffest
    )


@given(elements_of, turns)
def test_steps_of_any_size(elements, path):
    """The torque at the turning points does not depend on how many angles lie between them."""
    coarse = np.array([0.0, *path])
    fine = np.unique(np.linspace(0, len(coarse) - 1, 20 * (len(coarse) - 1) + 1))
    angles = np.interp(fine, np.arange(len(coarse)), coarse)
    assert gms_torque(elements, angles)[::20] == pytest.approx(gms_torque(elements, coarse), abs=1e-12)


@given(elements_of, turns, st.floats(0.0, 1.0))
def test_a_small_loop_is_wiped_out(elements, path, share):
    """Non-local memory: a loop within a way leaves no trace once its turning point is passed again."""
    last, end = ([0.0, *path])[-1], 1.5
    middle = last + (end - last) * share
    without = gms_torque(elements, [0.0, *path, middle, end])
    # back a part of the way, and on
    back = last + (middle - last) * 0.7
    with_loop = gms_torque(elements, [0.0, *path, middle, back, middle, end])
    assert with_loop[-2:] == pytest.approx(without[-2:], abs=1e-12)


@given(elements_of, st.floats(0.001, 0.5), st.floats(0.01, 0.99))
def test_the_rule_of_masing(elements, amplitude, share):
    """A branch after a turning point is the curve from rest, twice as large both ways."""
    virgin = gms_torque(elements, [0.0, amplitude * share, amplitude])
    turned = gms_torque(elements, [0.0, amplitude, amplitude - 2 * amplitude * share])
    assert turned[-1] == pytest.approx(virgin[-1] - 2 * virgin[1], abs=1e-12)


def test_memory_is_of_more_than_the_last_turn():
    """The same last turn and the same place, and another torque: one of them came from farther away."""
    near, far = (gms_torque(THREE, [0.0, first, 0.0, 0.02]) for first in (0.03, 0.2))
    assert abs(near[-1] - far[-1]) > 0.01


def test_from_a_state():
    """A path goes on from where it was left."""
    whole = gms_torque(THREE, [0.0, 0.1, 0.06])
    slid = [one.slip_torque for one in THREE]
    assert gms_torque(THREE, [0.1, 0.06], initial_torques=slid) == pytest.approx([0.1, whole[-1]], abs=1e-15)


# -- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"coulomb_torque": 0.0}, "winding_up.coulomb_torque"),
        ({"screw_angle": np.array([0.0, 2e-3, 1e-3, 3e-3])}, "winding_up.screw_angle"),
        ({"screw_angle": np.array([0.0, 1e-3, 2e-3, math.nan])}, "winding_up.screw_angle"),
        ({"torque": np.zeros(3)}, "winding_up.screw_angle"),
    ],
)
def test_what_is_no_curve(changes, where):
    angles = np.array([0.0, 1e-3, 2e-3, 3e-3])
    whole = {"screw_angle": angles, "travel": angles, "torque": np.array([-1.0, 0.0, 0.5, 1.0]), "coulomb_torque": 1.0}
    WindingUp(**whole)
    with pytest.raises(InputError) as error:
        WindingUp(**(whole | changes))
    assert [fault.where for fault in error.value.faults] == [where]


def test_what_a_fit_refuses():
    curve = of_elements(THREE)
    for call, where in (
        (lambda: fit_slip_elements(curve, 5), "fit_slip_elements.count"),
        (lambda: fit_slip_elements(curve, 0), "fit_slip_elements.count"),
        (lambda: gms_torque(THREE, [0.0, 1.0], initial_torques=[0.0]), "gms_torque.initial_torques"),
        (lambda: gms_torque(THREE, [0.0, 1.0], initial_torques=[0.0, 0.0, 0.06]), "gms_torque.initial_torques"),
    ):
        with pytest.raises(InputError) as error:
            call()
        assert error.value.faults[0].where == where


def test_no_first_range_where_nothing_was_sampled():
    angles = np.linspace(0, 0.2, 50)
    curve = WindingUp(
        screw_angle=angles,
        travel=angles,
        torque=presliding.dahl_torque(50.0, 0.1, -0.1, angles),
        coulomb_torque=0.1,
    )
    assert fit_dahl_first(curve) is None
    assert fit_dahl(curve).model.presliding_stiffness == pytest.approx(50.0, rel=1e-6)
