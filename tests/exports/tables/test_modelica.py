"""The Modelica component simulated by a compiler of the language, and the table of a LossyGear."""

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import ballscrew as bs
from ballscrew.exports.tables.friction_table import FrictionTable, friction_table
from ballscrew.exports.tables.modelica import component, export, loss_table

RANGES = {"axial_load": (-3000.0, 5000.0)}
#: Stands in for the Modelica Standard Library, so that the test needs the compiler only.
LIBRARY = Path(__file__).with_name("Modelica.mo")


@pytest.fixture(scope="module")
def handed(handed_over):
    return handed_over(bs.FrictionModel.olaru2005(), bs.DoubleNut(preload=900.0), to="modelica", ranges=RANGES)


@pytest.fixture(scope="module")
def exported(handed):
    return export(handed)


def _number(text, pattern):
    return float(re.search(pattern, text)[1])


def test_a_compiler_simulates_the_example_as_scipy_does(handed, exported):
    rumoca = pytest.importorskip("rumoca", reason="the Modelica compiler rumoca is not installed")
    text = exported.files["BallScrewFriction.mo"].decode()
    model = rumoca.Session(roots=[str(LIBRARY)]).loads(text, model="BallScrewFriction.Example", filename="a.mo")
    settings = rumoca.SimConfig(solver="bdf", rtol=1e-8, atol=1e-10)
    found = model.simulate(t=(0, 1.2), dt=0.02, config=settings)
    mass, inertia = _number(text, r"Mass mass\(m = (.*?)\)"), _number(text, r"J = (.*?),")
    amplitude, offset = _number(text, r"amplitude = (.*?),"), _number(text, r"offset = (.*?)\)")
    travel, per_load = _number(text, r"travel\(.*?\) = (\S+)"), _number(text, r"torqueOfLoad\(.*?\) = (\S+)")
    table, state = friction_table(handed), {"temperature": np.array([313.15])}

    def slope(t, y):
        def imbalance(acceleration):
            load = mass * (9.81 + travel * acceleration)
            point = {"axial_load": np.array([load]), "screw_speed": np.array([y[1]]), **state}
            friction = table.at(point)["screw_torque"][0] * np.tanh(y[1] / 0.1)
            return inertia * acceleration + per_load * load + friction - offset - amplitude * np.sin(2 * np.pi * t)

        return [y[1], brentq(imbalance, -1e5, 1e5, xtol=1e-9)]

    wanted = solve_ivp(slope, (0, 1.2), [0, 0], t_eval=found.time, method="LSODA", rtol=1e-7, atol=1e-7).y[1]
    speed = np.asarray(found["rotor.w"])
    assert speed.max() > 50.0
    assert speed.min() < -1.0
    assert np.abs(speed - wanted).max() <= 1e-4 * np.abs(speed).max()


def test_the_table_of_the_gear_has_the_error_it_states_by_the_equations_of_the_gear(handed, exported):
    """tau_loss = (1 - eta_mf1) tau_a + tau_bf1 in quadrant 1, (1 - 1/eta_mf2) tau_a - tau_bf2 in quadrant 4."""
    table = friction_table(handed)
    gear = loss_table(table)
    loads, speeds = table.axes["axial_load"], table.axes["screw_speed"]
    worst = 0.0
    for speed, driving, driven, constant_1, constant_2 in gear.rows:
        column = int(np.argmin(np.abs(speeds - speed)))
        load_torque = np.abs(table.values["ideal_torque"][:, column])
        forward = (load_torque + constant_1) / driving - load_torque
        backward = load_torque - (load_torque - constant_2) * driven
        assert backward == pytest.approx(forward, rel=1e-9, abs=1e-12)
        worst = max(worst, np.abs(forward - table.values["screw_torque"][:, column]).max())
    assert loads[0] < 0
    assert worst == pytest.approx(gear.error, rel=1e-6)
    assert f"{gear.error:.3g} N m" in exported.files["LossyGear.txt"].decode()


def test_friction_that_falls_with_the_load_is_met_by_a_constant_half_way():
    axes = {"axial_load": np.linspace(0.0, 1000.0, 11), "screw_speed": np.array([0.0, 100.0])}
    load = np.repeat(axes["axial_load"][:, None], 2, axis=1)
    values = {"screw_torque": 0.5 - 2e-4 * load, "ideal_torque": 1e-3 * load}
    gear = loss_table(FrictionTable(axes, values, np.ones_like(load, dtype=bool), {}, 0.0))
    assert gear.rows[:, 1:3] == pytest.approx(1.0)
    assert gear.rows[:, 3:] == pytest.approx(0.4)
    assert (gear.error, gear.of_largest) == pytest.approx((0.1, 0.2))


@pytest.mark.parametrize(
    ("speeds", "rows", "fitted"),
    [
        ([-100.0, 0.0, 1.0], [0.0, 100.0], (-100.0, 0.0)),
        ([-1.0, 0.0, 100.0], [0.0, 100.0], (0.0, 100.0)),
        ([-100.0, 0.0, 100.0], [0.0, 100.0], (0.0, 100.0)),
        ([-100.0, -50.0, -1.0], [1.0, 50.0, 100.0], (-100.0, -1.0)),
    ],
)
def test_the_gear_has_the_direction_that_reaches_the_higher_speed(speeds, rows, fitted):
    axes = {"axial_load": np.array([0.0, 500.0, 1000.0]), "screw_speed": np.array(speeds)}
    load = np.repeat(axes["axial_load"][:, None], len(speeds), axis=1)
    values = {"screw_torque": 0.2 + 1e-4 * load - 1e-3 * axes["screw_speed"], "ideal_torque": 1e-3 * load}
    gear = loss_table(FrictionTable(axes, values, np.ones_like(load, dtype=bool), {}, 0.0))
    assert gear.rows[:, 0].tolist() == rows
    assert gear.speeds == fitted


def test_the_file_of_the_gear_has_its_speeds(exported):
    assert "Fitted and compared from 0 to 300 rad/s" in exported.files["LossyGear.txt"].decode()


def test_the_example_by_hand(handed, exported):
    """A weight of a tenth of the largest load is held, and swung beyond its friction up to a third of the speeds."""
    text = exported.files["BallScrewFriction.mo"].decode()
    mass, inertia = _number(text, r"Mass mass\(m = (.*?)\)"), _number(text, r"J = (.*?),")
    amplitude, offset = _number(text, r"amplitude = (.*?),"), _number(text, r"offset = (.*?)\)")
    travel = 0.005 / (2 * np.pi)
    assert mass == 50.0  # 500 N, to one digit
    at_load = handed.evaluate({"axial_load": mass * 9.81, "screw_speed": np.linspace(-300.0, 300.0, 601)})
    assert offset == pytest.approx(at_load["ideal_torque"][-1], rel=5e-3)
    friction = at_load["screw_torque"].max()
    swung = np.pi * (inertia + mass * travel**2) * 300.0 / 3
    assert amplitude == pytest.approx(friction + swung, rel=0.02)  # the table is off by up to 1 %
    assert 0.1 * friction < swung < 10 * friction  # so that both count


def test_the_example_swings_beyond_the_friction_at_its_own_load(handed):
    """Of a table whose friction is a hundredth of the load in N m: 490.5 N of 50 kg."""
    axes = {"axial_load": np.array([-3000.0, 0.0, 5000.0]), "screw_speed": np.array([-30.0, 0.0, 60.0])}
    load = np.repeat(axes["axial_load"][:, None], 3, axis=1)
    values = {"screw_torque": 0.01 * np.abs(load), "ideal_torque": 8e-4 * load, "drive_torque": 8e-4 * load}
    text = component(handed, FrictionTable(axes, values, np.ones((3, 3), dtype=bool), {}, 0.0), 0.1, [])
    inertia = _number(text, r"J = (.*?),") + 50.0 * (0.005 / (2 * np.pi)) ** 2
    assert _number(text, r"offset = (.*?)\)") == pytest.approx(50 * 9.81 * 8e-4, rel=5e-3)
    assert _number(text, r"amplitude = (.*?),") == pytest.approx(4.905 + np.pi * inertia * 30.0 / 3, rel=5e-3)


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        ({"ranges": {"temperature": (300.0, 330.0)}}, "hand_over.ranges.temperature: cannot be an axis"),
        ({"ranges": RANGES, "speed_at_rest": 0.0}, "hand_over.speed_at_rest: must be positive"),
    ],
)
def test_faults_name_field_and_remedy(handed_over, asked, expected):
    with pytest.raises(bs.InputError) as fault:
        export(handed_over(bs.FrictionModel.olaru2005(), bs.SingleNut(), to="modelica", **asked))
    assert str(fault.value).startswith(expected)
