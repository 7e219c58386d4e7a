"""The tape: what is written down, what is shared, what is dropped, and what it plays."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.compiler.tracing.program import Interpreter, Program
from ballscrew.compiler.tracing.tape import Tape, Traced, choose
from support.expressions import EXPRESSIONS

X = np.array([0.0, 0.25, 1.0, 2.0, 7.0])
Y = np.array([3.0, 0.0, 1.0, 0.5, 2.0])


def record(function, inputs=2):
    """The program of a function of some inputs."""
    tape = Tape(inputs)
    return Program.of(tape, {"out": function(*(tape.value(i) for i in range(inputs)))})


def play(program, *values):
    values = values or (X, Y)
    out = np.full(len(values[0]), 99.0)
    with np.errstate(all="ignore"):
        Interpreter(program).run(values, {"out": out})
    return out


def functions_of(program):
    return [step.function for _, step in program.steps]


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_plays_what_arrays_give(name):
    """Also at zero: the same infinities, the same undefined values."""
    function = EXPRESSIONS[name]
    with np.errstate(all="ignore"):
        expected = function(X, Y).astype(float)
    found = play(record(function))
    if name == "cancelling powers":
        # x²/x is x: at zero the tape keeps the limit, where arrays lose it
        expected[0] = 0.0
    assert np.allclose(found, expected, rtol=1e-14, atol=0, equal_nan=True)


def test_zero_is_kept_by_logarithms():
    """Products of powers go through logarithms; that of zero is minus infinity, and comes back as zero."""
    program = record(lambda x, y: 2.86 * x**0.66 * y**0.47)
    assert np.log in functions_of(program)
    assert list(play(program, np.array([0.0, 0.0, 4.0]), np.array([1.0, 0.0, 0.0]))) == [0.0, 0.0, 0.0]
    limit = record(lambda x, y: x**-0.073 * y)
    assert list(play(limit, np.array([0.0, 1.0]), np.array([2.0, 2.0]))) == [np.inf, 2.0]


def test_equal_steps_are_shared():
    """Whoever computes the same thing twice computes it once."""
    once = record(lambda x, y: np.exp(x + y))
    twice = record(lambda x, y: np.exp(x + y) + np.exp(x + y))
    assert functions_of(once) == [np.add, np.exp]
    assert functions_of(twice) == [np.add, np.exp, np.add]


def test_logarithms_are_shared_between_products():
    """One logarithm a base, one exponential a product, whatever the number of powers."""
    program = record(lambda x, y: x**0.66 * y**0.47 + x**0.68 * y**-0.073)
    functions = functions_of(program)
    assert functions.count(np.log) == 2
    assert functions.count(np.exp) == 2
    assert np.power not in functions


def test_constants_fold():
    """Factors are gathered into one, and cost one step at most."""
    program = record(lambda x, y: 2 * (3 * x) * (y / 4) * 5)
    assert functions_of(program) == [np.multiply, np.multiply]
    assert len(record(lambda x, y: 2 * x / 2 * y).steps) == 1


def test_unneeded_steps_are_dropped():
    """What no output needs is not played."""
    tape = Tape(2)
    x, y = tape.value(0), tape.value(1)
    needless = np.exp(np.sin(x) + y)
    needed = np.cos(y)
    assert needless.index != needed.index
    program = Program.of(tape, {"out": needed})
    assert functions_of(program) == [np.cos]
    assert np.allclose(play(program), np.cos(Y), rtol=0, atol=0)


def test_sweeps_drop_what_is_not_asked_for(seed_screw, seed_oil):
    """Asking a result for less makes a shorter program; that of the ideal torque has no step of friction."""
    model = bs.FrictionModel.corrected()

    def program(*names):
        tape = Tape(2)
        with np.errstate(all="ignore"):
            r = model(seed_screw, seed_oil, axial_load=tape.value(0), screw_speed=tape.value(1))
            return Program.of(tape, {name: getattr(r, name) for name in names})

    load_next_to_zero_is_none = [np.abs, np.less, choose]
    assert functions_of(program("ideal_torque")) == [*load_next_to_zero_is_none, np.multiply]
    lengths = [len(program(*names).steps) for names in (["screw_torque"], ["screw_torque", "friction_power", "valid"])]
    assert 4 < lengths[0] < lengths[1]


def test_buffers_are_used_again():
    """A long chain needs few buffers: each is given up after its last use."""

    def chain(x, y):
        for _ in range(20):
            x = np.sin(x + y)
        return x

    program = record(chain)
    assert len(program.steps) == 40
    assert len(Interpreter(program).buffers) <= 3
    expected = X
    for _ in range(20):
        expected = np.sin(expected + Y)
    assert np.array_equal(play(program), expected)


def test_inputs_are_never_written_to():
    x, y = X.copy(), Y.copy()
    program = record(lambda x, y: np.where(x > 1, np.exp(x), np.sin(y)) * x + y)
    play(program, x, y)
    assert np.array_equal(x, X)
    assert np.array_equal(y, Y)


def test_programs_can_be_played_again_on_other_sizes():
    program = record(lambda x, y: np.exp(x) + y**0.5)
    for size in (3, 1, 5, 2):
        assert np.allclose(play(program, X[:size], Y[:size]), np.exp(X[:size]) + Y[:size] ** 0.5, rtol=1e-15)


def test_constant_and_input_outputs():
    """An output may be a number, or an input as it came."""
    tape = Tape(1)
    program = Program.of(tape, {"constant": 4.5, "input": tape.value(0), "mask": tape.value(0) > 1})
    results = {"constant": np.empty(5), "input": np.empty(5), "mask": np.empty(5, dtype=bool)}
    Interpreter(program).run([X], results)
    assert np.array_equal(results["constant"], np.full(5, 4.5))
    assert np.array_equal(results["input"], X)
    assert np.array_equal(results["mask"], X > 1)


def test_no_truth_value():
    """An ``if`` on values would take one branch for all of them: it is refused."""
    x = Tape(1).value(0)
    with pytest.raises(TypeError, match="use where"):
        bool(x > 1)
    with pytest.raises(TypeError, match="truth"):
        _ = 1 if x else 0
    with pytest.raises(TypeError, match="truth"):
        _ = 0 < x < 1


@pytest.mark.parametrize(
    "function",
    [
        lambda x: x[0],
        lambda x: x[x > 1],
        lambda x: x + np.ones(3),
        lambda x: np.interp(x, [0, 1], [0, 1]),
        lambda x: np.sum(x),
        lambda x: np.maximum.reduce(x),
        lambda x: np.clip(x, 0, 1),
        lambda x: np.modf(x),
        lambda x: np.multiply(x, 2, out=np.empty(3)),
        lambda x: float(x),
        lambda x: [*x],
    ],
)
def test_what_is_not_elementwise_cannot_be_recorded(function):
    """Refused with TypeError, on which a sweep turns to plain arrays."""
    with pytest.raises(TypeError):
        function(Tape(1).value(0))


def test_a_mask_knows_that_it_is_one():
    tape = Tape(2)
    x, y = tape.value(0), tape.value(1)
    for mask in (x > y, (x > 1) & (y > 1), ~(x == 0), (x > 1) | True, np.isfinite(x), np.logical_not(x > 1)):
        assert isinstance(mask, Traced)
        assert tape.is_mask(mask.index)
    for value in (x, x + y, np.where(x > 1, x, y), (x > 1) * 2.0):
        assert not tape.is_mask(value.index)


def test_models_can_be_recorded(seed_screw, seed_oil, model):
    """The models themselves take the fast path, with fields of screw, oil and laws traced too."""
    tape = Tape(6)
    load, speed, viscosity, diameter, conformity, friction = map(tape.value, range(6))
    screw = dataclasses.replace(seed_screw, ball_diameter=diameter, nut_conformity=conformity)
    oil = dataclasses.replace(seed_oil, viscosity=viscosity)
    law = dataclasses.replace(model.friction, boundary_friction_coefficient=friction)
    traced = dataclasses.replace(model, friction=law)
    with np.errstate(all="ignore"):
        r = traced(screw, oil, axial_load=load, screw_speed=speed)
        assert isinstance(r.screw_torque, Traced)
        program = Program.of(tape, {"out": r.screw_torque})
    values = (4000.0, 60.0, 0.1, 3.175e-3, 0.515, model.friction.boundary_friction_coefficient)
    found = play(program, *(np.full(2, v) for v in values))
    plain = model(seed_screw, seed_oil, axial_load=4000.0, screw_speed=60.0).screw_torque
    assert np.allclose(found, plain, rtol=1e-13, atol=0)


NEGATIVE = np.array([-2.0, 2.0, -2.0, 0.0, -1.0])
MIXED = np.array([-3.0, 3.0, 3.0, 1.0, 1.0])


@pytest.mark.parametrize(
    "function",
    [
        lambda x, y: (x**2) ** 0.3 + 0 * y,
        lambda x, y: np.sqrt(x * y),
        lambda x, y: (x / y) ** 0.3,
        lambda x, y: ((x * y) ** 2) ** 0.25,
        lambda x, y: ((x - 1) ** 2 * y**2) ** 0.3,
        lambda x, y: (-2.0) ** y + x,
        lambda x, y: (x**3 * y) ** 0.7,
    ],
)
def test_factors_may_be_negative_where_the_product_is_not(function):
    """A broken power is taken of each factor only where that is the same."""
    with np.errstate(all="ignore"):
        expected = function(NEGATIVE, MIXED)
    assert np.allclose(play(record(function), NEGATIVE, MIXED), expected, rtol=1e-14, equal_nan=True)


def test_nothing_times_infinity_behind_a_mask():
    function = lambda x, y: np.where(x > 1, 0.0, x * np.inf) + y  # noqa: E731  (as short as those above)
    with np.errstate(all="ignore"):
        expected = function(X, Y)
    assert np.array_equal(play(record(function)), expected, equal_nan=True)
