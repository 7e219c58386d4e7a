"""Kernels against the model on plain arrays: the same numbers, NaN in the same places, whatever the blocks."""

import dataclasses
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.compiler.kernels import kernel
from ballscrew.engine.evaluation.evaluation import Evaluation, rectangles
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.laws import rolling
from support.quick_kernels import SHIPPED, UNOPTIMISED, set_code_optimisation
from support.structures import forget_structures

MODELS = {
    "olaru2005": bs.FrictionModel.olaru2005(),
    "olaru2005-literal": bs.FrictionModel.olaru2005(literal_film_parameter=True),
    "corrected": bs.FrictionModel.corrected(),
    "reference": bs.FrictionModel.reference(),
}
EXAMPLE = Path(__file__).parents[3] / "examples" / "olaru2005.toml"

#: Every kind of input, over ranges that reach beyond what is usual.
RANGES = {
    "axial_load": (1, 20_000),
    "screw_speed": (0.1, 300),
    "viscosity": (0.001, 1),
    "pitch_circle_diameter": (0.02, 0.06),
    "lead": (0.003, 0.02),
    "ball_diameter": (0.002, 0.004),
    "contact_angle": (0.5, 1.1),
    "screw_conformity": (0.505, 0.6),
    "nut_conformity": (0.505, 0.6),
    "ball_roughness": (1e-8, 3e-7),
    "pressure_viscosity_coefficient": (1e-8, 3e-8),
    "friction.boundary_friction_coefficient": (0.05, 0.25),
}
#: Outputs that are differences and pass through zero, and what they are small against.
DIFFERENCES = {
    "nut_torque": lambda r: r.screw_torque,
    "nut_friction_torque": lambda r: r.screw.friction_torque,
    "nut_tangential_force": lambda r: r.screw.tangential_force,
    "nut_sliding_force": lambda r: r.screw.tangential_force,
    "screw_sliding_force": lambda r: r.screw.tangential_force,
    "lateral_force": lambda r: r.screw.friction_coefficient * r.contact_load,
    "back_driving_efficiency": lambda r: 1.0,
    "holding_torque": lambda r: r.ideal_torque + r.screw_torque,
    "residual": lambda r: 1.0,
}
#: What settles in the balance of the slip is as accurate as the balance: in units of its largest value.
SETTLED = ("creep_speed", "pure_rolling_offset", "lateral_slip_speed")


def random_points(count, seed=0):
    rng = np.random.default_rng(seed)
    values = {name: rng.uniform(low, high, count) for name, (low, high) in RANGES.items()}
    values["axial_load"][:5] = 0.0
    values["screw_speed"][3:9] = 0.0
    return {name: xr.DataArray(v, dims="point") for name, v in values.items()}


def grid(*sizes):
    names = ("axial_load", "screw_speed", "viscosity")
    ends = ((0.0, 4000.0), (0.0, 100.0), (0.01, 0.5))
    return {n: np.linspace(*e, s) for n, e, s in zip(names, ends, sizes, strict=True)}


def filled(plan, engine, **how):
    evaluation = Evaluation.of(plan, engine)
    results = evaluation.empty(plan.total)
    evaluation.fill(results, slice(0, plan.total), **how)
    return results


#: Models and numbers of points. The letter of the paper differs from it in one ratio.
SHORT = [(name, 5000) for name in MODELS if name != "olaru2005-literal"]
MANY = [pytest.param(name, 100_000, marks=pytest.mark.long) for name in MODELS]


@pytest.mark.slow
@pytest.mark.compiles
@pytest.mark.parametrize(("name", "count"), [*SHORT, *MANY])
def test_kernels_are_the_model_on_plain_arrays(name, count):
    """At random points, no load and rest among them, all outputs."""
    subject = Configuration(MODELS[name], SCREW, OIL)
    plan = Plan.of(subject, list(known_outputs()), random_points(count))
    found = filled(plan, "compiled")
    result = subject.at(plan.points(slice(0, plan.total)))
    for output in plan.wanted.values():
        expected = np.broadcast_to(output.read(result), plan.total)
        value = found[output.name]
        if output.dtype is bool:
            assert np.mean(value != expected) < 1e-4, output.name  # a bound met to the last place
            continue
        assert np.array_equal(np.isnan(value), np.isnan(expected)), output.name
        assert np.array_equal(np.isinf(value), np.isinf(expected)), output.name
        finite = np.isfinite(expected)
        value, expected = value[finite], expected[finite]
        scale = np.abs(expected)
        if output.name in DIFFERENCES:
            scale = np.abs(np.broadcast_to(DIFFERENCES[output.name](result), plan.total))[finite]
        if "pure_rolling_offset" in output.name:  # a root: of nothing, the root of what rounding leaves
            value, expected = value**2, expected**2
        if "spin" in output.name or output.name.endswith(SETTLED):
            scale = np.max(np.abs(expected), initial=0)
        assert np.all(np.abs(value - expected) <= 1e-12 * scale), output.name


@pytest.mark.compiles
@pytest.mark.parametrize(
    ("name", "outputs", "points"),
    [
        ("corrected", list(known_outputs()), random_points(5003)),
        ("olaru2005", None, grid(7, 11, 30)),
        pytest.param("reference", list(known_outputs()), random_points(5003), marks=pytest.mark.long),
    ],
    ids=["points", "grid", "reference"],
)
def test_optimisation_changes_no_bit(name, outputs, points):
    """Most tests have kernels whose code is not optimised."""
    plan = Plan.of(Configuration(MODELS[name], SCREW, OIL), outputs, points)
    levels = []
    for level in (UNOPTIMISED, SHIPPED):
        with pytest.MonkeyPatch.context() as patch:
            set_code_optimisation(patch, level)
            levels.append(filled(plan, "compiled"))
    assert UNOPTIMISED != SHIPPED
    for output, values in levels[0].items():
        assert np.array_equal(values, levels[1][output], equal_nan=True), output


@pytest.mark.slow
@pytest.mark.compiles
@pytest.mark.parametrize("engine", ["numpy", "compiled"])
@pytest.mark.parametrize("name", ["olaru2005", "reference"])
@pytest.mark.parametrize("how", [{"block_size": 7}, {"block_size": 37}, {"block_size": 1000, "threads": 3}])
def test_any_blocks_and_threads_give_the_same_bits(name, how, engine):
    plan = Plan.of(Configuration(MODELS[name], SCREW, OIL), None, random_points(1003))
    whole = filled(plan, engine, threads=1)
    for output, values in filled(plan, engine, **how).items():
        assert np.array_equal(values, whole[output], equal_nan=True), output


@pytest.mark.compiles
@pytest.mark.parametrize("name", MODELS)
def test_grids_are_the_points_they_are_made_of(name):
    """No load and rest are among the values of the axes."""
    plan = Plan.of(Configuration(MODELS[name], SCREW, OIL), None, grid(11, 13, 19))
    cut = Evaluation.of(plan, "compiled")
    # how a grid is cut shows in memory and time alone
    assert cut._row_length == 13 * 19
    found, expected = filled(plan, "compiled"), filled(plan, "numpy")
    for output in found:
        if found[output].dtype == bool:
            assert np.array_equal(found[output], expected[output]), output
        else:
            size = np.abs(expected["screw_torque"] if output == "nut_torque" else expected[output])
            size = np.maximum(size, 1.0) if output == "back_driving_efficiency" else size
            finite = np.isfinite(expected[output])
            assert np.array_equal(found[output][~finite], expected[output][~finite], equal_nan=True), output
            off = np.abs(found[output][finite] - expected[output][finite])
            assert np.all(off <= 1e-12 * size[finite]), output


@pytest.mark.parametrize("engine", ["numpy", pytest.param("compiled", marks=pytest.mark.compiles)])
@pytest.mark.parametrize("how", [{"block_size": 1}, {"block_size": 100}, {"block_size": 5000, "threads": 2}])
def test_any_blocks_of_a_grid_give_the_same_bits(how, engine):
    plan = Plan.of(Configuration(MODELS["olaru2005"], SCREW, OIL), None, grid(7, 11, 30))
    whole = filled(plan, engine, threads=1)
    for output, values in filled(plan, engine, **how).items():
        assert np.array_equal(values, whole[output], equal_nan=True), output


@pytest.mark.compiles
def test_parts_are_what_the_whole_has_there():
    plan = Plan.of(Configuration(MODELS["corrected"], SCREW, OIL), None, grid(7, 11, 30))
    evaluation, whole = Evaluation.of(plan, "compiled"), filled(plan, "compiled")
    for start, stop in ((0, 1), (5, 340), (329, 331), (660, 2310), (2309, 2310)):
        results = evaluation.empty(stop - start)
        evaluation.fill(results, slice(start, stop))
        for output, values in results.items():
            assert np.array_equal(values, whole[output][start:stop], equal_nan=True)


@given(st.integers(0, 60), st.integers(0, 60), st.integers(1, 13))
def test_rectangles_cover_a_part_once(start, size, row_length):
    part = slice(start, start + size)
    places = [
        row * row_length + column
        for rows, columns in rectangles(part, row_length)
        for row in range(rows.start, rows.stop)
        for column in range(columns.start, columns.stop)
    ]
    assert places == list(range(part.start, part.stop))


@pytest.mark.slow
@pytest.mark.compiles
@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("engine", ["numpy", "compiled"])
def test_no_load_and_rest_as_numbers(name, engine):
    """A load of zero that is the same at all points folds into the constants."""
    subject = Configuration(MODELS[name], SCREW, OIL)
    for axes in (
        {"axial_load": 0.0, "screw_speed": [0.0, 0.1, 60.0]},
        {"axial_load": [0.0, 100.0], "screw_speed": 0.0},
    ):
        found = filled(Plan.of(subject, None, axes), engine)
        result = subject.at({n: np.asarray(v) for n, v in axes.items()})
        for output, values in found.items():
            expected = np.broadcast_to(known_outputs()[output].read(result), values.shape)
            assert np.array_equal(np.isnan(values), np.isnan(expected)), output
            assert np.allclose(values, expected, rtol=1e-12, atol=1e-18, equal_nan=True), output


@pytest.mark.slow
@pytest.mark.compiles
def test_a_tall_grid_has_no_tables():
    """Tables of many rows would need more memory than the blocks they serve."""
    axes = {"axial_load": np.linspace(1, 4000, 1_000_000), "screw_speed": np.linspace(1, 100, 20)}
    assert (
        Evaluation.of(Plan.of(Configuration(MODELS["reference"], SCREW, OIL), None, axes), "compiled")._row_length == 1
    )


@pytest.mark.compiles
def test_a_law_of_the_same_name_has_another_fingerprint():
    """On a grid, what is different may be in a table only; and a law may not be recorded at all."""

    def resistance(share):
        def snare_resistance(conditions):
            return share * rolling.snare_resistance(conditions)

        return snare_resistance

    def blind(share):
        def printed(conditions):
            return np.vectorize(lambda film: share * film)(conditions.film_parameter)

        return printed

    def fingerprint(**changed):
        model = dataclasses.replace(MODELS["olaru2005"], **changed)
        return Evaluation.of(Plan.of(Configuration(model, SCREW, OIL), None, grid(20, 20, 30))).fingerprint

    assert fingerprint(elastic_resistance=resistance(1)) != fingerprint(elastic_resistance=resistance(3))
    assert fingerprint(friction=blind(0.1)) != fingerprint(friction=blind(0.2))


@pytest.mark.compiles
def test_the_number_of_balls_can_be_varied():
    plan = Plan.of(Configuration(MODELS["reference"], SCREW, OIL), None, {**grid(5, 7, 9), "loaded_balls": [50, 56]})
    found, expected = filled(plan, "compiled"), filled(plan, "numpy")
    assert np.array_equal(found["valid"], expected["valid"])
    assert np.allclose(found["screw_torque"], expected["screw_torque"], rtol=1e-12, equal_nan=True)


@pytest.mark.parametrize(
    "values",
    [
        "100",
        ["4 kN"],
        [[1.0], [2.0, 3.0]],
        [1.0, None],
        [True, False],
        np.ma.masked_array([1.0, 2.0], [0, 1]),
        [1 + 2j],
    ],
)
def test_what_is_no_number_is_refused(values):
    with pytest.raises(bs.InputError, match="must be numbers in SI"):
        bs.sweep(MODELS["olaru2005"], SCREW, OIL, axial_load=values, screw_speed=1.0)


def test_labels_that_disagree_are_refused():
    loads = xr.DataArray([1.0, 2.0], dims="point", coords={"point": [0, 1]})
    speeds = xr.DataArray([1.0, 2.0], dims="point", coords={"point": [1, 0]})
    with pytest.raises(bs.InputError, match="has other labels in another input"):
        bs.sweep(MODELS["olaru2005"], SCREW, OIL, axial_load=loads, screw_speed=speeds)


def test_small_work_is_left_to_numpy(monkeypatch, tmp_path):
    forget_structures(monkeypatch, tmp_path)
    plan = Plan.of(Configuration(MODELS["reference"], SCREW, OIL), None, grid(5, 5, 5))
    assert Evaluation.of(plan).engine == "numpy"


@pytest.mark.slow
@pytest.mark.compiles
def test_large_work_is_compiled_and_what_is_compiled_is_used():
    subject = Configuration(dataclasses.replace(MODELS["reference"], ball_friction_coefficient=0.0987), SCREW, OIL)
    points = {name: values.expand_dims(times=30) for name, values in random_points(100_000).items()}  # views
    assert Evaluation.of(Plan.of(subject, None, points)).engine == "compiled"
    middling = Plan.of(subject, None, random_points(100_000))
    assert Evaluation.of(middling).engine == "compiled"  # as it is compiled by now, for other points
    # as a new process, which has no kernel loaded
    kernel._kernels.clear()
    assert Evaluation.of(middling).engine == "compiled"  # from disk


def test_without_a_compiler(monkeypatch):
    monkeypatch.setattr(kernel, "available", lambda: False)
    plan = Plan.of(Configuration(MODELS["olaru2005"], SCREW, OIL), None, grid(3, 3, 3))
    assert Evaluation.of(plan).engine == "numpy"
    with pytest.raises(bs.InputError, match=r'sweep.engine: .* · pip install "ballscrew\[fast\]"'):
        Evaluation.of(plan, "compiled")


def test_unknown_engine():
    with pytest.raises(bs.InputError, match=r"sweep.engine: unknown engine \(turbo\) · one of numpy, compiled, model"):
        bs.sweep(MODELS["olaru2005"], SCREW, OIL, axial_load=[1.0], screw_speed=[1.0], engine="turbo")


@pytest.mark.parametrize("name", ["olaru2005", "corrected", "reference"])
def test_the_model_itself_says_what_its_recording_says(name):
    """Also at rest and without load; they differ by rounding alone."""
    axes = {"axial_load": [0.0, 20.0, 400.0, 4000.0], "screw_speed": [0.0, 5.0, 60.0], "lead": [0.005, 0.02]}
    recorded, itself = (bs.sweep(MODELS[name], SCREW, OIL, engine=engine, **axes) for engine in ("numpy", "model"))
    xr.testing.assert_allclose(recorded, itself, rtol=1e-9)
    assert list(recorded.dims) == list(itself.dims)


def test_the_model_itself_fills_no_store(tmp_path):
    """A store goes on with what it was begun with, which must have a name of its own."""
    with pytest.raises(bs.InputError, match=r"sweep.engine: fills no store \(model\)"):
        bs.sweep(
            MODELS["olaru2005"], SCREW, OIL, axial_load=[1.0], screw_speed=1.0, engine="model", to=tmp_path / "a.zarr"
        )


@pytest.mark.compiles
def test_a_law_that_kernels_do_not_know():
    """It is evaluated by NumPy, unless a kernel is asked for."""

    def odd_film(conditions):
        return 1e-7 * np.cosh(1e-9 * (conditions.speed_parameter + conditions.load_parameter))

    model = dataclasses.replace(MODELS["corrected"], film=odd_film)
    axes = grid(3, 3, 3)
    assert Evaluation.of(Plan.of(Configuration(model, SCREW, OIL), None, axes)).engine == "numpy"
    with pytest.raises(bs.InputError, match=r"sweep\.engine: "):
        bs.sweep(model, SCREW, OIL, engine="compiled", **axes)


@pytest.mark.slow
def test_a_single_run_loads_no_compiler():
    """Nor anything else that takes long to load."""
    program = (
        "import sys\n"
        "from ballscrew.faces.cli.main import main\n"
        f"sys.argv = ['ballscrew', 'run', {str(EXAMPLE)!r}]\n"
        "try:\n    main()\nexcept SystemExit as end:\n    assert not end.code\n"
        "heavy = {'llvmlite', 'numba', 'jax', 'dask', 'distributed', 'pandas', 'matplotlib', 'zarr', 'scipy'}\n"
        "print('loaded:', sorted(name for name in heavy if sys.modules.get(name) is not None))"
    )
    outcome = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "loaded: []" in outcome.stdout
