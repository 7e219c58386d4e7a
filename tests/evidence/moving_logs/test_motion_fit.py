"""Fits of synthetic logs, whose truth is known."""

import dataclasses
import time

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.moving_logs.equation import Equation, dead_time
from ballscrew.evidence.moving_logs.motion_fit import LINEAR, POWER, SCREW
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.evidence.moving_logs.power_law import power_law
from ballscrew.evidence.moving_logs.screw_model import NAMES, ScrewFriction, linear_model
from support.moving_logs import MODEL, OIL, SCREW_OF, TRUTH, record, strokes

TRUE = np.array([TRUTH[name] for name in NAMES])


def equation(**options):
    return Equation.of(MovingLog.of(record(**options)).checked())


def test_without_noise_the_truth_comes_out():
    found = linear_model(equation(noise=0.0))
    assert found.identified == (True,) * 4
    # what is left is of the corners, rounded within a few steps of time
    np.testing.assert_allclose(found.values, TRUE, rtol=1e-3)


@pytest.mark.slow
def test_intervals_hold_where_ordinary_ones_do_not():
    """40 logs with noise that lasts 0.2 s: an interval of 95 % misses more than 8 of 40 in one of 10 000 runs."""
    covered, ordinary = np.zeros(4), np.zeros(4)
    for seed in range(40):
        found = linear_model(equation(correlation=0.2, seed=seed))
        off = np.abs(found.values - TRUE)
        solved = found.solution
        plain = np.sqrt(np.var(solved.residuals) * np.diag(np.linalg.inv(solved.slopes.T @ solved.slopes)))
        covered += off <= solved.half_width()
        ordinary += off <= 1.96 * plain
    assert covered.min() >= 32
    assert ordinary.min() < 20


def test_the_exponent_of_the_speed_and_its_interval():
    found = power_law(equation(friction=lambda v: 15.0 + 150.0 * v**0.6, noise=0.5))
    assert found is not None
    assert found.interval[0] < 0.6 < found.interval[1] < 1.0
    low, high = found.interval
    assert low <= found.bootstrap[0] < found.exponent < found.bootstrap[1] <= high
    assert found.constant_force == pytest.approx(15.0, abs=4.0)
    assert set(found.choices) >= {"first half", "forward", "without speeds below 10%"}


def test_a_dead_time_of_several_steps_is_found_and_taken_off():
    delay, corrected = dead_time(equation(delay=6e-3))
    assert delay.value == pytest.approx(6e-3, abs=3e-4)
    assert delay.corrected
    np.testing.assert_allclose(linear_model(corrected).values, TRUE, rtol=0.05)
    none, same = dead_time(equation())
    assert abs(none.value) <= none.half_width
    assert not none.corrected
    assert same.shift == 0.0


@pytest.fixture(scope="module")
def of_the_screw():
    """A log of an axis with the friction of a screw, whose oil is twice as thick as its case says."""
    truth = Configuration(MODEL, SCREW_OF, dataclasses.replace(OIL, viscosity=0.1))
    friction = ScrewFriction.of(truth, ["viscosity"], 0.13, 250.0)
    table = friction.table(np.array([0.1]))
    data = record(friction=lambda v: 5.0 + table(v, np.zeros_like(v)), noise=0.3)
    other = record(
        strokes(speeds=(0.02, 0.06, 0.1)), friction=lambda v: 5.0 + table(v, np.zeros_like(v)), noise=0.3, seed=1
    )
    return bs.fit_motion(MODEL, SCREW_OF, OIL, data, carried_mass=0.0, test=other)


def test_the_viscosity_of_the_screw_is_found(of_the_screw):
    estimate = of_the_screw.estimates["viscosity"]
    assert estimate.interval[0] < 0.1 < estimate.interval[1]
    assert estimate.value == pytest.approx(0.1, rel=0.3)
    assert of_the_screw.estimates["mass"].value == pytest.approx(95.0, rel=5e-3)
    assert of_the_screw.estimates["carried_mass"].given
    assert of_the_screw.screw.table_error < 1e-3


def test_the_physical_model_is_nearer_than_the_linear_one_here_and_on_the_other_log(of_the_screw):
    for errors in (of_the_screw.relative_errors, of_the_screw.cross_errors):
        assert errors[SCREW] < errors[LINEAR]
        assert set(errors) == {LINEAR, POWER, SCREW}
    assert of_the_screw.model == SCREW
    assert of_the_screw.cross_error == of_the_screw.cross_errors[SCREW]


def test_the_effect_of_the_filter_is_reported(of_the_screw):
    assert len(of_the_screw.filter_effects) == 4
    for effect in of_the_screw.filter_effects:
        assert effect.values[0] == pytest.approx(95.0, rel=0.02)


# -- what a log does not tell ---------------------------------------------------------------------


def records_of(data, **options):
    found = bs.fit_motion(MODEL, SCREW_OF, OIL, data, **options)
    return found, {record.subject: record.text for record in found.warning_records if record.id == "fit.not_identified"}


def test_one_direction_does_not_tell_gravity_from_friction():
    data = record(np.abs(strokes()), noise=0.3)
    found, texts = records_of(data)
    assert not found.estimates["offset"].identified
    assert not found.estimates["coulomb_force"].identified
    (text,) = [text for subject, text in texts.items() if {"offset", "coulomb_force"} <= {*subject.split(",")}]
    assert "record strokes in both directions" in text
    assert found.estimates["mass"].value == pytest.approx(95.0, rel=0.02)


def test_a_log_whose_ramps_are_too_slow_does_not_tell_the_mass():
    speed = strokes(speeds=(0.05, 0.1), acceleration=0.005, hold=1.0, rest=0.5, repeats=1, step=5e-3)
    found, texts = records_of(record(speed, step=5e-3, noise=8.0, correlation=0.5))
    assert not found.estimates["mass"].identified
    assert found.estimates["mass"].interval is None
    (text,) = [text for subject, text in texts.items() if "mass" in subject.split(",")]
    assert "ramps" in text
    assert found.screw is None
    assert any(record.id == "fit.no_screw_model" for record in found.warning_records)


@pytest.mark.slow
def test_gravity_and_the_zero_of_the_sensor_are_named_as_one(of_the_screw):
    assert any(record.id == "fit.gravity_or_offset" for record in of_the_screw.warning_records)


@pytest.mark.slow
@pytest.mark.implausible
def test_a_screw_with_more_friction_than_the_axis_is_said_not_to_fit():
    heavy = dataclasses.replace(SCREW_OF, nut=bs.DoubleNut(preload=5000.0))
    log, oil = record(noise=0.3), bs.Lubricant(viscosity=1.0)
    freed = bs.fit_motion(MODEL, heavy, oil, log, carried_mass=0.0)
    assert any(record.id == "fit.preload_freed" for record in freed.warning_records)
    assert freed.estimates["nut.preload"].value < 1000.0
    found = bs.fit_motion(MODEL, heavy, oil, log, ["viscosity"], carried_mass=0.0)
    assert found.model == LINEAR
    (text,) = [record.text for record in found.warning_records if record.id == "fit.screw_model_off"]
    assert "--free viscosity,nut.preload" in text


@pytest.mark.long
def test_25_000_rows_are_fitted_within_10_seconds():
    """A table of friction stands for the model, which would be evaluated at every row in each step."""
    moment = 1e-3 * np.arange(25_000)
    slow, fast = 2 * np.pi * 0.31, 2 * np.pi * 0.83
    speed = 0.1 * slow * np.cos(slow * moment) + 0.02 * fast * np.cos(fast * moment)
    data = record(speed, step=1e-3, noise=1.0)
    begun = time.perf_counter()
    found = bs.fit_motion(MODEL, SCREW_OF, OIL, data)
    assert time.perf_counter() - begun < 10.0
    assert len(found.equation.speed) == 25_000
    assert found.estimates["mass"].value == pytest.approx(95.0, rel=0.02)
