"""Linear guides: the law of makers, statics of a table, and the worked example of a catalogue."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.supports.guide import CarriedMass, GuidedTable
from ballscrew.physics.sizing.checks import mean_load
from support.equations import guide_life

#: PMI2008. Known are the numbers and the results; what each length is, and the stroke of 1500 mm, was found by them:
#: l1 and l2 the spacings, l3 and l4 where the 700 kg are, l6 and l5 how high the 700 kg and the 450 kg are.
PMI = GuidedTable(
    masses=(CarriedMass(mass=700.0, along=0.135, across=0.060, above=0.400), CarriedMass(mass=450.0, above=0.175)),
    carriage_spacing=0.650,
    rail_spacing=0.450,
    gravity=9.8,
)
STROKE, SPEED, START, STOP = 1.5, 0.75, 15.0, 5.0
MEANS, LIVES = (2700.7, 4077.2, 3187.7, 1872.6), (193_500e3, 56_231e3, 117_700e3, 580_400e3)


def mean_loads():
    """Of the four carriages, there and back."""
    starting, stopping = SPEED**2 / 2 / START, SPEED**2 / 2 / STOP
    distances = [starting, STROKE - starting - stopping, stopping]
    there = PMI.loads(np.array([-START, 0.0, STOP])).equivalent
    back = PMI.loads(np.array([START, 0.0, -STOP])).equivalent
    return [mean_load([*to, *fro], [*distances, *distances]) for to, fro in zip(there.T, back.T, strict=True)]


def test_mean_loads_of_the_example():
    np.testing.assert_allclose(mean_loads(), MEANS, atol=0.1)


def test_largest_load_of_the_example():
    accelerations = np.array([-START, -STOP, 0.0, STOP, START])
    equivalent = PMI.loads(accelerations).equivalent
    assert np.unravel_index(np.argmax(equivalent), equivalent.shape) == (0, 1)
    assert np.max(equivalent) == pytest.approx(8611.2, abs=0.1)


def test_lives_of_the_example():
    """One rating over its service factor, 42.4 kN, explains all four lives to four digits."""
    lives = [float(guide_life(42_400.0, mean, 1.0)) for mean in mean_loads()]
    assert [f"{life:.3e}" for life in lives] == [f"{life:.3e}" for life in LIVES]


def test_equilibrium_of_any_table():
    table = GuidedTable(
        masses=(
            CarriedMass(mass=300.0, along=-0.1, across=0.05, above=0.2),
            CarriedMass(mass=80.0, along=0.4, across=-0.3, above=-0.1),
        ),
        carriage_spacing=0.5,
        rail_spacing=0.3,
        inclination=math.radians(25),
    )
    found = table.loads(3.0)
    x = np.array([-1, 1, 1, -1]) * 0.25
    y = np.array([1, 1, -1, -1]) * 0.15
    down, back = table.gravity * math.cos(table.inclination), 3.0 + table.gravity * math.sin(table.inclination)
    of = {
        name: np.array([getattr(each, name) for each in table.masses]) for name in ("mass", "along", "across", "above")
    }
    m = of["mass"]
    assert found.normal.sum() == pytest.approx(np.sum(m) * down)
    assert found.lateral.sum() == pytest.approx(0.0, abs=1e-9)
    assert (found.normal * x).sum() == pytest.approx(np.sum(m * (down * of["along"] - back * of["above"])))
    assert (found.normal * y).sum() == pytest.approx(np.sum(m * down * of["across"]))
    assert (found.lateral * x).sum() == pytest.approx(-np.sum(m * back * of["across"]))


def test_friction_of_carriages():
    guide = bs.LinearGuide(friction_coefficient=0.003, seal_force=2.0)
    loads = PMI.loads(0.0)
    found = guide.under(loads.equivalent, speed=-0.5)
    assert found.friction_effort == pytest.approx(0.003 * 1150 * 9.8 + 8.0)
    assert found.friction_power == pytest.approx(0.5 * found.friction_effort)
    even = guide(bs.OperatingState(np.array([-1150 * 9.8, 0.0]), 0.5))
    np.testing.assert_allclose(even.friction_effort, [found.friction_effort, 8.0])
    np.testing.assert_allclose(sum(even.contributions.values()), even.friction_effort)


def test_a_carriage_that_is_pulled_rubs_too():
    guide = bs.LinearGuide(friction_coefficient=0.003, seal_force=0.0)
    pulled = PMI.loads(40.0)
    assert np.min(pulled.normal) < 0
    assert guide.under(pulled.normal).friction_effort > 0.003 * 1150 * 9.8


def test_faults_name_the_field():
    with pytest.raises(bs.InputError) as raised:
        bs.LinearGuide(friction_coefficient=-0.1, seal_force=2.0, carriages=2.5)
    assert [fault.field for fault in raised.value.faults] == ["guide.friction_coefficient", "guide.carriages"]
