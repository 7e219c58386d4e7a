"""A nut whose heat goes along with it: the exact profile, conservation, and spread heat as the limit of fast cycles."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.duty import duty
from ballscrew.axis.motion.profiles import Segment, Segments
from ballscrew.axis.thermal.friction_map import friction_map
from ballscrew.axis.thermal.moving_source import Itinerary, Slot, is_long, itinerary_of, marched
from ballscrew.axis.thermal.network import CAPACITY, CONDUCTIVITY, DENSITY, network_of, nut_length_of
from ballscrew.axis.thermal.warm_up import warm_up

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
SCREW = ROW.screw(nut=bs.DoubleNut(preload=3500.0))
OIL = bs.Lubricant.from_grade("ISO VG 100", 293.15)
MODEL = bs.FrictionModel.reference()
AIR = bs.Surroundings(shaft_length=1.2)


def moved(*segments):
    return duty(MODEL, SCREW, OIL, axis=Axis(mass=0.0), motion=Segments(segments=segments, acceleration=5.0))


def to_and_fro(rpm, stroke=0.6):
    return bs.to_and_fro(MODEL, SCREW, OIL, axial_load=0.0, screw_speed=rpm * math.tau / 60, stroke=stroke)


@pytest.fixture(scope="module")
def creeping():
    """One long move with all heat into the shaft, far from the ends, and its network in fine cells."""
    where = bs.Surroundings(
        shaft_length=2.0,
        shaft_share=1.0,
        ball_conductance=1e-9,
        shaft_convection=60.0,
        first_position=0.4,
        shaft_to_bearing=0.0,
    )
    slow = moved(Segment(duration=3000.0, speed=0.4e-3))
    network = network_of(slow, where)
    shaft = dataclasses.replace(network.shaft, cells=200)
    return slow, dataclasses.replace(network, shaft=shaft, spread=np.full(200, 1 / 200))


def travelled(slow, network):
    """The state at the end of the move."""
    along = itinerary_of(slow, network)
    start = np.full((1, network.size), float(network.surroundings.ambient))
    slots = [Slot.of([one]) for one in along.networks(network)]
    (state,) = marched(slots, along.pieces(np.array([0.0, 3000.0])), start, grows=False)
    return state


@pytest.fixture(scope="module")
def arrived(creeping):
    return travelled(*creeping)


def test_the_profile_that_travels_with_the_nut(creeping, arrived, monkeypatch):
    """exp((−U ± √(U² + 4 a β)) ξ / 2a) before and behind it, as for the bar alone; of second order in the slots."""
    slow, network = creeping
    shaft, speed = network.shaft, 0.4e-3
    diffusivity, beta = CONDUCTIVITY / (DENSITY * CAPACITY), 4 * 60.0 / (DENSITY * CAPACITY * shaft.diameter)
    root = math.sqrt(speed**2 + 4 * diffusivity * beta)
    exact = np.array([-speed - root, -speed + root]) / (2 * diffusivity)
    width, xi = nut_length_of(SCREW), shaft.places - (0.4 + speed * 3000.0)
    parts = (xi > 0.6 * width) & (xi < 0.18), (xi < -0.6 * width) & (xi > -0.4)

    def errors(state):
        rise = state.temperatures[0, :-3] - network.surroundings.ambient
        slopes = [np.polyfit(xi[part], np.log(rise[part]), 1)[0] for part in parts]
        return np.abs(slopes / exact - 1)

    ahead, behind = errors(arrived)
    assert ahead < 0.015  # a decay of 28 mm in cells of 10 mm
    assert behind < 1e-3
    coarse = []
    for slots in (2.0, 4.0):
        monkeypatch.setattr("ballscrew.axis.thermal.moving_source.PER_NUT_LENGTH", slots)
        coarse.append(errors(travelled(slow, network))[1])
    assert np.log2(coarse[0] / coarse[1]) > 1.8


@pytest.mark.slow
def test_heat_that_travels_is_conserved(creeping, arrived):
    _, network = creeping
    state = arrived
    stored = network.capacity @ (state.temperatures[0] - network.surroundings.ambient)
    assert state.generated[0] == pytest.approx(stored + state.lost[0], abs=1e-8 * state.generated[0])


@pytest.mark.parametrize(("hours", "follows"), [(0.9, False), (1.1, True)])
def test_a_cycle_of_more_than_a_fiftieth_of_the_time_is_followed(hours, follows):
    duty = moved(
        Segment(distance=0.3, speed=0.02),
        Segment(duration=3600.0 * hours / 50 - 30.0),
        Segment(distance=-0.3, speed=0.02),
    )
    assert is_long(duty, 3600.0) is follows


@pytest.mark.slow
def test_chosen_by_the_motion():
    """A cycle of 12 s in an hour is spread, one move of an hour is followed; heat is conserved in both."""
    fast = warm_up(to_and_fro(600), AIR, time=3600.0, outputs=3)
    slow = moved(Segment(distance=0.6, speed=0.6 / 1800), Segment(distance=-0.6, speed=0.6 / 1800))
    creeping = warm_up(slow, AIR, time=3600.0, outputs=13, cool_down=600.0)
    assert fast.along is None
    assert isinstance(creeping.along, Itinerary)
    heat = creeping.heat
    assert heat["generated"] == pytest.approx(heat["stored"] + heat["lost"], abs=1e-8 * creeping.generated)
    assert creeping.heat["generated"][-1] == pytest.approx(heat["generated"][12], rel=1e-12)  # none while it stands
    # the shaft is the warmest in the nut, where half a cycle is from one end to the other
    for at, place in ((3, 0.3 + 0.3), (6, 0.3 + 0.6), (9, 0.3 + 0.3)):
        warmest = creeping.places[np.argmax(creeping.shaft_temperature[at])]
        assert warmest == pytest.approx(place, abs=nut_length_of(SCREW) / 2 + 0.02)


@pytest.mark.slow
def test_fast_cycles_are_the_spread_heat():
    """Both ways at once: what is generated, grows, and warms up agrees within what a stroke has at its own places."""
    spread, followed = (warm_up(to_and_fro(1000), AIR, time=900.0, outputs=4, moving=way) for way in (False, True))
    assert followed.generated == pytest.approx(spread.generated, rel=2e-3)
    assert followed.shaft_growth[-1] == pytest.approx(spread.shaft_growth[-1], rel=0.02)
    rise = spread.nut_temperature[-1] - 293.15
    assert followed.nut_temperature[-1] == pytest.approx(spread.nut_temperature[-1], abs=0.02 * rise)


@pytest.mark.slow
def test_slots_are_the_cycle():
    """Their friction is in the mean that of the cycle, and their times are its time."""
    work = moved(
        Segment(distance=0.5, speed=0.1), Segment(duration=20.0), Segment(distance=-0.5, speed=0.2, force=4000.0)
    )
    network = network_of(work, AIR)
    along = itinerary_of(work, network)
    assert along.edges[-1] == pytest.approx(work.states.cycle_time)
    parts = np.diff(along.edges)
    mean = sum(part * friction.power for part, friction in zip(parts, along.frictions, strict=True)) / np.sum(parts)
    assert mean == pytest.approx(friction_map(work).power, rel=1e-12)
    assert np.sum(along.spreads, axis=1) == pytest.approx(np.ones(parts.size))
    instants = np.array([0.0, 7.0, 40.0, 100.0])
    pieces = list(along.pieces(instants))
    assert sum(piece.length for piece in pieces) == pytest.approx(100.0)
    ends = [piece.start + piece.length for piece in pieces if piece.shown]
    assert ends == pytest.approx(instants[1:])
    assert all(along.edges[p.slot] - 1e-9 <= p.start % along.edges[-1] + 1e-9 for p in pieces)


@pytest.mark.slow
def test_bands_of_a_nut_that_is_followed():
    """Samples at the central values are the transient itself."""
    slow = moved(Segment(distance=0.3, speed=0.01), Segment(distance=-0.3, speed=0.01))
    exact = {"surroundings.nut_conductance": bs.Uniform(9.999999, 10.000001)}
    found = bs.warm_up_band(slow, AIR, distributions=exact, samples=2, time=600.0, outputs=5, cool_down=150.0)
    central = found.warm_up
    assert central.along is not None
    for name in ("nut_temperature", "shaft_growth", "preload", "screw_torque"):
        assert found.series[name].median == pytest.approx(getattr(central, name), rel=1e-4, abs=1e-12), name
