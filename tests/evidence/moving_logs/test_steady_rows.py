"""Friction over speed from rows at constant speed: a law put in comes out, and a real mill as read by hand."""

import json
from pathlib import Path

import numpy as np
import pytest

from ballscrew.basis.errors import InputError
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.evidence.moving_logs.power_law import steady_friction
from ballscrew.evidence.moving_logs.reading import read_moving

EXAMPLES = Path(__file__).parents[3] / "examples"
FILES = [str(EXAMPLES / f"{name}.csv") for name in ("mill_slow", "mill_fast")]
OPTIONS = ("--period", "0.1 s", "--case", str(EXAMPLES / "feed_axis.toml"), "--json")


def log_of(speeds, friction, offset=0.0):
    """Strokes there and back at each speed, three times, with a force that also accelerates 50 kg."""
    ramp = np.array([0.0, 0.137, 0.311, 0.573, 0.831])
    stroke = np.concatenate([[0.0] * 5, ramp, [1.0] * 20, ramp[::-1]])
    speed = np.concatenate([sign * v * stroke for v in speeds for _ in range(3) for sign in (1, -1)])
    time = 0.1 * np.arange(speed.size)
    force = np.sign(speed) * friction(np.abs(speed)) + offset + 50 * np.gradient(speed, time)
    return MovingLog(time=time, force=force, speed=np.round(speed, 6))


def test_a_law_of_friction_comes_out():
    found = steady_friction(log_of([0.01, 0.03, 0.1, 0.3], lambda v: 40 * v**0.4, offset=7.0))
    assert [one.speed for one in found.speeds] == pytest.approx([0.01, 0.03, 0.1, 0.3], rel=1e-6)
    assert [one.friction for one in found.speeds] == pytest.approx(
        [40 * one.speed**0.4 for one in found.speeds], rel=1e-6
    )
    assert [one.offset for one in found.speeds] == pytest.approx([7.0] * 4)


def test_noise_is_in_the_interval_of_the_exponent():
    rng = np.random.default_rng(3)
    log = log_of([0.01, 0.03, 0.1, 0.3], lambda v: 40 * v**0.4)
    noisy = MovingLog(time=log.time, force=log.force + rng.normal(0, 0.5, len(log)), speed=log.speed)
    low, high = steady_friction(noisy).interval
    assert low < 0.4 < high
    assert high - low < 0.1


def test_speeds_that_creep_are_of_several_speeds():
    """1 mm/s, and from 50 to 156 mm/s, each a twenty-fifth faster than the one before."""
    log = log_of([0.05 * 1.04**n for n in range(30)] + [0.001], lambda v: 40 * v**0.4)
    speeds = [one.speed for one in steady_friction(log).speeds]
    assert len(speeds) == 9
    assert steady_friction(log).exponent == pytest.approx(0.4, abs=0.02)


def test_an_offset_that_differs_between_speeds_is_in_the_error():
    """0 N at 10 mm/s and 20 N at 30: at 100, logged forward alone, the friction of 41 N is uncertain by as much."""
    log = log_of([0.001, 0.01, 0.03, 0.1], lambda v: 41 + 0 * v)
    force = log.force + 20.0 * (np.abs(np.repeat(np.repeat([0.001, 0.01, 0.03, 0.1], 6), 35)) == 0.03)
    rows = np.r_[:630, 630:665]
    *_, alone = steady_friction(MovingLog(time=log.time[rows], force=force[rows], speed=log.speed[rows])).speeds
    assert alone.is_one_way
    assert abs(alone.friction - 41.0) < 2 * alone.std < 60.0


def test_strokes_that_are_not_repeated_are_refused():
    log = log_of([0.001, 0.03], lambda v: 41 + 0 * v)
    rows = np.r_[:210, 210:280]
    with pytest.raises(InputError, match="has one stroke alone at each speed and direction · repeat the strokes"):
        steady_friction(MovingLog(time=log.time[rows], force=log.force[rows], speed=log.speed[rows]))


def test_what_cannot_be_told_is_refused():
    with pytest.raises(InputError, match="no rows at constant speed in both directions"):
        steady_friction(MovingLog(time=np.arange(300.0), force=np.ones(300), speed=np.full(300, 0.1)))
    with pytest.raises(InputError, match="no column of a speed"):
        steady_friction(MovingLog(time=np.arange(300.0), force=np.ones(300), position=np.arange(300.0)))
    slow = log_of([0.01, 0.02], lambda v: 40 + 0 * v)
    assert np.isnan(steady_friction(slow).exponent)


def test_one_direction_counts_without_the_offset_of_the_other_speeds():
    """41 N at 0.1 m/s, logged backward alone, once; 7 N of gravity are known from the slower speed."""
    log = log_of([0.001, 0.03, 0.1], lambda v: 40 + 1.0 * (v > 0.05), offset=7.0)
    rows = np.r_[:420, 455:490]
    assert np.all(log.speed[455:490] <= 0)
    force = log.force + np.random.default_rng(2).normal(0, 0.1, len(log))
    # the slowest tells how finely speeds are written, and is no steady one
    slow, alone = steady_friction(MovingLog(time=log.time[rows], force=force[rows], speed=log.speed[rows])).speeds
    assert (slow.is_one_way, alone.is_one_way) == (False, True)
    assert np.isnan(alone.forward)
    assert alone.backward == pytest.approx(-34.0, abs=0.1)
    assert alone.offset == slow.offset == pytest.approx(7.0, abs=0.1)
    assert alone.friction == pytest.approx(41.0, abs=0.1)
    # two errors of the same scatter: that of a single stretch, and that of the offset
    assert alone.std > slow.std > 0


def test_a_real_mill_as_read_by_hand():
    """Amperes of the X axis, by thirty lines written apart from this program: 9.4 at 50 mm/s, in one direction."""
    slow, fast = (read_moving(file, lead=0.01, axis="X1", period=0.1, steady=True) for file in FILES)
    assert (slow.unit, fast.unit) == ("A", "A")
    three, _, twenty, fifty = steady_friction(slow, fast).speeds
    assert 4.2 < three.friction < 5.2
    # by hand without telling 18 from 20 mm/s
    assert 6.5 < twenty.friction < 7.5 + twenty.std
    assert fifty.friction == pytest.approx(9.4, abs=fifty.std)
    assert fifty.is_one_way
    assert all(0.05 < speed.std < 0.8 for speed in (three, twenty, fifty))


def test_on_the_command_line(ballscrew):
    document = json.loads(ballscrew("fit", FILES[0], "--test", FILES[1], "--steady", "--axis", "X1", *OPTIONS).stdout)
    assert document["unit"] == "A"
    assert [round(1e3 * speed["speed"]) for speed in document["speeds"]] == [3, 18, 20, 50]
    assert [speed["backward"] is None for speed in document["speeds"]] == [False, False, False, True]
    low, high = document["speed_exponent"]["interval"]
    assert 0 < low < document["speed_exponent"]["value"] < high < 1


@pytest.mark.parametrize("axis", ["X1", "Y1"])
def test_a_motion_that_the_log_does_not_tell_is_refused_in_one_line(ballscrew, axis):
    process = ballscrew("fit", FILES[1], "--moving", "--axis", axis, "--torque-constant", "0.5 N m/A", *OPTIONS)
    assert (process.returncode, process.stdout) == (2, "")
    (line,) = process.stderr.strip().splitlines()
    assert "moves too little above its noise" in line


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (("--axis", "Q7", *OPTIONS), "--axis: no heading begins with it (Q7)"),
        (("--axis", "X1", *OPTIONS[2:]), 'at a fixed period: --period "0.1 s"'),
        (OPTIONS, "say which axis: --axis X1 or --axis Y1"),
        (OPTIONS[2:], "say which axis: --axis X1 or --axis Y1"),
        (("--axis", "X1", *OPTIONS), "or --steady for friction over speed in amperes"),
    ],
)
def test_options_of_logs_of_controllers(ballscrew, options, text):
    process = ballscrew("fit", FILES[0], "--moving", *options)
    assert process.returncode == 2
    (line,) = process.stderr.strip().splitlines()
    assert text in line
