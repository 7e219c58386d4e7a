"""A cycle in closed form: extremes and kinks within a phase, and a motor by hand."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.duty_cycle.drive_sizing import MotorCheck
from ballscrew.axis.duty_cycle.duty import cycle, duty
from ballscrew.axis.motion.profiles import SCurve, Sine, Trapezoid
from ballscrew.axis.motion.states import NODES, largest_within, sign_changes

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
SCREW = ROW.screw()
ARM = ROW.lead / (2 * math.pi)


class Drag:
    """Friction on the shaft in proportion to its speed."""

    def __init__(self, per_speed):
        self.per_speed = per_speed

    def __call__(self, state):
        torque = self.per_speed * np.abs(state.screw_speed)
        return SimpleNamespace(friction_effort=torque, contributions={"drag": torque}, validity={})


@pytest.mark.parametrize("frequency", [0.5, 2.0])
def test_a_largest_torque_and_a_change_of_sign_within_a_phase(frequency):
    """τ = P cos θ + Q sin θ: its largest is the root of the squares, and the motor brakes from θ = φ + π/2 to π."""
    mass, amplitude, drag, w = 100.0, 0.2, 0.01, math.tau * frequency
    motion = Sine(stroke=2 * amplitude, frequency=frequency)
    found = duty(1.0, SCREW, axis=Axis(mass=mass), motion=motion, also={"drag": Drag(drag)})
    inertia, friction, fastest = mass * amplitude * w**2 * ARM, drag * amplitude * w / ARM, amplitude * w / ARM
    largest, phi = math.hypot(inertia, friction), math.atan2(friction, inertia)
    assert found.torque_peak == pytest.approx(largest, rel=1e-10)
    assert found.torque_rms == pytest.approx(largest / math.sqrt(2), rel=1e-12)

    def energy(theta):
        """Integral of sin θ cos(θ − φ)."""
        return -math.cos(2 * theta - phi) / 4 + theta * math.sin(phi) / 2

    turns = phi + math.pi / 2
    both_ways = 2 * largest * fastest / w
    assert found.energy_drawn == pytest.approx(both_ways * (energy(turns) - energy(0.0)), rel=1e-10)
    assert found.energy_returned == pytest.approx(both_ways * (energy(turns) - energy(math.pi)), rel=1e-8)
    assert np.max(found.power) == pytest.approx(largest * fastest * (1 + math.sin(phi)) / 2, rel=1e-10)
    assert np.min(found.power) == pytest.approx(-largest * fastest * (1 - math.sin(phi)) / 2, rel=1e-9)
    # the states of the phases alone miss it
    assert (
        found.torque_peak
        > cycle(1.0, SCREW, axis=Axis(mass=mass), motion=motion, also={"drag": Drag(drag)}).torque_peak
    )


def test_a_kink_of_the_friction_within_a_phase():
    """The load of a quick upright sine changes its sign where the mass would fall behind: friction has a kink there."""
    mass, amplitude, eta, w = 100.0, 0.2, 0.9, math.tau * 2.0
    free = amplitude * w**2
    assert free > 9.80665
    found = duty(eta, SCREW, axis=Axis(mass=mass, inclination=math.pi / 2), motion=Sine(stroke=0.4, frequency=2.0))
    # of all ways |g + a u| over u = cos θ from -1 to 1, forth and back
    both = ((9.80665 + free) ** 2 + (free - 9.80665) ** 2) / (2 * free)
    assert found.energy_lost == pytest.approx(2 * (1 / eta - 1) * mass * amplitude * both, rel=1e-10)
    assert found.energy_drawn - found.energy_returned == pytest.approx(found.energy_lost, rel=1e-10)


def test_a_kink_of_the_loss_of_a_belt_within_a_phase():
    """The loss bends where what the belt passes on changes its sign, not where the torque with the rotor does."""
    mass, amplitude, drag, eta, inertia, w = 100.0, 0.2, 0.01, 0.8, 5e-3, math.tau * 2.0
    axis = Axis(mass=mass, transmission_efficiency=eta, inertia=inertia)
    motion = Sine(stroke=2 * amplitude, frequency=2.0)
    found = duty(1.0, SCREW, axis=axis, motion=motion, also={"drag": Drag(drag)})
    moved, friction, fastest = mass * amplitude * w**2 * ARM, drag * amplitude * w / ARM, amplitude * w / ARM
    passed, phi = math.hypot(moved, friction), math.atan2(friction, moved)

    def energy(theta):
        """Integral of sin θ cos(θ − φ)."""
        return -math.cos(2 * theta - phi) / 4 + theta * math.sin(phi) / 2

    turns = phi + math.pi / 2
    forwards, back = energy(turns) - energy(0.0), energy(turns) - energy(math.pi)
    both_ways = 2 * passed * fastest / w
    lost = both_ways * ((1 / eta - 1) * forwards + (1 - eta) * back)
    assert sum(found.energy_lost_in["transmission"].values()) == pytest.approx(lost, rel=1e-10)
    rubbed = 2 * drag * fastest**2 * math.pi / 2 / w
    assert found.energy_lost == pytest.approx(lost + rubbed, rel=1e-10)


def test_states_of_cuts_are_those_of_the_motion():
    """A cut adds states and moves none: weights still sum to the time, and integrals are the same."""
    states = SCurve(stroke=0.4, speed=0.5, acceleration=5.0, jerk=60.0, dwell=0.3).states()
    cuts = [0.01, 0.2, 0.2 + 1e-13, states.time[-1] - 0.1, -1.0, 99.0]
    cut = states.cut_at(cuts)
    assert cut.time.size == states.time.size + 2 * (NODES + 2)  # none where it rests, one where two are as good as one
    assert cut.cycle_time == pytest.approx(states.cycle_time, rel=1e-14)
    assert cut.integral(cut.speed**2) == pytest.approx(states.integral(states.speed**2), rel=1e-13)
    assert np.all(np.diff(cut.time) >= 0)
    assert cut.speeds_of_ends == states.speeds_of_ends
    place = states.places_of(cut)
    assert np.array_equal(cut.time[place >= 0], states.time[place[place >= 0]])
    assert set(cut.phase[place < 0]) == set(states.phase) - set(cut.phase[place >= 0])


def test_changes_of_sign_and_largest_values_of_known_functions():
    """In each part by itself; none at its ends, none in what is no number, none in times that are all alike."""
    states = Trapezoid(stroke=1.0, speed=1.0, acceleration=2.0, returns=False).states()  # 0.5 s, 0.5 s, 0.5 s
    t = states.time
    for size in (1.0, 1e-9, 1e9):  # in any unit
        found = sign_changes(states, size * np.sin(math.tau * (t - 0.1)))
        assert found == pytest.approx([0.1, 0.6, 1.1], abs=1e-12)
    assert largest_within(states, np.cos(math.tau * (t - 0.2))) == pytest.approx([0.2, 1.2], abs=1e-6)
    assert sign_changes(states, np.where(t < 0.5, np.nan, 1 - 2 * t)) == []
    assert sign_changes(states, np.where(t < 0.5, np.nan, 0.6 - t)) == pytest.approx([0.6], abs=1e-12)
    assert largest_within(states, -np.cos(math.tau * (t - 0.7)) - 2) == []  # all below zero
    assert largest_within(states, t) == largest_within(states, np.ones_like(t)) == []
    assert sign_changes(states, 1e-14 * np.cos(math.tau * t) + (t > 1.0)) == []  # rounding beside what is large
    late = dataclasses.replace(states, time=np.full_like(t, 1e9))
    assert sign_changes(late, np.sin(math.tau * (t - 0.1))) == []


#: Forth and back by a trapezoid with rests: 0.1 s to the speed, 0.9 s at it, 0.1 s to rest, 0.4 s of rest.
CYCLE = Trapezoid(stroke=0.5, speed=0.5, acceleration=5.0, dwell=0.4)
MASS, ROTOR, ETA, RATIO, BELT, BEARINGS = 200.0, 2e-3, 0.9, 2.0, 0.96, 0.2


@pytest.fixture(scope="module")
def driven():
    axis = Axis(
        mass=MASS,
        guide_friction_coefficient=0.01,
        guide_seal_force=30.0,
        inertia=ROTOR,
        bearing_torque=BEARINGS,
        transmission_ratio=RATIO,
        transmission_efficiency=BELT,
    )
    return duty(ETA, SCREW, axis=axis, motion=CYCLE)


def by_hand():
    """Torques of the motor while it speeds up, moves and slows down."""
    rubs, alpha = 0.01 * MASS * 9.80665 + 30.0, 5.0 / ARM * RATIO
    found = []
    for acceleration in (5.0, 0.0, -5.0):
        load = MASS * acceleration + rubs
        shaft = load * ARM + abs(load) * ARM * (1 / ETA - 1) + BEARINGS
        of_belt = shaft / RATIO / BELT if shaft > 0 else shaft / RATIO * BELT
        found.append(of_belt + ROTOR * alpha * acceleration / 5.0)
    return found


def test_a_motor_by_hand(driven):
    """RMS with the rests, the peak against a curve that falls with the speed, and the speed: margins and verdicts."""
    up, steady, down = by_hand()
    times = 2 * 0.1, 2 * 0.9, 2 * 0.1
    whole = 2 * (1.1 + 0.4)
    rms = math.sqrt(sum(t * torque**2 for t, torque in zip(times, (up, steady, down), strict=True)) / whole)
    fastest = 0.5 / ARM * RATIO
    assert driven.states.cycle_time == pytest.approx(whole, rel=1e-12)
    assert driven.torque_rms == pytest.approx(rms, rel=1e-12)
    assert driven.torque_peak == pytest.approx(up, rel=1e-12)
    largest_load = MASS * 5.0 + 0.01 * MASS * 9.80665 + 30.0
    assert driven.screw_torque == pytest.approx(largest_load * ARM * (1 / ETA - 1), rel=1e-12)
    assert np.max(np.abs(driven.motor_speed)) == pytest.approx(fastest, rel=1e-12)
    assert up > -down > 0 > -steady

    # the curve falls from 10 N m at half that speed to 3 N m at one and a half times it: 6.5 N m at it
    motor = Motor(
        rated_torque=2.0,
        peak_torque=10.0,
        largest_speed=1.5 * fastest,
        torque_constant=0.8,
        resistance=1.5,
        curve=((0.5 * fastest, 10.0), (1.5 * fastest, 3.0)),
    )
    assert motor.peak_at(np.array([0.0, 0.25, 1.0, -1.25, 1.6]) * fastest) == pytest.approx(
        [10.0, 10.0, 6.5, 4.75, 0.0]
    )
    checked = MotorCheck(driven, motor)
    assert np.max(checked.utilisation) == pytest.approx(up / 6.5, rel=1e-12)
    of_rms, of_peak, of_speed = checked.checks
    assert (of_rms.value, of_rms.limit, of_rms.utilisation) == pytest.approx((rms, 2.0, rms / 2.0), rel=1e-12)
    assert (of_peak.value, of_peak.limit, of_peak.utilisation) == pytest.approx((up, 6.5, up / 6.5), rel=1e-12)
    assert (of_speed.value, of_speed.limit, of_speed.utilisation) == pytest.approx((fastest, 1.5 * fastest, 2 / 3))
    assert [one.holds for one in checked.checks] == [rms < 2.0, up < 6.5, True]
    assert checked.copper_loss == pytest.approx(1.5 * rms**2 * whole / 0.8**2, rel=1e-12)


def test_heat_of_a_cycle_by_hand(driven):
    """Of the nut, the bearings, the guides and the belt, over both ways of half a metre."""
    up, steady, down = by_hand()
    rubs, way = 0.01 * MASS * 9.80665 + 30.0, 2 * 0.5
    ways = {5.0: 2 * 0.025, 0.0: 2 * 0.45, -5.0: 2 * 0.025}
    found = {name: sum(parts.values()) for name, parts in driven.energy_lost_in.items()}
    nut = sum(abs(MASS * a + rubs) * (1 / ETA - 1) * distance for a, distance in ways.items())
    assert found["nut"] == pytest.approx(nut, rel=1e-12)
    assert found["guides"] == pytest.approx(rubs * way, rel=1e-12)
    assert found["support bearings"] == pytest.approx(BEARINGS * way / ARM, rel=1e-12)
    whole = sum(
        torque * distance / ARM * RATIO for torque, distance in zip((up, steady, down), ways.values(), strict=True)
    )
    assert driven.energy_lost == pytest.approx(whole, rel=1e-12)
    assert driven.heat["nut"] == pytest.approx(nut / driven.states.cycle_time, rel=1e-12)
