"""Evaluators: the numbers of the model, for numbers and arrays, from any thread and process."""

import dataclasses
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.evaluation.derivatives import derivatives
from ballscrew.engine.evaluation.outputs import DEFAULT_OUTPUTS, known_outputs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.laws import rolling

MODELS = {name: getattr(bs.FrictionModel, name)() for name in ("olaru2005", "corrected", "reference")}
ENGINES = ["numpy", pytest.param("compiled", marks=pytest.mark.compiles)]
INPUTS = ("axial_load", "screw_speed", "viscosity", "ball_diameter", "friction.boundary_friction_coefficient")


def random_points(count):
    rng = np.random.default_rng(17)
    ranges = ((0, 8000), (0, 200), (0.005, 1.0), (0.002, 0.0035), (0.05, 0.25))
    points = [rng.uniform(*ends, count) for ends in ranges]
    points[0][:4] = points[1][2:7] = 0.0
    return points


def by_the_model(model, values):
    load, speed, viscosity, diameter, coefficient = values
    model = dataclasses.replace(
        model, friction=dataclasses.replace(model.friction, boundary_friction_coefficient=coefficient)
    )
    screw, oil = dataclasses.replace(SCREW, ball_diameter=diameter), dataclasses.replace(OIL, viscosity=viscosity)
    result = model(screw, oil, axial_load=load, screw_speed=speed)
    return {name: known_outputs()[name].read(result) for name in DEFAULT_OUTPUTS}


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("name", MODELS)
def test_it_is_the_model(name, engine):
    f = bs.evaluator(MODELS[name], SCREW, OIL, inputs=INPUTS, engine=engine)
    values = random_points(300)
    expected = by_the_model(MODELS[name], values)
    found = f(*values)
    assert tuple(found) == DEFAULT_OUTPUTS == f.outputs
    for output, value in found.items():
        wanted = np.broadcast_to(expected[output], value.shape)
        assert value.dtype == (bool if output == "valid" else float)
        size = np.abs(expected["screw_torque"]) if output == "nut_torque" else np.maximum(1e-3, np.abs(wanted))
        finite = np.isfinite(wanted)
        assert np.array_equal(value[~finite], wanted[~finite], equal_nan=True), output
        found_there, wanted_there = (1.0 * array[finite] for array in (value, wanted))
        assert np.all(np.abs(found_there - wanted_there) <= 1e-11 * np.broadcast_to(size, 300)[finite]), output


@pytest.mark.parametrize("engine", ENGINES)
def test_numbers_give_the_bits_of_arrays(engine):
    """One by one, by name and in order, of Python and of NumPy; and in any blocks, on any threads."""
    f = bs.evaluator(MODELS["reference"], SCREW, OIL, inputs=INPUTS, engine=engine, threads=3)
    values = random_points(70_000 if engine == "compiled" else 50)
    whole = f(*values)
    for i in (0, 3, 5, 17, 49):
        point = [float(v[i]) for v in values]
        for found in (f(*point), f(**dict(zip(INPUTS, point, strict=True))), f(*map(np.float64, point))):
            for name, value in found.items():
                assert np.ndim(value) == 0
                assert np.array_equal(value, whole[name][i], equal_nan=True), name
    # so that a few points make several blocks
    f._block_size = 7
    few = f(*[v[:50] for v in values])
    assert all(np.array_equal(few[name], whole[name][:50], equal_nan=True) for name in few)


@pytest.mark.parametrize("engine", ENGINES)
def test_arrays_broadcast(engine):
    f = bs.evaluator(MODELS["corrected"], SCREW, OIL, inputs=INPUTS[:3], engine=engine)
    load, speed = np.linspace(1, 4000, 5)[:, None], [0.0, 10.0, 60.0]
    found = f(load, speed, 0.1)["screw_torque"]
    assert found.shape == (5, 3)
    for i, j in np.ndindex(5, 3):
        assert found[i, j] == f(float(load[i, 0]), speed[j], 0.1)["screw_torque"]
    assert f(np.array([]), 1.0, 0.1)["screw_torque"].shape == (0,)
    assert f(np.array(3.0), 1, np.float32(0.1))["screw_torque"].shape == ()
    with pytest.raises(bs.InputError, match=r"do not broadcast \(axial_load \(2,\), screw_speed \(3,\)"):
        f([1.0, 2.0], speed, 0.1)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("bad", "place"),
    [(bad, place) for place in range(len(INPUTS)) for bad in (np.nan, np.inf, *(() if place < 2 else (-1e-9, -5.0)))],
)
def test_a_value_beyond_its_bounds_is_no_number(bad, place, engine):
    f = bs.evaluator(MODELS["corrected"], SCREW, OIL, inputs=INPUTS, engine=engine)
    good = [1000.0, 60.0, 0.1, 0.003, 0.1]
    one = [*good[:place], bad, *good[place + 1 :]]
    among = [np.array([g, b, g]) for g, b in zip(good, one, strict=True)]
    alone, three, fine = f(*one), f(*among), f(*good)
    for name in DEFAULT_OUTPUTS:
        nothing = False if name == "valid" else np.nan
        assert np.array_equal(alone[name], nothing, equal_nan=name != "valid")
        assert np.array_equal(three[name], [fine[name], nothing, fine[name]], equal_nan=name != "valid")


@pytest.mark.parametrize("engine", ENGINES)
def test_derivatives_are_those_of_bs_derivatives(engine):
    by = ["axial_load", "ball_diameter"]
    f = bs.evaluator(
        MODELS["corrected"], SCREW, OIL, inputs=INPUTS[:4], outputs=["screw_torque", "efficiency"], by=by, engine=engine
    )
    values = dict(zip(INPUTS[:4], ([200.0, 4000.0], 30.0, 0.1, 0.003), strict=True))
    expected = derivatives(MODELS["corrected"], SCREW, OIL, by=by, outputs=["screw_torque", "efficiency"], **values)
    found = f(**values)
    assert list(found) == list(expected.data_vars)
    for name, value in found.items():
        np.testing.assert_allclose(value, expected[name], rtol=1e-11)
    assert np.isnan(f(**values | {"viscosity": -1.0})["d_efficiency_d_ball_diameter"]).all()


@pytest.mark.parametrize("engine", ENGINES)
def test_pickles_and_threads(engine):
    f = bs.evaluator(MODELS["corrected"], SCREW, OIL, inputs=["axial_load"], screw_speed=60.0, engine=engine)
    copied = pickle.loads(pickle.dumps(f))
    loads = np.linspace(1, 4000, 200).tolist()
    expected = [f(load) for load in loads]
    assert [copied(load) for load in loads] == expected
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(f, loads)) == expected


def test_laws_that_cannot_be_recorded():
    def blind(conditions):
        return np.interp(conditions.film_parameter, [0.0, 3.0], [0.2, 0.02])

    model = dataclasses.replace(MODELS["corrected"], friction=blind)
    f = bs.evaluator(model, SCREW, OIL)
    assert f.engine == "numpy"
    assert "model.friction" in f.engine_reason
    expected = model(SCREW, OIL, axial_load=np.array([100.0, 1000.0]), screw_speed=60.0)
    np.testing.assert_array_equal(f([100.0, 1000.0], 60.0)["screw_torque"], expected.screw_torque)
    assert f(100.0, 60.0)["screw_torque"] == expected.screw_torque[0]
    assert f(-100.0, 60.0)["screw_torque"] == expected.screw_torque[0]
    assert np.isnan(f(np.inf, 60.0)["screw_torque"])
    with pytest.raises(bs.InputError, match=r"evaluator\.by: has no derivatives"):
        bs.evaluator(model, SCREW, OIL, outputs=["screw_torque"], by=["axial_load"])
    with pytest.raises(bs.InputError, match=r"evaluator\.engine: "):
        bs.evaluator(model, SCREW, OIL, engine="compiled")


def test_a_law_is_read_when_the_evaluator_is_made():
    share = [1.0]
    model = dataclasses.replace(
        MODELS["corrected"], elastic_resistance=lambda conditions: share[0] * rolling.snare_resistance(conditions)
    )
    first = bs.evaluator(model, SCREW, OIL)
    before = first(1000.0, 60.0)
    share[0] = 3.0
    assert first(1000.0, 60.0) == before
    assert bs.evaluator(model, SCREW, OIL)(1000.0, 60.0)["screw_torque"] > before["screw_torque"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"inputs": ["axial_lod", "screw_speed"]}, r"evaluator\.inputs: unknown input \(axial_lod\) · did you mean"),
        ({"inputs": ["axial_load"]}, r"evaluator\.screw_speed: missing"),
        ({"inputs": ["axial_load"], "screw_speed": np.inf}, r"operation\.screw_speed: must be a finite number"),
        ({"inputs": ["axial_load"], "screw_speed": [1.0, 2.0]}, r"evaluator\.screw_speed: must be one number"),
        ({"inputs": ["axial_load", "axial_load"], "screw_speed": 1.0}, r"evaluator\.inputs: is named twice"),
        ({"axial_load": 1.0}, r"evaluator\.axial_load: is an input and fixed"),
        ({"inputs": [], "axial_load": 1.0, "screw_speed": 1.0}, r"evaluator\.inputs: missing"),
        ({"outputs": ["torque"]}, r"evaluator\.outputs: unknown output"),
        ({"by": ["lead"]}, r"evaluator\.by: is no input \(lead\)"),
        ({"by": ["axial_load"]}, r"evaluator\.outputs: is true or false"),
        ({"engine": "turbo"}, r"evaluator\.engine: unknown engine"),
        ({"lead": -1.0}, r"screw\.lead: must be positive"),
    ],
)
def test_what_it_cannot_be_made_of(given, message):
    with pytest.raises(bs.InputError, match=message):
        bs.evaluator(MODELS["olaru2005"], SCREW, OIL, **given)


@pytest.mark.parametrize(
    ("values", "named", "message"),
    [
        ((1.0,), {}, r"evaluator\.screw_speed: missing"),
        ((1.0, 2.0, 3.0), {}, r"evaluator: too many values \(3\)"),
        ((1.0, 2.0), {"axial_load": 1.0}, r"evaluator\.axial_load: is given twice"),
        ((), {"axial_load": 1.0, "speed": 2.0}, r'evaluator\.speed: no input · did you mean "screw_speed"'),
        (("1", 2.0), {}, r"evaluator\.axial_load: must be numbers in SI"),
        ((True, 2.0), {}, r"evaluator\.axial_load: must be numbers in SI"),
        ((None, 2.0), {}, r"evaluator\.axial_load: must be numbers in SI"),
        (([[1.0], [1.0, 2.0]], 2.0), {}, r"evaluator\.axial_load: must be numbers in SI"),
        ((np.ma.masked_array([1.0], [1]), 2.0), {}, r"evaluator\.axial_load: must be numbers in SI"),
        ((1 + 1j, 2.0), {}, r"evaluator\.axial_load: must be numbers in SI"),
    ],
)
def test_what_it_cannot_be_called_with(values, named, message):
    f = bs.evaluator(MODELS["olaru2005"], SCREW, OIL, engine="numpy")
    with pytest.raises(bs.InputError, match=message):
        f(*values, **named)


@pytest.mark.slow
@pytest.mark.compiles
@pytest.mark.parametrize("name", ["film.speed_exponent", "pressure_modulus_slope", "ball_to_ball_force"])
def test_an_input_that_is_a_constant_of_most_recordings_varies(name):
    """Exponents and numbers that the parts leave out: one by one and as arrays, results are those of the model."""
    sheared = dataclasses.replace(MODELS["reference"], full_film=LAWS["full_film"]["limiting-shear"]())
    model = MODELS["corrected"] if name == "ball_to_ball_force" else sheared
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=4326.0))
    oil = bs.Lubricant.from_grade("ISO VG 100", 313.15)
    values = {
        "film.speed_exponent": (0.6, 0.7),
        "pressure_modulus_slope": (0.01, 0.04),
        "ball_to_ball_force": (0.5, 5.0),
    }
    f = bs.evaluator(model, screw, oil, inputs=(*INPUTS[:2], name), outputs=("screw_torque",))
    found = f(5e3, 30.0, np.array(values[name]))["screw_torque"]
    points = {"axial_load": 5e3, "screw_speed": 30.0, name: list(values[name])}
    expected = bs.sweep(model, screw, oil, outputs=["screw_torque"], engine="model", **points)["screw_torque"]
    assert abs(found[1] - found[0]) > 1e-6
    np.testing.assert_allclose(found, expected.to_numpy(), rtol=1e-11)
    np.testing.assert_allclose([f(5e3, 30.0, x)["screw_torque"] for x in values[name]], found, rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("nut", [bs.SingleNut(), bs.DoubleNut(900.0, bodies=bs.Bodies())], ids=["row", "elastic"])
def test_a_speed_beyond_all_numbers_is_none_for_each_engine(name, nut):
    model, screw = MODELS[name], dataclasses.replace(SCREW, nut=nut)
    speeds = np.array([60.0, 1e99, 1e101, 1e200, 1e300, -1e300])
    called = model(screw, OIL, axial_load=500.0, screw_speed=speeds)
    found = bs.evaluator(model, screw, OIL, inputs=("screw_speed",), outputs=["screw_torque"], axial_load=500.0)(
        screw_speed=speeds
    )
    for torque in (called.screw_torque, found["screw_torque"]):
        assert np.isnan(torque).tolist() == [False, False, True, True, True, True]
    assert not called.valid[2:].any()
    with pytest.raises(bs.InputError, match="screw_speed: is beyond all numbers"):
        model(screw, OIL, axial_load=500.0, screw_speed=1e300)


@pytest.mark.compiles
def test_engines_agree_wherever_the_result_is_valid_down_to_loads_that_are_none():
    """Under a tenth of a millinewton a row of balls skids, and rounding decides where its slip ends."""
    loads = np.concatenate([[0.0], np.geomspace(1e-60, 1e3, 253)])
    for model in MODELS.values():
        called = model(SCREW, OIL, axial_load=loads, screw_speed=10.0)
        found = bs.evaluator(
            model, SCREW, OIL, inputs=("axial_load",), outputs=["screw_torque"], screw_speed=10.0, engine="compiled"
        )(axial_load=loads)
        known = called.valid | (loads >= 1e-4)
        np.testing.assert_allclose(found["screw_torque"][known], called.screw_torque[known], rtol=1e-12)
        np.testing.assert_allclose(found["screw_torque"], called.screw_torque, rtol=1e-4)
