"""Bands of warming up: each sample is a transient of its own, exact but for the friction, and none is lost unsaid."""

import dataclasses
import itertools
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.thermal import warm_up_band as module
from ballscrew.axis.thermal.modes import functions
from ballscrew.axis.thermal.moving_source import Piece, Slot, marched
from ballscrew.axis.thermal.network import FrictionFactor
from ballscrew.axis.thermal.surroundings import VARIED
from ballscrew.axis.thermal.warm_up import equilibrium, warm_up
from ballscrew.axis.thermal.warm_up_band import sampled, warm_up_band
from ballscrew.basis.errors import InputError

SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=3500.0))
OIL = bs.Lubricant.from_grade("ISO VG 100", 293.15)
MODEL = bs.FrictionModel.reference()
AIR = bs.Surroundings(shaft_length=1.2)


@pytest.fixture(scope="module")
def duty():
    return bs.to_and_fro(MODEL, SCREW, OIL, axial_load=0.0, screw_speed=100.0, stroke=0.5)


@pytest.fixture(scope="module")
def central(duty):
    return warm_up(duty, AIR, cool_down=3600.0)


def pieces(instants):
    return [Piece(0, float(a), float(b - a), True) for a, b in itertools.pairwise(instants)]


def test_functions_of_the_steps():
    """Against their integrals, where the closed forms cancel and where they do not."""
    z = np.array([0.0, 1e-9, 1e-3, 0.4999, 0.5001, 3.0, 700.0])
    nodes, weights = np.polynomial.legendre.leggauss(80)
    s, w = (nodes + 1) / 2, weights / 2
    e, *found = functions(z)
    assert e == pytest.approx(np.exp(-z), rel=1e-15)
    for k, phi in enumerate(found, start=1):
        at = [np.sum(w * np.exp(-x * (1 - s)) * s ** (k - 1)) / math.factorial(k - 1) for x in z[:-1]]
        assert phi[:-1] == pytest.approx(at, rel=1e-13)
    assert found[0][-1] == pytest.approx(1 / 700, rel=1e-13)


def test_a_transient_by_modes_is_that_of_the_stiff_solver(central):
    """Two ways of integration: BDF of variable order, and exact steps of the linear part. Cooling has no friction."""
    works = np.flatnonzero(central.works)
    slot = Slot.of([central.network])
    start = np.full((1, central.network.size), 293.15)
    states = list(marched([slot], pieces(central.time[works]), start))
    nut = np.array([state.temperatures[0, -3] for state in states])
    assert nut == pytest.approx(central.nut_temperature[works][1:], abs=1e-3)
    resting = Slot.of([central.network.standing], works=False)
    last = list(marched([resting], pieces(central.time[works[-1] :]), states[-1].temperatures))[-1]
    assert last.temperatures[0] == pytest.approx(central.states[: central.network.size, -1], abs=1e-3)
    for state in states[::30]:
        stored = central.network.capacity @ (state.temperatures[0] - 293.15)
        assert state.generated[0] == pytest.approx(stored + state.lost[0], abs=1e-11 * state.generated[0])


def test_steps_are_of_second_order(central, monkeypatch):
    """Without friction that changes there is no error; with it, half the steps make a quarter of it."""
    slot, start = Slot.of([central.network]), np.full((1, central.network.size), 293.15)
    instants = np.linspace(0.0, 600.0, 6)

    def after(steps):
        monkeypatch.setattr("ballscrew.axis.thermal.moving_source.PER_NUT", steps)
        monkeypatch.setattr("ballscrew.axis.thermal.moving_source.PER_TIME", 1e9)
        return list(marched([slot], pieces(instants), start))[-1].temperatures[0, -3]

    exact = after(256.0)
    errors = [abs(after(steps) - exact) for steps in (2.0, 4.0, 8.0)]
    assert np.log2(errors[0] / errors[1]) > 1.7
    assert np.log2(errors[1] / errors[2]) > 1.7


def test_the_steps_are_as_short_as_they_are_said_to_be(central, monkeypatch):
    """From the cold, where friction changes most, against steps of a thirtieth of their length."""
    slot, start = Slot.of([central.network]), np.full((1, central.network.size), 293.15)

    def nut():
        states = marched([slot], pieces([0.0, 60.0, 300.0, 1200.0, 7200.0]), start)
        return np.array([state.temperatures[0, -3] for state in states])

    usual = nut()
    monkeypatch.setattr("ballscrew.axis.thermal.moving_source.PER_NUT", 30 * 8.0)
    monkeypatch.setattr("ballscrew.axis.thermal.moving_source.PER_TIME", 30 * 30.0)
    assert np.max(np.abs(usual - nut())) < 5e-4


def test_samples_side_by_side_are_transients_of_their_own(duty, central):
    """Others beside it change nothing, and a changed network is that of changed surroundings."""
    values = {
        "ball_conductance": 9.0, "shaft_convection": 20.0, "nut_conductance": 30.0, "shaft_share": 0.3,
        "ambient": 290.0, "nut_mass": 4.0, "bearing_conductance": 3.0,
    }  # fmt: skip
    where = dataclasses.replace(AIR, **values)
    own = warm_up(duty, where)
    changed = sampled(central.network, values, preload=None, factor=None)
    # of two networks that are known; a band draws its own
    found = module._transients([central.network, changed], (own.time, np.empty(0)), duty.mean_speed)
    assert found["nut_temperature"][:, 1] == pytest.approx(own.nut_temperature, abs=2e-3)
    assert found["shaft_growth"][:, 1] == pytest.approx(own.shaft_growth, rel=2e-4, abs=1e-9)
    assert found["screw_torque"][:, 1] == pytest.approx(own.screw_torque, rel=2e-4)
    assert equilibrium(changed).preload == pytest.approx(own.equilibrium.preload, rel=1e-9)


def test_another_preload_is_that_of_another_nut(duty, central):
    set_to = 3000.0
    nut = bs.to_and_fro(
        MODEL,
        dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=set_to)),
        OIL,
        axial_load=0.0,
        screw_speed=100.0,
        stroke=0.5,
    )
    where = dataclasses.replace(AIR, ball_conductance=4.0)
    own = bs.steady_heat(nut, where)
    changed = equilibrium(sampled(bs.steady_heat(duty, where).network, {}, preload=set_to, factor=None))
    assert changed.preload == pytest.approx(own.preload, rel=2e-3)  # of the cold approach, Hertz without film
    assert changed.power == pytest.approx(own.power, rel=2e-3)


def test_a_factor_of_the_friction_is_found(duty):
    """An input that changes the torque by a known factor: with half the friction, the start has half the torque."""
    factor = FrictionFactor((293.15, 300.0), (0.5, 0.8))
    assert [factor.at(T) for T in (280.0, 293.15, 300.0, 350.0)] == pytest.approx([0.5, 0.5, 0.8, 0.8])
    network = bs.steady_heat(duty, AIR).network
    start = np.full(network.size, 293.15)
    half = dataclasses.replace(network, friction_factor=factor)
    assert half.power(start) == pytest.approx(0.5 * network.power(start), rel=1e-12)


def test_bands_hold_the_middle_and_say_what_is_lost(duty, central):
    found = warm_up_band(duty, AIR, samples=64, cool_down=3600.0)
    assert np.array_equal(found.time, central.time)
    assert set(found.uncertain) >= {"surroundings.ball_conductance", "surroundings.shaft_share"}
    last = int(np.flatnonzero(central.works)[-1])
    for name, one in found.series.items():
        middle = central.shaft_temperature.mean(axis=1) if name == "shaft_temperature" else getattr(central, name)
        assert one.low[last] < middle[last] < one.high[last], name
        assert np.all(one.low <= one.median)
        assert np.all(one.median <= one.high)
    assert found.steady["preload"].low < central.equilibrium.preload < found.steady["preload"].high
    hot = dataclasses.replace(AIR, nut_conductance=60.0, ball_conductance=2.5)
    fast = bs.to_and_fro(MODEL, SCREW, OIL, axial_load=0.0, screw_speed=314.0, stroke=0.5)
    lost = warm_up_band(fast, hot, samples=32, outputs=21)
    assert 0 < 1 - lost.steady_share < 1
    assert lost.known_share[0] == 1
    assert np.all(np.diff(lost.known_share) <= 0)
    assert lost.known_share[-1] == pytest.approx(lost.steady_share, abs=0.15)


@pytest.mark.slow
def test_uncertain_friction_widens_the_torque(duty):
    one = {"surroundings.ball_conductance": bs.LogNormal(4.0, 1.5)}
    two = one | {"friction.boundary_friction_coefficient": bs.Normal(0.12, 0.03)}
    narrow, wide = (
        warm_up_band(duty, AIR, distributions=uncertain, samples=32, outputs=5, time=1200.0) for uncertain in (one, two)
    )
    assert narrow.series["screw_torque"].low[0] == pytest.approx(narrow.series["screw_torque"].high[0], rel=1e-9)
    ends = wide.series["screw_torque"]
    # the torque of the start is that of the model at the drawn coefficient
    drawn = [0.12 + sign * 1.96 * 0.03 for sign in (-1, 1)]
    by_model = [
        float(
            dataclasses.replace(MODEL, friction=dataclasses.replace(MODEL.friction, boundary_friction_coefficient=mu))(
                SCREW, OIL, axial_load=0.0, screw_speed=100.0
            ).screw_torque
        )
        for mu in drawn
    ]
    assert [ends.low[0], ends.high[0]] == pytest.approx(by_model, rel=0.03)


def test_friction_is_known_cold_and_as_warm_as_it_becomes_at_work():
    """With a coolant that warms the oil whatever the friction: the model itself, with the coefficient that is drawn."""
    heated = bs.Surroundings(
        shaft_length=1.2,
        bore=0.02,
        coolant=330.0,
        coolant_convection=3000.0,
        ball_conductance=15.0,
        nut_mass=100.0,
        nut_conductance=1.0,
        shaft_share=1.0,
    )
    single = dataclasses.replace(SCREW, nut=bs.SingleNut())
    ways = (
        bs.Segment(duration=0.4, speed=0.02, force=9000.0), bs.Segment(duration=2.1, speed=0.02, force=3000.0),
        bs.Segment(duration=0.5, speed=-0.1, force=500.0),
    )  # fmt: skip
    motion = bs.Segments(segments=ways)
    slow = bs.duty(MODEL, single, OIL, axis=bs.Axis(mass=0.0), motion=motion)
    drawn = 0.18
    found = warm_up_band(
        slow,
        heated,
        samples=2,
        time=3600.0,
        cool_down=1800.0,
        outputs=5,
        distributions={"friction.boundary_friction_coefficient": bs.Uniform(drawn - 1e-9, drawn + 1e-9)},
    )
    rougher = dataclasses.replace(
        MODEL, friction=dataclasses.replace(MODEL.friction, boundary_friction_coefficient=drawn)
    )
    lead = float(single.lead)
    for at in (0, found.last_at_work):
        oil = OIL.at(float(found.warm_up.oil_temperature[at]))
        torques = [
            float(rougher(single, oil, axial_load=way.force, screw_speed=math.tau * way.speed / lead).screw_torque)
            for way in ways
        ]
        mean = np.average(torques, weights=[0.008, 0.042, 0.05])  # by the turns of each
        assert found.series["screw_torque"].median[at] == pytest.approx(mean, rel=1e-3)
    warm = found.warm_up.oil_temperature
    assert warm[found.last_at_work] > 5 + warm[1] > 15 + warm[0]  # so that each instant has a friction of its own
    assert torques[0] > 1.5 * torques[1] > 2 * torques[2]


def test_nothing_that_is_changed_is_the_same_network(central):
    """Also of a hollow shaft through which nothing flows."""
    hollow = dataclasses.replace(
        central.network,
        shaft=dataclasses.replace(central.network.shaft, bore=0.02),
        surroundings=dataclasses.replace(AIR, bore=0.02),
    )
    for network in (central.network, hollow):
        same = sampled(network, {}, preload=None, factor=None)
        for name in ("losses", "outside", "conductances", "source", "constant", "capacity"):
            assert np.array_equal(getattr(same, name), getattr(network, name)), name
        assert (same.preload_set, same.approach_set) == (network.preload_set, network.approach_set)


@pytest.mark.parametrize(
    ("uncertain", "named"),
    [
        ({"surroundings.shaft_length": bs.Normal(1.0, 0.1)}, "surroundings.shaft_length: has no band"),
        ({"surroundings.ball_conductanc": bs.Normal(1.0, 0.1)}, "ball_conductance"),
        ({"temperature": bs.Normal(300.0, 1.0)}, "follows from the heat"),
        ({"frictio": bs.Normal(300.0, 1.0)}, "band.distributions.frictio"),
    ],
)
def test_inputs_that_have_no_band(duty, uncertain, named):
    with pytest.raises(InputError, match=named):
        warm_up_band(duty, AIR, distributions=uncertain, samples=4)


def test_what_varies_are_fields():
    names = {field.name for field in dataclasses.fields(bs.Surroundings)}
    assert set(VARIED) < names
