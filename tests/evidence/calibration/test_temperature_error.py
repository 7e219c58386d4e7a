"""The error of the oil temperature of a log: one number for all rows, in the covariance of a fit and nowhere twice."""

import dataclasses
import importlib
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binom
from scipy.stats import t as student

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE
from ballscrew.evidence.calibration.fit import fit
from ballscrew.evidence.papers.olaru2005.case import SCREW
from support.synthetic_logs import OIL, log, truth

pytestmark = pytest.mark.slow

PAPER, REFERENCE = bs.FrictionModel.olaru2005(), bs.FrictionModel.reference()
FRICTION, SEALS = "boundary_friction_coefficient", "constant_torque"
VG_100 = bs.Lubricant.from_grade("ISO VG 100")
BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
#: How often right intervals fail the test of 40 logs.
FALSE_ALARM = 1e-3


def columns(rows=400):
    return log(truth(REFERENCE), rows=rows, oil=VG_100, temperatures=(295, 330), noise=0.002, outliers=0.0, drift=0.0)


def warmed(columns, kelvin):
    return {**columns, "temperature": columns["temperature"] + kelvin}


@pytest.fixture(scope="module")
def found():
    return fit(REFERENCE, SCREW, VG_100, columns(), [FRICTION, SEALS], holdout=0.0)


def test_a_log_whose_every_temperature_is_beyond_any_oil_is_refused():
    with pytest.raises(
        InputError, match=r"log.temperature: is beyond any oil in every row \(6\d\d.* K\) · check its unit"
    ):
        fit(REFERENCE, SCREW, VG_100, warmed(columns(), 330.0), [FRICTION])


def test_a_warmer_log_moves_the_estimates_as_the_derivative_says(found):
    """Against fits of the log with temperatures half a kelvin higher and lower.

    The derivative has the mean curvature of the loss for that of each row. What the parameters make up for of the
    effect t of a kelvin is the same with both; of the rest r the two differ by (XᵀX)⁻¹ Xᵀ (D/d − 1) r, with the
    curvatures D of the rows and their mean d: within four standard deviations of that.
    """
    step, solution = 0.5, found.solution
    up, down = (
        fit(REFERENCE, SCREW, VG_100, warmed(columns(), sign * step), [FRICTION, SEALS], holdout=0.0)
        for sign in (1, -1)
    )
    difference = (up.solution.values - down.solution.values)[:2] / (2 * step)
    u = np.minimum((solution.residuals / solution.scatter / 4.685) ** 2, 1)
    curvatures = (1 - u) * (1 - 5 * u)
    x = solution.slopes / solution.scatter[:, np.newaxis]
    t = found.temperature_error.torque_per_kelvin / solution.scatter
    inverse = np.linalg.inv(x.T @ x)
    rest = t - x @ (inverse @ (x.T @ t))
    gain = inverse @ (x.T * rest)
    deviation = np.sqrt(np.sum(gain**2, axis=1)) * curvatures.std() / curvatures.mean()
    assert np.all(np.abs(found.temperature_error.shift[:2] - difference) < 4 * deviation[:2])
    # sharp enough to tell: the shift of the seals is many such deviations
    assert abs(difference[1]) > 20 * deviation[1]


def test_the_covariance_gains_what_that_makes_of_the_error(found):
    exact = fit(REFERENCE, SCREW, VG_100, columns(), [FRICTION, SEALS], holdout=0.0, temperature_error=0.0)
    shift = found.temperature_error.shift
    gained = np.outer(shift, shift) * (LOGGED_TEMPERATURE / NORMAL_95) ** 2
    np.testing.assert_allclose(found.uncertainty.covariance, exact.uncertainty.covariance + gained, rtol=1e-12)
    np.testing.assert_array_equal(found.solution.values, exact.solution.values)
    for name, estimate in found.estimates.items():
        before = exact.estimates[name]
        assert estimate.std > before.std
        assert before.temperature_share == 0
        assert estimate.temperature_share == pytest.approx(1 - (before.std / estimate.std) ** 2)


def test_no_number_of_rows_makes_it_smaller(found):
    more = fit(REFERENCE, SCREW, VG_100, columns(1600), [FRICTION, SEALS], holdout=0.0)
    for name, estimate in found.estimates.items():
        of_temperature = [e.std * np.sqrt(e.temperature_share) for e in (estimate, more.estimates[name])]
        assert of_temperature[1] == pytest.approx(of_temperature[0], rel=0.2)
        assert more.estimates[name].temperature_share > estimate.temperature_share


def test_it_is_as_in_a_service_where_nothing_is_said(found):
    assert found.temperature_error.half_width == found.settings["temperature_error"] == LOGGED_TEMPERATURE
    unlogged = {name: values for name, values in columns().items() if name != "temperature"}
    for oil in (VG_100, OIL):
        assert fit(REFERENCE, SCREW, oil, unlogged, [FRICTION]).temperature_error.half_width == UNKNOWN_TEMPERATURE
    unused = fit(REFERENCE, SCREW, OIL, columns(), [FRICTION])
    assert unused.temperature_error.half_width == UNKNOWN_TEMPERATURE


def test_a_free_viscosity_is_that_of_the_log_whatever_its_temperature():
    unlogged = {name: values for name, values in columns().items() if name != "temperature"}
    free = fit(REFERENCE, SCREW, VG_100, unlogged, [FRICTION, "viscosity"])
    assert not free.temperature_error.shift.any()
    assert [estimate.temperature_share for estimate in free.estimates.values()] == [0.0, 0.0]


def test_the_posterior_of_a_service_has_it_once():
    nut = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=3000.0))
    speed = np.tile(np.geomspace(1, 60, 20), 4) * np.repeat([1.0, -1.0], 40)
    warm = np.linspace(300.0, 315.0, 80)
    torque = REFERENCE(nut, VG_100.at(warm), axial_load=0.0, screw_speed=np.abs(speed)).screw_torque * np.sign(speed)
    torque = torque * (1 + 0.01 * np.random.default_rng(1).standard_normal(80))
    rows = {"axial_load": np.zeros(80), "screw_speed": speed, "friction_torque": torque, "temperature": warm}
    change = bs.preload_change(REFERENCE, nut, VG_100, None, rows, distributions={})
    assert change.worn.fit.temperature_error.half_width == 0.0
    assert "temperature of the worn log" in change.worn.shares


def test_the_interval_has_the_degrees_of_freedom_of_the_part_that_was_estimated(found):
    """Satterthwaite: (s² + t²)² / (s⁴/ν) for a variance s² of ν degrees and a known one t²."""
    one = dataclasses.replace(
        found.estimates[FRICTION],
        value=0.1,
        std=0.01,
        temperature_share=0.75,
        degrees_of_freedom=3,
        bounds=(-np.inf, np.inf),
    )
    s2, t2 = 0.25 * 0.01**2, 0.75 * 0.01**2
    degrees = (s2 + t2) ** 2 / (s2**2 / 3)
    assert np.diff(one.interval())[0] == pytest.approx(2 * 0.01 * student.ppf(0.975, degrees))


def test_samples_of_the_posterior_have_it_too():
    """Near its top, ``exp(−½ (k Σ ρ + z²))`` is normal with the inverse of ``k Σ ψ′ g gᵀ``, 1 added for z."""
    pytest.importorskip("emcee", reason="emcee is not installed (the extra calibrate)")
    few = log(
        truth(),
        rows=80,
        oil=VG_100,
        temperatures=(313, 314),
        noise=2e-4,
        outliers=0.0,
        drift=0.0,
        both=False,
        loads=(1000, 1100),
        speeds=(300, 320),
    )
    del few["time"]
    found = fit(PAPER, SCREW, VG_100, few, [FRICTION], holdout=0.0, temperature_error=30.0)
    samples, solution = found.posterior(200, seed=1), found.solution
    u = np.minimum((solution.residuals / solution.scatter / 4.685) ** 2, 1)
    bend, pull = (1 - u) * (1 - 5 * u), solution.residuals / solution.scatter * (1 - u) ** 2
    warm = found.temperature_error.deviation * found.temperature_error.torque_per_kelvin
    g = np.column_stack([solution.slopes, warm]) / solution.scatter[:, np.newaxis]
    known = np.diag([*np.zeros(g.shape[1] - 1), 1.0])
    deviations = [
        np.sqrt(np.linalg.inv(bend.sum() / (pull @ pull) * (each.T * bend) @ each + prior)[0, 0])
        for each, prior in ((g, known), (g[:, :-1], known[:-1, :-1]))
    ]
    drawn = samples.samples[FRICTION]
    effective = drawn.size / samples.autocorrelation_time
    assert list(samples.samples) == [FRICTION]
    assert drawn.std() == pytest.approx(deviations[0], rel=4 / np.sqrt(2 * effective))
    # without it the samples would lie closer than that
    assert deviations[0] * (1 - 4 / np.sqrt(2 * effective)) > deviations[1]


@pytest.mark.parametrize("error", [-1.0, 1e3, np.nan])
def test_an_error_that_is_none_is_refused(error):
    with pytest.raises(InputError, match=r"fit\.temperature_error: must be from 0 to 100 K"):
        fit(REFERENCE, SCREW, VG_100, columns(60), temperature_error=error)


@pytest.mark.long
def test_intervals_of_forty_logs_of_a_sensor_that_is_off_hold_the_truth(monkeypatch):
    """Right intervals of 95 % fail this in one of a thousand runs, by the binomial distribution.

    Without the error of the temperature, intervals of the rows alone hold it far less often: the same limit says so.
    """
    monkeypatch.syspath_prepend(BENCHMARKS)
    module = importlib.import_module("intervals")
    least = binom.ppf(FALSE_ALARM, module.LOGS, 0.95)
    for with_error, without in module.held_of_warm_logs().values():
        assert with_error >= least > without
