"""Exports at loads and speeds down to the least number there is: as a speed that decays to rest passes them."""

import re
import subprocess
import sys

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.exports.programs import interpreter
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.components.operating_state import NOTHING

from .compiled import needs_a_compiler
from .presets import NUTS as RIGID
from .presets import presets_and_nuts
from .test_c99 import compiled, needs_the_library

pytestmark = pytest.mark.slow

NUTS = {
    **RIGID,
    "elastic single": bs.SingleNut(bodies=Bodies()),
    "elastic double": bs.DoubleNut(preload=900.0, bodies=Bodies()),
    "elastic oversize": bs.OversizeBallNut(preload=900.0, bodies=Bodies()),
}
TORQUES = ("screw_torque", "drive_torque", "ideal_torque", "holding_torque", "friction_power")
#: Where the model itself says that a ball is not in balance, rounding decides where its iteration ends.
WITHOUT_BALANCE = 1e-6


def points_near_zero(handed, count, seed=3):
    """Loads and speeds of both signs at all exponents, each also at usual values of the other and at zero."""
    random = np.random.default_rng(seed)
    which = random.random(count)
    load = 10.0 ** random.uniform(-323.3, 4.0, count) * random.choice([-1.0, 1.0], count)
    speed = 10.0 ** random.uniform(-323.3, 2.5, count) * random.choice([-1.0, 1.0], count)
    load = np.where(which < 0.3, random.choice([-3000.0, -100.0, 0.0, 100.0, 3000.0], count), load)
    speed = np.where(which > 0.7, random.choice([-30.0, 0.0, 5.0, 30.0], count), speed)
    usual = {one.name: np.full(count, one.value) for one in handed.inputs}
    return {**usual, "axial_load": load, "screw_speed": speed}


def compare_with_model(handed, found, points):
    """The model called on plain arrays, which no recording and no C has a part in."""
    subject = handed.subject
    operation = {name: points[name] for name in ("axial_load", "screw_speed")}
    model = subject.model(subject.screw, subject.lubricant, **operation)
    holds = np.broadcast_to(model.valid, points["axial_load"].shape)
    assert np.array_equal(found["valid"].astype(bool), holds)
    for name in TORQUES:
        exact = np.broadcast_to(getattr(model, name), holds.shape)
        assert np.all(np.isfinite(exact)), name
        assert np.all(np.isfinite(found[name])), name
        assert np.all(found[name][exact == 0.0] == 0.0), name
        # a difference of two torques is as exact as they are
        size = np.maximum(np.abs(exact), np.abs(model.ideal_torque) if name[0] in "dh" else 0.0)
        off = np.divide(np.abs(found[name] - exact), size, out=np.zeros_like(size), where=size > 0)
        assert np.max(off, where=holds, initial=0.0) <= 1e-12, name
        assert np.max(off) <= WITHOUT_BALANCE, name


@pytest.mark.parametrize(("preset", "nut"), presets_and_nuts(["row", "single", "double", "oversize"]))
def test_recorded_near_zero_is_the_model(handed_over, preset, nut):
    handed = handed_over(getattr(bs.FrictionModel, preset)(), NUTS[nut])
    points = points_near_zero(handed, 2000)
    compare_with_model(handed, handed.evaluate(points), points)


@pytest.mark.parametrize("nut", ["row", "double", "oversize"])
def test_there_is_no_jump_where_a_speed_or_a_load_is_none(handed_over, nut):
    """What is nearer to zero has the limits: the friction of rest, and no friction of no load."""
    subject = handed_over(bs.FrictionModel.reference(), NUTS[nut]).subject
    near, loads = np.array([0.9 * NOTHING, 1.1 * NOTHING]), np.array([800.0, -300.0])[:, None]
    slow = subject.model(subject.screw, subject.lubricant, axial_load=loads, screw_speed=near)
    np.testing.assert_allclose(slow.screw_torque[:, 0], slow.screw_torque[:, 1], rtol=1e-12)
    np.testing.assert_allclose(slow.drive_torque[:, 0], slow.drive_torque[:, 1], rtol=1e-12)
    assert np.array_equal(slow.valid[:, 0], slow.valid[:, 1])
    idle = subject.model(subject.screw, subject.lubricant, axial_load=near, screw_speed=20.0)
    np.testing.assert_allclose(idle.screw_torque[0], idle.screw_torque[1], rtol=1e-12, atol=1e-99)
    assert idle.valid[0] == idle.valid[1]


@needs_a_compiler
@pytest.mark.parametrize(("preset", "nut"), [("reference", "row"), ("olaru2005", "elastic double")])
def test_compiled_near_zero_is_the_model(handed_over, tmp_path, preset, nut):
    handed = handed_over(getattr(bs.FrictionModel, preset)(), NUTS[nut])
    points = points_near_zero(handed, 200 if "elastic" in nut else 4000)
    compare_with_model(handed, compiled(handed, tmp_path)(points), points)


@needs_the_library
@pytest.mark.parametrize(("preset", "nut"), [("reference", "double"), ("olaru2005", "elastic single")])
def test_interpreted_near_zero_is_the_model(handed_over, preset, nut):
    handed = handed_over(getattr(bs.FrictionModel, preset)(), NUTS[nut])
    points = points_near_zero(handed, 200 if "elastic" in nut else 3000)
    compare_with_model(handed, interpreter.Interpreted(interpreter.program_file(handed)).at(points), points)


@needs_the_library
@pytest.mark.long
@pytest.mark.parametrize("nut", NUTS)
def test_every_nut_interpreted_near_zero_is_the_model(handed_over, nut):
    handed = handed_over(bs.FrictionModel.reference(), NUTS[nut])
    points = points_near_zero(handed, 400 if "elastic" in nut else 20_000, seed=4)
    compare_with_model(handed, interpreter.Interpreted(interpreter.program_file(handed)).at(points), points)


@needs_the_library
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_an_fmu_decays_to_rest(handed_over, tmp_path, kind):
    fmpy = pytest.importorskip("fmpy", reason="needs fmpy, of the extra dev")
    handed = handed_over(bs.FrictionModel.reference(), NUTS["row"])
    subject = handed.subject
    path = bs.hand_over(subject.model, subject.screw, subject.lubricant, to="fmu").write(tmp_path)[0]
    time = np.linspace(0.0, 1.0, 648)
    rows = {"axial_load": np.where(time < 0.5, 800.0, 10.0**-300), "screw_speed": 10.0 ** (2.0 - 325.3 * time)}
    signals = np.array(list(zip(time, *rows.values(), strict=True)), dtype=[(n, float) for n in ("time", *rows)])
    names = [*rows, "screw_torque", "ideal_torque", "holding_torque", "friction_power", "drive_torque", "valid"]
    solver = {"solver": "Euler", "step_size": time[1]} if kind == "ModelExchange" else {}
    found = fmpy.simulate_fmu(
        str(path),
        fmi_type=kind,
        input=signals,
        stop_time=1.0,
        output_interval=time[1],
        output=names,
        start_values={"regularisation_speed": 0.0},
        **solver,
    )
    points = {**{one.name: np.full(len(found), one.value) for one in handed.inputs}, **{n: found[n] for n in rows}}
    assert np.min(points["screw_speed"]) < 1e-320
    compare_with_model(handed, {name: found[name] for name in names}, points)


@needs_a_compiler
def test_a_mujoco_plugin_decays_to_rest(tmp_path):
    """In a process of its own: MuJoCo knows each plugin once."""
    pytest.importorskip("mujoco", reason="mujoco is not installed: pip install mujoco-core")
    screw = bs.catalogue()["rexroth-16x5x3-4-double"].screw(nut=NUTS["row"])
    oil = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
    bs.hand_over(bs.FrictionModel.reference(), screw, oil, to="mujoco", load=500.0, plugin="test.rest").write(tmp_path)
    subprocess.run(["make", "-s", f"PYTHON={sys.executable}", "CFLAGS=-O0"], cwd=tmp_path, check=True)
    script = """
import mujoco
mujoco.mj_loadPluginLibrary("./libballscrew.so")
m = mujoco.MjModel.from_xml_path("axis_plugin.xml")
gear = m.actuator_gear[0, 0]
for exponent in range(-323, 3):
    for sign in (-1.0, 1.0):
        d = mujoco.MjData(m)
        d.qvel[0] = sign * float(f"1e{exponent}") / gear
        d.ctrl[0] = 300.0 / gear
        mujoco.mj_forward(m, d)
        d.plugin_state[0] = sign
        mujoco.mj_forward(m, d)
        print(*(float(x).hex() for x in d.sensordata))
"""
    ran = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, check=True)
    sensed = np.array([[float.fromhex(x) for x in line.split()] for line in ran.stdout.splitlines()])
    assert not re.search("nan", ran.stdout)
    assert np.all(sensed[:, 3] == 1.0)
    assert np.all(np.abs(sensed[:, 1]) > 0.0)
