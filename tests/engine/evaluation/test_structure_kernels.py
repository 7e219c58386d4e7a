"""Kernels of structures against the model itself (properties), and what of them is kept for other processes."""

from __future__ import annotations

import dataclasses
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.tracing.program import as_document, can_be_written, from_document
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.structures import (
    OilFollows,
    Structure,
    inputs_of_structure,
    numbers_alone,
    recorded_structure,
)
from ballscrew.physics.equations import hertz
from support.structures import CASES, NUTS, OIL, ROW, assert_same, by_model, case_of, forget_structures, points_of

pytestmark = [pytest.mark.slow, pytest.mark.compiles]
LOADS, SPEEDS = np.array([0.0, 3e3, -3e3, 12e3, 5e3]), np.array([10.0, 0.0, 40.0, -40.0, 5.0])
ELASTIC = {
    "double": bs.DoubleNut(preload=4326.0, bodies=bs.Bodies()),
    "oversize": bs.OversizeBallNut(preload=2000.0, bodies=bs.Bodies()),
}


def kernel_of(subject, outputs=("screw_torque",)):
    structure = Structure(subject, list(outputs))
    found = structure.kernel()
    assert found is not None
    return structure, found


def filled(kernel, wanted, points):
    count = max(np.size(values) for values in points.values())
    numbers = {name: values for name, values in points.items() if np.ndim(values) == 0}
    results = {name: np.empty(count, dtype=output.dtype) for name, output in wanted.items()}
    arrays = {name: values for name, values in points.items() if name not in numbers}
    kernel.fill(kernel.table(numbers), arrays, results)
    return results


@pytest.mark.implausible
@pytest.mark.parametrize(("nut", "model"), CASES)
def test_a_kernel_equals_the_model_at_any_numbers(nut, model):
    subject = case_of(nut, model)
    structure, kernel = kernel_of(subject)
    points = points_of(subject, structure.names, 301)
    expected = by_model(numbers_alone(subject), points, structure.wanted)
    assert_same(filled(kernel, structure.wanted, points), expected)


def test_no_bit_depends_on_which_inputs_are_arrays():
    subject = case_of("double", "reference")
    structure, kernel = kernel_of(subject)
    numbers = {name: float(subject.value_of(name)) for name in structure.names if name not in OPERATION}
    points = {"axial_load": np.linspace(-9e3, 9e3, 37), "screw_speed": np.linspace(-50.0, 50.0, 37)}
    arrays = {name: np.full(37, value) for name, value in numbers.items()}
    some = numbers | {"lead": arrays["lead"], "viscosity": arrays["viscosity"]}
    found = [filled(kernel, structure.wanted, points | others) for others in (numbers, arrays, some)]
    for name, values in found[0].items():
        assert np.array_equal(values, found[1][name], equal_nan=True), name
        assert np.array_equal(values, found[2][name], equal_nan=True), name


@pytest.mark.parametrize("nut", list(ELASTIC))
def test_balls_that_differ_equal_the_model_in_this_process_and_from_disk(nut, monkeypatch):
    screw = dataclasses.replace(bs.catalogue()[ROW].screw(nut=ELASTIC[nut]), loaded_balls=10)
    model = bs.FrictionModel.reference()
    found = []
    for _ in range(2):
        forget_structures(monkeypatch)  # the second time what the first one has kept is read
        found.append(bs.evaluator(model, screw, OIL, outputs=["screw_torque", "efficiency", "valid"])(LOADS, SPEEDS))
    result = model(screw, OIL, axial_load=LOADS, screw_speed=SPEEDS)
    for name, values in found[0].items():
        expected = np.broadcast_to(getattr(result, name), values.shape)
        assert np.array_equal(values, found[1][name], equal_nan=True), name
        np.testing.assert_allclose(values, expected, rtol=1e-12, atol=0.0, equal_nan=True)


@pytest.mark.parametrize("nut", [*NUTS, "elastic"])
def test_an_evaluator_equals_the_model_and_has_nothing_beyond_bounds(nut):
    screw = bs.catalogue()[ROW].screw(nut=ELASTIC["double"] if nut == "elastic" else NUTS[nut])
    model, inputs = bs.FrictionModel.reference(), ["axial_load", "screw_speed", "temperature", "density"]
    ready = bs.evaluator(model, screw, OIL, inputs=inputs, outputs=["screw_torque", "valid"])
    values = 3e3, np.array([40.0, 10.0, np.nan]), np.array([300.0, -1.0, 300.0]), 880.0
    found = ready(*values)
    expected = model(screw, dataclasses.replace(OIL.at(300.0), density=880.0), axial_load=3e3, screw_speed=40.0)
    assert found["screw_torque"][0] == pytest.approx(expected.screw_torque, rel=1e-12)
    assert np.isnan(found["screw_torque"][1:]).all()
    assert found["valid"].tolist() == [bool(expected.valid), False, False]
    for place in range(3):
        one = ready(*(np.broadcast_to(value, 3)[place] for value in values))
        assert np.array_equal(one["screw_torque"], found["screw_torque"][place], equal_nan=True)


def test_derivatives_are_those_of_a_kernel_of_just_one_case(monkeypatch, tmp_path):
    forget_structures(monkeypatch, tmp_path)
    subject = case_of("double", "reference")
    free = ["friction.boundary_friction_coefficient", "nut.preload"]
    given = {"axial_load": xr.DataArray(LOADS, dims="point"), "screw_speed": xr.DataArray(SPEEDS, dims="point")}
    parts = subject.model, subject.screw, subject.lubricant
    expected = bs.derivatives(*parts, outputs=["screw_torque"], by=free, engine="numpy", **given)
    assert Structure(subject, ["screw_torque"], [*given, *free], free).kernel() is not None
    found = bs.derivatives(*parts, outputs=["screw_torque"], by=free, **given)
    assert found.attrs["engine"] == "compiled"
    for name in expected:
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-10, atol=1e-12, equal_nan=True)


#: Asks a screw of a kind for its friction in a process of its own, and counts what it records and compiles.
ASKED = """
import json, sys
import ballscrew as bs
from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.tracing import tape
counts = {"compiled": 0, "recorded": 0}
whole, made = kernel._compile, tape.Tape.__init__
def compiled(*how):
    counts["compiled"] += 1
    return whole(*how)
def recorded(self, inputs, *rest, **more):
    counts["recorded"] += inputs > 20
    return made(self, inputs, *rest, **more)
kernel._compile, tape.Tape.__init__ = compiled, recorded
nut = {"rigid": bs.DoubleNut(preload=float(sys.argv[2])), "row": bs.SingleNut(),
       "elastic": bs.DoubleNut(preload=float(sys.argv[2]), bodies=bs.Bodies())}[sys.argv[1]]
screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=nut)
oil = bs.Lubricant.from_grade("ISO VG 68", 300 + float(sys.argv[2]) / 1e3)
ready = bs.evaluator(bs.FrictionModel.reference(), screw, oil, outputs=["screw_torque"])
print(json.dumps(counts | {"torque": float(ready(3e3, 50.0)["screw_torque"])}))
"""


def asked(kind, preload, cache):
    command = [sys.executable, "-W", "ignore", "-c", ASKED, kind, str(preload)]
    environment = {**os.environ, "BALLSCREW_CACHE": str(cache)}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    return json.loads(done.stdout)


@pytest.mark.parametrize("kind", ["row", "rigid", "elastic"])
def test_another_process_records_nothing_and_compiles_nothing(kind, tmp_path):
    """Whatever its numbers are: the second asks for another preload, of another oil."""
    first = asked(kind, 4000.0, tmp_path)
    assert first["recorded"] > 0
    assert first["compiled"] > 0
    found = asked(kind, 3000.0, tmp_path)
    assert (found["recorded"], found["compiled"]) == (0, 0)
    nut = {"row": bs.SingleNut(), "rigid": bs.DoubleNut(preload=3000.0)}.get(kind)
    nut = bs.DoubleNut(preload=3000.0, bodies=bs.Bodies()) if nut is None else nut
    oil = bs.Lubricant.from_grade("ISO VG 68", 303.0)
    screw = bs.catalogue()[ROW].screw(nut=nut)
    result = bs.FrictionModel.reference()(screw, oil, axial_load=3e3, screw_speed=50.0)
    assert found["torque"] == pytest.approx(float(result.screw_torque), rel=1e-12)


def compiled_count(monkeypatch):
    """What is compiled from now on."""
    found = []
    # counts what is compiled
    whole = kernel._compile
    monkeypatch.setattr(kernel, "_compile", lambda *how: found.append(how) or whole(*how))
    return found


def test_what_is_damaged_is_compiled_again(monkeypatch, tmp_path):
    forget_structures(monkeypatch, tmp_path)
    subject = case_of("single", "olaru2005")
    kernel_of(subject)
    (file,) = (tmp_path / "kernels").iterdir()
    whole = file.read_bytes()
    count = compiled_count(monkeypatch)
    forget_structures(monkeypatch)
    kernel_of(subject)
    assert not count
    for damaged in (whole[:-1], whole[:200] + bytes([whole[200] ^ 1]) + whole[201:], b"", b"{}\n"):
        file.write_bytes(damaged)
        forget_structures(monkeypatch)
        assert Structure(subject, ["screw_torque"]).known() is None
    kernel_of(subject)
    assert len(count) == 1
    assert file.read_bytes() == whole


def test_what_another_source_has_made_is_not_used(monkeypatch, tmp_path):
    forget_structures(monkeypatch, tmp_path)
    subject = case_of("single", "olaru2005")
    kernel_of(subject)
    forget_structures(monkeypatch)
    monkeypatch.setattr(f"{Structure.__module__}.recorder_digest", lambda: "another package")
    assert Structure(subject, ["screw_torque"]).known() is None


def test_what_others_may_write_is_not_used(monkeypatch, tmp_path):
    forget_structures(monkeypatch, tmp_path)
    subject = case_of("single", "olaru2005")
    kernel_of(subject)
    (file,) = (tmp_path / "kernels").iterdir()
    file.chmod(0o666)
    forget_structures(monkeypatch)
    assert Structure(subject, ["screw_torque"]).known() is None


def test_where_a_function_was_replaced_nothing_that_was_kept_counts(monkeypatch):
    subject = case_of("single", "olaru2005")
    structure, _ = kernel_of(subject)
    with monkeypatch.context() as patch:
        patch.setattr(hertz, "equivalent_modulus", lambda *moduli: 2 * moduli[0])
        assert Structure(subject, ["screw_torque"]).name is None
    assert Structure(subject, ["screw_torque"]).name == structure.name


def test_without_a_compiler_there_is_none(monkeypatch):
    monkeypatch.setattr(kernel, "available", lambda: False)
    subject = case_of("single", "olaru2005")
    assert Structure(subject, ["screw_torque"]).ready(10**9) is None
    assert bs.evaluator(subject.model, subject.screw, subject.lubricant).engine == "numpy"


def test_so_many_points_asked_for_one_after_another_are_compiled(monkeypatch, tmp_path):
    forget_structures(monkeypatch, tmp_path)
    subject = case_of("single", "olaru2005")
    engines = []
    for _ in range(6):
        points = {"axial_load": xr.DataArray(np.linspace(1.0, 9e3, 4000), dims="point"), "screw_speed": 30.0}
        engines.append(Evaluation.of(Plan.of(subject, None, points), shared=True).engine)
    assert engines == ["numpy"] * 4 + ["compiled"] * 2


def test_a_fingerprint_tells_numbers_apart_that_one_kernel_serves():
    found = set()
    for preload in (4000.0, 4000.0, 4001.0):
        screw = bs.catalogue()[ROW].screw(nut=bs.DoubleNut(preload=preload))
        subject = Configuration(bs.FrictionModel.olaru2005(), screw, OIL)
        kernel_of(subject)
        evaluation = Evaluation.of(
            Plan.of(subject, ["screw_torque"], {"axial_load": LOADS, "screw_speed": 30.0}), shared=True
        )
        assert evaluation.engine == "compiled"
        found.add(evaluation.fingerprint)
    assert len(found) == 2


def test_a_program_is_read_as_it_was_written():
    subject = case_of("double", "reference")
    structure = Structure(subject, ["screw_torque"])
    program = recorded_structure(numbers_alone(subject), structure.wanted, structure.names)
    assert can_be_written(program)
    again = from_document(json.loads(json.dumps(as_document(program))))
    assert json.dumps(as_document(again)) == json.dumps(as_document(program))
    assert again.nonnegative == program.nonnegative
    with pytest.raises(ValueError, match="popen"):
        from_document({**as_document(program), "steps": [(99, "popen", [("step", 0)], False)]})


def test_an_exponent_that_is_fixed_counts_where_balls_differ():
    screw = dataclasses.replace(bs.catalogue()[ROW].screw(nut=ELASTIC["double"]), loaded_balls=10)
    model = bs.FrictionModel.olaru2005()
    changed = dataclasses.replace(model, film=dataclasses.replace(model.film, speed_exponent=0.6))
    ready = bs.evaluator(model, screw, OIL, outputs=["screw_torque"], **{"film.speed_exponent": 0.6})
    result = changed(screw, OIL, axial_load=3e3, screw_speed=50.0)
    assert ready(3e3, 50.0)["screw_torque"] == pytest.approx(float(result.screw_torque), rel=1e-12)


def test_an_input_that_no_kernel_has_is_refused():
    subject = case_of("single", "reference")
    with pytest.raises(ValueError, match=r"no inputs of the recording: film\.speed_exponent"):
        OilFollows.of(subject, ["temperature", "film.speed_exponent"], inputs_of_structure(subject))


#: A process that keeps a kernel, whose source has changed since it was imported or not.
LONG_RUNNING = """
import sys
import time
from pathlib import Path
from pathlib import Path
import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.engine.evaluation import fingerprint
model = bs.FrictionModel.olaru2005()
file = Path(bs.__file__).with_name("physics") / "friction" / "model.py"
assert sys.argv[1] in str(file)
if sys.argv[2] == "changed":
    file.write_text(file.read_text() + "# another source")
f = bs.evaluator(model, SCREW, OIL, outputs=["screw_torque"])
print(f.engine_reason, float(f(1e3, 10.0)["screw_torque"]))
"""


def test_a_process_whose_source_has_changed_keeps_nothing(tmp_path):
    """What it computes is what it imported, whatever its files say now; it is no slower."""
    shutil.copytree(Path(bs.__file__).parent, tmp_path / "ballscrew", ignore=shutil.ignore_patterns("__pycache__"))
    time.sleep(0.1)
    said = {}
    for how in ("changed", "same"):
        cache = tmp_path / how
        environment = {**os.environ, "PYTHONPATH": str(tmp_path), "BALLSCREW_CACHE": str(cache)}
        command = [sys.executable, "-c", LONG_RUNNING, str(tmp_path), how]
        said[how] = subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout
        kept = list((cache / "kernels").iterdir()) if (cache / "kernels").exists() else []
        assert bool(kept) == (how == "same"), kept
    assert said["changed"] == said["same"]
    assert "is there" in said["same"]
