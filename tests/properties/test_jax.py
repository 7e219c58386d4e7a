"""The models on arrays of JAX: NumPy's numbers, and derivatives that agree with differences.

JAX is loaded by the tests that use it: where it is loaded, each worker holds 100 MB more from the start.
"""

import dataclasses
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.engine.evaluation import derivatives
from ballscrew.engine.evaluation.derivatives import jax_value_and_partials
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.laws import ball_chain, film, friction, hertz, inlet, rolling
from ballscrew.physics.solvers.line_slip import line_slip
from support.strategies import MODELS, corrected, reference

pytestmark = pytest.mark.slow

#: Between them, all laws that are not in a preset.
OTHERS = {
    "line slip": dataclasses.replace(
        reference,
        slip=line_slip,
        friction=friction.GreenwoodTrippSharing(),
        rolling=rolling.aihara_rolling,
        ball_force=ball_chain.ProportionalBallForce(),
    ),
    "Arana": dataclasses.replace(
        reference,
        full_film=friction.arana_traction,
        inlet=inlet.flooded_inlet,
        ball_force=ball_chain.ChainBallForce(gap=0.03),
    ),
    "Eyring": dataclasses.replace(
        corrected,
        full_film=friction.EyringTraction(),
        elastic_resistance=rolling.Hysteresis(),
        rolling=rolling.houpert_rolling,
    ),
    "limiting shear": dataclasses.replace(
        corrected,
        full_film=friction.LimitingShearTraction(),
        hertz=hertz.brewe_hamrock_hertz,
        film=film.hamrock_dowson_central,
        friction=friction.BalanSharing(),
    ),
}
#: What numbers the models leave open.
GIVEN = {"ball_to_ball_force": 0.02, "pure_rolling_offset": 0.34, "pressure_modulus_slope": 0.02}
#: A play to take differences of; without play there are none relative to it.
PLAY = {"axial_play": 2e-5}
#: Inputs that enter late, or at one contact only.
FAR_ENDS = {"axial_load", "nut_roughness", "nut_conformity", "thermal_conductivity", "ball_friction_coefficient"}
FAR_ENDS |= {"inlet.inlet_film_ratio", "friction.asperity_radius"}
#: Points of a test. JAX prepares its operations anew for each number of them, so all tests have as many.
NUMBER = 40


def subject_of(model):
    """A model on the paper's screw."""
    screw = bs.BallScrew(0.040, 0.005, 3.175e-3, 56, np.pi / 4, 0.515, 0.515)
    return Configuration(model, screw, bs.Lubricant(viscosity=0.1))


def inputs_of(subject):
    """All inputs of a model, with their values where it has some."""
    values = {
        name: 4000.0 if name == "axial_load" else 60.0 if name == "screw_speed" else PLAY.get(name)
        for name in subject.inputs
        if not name.startswith("nut.")  # a second name
    }
    values = {name: subject.value_of(name) if value is None else value for name, value in values.items()}
    values = {name: GIVEN[name] if value is None else float(value) for name, value in values.items()}
    if subject.model.slip is not corrected.slip:
        del values["pure_rolling_offset"]  # refused where other slip is
    return values


def points_of(subject, seed=0, also=lambda result: result.valid):
    """Random screws, oils and operating points that are valid, of those that are something else besides."""
    random = np.random.default_rng(seed)
    drawn = 300 * NUMBER
    points = {name: value * random.uniform(0.8, 1.2, drawn) for name, value in inputs_of(subject).items()}

    def powers(low, high):
        return np.exp(random.uniform(np.log(low), np.log(high), drawn))

    points |= {
        "axial_load": powers(10, 2e4),
        "screw_speed": powers(0.1, 300),
        "viscosity": powers(0.005, 1),
        "contact_angle": np.radians(random.uniform(20, 70, drawn)),
        "screw_conformity": random.uniform(0.505, 0.56, drawn),
        "nut_conformity": random.uniform(0.505, 0.56, drawn),
        "loaded_balls": random.integers(20, 200, drawn).astype(float),
        "starts": np.ones(drawn),
    }
    points |= {"pure_rolling_offset": random.uniform(0.3, 0.4, drawn)} if "pure_rolling_offset" in points else {}
    with np.errstate(all="ignore"):
        result = subject.at(points)
    chosen = np.flatnonzero(result.valid & also(result))[:NUMBER]
    assert len(chosen) == NUMBER
    return {name: values[chosen] for name, values in points.items()}


def outputs_of(subject, outputs):
    """Outputs of a model as a function of its inputs."""
    return lambda values: {name: known_outputs()[name].read(subject.at(values)) for name in outputs}


def differences(function, points, relative):
    """Central differences by each input, a row each, extrapolated to a step of zero."""
    rows = np.arange(len(points))[:, None]

    def moved(step):
        everywhere = {n: values * np.where(rows == i, 1 + step, 1.0) for i, (n, values) in enumerate(points.items())}
        found = function({name: values.ravel() for name, values in everywhere.items()})
        return {output: values.reshape(len(points), -1) for output, values in found.items()}

    def central(step):
        up, down = moved(step), moved(-step)
        return {output: (up[output] - down[output]) / (2 * step * np.array(list(points.values()))) for output in up}

    wide, narrow = central(relative), central(relative / 2)
    return {output: (4 * narrow[output] - wide[output]) / 3 for output in wide}


@pytest.mark.parametrize("name", MODELS)
def test_the_numbers_are_those_of_numpy(name):
    import jax

    subject = subject_of(MODELS[name])
    points = points_of(subject)
    expected = subject.at(points)
    with jax.enable_x64(True):
        found = subject.at({name: jax.numpy.asarray(values) for name, values in points.items()})
        for output, entry in known_outputs().items():
            mine, numpys = np.asarray(entry.read(found)), np.asarray(entry.read(expected))
            if entry.dtype is bool:
                assert (mine == numpys).all(), output
            else:
                rounding = 1e-12 if output == "residual" else 0  # in units of load and preload
                np.testing.assert_allclose(mine, numpys, rtol=1e-12, atol=rounding, err_msg=output)


@pytest.mark.parametrize("name", MODELS)
def test_derivatives_are_those_of_differences(name):
    subject = subject_of(MODELS[name])
    points = points_of(subject, seed=1)
    outputs = ["screw_torque"] if name == "reference" else ["screw_torque", "efficiency"]
    function = outputs_of(subject, outputs)
    values, partials = jax_value_and_partials(function, points, outputs, list(points))
    assert set(partials) == {(output, name) for output in outputs for name in points}
    expected = function(points)
    for output in outputs:
        np.testing.assert_allclose(values[output], expected[output], rtol=1e-12)
    # a step may cross one of the small jumps that a fixed number of iterations leaves: the best of three
    tried = [differences(function, points, step) for step in (1e-3, 1e-4, 1e-5)]
    for output in outputs:
        found = np.array([partials[output, name] for name in points])
        off = np.min([np.abs(found - slopes[output]) for slopes in tried], axis=0)
        # differences see a change of an output relative to its size
        seen = np.abs(found) + 1e-3 * np.abs(expected[output] / np.array(list(points.values())))
        assert (off < 1e-6 * seen).all(), (output, dict(zip(points, np.max(off / seen, axis=1), strict=True)))


#: All but these are long to trace.
SOON_TRACED = ("olaru2005", "line slip")
TRACED = [
    *SOON_TRACED,
    *(pytest.param(name, marks=pytest.mark.long) for name in sorted((MODELS | OTHERS).keys() - {*SOON_TRACED})),
]


@pytest.mark.parametrize("name", TRACED)
def test_each_input_alone_may_come_from_jax(name, monkeypatch):
    import jax

    monkeypatch.setattr(sys.modules[line_slip.__module__], "STEPS", 2)  # the others are the same again
    subject = subject_of((MODELS | OTHERS)[name])
    values = inputs_of(subject)
    if subject.model.slip is not corrected.slip:  # long to trace: of each part, what the rest depends on least
        values = {name: value for name, value in values.items() if name in FAR_ENDS}
    function = outputs_of(subject, ["screw_torque", "friction_power", "valid"])
    operation = {"axial_load": 4000.0, "screw_speed": 60.0}
    with jax.enable_x64(True):
        for name, value in values.items():
            found = jax.eval_shape(lambda x, name=name: function(operation | {name: x}), np.float64(value))
            assert found["screw_torque"].dtype == np.float64, name


def test_where_the_ball_creeps_the_other_way_no_derivative_is_spoilt():
    subject = subject_of(reference)
    points = points_of(subject, seed=2, also=lambda result: result.nut.pure_rolling_offset == 0)
    output, by = "nut_pure_rolling_offset", ["axial_load", "nut_conformity", "viscosity"]
    values, partials = jax_value_and_partials(outputs_of(subject, [output]), points, [output], by)
    assert (values[output] == 0).all()
    for name in by:
        np.testing.assert_array_equal(partials[output, name], np.zeros(NUMBER))


def test_compiled_blocks_say_the_same(monkeypatch):
    subject = subject_of(MODELS["olaru2005"])
    points = points_of(subject, seed=3)
    outputs, by = ["screw_torque", "efficiency"], ["axial_load", "ball_diameter", "friction.decay"]
    function = outputs_of(subject, outputs)
    values, partials = jax_value_and_partials(function, points, outputs, by)
    monkeypatch.setattr(derivatives, "UNCOMPILED", 20)
    monkeypatch.setattr(derivatives, "BLOCK", 16)
    calls = []

    def counted(inputs):
        calls.append(1)
        return function(inputs)

    again, slopes = jax_value_and_partials(counted, points, outputs, by)
    assert len(calls) == len(outputs)  # compiled once each, for three blocks of one shape
    for output in outputs:
        np.testing.assert_allclose(again[output], values[output], rtol=1e-13)
    for key in partials:
        np.testing.assert_allclose(slopes[key], partials[key], rtol=1e-11)


def test_forward_and_reverse_and_one_by_one_agree():
    import jax

    subject = subject_of(MODELS["olaru2005"])
    points = points_of(subject, seed=4)
    function = outputs_of(subject, ["screw_torque"])
    _, partials = jax_value_and_partials(function, points, ["screw_torque"], ["axial_load", "screw_speed"])

    def torque(axial_load, screw_speed, others):
        return function({**others, "axial_load": axial_load, "screw_speed": screw_speed})["screw_torque"]

    with jax.enable_x64(True):
        at = {name: jax.numpy.asarray(values) for name, values in points.items()}
        operation = at.pop("axial_load"), at.pop("screw_speed")
        by_load, by_speed = jax.jit(jax.vmap(jax.grad(torque, (0, 1))))(*operation, at)
        _, forward = jax.jvp(lambda load: torque(load, operation[1], at), operation[:1], (np.ones(NUMBER),))
    np.testing.assert_allclose(by_load, partials["screw_torque", "axial_load"], rtol=1e-11)
    np.testing.assert_allclose(by_speed, partials["screw_torque", "screw_speed"], rtol=1e-11)
    np.testing.assert_allclose(forward, partials["screw_torque", "axial_load"], rtol=1e-11)


def test_outputs_that_do_not_depend_on_an_input_have_no_slope():
    subject = subject_of(corrected)
    points = points_of(subject)
    function = outputs_of(subject, ["rolling_share", "ideal_torque"])
    values, partials = jax_value_and_partials(
        function, points, ["rolling_share", "ideal_torque"], ["viscosity", "lead"]
    )
    np.testing.assert_array_equal(values["rolling_share"], np.ones(NUMBER))
    np.testing.assert_array_equal(partials["rolling_share", "lead"], np.zeros(NUMBER))
    np.testing.assert_array_equal(partials["ideal_torque", "viscosity"], np.zeros(NUMBER))
    np.testing.assert_allclose(partials["ideal_torque", "lead"], points["axial_load"] / (2 * np.pi), rtol=1e-14)


def test_double_precision_is_for_the_call_alone():
    import jax

    point = {"axial_load": np.array([4000.0]), "screw_speed": np.array([60.0])}
    values, _ = jax_value_and_partials(lambda p: {"product": p["axial_load"] / 3}, point, ["product"], ["axial_load"])
    assert values["product"][0] == 4000 / 3
    assert jax.numpy.ones(1).dtype == np.float32


def test_without_jax_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "jax", None)
    with pytest.raises(InputError, match=r'needs JAX .* pip install "ballscrew\[jax\]"'):
        jax_value_and_partials(dict, {"axial_load": np.ones(1)}, ["axial_load"], ["axial_load"])


def test_nothing_else_loads_jax():
    case = Path(__file__).parents[2] / "examples" / "olaru2005.toml"
    code = f"""
import sys
import ballscrew
from ballscrew.faces.cli.main import app
app(["run", {str(case)!r}], standalone_mode=False)
assert "jax" not in sys.modules
"""
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert process.returncode == 0, process.stderr
