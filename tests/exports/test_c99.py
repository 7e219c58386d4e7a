"""The C source against the model in Python: every operation, presets, laws, nuts, and what is beyond the range."""

import dataclasses
import hashlib
import json
import subprocess
from importlib import resources

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Step
from ballscrew.exports.export import Export, target
from ballscrew.exports.programs import c99, c_source, interpreter
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.friction.validity import NUT_REASONS
from ballscrew.physics.solvers.line_slip import TOLERANCE, line_slip

from .compiled import COMPILER, STRICT, evaluated, library, names, needs_a_compiler
from .presets import NUTS

#: Largest relative difference between C and NumPy: both round each of thousands of steps.
ROUNDING = 1e-12
needs_the_library = pytest.mark.skipif(
    not interpreter.runs_here(), reason="the prebuilt library is for Linux on x86-64"
)


def compare(found, wanted, rounding=ROUNDING):
    """All numbers to rounding, truths exactly."""
    for name, values in wanted.items():
        exact = values.astype(float)
        assert np.all(np.isfinite(exact)), name
        if name == "valid":
            assert np.array_equal(found[name], exact)
        else:
            size = np.maximum(np.abs(exact), 1e-9 * np.max(np.abs(exact)))
            assert np.max(np.abs(found[name] - exact) / size, initial=0.0) <= rounding, name


def compiled(handed, folder):
    """The model compiled, as a function of points by name."""
    (folder / "ballscrew.c").write_text(c99.source(handed))
    (folder / "ballscrew.h").write_text(c99.header(handed))
    made = library(folder, folder / "ballscrew.c")
    assert names(made, "ballscrew_inputs") == list(handed.input_names)
    assert names(made, "ballscrew_outputs") == list(handed.output_names)

    def at(points):
        given = np.stack([points[name] for name in handed.input_names], axis=-1)
        found = evaluated(made.ballscrew_evaluate, given, len(handed.output_names))
        return dict(zip(handed.output_names, found.T, strict=True))

    return at


# -- operations ---------------------------------------------------------------------------------------

VALUES = (-np.inf, -2.5, -1.0, -0.3, -0.0, 0.0, 0.3, 1.0, 2.0, 7.1, np.inf, np.nan)
POINTS = np.array([(a, b) for a in VALUES for b in VALUES])


def program_of_all_operations():
    """A program with an output for each operation that C has, of two inputs."""
    steps, outputs = [], {}

    def add(step):
        steps.append((2 + len(steps), step))
        return 1 + len(steps)

    a, b = ("step", 0), ("step", 1)
    below, above = (("step", add(Step(f, (a, b), True))) for f in (np.less, np.greater_equal))
    for function in interpreter.OPERATIONS:
        name = function.__name__
        if name == "choose":
            operands = (below, a, b)
        elif name.startswith(("bitwise", "logical_and", "logical_or", "logical_xor")):
            operands = (below, above)
        elif function in (np.invert, np.logical_not):
            operands = (below,)
        else:
            operands = (a, b)[: function.nin]
        is_mask = name != "choose" and function(*[True if o in (below, above) else 0.5 for o in operands]).dtype == bool
        outputs[name] = add(Step(function, operands, bool(is_mask)))
    outputs["valid"] = above[1]
    return Program(2, tuple(steps), outputs, {"constant": -1.5, "none": np.nan, "endless": -np.inf})


def by_numpy(program):
    masks = {i for i, step in program.steps if step.is_mask}
    found = {n: np.empty(len(POINTS), bool if i in masks else float) for n, i in program.outputs.items()}
    found |= {n: np.empty(len(POINTS)) for n in program.constants}
    with np.errstate(all="ignore"):
        program.interpreter.run(list(POINTS.T.copy()), found)
    return found


def test_every_operation_of_the_interpreter_is_one_of_c():
    known = {*c_source.INFIX, *c_source.CALLS, *c_source.TESTS, *c_source.EXTREMES}
    others = {"choose", "invert", "logical_not", "remainder"}
    assert {f for f in interpreter.OPERATIONS if f.__name__ not in others} == known


@needs_a_compiler
def test_operations_compiled(tmp_path):
    program = program_of_all_operations()
    made = c_source.functions(program)
    results = "".join(f"    outputs[{k}] = {text};\n" for k, text in enumerate(made.results.values()))
    body = f"double v[{made.room}];\n{''.join(made.calls)}\n{results}"
    source = tmp_path / "operations.c"
    head = "#include <math.h>\nvoid evaluate(const double *x, double *outputs);\n"
    source.write_text(
        "\n".join(
            [
                head,
                *c_source.own_functions(made.texts),
                *made.texts,
                f"void evaluate(const double *x, double *outputs)\n{{\n{body}}}\n",
            ]
        )
    )
    found = evaluated(library(tmp_path, source).evaluate, POINTS, len(made.results))
    for (name, values), column in zip(_in_order(by_numpy(program), made.results).items(), found.T, strict=True):
        np.testing.assert_allclose(column, values.astype(float), rtol=1e-15, atol=1e-300, err_msg=name)


def _in_order(values, order):
    return {name: values[name] for name in order}


@needs_the_library
def test_operations_interpreted():
    program = program_of_all_operations()
    outputs = [name for name in [*program.outputs, *program.constants] if name != "valid"] + ["valid"]
    ranges = dict.fromkeys("ab", (0.0, -np.inf, np.inf))
    run = interpreter.Interpreted(interpreter.file_of(program, ranges, outputs))
    found = run.at(dict(zip("ab", POINTS.T, strict=True)))
    wanted = by_numpy(program)
    wanted["valid"] &= ~np.isnan(POINTS).any(axis=1)
    for name in outputs:
        np.testing.assert_allclose(found[name], wanted[name].astype(float), rtol=1e-15, atol=1e-300, err_msg=name)


def test_an_operation_that_c_lacks_is_refused():
    program = Program(1, ((1, Step(np.exp2, (("step", 0),), False)),), {"valid": 1}, {})
    with pytest.raises(bs.InputError, match="C has no exp2 · write the law"):
        c_source.functions(program)
    with pytest.raises(bs.InputError, match="the interpreter has no exp2"):
        interpreter.file_of(program, {"a": (0.0, 0.0, 1.0)}, ["valid"])


def test_a_program_of_more_places_than_two_bytes_name_is_refused():
    constants = {f"c{i}": float(i) for i in range(2**16)}

    def of(count):
        outputs = list(constants)[: count - 1]  # and one input
        return interpreter.file_of(
            Program(1, (), {}, {name: constants[name] for name in outputs}), {"a": (0.0, 0.0, 1.0)}, outputs
        )

    assert len(of(2**16)) > 8 * 2**16
    with pytest.raises(bs.InputError, match="too large for the interpreter"):
        of(2**16 + 1)


@needs_the_library
@pytest.mark.parametrize(
    "damage", [lambda b: b[:-2], lambda b: b"X" + b[1:], lambda b: b[:-10] + b"\xff" * 10, lambda b: b""]
)
def test_a_damaged_program_is_refused(damage):
    program = Program(1, ((1, Step(np.exp, (("step", 0),), False)),), {"valid": 1}, {})
    whole = interpreter.file_of(program, {"a": (0.0, 0.0, 1.0)}, ["valid"])
    assert interpreter.Interpreted(whole).outputs == ["valid"]
    with pytest.raises(ValueError, match="damaged"):
        interpreter.Interpreted(damage(whole))


# -- models -------------------------------------------------------------------------------------------


@needs_a_compiler
@pytest.mark.parametrize(("preset", "nut"), [("olaru2005", "row"), ("olaru2005", "double"), ("corrected", "single")])
def test_compiled_is_the_model(handed_over, tmp_path, preset, nut):
    handed = handed_over(getattr(bs.FrictionModel, preset)(), NUTS[nut])
    points = handed.sample(10_000)
    compare(compiled(handed, tmp_path)(points), handed.evaluate(points))


@needs_the_library
@pytest.mark.parametrize("slot", LAWS)
def test_every_law_interpreted_is_the_model(handed_over, slot):
    for name, law in LAWS[slot].items():
        law = law() if isinstance(law, type) and dataclasses.is_dataclass(law) else law
        preset = bs.FrictionModel.corrected()
        model = dataclasses.replace(preset, **{slot: law})
        handed = handed_over(model, NUTS["row"])
        points = handed.sample(300)
        found = interpreter.Interpreted(interpreter.program_file(handed)).at(points)
        wanted = handed.evaluate(points)
        finite = {n: np.isfinite(values.astype(float)) for n, values in wanted.items()}
        for n, where in finite.items():
            assert np.array_equal(np.isfinite(found[n]), where), (name, n)
        # its iteration takes another way where rounding differs, and ends at this residual, as within Python
        rounding = TOLERANCE if law is line_slip else ROUNDING
        compare(*({n: v[finite[n]] for n, v in values.items()} for values in (found, wanted)), rounding)


@needs_the_library
def test_at_rest_and_without_load_there_are_numbers(handed_over):
    handed = handed_over(bs.FrictionModel.olaru2005(), NUTS["double"])
    at = interpreter.Interpreted(interpreter.program_file(handed)).at
    points = {"axial_load": [0.0, 0.0, 500.0, -500.0], "screw_speed": [0.0, 20.0, 0.0, 0.0]}
    points = {n: np.array(v) for n, v in points.items()} | {
        "temperature": np.full(4, 313.15),
        "preload": np.full(4, 900.0),
    }
    found = at(points)
    assert all(np.all(np.isfinite(values)) for values in found.values())
    np.testing.assert_allclose(found["drive_torque"][[0, 2, 3]], found["ideal_torque"][[0, 2, 3]], rtol=1e-15)
    assert found["drive_torque"][1] == found["screw_torque"][1] > 0.0


@needs_the_library
def test_beyond_the_range_the_nearest_value_counts(handed_over):
    handed = handed_over(
        bs.FrictionModel.olaru2005(),
        NUTS["double"],
        ranges={"axial_load": (-2000.0, 2000.0)},
        derivatives=["screw_speed"],
    )
    at = interpreter.Interpreted(interpreter.program_file(handed)).at
    names = handed.input_names
    inside = dict(zip(names, np.array([[2000.0, 30.0, 313.15, 900.0]]).T, strict=True))
    for change in ({"axial_load": 5000.0}, {"axial_load": np.nan}):
        beyond = at({**inside, **{n: np.array([v]) for n, v in change.items()}})
        assert beyond["valid"] == 0.0
        same = beyond["screw_torque"] == at(inside)["screw_torque"]
        assert same or np.isnan(change["axial_load"])
    assert at(inside)["valid"] == 1.0


@needs_the_library
def test_derivatives_are_the_slope(handed_over):
    handed = handed_over(bs.FrictionModel.corrected(), NUTS["row"], derivatives=["screw_speed"])
    at = interpreter.Interpreted(interpreter.program_file(handed)).at
    step = 1e-3
    speeds = np.array([40.0 - step, 40.0, 40.0 + step])
    found = at({"axial_load": np.full(3, 900.0), "screw_speed": speeds, "temperature": np.full(3, 313.15)})
    slope = (found["screw_torque"][2] - found["screw_torque"][0]) / (2 * step)
    assert found["d_screw_torque_d_screw_speed"][1] == pytest.approx(slope, rel=1e-7)


@pytest.mark.slow
@needs_a_compiler
def test_the_example_passes_its_test_vector(ballscrew, example, tmp_path):
    done = ballscrew("hand-over", example, "--to", "c", "-o", "made", "--json")
    assert done.returncode == 0, done.stderr
    results = json.loads(done.stdout)["results"]
    assert results["worst_error"]["screw_torque"]["relative"] <= ROUNDING or not interpreter.runs_here()
    assert results["valid_range"].keys() == {"axial_load", "screw_speed", "temperature"}
    folder = tmp_path / "made"
    assert {path.name for path in folder.iterdir()} == {
        "ballscrew.c",
        "ballscrew.h",
        "main.c",
        "test_vector.csv",
        "README.txt",
    }
    command = [COMPILER, *STRICT, "-O1", "ballscrew.c", "main.c", "-o", "example", "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    run = [str(folder / "example"), str(folder / "test_vector.csv")]
    tested = subprocess.run(run, capture_output=True, text=True)
    assert tested.returncode == 0
    assert tested.stdout.startswith("100 rows, largest relative difference ")
    shown = subprocess.run(run[:1], capture_output=True, text=True)
    assert "valid = 1" in shown.stdout


@needs_a_compiler
def test_the_header_can_be_included_in_cpp(handed_over, tmp_path):
    handed = handed_over(bs.FrictionModel.olaru2005(), NUTS["row"])
    (tmp_path / "ballscrew.h").write_text(c99.header(handed))
    (tmp_path / "a.cpp").write_text('#include "ballscrew.h"\nint main() { return BALLSCREW_AXIAL_LOAD; }\n')
    command = [COMPILER, "-x", "c++", "-fsyntax-only", "-Wall", "-Wextra", "-pedantic", "-Werror", "a.cpp"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    if "cc1plus" in done.stderr:
        pytest.skip("the compiler of this machine has no C++")
    assert done.returncode == 0, done.stderr


def test_the_prebuilt_library_is_of_these_sources():
    folder = resources.files("ballscrew").joinpath("data", "exports")
    own = sorted(path.name for path in folder.iterdir() if path.name.startswith(("ballscrew_", "fmi", "site_")))
    sources = [name for suffix in (".c", ".h") for name in own if name.endswith(suffix)]
    digest = hashlib.sha256(b"".join(interpreter.data(name) for name in sources)).hexdigest()
    assert interpreter.data("sources.sha256").decode().split() == [digest], "run: make interpreter"


def test_an_export_says_where_it_comes_from(handed_over):
    export = c99.export(handed_over(bs.FrictionModel.olaru2005(), NUTS["row"]))
    assert isinstance(export, Export)
    text = export.files["README.txt"].decode()
    assert "valid is 0 beyond the range" in text
    assert f"  {NUT_REASONS['elastic_regime']}\n" in text
    assert "Olaru2005" in text
    assert "loaded_balls = " in text
    assert f"ballscrew {bs.__version__}" in text


@needs_the_library
def test_a_program_is_called_as_its_text_says(handed_over, tmp_path):
    handed = handed_over(bs.FrictionModel.olaru2005(), NUTS["double"], to="program")
    export = target("program").export(handed)
    export.write(tmp_path)
    recipe = export.files["README.txt"].decode().split("ctypes:\n")[1].split("Each thread")[0]
    lines = "\n".join(line.strip() for line in recipe.splitlines())
    lines = lines.replace('"linux64', f'"{tmp_path}/linux64').replace('b"program', f'b"{tmp_path}/program')
    names = {}
    exec(lines, names)
    wanted = handed.evaluate({})
    assert list(names["outputs"]) == pytest.approx([float(wanted[name]) for name in handed.output_names], rel=1e-13)
