"""The test that teaches most: its formula, its limits, and that it does teach more than random ones."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.evidence.calibration.fit import fit
from ballscrew.evidence.calibration.next_test import RANGE_FACTOR, TEMPERATURE_MARGIN, next_test
from ballscrew.evidence.papers.olaru2005.case import SCREW
from support.synthetic_logs import OIL, RPM, log, truth

PAPER = bs.FrictionModel.olaru2005()
FRICTION, SEALS = "boundary_friction_coefficient", "constant_torque"


@pytest.fixture(scope="module")
def both():
    """Both directions, with the zero error of a sensor and its drift; the oil is known exactly."""
    return fit(PAPER, SCREW, OIL, log(truth()), [FRICTION, SEALS], temperature_error=0.0)


def information(found):
    """Of all parameters of a fit, those that are open known to their own size; rows by rows, without outliers."""
    total = np.diag(1 / found.uncertainty.scale**2)
    solution = found.solution
    u = (solution.residuals / solution.scatter / 4.685) ** 2
    rows = np.flatnonzero(u < 1)
    # the derivative of the pull of Tukey's biweight
    curvature = np.mean((1 - u[rows]) * (1 - 5 * u[rows]))
    for row in rows:
        total = total + curvature * np.outer(solution.slopes[row], solution.slopes[row]) / solution.scatter[row] ** 2
    return total


def test_what_remains_is_the_inverse_of_the_sum_of_both_informations(both):
    """Here readings are added one by one; their derivatives are differences of the model itself."""
    readings, count = 10, 2
    proposal = both.next_test(readings=readings)
    before = information(both)
    for place in (0, 100, -1, int(np.argmin(proposal.remaining_volume))):
        load, speed = (float(proposal.tests[name][place]) for name in ("axial_load", "screw_speed"))
        coefficient = both.estimates[FRICTION].value

        def torques(value, load=load, speed=speed):
            friction = dataclasses.replace(PAPER.friction, boundary_friction_coefficient=value)
            model = dataclasses.replace(PAPER, friction=friction)
            result = model(SCREW, OIL, axial_load=load, screw_speed=speed)
            return np.array([result.ideal_torque, result.screw_torque])

        ideal, friction = torques(coefficient)
        slope = (torques(coefficient + 1e-6) - torques(coefficient - 1e-6))[1] / 2e-6
        after = before
        for reading in range(readings):
            sign = 1 if reading % 2 else -1
            # friction and seals turn with the direction, the zero error does not, and how it moves is not known by then
            row = np.array([sign * slope, sign, 1.0, *[0.0] * (len(both.sensor) - 1)])
            row = row / both.solution.noise.of(ideal + sign * friction)
            after = after + np.outer(row, row)
        volumes = [np.sqrt(np.linalg.det(np.linalg.inv(total)[:count, :count])) for total in (after, before)]
        assert proposal.remaining_volume[place] == pytest.approx(volumes[0] / volumes[1], rel=1e-5)
    errors = [np.sqrt(np.diagonal(np.linalg.inv(total)))[:count] for total in (after, before)]
    assert list(proposal.remaining_error.values()) == pytest.approx(list(errors[0] / errors[1]), rel=1e-5)


def test_more_readings_leave_less_and_none_leaves_more_than_there_was(both):
    few, many = (both.next_test(readings=readings) for readings in (2, 200))
    assert np.all(many.remaining_volume < few.remaining_volume)
    assert np.all(few.remaining_volume <= 1)
    assert np.all(many.remaining_volume > 0)
    assert few.best_volume <= few.random_volume


def test_the_best_is_the_least_of_all_that_were_thought_of(both):
    proposal = both.next_test()
    place = int(np.argmin(proposal.remaining_volume))
    assert proposal.best == {name: values[place] for name, values in proposal.tests.items()}
    assert proposal.best_volume == proposal.remaining_volume.min()
    assert proposal.readings == 20
    assert set(proposal.remaining_error) == {FRICTION, SEALS}


def test_limits_are_kept_and_without_any_the_log_is_taken_twice_as_far(both):
    asked = {"axial_load": (900.0, 1100.0), "screw_speed": (10 * RPM, 20 * RPM)}
    for name, (low, high) in asked.items():
        values = both.next_test(asked).tests[name]
        assert values.min() == pytest.approx(low)
        assert values.max() == pytest.approx(high)
        assert np.all((values >= low * (1 - 1e-12)) & (values <= high * (1 + 1e-12)))
    load = both.rows.log.axial_load
    values = both.next_test().tests["axial_load"]
    assert values.min() == pytest.approx(load.min() / RANGE_FACTOR)
    assert values.max() == pytest.approx(load.max() * RANGE_FACTOR)


def test_temperatures_are_conditions_of_an_oil_by_its_grade():
    oil = bs.Lubricant.from_grade("ISO VG 100")
    found = fit(PAPER, SCREW, oil, log(truth(), oil=oil, temperatures=(300, 330)), [FRICTION])
    temperatures = found.next_test().tests["temperature"]
    measured = found.rows.log.temperature
    assert temperatures.min() == pytest.approx(measured.min() - TEMPERATURE_MARGIN)
    assert temperatures.max() == pytest.approx(measured.max() + TEMPERATURE_MARGIN)
    with pytest.raises(InputError, match=r"fit\.limits\.oil: is no condition"):
        found.next_test({"oil": (0, 1)})


@pytest.mark.parametrize(
    ("limits", "words"),
    [
        ({"temperature": (300, 330)}, r"fit\.limits\.temperature: is no condition of a test"),
        ({"axial_lod": (1, 2)}, r"fit\.limits\.axial_lod: is no condition of a test.*axial_load"),
        # beyond the pressure that the model is valid to
        ({"axial_load": (1e9, 2e9)}, "no valid point within the limits"),
    ],
)
def test_limits_that_cannot_be_reached_are_refused(limits, words, both):
    with pytest.raises(InputError, match=words):
        both.next_test(limits)


def test_points_that_are_not_valid_are_not_proposed(both):
    wide = both.next_test({"axial_load": (1e3, 1e6)})
    result = both.model(both.screw, both.lubricant, **wide.tests)
    assert result.valid.all()
    assert not both.model(both.screw, both.lubricant, axial_load=1e6, screw_speed=1.0).valid
    assert wide.tests["axial_load"].max() < 1e6


def test_one_direction_is_asked_for_where_the_log_has_one():
    """Then all readings count the same; half of them in reverse would be another test."""
    found = fit(PAPER, SCREW, OIL, log(truth(), both=False), [FRICTION])
    readings = 12
    proposal = found.next_test(readings=readings)
    place = int(np.argmin(proposal.remaining_volume))
    load, speed = (proposal.tests[name][place : place + 1] for name in ("axial_load", "screw_speed"))
    torques, slopes = found.response.at({"axial_load": load, "screw_speed": speed})(found.solution.values[:1])
    assert list(found.sensor) == ["torque_drift"]
    row = np.array([slopes[1, 0, 0], 0.0]) / found.solution.noise.of(torques.sum())
    before = information(found)
    after = before + readings * np.outer(row, row)
    volumes = [np.sqrt(np.linalg.inv(total)[0, 0]) for total in (after, before)]
    assert proposal.best_volume == pytest.approx(volumes[0] / volumes[1], rel=1e-9)


def test_the_same_every_time(both):
    one, other = next_test(both, seed=1), next_test(both, seed=1)
    assert one.best == other.best
    assert one.random_volume == other.random_volume


@pytest.mark.slow
def test_it_teaches_more_than_random_tests_when_it_is_run():
    """Friction and seals of a log with high loads only: run on the truth ten minutes later, and fitted again."""
    random, true = np.random.default_rng(0), truth(bs.FrictionModel.corrected())
    limits = {"axial_load": (100.0, 8000.0), "screw_speed": (5 * RPM, 3000 * RPM)}

    def read(load, speed, sign, time):
        torque = sign * (true(SCREW, OIL, axial_load=load, screw_speed=speed).screw_torque + 0.05)
        torque = torque + 0.02 * time / 3600 + random.normal(0, 0.01, time.size)
        return {"axial_load": load, "screw_speed": sign * speed, "time": time, "torque": torque}

    def fitted(columns):
        free, model = [FRICTION, SEALS], bs.FrictionModel.corrected()
        return fit(model, SCREW, OIL, columns, free, kind="friction", holdout=0.0, temperature_error=0.0)

    def volume(found):
        return np.sqrt(np.linalg.det(found.uncertainty.covariance[:2, :2]))

    speeds = np.exp(random.uniform(*np.log((10, 1000)), 300)) * RPM
    rows = read(random.uniform(2000, 4000, 300), speeds, random.choice([-1.0, 1.0], 300), np.linspace(0, 3600, 300))
    found = fitted(rows)

    def left(load, speed):
        sign = np.repeat([1.0, -1.0], 10)
        more = read(np.full(20, load), np.full(20, speed), sign, np.linspace(4200, 4260, 20))
        return volume(fitted({name: np.concatenate([rows[name], more[name]]) for name in rows})) / volume(found)

    proposal = found.next_test(limits, 20)
    low, high = np.log(np.array(list(limits.values())).T)
    by_chance = np.median([left(*np.exp(random.uniform(low, high))) for _ in range(10)])
    proposed = left(proposal.best["axial_load"], proposal.best["screw_speed"])
    assert proposed < 0.6 * by_chance
    # readings that come later than the log also have its drift
    assert proposal.best_volume < proposed < 1.5 * proposal.best_volume
