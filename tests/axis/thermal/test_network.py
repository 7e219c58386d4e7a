"""The network of heat against closed forms and other integrators, with its equations written out here."""

import dataclasses
import itertools
import math
import types

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import ballscrew as bs
from ballscrew.axis.thermal.friction_map import FrictionMap
from ballscrew.axis.thermal.moving_source import Piece, Slot, marched
from ballscrew.axis.thermal.network import CONDUCTIVITY, EXPANSION, Network, Shaft, network_of
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.axis.thermal.warm_up import equilibrium, warm_up

AIR, COOLANT = 295.0, 292.0
FIRST, LAST, LENGTH = 0.3, 0.75, 1.2
POWER = 400.0
#: A hollow shaft whose heat goes everywhere: to the air, to the coolant, to the bearings, and to the nut.
GIVEN = Surroundings(
    ambient=AIR,
    nut_conductance=9.0,
    bearing_conductance=5.0,
    shaft_to_bearing=7.0,
    shaft_share=0.6,
    bore=0.012,
    coolant=COOLANT,
)
BAR = Shaft(length=LENGTH, diameter=0.034, bore=0.012, convection=25.0, bore_convection=200.0)
BALLS, BEARINGS = 12.0, (30.0, 10.0)
CONSTANT = FrictionMap(np.linspace(258.15, 393.15, 5), np.zeros(1), np.full((5, 1), POWER))


def network(cells=60, friction=CONSTANT, given=GIVEN, **changed):
    shaft = dataclasses.replace(BAR, cells=cells)
    stroke = shaft.spread(np.array([(FIRST + LAST) / 2]), np.ones(1), LAST - FIRST)
    return Network(
        shaft,
        given,
        stroke,
        BALLS,
        4.0,
        BEARINGS,
        friction,
        preload_set=0.0,
        approach_set=1.0,
        approach_per_kelvin=0.0,
        ends=(FIRST, LAST),
        **changed,
    )


def exact():
    """Temperatures of nut and bearings, the profile, and the growth: cosh and sinh in each of three parts."""
    to_air, to_coolant = 25.0 * math.pi * 0.034, 200.0 * math.pi * 0.012
    beta, k = to_air + to_coolant, CONDUCTIVITY * math.pi / 4 * (0.034**2 - 0.012**2)
    outside, m = (to_air * AIR + to_coolant * COOLANT) / beta, math.sqrt(beta / k)
    starts, lengths = (0.0, FIRST, LAST), (FIRST, LAST - FIRST, LENGTH - LAST)

    # unknowns: of each part A cosh + B sinh from its start; heat by length in the stroke; first, last, nut over outside
    def row(*entries):
        found = np.zeros(10)
        for place, value in entries:
            found[place] += value
        return found

    def level(part, x, sign=1.0):
        own = [(2 * part, sign * math.cosh(m * x)), (2 * part + 1, sign * math.sinh(m * x))]
        return [*own, (6, sign / beta)] if part == 1 else own

    def slope(part, x, sign=1.0):
        return [(2 * part, sign * k * m * math.sinh(m * x)), (2 * part + 1, sign * k * m * math.cosh(m * x))]

    a, b, c = lengths
    mean = [(2, math.sinh(m * b) / (m * b)), (3, (math.cosh(m * b) - 1) / (m * b)), (6, 1 / beta)]
    to_shaft, given = GIVEN.shaft_to_bearing, 1 - GIVEN.shaft_share
    above = AIR - outside
    equations = [
        (row(*level(0, a), *level(1, 0, -1)), 0.0),
        (row(*slope(0, a), *slope(1, 0, -1)), 0.0),
        (row(*level(1, b), *level(2, 0, -1)), 0.0),
        (row(*slope(1, b), *slope(2, 0, -1)), 0.0),
        (row(*slope(0, 0), (7, to_shaft), *level(0, 0, -to_shaft)), 0.0),
        (row(*slope(2, c, -1), (8, to_shaft), *level(2, c, -to_shaft)), 0.0),
        (row((7, 5.0 + to_shaft), *level(0, 0, -to_shaft)), BEARINGS[0] + 5.0 * above),
        (row((8, 5.0 + to_shaft), *level(2, c, -to_shaft)), BEARINGS[1] + 5.0 * above),
        (row((9, 9.0 + BALLS), *((at, -BALLS * value) for at, value in mean)), given * POWER + 9.0 * above),
        (row((6, b), (9, -BALLS), *((at, BALLS * value) for at, value in mean)), GIVEN.shaft_share * POWER),
    ]
    found = np.linalg.solve(np.array([one for one, _ in equations]), np.array([value for _, value in equations]))

    def profile(places):
        part = np.searchsorted(starts, places, side="right") - 1
        x = places - np.array(starts)[part]
        rise = found[2 * part] * np.cosh(m * x) + found[2 * part + 1] * np.sinh(m * x)
        return outside + rise + np.where(part == 1, found[6] / beta, 0.0)

    # from the balance of the whole shaft: what it takes in, it gives to air and coolant
    taken = found[6] * b + to_shaft * (found[7] - found[0])
    taken += to_shaft * (found[8] - level_at(found[4:6], m * c))
    growth = EXPANSION * (taken / beta + (outside - AIR) * LENGTH)
    return found[[9, 7, 8]] + outside, profile, growth


def level_at(coefficients, z):
    return coefficients[0] * math.cosh(z) + coefficients[1] * math.sinh(z)


def test_a_cooled_bore_at_second_order():
    """The heat goes to a coolant, to the air and through both ends: the error falls with the square of the cells."""
    others, profile, growth = exact()
    errors = []
    for cells in (40, 80, 160):
        end = equilibrium(network(cells))
        assert end.power == pytest.approx(POWER, rel=1e-12)
        rise = profile(end.network.shaft.places)
        errors.append(
            (
                np.sqrt(np.mean((end.temperatures[:-3] - rise) ** 2)) / np.ptp(rise),
                np.max(np.abs(end.temperatures[-3:] - others)) / np.ptp(rise),
                abs(end.growth / growth - 1),
            )
        )
    coarse, middle, fine = np.log2(errors)
    assert np.all(coarse - middle > 1.9)
    assert np.all(middle - fine > 1.9)
    assert np.all(np.array(errors[1]) < (2e-3, 5e-4, 1e-3))


# -- through time ---------------------------------------------------------------------------------------------------

SET_TO, APPROACH, PER_KELVIN = 3000.0, 8e-6, 9e-8
SPEED = 110.0


def friction_of(oil, preload):
    """A friction that falls with the temperature and grows with the root of the preload, W."""
    return 300.0 * np.exp((300.0 - oil) / 45.0) * (0.6 + np.sqrt(preload / SET_TO))


def _mapped():
    temperatures, preloads = np.linspace(258.15, 393.15, 40), SET_TO * np.linspace(0.0, 2.0, 9) ** 2
    return FrictionMap(temperatures, preloads, friction_of(temperatures[:, None], preloads))


@pytest.fixture(scope="module")
def warm():
    """A network of few cells whose friction depends on its own heat."""
    found = network(16, _mapped())
    return dataclasses.replace(found, preload_set=SET_TO, approach_set=APPROACH, approach_per_kelvin=PER_KELVIN)


def held(shaft, nut):
    """Preload: Hertz's law, with the approach that the warmer shaft adds."""
    return SET_TO * max(1 + PER_KELVIN * (shaft - nut) / APPROACH, 0.0) ** 1.5


def rates(state, spread, *, works):
    """The equations of the network, one by one: rates of all temperatures, then heat generated and lost."""
    cells = spread.size
    T, nut, first, last = state[:cells], *state[cells : cells + 3]
    dx, section = LENGTH / cells, math.pi / 4 * (0.034**2 - 0.012**2)
    conduction = 46.0 * section / dx
    to_air = (25.0 if works else 9.0) * math.pi * 0.034 * dx * (T - AIR)
    to_coolant = 200.0 * math.pi * 0.012 * dx * (T - COOLANT)
    through_end = 1 / (1 / 7.0 + dx / 2 / (46.0 * section))
    shaft = float(spread @ T)
    power = friction_of((shaft + nut) / 2, held(shaft, nut)) if works else 0.0
    through_balls = BALLS * (nut - shaft)
    heat = spread * (0.6 * power + through_balls) - to_air - to_coolant
    heat[1:] += conduction * (T[:-1] - T[1:])
    heat[:-1] += conduction * (T[1:] - T[:-1])
    heat[0] += through_end * (first - T[0])
    heat[-1] += through_end * (last - T[-1])
    given = BEARINGS if works else (0.0, 0.0)
    of_nut = 0.4 * power - through_balls - 9.0 * (nut - AIR)
    of_first = given[0] - through_end * (first - T[0]) - 5.0 * (first - AIR)
    of_last = given[1] - through_end * (last - T[-1]) - 5.0 * (last - AIR)
    lost = np.sum(to_air + to_coolant) + 9.0 * (nut - AIR) + 5.0 * (first + last - 2 * AIR)
    steel = 470.0 * np.array([7850.0 * section * dx, 4.0, 3.0])
    return np.array(
        [*heat / steel[0], of_nut / steel[1], of_first / steel[2], of_last / steel[2], power + sum(given), lost]
    )


@pytest.fixture(scope="module")
def by_hand(warm):
    """Work for an hour, then half an hour of rest, by Radau's method: instants by temperatures and heats."""
    spread, size = warm.spread, warm.size
    start = np.concatenate([np.full(size, AIR), [0.0, 0.0]])
    parts, instants = [start[:, None]], (np.linspace(0, 3600.0, 7), np.linspace(0, 1800.0, 4))
    for works, at in zip((True, False), instants, strict=True):
        found = solve_ivp(
            lambda _, y, works=works: rates(y, spread, works=works),
            (0.0, at[-1]),
            parts[-1][:, -1],
            "Radau",
            t_eval=at[1:],
            rtol=1e-9,
            atol=1e-9,
        )
        parts.append(found.y)
    return np.concatenate(parts, axis=1)


def test_a_warm_up_by_another_integrator(warm, by_hand, monkeypatch):
    """Every temperature, the heats, and what follows from them: while it works, and while it stands."""
    monkeypatch.setattr("ballscrew.axis.thermal.warm_up.network_of", lambda *_, **__: warm)
    found = warm_up(
        types.SimpleNamespace(mean_speed=SPEED), GIVEN, time=3600.0, outputs=7, cool_down=1800.0, moving=False
    )
    size = warm.size
    assert found.time == pytest.approx([*np.linspace(0.0, 3600.0, 7), 4200.0, 4800.0, 5400.0])
    assert np.max(np.abs(found.states[:size] - by_hand[:size])) < 1e-3
    assert found.heat["generated"] == pytest.approx(by_hand[size], rel=1e-4)
    assert found.heat["lost"] == pytest.approx(by_hand[size + 1], rel=1e-4, abs=1.0)
    shaft, nut = warm.spread @ by_hand[: size - 3], by_hand[size - 3]
    preload = np.array([held(*one) for one in zip(shaft, nut, strict=True)])
    power = friction_of((shaft + nut) / 2, preload)
    assert found.oil_temperature == pytest.approx((shaft + nut) / 2, abs=1e-3)
    assert found.preload == pytest.approx(preload, rel=1e-4)
    assert found.screw_torque == pytest.approx(power / SPEED, rel=1e-4)
    mean = np.mean(by_hand[: size - 3], axis=0)
    assert found.shaft_growth == pytest.approx(11.7e-6 * LENGTH * (mean - AIR), abs=1e-7)


def test_exact_steps_by_another_integrator(warm, by_hand):
    """Nut and shaft through time in steps of their modes: within half a millikelvin."""
    work, rest = np.linspace(0.0, 3600.0, 7), np.linspace(0.0, 1800.0, 4)
    state = np.full((1, warm.size), AIR)
    generated = lost = 0.0
    for works, instants, there in ((True, work, by_hand[:, 1:7]), (False, rest, by_hand[:, 7:])):
        slot = Slot.of([warm if works else warm.standing], works=works)
        pieces = [Piece(0, float(a), float(b - a), True) for a, b in itertools.pairwise(instants)]
        for one, wanted in zip(list(marched([slot], pieces, state)), there.T, strict=True):
            assert one.temperatures[0] == pytest.approx(wanted[: warm.size], abs=5e-4)
            assert generated + one.generated[0] == pytest.approx(wanted[-2], rel=1e-4)
            assert lost + one.lost[0] == pytest.approx(wanted[-1], rel=1e-4)
        state, generated, lost = one.temperatures, generated + one.generated[0], lost + one.lost[0]


def test_a_screw_without_friction_settles_where_it_is():
    nothing = FrictionMap(np.linspace(258.15, 393.15, 5), np.zeros(1), np.zeros((5, 1)))
    end = equilibrium(dataclasses.replace(network(8, nothing), bearing_power=(0.0, 0.0)))
    assert (end.exists, end.power, end.margin) == (True, 0.0, 1.0)


def test_how_far_a_duty_is_from_a_steady_state():
    """Of a constant friction: what is lost at the hottest oil that is known, less the friction, as a share of it."""
    given = dataclasses.replace(GIVEN, bore=0.0, coolant=None, shaft_share=0.0)
    friction = FrictionMap(np.linspace(258.15, 393.15, 5), np.zeros(1), np.full((5, 1), 4000.0))
    apart = dataclasses.replace(network(8, friction, given), ball_conductance=1e-9, bearing_power=(0.0, 0.0))
    end = equilibrium(apart)
    # the oil is half as warm as the nut, which alone is heated
    taken = 9.0 * 2 * (393.15 - AIR)
    assert not end.exists
    assert end.margin == pytest.approx(taken / 4000.0 - 1, abs=0.04 * taken / 4000.0)  # 400 powers are looked at
    assert math.isnan(end.power)


# -- what it is made of -----------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def made():
    """The network of a double nut that goes to and fro at 100 rad/s over half a metre, and its screw."""
    row = bs.catalogue()["rexroth-40x10x6-6-double"]
    screw = row.screw(nut=bs.DoubleNut(preload=3500.0, spacing=0.012))
    oil, model = bs.Lubricant.from_grade("ISO VG 100", 293.15), bs.FrictionModel.olaru2005()
    duty = bs.to_and_fro(model, screw, oil, axial_load=0.0, screw_speed=100.0, stroke=0.5)
    return network_of(duty, Surroundings(shaft_length=1.2)), screw


def test_sizes_of_a_network_by_hand(made):
    """The root of the grooves as shaft, a nut of 1.6 times the circle and of its turns and two leads, in the middle."""
    found, screw = made
    d_m, ball, alpha = (
        float(getattr(screw, name)) for name in ("pitch_circle_diameter", "ball_diameter", "contact_angle")
    )
    conformity = float(screw.screw_conformity)
    aside, out = ((conformity - 0.5) * ball * f(alpha) for f in (math.sin, math.cos))  # the centre of either circle
    root = d_m + 2 * (out - math.sqrt((conformity * ball) ** 2 - aside**2))
    assert found.shaft.diameter == pytest.approx(root, rel=1e-9)
    length = float(screw.loaded_turns) * 0.01 * 2 + 2 * 0.01
    assert found.nut_mass == pytest.approx(7850 * math.pi / 4 * (1.6**2 - 1) * d_m**2 * length, rel=1e-12)
    assert found.capacity[-3] == pytest.approx(470 * found.nut_mass, rel=1e-12)
    assert found.ends == pytest.approx((0.35, 0.85), abs=1e-12)
    assert found.preload_set == 3500.0
    middle = float(found.spread @ found.shaft.places)
    spread = float(found.spread @ (found.shaft.places - middle) ** 2)
    assert middle == pytest.approx(0.6, rel=1e-9)
    # even over the stroke, and of the nut's length at each place: variances add, and that of a cell of 20 mm
    assert spread == pytest.approx((0.5**2 + length**2) / 12, rel=5e-3)
    # halves apart by their spacing and the turns of one: α_T d sin α / 2 along, and cos α d_m / 2 across
    apart = 0.012 + float(screw.loaded_turns) * 0.01
    assert found.approach_of_unknown_sign == pytest.approx(11.7e-6 * apart * math.sin(alpha) / 2, rel=1e-9)
    assert found.approach_per_kelvin == pytest.approx(11.7e-6 * d_m * math.cos(alpha) / 2, rel=1e-9)


def test_the_air_around_a_shaft_that_turns(made):
    """Nu = 0.133 Re^(2/3) Pr^(1/3) for a shaft that turns in still air, as recalled; at least 9 W/(m² K) at rest."""
    found, _ = made
    reynolds = 100.0 * found.shaft.diameter**2 / 17.0e-6  # with the diameter in place of the radius
    turning = 0.133 * reynolds ** (2 / 3) * 0.706 ** (1 / 3) * 0.0270 / found.shaft.diameter
    assert found.shaft.convection == pytest.approx(max(turning, 9.0), rel=1e-9)
    assert turning > 9.0
    assert found.standing.shaft.convection == 9.0
