"""Recorded motions: exact where they are exact, noise that is found, smoothing that it asks for, faults."""

import numpy as np
import pytest

from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.duty import duty
from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.axis.motion.trajectory import Trajectory
from ballscrew.basis.arrays import compact
from ballscrew.basis.errors import InputError
from support.equations import mechanical_energy

STEP = 1e-3
MOVE = Trapezoid(stroke=0.2, speed=0.5, acceleration=5.0, dwell=0.1)


def sampled(motion, step=STEP):
    """Times, positions and speeds of a motion at equal steps."""
    phases = motion.phases()
    ends = np.cumsum([float(phase.duration) for phase in phases])
    time = np.arange(0.0, ends[-1], step)
    found = np.empty((2, time.size))
    for number, phase in enumerate(phases):
        here = (time >= ends[number] - float(phase.duration)) & (time < ends[number])
        found[:, here] = phase.at(time[here] - ends[number] + float(phase.duration))[:2]
    return time, *found


def test_a_constant_acceleration_is_exact():
    time = np.linspace(0.0, 1.0, 101)
    states = Trajectory(time=time, position=3.0 * time**2 / 2, half_width=2).states()
    inner = slice(3, -3)
    assert states.speed[inner] == pytest.approx(3.0 * states.time[inner], rel=1e-10)
    assert states.acceleration[inner] == pytest.approx(3.0, rel=1e-9)
    assert states.cycle_time == pytest.approx(1.0, rel=1e-14)


def test_speeds_without_noise_are_taken_as_they_are():
    time, _, speed = sampled(MOVE)
    record = Trajectory(time=time, speed=speed)
    assert record.chosen_half_width == 0
    assert record.states().speed == pytest.approx((speed[1:] + speed[:-1]) / 2, abs=1e-15)
    assert record.states().travel == pytest.approx(0.4, rel=1e-3)


@pytest.mark.parametrize("column", ["position", "speed"])
def test_the_noise_is_found_and_smoothed(seed_screw, column):
    time, position, speed = sampled(MOVE)
    noise = {"position": 2e-6, "speed": 2e-3}[column]
    values = {"position": position, "speed": speed}[column]
    noisy = values + np.random.default_rng(1).normal(0.0, noise, time.size)
    record = Trajectory(time=time, **{column: noisy})
    # the deviation of a median of 1200 correlated numbers is some per cent
    assert record.noise == pytest.approx(noise, rel=0.2)
    assert record.chosen_half_width > 1
    assert record.acceleration_noise(record.chosen_half_width) < 0.05 * 6.0
    exact, found, raw = (
        duty(0.9, seed_screw, axis=Axis(mass=100.0), motion=motion).torque_rms
        for motion in (MOVE, record, record.smoothed_by(0))
    )
    assert abs(found / exact - 1) < 0.03
    assert abs(found / exact - 1) < abs(raw / exact - 1)


def test_the_predicted_noise_of_the_acceleration_is_that_of_samples():
    time = np.arange(20_000) * STEP
    noise = np.random.default_rng(2).normal(0.0, 1e-6, time.size)
    for width in (1, 4):
        record = Trajectory(time=time, position=noise, half_width=width)
        # the slopes before those near rest are taken as zero
        slopes = record._speeds(width)
        assert np.std(np.diff(slopes) / STEP) == pytest.approx(record.acceleration_noise(width), rel=0.05)


def test_the_noise_of_a_mean_falls_with_the_root_of_its_samples():
    """Private, as it only says which speeds are rests."""
    time = np.arange(400) * STEP
    record = Trajectory(time=time, speed=np.random.default_rng(4).normal(0.0, 1e-3, time.size))
    for width in (0, 1, 8):
        number = 2 * width + 1
        assert record._speed_noise(width) == pytest.approx(record.noise / np.sqrt(number), rel=1e-12)
        assert record.acceleration_noise(width) == pytest.approx(np.sqrt(2) * record.noise / number / STEP, rel=1e-12)
    # of a line through 2h + 1 places, the standard error of its slope
    record = Trajectory(time=time, position=record.speed)
    for width in (1, 4):
        squares = width * (width + 1) * (2 * width + 1) / 3
        assert record._speed_noise(width) == pytest.approx(record.noise / np.sqrt(squares) / STEP, rel=1e-12)


def test_a_rest_with_noise_is_a_rest():
    time = np.arange(2000) * STEP
    moving = np.where(time < 1.0, 0.3 * time, 0.3)
    noisy = moving + np.random.default_rng(3).normal(0.0, 1e-6, time.size)
    states = Trajectory(time=time, position=noisy).states()
    rest = (states.time > 1.1) & (states.time < 1.9)
    # of three standard deviations on either side 0.27 % are left
    assert np.mean(states.direction[rest] == 0) > 0.95
    assert (states.direction[(states.time > 0.1) & (states.time < 0.9)] == 1).all()


def test_energy_telescopes(seed_screw):
    time, position, _ = sampled(MOVE)
    found = duty(0.9, seed_screw, axis=Axis(mass=100.0, inertia=1e-3), motion=Trajectory(time=time, position=position))
    kept = found.energy_drawn - found.energy_returned - found.energy_lost
    assert kept == pytest.approx(mechanical_energy(found), abs=1e-9 * found.energy_drawn)


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"position": None}, "trajectory.position: missing · give positions, or speeds"),
        ({"force": np.zeros(3)}, "trajectory.force: has another size than the times (3) · give one a time"),
        ({"time": np.array([0.0, 1.0, 0.5, 2.0])},
         "trajectory.time sample 3: time runs back (0.5 s after 1 s) · sort the rows, or cut the record there"),
        ({"time": np.array([0.0, 1.0, 1.0, 2.0])}, "trajectory.time sample 3: time stands still (1 s after 1 s)"),
        ({"time": np.array([0.0, 1.0, 2.0, 60.0])}, "trajectory.time sample 4: comes after a gap (58 s, usually 1 s)"),
        ({"time": 1e-200 * np.arange(4.0)},
         "trajectory.time sample 2: has an unlikely step of time (1e-200 s) · 1e-09 s to 100000 s: check the unit"),
        ({"position": np.array([0.0, np.nan, 1.0, 1.0])}, "trajectory.position: must be finite (sample 2)"),
        ({"time": np.arange(2.0), "position": np.arange(2.0)}, "trajectory.time: has too few samples (2) · 3 at least"),
    ],
)  # fmt: skip
def test_faults(changes, line):
    with pytest.raises(InputError) as refused:
        Trajectory(**{"time": np.arange(4.0), "position": np.arange(4.0), **changes})
    assert str(refused.value).startswith(line)


def test_equal_values_take_the_memory_of_one():
    """A million zeros of a duty cost nothing; NaN is equal to NaN, and one other value makes it a full array."""
    for value in (0.0, 3.5, np.nan):
        many = compact(np.full(1000, value))
        assert many.strides == (0,)
        np.testing.assert_array_equal(many, np.full(1000, value))
    mixed = np.array([0.0, np.nan, 0.0])
    assert compact(mixed) is mixed
