"""The named calibration is what its command makes of the rows shipped, and it is put into models as declared."""

import dataclasses
import importlib.util
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from ballscrew.basis.errors import InputError
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.friction.calibrations import PARAMETERS, calibrated, calibration, calibrations, with_parameters
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.ball_chain import ProportionalBallForce
from ballscrew.questions.validate import compute

pytestmark = pytest.mark.slow

SCRIPT = Path(__file__).parents[3] / "benchmarks" / "fit_calibration.py"
STORED = calibration("rexroth-2006")


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("fit_calibration", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, spec.name, module)
        patch.syspath_prepend(SCRIPT.parent)
        spec.loader.exec_module(module)
        yield module


@pytest.fixture(scope="module")
def linear(script):
    """Residuals at the stored numbers, and their slopes in units of the numbers."""
    best = np.array([STORED.boundary_friction_coefficient, STORED.share_of_load])

    def residuals(x):
        sets = script.entries(script.declared(*map(float, x)))
        return np.array([script.in_half_bands(point) for entry in sets for point in entry.points])

    at = residuals(best)
    slopes = []
    for i in range(2):
        step = np.where(np.arange(2) == i, 1e-3 * best, 0.0)
        slopes.append((residuals(best + step) - residuals(best - step)) / 2e-3)
    return best, at, np.array(slopes).T


def test_the_stored_numbers_are_the_least_squares(linear):
    """One more step of Gauss and Newton from there is no step: less than a thousandth of the standard errors."""
    best, residuals, slopes = linear
    step = np.linalg.lstsq(slopes, -residuals, rcond=None)[0] * best
    assert np.all(np.abs(step) < 1e-3 * np.array(STORED.standard_errors))
    assert STORED.rows == residuals.size == 42
    assert STORED.cost == pytest.approx(float(residuals @ residuals), rel=1e-5)


def test_the_stored_covariance_is_that_of_the_linear_model(linear):
    best, residuals, slopes = linear
    variance = residuals @ residuals / (residuals.size - 2)
    covariance = variance * np.linalg.inv(slopes.T @ slopes) * np.outer(best, best)
    np.testing.assert_allclose(STORED.covariance, covariance, rtol=2e-3)
    assert STORED.correlation == pytest.approx(
        covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1]), abs=2e-3
    )


def test_the_stored_numbers_belong_to_the_rows_shipped(script):
    assert STORED.data == {SETS[name].file: compute.fingerprint(SETS[name].file) for name in script.FITTED}
    assert STORED.objective == script.OBJECTIVE


def test_the_file_is_as_the_command_writes_it(script):
    found = {
        name: script.Fit(
            np.array([getattr(one, field) for field in one.fitted]), np.array(one.covariance), one.rows, one.cost
        )
        for name, one in calibrations().items()
        if name in script.DECLARED  # those of other makers are fitted anew, in one step
    }
    assert script.toml_text(found) == (script.DATA / "calibrations.toml").read_text(encoding="utf-8")
    assert tomllib.loads(script.toml_text(found)).keys() == calibrations().keys()


# -- in a model -----------------------------------------------------------------------------------


def test_it_changes_two_numbers_and_nothing_else():
    reference = FrictionModel.reference()
    model = calibrated(reference, STORED)
    assert model.friction.boundary_friction_coefficient == STORED.boundary_friction_coefficient
    assert isinstance(model.ball_force, ProportionalBallForce)
    assert model.ball_force.share_of_load == STORED.share_of_load
    for field in dataclasses.fields(FrictionModel):
        if field.name not in ("friction", "ball_force"):
            assert getattr(model, field.name) == getattr(reference, field.name) or field.name in (
                "film",
                "inlet",
            )
    for field in dataclasses.fields(model.friction):
        if field.name != "boundary_friction_coefficient":
            assert getattr(model.friction, field.name) == getattr(reference.friction, field.name)
    assert list(PARAMETERS.values()) == ["friction.boundary_friction_coefficient", "ball_force.share_of_load"]


def test_in_a_model_whose_neighbours_brake_they_rub_as_in_the_fitted_one():
    """The fitted force would brake with all of itself: ten times the torque."""
    for name in ("corrected", "olaru2005"):
        model = getattr(FrictionModel, name)()
        assert calibrated(model, STORED).ball_chain is FrictionModel.reference().ball_chain


def test_a_number_that_was_not_fitted_stays():
    reference = FrictionModel.reference()
    friction = dataclasses.replace(reference.friction, boundary_friction_coefficient=0.2)
    model = calibrated(dataclasses.replace(reference, friction=friction), calibration("rexroth-2006-rubbing"))
    assert model.friction.boundary_friction_coefficient == 0.2
    assert model.ball_force.share_of_load == calibration("rexroth-2006-rubbing").share_of_load


def test_models_that_it_does_not_fit_are_refused():
    reference = FrictionModel.reference()
    with pytest.raises(InputError, match=r"model\.friction: has no boundary friction to calibrate"):
        with_parameters(dataclasses.replace(reference, friction=lambda *_: 0.1), 0.1, 0.001)
    with pytest.raises(InputError, match=r"model\.ball_to_ball_force: does not count with a calibration"):
        calibrated(dataclasses.replace(reference, ball_to_ball_force=0.1), STORED)
    with pytest.raises(InputError, match="share_of_load: must not be negative"):
        with_parameters(reference, 0.1, -1.0)
    with pytest.raises(InputError, match=r'unknown calibration \(rexroth\) · did you mean "rexroth-2006'):
        calibration("rexroth")
