"""A baseline whose torque still goes with the temperature after the model has accounted for it."""

import math

import numpy as np
import pytest
from scipy.stats import binom
from scipy.stats import t as student

import ballscrew as bs
from ballscrew.evidence.service.diagnostics import CHANCE, temperature_trend
from support.condition_series import SPEED
from support.service_logs import OIL, RPM, SCREW

PAPER = bs.FrictionModel.olaru2005()
TRENDS = ("condition.temperature_trend", "service.temperature_trend")
#: How often right rates fail a test.
FALSE_ALARM = 1e-3
WARM = 303.15 + np.array([-8.0, 5.0, -3.0, 8.0, 0.0, -6.0, 3.0, 6.0, -1.0, 2.0, 8.0, -8.0])


def table(per_kelvin, seed=0, noise=0.003):
    """Tests of a healthy nut whose torque goes with the temperature by so much more than the model has it, 1/K."""
    random = np.random.default_rng(seed)
    torque = PAPER(SCREW, OIL.at(WARM), axial_load=0.0, screw_speed=SPEED).screw_torque
    torque = torque * np.exp(per_kelvin * (WARM - WARM.mean()) + random.normal(0, noise, WARM.size))
    return {"number": np.arange(1.0, WARM.size + 1), "torque": torque, "temperature": WARM}


def of_condition(**options):
    found = bs.condition(PAPER, SCREW, OIL, table(**options), screw_speed=SPEED, baseline=8, distributions={})
    return [record for record in found.warning_records if record.id in TRENDS]


@pytest.mark.parametrize(("per_kelvin", "words"), [(0.01, "over-corrects"), (-0.01, "under-corrects")])
def test_a_condition_says_that_its_baseline_still_goes_with_the_temperature_and_which_way(per_kelvin, words):
    """The model takes the torque down with the temperature: one that falls less is taken up too much."""
    (record,) = of_condition(per_kelvin=per_kelvin)
    assert record.value == pytest.approx(per_kelvin, abs=0.003)
    assert record.severity == "warning"
    assert f"the model {words}" in record.text
    assert "first 8 tests" in record.text


def test_a_baseline_that_does_not_is_not_blamed_but_seldom():
    said = sum(len(of_condition(per_kelvin=0.0, seed=seed)) for seed in range(12))
    assert said <= binom.ppf(1 - FALSE_ALARM, 12, CHANCE)


def test_a_baseline_without_temperatures_or_of_one_is_not_judged():
    cold = {**table(per_kelvin=0.01), "temperature": np.full(WARM.size, 303.15)}
    unlogged = {name: values for name, values in cold.items() if name != "temperature"}
    for tests in (cold, unlogged):
        found = bs.condition(PAPER, SCREW, OIL, tests, screw_speed=SPEED, baseline=8, distributions={})
        assert not [record for record in found.warning_records if record.id in TRENDS]


def of_service(per_kelvin):
    """What a service says of a log of which the torque goes with the temperature by so much more than the model's."""
    random = np.random.default_rng(3)
    rows = 160
    warm = 303.15 + 10 * np.sin(np.linspace(0, 9, rows))
    speed, sign = RPM * np.exp(random.uniform(*np.log((10, 1000)), rows)), np.where(np.arange(rows) % 2, -1.0, 1.0)
    torque = PAPER(SCREW, OIL.at(warm), axial_load=0.0, screw_speed=speed).screw_torque
    torque = sign * torque * np.exp(per_kelvin * (warm - 303.15) + random.normal(0, 0.005, rows))
    log = {"axial_load": np.zeros(rows), "screw_speed": sign * speed, "friction_torque": torque, "temperature": warm}
    found = bs.preload_change(PAPER, SCREW, OIL, None, log, distributions={})
    return [record for record in found.warning_records if record.id in TRENDS]


def test_a_service_says_it_of_its_logs():
    (record,) = of_service(per_kelvin=0.01)
    assert record.text.startswith("worn log: ")
    assert "the model over-corrects" in record.text
    assert record.value == pytest.approx(0.01, abs=0.003)


def test_a_service_says_nothing_of_a_log_that_the_model_explains():
    assert not of_service(per_kelvin=0.0)


def test_the_slope_and_its_interval_are_those_of_least_squares():
    """Of independent values, beside another column that they go with."""
    random = np.random.default_rng(1)
    warm, other = random.uniform(290, 310, 12), random.normal(0, 1, 12)
    values = 0.02 * warm + 0.3 * other + random.normal(0, 0.01, 12)
    found = temperature_trend(values, warm, other[:, np.newaxis])
    x = np.stack([np.ones(12), warm, other], axis=1)
    best, (rest,), *_ = np.linalg.lstsq(x, values, rcond=None)
    error = math.sqrt(rest / 9 * np.linalg.inv(x.T @ x)[1, 1])
    assert found.slope == pytest.approx(best[1])
    # never less than independent values have
    assert (found.high - found.low) / 2 >= student.ppf(0.975, 9) * error * (1 - 1e-9)
    assert found.low < 0.02 < found.high
    assert found.told


def test_of_few_values_or_of_one_temperature_nothing_is_told():
    assert temperature_trend(np.zeros(2), np.array([290.0, 300.0])) is None
    assert temperature_trend(np.zeros(9), np.linspace(300, 301, 9)) is None
