"""The preload of a nut whose torque is a product of powers, from one torque and from logs: worked out by hand."""

import dataclasses
import math
import types

import numpy as np
import pytest
from scipy.special import logsumexp
from scipy.stats import linregress, multivariate_normal, norm
from scipy.stats import t as student

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.monte_carlo import JointNormal
from ballscrew.evidence.service import posterior
from ballscrew.evidence.service.diagnostics import Mixture, temperature_trend
from ballscrew.evidence.service.posterior import Groups, Posterior, conditional
from support.power_law import BOUNDARY_FRICTION, MODEL, PER_KELVIN, SPEED, P, S, torque_of
from support.service_logs import OIL, PRELOAD, SCREW, WARM

Z = norm.ppf(0.975)
FRICTION = "friction.boundary_friction_coefficient"


# -- one torque -----------------------------------------------------------------------------------


@pytest.mark.parametrize("logged", [True, False])
def test_a_torque_without_load(logged):
    """The logarithm of the preload is normal: that of oil and reading over the power of the preload."""
    reading, speed, warmer = 0.25, 2 * SPEED, 5.0 if logged else 0.0
    found = bs.preload_of_torque(
        MODEL,
        SCREW,
        OIL,
        torque=reading,
        torque_deviation=0.02 * reading,
        screw_speed=speed,
        temperature=WARM + warmer if logged else None,
        distributions={FRICTION: bs.Normal(BOUNDARY_FRICTION, 0.001)},
    )
    middle = math.log(PRELOAD) + math.log(reading / torque_of(1.0, speed, warmer)) / P
    parts = {"temperature": PER_KELVIN * (2 if logged else 10) / Z, "reading": 0.02, FRICTION: S * 0.005}
    whole = math.hypot(*parts.values()) / P
    # the width of the kernel between the samples is Silverman's, half of it on each side
    kernel = math.sqrt(1 + 0.25 * 512 ** (-2 / 5))
    low, high = np.log(found.interval())
    assert math.log(found.preload) == pytest.approx(middle, abs=0.03 * whole)
    assert high - low == pytest.approx(2 * Z * whole * kernel, rel=0.03)
    for name, part in parts.items():
        assert found.shares[name] == pytest.approx((part / P / whole) ** 2, abs=0.05), name


def test_a_torque_that_most_screws_cannot_have():
    """A nut of seals: what they lose is what no preload is below, and a hundred times the preload is the most."""
    losses = {"seals": bs.Seals(0.2)}
    screw = dataclasses.replace(SCREW, nut=dataclasses.replace(SCREW.nut, losses=losses))
    asked = {"screw_speed": SPEED, "distributions": {}}
    least, most = (0.2 + torque_of(share) for share in (1e-3, 1e2))
    for torque, known in ((0.99 * least, False), (1.05 * least, True), (0.8 * most, True), (1.3 * most, False)):
        if known:
            found = bs.preload_of_torque(MODEL, screw, OIL, torque=torque, **asked)
            by_hand = PRELOAD * ((torque - 0.2) / torque_of()) ** (1 / P)
            assert found.preload == pytest.approx(by_hand, rel=0.02)
        else:
            with pytest.raises(bs.InputError, match=f"loses {least:.3g} N m without any"):
                bs.preload_of_torque(MODEL, screw, OIL, torque=torque, **asked)
    refused = [({"torque": 0.0}, "torque: must be positive"), ({"screw_speed": 0.0}, "screw_speed: must be positive")]
    for wrong, words in [*refused, ({"torque_deviation": -1e-9}, "torque_deviation: must not be negative")]:
        with pytest.raises(bs.InputError, match=words):
            bs.preload_of_torque(MODEL, screw, OIL, **{"torque": 0.5, **asked, **wrong})


# -- two logs -------------------------------------------------------------------------------------

ROWS = 60


def log(share, seed, warmer=0.0, friction=1.0):
    random = np.random.default_rng(seed)
    speed, sign = SPEED * np.geomspace(0.5, 8, ROWS), np.where(np.arange(ROWS) % 2, -1.0, 1.0)
    torque = torque_of(share, speed, warmer, friction) * np.exp(random.normal(0, 0.003, ROWS))
    return {
        "axial_load": np.zeros(ROWS),
        "screw_speed": sign * speed,
        "friction_torque": sign * torque,
        "time": np.arange(float(ROWS)),
        "temperature": np.full(ROWS, WARM + warmer),
    }


@pytest.fixture(scope="module")
def change():
    uncertain = {FRICTION: bs.Normal(BOUNDARY_FRICTION, 0.02)}
    logs = log(1.0, 0), log(0.6, 1, warmer=4.0)
    return bs.preload_change(MODEL, SCREW, OIL, *logs, distributions=uncertain, kind="friction")


def test_the_share_left_and_its_doubt(change):
    """An error of the model that both logs share goes out; the two oils and the model at each day do not."""
    of_oil = PER_KELVIN * 2 / Z / P
    # twelve groups, each off by 2 % · √(12/10)
    of_groups = 0.02 * math.sqrt(12 / 10) / math.sqrt(12) / P
    assert change.ratio == pytest.approx(0.6, rel=0.01)
    deviation = math.sqrt(change.logarithm.total_variance)
    assert deviation == pytest.approx(math.sqrt(2) * math.hypot(of_oil, of_groups), rel=0.1)
    of_friction = S * 0.1 / P
    for one in (change.new, change.worn):
        deviation = math.sqrt(one.logarithm.total_variance)
        assert deviation == pytest.approx(math.hypot(of_oil, of_groups, of_friction), rel=0.1)
    assert change.new.temperature == pytest.approx(WARM)
    assert change.worn.temperature == pytest.approx(WARM + 4)
    assert change.worn.shares["friction.boundary_friction_coefficient"] == pytest.approx(
        of_friction**2 / (of_oil**2 + of_groups**2 + of_friction**2), abs=0.08
    )
    assert change.ratio_shares["friction.boundary_friction_coefficient"] < 0.05


def test_what_else_would_explain_the_worn_log(change):
    """The preload of the new log, as it was found, and the change that makes up for it."""
    subject, warmer = change.worn.subject, change.worn.warmer
    then = float(change.new.subject.value_of("nut.preload")) / PRELOAD
    friction = float(subject.value_of(FRICTION)) / BOUNDARY_FRICTION
    measured = 0.6**P * math.exp(-PER_KELVIN * 4)
    causes = {one.name: one for one in change.alternatives}
    assert set(causes) == {"boundary_friction_coefficient", "temperature", "constant_torque"}
    by_friction, by_oil = causes["boundary_friction_coefficient"], causes["temperature"]
    assert by_friction.instead_of == BOUNDARY_FRICTION
    expected = (measured / (then**P * math.exp(-PER_KELVIN * 4))) ** (1 / S) * BOUNDARY_FRICTION
    assert by_friction.value == pytest.approx(expected, rel=0.01)
    kelvin = math.log(then**P * friction**S / measured) / PER_KELVIN
    assert by_oil.value == pytest.approx(WARM + kelvin, abs=0.1)
    assert by_oil.instead_of == pytest.approx(WARM + 4)
    # a factor of the torque is as good as a preload; a constant torque is not
    assert by_friction.explains
    assert by_oil.explains
    for one in (by_friction, by_oil):
        assert one.rms == pytest.approx(one.rms_of_preload, rel=1e-3)
        assert one.plausible is False
    assert causes["constant_torque"].plausible is None
    assert causes["constant_torque"].instead_of == 0.0
    # the noise, and what the most probable numbers are off by besides: less than the 2 % of the model
    rows = change.worn.fit.rows
    noise = np.abs(rows.log.torque) - torque_of(0.6, np.abs(rows.log.screw_speed), 4.0)
    assert 0.9 * np.std(noise) < change.worn.residual_rms < 0.02 * np.mean(np.abs(rows.log.torque))
    assert abs(warmer) < 3


def test_causes_within_what_is_known():
    """A change of 1 % is within a boundary friction of 10 %, within 2 K of the oil, and within the seals."""
    losses = {"seals": bs.Seals(0.02)}
    screw = dataclasses.replace(SCREW, nut=dataclasses.replace(SCREW.nut, losses=losses))
    one = log(0.99, 2)
    one["friction_torque"] = one["friction_torque"] + np.sign(one["screw_speed"]) * 0.02
    uncertain = {FRICTION: bs.Normal(BOUNDARY_FRICTION, 0.02)}
    found = bs.preload_change(MODEL, screw, OIL, None, one, distributions=uncertain, kind="friction")
    assert [cause.plausible for cause in found.alternatives] == [True, True, True]
    assert found.new.preload == pytest.approx(PRELOAD, rel=1e-6)
    # the nominal preload by half of what lies between its quantiles of one deviation
    (share,) = (one for name, one in found.ratio_shares.items() if name == "nominal preload")
    assert share == pytest.approx(found.new.logarithm.variance[0] / found.logarithm.total_variance, rel=1e-9)


# -- parts ----------------------------------------------------------------------------------------


def groups(share, deviation, constant=False):
    speeds = SPEED * np.array([0.5, 1.0, 2.0, 4.0])
    points = {"axial_load": np.zeros(4), "screw_speed": speeds, "temperature": np.full(4, WARM)}
    friction = torque_of(share, speeds)
    return Groups(points, friction, deviation * friction, constant)


def test_what_means_say_of_a_preload():
    """Relative errors of 8 % in each of four means are 4 % of the torque, and 5 % of the preload; a kelvin is 2 %."""
    subject = Configuration(MODEL, SCREW, OIL)
    values = {FRICTION: BOUNDARY_FRICTION * np.array([1.0, 1.0, 1.2])}
    found = conditional(groups(0.7, 0.08), subject, PRELOAD, values, np.array([0.0, 3.0, 0.0]))
    expected = math.log(0.7) + np.array([0.0, 3 * PER_KELVIN, -S * math.log(1.2)]) / P
    assert found.mean == pytest.approx(expected, abs=0.004)
    assert np.sqrt(found.variance) == pytest.approx(np.full(3, 0.05), rel=0.02)
    assert found.misfit == pytest.approx(np.zeros(3), abs=0.1)
    # the probability of the torques, by the preload summed over the table's steps
    step = math.log(4.0 / 0.05) / 160
    assert found.evidence == pytest.approx(np.full(3, math.log(math.sqrt(2 * math.pi) * 0.05 / step)), abs=0.05)


def test_what_means_say_beside_a_constant_torque():
    """Least squares of two columns: torque by the preload, and one for all."""
    subject = Configuration(MODEL, SCREW, OIL)
    given = groups(0.7, 0.01, constant=True)
    given = given._replace(friction=given.friction + 0.05)
    found = conditional(given, subject, PRELOAD, {}, np.zeros(1))
    x = np.stack([P * (given.friction - 0.05), np.ones(4)], axis=1) / given.deviation[:, np.newaxis]
    assert found.mean == pytest.approx([math.log(0.7)], abs=0.01)
    assert found.variance == pytest.approx([np.linalg.inv(x.T @ x)[0, 0]], rel=0.1)


def test_shares_and_scores_of_samples_by_hand():
    weights = np.array([0.1, 0.2, 0.3, 0.4])
    scores = np.array([[1.0, 0.0], [-1.0, 2.0], [0.5, 1.0], [0.0, -1.0]])
    found = Posterior({"a": scores[:, 0] + 10}, scores, ["a", "b"], weights, [], [], best=2)
    assert found.number_at_best() == {"a": 10.5}
    assert found.effective_samples == pytest.approx(1 / 0.3)
    assert found.mean_scores() == pytest.approx({"a": 0.05, "b": 0.3})
    logarithm, variance = np.array([0.3, -0.1, 0.2, 0.0]), np.array([0.01, 0.02, 0.0, 0.01])
    covariance = np.cov(np.column_stack([scores, logarithm]).T, aweights=weights, ddof=0)
    total = covariance[2, 2] + weights @ variance
    by_hand = {name: covariance[i, 2] ** 2 / covariance[i, i] / total for i, name in enumerate("ab")}
    assert found.shares(logarithm, variance) == pytest.approx(by_hand)
    still = dataclasses.replace(found, scores=np.ones((4, 2)))
    assert still.shares(logarithm, variance) == {"a": 0.0, "b": 0.0}
    assert found.shares(np.zeros(4), np.zeros(4)) == {"a": 0.0, "b": 0.0}


def test_the_density_of_samples_is_that_of_a_mixture():
    """A fifth of the samples from what was known, the others about a mean (SciPy)."""
    random = np.random.default_rng(5)
    scores, mean = random.normal(0, 1, (20, 2)), np.array([0.5, -1.0])
    root = np.array([[0.7, 0.0], [0.2, 0.4]])
    parts = [multivariate_normal([0, 0]).logpdf(scores), multivariate_normal(mean, root @ root.T).logpdf(scores)]
    by_scipy = logsumexp(parts, axis=0, b=np.array([[0.2], [0.8]]))
    # answers show the weights alone, not what they are made of
    found = posterior._density(scores, mean, root) - math.log(2 * math.pi)
    assert found == pytest.approx(by_scipy)


def test_correlated_numbers_are_mixed_as_a_calibration_left_them():
    joint = JointNormal(("x", "b", "a"), np.zeros(3), np.array([[1.0, 0, 0], [0, 4.0, 3.0], [0, 3.0, 9.0]]))
    # answers show the weights alone, not what they are made of
    mixing = posterior._mixing(["a", "c", "b"], joint)
    assert mixing @ mixing.T == pytest.approx(np.array([[1, 0, 0.5], [0, 1, 0], [0.5, 0, 1]]), abs=1e-6)


def test_weights_are_flattened_until_an_eighth_of_a_round_counts():
    weights = np.exp(-0.5 * np.linspace(0, 80, 2000) ** 2)
    weights /= weights.sum()
    # answers show the weights alone, not what they are made of
    flat = posterior._flattened(weights)
    assert flat.sum() == pytest.approx(1)
    assert 1 / np.sum(weights**2) < 64 <= 1 / np.sum(flat**2) < 100
    power = np.log(flat[0] / flat[200]) / np.log(weights[0] / weights[200])
    assert np.log(power) / np.log(0.7) == pytest.approx(round(np.log(power) / np.log(0.7)))
    even = np.full(100, 0.01)
    assert posterior._flattened(even) == pytest.approx(even)


def test_errors_of_a_sensor_are_those_of_weighted_least_squares():
    random = np.random.default_rng(6)
    columns, known, factor = random.normal(0, 1, (30, 3)), np.array([[0.0, 2.0, 0.0]]), random.uniform(1, 3, 30)
    sent, model = random.normal(0, 1, 30), random.normal(0, 1, 30)
    one = types.SimpleNamespace(sensor=posterior.Sensor(columns, known), torque=sent)
    weights = np.diag(factor**2)
    by_hand = np.linalg.solve(columns.T @ weights @ columns + known.T @ known, columns.T @ weights @ (sent - model))
    assert posterior.errors_of_sensor(one, model, factor) == pytest.approx(by_hand)


def test_a_mixture_by_hand():
    one = Mixture(np.array([0.25, 0.75]), np.array([1.0, 3.0]), np.array([0.04, 0.09]))
    assert one.total_variance == pytest.approx(0.25 * 0.04 + 0.75 * 0.09 + 0.25 * 0.75 * 4)
    assert one.share_below(2.9) == pytest.approx(0.25 * norm.cdf(1.9 / 0.2) + 0.75 * norm.cdf(-0.1 / 0.3))
    assert one.share_below(one.quantile(0.4)) == pytest.approx(0.4)
    less = one.less(Mixture.of(0.5, 0.1))
    assert (less.mean.tolist(), less.variance.tolist()) == ([0.5, 2.5], pytest.approx([0.05, 0.1]))
    assert one.less(one).mean.tolist() == [0.0, 0.0]
    for weights, variance in ((np.array([np.nan, 1.0]), one.variance), (one.weights, np.array([np.nan, 0.1]))):
        untold = Mixture(weights, one.mean, variance)
        assert not untold.told
        assert math.isnan(untold.share_below(2.0))
        assert math.isnan(untold.quantile(0.1))
        assert untold.quantile(0.5) == 2.0
    exact = Mixture.of(2.0, 0.0)
    assert exact.interval(0.95) == pytest.approx((math.exp(2), math.exp(2)))


# -- trends of temperature ------------------------------------------------------------------------


def test_a_trend_of_values_that_alternate_is_that_of_scipy():
    """Errors that alternate make the one of Newey and West the smaller: the interval is that of independent values."""
    warm = 300 + np.array([0.0, 5, 1, 4, 2, 3, 2.5, 4.5, 0.5, 3.5])
    values = 0.004 * warm + 0.01 * np.where(np.arange(10) % 2, 1, -1) + 0.002 * np.sin(np.arange(10))
    found, known = temperature_trend(values, warm), linregress(warm, values)
    half = student.ppf(0.975, 8) * known.stderr
    assert (found.slope, found.chance) == pytest.approx((known.slope, known.pvalue), rel=1e-9)
    assert (found.low, found.high) == pytest.approx((known.slope - half, known.slope + half), rel=1e-9)
    assert found.temperature_range == pytest.approx(5.0)


def test_a_trend_of_three_values_has_one_degree_of_freedom():
    """Student's distribution of one degree is Cauchy's: 12.7 standard errors, and seldom told."""
    found = temperature_trend(np.array([0.0, 0.03, 0.04]), np.array([300.0, 302.0, 304.0]))
    # 0.01 a kelvin, off by 0.01 · (-1, 2, -1) / 3
    error = math.sqrt(0.01**2 * 6 / 9) / math.sqrt(8)
    assert found.slope == pytest.approx(0.01)
    assert found.high - found.slope == pytest.approx(math.tan(0.475 * math.pi) * error)
    assert not found.told
    assert temperature_trend(np.array([0.0, 0.03]), np.array([300.0, 302.0])) is None


def test_a_trend_of_values_that_follow_each_other_is_that_of_newey_and_west():
    random = np.random.default_rng(8)
    warm = 300 + 4 * np.sin(np.linspace(0, 9, 60))
    values = np.convolve(random.normal(0, 0.01, 69), np.ones(10) / 10, mode="valid")
    found = temperature_trend(values, warm)
    x = np.column_stack([np.ones(60), warm - warm.mean()])
    best = np.linalg.lstsq(x, values, rcond=None)[0]
    off = values - x @ best
    # twice the lag before the first correlation that independent numbers could have
    correlations = [float(off[k:] @ off[:-k] / (off @ off)) for k in range(1, 7)]
    lag = 2 * next(before for before, one in enumerate(correlations) if one < 2 / math.sqrt(60))
    assert lag == 6
    moments = x * off[:, np.newaxis]
    middle = moments.T @ moments
    for k in range(1, lag + 1):
        product = moments[k:].T @ moments[:-k]
        middle = middle + (1 - k / (lag + 1)) * (product + product.T)
    bread = np.linalg.inv(x.T @ x)
    error = math.sqrt((bread @ middle @ bread)[1, 1])
    assert error > linregress(warm, values).stderr
    assert (found.high - found.low) / 2 == pytest.approx(student.ppf(0.975, 58) * error, rel=1e-9)


def test_what_a_trend_says():
    rising = temperature_trend(0.002 * np.arange(9.0) + 1e-4 * np.cos(9 * np.arange(9.0)), 300 + np.arange(9.0))
    for sign, per_kelvin, words in ((1, -0.02, "over"), (1, 0.02, "under"), (-1, -0.02, "under"), (-1, 0.02, "over")):
        ends = (rising.low, rising.high) if sign > 0 else (-rising.high, -rising.low)
        text = rising._replace(slope=sign * rising.slope, low=ends[0], high=ends[1]).text(per_kelvin)
        assert f"still {'rises' if sign > 0 else 'falls'} by" in text
        assert f"({100 * rising.low:.2f} to {100 * rising.high:.2f} %, 95 %): the model {words}-corrects" in text


# -- groups of rows, and logs that nothing explains -----------------------------------------------


def fitted(rows, loads=None, noise=0.0):
    random = np.random.default_rng(9)
    speed, sign = SPEED * np.geomspace(0.5, 8, rows), np.where(np.arange(rows) % 2, -1.0, 1.0)
    load = np.zeros(rows) if loads is None else np.tile(loads, rows // len(loads))
    torque = torque_of(1.0, speed) * (1 + random.normal(0, noise, rows))
    data = {"axial_load": load, "screw_speed": sign * speed, "friction_torque": sign * torque}
    return bs.fit(MODEL, SCREW, OIL, data, ["nut.preload"], temperature_error=0.0, holdout=0.0)


@pytest.mark.parametrize(
    ("rows", "loads", "sizes"),
    [
        (60, None, [5] * 12),
        (24, None, [3] * 8),
        (80, [100.0, 900.0, 500.0, 700.0], [7, 7, 6] * 4),
        (20, [100.0, 900.0, 500.0, 700.0], [4, 4, 3, 3, 3, 3]),
    ],
)
def test_groups_of_rows_by_hand(rows, loads, sizes):
    """Twelve at most, of three rows or more; by four loads where there are eight; off by 2 % in ten parts."""
    found = fitted(rows, loads)
    groups = Groups.of(found)
    assert len(groups.friction) == len(sizes)
    speeds = np.abs(found.rows.log.screw_speed)
    order = np.argsort(np.abs(found.rows.log.axial_load), kind="stable")
    of_loads = np.array_split(order, 4 if len(sizes) >= 8 and loads else 1)
    parts = [
        one[chosen]
        for one in of_loads
        for chosen in np.array_split(np.argsort(speeds[one], kind="stable"), len(sizes) // len(of_loads))
    ]
    assert [part.size for part in parts] == sizes
    assert groups.points["screw_speed"] == pytest.approx([np.exp(np.mean(np.log(speeds[part]))) for part in parts])
    assert groups.friction == pytest.approx([torque_of(1.0, v) for v in groups.points["screw_speed"]], rel=1e-6)
    error = 0.02 * math.sqrt(max(len(sizes) / 10, 1))
    assert groups.deviation / groups.friction == pytest.approx(np.full(len(sizes), error), rel=1e-3)
    assert not groups.constant


def test_loads_of_both_signs_are_in_no_group_together():
    groups = Groups.of(fitted(60, [-900.0, 900.0]))
    assert groups.points["axial_load"] == pytest.approx([900.0] * 6 + [-900.0] * 6, rel=1e-12)


def test_the_scatter_of_rows_is_in_the_preload_of_a_log():
    """Noise of 15 %: in the means of groups beside the 2 % of the model, and in the rows of the first fit."""
    random = np.random.default_rng(11)
    one = log(1.0, 0)
    one["friction_torque"] = one["friction_torque"] * (1 + random.normal(0, 0.15, ROWS))
    found = bs.preload_change(MODEL, SCREW, OIL, None, one, distributions={}, kind="friction")
    of_groups = math.hypot(0.15 / math.sqrt(5), 0.02 * math.sqrt(1.2)) / math.sqrt(12)
    of_rows, of_oil = 0.15 / math.sqrt(ROWS), PER_KELVIN * 2 / Z
    expected = math.sqrt(of_groups**2 + of_rows**2 + of_oil**2) / P
    assert math.sqrt(found.worn.logarithm.total_variance) == pytest.approx(expected, rel=0.15)
    without_rows = math.hypot(of_groups, of_oil) / P
    assert without_rows < 0.9 * expected


def test_a_log_that_no_preload_explains_still_has_its_nearest():
    """A torque that goes with the root of the speed: far off at all speeds, and said to be."""
    one = log(1.0, 0)
    one["friction_torque"] = one["friction_torque"] * np.abs(one["screw_speed"] / SPEED) ** 0.5
    found = bs.preload_change(MODEL, SCREW, OIL, None, one, distributions={}, kind="friction")
    assert found.logarithm.told
    assert "service.misfit" in {record.id for record in found.warning_records}


def test_an_oil_without_a_grade_explains_a_log_by_its_viscosity():
    """Its viscosity falls by its temperature coefficient, as the model's torque does: ln 0.8 of the preload is 9 K."""
    plain = bs.Lubricant(viscosity=OIL.viscosity, temperature_coefficient=OIL.temperature_coefficient)
    one = {name: values for name, values in log(0.8, 0).items() if name != "temperature"}
    found = bs.preload_change(MODEL, SCREW, plain, None, one, distributions={}, kind="friction")
    cause = next(one for one in found.alternatives if one.name == "viscosity")
    kelvin = -P * math.log(0.8) / PER_KELVIN
    expected = OIL.viscosity * math.exp(-OIL.temperature_coefficient * kelvin)
    assert cause.value == pytest.approx(expected, rel=0.02)
    assert cause.instead_of == OIL.viscosity
    assert cause.plausible  # 10 K either way


def test_the_seed_is_zero_unless_it_is_given():
    asked = {"torque": 0.25, "screw_speed": SPEED, "distributions": {FRICTION: bs.Normal(BOUNDARY_FRICTION, 0.02)}}
    found = [bs.preload_of_torque(MODEL, SCREW, OIL, **asked, **seed).shares for seed in ({}, {"seed": 0}, {"seed": 1})]
    assert found[0] == found[1] != found[2]
