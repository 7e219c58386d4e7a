"""Moves against an independent planner, and against closed forms."""

import math

import numpy as np
import pytest
import ruckig

from ballscrew.axis.motion.profiles import SCurve, Segment, Segments, Sine, Trapezoid, move, timing
from ballscrew.axis.motion.states import states_of
from ballscrew.basis.errors import InputError


def planned(distance, speed, acceleration, jerk):
    """The move by the planner, time-optimal from rest to rest."""
    task = ruckig.InputParameter(1)
    task.current_position, task.target_position = [0.0], [distance]
    task.max_velocity, task.max_acceleration, task.max_jerk = [speed], [acceleration], [jerk]
    trajectory = ruckig.Trajectory(1)
    assert ruckig.Ruckig(1).calculate(task, trajectory) == ruckig.Result.Working
    return trajectory


def test_moves_with_limited_jerk_against_a_planner():
    """200 random moves, from those that reach no acceleration to those that cruise: time, and states on the way."""
    random = np.random.default_rng(19)
    for limits in 10 ** random.uniform([-3, -2, -1, 0], [1, 0.5, 1.5, 4], size=(200, 4)):
        distance, speed, acceleration, jerk = (float(number) for number in limits)
        expected, found = planned(distance, speed, acceleration, jerk), timing(distance, speed, acceleration, jerk)
        assert found.total == pytest.approx(expected.duration, rel=1e-9)
        states = states_of(move(0.0, distance, speed, acceleration, jerk))
        for time, x, v, a in zip(states.time, states.position, states.speed, states.acceleration, strict=True):
            there = expected.at_time(float(time))
            assert x == pytest.approx(there[0][0], abs=1e-9 * distance)
            assert v == pytest.approx(there[1][0], abs=1e-9 * speed)
            # where the jerk changes, the times differ by rounding
            assert a == pytest.approx(there[2][0], abs=1e-9 * acceleration + 1e-14 * jerk * found.total)


def test_a_rest_is_its_two_ends_and_its_middle():
    """Nothing changes in a rest: more states of it would be more rows of a table, and no more is known."""
    states = Trapezoid(stroke=0.4, speed=0.5, acceleration=5.0, dwell=0.3).states()
    way = 0.4 / 0.5 + 0.5 / 5.0
    rests = [start + share * 0.3 for start in (way, 2 * way + 0.3) for share in (0.0, 0.5, 1.0)]
    assert states.time[states.direction == 0] == pytest.approx(rests, rel=1e-12)


@pytest.mark.parametrize(("distance", "cruises"), [(1.0, True), (0.05, False)])
def test_a_trapezoid_of_speed_and_a_triangle(distance, cruises):
    v, a = 0.5, 4.0
    found = timing(distance, v, a)
    assert found.total == pytest.approx(distance / v + v / a if cruises else 2 * math.sqrt(distance / a), rel=1e-14)
    assert (found.cruise > 0) == cruises


@pytest.mark.parametrize(
    "motion",
    [
        Trapezoid(stroke=0.4, speed=0.5, acceleration=5.0, dwell=0.3),
        SCurve(stroke=0.4, speed=0.5, acceleration=5.0, jerk=60.0, dwell=0.3),
        Sine(stroke=0.4, frequency=0.7),
        Segments(
            segments=(
                Segment(distance=0.3, speed=0.5),
                Segment(duration=2.0),
                Segment(distance=-0.3, speed=0.1, force=200.0, acceleration=1.0),
            ),
            acceleration=5.0,
        ),
    ],
    ids=lambda motion: type(motion).__name__,
)
def test_states_are_consistent(motion):
    """Integrals of the acceleration and of the speed are the changes of speed and of position; the cycle closes."""
    states = motion.states()
    assert states.integral(states.speed) == pytest.approx(0.0, abs=1e-15)
    assert states.integral(states.acceleration) == pytest.approx(0.0, abs=1e-14)
    assert [states.position[0], states.position[-1]] == pytest.approx([0.0, 0.0], abs=1e-15)
    assert np.all(np.diff(states.time) >= 0)
    assert states.time[-1] == pytest.approx(states.cycle_time, rel=1e-15)
    assert states.travel == pytest.approx(2 * states.stroke, rel=1e-14)
    assert np.all(np.sign(states.speed) * states.direction >= 0)


def test_the_mean_of_a_power_of_the_speed():
    """Friction that grows with the root of the speed, from zero: the nodes of a phase are enough for it."""
    states = Trapezoid(stroke=0.1, speed=10.0, acceleration=4.0, returns=False).states()
    top = math.sqrt(0.1 * 4.0)
    assert states.integral(np.sqrt(np.abs(states.speed))) / states.cycle_time == pytest.approx(
        2 / 3 * math.sqrt(top), rel=1e-4
    )


@pytest.mark.parametrize(
    ("build", "named"),
    [
        (lambda: Trapezoid(stroke=0.0, speed=1.0, acceleration=1.0), "motion.stroke"),
        (lambda: SCurve(stroke=1.0, speed=1.0, acceleration=1.0, jerk=-1.0), "motion.jerk"),
        (lambda: Segment(distance=1.0, duration=1.0, speed=1.0), "segment.distance"),
        (lambda: Segment(distance=1.0), "segment.speed"),
        (lambda: Segments(segments=(Segment(distance=1.0, speed=1.0),)), "motion.segment 1.acceleration"),
        (lambda: Segments(segments=()), "motion.segments"),
    ],
)
def test_bad_motions_are_named(build, named):
    with pytest.raises(InputError, match=named):
        build()


def test_places_on_a_shaft_begin_where_they_are_told_or_lie_in_its_middle():
    states = Trapezoid(stroke=0.3, speed=0.5, acceleration=5.0).states()
    assert states.places_on(0.9) == pytest.approx(0.3 + states.position, rel=1e-12)
    assert states.places_on(0.9, 0.1) == pytest.approx(0.1 + states.position, rel=1e-12)
    for first in (0.0, 0.6, -0.1):
        with pytest.raises(InputError, match="does not fit between the bearings"):
            states.places_on(0.9, first)
