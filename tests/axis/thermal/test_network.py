"""The network of heat against closed forms and other integrators, with its equations written out here."""

import dataclasses
import math

import numpy as np
import pytest

from ballscrew.axis.thermal.equilibrium import equilibrium
from ballscrew.axis.thermal.friction_map import FrictionMap
from ballscrew.axis.thermal.network import Network
from ballscrew.axis.thermal.shaft import CONDUCTIVITY, EXPANSION, Shaft
from ballscrew.axis.thermal.surroundings import Surroundings

AIR, COOLANT = 295.0, 292.0
FIRST, LAST, LENGTH = 0.3, 0.75, 1.2
POWER = 400.0
#: A hollow shaft whose heat goes everywhere: to the air, to the coolant, to the bearings, and to the nut.
GIVEN = Surroundings(
    ambient=AIR, nut_conductance=9.0, bearing_conductance=5.0, shaft_to_bearing=7.0, shaft_share=0.6, bore=0.012,
    coolant=COOLANT,
)  # fmt: skip
BAR = Shaft(length=LENGTH, diameter=0.034, bore=0.012, convection=25.0, bore_convection=200.0)
BALLS, BEARINGS = 12.0, (30.0, 10.0)
CONSTANT = FrictionMap(np.linspace(258.15, 393.15, 5), np.zeros(1), np.full((5, 1), POWER))


def network(cells=60, friction=CONSTANT, given=GIVEN, **changed):
    shaft = dataclasses.replace(BAR, cells=cells)
    stroke = shaft.spread(np.array([(FIRST + LAST) / 2]), np.ones(1), LAST - FIRST)
    return Network(
        shaft, given, stroke, BALLS, 4.0, BEARINGS, friction, preload_set=0.0, approach_set=1.0,
        approach_per_kelvin=0.0, ends=(FIRST, LAST), **changed,
    )  # fmt: skip


def exact():
    """Temperatures of nut and bearings, the profile, and the growth: cosh and sinh in each of three parts."""
    to_air, to_coolant = 25.0 * math.pi * 0.034, 200.0 * math.pi * 0.012
    beta, k = to_air + to_coolant, CONDUCTIVITY * math.pi / 4 * (0.034**2 - 0.012**2)
    outside, m = (to_air * AIR + to_coolant * COOLANT) / beta, math.sqrt(beta / k)
    starts, lengths = (0.0, FIRST, LAST), (FIRST, LAST - FIRST, LENGTH - LAST)

    # unknowns: of each part A cosh + B sinh from its start; heat by length in the stroke; first, last, nut above outside
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
