"""MuJoCo: the plugin and the joint parameters simulated by MuJoCo itself, against the model in Python."""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.exports import hand_over
from support.commands import ROOT

if importlib.util.find_spec("mujoco") is None:
    pytest.skip("mujoco is not installed: pip install mujoco-core", allow_module_level=True)
COMPILER = shutil.which("cc") and shutil.which("make")
if not COMPILER:
    pytest.skip("no C compiler and make to build the plugin with", allow_module_level=True)

GRAVITY = 9.80665
LOAD, INERTIA = 1000.0, 2e-4
#: How fast the control of the speed is, rad/s, and steps of 1 ms until nothing is left of its start: exp(-40).
QUICKNESS, STEPS = 100.0, 400


def build(folder, optimised="-O0"):
    command = ["make", "-s", f"PYTHON={sys.executable}", f"CFLAGS={optimised} -Wall -Wextra -Werror"]
    built = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr
    assert not built.stderr


@pytest.fixture(scope="session")
def subject():
    row = bs.catalogue()["rexroth-16x5x3-4-double"]
    oil = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
    return bs.FrictionModel.olaru2005(), row.screw(nut=bs.DoubleNut(preload=900.0)), oil


@pytest.fixture(scope="session")
def folder(subject, tmp_path_factory):
    """The export, with its plugin built and loaded: once in a process, as MuJoCo knows each name once."""
    import mujoco

    place = tmp_path_factory.mktemp("mujoco")
    # a name of its own, as another worker of the same process may have loaded one
    bs.hand_over(*subject, to="mujoco", load=LOAD, inertia=INERTIA, plugin="test.small_screw").write(place)
    build(place)
    mujoco.mj_loadPluginLibrary(str(place / "libballscrew.so"))
    return place


@pytest.fixture(scope="session")
def axis(folder):
    return json.loads((folder / "axis.json").read_text())


def steady_friction(m, axis, load, speed):
    """Torque that keeps a speed in the simulation, less that which the load needs."""
    import mujoco

    d, gear = mujoco.MjData(m), axis["gear"]
    swings = m.dof_M0[0] / gear**2
    d.qvel[0] = speed / gear
    d.qfrc_applied[0] = axis["mass"] * GRAVITY - load
    wound = load / gear
    for _ in range(STEPS):
        off = speed - gear * d.qvel[0]
        wound += off * swings * QUICKNESS**2 * m.opt.timestep
        d.ctrl[0] = wound + 2 * swings * QUICKNESS * off
        mujoco.mj_step(m, d)
    assert gear * d.qvel[0] == pytest.approx(speed, rel=1e-9)
    return d.ctrl[0] - load / gear


def of_model(subject, load, speed, oil=None):
    model, screw, usual = subject
    result = model(screw, oil or usual, axial_load=load, screw_speed=speed)
    return float(np.sign(speed) * result.screw_torque)


@pytest.mark.parametrize("load", [-500.0, 1000.0, 3000.0])
def test_the_plugin_is_the_model_under_any_load(folder, axis, subject, load):
    import mujoco

    m = mujoco.MjModel.from_xml_path(str(folder / "axis_plugin.xml"))
    for speed in (5.0, -5.0, 40.0, -40.0, 300.0, -300.0):
        assert steady_friction(m, axis, load, speed) == pytest.approx(of_model(subject, load, speed), rel=1e-6)


def test_the_parameters_are_as_far_off_in_a_simulation_as_the_export_says(folder, axis, subject):
    import mujoco

    m = mujoco.MjModel.from_xml_path(str(folder / "axis_parameters.xml"))
    assert m.dof_armature[0] == pytest.approx(INERTIA * axis["gear"] ** 2)
    for stated in axis["joint_errors"]:
        load, speed = (stated["relative_at"][name] for name in ("axial_load", "screw_speed"))
        off = steady_friction(m, axis, load, speed) / of_model(subject, load, speed) - 1
        assert abs(off) == pytest.approx(stated["relative"], rel=1e-6)
    assert axis["joint_errors"][2]["at"]["axial_load"] == LOAD
    assert axis["joint_errors"][2]["relative"] < 0.02


def test_an_attribute_is_an_input_of_the_model(folder, axis, subject):
    import mujoco

    text = (folder / "axis_plugin.xml").read_text()
    m = mujoco.MjModel.from_xml_string(
        text.replace('key="temperature" value="313.15"', 'key="temperature" value="300"')
    )
    cold = bs.Lubricant.from_grade("ISO VG 100", temperature=300.0)
    expected = of_model(subject, LOAD, 40.0, cold)
    assert expected > 1.05 * of_model(subject, LOAD, 40.0)
    assert steady_friction(m, axis, LOAD, 40.0) == pytest.approx(expected, rel=1e-6)


def test_no_force_is_lost_while_speed_and_load_change(folder, axis, subject):
    """Newton for the mass, with the acceleration of one step before for what turns; friction is that of the model."""
    import mujoco

    m = mujoco.MjModel.from_xml_path(str(folder / "axis_plugin.xml"))
    d, random = mujoco.MjData(m), np.random.default_rng(5)
    before, found = 0.0, []
    for step in range(200):
        d.ctrl[0] = LOAD / axis["gear"] * (1 + 2 * np.cos(0.05 * step)) + 0.01 * random.standard_normal()
        mujoco.mj_forward(m, d)
        load, friction, _, holds = d.sensordata
        accelerating = axis["mass"] * (d.qacc[0] + GRAVITY)
        lag = axis["joint"]["armature"] * (d.qacc[0] - before)
        assert load - lag == pytest.approx(accelerating, rel=1e-9, abs=1e-6)
        assert holds == 1
        speed = axis["gear"] * d.qvel[0]
        if abs(speed) > 5:
            found.append((load, speed, friction))
        before = d.qacc[0]
        mujoco.mj_step(m, d)
        assert d.qacc[0] == pytest.approx(before, rel=1e-9, abs=1e-9)
    model, screw, oil = subject
    loads, speeds, frictions = np.array(found).T
    assert np.min(speeds) < -50
    assert np.max(speeds) > 50
    expected = np.sign(speeds) * model(screw, oil, axial_load=loads, screw_speed=speeds).screw_torque
    np.testing.assert_allclose(frictions, expected, rtol=1e-9)


def test_it_holds_and_does_not_creep_and_slips_beyond(folder, axis, subject):
    import mujoco

    m = mujoco.MjModel.from_xml_path(str(folder / "axis_plugin.xml"))
    most = of_model(subject, LOAD, 1e-9)
    places = {}
    for share in (0.9, 1.1):
        d = mujoco.MjData(m)
        d.ctrl[0] = LOAD / axis["gear"] - share * most
        places[share] = []
        for _ in range(2):
            mujoco.mj_step(m, d, 300)
            places[share].append(d.qpos[0])
    assert abs(places[0.9][1]) < 1e-4
    assert places[0.9][0] == pytest.approx(places[0.9][1], abs=1e-10)
    assert places[1.1][1] < 2 * places[1.1][0] < -2e-4


@pytest.mark.slow
@pytest.mark.parametrize("name", ["axis_plugin.xml", "axis_parameters.xml"])
@pytest.mark.parametrize(
    ("inclination", "counterweight"), [("90 deg", "0 kg"), ("30 deg", "0 kg"), ("-45 deg", "200 kg")]
)
def test_the_carriage_weighs_what_the_axis_of_the_case_does(folder, example, name, inclination, counterweight):
    import mujoco

    changes = ["axis.mass=350 kg", f"axis.inclination={inclination}", f"axis.counterweight={counterweight}"]
    case = case_file.load(example.parent / "vertical_axis.toml", changes)
    made = hand_over.of_case(case, "mujoco", hand_over.Request(options=["plugin=test.small_screw"]))
    # the plugin that is loaded has another screw: its gear is not judged where the actuator is a motor
    text = re.sub(r"(?s)  <(extension|actuator|sensor)>.*?</\1>\n", "", made.files[name].decode())
    m = mujoco.MjModel.from_xml_string(text)
    d = mujoco.MjData(m)
    mujoco.mj_forward(m, d)
    moved, armature = case.axis.mass + case.axis.counterweight, json.loads(made.files["axis.json"])["joint"]["armature"]
    assert m.dof_M0[0] == pytest.approx(moved + armature, rel=1e-9)
    assert d.qfrc_bias[0] - d.qfrc_passive[0] == pytest.approx(case.axis.gravity_force, rel=1e-6)
    direction = (np.cos(case.axis.inclination), 0.0, np.sin(case.axis.inclination))
    np.testing.assert_allclose(d.xaxis[0], direction, atol=1e-12)
    assert f"The axis moves {moved:g} kg at {inclination} above the horizontal" in text


def test_a_copy_goes_on_as_the_original(folder, axis):
    import mujoco

    m = mujoco.MjModel.from_xml_path(str(folder / "axis_plugin.xml"))
    d, other = mujoco.MjData(m), mujoco.MjData(m)
    d.ctrl[0] = 2 * LOAD / axis["gear"]
    mujoco.mj_step(m, d, 20)
    mujoco.mj_copyData(other, m, d)
    mujoco.mj_step(m, d, 20)
    mujoco.mj_step(m, other, 20)
    assert d.qpos[0] == other.qpos[0] > 0
    assert list(d.sensordata) == list(other.sensordata)


def test_older_versions_get_linear_damping(subject):
    import mujoco

    export = bs.hand_over(*subject, to="mujoco", load=LOAD, polynomial=False)
    m = mujoco.MjModel.from_xml_string(export.files["axis_parameters.xml"].decode())
    stated = json.loads(export.files["axis.json"])["joint"]
    assert [m.dof_frictionloss[0], m.dof_damping[0]] == pytest.approx([stated["friction"], *stated["damping"]])
    assert not np.any(m.dof_dampingpoly)


@pytest.mark.parametrize(
    ("what", "instead", "says"),
    [
        (r'gear="[^"]*"', 'gear="100"', "the gear of a slide must be 2 pi / lead"),
        (r'key="inertia" value="[^"]*"', 'key="inertia" value="-1"', "inertia must be a number, 0 or more"),
        (r'key="preload" value="[^"]*"', 'key="preload" value="much"', "an attribute is no number"),
        (r'key="preload"', 'key="preloaded"', "unrecognized attribute"),
    ],
)
def test_what_cannot_be_is_refused(folder, monkeypatch, tmp_path, what, instead, says):
    import mujoco

    monkeypatch.chdir(tmp_path)  # MuJoCo writes its log into the folder
    text, changed = re.subn(what, instead, (folder / "axis_plugin.xml").read_text())
    assert changed == 1
    with pytest.raises(ValueError, match=says):
        mujoco.MjModel.from_xml_string(text)


@pytest.mark.parametrize("name", ["two words", "", ".x"])
def test_a_name_that_mujoco_would_not_find_is_refused(subject, name):
    with pytest.raises(bs.InputError, match=r"hand_over\.plugin: must be words"):
        bs.hand_over(*subject, to="mujoco", load=LOAD, plugin=name)


@pytest.mark.long
def test_the_walk_of_the_page(commands, example, tmp_path):
    """Export, build and script as people run them, with the reference model; the page shows what it prints."""
    done = commands.run(
        ["hand-over", example.parent / "vertical_axis.toml", "--to", "mujoco", "-o", "z"], folder=tmp_path
    )
    assert done.returncode == 0, done.stderr
    build(tmp_path / "z", "-O2")
    ran = subprocess.run(
        [sys.executable, "run.py"], cwd=tmp_path / "z", capture_output=True, text=True, check=True, env={**os.environ}
    )
    shown = ROOT.joinpath("docs/howto/hand_over_robots.md").read_text(encoding="utf-8")
    said = [line for line in ran.stdout.splitlines() if "takes" not in line]
    assert [line for line in said if line not in shown] == []
    assert "worst: plugin < 1e-9" in ran.stdout
