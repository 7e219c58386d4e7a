"""The condition of a nut whose torque is a product of powers: every number of it worked out by hand."""

import dataclasses
import math
import types

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.stats import norm

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.service.condition_means import Trend, _faults_of_sources, _of_one_speed, of_logs
from ballscrew.evidence.service.condition_records import (
    _of_baseline,
    _of_factor,
    _of_temperatures,
    _of_torques,
    _of_trend,
    span_of,
)
from ballscrew.evidence.service.condition_values import REPEATABILITY, USUAL
from support import power_law
from support.power_law import LEVER, MODEL, PER_KELVIN, SPEED, P, S, torque_of
from support.service_logs import OIL, PRELOAD, SCREW, WARM

Z = norm.ppf(0.975)
#: What the case does not know of this screw.
FACTOR = 1.3
TESTS, BASELINE = 12, 5
LEFT = np.array([1.0] * 5 + [0.97, 0.94, 0.9, 0.87, 0.8, 0.77, 0.72])
KELVIN = np.array([0.5, 3.0, -4.0, 2.0, 1.0, 8.0, -6.0, 15.0, 5.0, -2.0, 7.0, 4.0])
SPEEDS = SPEED * np.array([1.0, 2.0, 0.5, 3.0, 1.5, 0.7, 4.0, 1.0, 2.5, 0.4, 1.2, 2.0])
#: What the torques scatter by.
ERRORS = 0.01 * np.array([0.3, -1.2, 0.8, 0.1, -0.5, 1.4, -0.2, 0.6, -0.9, 0.4, -0.3, 0.7])
TORQUES = FACTOR * torque_of(LEFT, SPEEDS, KELVIN) * np.exp(ERRORS)
TABLE = {"torque": TORQUES, "number": np.arange(1.0, TESTS + 1)}


def condition(tests, *, oil=OIL, screw=SCREW, **options):
    options = {"distributions": {}, **options}
    return bs.condition(MODEL, screw, oil, tests, **options)


def columns(found, *names):
    return (np.array([getattr(state, name) for state in found.states]) for name in names)


def cusum(values, besides):
    """Page's sums of a fall and a rise, written out."""
    fall, rise = [0.0], [0.0]
    for i in range(BASELINE, values.size):
        scatter = math.sqrt(sum((values[j + 1] - values[j]) ** 2 for j in range(i)) / (2 * i))
        score = (values[i] - np.mean(values[:BASELINE])) / math.hypot(scatter, besides)
        score = min(4.0, max(-4.0, score))
        fall.append(max(0.0, fall[-1] - score - 1))
        rise.append(max(0.0, rise[-1] + score - 1))
    return np.array(fall[1:]), np.array(rise[1:])


@pytest.mark.parametrize("logged", [True, False])
def test_a_table_reduced_by_hand(logged):
    kelvin = KELVIN if logged else np.zeros(TESTS)
    table = {**TABLE, "screw_speed": SPEEDS, **({"temperature": WARM + KELVIN} if logged else {})}
    found = condition(table, tolerance=0.25)
    # over the model, and over the first tests
    over = np.log(TORQUES / torque_of(1.0, SPEEDS, kelvin))
    factor = np.mean(over[:BASELINE])
    preload = (over - factor) / P
    speed, warm = np.exp(np.mean(np.log(SPEEDS[:BASELINE]))), np.mean(kelvin[:BASELINE])
    torque = np.log(torque_of(1.0, speed, warm)) + factor + P * preload
    assert found.factor == pytest.approx(math.exp(factor), rel=1e-9)
    assert found.factor_interval == pytest.approx([math.exp(factor)] * 2, rel=1e-9)
    assert found.reference_speed == pytest.approx(speed, rel=1e-12)
    assert found.reference_temperature == pytest.approx(WARM + warm, rel=1e-12)
    assert (found.exponent, found.per_kelvin) == pytest.approx((P, -PER_KELVIN), rel=1e-4)
    assert found.temperatures == (TESTS if logged else 0)
    # of the torque a kelvin is PER_KELVIN; the model is off by 2 %; the scatter by the median of the differences
    of_temperature = PER_KELVIN * (2 if logged else 10) / Z
    scatter = np.median(np.abs(np.diff(torque))) / norm.ppf(0.75) / math.sqrt(2)
    assert found.scatter == pytest.approx(scatter, rel=1e-4)
    torques, low, high = columns(found, "torque", "torque_low", "torque_high")
    assert np.log(torques) == pytest.approx(torque, rel=1e-7)
    width = 2 * Z * math.hypot(of_temperature, scatter)
    assert np.log(high / low) == pytest.approx(np.full(TESTS, width), rel=1e-4)
    # the mean of five tests has a fifth of the variance; what the weather shares counts whole without temperatures
    shared = of_temperature * (math.sqrt(1 / BASELINE) if logged else 1)
    deviation = math.sqrt(of_temperature**2 + shared**2 + 1.2 * (scatter**2 + 0.02**2)) / P
    preloads, low, high = columns(found, "preload", "preload_low", "preload_high")
    assert np.log(preloads) == pytest.approx(preload, abs=1e-7)
    assert np.log(low) == pytest.approx(preload - Z * deviation, rel=1e-4, abs=1e-6)
    assert np.log(high) == pytest.approx(preload + Z * deviation, rel=1e-4, abs=1e-6)
    left = next(one for one in found.verdict_records if one.id == "condition.preload_left")
    assert "less than 75% of it" in left.text
    assert (left.limit, left.value) == (0.75, pytest.approx(math.exp(preload[-1]), rel=1e-6))
    loss = norm.cdf((math.log(0.75) - preload[-1]) / deviation)
    assert found.probability_of_loss == pytest.approx(loss, rel=1e-4)
    fall, rise = cusum(torque, math.hypot(of_temperature, 0.02) if logged else 0.02)
    assert found.chart.fall[BASELINE:] == pytest.approx(fall, rel=1e-4)
    assert found.chart.rise[BASELINE:] == pytest.approx(rise, rel=1e-4)
    slopes = [(preload[j] - preload[i]) / (j - i) for i in range(TESTS) for j in range(i + 1, TESTS)]
    assert found.trend.slope == pytest.approx(np.median(slopes), rel=1e-6)


def test_seals_make_the_torque_go_less_with_preload_and_temperature():
    """By their share of the torque, in the last test; the first tests have another."""
    screw = dataclasses.replace(SCREW, nut=dataclasses.replace(SCREW.nut, losses={"seals": bs.Seals(0.1)}))
    torque = 0.1 + torque_of(np.array([1.0] * 6 + [0.5]))
    table = {"torque": torque, "screw_speed": np.full(7, SPEED), "temperature": np.full(7, WARM)}
    found = condition(table, screw=screw)
    share = 1 - 0.1 / torque[-1]
    assert found.states[-1].preload == pytest.approx(0.5, rel=1e-6)
    assert found.exponent == pytest.approx(P * share, rel=0.01)
    # the difference over a kelvin
    assert found.per_kelvin == pytest.approx(-PER_KELVIN * share, rel=0.02)


def alternatives(found):
    return {one.subject: one for one in found.verdict_records if one.id == "condition.alternative"}


@pytest.mark.parametrize(("left", "logged"), [(0.6, False), (0.8, False), (1.3, True), (0.935, True)])
def test_what_else_would_explain_the_last_torque(left, logged):
    # the first tests are not alike: the change is that from their mean
    torque = FACTOR * torque_of(np.append(np.ones(BASELINE + 1), left))
    torque = torque * np.exp([0.01, -0.01, 0.004, 0.0, -0.004, 0.0, 0.0])
    table = {"torque": torque, "number": np.arange(7.0), "screw_speed": np.full(7, SPEED)}
    if logged:
        table["temperature"] = np.full(7, WARM)
    found = condition(table)
    change = P * math.log(left)
    causes = alternatives(found)
    assert set(causes) == {"temperature", "constant_torque", "boundary_friction_coefficient"}
    limit = 2.0 if logged else 10.0
    kelvin = -change / PER_KELVIN
    assert causes["temperature"].value == pytest.approx(kelvin, rel=1e-6)
    assert causes["temperature"].limit == limit
    assert causes["temperature"].holds is (abs(kelvin) <= math.sqrt(2) * limit)
    assert ("hotter" if kelvin > 0 else "colder") in causes["temperature"].text
    # the constant torque is there at the reference, of the whole
    whole = FACTOR * power_law.TORQUE
    assert causes["constant_torque"].value == pytest.approx(whole * (left**P - 1), rel=1e-6)
    assert ("less" if left < 1 else "more") in causes["constant_torque"].text
    friction = causes["boundary_friction_coefficient"]
    assert friction.value == pytest.approx(power_law.BOUNDARY_FRICTION * math.exp(change / S), rel=1e-6)
    assert friction.limit == power_law.BOUNDARY_FRICTION


def test_a_last_test_without_a_temperature_is_known_by_ten_kelvin():
    """Those before have one; that of the case stands for the last, which 7 K would explain."""
    torque = torque_of(np.append(np.ones(BASELINE + 1), math.exp(-7 * PER_KELVIN / P)))
    warm = np.full(7, WARM)
    warm[-1] = math.nan
    cause = alternatives(condition({"torque": torque, "screw_speed": np.full(7, SPEED), "temperature": warm}))
    assert (cause["temperature"].limit, cause["temperature"].holds) == (10.0, True)
    assert cause["temperature"].value == pytest.approx(7.0, rel=1e-6)


def test_what_no_oil_and_no_boundary_friction_explains():
    """Beyond 60 K, and beyond a twentieth of the boundary friction."""
    for left, explained in ((0.225, True), (0.22, False), (4.4, True), (4.6, False)):
        torque = torque_of(np.append(np.ones(BASELINE + 1), left))
        causes = alternatives(condition({"torque": torque, "screw_speed": np.full(7, SPEED)}))
        change = abs(P * math.log(left))
        assert explained is (change / PER_KELVIN < 60) is (change / S < math.log(20))
        for name in ("temperature", "boundary_friction_coefficient"):
            assert (causes[name].value is not None) is explained
            assert causes[name].holds is (False if name == "temperature" or not explained else None)


def test_a_change_within_the_scatter_has_no_other_causes():
    """Beyond 1.96 times the scatter and the 2 % of the model."""
    for change, said in ((0.9, False), (1.1, True)):
        torque = torque_of() * np.append(np.ones(BASELINE + 1), math.exp(change * Z * 0.02))
        assert bool(alternatives(condition({"torque": torque, "screw_speed": np.full(7, SPEED)}))) is said


@pytest.mark.parametrize("kelvin", [-5.5, 4.5, 5.5])
def test_a_last_test_at_another_temperature_is_said(kelvin):
    warm = np.append(WARM + np.array([1.0, -1.0, 2.0, -2.0, 0.0, 7.0]), WARM + kelvin)
    table = {"torque": torque_of(1.0, SPEED, warm - WARM), "screw_speed": np.full(7, SPEED), "temperature": warm}
    said = [one for one in condition(table).warning_records if one.id == "condition.temperatures_differ"]
    assert [one.value for one in said] == pytest.approx([kelvin] if abs(kelvin) > 5 else [])
    assert all(("hotter" if kelvin > 0 else "colder") in one.text for one in said)
    assert all("6 K" in one.text for one in said)


def test_without_temperatures_the_oil_that_would_do_is_said():
    torque = torque_of(np.append(np.ones(BASELINE + 1), 0.8))
    found = condition({"torque": torque, "screw_speed": np.full(7, SPEED)})
    (said,) = (one.text for one in found.warning_records if one.id == "condition.no_temperature")
    # each kelvin is 2 %; ln 0.8 of the preload is as 9 K
    assert "each kelvin is 2.0% of the torque" in said
    assert "an oil 9 K hotter would explain the last test" in said


# -- several speeds -------------------------------------------------------------------------------

LEVELS = SPEED * np.array([0.5, 1.0, 2.0, 4.0, 8.0])
ROWS = 6


def log(share, *, seals=0.0, warmer=0.0, friction=1.0, zero=0.004):
    """A log at five speeds in both directions, noiseless, of a sensor with a zero error."""
    speed = np.repeat(LEVELS, 2 * ROWS)
    sign = np.tile(np.repeat([1.0, -1.0], ROWS), LEVELS.size)
    torque = FACTOR * torque_of(share, speed, warmer, friction) + seals
    return {
        "axial_load": np.zeros(speed.size),
        "screw_speed": sign * speed,
        "torque": sign * torque + zero,
        "temperature": np.full(speed.size, WARM),
        "time": 2.0 * np.arange(speed.size),
    }


def means_of(*logs, kind="friction"):
    logs = [{**one, "temperature": one["temperature"] + 0.0} for one in logs]
    return of_logs(Configuration(MODEL, SCREW, OIL), logs, kind, None)


def test_means_of_logs_by_hand():
    """By speed: half the difference of the medians of both directions, and its error by their absolute deviations."""
    one = log(0.9)
    speed, sign = np.abs(one["screw_speed"]), np.sign(one["screw_speed"])
    # at one speed the rows of each direction scatter evenly; the zero of the sensor goes out
    spread = np.where(speed == LEVELS[2], np.tile([-0.03, -0.02, -0.01, 0.01, 0.02, 0.03], 2 * LEVELS.size), 0.0)
    model = torque_of(1.0, speed)
    one["torque"] = one["torque"] + sign * spread * model
    means = means_of(one, log(0.8))
    assert (means.count, means.per, means.times.tolist()) == (2, "test", [1.0, 2.0])
    assert means.labels == ["log 1", "log 2"]
    assert means.speeds.tolist() == [5, 5]
    assert means.test.tolist() == [0] * 5 + [1] * 5
    assert means.screw_speed == pytest.approx(np.tile(LEVELS, 2))
    assert means.logged.all()
    assert means.at_the_same_speeds
    assert means.warnings == ()
    first = FACTOR * torque_of(0.9, LEVELS)
    assert means.torque == pytest.approx(np.append(first, FACTOR * torque_of(0.8, LEVELS)))
    # the standard error of a median is 1.2533 times that of a mean; two directions have half of the variance
    error = 1.2533 * 1.4826 * 0.02 / math.sqrt(ROWS) / math.sqrt(2) / (FACTOR * 0.9**P)
    assert means.deviation[2] == pytest.approx(error, rel=1e-3)
    assert means.deviation[[0, 1, 3, 4]] == pytest.approx(np.zeros(4), abs=1e-12)


def test_rows_that_are_not_quite_at_one_speed_and_temperature():
    """Their mean is at the geometric mean of the speeds, and at the mean of loads and temperatures."""
    one, random = log(0.9), np.random.default_rng(3)
    rows = one["torque"].size
    speed = np.abs(one["screw_speed"]) * np.exp(random.uniform(-0.04, 0.04, rows))
    kelvin, load = random.uniform(-2, 2, rows), random.uniform(0, 50, rows)
    torque = np.sign(one["screw_speed"]) * FACTOR * torque_of(0.9, speed, kelvin)
    changed = {"screw_speed": np.sign(one["screw_speed"]) * speed, "temperature": WARM + kelvin, "axial_load": load}
    means = means_of({**one, **changed, "torque": torque})
    parts = np.arange(rows).reshape(LEVELS.size, -1)
    assert means.screw_speed == pytest.approx(np.exp(np.log(speed[parts]).mean(axis=1)))
    assert means.temperature == pytest.approx(WARM + kelvin[parts].mean(axis=1))
    assert means.axial_load == pytest.approx(load[parts].mean(axis=1))
    expected = FACTOR * torque_of(0.9, means.screw_speed, means.temperature - WARM)
    assert means.torque == pytest.approx(expected, rel=1e-6)


def test_a_log_of_one_direction_keeps_its_zero_and_says_so():
    both = log(1.0, zero=0.02)
    forward = {name: values[both["screw_speed"] > 0] for name, values in both.items()}
    means = means_of(both, forward, both)
    own = FACTOR * torque_of(1.0, LEVELS)
    assert means.torque == pytest.approx(np.concatenate([own, own + 0.02, own]))
    assert [(one.id, one.subject) for one in means.warnings] == [("condition.one_direction", "log 2")]
    loaded = {**forward, "axial_load": np.full(forward["torque"].size, 500.0)}
    # of a torque of the drive what the load asks for goes out
    drive = {**loaded, "torque": loaded["torque"] + LEVER * 500.0}
    assert means_of(drive, kind="drive").torque == pytest.approx(own + 0.02)
    assert means_of(drive, kind="drive").axial_load == pytest.approx(np.full(5, 500.0))
    with pytest.raises(bs.InputError, match="has a load and one direction, and the kind of torque is not known"):
        means_of(drive, kind="unknown")
    few = {name: values[np.abs(both["screw_speed"]) < LEVELS[1]][:2] for name, values in both.items()}
    with pytest.raises(bs.InputError):
        means_of(few)


def test_a_torque_against_the_motion_is_no_friction():
    with pytest.raises(bs.InputError, match="has a mean friction torque that is not positive"):
        means_of({**log(1.0), "torque": -log(1.0)["torque"]})


def test_logs_of_one_file_are_given_once():
    """By what is in them, whatever they are called."""
    sources = [("a.csv", "1"), ("b.csv", "2"), ("c.csv", "1"), None]
    logs = [types.SimpleNamespace(source=source) for source in sources]
    # each step of a condition by itself: its answer shows them together
    (fault,) = _faults_of_sources(logs)
    assert "two logs are the same file (a.csv, c.csv)" in str(bs.InputError(fault))
    assert _faults_of_sources([*logs[:2], logs[3], logs[3]]) == []


def test_rows_of_alike_speeds():
    """Parts by gaps of more than a tenth; of a sweep without gaps even ones of twelve rows; twelve parts at most."""

    def parts(speed):
        found = _of_one_speed(np.asarray(speed, dtype=float))
        assert sorted(np.concatenate(found).tolist()) == list(range(len(speed)))
        return [sorted(np.asarray(speed)[part].tolist()) for part in found]

    assert parts([10, 30, 10.9, 29, 10.4]) == [[10, 10.4, 10.9], [29, 30]]
    assert len(parts(np.geomspace(1, 2.2, 40))) == 1  # a factor of 2.2 is not wide
    assert [len(part) for part in parts(np.geomspace(1, 2.3, 40))] == [14, 13, 13]
    assert [len(part) for part in parts(np.geomspace(1, 2.3, 20))] == [20]
    assert [len(part) for part in parts(np.geomspace(1, 50, 300))] == [25] * 12
    assert len(parts(1.2 ** np.arange(12))) == 12
    assert [len(part) for part in parts(np.repeat(1.2 ** np.arange(13), 2))] == [3, 3] + [2] * 10


def test_causes_beside_each_other_are_the_most_probable_ones():
    """By another solver: least squares of scores, of the torques and of what is known of each cause."""
    given = [{"share": 1.0}] * BASELINE + [{"share": 0.9, "seals": -0.02}, {"share": 0.7, "warmer": 1.0}]
    found = condition([log(**one) for one in given], kind="friction")
    priors = np.array([USUAL["nut.preload"], 0.5, 0.5, 2 / Z])
    everything = [
        FACTOR * torque_of(one["share"], LEVELS, one.get("warmer", 0.0)) + one.get("seals", 0.0) for one in given
    ]
    priors[2] *= math.exp(np.mean(np.log(everything)))
    factor = FACTOR

    def scores(state, measured):
        preload, friction, constant, kelvin = state
        torque = factor * torque_of(math.exp(preload), LEVELS, kelvin, math.exp(friction)) + constant
        return np.concatenate([(torque - measured) / (REPEATABILITY * measured), state / priors])

    for state, measured in zip(found.states, everything, strict=True):
        best = least_squares(scores, np.zeros(4), args=(measured,), xtol=1e-14, ftol=1e-14, gtol=1e-14)
        spread = np.sqrt(np.diagonal(np.linalg.inv(best.jac.T @ best.jac)))
        names = ("nut.preload", "boundary_friction_coefficient", "constant_torque", "temperature")
        for i, name in enumerate(names):
            part = state.parts[name]
            value, width = best.x[i], Z * spread[i] * math.sqrt(1 + 1 / BASELINE)
            ends = np.array([value - width, value, value + width])
            if i < 2:
                ends = np.exp(ends)
            assert [part.low, part.value, part.high] == pytest.approx(ends, rel=2e-3, abs=1e-5), name
            assert part.told is bool(spread[i] < 0.5 * priors[i])


@pytest.mark.parametrize(("share", "refused"), [(0.19, False), (0.21, True)])
def test_a_log_of_one_test_has_one_load(share, refused):
    """Loads that differ by a fifth of the preload at most."""
    one = log(1.0)
    one["axial_load"] = np.where(np.arange(one["torque"].size) % 2, share * PRELOAD, 0.0)
    if refused:
        with pytest.raises(bs.InputError, match="log 1: log: has many loads"):
            means_of(one)
    else:
        assert means_of(one).axial_load == pytest.approx(np.full(5, share * PRELOAD / 2))


def test_a_direction_counts_from_three_rows_of_a_speed_on():
    one = log(1.0)
    forward = np.flatnonzero((one["screw_speed"] > 0) & (one["screw_speed"] < 1.5 * LEVELS[0]))
    for left, counts in ((3, True), (2, False)):
        kept = np.ones(one["torque"].size, dtype=bool)
        kept[forward[left:]] = False
        means = means_of({name: values[kept] for name, values in one.items()})
        assert (means.speeds.tolist() == [5]) is counts
        assert ("fewer than 3 of their speed in a direction" in " ".join(means.notes)) is not counts


def test_temperatures_of_a_test_are_the_mean_of_its_speeds():
    """The torque goes with the mean by 1 % a kelvin exactly: not with the warmest speed, which is another order."""
    random = np.random.default_rng(2)
    mean = WARM + np.array([0.0, 5, -4, 3, 8, -6, 2, 9])
    warm = mean[:, np.newaxis] + np.array([-1.0, 0, 1]) * random.uniform(1, 9, (8, 1))
    means = types.SimpleNamespace(
        test=np.repeat(np.arange(8), 3), temperature=warm.ravel(), logged=np.ones(8, dtype=bool)
    )
    made = types.SimpleNamespace(baseline=8, per_kelvin=-PER_KELVIN, states=[None] * 8, reference_temperature=WARM)
    found = types.SimpleNamespace(torque=0.01 * mean + 1e-4 * np.tile([1, -1], 4))
    (record,) = _of_baseline(made, means, found, True)
    assert record.value == pytest.approx(0.01, rel=0.01)
    assert _of_baseline(made, means, found, False) == []
    made.baseline = 5
    (record,) = _of_temperatures(made, means, found, None, 0.0, True)
    assert record.value == pytest.approx(mean[-1] - np.mean(mean[:5]))


@pytest.mark.parametrize(
    ("torques", "test"),
    [([4, 4, 4, 4, 5], "d"), ([5, 4, 4, 4, 4], "e"), ([4, 4, 4, 5, 4], None), ([4, 4, 4, 4, 4], "d")],
)
def test_torques_that_repeat_three_others(torques, test):
    """Four in a row, said once, in the last of them."""
    states = [types.SimpleNamespace(label=label, preload=1.0) for label in "abcde"]
    means = types.SimpleNamespace(speeds=np.ones(5), torque=np.array(torques, dtype=float))
    records = _of_torques(types.SimpleNamespace(states=states), means)
    assert [one.subject for one in records] == ([] if test is None else [f"states.{'abcde'.index(test)}"])
    assert all(
        one.text.startswith(f"{test}: the torque is the same to the last digit as in the 3 tests") for one in records
    )
    states[1].preload = math.nan
    (untold,) = (one for one in _of_torques(types.SimpleNamespace(states=states), means) if "preload" in one.id)
    assert untold.value == 1.0


@pytest.mark.parametrize(
    ("factor", "said"), [(1.51, True), (1.49, False), (1 / 1.49, False), (1 / 1.51, True)]
)  # fmt: skip
def test_a_factor_beyond_one_and_a_half_is_said(factor, said):
    assert bool(_of_factor(types.SimpleNamespace(factor=factor, factor_interval=(1.0, 2.0)))) is said


@pytest.mark.parametrize(
    ("per", "time", "name", "span"),
    [("test", 9.0, "10 tests", 10), ("s", 92 * 86400, "a year", 365.25 * 86400), ("s", 91 * 86400, "1000 h", 3.6e6)],
)
def test_the_span_that_a_trend_is_said_of(per, time, name, span):
    """A year of series of a quarter of one or more, 1000 h of shorter ones, ten tests without times."""
    states = [types.SimpleNamespace(time=1e9), types.SimpleNamespace(time=1e9 + time)]
    made = types.SimpleNamespace(per=per, states=states, trend=Trend(0.01 / span, -0.02 / span, 0.03 / span))
    assert span_of(made) == (name, span)
    (record,) = _of_trend(made)
    assert "+1.0%" in record.text
    assert record.unit == ("1" if per == "test" else "1/s")
    made.trend = Trend(math.nan, math.nan, math.nan)
    assert _of_trend(made) == []
