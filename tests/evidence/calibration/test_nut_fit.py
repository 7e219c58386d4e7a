"""Fits of preloaded nuts with a known truth: preload and seals, without load and loaded, and what cannot be told."""

import dataclasses
import functools

import numpy as np
import pytest
from scipy.stats import binom

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.calibration import fit as calibration
from ballscrew.evidence.calibration import next_test
from ballscrew.evidence.calibration.response import Response
from support.strategies import MODELS
from support.synthetic_logs import OIL

MODEL = MODELS["olaru2005"]
#: The oil of these logs is exactly as warm as said.
fit = functools.partial(calibration.fit, temperature_error=0.0)
PRELOAD, SEALS, FRICTION = "nut.preload", "constant_torque", "boundary_friction_coefficient"
TRUE_PRELOAD, TRUE_SEALS = 3000.0, 0.12
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=4326.0))
TRUTH = dataclasses.replace(
    SCREW, nut=bs.DoubleNut(preload=TRUE_PRELOAD, losses={"seals": bs.Seals(seal_torque=TRUE_SEALS)})
)
WITHOUT_SEALS = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=TRUE_PRELOAD))
#: Logs of each kind, and of those that ``make test-all`` runs.
SEEDS, MANY = 10, 200
#: How often intervals that are right fail a test of ``SEEDS`` logs.
FALSE_ALARM = 1e-3
#: The load at which the relieved half of the true nut lifts off, about.
LIFT_OFF = 2.8 * TRUE_PRELOAD
CASES = {
    "preload, no load": ([PRELOAD], WITHOUT_SEALS, 0.0),
    "preload, loaded": ([PRELOAD], WITHOUT_SEALS, LIFT_OFF),
    "preload and seals, no load": ([PRELOAD, SEALS], TRUTH, 0.0),
    "preload and seals, loaded": ([PRELOAD, SEALS], TRUTH, LIFT_OFF),
}


def nut_log(screw, seed, largest_load, rows=120):
    """A log of both directions at random loads up to one and random speeds: noise, a drift of the zero, outliers."""
    rng = np.random.default_rng(seed)
    load = rng.uniform(0.0, largest_load, rows) if largest_load else np.zeros(rows)
    speed = np.exp(rng.uniform(np.log(1.0), np.log(300.0), rows)) * np.where(np.arange(rows) % 2, 1, -1)
    result = MODEL(screw, OIL, axial_load=load, screw_speed=speed)
    torque, usual = result.drive_torque, float(np.median(result.screw_torque))
    torque = torque + 0.01 * usual * rng.standard_normal(rows) + 0.02 * usual * np.linspace(-0.5, 0.5, rows)
    torque = torque + np.where(rng.random(rows) < 0.05, 0.3 * usual * rng.standard_normal(rows), 0.0)
    return {"axial_load": load, "screw_speed": speed, "torque": torque, "time": np.arange(rows, dtype=float)}


def covered(name, seeds):
    """For each estimate and seed: does the interval of 95 % hold the truth?"""
    free, screw, largest_load = CASES[name]
    true = {PRELOAD: TRUE_PRELOAD, SEALS: TRUE_SEALS}
    hits = []
    for seed in range(seeds):
        found = fit(MODEL, SCREW, OIL, nut_log(screw, seed, largest_load), free)
        row = []
        for number in free:
            interval = found.estimates[number].interval()
            row.append(None if interval is None else interval[0] <= true[number] <= interval[1])
        hits.append(row)
    return list(zip(*hits, strict=True))


@pytest.mark.slow
@pytest.mark.usefixtures("quick_baselines")
@pytest.mark.parametrize("name", CASES)
def test_intervals_hold_the_preload(name):
    for hits in covered(name, SEEDS):
        told = [hit for hit in hits if hit is not None]
        assert len(told) >= 0.9 * SEEDS
        assert np.sum(told) >= binom.ppf(FALSE_ALARM, len(told), 0.95)


@pytest.mark.usefixtures("quick_baselines")
@pytest.mark.long
@pytest.mark.parametrize("name", CASES)
def test_intervals_of_95_percent_hold_the_preload_in_90_to_99_percent_of_logs(name):
    for hits in covered(name, MANY):
        told = [hit for hit in hits if hit is not None]
        assert len(told) >= 0.9 * MANY
        assert 0.90 <= np.mean(told) <= 0.99


def at_one_point(seed, rows=60):
    """A log of one operating point, in both directions."""
    log = nut_log(WITHOUT_SEALS, seed, 0.0, rows)
    speed = 30.0 * np.sign(log["screw_speed"])
    torque = MODEL(WITHOUT_SEALS, OIL, axial_load=0.0 * speed, screw_speed=speed).drive_torque
    noise = 0.01 * np.abs(torque) * np.random.default_rng(seed).standard_normal(rows)
    return {**log, "screw_speed": speed, "torque": torque + noise}


def test_preload_and_friction_at_one_operating_point_are_one_number():
    found = fit(MODEL, SCREW, OIL, at_one_point(1), [PRELOAD, FRICTION])
    assert not any(estimate.identified for estimate in found.estimates.values())
    assert [combination.identified for combination in found.identifiability.combinations] == [True, False]
    assert found.next_test().best_volume < 0.3


@pytest.mark.slow
def test_a_range_of_loads_past_lift_off_tells_them_apart():
    found = fit(MODEL, SCREW, OIL, nut_log(WITHOUT_SEALS, 2, 3 * LIFT_OFF, rows=300), [PRELOAD, FRICTION])
    for number, true in ((PRELOAD, TRUE_PRELOAD), (FRICTION, 0.1)):
        estimate = found.estimates[number]
        assert estimate.identified, number
        if number == PRELOAD:
            low, high = estimate.interval(0.999)
            assert low <= true <= high


def test_the_fitted_torque_of_seals_is_in_all_that_follows():
    found = fit(MODEL, SCREW, OIL, nut_log(TRUTH, 3, 0.0), [PRELOAD, SEALS])
    seals = found.estimates[SEALS].value
    assert found.screw.nut.losses["constant"].constant_torque == seals
    alone = dataclasses.replace(found.screw, nut=dataclasses.replace(found.screw.nut, losses={}))
    with_it, without = (MODEL(s, OIL, axial_load=500.0, screw_speed=20.0).screw_torque for s in (found.screw, alone))
    assert with_it == pytest.approx(without + seals, rel=1e-12)
    assert found.predict(500.0, 20.0) == with_it
    assert found.band(500.0, 20.0).value == pytest.approx(with_it, rel=1e-9)
    again = fit(MODEL, found.screw, OIL, nut_log(TRUTH, 3, 0.0), [PRELOAD, SEALS])
    assert again.estimates[SEALS].value == pytest.approx(seals, rel=1e-6)


def test_rows_past_lift_off_are_said():
    found = fit(MODEL, SCREW, OIL, nut_log(WITHOUT_SEALS, 2, 2 * LIFT_OFF, rows=200), [PRELOAD])
    said = [record for record in found.warning_records if record.id == "fit.lift_off"]
    assert len(said) == 1
    assert said[0].value == pytest.approx(LIFT_OFF, rel=0.1)
    loads = nut_log(WITHOUT_SEALS, 2, 2 * LIFT_OFF, rows=200)["axial_load"]
    assert f"at {np.sum(loads >= said[0].value)} of 200 rows" in said[0].text
    assert not [
        r
        for r in fit(MODEL, SCREW, OIL, nut_log(WITHOUT_SEALS, 2, 0.0), [PRELOAD]).warning_records
        if "lift_off" in r.id
    ]


# -- elastic bodies -----------------------------------------------------------------------------------

ELASTIC = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=TRUE_PRELOAD, bodies=bs.Bodies()))


@pytest.mark.slow
def test_a_nut_of_elastic_bodies_is_fitted(quick_baselines):
    """Friction and seals are those of the nut, not those of rigid bodies, which would take the rest as friction."""
    model = MODELS["reference"]
    rng = np.random.default_rng(4)
    load, speed = np.tile([0.0, 3000.0, 9000.0], 20), np.tile(np.repeat([2.0, 8.0, 30.0, 90.0, 200.0], 3), 4)
    speed = speed * np.repeat([1.0, -1.0, -1.0, 1.0], 15)
    result = model(ELASTIC, OIL, axial_load=load, screw_speed=np.abs(speed))
    torque = result.screw_torque + TRUE_SEALS
    torque = np.sign(speed) * torque * (1.0 + 0.005 * rng.standard_normal(load.size))
    data = {"axial_load": load, "screw_speed": speed, "torque": torque}
    free, start = [FRICTION, SEALS], dataclasses.replace(model, friction=dataclasses.replace(
        model.friction, boundary_friction_coefficient=0.2))  # fmt: skip
    found = fit(start, ELASTIC, OIL, data, free, kind="friction")
    true = {FRICTION: model.friction.boundary_friction_coefficient, SEALS: TRUE_SEALS}
    for name, value in true.items():
        low, high = found.estimates[name].interval(1 - FALSE_ALARM)
        assert low < value < high, name
        assert high - low < 0.2 * value, name
    rigid = dataclasses.replace(ELASTIC, nut=bs.DoubleNut(preload=TRUE_PRELOAD))
    other = fit(start, rigid, OIL, data, free, kind="friction")
    low, high = other.estimates[FRICTION].interval(1 - FALSE_ALARM)
    assert not low < true[FRICTION] < high


def test_slopes_of_a_nut_of_elastic_bodies_are_those_of_the_model():
    """By differences of the model itself, with a hundred times the step."""
    model = MODELS["reference"]
    points = {"axial_load": np.array([0.0, 3000.0, 9000.0]), "screw_speed": np.array([2.0, 30.0, 200.0])}
    subject = Configuration(model, ELASTIC, OIL)
    names = ["friction.boundary_friction_coefficient", PRELOAD]
    response = Response.of(subject, names, points)
    torques, slopes = response(response.start)

    def friction(changes):
        made = subject.changed(changes)
        return made.model(made.screw, made.lubricant, **points).screw_torque

    assert torques[1] == pytest.approx(friction({}), rel=1e-9)
    for place, (name, value) in enumerate(zip(names, response.start, strict=True)):
        step = 1e-3 * value
        expected = (friction({name: value + step}) - friction({name: value - step})) / (2 * step)
        assert slopes[1, :, place] == pytest.approx(expected, rel=1e-4), name
    fewer = response.at({name: values[1:] for name, values in points.items()})
    assert fewer(response.start)[0] == pytest.approx(torques[:, 1:], rel=1e-9)


SMALL = bs.catalogue()["rexroth-25x5x3-4-double"].screw(nut=bs.DoubleNut(preload=1113.0, bodies=bs.Bodies()))
#: Loads of a nut whose bodies are strained otherwise under the opposite load.
SIGNED = {"negative": (-2000.0, -200.0), "both": (-2000.0, 1800.0)}


def signed_log(loads, *, column=lambda load, _: load):
    """Exact torques on the shaft in both directions; ``column`` makes what is logged of the load and the direction."""
    load, speed = np.tile(np.linspace(*loads, 4), 6), np.repeat([4.0, -4.0, 15.0, -15.0, 60.0, -60.0], 4)
    torque = MODELS["reference"](SMALL, OIL, axial_load=load, screw_speed=speed).drive_torque
    return {"axial_load": column(load, np.sign(speed)), "screw_speed": speed, "torque": torque}


def fit_from_elsewhere(data):
    """The friction and the preload, from a start off both."""
    model = MODELS["reference"]
    start = dataclasses.replace(model, friction=dataclasses.replace(model.friction, boundary_friction_coefficient=0.15))
    screw = dataclasses.replace(SMALL, nut=dataclasses.replace(SMALL.nut, preload=1400.0))
    found = fit(start, screw, OIL, data, [FRICTION, PRELOAD], holdout=0.0, engine="compiled")
    return found, (found.estimates[FRICTION].value, found.estimates[PRELOAD].value)


@pytest.mark.slow
@pytest.mark.parametrize("name", SIGNED)
def test_exact_torques_return_the_truth_whatever_the_signs_of_the_loads(name, quick_baselines, monkeypatch):
    monkeypatch.setattr(next_test, "SPEED_COUNT", 2)
    monkeypatch.setattr(next_test, "LOAD_COUNT", 3)
    found, values = fit_from_elsewhere(signed_log(SIGNED[name]))
    assert values == pytest.approx((0.12, 1113.0), rel=1e-3)
    assert found.rows.convention.description == "torque on the shaft, load and speed with their signs"
    # prediction, band and next test are on the same side of the nut
    for load in (-1590.0, 1590.0):
        true = MODELS["reference"](SMALL, OIL, axial_load=load, screw_speed=10.0).screw_torque
        assert found.predict(load, -10.0) == pytest.approx(true, rel=1e-3)
        assert found.band(load, -10.0).value == pytest.approx(true, rel=1e-3)
    tests = found.next_test().tests["axial_load"]
    assert {*np.sign(tests)} == {*np.sign(SIGNED[name])}


@pytest.mark.slow
def test_loads_that_are_logged_with_the_opposite_sign_are_turned_by_the_torque(quick_baselines):
    found, values = fit_from_elsewhere(signed_log(SIGNED["negative"], column=lambda load, _: -load))
    assert values == pytest.approx((0.12, 1113.0), rel=1e-3)
    assert "opposite sign" in found.rows.convention.description


@pytest.mark.slow
def test_sizes_of_friction_torques_and_loads_are_taken_as_positive_and_that_is_said(quick_baselines):
    data = signed_log((200.0, 2000.0))
    load, speed = data["axial_load"], data["screw_speed"]
    for nut, share in ((SMALL.nut, 0.01), (dataclasses.replace(SMALL.nut, bodies=None), None)):
        screw = dataclasses.replace(SMALL, nut=nut)
        friction = {
            sign: MODELS["reference"](screw, OIL, axial_load=sign * load, screw_speed=speed).screw_torque
            for sign in (1, -1)
        }
        columns = {"axial_load": load, "screw_speed": np.abs(speed), "torque": friction[1]}
        found = fit(MODELS["reference"], screw, OIL, columns, [FRICTION], kind="friction", holdout=0.0)
        said = [record for record in found.warning_records if record.id == "fit.load_sign"]
        assert len(said) == (share is not None)
        if share is not None:
            other = np.median(np.abs(friction[-1] - friction[1])) / np.median(friction[1])
            assert said[0].value == pytest.approx(other, rel=1e-2)
            assert other > share
