"""Mean loads and life over a cycle by hand: flanks that rest, halves that never do, and loads weighed by turns."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.drive_sizing import CycleLife, VendorRule, cubic_mean
from ballscrew.axis.duty_cycle.duty import duty
from ballscrew.axis.motion.profiles import Segment, Segments

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
SCREW = ROW.screw()
ARM = ROW.lead / math.tau
RATING = 50e3
#: 0.3 m against 6 kN, 0.1 m that is pushed by 2 kN, a rest under 9 kN, and 0.4 m back against 3 kN.
WAYS = (
    Segment(duration=3.0, speed=0.1, force=6000.0), Segment(duration=0.5, speed=0.2, force=-2000.0),
    Segment(duration=2.0, force=9000.0), Segment(duration=1.0, speed=-0.4, force=-3000.0),
)  # fmt: skip
CYCLE = 6.5


def of(preload=0.0, nut=None, **options):
    found = duty(0.9, SCREW, axis=Axis(mass=0.0), motion=Segments(segments=WAYS))
    return CycleLife(found, nut or bs.SingleNut(), preload, RATING, **options)


def mean(*parts):
    """The cubic mean over all 0.8 m."""
    return (sum(way * load**3 for way, load in parts) / 0.8) ** (1 / 3)


def test_flanks_that_rest_while_the_other_is_pressed():
    found = of()
    against, along = mean((0.3, 6000.0)), mean((0.1, 2000.0), (0.4, 3000.0))
    assert list(found.mean_loads.values()) == pytest.approx([against, along], rel=1e-12)
    assert found.mean_load == pytest.approx(against, rel=1e-12)
    both = mean((0.3, 6000.0), (0.1, 2000.0), (0.4, 3000.0))
    assert found.mean_load_of_both == pytest.approx(both, rel=1e-12)
    lives = [1e6 * (RATING / load) ** 3 for load in (against, along)]
    together = sum(life ** (-10 / 9) for life in lives) ** (-9 / 10)
    assert list(found.lives.values()) == pytest.approx(lives, rel=1e-12)
    assert found.revolutions == pytest.approx(together, rel=1e-12)
    assert found.revolutions_of_the_worse == pytest.approx(min(lives), rel=1e-12)
    assert found.cycles == pytest.approx(together / (0.8 / ROW.lead), rel=1e-12)
    assert found.time == pytest.approx(found.cycles * CYCLE, rel=1e-12)


@pytest.mark.parametrize("preload", [1500.0, 4000.0])
def test_halves_that_are_loaded_all_the_time(preload):
    """The relieved half has P ((1 + x)^1.5 − 2^1.5 x), x = F/(2^1.5 P) up to 1, the other F more."""

    def relieved(load):
        x = min(load / (2**1.5 * preload), 1.0)
        return preload * ((1 + x) ** 1.5 - 2**1.5 * x)

    found = of(preload, bs.DoubleNut(preload=preload))
    first = mean((0.3, 6000.0 + relieved(6000.0)), (0.1, relieved(2000.0)), (0.4, relieved(3000.0)))
    other = mean((0.3, relieved(6000.0)), (0.1, 2000.0 + relieved(2000.0)), (0.4, 3000.0 + relieved(3000.0)))
    assert list(found.mean_loads.values()) == pytest.approx([first, other], rel=1e-12)
    # balls between two grooves of one body are no halves
    assert dataclasses.replace(found, nut=bs.SingleNut()).mean_loads == pytest.approx(of().mean_loads)


def test_shocks_count_by_their_cube():
    plain, shaken = of(), of(load_factor=1.5)
    assert shaken.revolutions == pytest.approx(plain.revolutions / 1.5**3, rel=1e-12)
    assert shaken.mean_load == plain.mean_load


def test_one_way_alone_and_no_rating_and_no_turn():
    one_way = duty(0.9, SCREW, axis=Axis(mass=0.0), motion=Segments(segments=WAYS[:1]))
    found = CycleLife(one_way, bs.SingleNut(), 0.0, RATING)
    assert list(found.lives.values())[1] == math.inf
    assert found.revolutions == pytest.approx(1e6 * (RATING / 6000.0) ** 3, rel=1e-12)
    unrated = CycleLife(one_way, bs.SingleNut(), 0.0)
    assert math.isnan(unrated.revolutions)
    assert math.isnan(unrated.revolutions_of_the_worse)
    idle = duty(0.9, SCREW, axis=Axis(mass=0.0), motion=Segments(segments=WAYS[2:3]))
    found = CycleLife(idle, bs.SingleNut(), 0.0, RATING)
    assert [math.isnan(one) for one in (found.revolutions, found.cycles, found.mean_load)] == [True, True, True]
    free = duty(0.9, SCREW, axis=Axis(mass=0.0), motion=Segments(segments=(Segment(duration=1.0, speed=0.1),)))
    assert CycleLife(free, bs.SingleNut(), 0.0, RATING).revolutions == math.inf
    assert math.isnan(cubic_mean(np.ones(3), np.zeros(3)))


def test_the_rule_of_catalogues_by_hand():
    """F P/2πη and the inertia of all; at rest the guides help to hold, and a brake leaves nothing to the motor."""
    axis = Axis(
        mass=150.0,
        counterweight=30.0,
        inclination=math.radians(30),
        guide_friction_coefficient=0.05,
        guide_seal_force=20.0,
        inertia=3e-3,
        bearing_torque=0.15,
        transmission_ratio=2.5,
        transmission_efficiency=0.95,
    )
    ways = Segment(distance=0.3, speed=0.2, force=400.0), Segment(duration=1.0, force=100.0)
    motion = Segments(segments=(*ways, Segment(distance=-0.3, speed=0.2)), acceleration=2.0)
    g, eta = 9.80665, 0.85
    weight = 150 * g * math.sin(math.radians(30)) - 30 * g
    rubs = 0.05 * 150 * g * math.cos(math.radians(30)) + 20
    for holds in (False, True):
        found = duty(0.9, SCREW, axis=dataclasses.replace(axis, brake_holds=holds), motion=motion)
        rule, states = VendorRule(found, eta), found.states
        arm = ARM / 2.5
        inertia = 3e-3 + 180 * arm**2
        for phase, force, acceleration, direction in (
            (0, weight + 400 + rubs, 2.0, 1), (1, weight + 400 + rubs, 0.0, 1), (2, weight + 400 + rubs, -2.0, 1),
            (4, weight - rubs, -2.0, -1), (5, weight - rubs, 0.0, -1), (6, weight - rubs, 2.0, -1),
        ):  # fmt: skip
            wanted = (force * arm / eta + direction * 0.15 / 2.5) / 0.95 + inertia * acceleration / arm
            assert rule.torque[states.phase == phase] == pytest.approx(wanted, rel=1e-12)
        held = 0.0 if holds else max(weight + 100 - rubs, 0.0) * arm / eta / 0.95
        assert rule.torque[states.phase == 3] == pytest.approx(held, rel=1e-12)
        assert rule.torque_peak == pytest.approx(np.max(np.abs(rule.torque)), rel=1e-15)
        assert rule.torque_rms**2 * states.cycle_time == pytest.approx(states.weight @ rule.torque**2, rel=1e-12)
