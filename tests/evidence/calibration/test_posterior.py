"""Samples of the posterior against what is known in closed form."""

import dataclasses
import functools
import sys

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.evidence.calibration import fit as calibration
from ballscrew.evidence.papers.olaru2005.case import SCREW
from support.synthetic_logs import OIL, log, truth

pytest.importorskip("emcee", reason="emcee is not installed (the extra calibrate)")
PAPER = bs.FrictionModel.olaru2005()
#: The oil of these logs is exactly as warm as said.
fit = functools.partial(calibration.fit, temperature_error=0.0)
FRICTION, OFFSET = "boundary_friction_coefficient", "pure_rolling_offset"


@pytest.fixture(scope="module")
def found():
    columns = log(truth(), rows=150, both=False, drift=0, outliers=0)
    del columns["time"]
    return fit(PAPER, SCREW, OIL, columns, [FRICTION], holdout=0)


@pytest.fixture(scope="module")
def samples(found):
    return found.posterior(steps=500, seed=1)


def test_where_the_model_is_nearly_a_straight_line_the_errors_are_those_of_the_curvature(found, samples):
    """``exp(−½ k Σ ρ)`` near its top is normal with the covariance (k Σ ψ′ g gᵀ)⁻¹, g the derivatives."""
    solution = found.solution
    r = solution.residuals / solution.scatter
    u = np.minimum((r / 4.685) ** 2, 1)
    bend, pull = (1 - u) * (1 - 5 * u), r * (1 - u) ** 2
    g = solution.slopes / solution.scatter[:, np.newaxis]
    deviation = np.sqrt(np.linalg.inv(bend.sum() / (pull @ pull) * (g.T * bend) @ g)[0, 0])
    drawn = samples.samples[FRICTION]
    effective = drawn.size / samples.autocorrelation_time
    assert effective > 100
    assert abs(drawn.mean() - solution.values[0]) < 4 * deviation / np.sqrt(effective)
    assert drawn.std() == pytest.approx(deviation, rel=4 / np.sqrt(2 * effective))
    low, high = samples.interval(FRICTION)
    assert high - low == pytest.approx(2 * 1.96 * deviation, rel=0.15)


@pytest.mark.slow
def test_the_run_says_how_far_it_can_be_trusted(samples):
    assert 1 < samples.autocorrelation_time < 100
    assert 0.2 < samples.acceptance < 0.95
    narrow, wide = samples.interval(FRICTION, 0.5), samples.interval(FRICTION, 0.99)
    assert wide[0] < narrow[0] < narrow[1] < wide[1]


def test_the_same_seed_gives_the_same_samples(found):
    one, again, other = (found.posterior(steps=20, seed=seed).samples[FRICTION] for seed in (3, 3, 4))
    np.testing.assert_array_equal(one, again)
    assert not np.array_equal(one, other)


@pytest.mark.slow
def test_samples_keep_within_the_bounds(found):
    low = found.estimates[FRICTION].value
    bounded = fit(PAPER, SCREW, OIL, found.rows.log, [FRICTION], holdout=0, bounds={FRICTION: (low, 0.3)})
    drawn = bounded.posterior(steps=200).samples[FRICTION]
    assert np.all(drawn >= low - 1e-12)
    assert drawn.std() > 0


@pytest.mark.slow
def test_a_prior_alone_is_sampled_where_the_log_says_nothing():
    name = "lubricant.heat_capacity"
    columns = log(truth(), rows=30, both=False, outliers=0, drift=0)
    given = fit(PAPER, SCREW, OIL, columns, [FRICTION, name], priors={name: bs.Normal(2000.0, 30.0)}, holdout=0)
    drawn = given.posterior(steps=300, seed=2)
    effective = drawn.samples[name].size / drawn.autocorrelation_time
    assert drawn.samples[name].mean() == pytest.approx(2000, abs=4 * 30 / np.sqrt(effective))
    assert drawn.samples[name].std() == pytest.approx(30, rel=4 / np.sqrt(2 * effective))


def test_rows_held_out_do_not_count(found):
    columns = {name: getattr(found.rows.log, name) for name in ("axial_load", "screw_speed", "torque")}
    one = fit(PAPER, SCREW, OIL, columns, [FRICTION], kind="drive", seed=5)
    held_out = one.rows.held_out
    rows = dataclasses.replace(
        one.rows, log=dataclasses.replace(one.rows.log, torque=np.where(held_out, 99.0, one.rows.log.torque))
    )
    spoilt = dataclasses.replace(one, rows=rows)
    drawn = [which.posterior(steps=20).samples[FRICTION] for which in (one, spoilt)]
    np.testing.assert_array_equal(*drawn)


def test_progress_is_told(found):
    told = []
    found.posterior(steps=5, done=lambda finished, total: told.append((finished, total)))
    assert told == [(1, 5), (2, 5), (3, 5), (4, 5), (5, 5)]


def test_without_emcee_it_says_what_to_install(found, monkeypatch):
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(InputError, match=r"ballscrew\[calibrate\]"):
        found.posterior(steps=1)
