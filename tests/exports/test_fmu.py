"""FMUs: read, checked and run by importers that are not ours, with an empty PATH."""

import ctypes
import re
import zipfile
from urllib.parse import quote
from xml.etree import ElementTree

import numpy as np
import pint
import pytest

import ballscrew as bs
from ballscrew.exports.programs import fmu, interpreter
from ballscrew.exports.programs.interpreter import program_file

from .compiled import library, needs_a_compiler

pytestmark = pytest.mark.skipif(not interpreter.runs_here(), reason="the prebuilt library is for Linux on x86-64")
BOUNDARY = "friction.boundary_friction_coefficient"
POINTS = 201
TORQUES = ("screw_torque", "ideal_torque", "holding_torque", "friction_power")


@pytest.fixture(scope="module")
def handed(handed_over):
    return handed_over(bs.FrictionModel.olaru2005(), bs.DoubleNut(preload=900.0), parameters=[BOUNDARY])


@pytest.fixture(scope="module", params=[2, 3])
def version(request):
    return request.param


@pytest.fixture(scope="module")
def file(handed, version, tmp_path_factory):
    export = bs.hand_over(*parts(handed), to="fmu", parameters=[BOUNDARY], version=version)
    return export.write(tmp_path_factory.mktemp(f"fmi{version}"))[0]


def parts(handed):
    subject = handed.subject
    return subject.model, subject.screw, subject.lubricant


@pytest.fixture
def fmpy():
    return pytest.importorskip("fmpy", reason="needs fmpy, of the extra dev")


def test_fmpy_finds_no_problem(fmpy, file):
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(file)) == []


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_simulated_is_the_model(fmpy, monkeypatch, handed, file, kind):
    monkeypatch.setenv("PATH", "")
    time = np.linspace(0.0, 1.0, POINTS)
    given = {
        "axial_load": 2500.0 * np.sin(7.0 * time),
        "screw_speed": 120.0 * np.cos(13.0 * time),
        "temperature": 290.0 + 50.0 * time,
    }
    signals = np.array(list(zip(time, *given.values(), strict=True)), dtype=[(n, float) for n in ("time", *given)])
    step = 1.0 / (POINTS - 1)
    solver = {"solver": "Euler", "step_size": step} if kind == "ModelExchange" else {}
    wanted_names = [*given, *TORQUES, "drive_torque", "friction_torque", "valid"]
    found = fmpy.simulate_fmu(
        str(file),
        fmi_type=kind,
        input=signals,
        stop_time=1.0,
        output_interval=step,
        output=wanted_names,
        start_values={"preload": 700.0, BOUNDARY: 0.12},
        **solver,
    )
    points = {name: found[name] for name in given}
    wanted = handed.evaluate({**points, "preload": 700.0, BOUNDARY: 0.12})
    assert len(found) == POINTS
    for name in TORQUES:
        np.testing.assert_allclose(found[name], wanted[name], rtol=1e-12, err_msg=name)
    assert np.array_equal(found["valid"], wanted["valid"].astype(float))
    continuous = np.tanh(points["screw_speed"] / fmu.REGULARISATION_SPEED) * wanted["screw_torque"]
    np.testing.assert_allclose(found["friction_torque"], continuous, rtol=1e-12)
    np.testing.assert_allclose(found["drive_torque"], wanted["ideal_torque"] + continuous, rtol=1e-12, atol=1e-12)
    moving = np.abs(points["screw_speed"]) > 20.0 * fmu.REGULARISATION_SPEED
    np.testing.assert_allclose(found["drive_torque"][moving], wanted["drive_torque"][moving], rtol=1e-12, atol=1e-12)


def test_without_regularisation_the_sign_counts(fmpy, handed, file):
    found = {}
    for speed in (-1e-6, 0.0, 1e-6):
        start = {"axial_load": 800.0, "screw_speed": speed, "regularisation_speed": 0.0}
        result = fmpy.simulate_fmu(
            str(file), stop_time=0.01, output=["friction_torque", "screw_torque"], start_values=start
        )
        found[speed] = result["friction_torque"][-1] / result["screw_torque"][-1]
    assert list(found.values()) == [-1.0, 0.0, 1.0]


def test_another_importer_finds_the_same_digits(handed, tmp_path):
    pytest.importorskip("libcosimpy", reason="needs libcosimpy, of the extra dev")
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    path = bs.hand_over(*parts(handed), to="fmu").write(tmp_path)[0]
    execution = CosimExecution.from_step_size(int(1e7))
    slave = execution.add_local_slave(CosimLocalSlave(str(path), "screw"))
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(manipulator)
    execution.add_observer(observer)
    places = {variable.name.decode(): variable.reference for variable in execution.slave_variables(slave)}
    point = {"axial_load": -1500.0, "screw_speed": 60.0, "temperature": 320.0}
    manipulator.slave_real_values(slave, [places[name] for name in point], list(point.values()))
    execution.step()
    execution.step()
    wanted = handed.evaluate(point)
    names = [*TORQUES, "drive_torque", "valid"]
    found = observer.last_real_values(slave, [places[name] for name in names])
    np.testing.assert_allclose(found, [float(wanted[name]) for name in names], rtol=1e-13)


def test_a_third_importer_finds_the_same_digits(handed, file):
    try:
        from ecospy import EcosSimulation, EcosSimulationStructure
        from ecospy.EcosParameterSet import EcosParameterSet
    except (ImportError, OSError) as missing:
        pytest.skip(f"needs ecospy, and libtbb12 on Linux: {missing}")
    point = {"axial_load": -1500.0, "screw_speed": 60.0, "temperature": 320.0}
    structure, start = EcosSimulationStructure(), EcosParameterSet()
    structure.add_model("screw", str(file))
    for name, value in point.items():
        start.add_real(f"screw::{name}", value)
    structure.add_parameter_set("start", start)
    with EcosSimulation(structure=structure, step_size=0.01) as simulation:
        simulation.init(parameter_set="start")
        simulation.step(2)
        found = [simulation.get_real(f"screw::{name}") for name in (*TORQUES, "drive_torque", "valid")]
    wanted = handed.evaluate(point)
    np.testing.assert_allclose(found, [float(wanted[n]) for n in (*TORQUES, "drive_torque", "valid")], rtol=1e-13)


def test_what_is_in_it(file, version):
    with zipfile.ZipFile(file) as archive:
        held = set(archive.namelist())
        description = ElementTree.fromstring(archive.read("modelDescription.xml"))
    source = f"sources/fmi{version}.c"
    assert {"modelDescription.xml", "resources/program.bin", source, "sources/ballscrew_program.c"} <= held
    listed = {variable.get("name"): variable for variable in description.find("ModelVariables")}
    assert listed["axial_load"].get("causality") == "input"
    assert listed["preload"].get("causality") == listed[BOUNDARY].get("causality") == "parameter"
    assert "holds nothing" in listed["regularisation_speed"].get("description")


def test_each_description_begins_with_its_encoding(file):
    """FMI 3.0, FMI description schema: the first line must contain the encoding scheme, which is always UTF-8."""
    with zipfile.ZipFile(file) as archive:
        descriptions = [archive.read(name) for name in archive.namelist() if name.endswith(".xml")]
    assert descriptions
    for content in descriptions:
        first = content.decode("utf-8").splitlines()[0]
        assert re.fullmatch(r"""<\?xml version=(["'])1\.0\1 encoding=(["'])UTF-8\2\?>""", first), first


@pytest.mark.slow
@needs_a_compiler
def test_its_sources_make_its_library(file, version, tmp_path):
    """Those that the description names, and nothing else."""
    with zipfile.ZipFile(file) as archive:
        archive.extractall(tmp_path)
    where = {2: ("modelDescription.xml", "File"), 3: ("sources/buildDescription.xml", "SourceFile")}[version]
    named = [one.get("name") for one in ElementTree.parse(tmp_path / where[0]).iter(where[1])]
    made = library(tmp_path, *(tmp_path / "sources" / name for name in dict.fromkeys(named)))
    assert getattr(made, f"fmi{version}DoStep")


def test_the_same_model_makes_the_same_bytes(handed):
    first, other = (bs.hand_over(*parts(handed), to="fmu").files["ballscrew.fmu"] for _ in range(2))
    assert first == other


def test_the_warning_of_rest_and_the_error_are_stated(handed):
    export = bs.hand_over(*parts(handed), to="fmu")
    assert [record.id for record in export.warnings] == ["hand_over.rest"]
    errors = {one.output: one for one in export.worst_error}
    assert errors["screw_torque"].relative <= 1e-12
    assert errors["valid"].value == 0.0
    assert errors["drive_torque_in_motion"].of_largest <= 1e-12
    near_rest = errors["drive_torque"]
    lacks = 1.0 - np.tanh(abs(near_rest.at["screw_speed"]) / fmu.REGULARISATION_SPEED)
    friction = handed.evaluate(near_rest.at)["screw_torque"]
    assert near_rest.value == pytest.approx(lacks * friction, rel=1e-9)
    assert near_rest.value > 0.1 * errors["screw_torque"].largest


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"version": 1}, "hand_over.version: must be 2 or 3"),
        ({"derivatives": ["preload"]}, "hand_over.derivatives: an FMU has"),
    ],
)
def test_what_it_cannot_be_is_refused(handed, change, expected):
    with pytest.raises(bs.InputError, match=expected):
        bs.hand_over(*parts(handed), to="fmu", **change)


@pytest.mark.parametrize("form", ["{plain}", "file://{quoted}", "file:{quoted}", "file://localhost{quoted}/"])
def test_resources_are_found_by_path_and_by_uri(handed, tmp_path, form):
    folder = tmp_path / "a b%20c" / "resources"
    folder.mkdir(parents=True)
    (folder / "program.bin").write_bytes(program_file(handed))
    prebuilt = interpreter.prebuilt_library()
    prebuilt.fmi2Instantiate.restype = ctypes.c_void_p
    prebuilt.fmi2Instantiate.argtypes = [
        ctypes.c_char_p,
        ctypes.c_int,
        *[ctypes.c_char_p] * 2,
        *[ctypes.c_void_p],
        *[ctypes.c_int] * 2,
    ]
    prebuilt.fmi2FreeInstance.argtypes = [ctypes.c_void_p]

    def instance(place):
        return prebuilt.fmi2Instantiate(b"screw", 1, b"", place.encode(), None, 0, 0)

    found = instance(form.format(plain=folder, quoted=quote(str(folder))))
    assert found
    prebuilt.fmi2FreeInstance(found)
    assert not instance(form.format(plain=tmp_path, quoted=quote(str(tmp_path))))


def test_units_are_what_they_are_in_base_units():
    """By the registry of pint; the table is private, as an FMU has only the units of its variables."""
    registry = pint.UnitRegistry()
    short = {"kilogram": "kg", "meter": "m", "second": "s", "kelvin": "K", "radian": "rad"}
    for name, exponents in fmu._BASE_UNITS.items():
        quantity = registry.Quantity(1.0, name).to_base_units()
        assert quantity.magnitude == 1.0
        assert {short[unit]: power for unit, power in quantity.unit_items()} == exponents, name
