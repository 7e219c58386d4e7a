"""Friction after a reversal in exports with a state: each against ``gms_torque`` with the elements of the physics."""

import ctypes
import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.exports import hand_over
from ballscrew.exports.export import Export
from ballscrew.exports.programs import c99
from ballscrew.exports.programs.presliding import OPTIONS, options_of_case, presliding
from ballscrew.physics.moving_balls.friction_states import (
    SlipElement,
    WindingUp,
    error_of,
    fit_slip_elements,
    gms_torque,
    of_elements,
)
from ballscrew.physics.moving_balls.reversal import loops, reversal

from .compiled import library, needs_a_compiler
from .conftest import OIL

pytestmark = pytest.mark.slow

LOAD, SPEED, COUNT = 2000.0, 0.6, 3
ASKED = {"presliding": COUNT, "presliding_load": LOAD, "presliding_speed": SPEED}
#: Rounding, as a share of the steady torque: every step of the state is one of gms_torque.
ROUNDING = 1e-12
SCREW = bs.catalogue()["rexroth-16x5x3-4-double"].screw(nut=bs.DoubleNut(preload=900.0))
MODEL = bs.FrictionModel.reference()


@pytest.fixture(scope="module")
def curve():
    operation = {"axial_load": LOAD, "screw_speed": SPEED}
    after = reversal(MODEL, SCREW, OIL, **operation)
    return WindingUp.of(after, loops(MODEL, SCREW, OIL, after, **operation))


@pytest.fixture(scope="module")
def fit(curve):
    return fit_slip_elements(curve, COUNT)


@pytest.fixture(scope="module")
def path():
    """Angles, rad: small and large loops with turning points within others, steps of any size, and rests."""
    random = np.random.default_rng(7)
    steps = random.normal(size=600) * 10.0 ** random.uniform(-5, 0.5, 600)
    steps[random.random(600) < 0.1] = 0.0
    return np.concatenate([[0.0], np.cumsum(steps)])


def wanted(elements, at_once, angles):
    """The torque along a path by the physics, N m."""
    return gms_torque(elements, angles) + at_once * np.sign(np.diff(angles, prepend=angles[:1]))


def of_shares(found, torque):
    """The elements that an export has at a steady torque."""
    return [
        SlipElement(stiffness=one.share * torque / one.slip_angle, slip_torque=one.share * torque)
        for one in found.elements
    ]


# -- the elements ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def handed(handed_over):
    return handed_over(MODEL, SCREW.nut, **ASKED)


@pytest.fixture(scope="module")
def elements(handed):
    return presliding(handed)


def test_the_shares_are_of_the_steady_torque_and_sum_to_it(elements, curve, fit):
    assert elements.at_once + sum(one.share for one in elements.elements) == pytest.approx(1.0, rel=1e-9)
    assert elements.at_once == pytest.approx(curve.at_once / curve.steady_torque, rel=1e-12)
    for found, fitted in zip(of_shares(elements, curve.steady_torque), fit.elements, strict=True):
        assert found.stiffness == pytest.approx(fitted.stiffness, rel=1e-12)
        assert found.slip_torque == pytest.approx(fitted.slip_torque, rel=1e-12)


def test_the_error_told_is_that_of_the_elements_handed_over(elements, curve):
    off = error_of(curve, of_elements(of_shares(elements, curve.steady_torque), curve))
    assert elements.fit.error.largest == pytest.approx(off.largest, rel=1e-9)
    assert 0 < off.largest < 0.2


def test_without_the_option_there_is_none(handed_over):
    assert presliding(handed_over(MODEL, SCREW.nut)) is None


def test_a_case_gives_its_operating_point(example):
    operation = case_file.load(example).operation
    assert options_of_case(case_file.load(example)) == {
        "presliding_load": operation.axial_load,
        "presliding_speed": operation.screw_speed,
    }


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"presliding": 5}, "hand_over.presliding: must be 0 to 4"),
        ({"presliding": -1}, "hand_over.presliding: must be 0 to 4"),
        ({"presliding_load": float("nan")}, "hand_over.presliding_load: is needed for the reversal"),
        ({"presliding_speed": float("nan")}, "hand_over.presliding_speed: is needed for the reversal"),
        ({"presliding_speed": 0.0}, "hand_over.presliding_speed: must not be zero"),
    ],
)
def test_faults_name_the_option(handed, change, expected):
    asked = dataclasses.replace(handed, options={**handed.options, **change})
    with pytest.raises(bs.InputError, match=expected):
        presliding(asked)


def test_a_model_without_slip_across_the_path_is_refused(handed_over):
    with pytest.raises(bs.InputError, match="knows no slip across the path"):
        presliding(handed_over(bs.FrictionModel.olaru2005(), SCREW.nut, **ASKED))


# -- C -----------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def exported(handed):
    return c99.export(handed)


@pytest.fixture(scope="module")
def turned(exported, tmp_path_factory):
    """A function of a path, a steady torque and the direction before: the torque by the compiled source."""
    folder = tmp_path_factory.mktemp("presliding")
    exported.write(folder)
    made = library(folder, folder / "ballscrew_presliding.c")
    turn, start = made.ballscrew_presliding_turn, made.ballscrew_presliding_start
    turn.argtypes, turn.restype = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double], ctypes.c_double
    start.argtypes, start.restype = [ctypes.c_void_p, ctypes.c_double], None

    def along(angles, torque, before=0.0):
        state = (ctypes.c_double * COUNT)(*[np.nan] * COUNT)
        start(state, before)
        return np.array([turn(state, step, torque) for step in np.diff(angles, prepend=angles[:1])])

    return along


@needs_a_compiler
def test_compiled_is_gms_torque(turned, curve, fit, path):
    steady = float(curve.steady_torque)
    found = turned(path, steady)
    np.testing.assert_allclose(found, wanted(fit.elements, curve.at_once, path), rtol=0, atol=ROUNDING * steady)
    assert np.ptp(found) > 1.5 * steady  # the path slides both ways


@needs_a_compiler
def test_compiled_scales_with_the_steady_torque(turned, curve, path):
    np.testing.assert_allclose(turned(path, 0.5), turned(path, 1.0) / 2, rtol=1e-15)


@needs_a_compiler
def test_compiled_goes_from_one_steady_torque_to_the_other(turned, curve):
    angles = np.asarray(curve.screw_angle, dtype=float)
    steady = float(curve.steady_torque)
    found = turned(angles, steady, before=-1.0)
    assert found[1] < -0.5 * steady + 2 * curve.at_once
    assert turned(np.array([0.0, 10.0]), steady, before=-1.0)[-1] == pytest.approx(steady, rel=1e-9)
    held = -np.array([one.slip_torque for one in fit_slip_elements(curve, COUNT).elements])
    back = gms_torque(fit_slip_elements(curve, COUNT).elements, angles, initial_torques=held)
    np.testing.assert_allclose(found[1:], back[1:] + curve.at_once, rtol=0, atol=ROUNDING * steady)


def test_the_text_says_hypothesis_point_and_error(exported, elements):
    text = exported.files["README.txt"].decode()
    assert "HYPOTHESIS" in text
    assert f"axial_load = {LOAD!r} N, screw_speed = {SPEED!r} rad/s" in text
    assert f"off by up to {elements.fit.error.largest:.2g} of the steady torque" in text
    for loop in elements.fit.loops:
        assert f"stroke of +-{np.degrees(loop.stroke / 2):g} deg of the screw: {loop.work_ratio:.3g}\n" in text
    (said,) = [record for record in exported.warnings if record.id == "hand_over.presliding"]
    assert "is a hypothesis" in said.text
    assert "2 kN" in said.text
    assert f"up to {elements.fit.work_error:.0%} of the friction work of short strokes" in said.text


def test_an_export_without_the_option_is_as_it_was(handed_over):
    without: Export = c99.export(handed_over(MODEL, SCREW.nut))
    assert set(without.files) == {"ballscrew.c", "ballscrew.h", "main.c", "test_vector.csv", "README.txt"}
    assert not any(b"presliding" in content or b"HYPOTHESIS" in content for content in without.files.values())
    assert not any(record.id == "hand_over.presliding" for record in without.warnings)


def test_the_option_adds_files_and_leaves_the_model_alone(exported, handed_over):
    without = c99.export(handed_over(MODEL, SCREW.nut)).files
    assert set(exported.files) - set(without) == {"ballscrew_presliding.c", "ballscrew_presliding.h"}
    assert all(exported.files[name] == without[name] for name in without if name != "README.txt")


def test_the_options_are_read_from_text(example):
    case = case_file.load(example.parent / "feed_drive.toml", ["operation.screw_speed=6 rpm"])
    made = hand_over.of_case(case, "c", hand_over.Request(options=["presliding=2", "presliding_load=1 kN"]))
    assert "axial_load = 1000.0 N, screw_speed = 0.6283185307179586 rad/s" in made.files["README.txt"].decode()
    assert list(OPTIONS) == ["presliding", "presliding_load", "presliding_speed"]
