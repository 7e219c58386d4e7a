"""Every target, of cases that are no example of a page, read back and held against the model called on plain arrays."""

import csv
import ctypes
import io
import json
import re
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator
from scipy.io import loadmat

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.exports import hand_over
from ballscrew.exports.export import TARGETS
from ballscrew.exports.programs import interpreter

from .compiled import evaluated, library, names, needs_a_compiler

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not interpreter.runs_here(), reason="the prebuilt library is for Linux on x86-64"),
]
#: Cases by name: an example, and what is changed in it.
CASES = {
    "single": ("feed_drive.toml", ["operation.axial_load=3 kN", "lubricant.temperature=31 degC"]),
    "calibrated": ("feed_drive.toml", ["model.calibration=rexroth-2006", "screw.lead=12 mm"]),
    "axis": ("vertical_axis.toml", ["axis.mass=350 kg", "axis.inclination=40 deg", "nut.preload=3 %"]),
    "offset": ("feed_drive.toml", ["nut.type=offset-lead", "nut.preload=2 kN", "screw.loaded_balls=60"]),
    "oversize": ("feed_drive.toml", ["nut.type=oversize-balls", "nut.preload=2 kN"]),
    "elastic": ("catalogue_screw.toml", ["nut.preload=4 kN", "operation.axial_load=-5 kN"]),
    "deviations": ("catalogue_screw.toml", ["nut.preload=4 kN", "deviations.ball_diameter=0.3 um"]),
}
MODELS = ("olaru2005", "corrected", "reference")
#: Cases and models of the short tests; the others are long.
SHORT = [("calibrated", "reference"), ("axis", "corrected"), ("offset", "olaru2005")]
ALL = [
    (case, model)
    for case in CASES
    for model in MODELS
    if model == "reference" or case not in ("oversize", "deviations")
]


def of_cases(cases):
    """A test of each of these cases with its model."""
    found = [pytest.param(*one, marks=() if one in SHORT else pytest.mark.long) for one in cases]
    return pytest.mark.parametrize(("name", "model"), found)


every = of_cases(ALL)
#: Balls that deviate are solved in Python, in no formula.
every_of_formulas = of_cases([one for one in ALL if one[0] != "deviations"])
FORMULAS = ("c", "program", "fmu", "mujoco")
LARGEST_LOAD, LARGEST_SPEED = 8e3, 150.0
RANGES = [f"axial_load=-{LARGEST_LOAD}:{LARGEST_LOAD} N", f"screw_speed=-{LARGEST_SPEED}:{LARGEST_SPEED} rad/s"]
ROUNDING = 1e-12


@pytest.fixture
def case_of(example):
    def case(name, model):
        file, changes = CASES[name]
        if model != "reference":  # a calibration and a scatter are of the reference model
            changes = [one for one in changes if not one.startswith("model.")]
        return case_file.load(example.parent / file, [*changes, f"model.name={model}"])

    return case


def of_model(case, load, speed, temperature=None):
    """The model called on plain arrays: no recording, no C and no table has a part in it."""
    oil = case.lubricant if temperature is None else case.lubricant.at(temperature)
    return case.model(case.screw, oil, axial_load=load, screw_speed=speed)


def points_of(count, seed):
    random = np.random.default_rng(seed)
    load = random.uniform(-LARGEST_LOAD, LARGEST_LOAD, count)
    speed = random.uniform(-LARGEST_SPEED, LARGEST_SPEED, count) * 10.0 ** random.uniform(-3, 0, count)
    load[::17], speed[::23] = 0.0, 0.0
    return load, speed


def exported(case, to, options=()):
    bounded = to not in FORMULAS
    return hand_over.of_case(case, to, hand_over.Request(ranges=RANGES if bounded else (), options=options))


def compare(found, case, load, speed, temperature=None):
    model = of_model(case, load, speed, temperature)
    assert np.array_equal(np.asarray(found["valid"]).astype(bool), np.broadcast_to(model.valid, load.shape))
    for name in ("screw_torque", "ideal_torque", "drive_torque", "holding_torque", "friction_power"):
        exact = np.broadcast_to(getattr(model, name), load.shape)
        assert np.array_equal(np.isnan(exact), np.isnan(found[name])), name
        size = np.abs(model.screw_torque) * (np.abs(speed) if name == "friction_power" else 1.0)
        size = size + (np.abs(model.ideal_torque) if name != "friction_power" else 0.0)
        off = np.abs(found[name] - exact)
        assert np.all((off <= ROUNDING * size) | np.isnan(exact)), name


# -- targets that are the model -----------------------------------------------------------------------


@pytest.mark.parametrize("to", FORMULAS)
def test_balls_that_deviate_are_in_no_formula(case_of, to):
    options = ["mass=10 kg"] if to == "mujoco" else ()
    with pytest.raises(bs.InputError, match="balls or a lead that deviate are solved in Python only · take a table"):
        exported(case_of("deviations", "reference"), to, options)


@needs_a_compiler
@every_of_formulas
def test_the_source_is_the_model(case_of, tmp_path, name, model):
    case = case_of(name, model)
    exported(case, "c").write(tmp_path)
    made = library(tmp_path, tmp_path / "ballscrew.c")
    inputs, outputs = (names(made, f"ballscrew_{kind}") for kind in ("inputs", "outputs"))
    load, speed = points_of(60 if name == "elastic" else 1000, 11)
    temperature = np.random.default_rng(12).uniform(285.0, 350.0, load.size)
    usual = dict(zip(inputs, (ctypes.c_double * len(inputs)).in_dll(made, "ballscrew_usual"), strict=True))
    usual |= {"axial_load": load, "screw_speed": speed, "temperature": temperature}
    points = np.stack([np.broadcast_to(usual[one], load.shape) for one in inputs], axis=-1)
    found = dict(zip(outputs, evaluated(made.ballscrew_evaluate, points, len(outputs)).T, strict=True))
    compare(found, case, load, speed, temperature)


@every_of_formulas
def test_the_program_and_the_fmu_are_the_model(case_of, name, model):
    case = case_of(name, model)
    content = exported(case, "program").files["program.bin"]
    with zipfile.ZipFile(io.BytesIO(exported(case, "fmu").files["ballscrew.fmu"])) as archive:
        assert archive.read("resources/program.bin") == content
        assert archive.read("binaries/linux64/ballscrew.so") == interpreter.data(interpreter.LINUX64)
        listed = ElementTree.fromstring(archive.read("modelDescription.xml")).find("ModelVariables")
    start = {one.get("name"): one.find("Real").get("start") for one in listed if one.find("Real").get("start")}
    load, speed = points_of(60 if name == "elastic" else 1000, 13)
    temperature = np.random.default_rng(14).uniform(285.0, 350.0, load.size)
    run = interpreter.Interpreted(content)
    points = {one: np.full(load.size, float(start[one])) for one in run.inputs}
    points |= {"axial_load": load, "screw_speed": speed, "temperature": temperature}
    compare(run.at(points), case, load, speed, temperature)


# -- tables -------------------------------------------------------------------------------------------


def table_of(case):
    made = exported(case, "table", ["kinds=csv,json,nc"])
    return made, json.loads(made.files["friction.json"])


@every
def test_the_tables_are_the_model(case_of, name, model):
    case = case_of(name, model)
    made, read = table_of(case)
    axes = [np.array(read["axes"][one]["values"]) for one in ("axial_load", "screw_speed")]
    values = {one: np.array(held["values"]) for one, held in read["outputs"].items()}
    load, speed = (each.ravel() for each in np.meshgrid(*axes, indexing="ij"))
    exact = of_model(case, load, speed)
    for one in ("screw_torque", "ideal_torque", "drive_torque"):
        np.testing.assert_allclose(values[one].ravel(), getattr(exact, one), rtol=1e-9, atol=1e-12, err_msg=one)
    # between the nodes: as far off as it says, at points that it does not know
    stated = {one.output: one for one in made.worst_error}
    load, speed = points_of(60 if name in ("elastic", "deviations") else 2000, 15)
    between = RegularGridInterpolator(axes, values["screw_torque"])(np.column_stack([load, speed]))
    off = np.abs(between - of_model(case, load, speed).screw_torque)
    assert off.max() <= max(1.5 * stated["screw_torque"].value, 1e-12)
    rows = np.array(list(csv.reader(io.StringIO(made.files["friction.csv"].decode())))[1:], dtype=float)
    assert rows[:, 2] == pytest.approx(values["screw_torque"].ravel(), rel=1e-15)
    of_matlab = loadmat(io.BytesIO(exported(case, "matlab").files["ballscrew_friction.mat"]), simplify_cells=True)
    load, speed = np.meshgrid(of_matlab["axial_load"].ravel(), of_matlab["screw_speed"].ravel(), indexing="ij")
    exact = of_model(case, load.ravel(), speed.ravel()).screw_torque.reshape(load.shape)
    np.testing.assert_allclose(of_matlab["screw_torque"], exact, rtol=1e-9, atol=1e-12)


# -- curves of one load -------------------------------------------------------------------------------


def curves_of(case):
    """Speeds of the screw, rad/s, and friction, N m, of each control, as it reads them."""
    lead, found = case.screw.lead, {}
    rows = np.array(list(csv.reader(io.StringIO(exported(case, "drive").files["friction_curve.csv"].decode())))[1:])
    found["drive"] = rows[:, 0].astype(float), rows[:, 2].astype(float), 0.0
    held = dict(re.findall(r"setp \S+\.(\w-val-\d+) (\S+)", exported(case, "linuxcnc").files["ballscrew.hal"].decode()))
    x, y = (np.array([float(v) for k, v in sorted(held.items()) if k[0] == one]) for one in "xy")
    ahead = x > 0
    found["linuxcnc"] = 1e-3 * 2 * np.pi / lead * x[ahead], y[ahead], 0.0
    text = exported(case, "beckhoff").files["friction_comp.lis"].decode()
    held = dict(re.findall(r"frict_comp\.(\S+) +(-?\d+)", text))
    count = int(held["table_entries"])
    x, y = (np.array([float(held[f"table[{k}].{one}"]) for k in range(1, count)]) for one in ("in", "out"))
    found["beckhoff"] = 1e-6 * 2 * np.pi / lead * x, 1e-3 * y, 1e-3
    return found


@every
def test_the_curves_are_the_friction_at_the_load_of_the_case(case_of, name, model):
    case = case_of(name, model)
    load = float(case.operation.axial_load)
    for control, (speeds, torques, step) in curves_of(case).items():
        assert np.all(np.diff(speeds) > 0), control
        both = [of_model(case, np.full(speeds.size, load), sign * speeds).screw_torque for sign in (1.0, -1.0)]
        exact = np.maximum(*both)
        assert np.max(np.abs(torques - exact)) <= 1e-4 * np.max(exact) + step, control


# -- joints -------------------------------------------------------------------------------------------


@every
def test_the_joints_have_the_error_that_they_state(case_of, name, model):
    case = case_of(name, model)
    load = float(case.operation.axial_load)
    gear = 2 * np.pi / case.screw.lead
    made = (
        {"urdf": exported(case, "urdf")}
        if name == "deviations"
        else {to: exported(case, to) for to in ("mujoco", "urdf")}
    )
    for to, export in made.items():
        axis = json.loads(export.files["axis.json"])
        assert axis["gear"] == pytest.approx(gear, rel=1e-12)
        if case.axis is None:
            assert axis["mass"] == pytest.approx(abs(load) / 9.80665)
            assert "hand_over.mass" in [one.id for one in export.warnings]
        else:
            assert axis["mass"] == case.axis.mass
            assert axis["gravity_force"] == pytest.approx(case.axis.gravity_force)
        if to == "urdf":
            joint = ElementTree.fromstring(export.files["axis.urdf"]).find("joint/dynamics")
            dry, damping = float(joint.get("friction")), [float(joint.get("damping"))]
        else:
            joint = ElementTree.fromstring(export.files["axis_parameters.xml"]).find("worldbody/body/joint")
            dry, damping = float(joint.get("frictionloss")), [float(one) for one in joint.get("damping").split()]
        low, high = axis["speeds"]
        speeds = np.geomspace(low, high, 40 if name in ("elastic", "deviations") else 300)
        slide = speeds / gear
        torque = (dry + sum(one * slide ** (k + 1) for k, one in enumerate(damping))) / gear
        stated = axis["joint_errors"][2]
        exact = of_model(case, np.full(speeds.size, load), speeds).screw_torque
        off = np.abs(torque / exact - 1.0)
        assert off.max() <= 1.02 * stated["relative"] + 1e-9, to
        at = stated["relative_at"]["screw_speed"]
        there = of_model(case, load, at).screw_torque
        torque_there = (dry + sum(one * (abs(at) / gear) ** (k + 1) for k, one in enumerate(damping))) / gear
        assert abs(torque_there / there - 1.0) == pytest.approx(stated["relative"], rel=1e-6), to


# -- Modelica -----------------------------------------------------------------------------------------


@every
def test_the_table_in_modelica_is_the_model(case_of, name, model):
    case = case_of(name, model)
    text = exported(case, "modelica").files["BallScrewFriction.mo"].decode()
    held = dict(re.findall(r"constant Real (\w)\[[^]]*\] = (.*?);", text, flags=re.DOTALL))
    loads, speeds, torques, valid = (
        np.array(json.loads(re.sub(r"{|}", lambda b: "[]"["{}".index(b[0])], held[n]))) for n in "FWMV"
    )
    load, speed = np.meshgrid(loads, speeds, indexing="ij")
    exact = of_model(case, load.ravel(), speed.ravel())
    np.testing.assert_allclose(torques.ravel(), exact.screw_torque, rtol=1e-9, atol=1e-12)
    assert np.array_equal(valid.ravel().astype(bool), exact.valid)
    per_load = float(re.search(r"torqueOfLoad\(.*?\) = (\S+)", text)[1])
    np.testing.assert_allclose(per_load * load.ravel(), exact.ideal_torque, rtol=1e-9, atol=1e-12)
    assert float(re.search(r"travel\(.*?\) = (\S+)", text)[1]) == pytest.approx(case.screw.lead / (2 * np.pi))


def test_all_targets_are_read_back():
    assert set(TARGETS) == {*FORMULAS, "table", "matlab", "modelica", "drive", "linuxcnc", "beckhoff", "urdf"}
