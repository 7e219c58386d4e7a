"""Warming up: heat is conserved, the end is the equilibrium, and what is outside the model is said."""

import dataclasses
import math
import types

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.duty import duty
from ballscrew.axis.motion.profiles import Segment, Segments
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.makers_bearing import KnownBearing
from ballscrew.axis.thermal.network import network_of, steady
from ballscrew.axis.thermal.surroundings import STILL, Surroundings
from ballscrew.axis.thermal.warm_up import warm_up
from ballscrew.basis.errors import InputError

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
OIL = bs.Lubricant.from_grade("ISO VG 100", 293.15)
MODEL = bs.FrictionModel.reference()
PLAIN = Surroundings(shaft_length=1.2)
COOLED = dataclasses.replace(PLAIN, nut_conductance=60.0)


def to_and_fro(rpm, nut=None, oil=OIL, stroke=0.5, model=MODEL):
    """A long stroke at one speed, without a mass."""
    speed = rpm / 60 * ROW.lead
    ways = [Segment(duration=stroke / speed, speed=sign * speed) for sign in (1, -1)]
    screw = ROW.screw(nut=nut or bs.DoubleNut(preload=3500.0))
    return duty(model, screw, oil, axis=Axis(mass=0.0, bearing_torque=0.1), motion=Segments(segments=tuple(ways)))


@pytest.fixture(scope="module")
def found():
    return warm_up(to_and_fro(1000), PLAIN, cool_down=3600.0)


def test_generated_is_stored_and_lost(found):
    heat = found.heat
    assert heat["generated"] == pytest.approx(heat["stored"] + heat["lost"], abs=1e-8 * found.generated)
    assert found.time[-1] == 5 * 3600.0


def test_the_end_is_the_equilibrium(monkeypatch):
    monkeypatch.setattr("ballscrew.axis.thermal.warm_up.RTOL", 1e-9)
    long = warm_up(to_and_fro(1000), PLAIN, time=40 * 3600.0, outputs=5)
    end = long.equilibrium
    assert end.exists
    assert end.margin > 0
    assert long.nut_temperature[-1] == pytest.approx(end.nut_temperature, abs=1e-6)
    # of the steady state itself, not of the tolerance of the integration
    balance = long.network.constant + long.network.source * long.network.power(end.temperatures)
    balance = balance - long.network.conductances @ end.temperatures
    assert np.max(np.abs(balance)) < 1e-9 * end.power
    assert long.shaft_growth[-1] == pytest.approx(end.growth, rel=1e-5)


def test_it_cools_down_again(found):
    last = int(np.flatnonzero(found.works)[-1])
    within = 1e-5  # of the integration, once nothing changes any more
    assert np.all(np.diff(found.nut_temperature[: last + 1]) > -within)
    assert np.all(np.diff(found.nut_temperature[last:]) < within)
    assert found.nut_temperature[last] > found.nut_temperature[-1] + 5 > 298.15
    assert found.heat["generated"][-1] == pytest.approx(found.heat["generated"][last], rel=1e-12)


def test_a_cooled_nut_holds_tighter():
    """A shaft that is warmer than its nut: to cool the nut alone raises the preload, and with it the torque."""
    plain, cooled = (warm_up(to_and_fro(500), where) for where in (PLAIN, COOLED))
    assert cooled.nut_temperature[-1] < plain.nut_temperature[-1]
    assert cooled.preload[-1] > plain.preload[-1] > 3500.0
    assert cooled.screw_torque[-1] > plain.screw_torque[-1]


def test_preload_by_hand():
    """Both normals of each ball give way by cos α · α_T · ΔT · d_m/2 more."""
    network = network_of(to_and_fro(500), PLAIN)
    alpha, d_m = ROW.contact_angle, ROW.ball_circle
    per_kelvin = math.cos(alpha) * 11.7e-6 * d_m / 2
    expected = 3500.0 * (1 + 2.0 * per_kelvin / network.approach_set) ** 1.5
    assert network.preload(2.0) == pytest.approx(expected, rel=1e-12)
    assert network.preload(-1000.0) == 0.0


def test_runaway_is_a_verdict():
    """A nut on a heat sink at high speed has no equilibrium; the run stops where friction is not known any more."""
    hot = warm_up(to_and_fro(3000), dataclasses.replace(COOLED, ball_conductance=2.0))
    end = hot.equilibrium
    assert not end.exists
    assert end.margin < 0
    assert hot.stopped is not None
    assert hot.time[-1] == hot.stopped
    assert hot.nut_temperature[-1] > hot.nut_temperature[0]
    assert math.isnan(end.nut_temperature)
    assert {record.id for record in hot.records} == {"verdict.equilibrium", "warning.bracing", "warning.stopped"}


def test_a_full_bath_is_a_run_of_its_own_that_takes_as_long():
    """Where oil comes back late there is less friction than in a full bath, which is another run, of another model."""
    cold = dataclasses.replace(PLAIN, ambient=268.15)
    inlet = dataclasses.replace(MODEL.inlet, replenishment_constant=0.0)
    starved, bath = (
        warm_up(to_and_fro(1000, model=model), cold, time=1200.0, cool_down=600.0)
        for model in (MODEL, dataclasses.replace(MODEL, inlet=inlet))
    )
    assert starved.flooded.screw_torque[0] == pytest.approx(bath.screw_torque[0], rel=1e-12)
    assert starved.flooded.screw_torque[0] > 2 * starved.screw_torque[0]
    assert starved.flooded.time[-1] == starved.time[-1] == 1800.0
    assert np.array_equal(starved.flooded.time, starved.time)
    assert bath.flooded is bath


def test_a_coolant_in_the_shaft():
    chilled = dataclasses.replace(PLAIN, bore=0.012, coolant=293.15)
    warm, cold = (warm_up(to_and_fro(1000), where).shaft_growth[-1] for where in (PLAIN, chilled))
    assert cold < 0.3 * warm


def test_a_nut_without_preload_has_none():
    single = warm_up(to_and_fro(1000, nut=bs.SingleNut()), PLAIN, time=3600.0)
    assert set(single.preload) == {0.0}


def test_a_hollow_shaft_without_a_coolant_loses_nothing_through_its_bore():
    dry = network_of(to_and_fro(500), dataclasses.replace(PLAIN, bore=0.012))
    assert dry.shaft.cell_to_coolant == 0.0


def test_a_standing_shaft_cools_as_a_body_at_rest(found):
    """Late, the slowest mode decays by free convection and the ends, and not as in the air of a shaft that turns."""
    standing, turning = found.network.standing, found.network
    assert standing.shaft.convection == STILL < turning.shaft.convection
    given = network_of(to_and_fro(500), dataclasses.replace(PLAIN, shaft_convection=30.0))
    assert given.standing is given


def test_friction_is_not_a_number_where_it_is_not_known(found):
    """Where the map ends, a torque in the answer would be that of its edge."""
    states = found.states.copy()
    states[: found.network.size, -1] = 450.0
    beyond = dataclasses.replace(found, states=states)
    assert math.isnan(beyond.screw_torque[-1])
    assert beyond.screw_torque[:-1] == pytest.approx(found.screw_torque[:-1])


@pytest.mark.slow
@pytest.mark.parametrize(
    "nut",
    [
        bs.OversizeBallNut(preload=1500.0),
        bs.OversizeBallNut(oversize=3e-6),
        bs.OffsetLeadNut(preload=2000.0),
        bs.DoubleNut(preload=3000.0, bodies=bs.Bodies()),
    ],
    ids=["preload of four contacts", "oversize", "offset lead", "elastic bodies"],
)
def test_every_kind_of_nut(nut):
    """The heat is that of the model at the oil and preload found, whatever arranges the balls."""
    screw = ROW.screw(nut=nut)
    found = bs.steady_heat(bs.to_and_fro(MODEL, screw, OIL, axial_load=0.0, screw_speed=100.0, stroke=0.5), PLAIN)
    warm = dataclasses.replace(screw, nut=nut.changed("preload", found.preload))
    there = MODEL(warm, OIL.at(found.oil_temperature), axial_load=0.0, screw_speed=100.0)
    assert found.power == pytest.approx(100.0 * float(there.screw_torque), rel=2e-4)
    assert found.network.preload_set > 0


def test_a_table_of_compensation(found):
    places, growth = found.compensation_table(0.1)
    assert places.tolist() == pytest.approx(np.arange(0, 1.25, 0.1).tolist())
    assert growth[0] == 0.0
    assert np.all(np.diff(growth) > 0)
    assert found.compensation_table(0.35)[0].tolist() == pytest.approx([0.0, 0.35, 0.7, 1.05, 1.2])


def test_the_steady_state_of_a_point_in_one_call():
    """To and fro at the point of a call of the model: its heat is that of the model at the oil and preload found."""
    screw = ROW.screw(nut=bs.DoubleNut(preload=3500.0))
    point = {"axial_load": 2000.0, "screw_speed": 100.0}
    end = bs.steady_heat(bs.to_and_fro(MODEL, screw, OIL, **point, stroke=0.5), PLAIN)
    warm = dataclasses.replace(screw, nut=bs.DoubleNut(preload=end.preload))
    at_end = [MODEL(warm, OIL.at(end.oil_temperature), **{**point, "screw_speed": way}) for way in (100.0, -100.0)]
    mean = np.mean([100.0 * float(found.screw_torque) for found in at_end])
    assert end.power == pytest.approx(mean, rel=1e-4)
    assert end.exists


def test_steady_temperatures_are_linear_in_the_heat():
    network = network_of(to_and_fro(500), PLAIN)
    rises = [steady(network, power) - steady(network, 0.0) for power in (1.0, 7.0)]
    assert rises[1] == pytest.approx(7 * rises[0], rel=1e-10)


@pytest.mark.parametrize(
    ("build", "named"),
    [
        (lambda: warm_up(to_and_fro(500)), "surroundings.shaft_length"),
        (lambda: warm_up(to_and_fro(500, stroke=2.0), PLAIN), "motion: does not fit between"),
        (lambda: warm_up(to_and_fro(500), PLAIN, time=0.0), "warm_up.time"),
        (lambda: warm_up(to_and_fro(500, oil=bs.Lubricant(viscosity=0.1)), PLAIN), "lubricant"),
        (lambda: Surroundings(coolant=293.15), "surroundings.coolant"),
        (lambda: warm_up(to_and_fro(500), dataclasses.replace(PLAIN, bore=0.05)), "surroundings.bore"),
        (lambda: warm_up(to_and_fro(500), dataclasses.replace(PLAIN, ambient=230.0)), "surroundings.ambient"),
        (lambda: warm_up(to_and_fro(500), PLAIN, time=60.0, moving=False).compensation_table(0.0), "warm_up.step"),
        (lambda: Surroundings(shaft_share=1.5), "surroundings.shaft_share"),
    ],
)
def test_bad_input_is_named(build, named):
    with pytest.raises(InputError, match=named):
        build()


def test_the_way_of_bracing_decides():
    """Halves that are pushed apart lose preload as the shaft between them grows, halves pulled together gain."""
    ends, per_kelvin, work = {}, {}, to_and_fro(500)
    for bracing in ("", "apart", "together"):
        where = dataclasses.replace(PLAIN, bracing=bracing)
        found = warm_up(work, where, time=60.0, outputs=2, moving=False)
        ends[bracing] = found.equilibrium.preload
        per_kelvin[bracing] = found.network.approach_per_kelvin
        assert bool(found.network.by_bracing) == (not bracing)
        assert ("warning.bracing" in {record.id for record in found.records}) == (not bracing)
    assert ends["apart"] < ends[""] < ends["together"]
    network = network_of(work, PLAIN)
    half = float(ROW.screw().loaded_turns * ROW.lead)
    along = 11.7e-6 * half * math.sin(ROW.contact_angle) / 2
    assert network.approach_of_unknown_sign == pytest.approx(along, rel=1e-12)
    assert per_kelvin["together"] - per_kelvin[""] == pytest.approx(along, rel=1e-9)
    assert per_kelvin["apart"] - per_kelvin[""] == pytest.approx(-along, rel=1e-9)
    alone = network_of(to_and_fro(500, nut=bs.OversizeBallNut(preload=2000.0)), PLAIN)
    assert not alone.by_bracing


def test_bearings_heat_their_own_ends():
    """By their mean friction power over the cycle; what has no place heats both ends alike."""
    bare = to_and_fro(500)
    fixed, floating = (
        MountedBearing(place=place, element=KnownBearing(torque=torque), load_share=0.0)
        for place, torque in (("fixed", 0.4), ("floating", 0.05))
    )
    held = dataclasses.replace(bare, also={one.name: one for one in (fixed, floating)})
    network = warm_up(held, PLAIN, time=3600.0, outputs=3).network
    turning = 500 * 2 * math.pi / 60
    assert network.bearing_power == pytest.approx(((0.4 + 0.05) * turning, (0.05 + 0.05) * turning), rel=1e-9)
    assert sum(network.bearing_power) == pytest.approx(sum(held.heat[name] for name in held.support_friction))
    ends = warm_up(held, PLAIN, time=3600.0, outputs=3)
    first, last = ends.bearing_temperatures
    assert first[-1] > last[-1]
    assert ends.heat["generated"] == pytest.approx(ends.heat["stored"] + ends.heat["lost"], abs=1e-8 * ends.generated)


def test_the_margin_is_that_of_the_linear_network():
    """By determinants, without an equation for the power: det(K − s ∇Pᵀ) / det K is 1 less the gain of the loop."""
    end = bs.steady_heat(to_and_fro(1000), COOLED)
    network, at = end.network, end.temperatures
    step = 1e-3
    slopes = [
        (network.power(at + step * row) - network.power(at - step * row)) / (2 * step) for row in np.eye(network.size)
    ]
    loop = network.conductances - np.outer(network.source, slopes)
    margin = np.linalg.det(loop) / np.linalg.det(network.conductances)
    assert abs(margin - 1) > 0.01  # so that a gain of the other sign is another margin
    assert end.margin == pytest.approx(margin, rel=1e-4)


def test_the_oil_is_between_nut_and_shaft():
    """The films of a ball are one on each: their mean temperature, and the excess is that of the shaft."""
    network = network_of(to_and_fro(500), PLAIN)
    temperatures = np.full(network.size, 340.0)  # of the shaft
    temperatures[-3] = 300.0  # of the nut
    assert network.of_oil @ temperatures == pytest.approx(320.0, rel=1e-12)
    assert network.of_excess @ temperatures == pytest.approx(40.0, rel=1e-12)


def test_what_lay_in_the_memory_of_the_solver_is_no_warning(monkeypatch):
    """Its table of differences is not filled at first: whatever was there before must not show."""
    plain = warm_up(to_and_fro(500), PLAIN, time=3600.0, outputs=3)
    filled = types.SimpleNamespace(**vars(np))
    signalling = np.uint64(0x7FF4000000000001)  # a NaN that complains of each operation
    filled.empty = lambda shape, dtype=float: np.full(shape, signalling).view(dtype)
    monkeypatch.setattr("scipy.integrate._ivp.bdf.np", filled)
    again = warm_up(to_and_fro(500), PLAIN, time=3600.0, outputs=3)
    assert np.array_equal(plain.states, again.states)
