"""The parts of a fit by hand: what is fitted, between which bounds, and what priors know before."""

import math
import types

import numpy as np
import pytest
from scipy.stats import lognorm, norm, triang

from ballscrew.basis.quantities import Info, Quantity
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import LogNormal, Normal, Triangular, Uniform
from ballscrew.evidence.calibration import problem as problems
from ballscrew.evidence.calibration.baselines import first_loss, robust_linear
from ballscrew.evidence.calibration.calibrated_model import Posterior
from ballscrew.evidence.calibration.fit import _one_sided, fit
from ballscrew.evidence.calibration.problem import CONVENTIONS, Priors, Problem, identify_convention
from ballscrew.evidence.calibration.response import torque_per_kelvin
from ballscrew.evidence.calibration.robust import Noise, Solution
from ballscrew.files.torque_logs.torque_log import TorqueLog
from support.power_law import BOUNDARY_FRICTION, MODEL, PER_KELVIN, SPEED, P, torque_of
from support.service_logs import OIL, PRELOAD, SCREW, WARM

FRICTION = "friction.boundary_friction_coefficient"
ROWS = 80


def log(both=True, rows=ROWS):
    """Rows from slow to fast, those of both directions in turn."""
    sign = np.where(np.arange(rows) % 2, -1.0, 1.0) if both else np.ones(rows)
    speed = SPEED * np.geomspace(0.5, 8, rows)
    columns = {"axial_load": np.zeros(rows), "screw_speed": sign * speed, "time": np.arange(float(rows))}
    return TorqueLog.of({**columns, "friction_torque": sign * torque_of(1.0, speed)})


class Response:
    """Two torques with their slopes by one number, whatever it is."""

    names, start = (FRICTION,), np.array([BOUNDARY_FRICTION])

    def __init__(self, torques, slopes):
        self.found = torques, slopes

    def __call__(self, values):
        return self.found


def problem(data, asked=(FRICTION,), scatter=0.01, friction=None, bounds=None):
    rows = len(data)
    torques = np.stack([np.zeros(rows), np.full(rows, 0.4) if friction is None else friction])
    slopes = np.stack([np.zeros((rows, 1)), np.ones((rows, 1))])
    return Problem.of(
        Configuration(MODEL, SCREW, OIL),
        Response(torques, slopes),
        {name: name for name in asked},
        data,
        CONVENTIONS[0],
        scatter,
        torques,
        slopes,
        bounds or {},
    )


def test_what_is_fitted_beside_the_numbers_that_are_free():
    """A zero where both directions tell, a drift besides, and three half waves more of a long log."""
    data = log()
    found = problem(data, (FRICTION, "constant_torque"), scatter=0.01, friction=np.full(ROWS, -0.4))
    assert found.names == [FRICTION, "constant_torque"]
    names = [one.name for one in found.parameters]
    waves = ["torque_wander_2", "torque_wander_3", "torque_wander_4"]
    assert names == [FRICTION, "constant_torque", "torque_offset", "torque_drift", *waves]
    assert found.has_torque_offset
    # 0.4 N m of friction is what a torque is measured by, a wandering zero by three scatters
    assert found.scale[1:].tolist() == [0.4] * 6
    assert found.deviations == {place: Normal(0.0, 0.03) for place in (4, 5, 6)}
    time = np.linspace(0, 1, ROWS)
    assert found.columns[:, 0] == pytest.approx(np.sign(data.screw_speed))
    assert found.columns[:, 1] == pytest.approx(np.ones(ROWS))
    assert found.columns[:, 2] == pytest.approx(time - 0.5)
    for i, half_waves in enumerate((2, 3, 4)):
        assert found.columns[:, 3 + i] == pytest.approx(np.cos(half_waves * math.pi * time))
    assert found.sensor_columns.shape == (ROWS, 5)
    assert found.sensor_columns[:, 0] == pytest.approx(np.ones(ROWS))
    assert found.beyond == pytest.approx(1e3 * max(0.4, np.max(np.abs(data.torque))))
    short = [one.name for one in problem(log(rows=58)).parameters]
    assert short == [FRICTION, "torque_offset", "torque_drift"]
    assert [one.name for one in problem(log(rows=18)).parameters] == [FRICTION, "torque_offset"]
    # all torques zero: they are measured by 1 N m
    assert problem(log(), friction=np.zeros(ROWS)).scale[1] == 1.0


def test_one_direction_has_a_drift_where_nothing_else_goes_with_it():
    data = log(both=False)
    assert [one.name for one in problem(data).parameters] == [FRICTION, "torque_drift"]
    # without a zero the sensor is right at the beginning
    assert problem(data).columns[:, 0] == pytest.approx(np.linspace(0, 1, ROWS))
    assert not problem(data).has_torque_offset


@pytest.mark.parametrize(("share", "independent"), [(0.15, True), (0.19, True), (0.21, False), (0.9, False)])
def test_a_drift_is_independent_where_the_slopes_explain_less_than_a_fifth(share, independent):
    """The square of the correlation is what a straight line explains, whatever the mean of the slopes."""
    drift = np.linspace(-0.5, 0.5, 101)
    other = np.cos(2 * math.pi * np.linspace(0, 1, 101))
    other = other - other.mean()
    other *= np.linalg.norm(drift) / np.linalg.norm(other)
    slopes = 7 + 3 * (math.sqrt(share) * drift + math.sqrt(1 - share) * other)
    assert np.corrcoef(drift, slopes)[0, 1] ** 2 == pytest.approx(share)
    # without a log and a fit around it
    assert problems._is_independent(drift, slopes[:, np.newaxis]) is independent


def test_rows_at_which_the_model_has_no_torque():
    """They are zero that nothing changes; where the model has none at all, they are far beyond what was measured."""
    found = problem(log(), scatter=0.01)
    torques, slopes = np.full((2, ROWS), 0.5), np.full((2, ROWS, 1), 2.0)
    torques[1, 3], slopes[1, 5, 0] = math.nan, math.inf
    values = np.zeros(len(found.parameters))
    found.response.found = torques, slopes
    torque, derivatives = found.torque(values)
    sign = np.sign(log().screw_speed)
    expected = 0.5 * sign
    expected[[3, 5]] = 0.0
    assert torque == pytest.approx(expected)
    assert derivatives[:, 0] == pytest.approx(4 * expected)
    values[1] = 0.25  # the zero of the sensor
    assert found.torque(values)[0] == pytest.approx(expected + 0.25)
    found.response.found = np.full((2, ROWS), math.nan), slopes
    assert found.torque(np.zeros(len(values)))[0] == pytest.approx(np.full(ROWS, found.beyond))
    chosen = np.arange(ROWS) < 5
    assert found.on(chosen)(values)[0].shape == (5,)


def quantity(**bounds):
    return Quantity("x", "1", Info("x", "a number", **bounds))


@pytest.mark.parametrize(
    ("bounds", "value", "scale", "low", "high"),
    [
        ({}, 3.0, 3.0, -math.inf, math.inf),
        ({}, -3.0, 3.0, -math.inf, math.inf),
        ({}, 0.0, 1.0, -math.inf, math.inf),
        # a conformity of 0.54 has 0.04 above its bound
        ({"above": 0.5, "at_most": 1}, 0.54, 0.04, 0.5 + 0.04e-6, 1.0),
        ({"at_least": 0, "below": 1}, 0.9, 0.1, 0.0, 1 - 0.1e-6),
        ({"at_least": 0, "at_most": 4}, 0.0, 4.0, 0.0, 4.0),
        ({"at_least": 2, "above": 1, "at_most": 9, "below": 8}, 2.0, 2.0, 2.0 + 2e-6, 8 - 2e-6),
    ],
)
def test_scales_and_bounds_of_a_number(bounds, value, scale, low, high):
    # without a log and a fit around it
    found = problems._parameter("x", quantity(**bounds), value)
    assert found.scale == pytest.approx(scale)
    assert (found.low, found.high) == (pytest.approx(low, abs=1e-12), pytest.approx(high, abs=1e-12))


# -- priors ---------------------------------------------------------------------------------------


def test_priors_are_the_residuals_of_their_distributions():
    """Standard deviations from the mean, of a log-normal number in logarithms; SciPy has the means and deviations."""
    of_triangle = triang((0.3 - 0.1) / (0.6 - 0.1), 0.1, 0.6 - 0.1)
    given = {0: Normal(2.0, 0.5), 1: LogNormal(3.0, 1.5), 2: Triangular(0.1, 0.3, 0.6), 3: Uniform(0.0, 1.0)}
    priors = Priors(given, np.full(4, 0.5), np.array([1.0, 2.0, 4.0, 8.0]))
    x = np.array([3.0, 4.5, 0.5, 0.9])
    expected = [2.0, 1.0, (0.5 - of_triangle.mean()) / of_triangle.std()]
    assert priors.residuals(x) == pytest.approx(expected)
    assert lognorm(math.log(1.5), scale=3.0).cdf(4.5) == pytest.approx(0.8413447)  # so is a residual of one
    step = 1e-6
    by_difference = np.array(
        [(priors.residuals(x + h) - priors.residuals(x - h)) / (2 * step) for h in step * np.eye(4)]
    )
    assert priors.slopes(x) == pytest.approx(by_difference.T, abs=1e-7)
    assert priors.deviation(2, 0.5) == pytest.approx(of_triangle.std())
    assert priors.deviation(1, 4.5) == pytest.approx(4.5 * math.log(1.5))
    assert priors.deviation(3, 0.5) is None
    # all are held weakly, by ten times their scales about their start
    everything = priors.all.residuals(x)
    assert everything[3:] == pytest.approx((x - 0.5) / (10 * np.array([1.0, 2, 4, 8])))
    assert priors.all.slopes(x)[3:] == pytest.approx(np.diag(1 / (10 * np.array([1.0, 2, 4, 8]))))
    assert Priors({0: LogNormal(3.0, 1.5)}, x, x).residuals(np.array([-1.0]))[0] == pytest.approx(
        -12 * math.log(10) / math.log(1.5)
    )


# -- what a fit says ------------------------------------------------------------------------------


def test_a_preload_of_a_product_of_powers_is_fitted_as_by_logarithms():
    """Noise that grows with the torque: the mean of the logarithms, and its standard error over the power."""
    random = np.random.default_rng(4)
    rows, share = 400, 0.02
    sign, speed = np.where(random.random(rows) < 0.5, -1.0, 1.0), SPEED * np.exp(random.uniform(-1, 2, rows))
    torque = torque_of(0.7, speed) * (1 + random.normal(0, share, rows))
    data = {"axial_load": np.zeros(rows), "screw_speed": sign * speed, "friction_torque": sign * torque}
    found = fit(MODEL, SCREW, OIL, data, ["nut.preload"], temperature_error=0.0, holdout=0.0)
    estimate = found.estimates["nut.preload"]
    error = share / math.sqrt(rows) / P
    by_hand = np.mean(np.log(torque / torque_of(1.0, speed))) / P
    assert math.log(estimate.value / PRELOAD) == pytest.approx(by_hand, abs=0.5 * error)
    assert estimate.std / estimate.value == pytest.approx(error, rel=0.15)
    assert not estimate.one_sided
    assert estimate.degrees_of_freedom == rows - len(found.problem.parameters)


def test_the_interval_of_samples_has_equal_shares_beyond_its_ends():
    found = Posterior({"x": np.arange(1001.0)}, 1.0, 0.5)
    assert found.interval("x", 0.9) == pytest.approx((50.0, 950.0))


def test_the_loss_of_a_line_by_hand():
    """Residuals of ±1: their scatter s is 1.4826, and each of them costs 2 c² (√(1 + (1/s c)²) − 1)."""
    ends = np.tile([1.0, -1.0], 20)
    scatter, c = 1.4826, 1.35
    each = 2 * c**2 * (math.sqrt(1 + (1 / scatter / c) ** 2) - 1)
    assert first_loss(np.ones((40, 1)), ends) == pytest.approx(scatter * math.sqrt(40 * each))
    assert first_loss(np.ones((40, 1)), 7 * ends) == pytest.approx(7 * scatter * math.sqrt(40 * each))
    found, loss = robust_linear(np.ones((40, 1)), 3 + ends)
    assert (found[0], loss) == (pytest.approx(3.0), pytest.approx(scatter * math.sqrt(40 * each)))


@pytest.mark.parametrize(
    ("torque", "one_sided"),
    [
        (lambda x: x, False),
        (lambda x: np.maximum(x, 1.0), True),
        (lambda x: np.minimum(x, 1.0), True),
        (lambda x: np.where(x < 1, 1 + 0.9 * (x - 1), x), False),
        (lambda x: np.where(x < 1, 1 + 0.3 * (x - 1), x), True),
    ],
)
def test_a_number_is_told_on_one_side_where_the_torques_go_flat(torque, one_sided):
    """The mean of normal readings: two errors away squared scores sum to four more, of half a slope to one."""
    noise = norm.ppf((np.arange(400) + 0.5) / 400)
    solution = Solution(np.ones(1), np.ones(400), noise, np.ones((400, 1)), Noise(1.0, 0.0), converged=True)
    made = types.SimpleNamespace(
        on=lambda chosen: lambda x: (np.full(np.count_nonzero(chosen), float(torque(x[0]))), None),
        parameters=[None],
        response=types.SimpleNamespace(names=["x"]),
        bounds=(np.array([-9.0]), np.array([9.0])),
    )
    fitted = types.SimpleNamespace(
        problem=made,
        solution=solution,
        held_out=np.zeros(400, dtype=bool),
        log=types.SimpleNamespace(torque=1.0 - noise),
    )
    uncertainty = types.SimpleNamespace(covariance=np.array([[1 / 400]]))
    # without a log and a fit around it
    assert _one_sided(fitted, uncertainty).tolist() == [one_sided]
    # a number without an error has no sides
    assert _one_sided(fitted, types.SimpleNamespace(covariance=np.zeros((1, 1)))).tolist() == [False]


def test_the_torque_by_a_kelvin_of_a_product_of_powers():
    """Its logarithm falls evenly; rows at which the model has no torque count nothing, nor where viscosity is free."""
    points = {"axial_load": np.zeros(2), "screw_speed": np.array([SPEED, math.nan]), "temperature": np.full(2, WARM)}
    weights = np.array([[0.0, 0.0], [-1.0, 1.0]])
    subject = Configuration(MODEL, SCREW, OIL)
    found = torque_per_kelvin(subject, ["nut.preload"], points, weights)
    assert found == pytest.approx([PER_KELVIN * torque_of(), 0.0], rel=1e-4)
    assert torque_per_kelvin(subject, ["viscosity"], points, weights).tolist() == [0.0, 0.0]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_drift_is_no_error_of_the_sensor_where_friction_has_one_sign(sign):
    """Of friction that rises and falls alike before and after the middle, a fit leaves a drift as it is.

    The scatter is the median of its size, by 1.4826 that of a normal distribution.
    """
    time = np.linspace(-0.5, 0.5, ROWS)
    friction = 0.4 + 0.2 * np.cos(20 * time)
    torques, speed = np.stack([np.zeros(ROWS), friction]), np.full(ROWS, sign * SPEED)
    measured = sign * (friction + 0.1 * time)
    _, scatter = identify_convention(measured, torques, np.zeros(ROWS), speed, time, "friction")
    assert scatter == pytest.approx(1.4826 * np.median(np.abs(0.1 * time)), rel=1e-5)
