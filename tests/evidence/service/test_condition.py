"""The condition over time: series with a known loss, drifts of the temperature, causes beside each other, bad input."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.stats import binom

import ballscrew as bs
from support.condition_series import SPEED, logs, series
from support.service_logs import OIL, PRELOAD, SCREW, WARM

PAPER, REFERENCE = bs.FrictionModel.olaru2005(), bs.FrictionModel.reference()
#: Series of the default run and of ``make test-all``; how often a right rate fails the test.
SEEDS, MANY, FALSE_ALARM = 8, 100, 1e-3
NUMBER = np.arange(1.0, 13.0)
STEADY = 0.4 + 0.004 * np.array([0.3, -1.2, 0.8, 0.1, -0.5, 1.4, -0.2, 0.6, -0.9, 0.4, -0.3, 0.7])


def condition(tests, model=PAPER, oil=OIL, screw=SCREW, **options):
    return bs.condition(model, screw, oil, tests, **{"screw_speed": SPEED, **options})


def many(model, seeds, **options):
    return [bs.condition(model, SCREW, OIL, series(model, s, **options), screw_speed=SPEED) for s in range(seeds)]


def at_least(count, tries, rate):
    """Whether so many successes are as many as at least a rate gives."""
    return count >= binom.ppf(FALSE_ALARM, tries, rate)


def at_most(count, tries, rate):
    return count <= binom.ppf(1 - FALSE_ALARM, tries, rate)


# -- known truths ---------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_loss_of_10_percent_is_found_at_1_percent_noise():
    found = many(PAPER, SEEDS, lost=0.1)
    assert at_least(sum(one.alarm is not None and one.chart.falls for one in found), SEEDS, 0.9)
    # not before there is one
    assert at_most(sum(one.alarm is not None and one.alarm < 6 for one in found), SEEDS, 0.01)
    assert at_least(sum(one.states[-1].preload_low < 0.9 < one.states[-1].preload_high for one in found), SEEDS, 0.95)


@pytest.mark.slow
def test_a_drift_of_5_kelvin_that_is_logged_is_no_wear():
    found = many(PAPER, SEEDS, warmer=5.0)
    assert at_most(sum(one.alarm is not None for one in found), SEEDS, 0.05)
    assert at_most(sum(one.verdict == "lost" for one in found), SEEDS, 0.05)
    assert all(one.states[-1].preload_low < 1 < one.states[-1].preload_high for one in found)


@pytest.mark.long
def test_100_losses_of_10_percent():
    found = many(REFERENCE, MANY, lost=0.1)
    assert sum(one.alarm is not None and one.chart.falls for one in found) >= 90


@pytest.mark.long
@pytest.mark.parametrize("warmer", [0.0, 5.0])
def test_100_healthy_series_with_and_without_a_drift_that_is_logged(warmer):
    found = many(REFERENCE, MANY, warmer=warmer)
    assert sum(one.alarm is not None for one in found) <= 5
    assert sum(one.verdict == "lost" for one in found) <= 5


def test_a_hotter_oil_that_is_not_logged_is_an_alarm_of_the_torque_but_no_loss():
    table = series(PAPER, 3, warmer=25.0, logged=False)
    found = condition(table)
    assert found.alarm is not None
    assert found.lost_since is None
    assert found.verdict != "lost"
    assert found.warning_records[0].id == "condition.no_temperature"
    assert "not that the nut has worn" in found.warnings[0]
    assert "it may be the oil" in found.verdict_records[0].text
    # logged, it is no alarm
    assert condition(series(PAPER, 3, warmer=25.0)).alarm is None


def test_without_temperatures_the_bands_are_wider():
    table = series(PAPER, 1)
    without = {name: one for name, one in table.items() if name != "temperature"}
    states = [condition(one).states[-1] for one in (table, without)]
    logged, not_logged = (math.log(one.preload_high / one.preload_low) for one in states)
    assert not_logged > 2 * logged
    assert states[1].temperature is None


def test_one_speed_in_each_test_tells_no_causes_apart():
    for tests, speed, is_said in ((series(PAPER, 1), SPEED, True), (logs(PAPER, 1, [1.0] * 6), None, False)):
        found = condition(tests, screw_speed=speed)
        assert ("condition.one_speed" in {record.id for record in found.warning_records}) == is_said


def test_exact_torques_give_the_exact_preload():
    left = np.array([1, 1, 1, 1, 1, 0.9, 0.75, 0.5])
    warm = WARM + np.array([0, 3, -4, 2, 0, 8, -6, 15.0])
    nut = dataclasses.replace(SCREW.nut, preload=PRELOAD * left)
    torque = PAPER(dataclasses.replace(SCREW, nut=nut), OIL.at(warm), axial_load=0.0, screw_speed=SPEED).screw_torque
    # a factor that the case does not know changes nothing
    found = condition({"torque": 1.3 * torque, "temperature": warm, "number": np.arange(8.0)}, distributions={})
    assert [one.preload for one in found.states] == pytest.approx(left, rel=1e-6)
    assert found.factor == pytest.approx(1.3)
    assert found.reference_temperature == pytest.approx(np.mean(warm[:5]))
    at_one = PAPER(
        dataclasses.replace(SCREW, nut=nut), OIL.at(np.mean(warm[:5])), axial_load=0.0, screw_speed=SPEED
    ).screw_torque
    assert [one.torque for one in found.states] == pytest.approx(1.3 * at_one, rel=1e-6)


def test_the_reference_temperature_moves_torques_but_no_preloads():
    table = series(PAPER, 2, lost=0.3)
    one, other = (condition(table, reference_temperature=kelvin) for kelvin in (WARM, WARM - 20))
    assert other.states[-1].torque > 1.02 * one.states[-1].torque
    assert [s.preload for s in one.states] == pytest.approx([s.preload for s in other.states])


def test_both_directions_are_averaged():
    table = {"torque_forward": STEADY + 0.05, "torque_backward": -(STEADY - 0.05), "number": NUMBER}
    found = condition(table)
    assert [one.torque for one in found.states] == pytest.approx(STEADY)


def test_the_same_data_give_the_same_answer():
    table = series(PAPER, 4, lost=0.2)
    one, other = (condition(table, seed=7) for _ in range(2))
    assert one.states == other.states
    assert one.trend == other.trend


def test_dates_make_a_trend_by_time():
    days = np.datetime64("2024-01-31") + np.arange(12) * np.timedelta64(30, "D")
    found = condition({"torque": STEADY * np.linspace(1, 0.8, 12), "time": days})
    assert found.per == "s"
    assert found.states[1].label == "2024-03-01"
    slope = math.log(0.8) / found.exponent / (11 * 30 * 86400)
    assert found.trend.slope == pytest.approx(slope, rel=0.15)
    assert found.trend.low < slope < found.trend.high


# -- logs -----------------------------------------------------------------------------------------


def test_logs_of_several_speeds_tell_causes_apart():
    left = [1.0] * 5 + [0.8, 0.6]
    found = condition(logs(PAPER, 1, left), screw_speed=None)
    assert all(one.preload_low < share < one.preload_high for one, share in zip(found.states, left, strict=True))
    assert {record.subject for record in found.verdict_records if record.id == "condition.part"} == {
        "nut.preload",
        "boundary_friction_coefficient",
        "constant_torque",
        "temperature",
    }
    for state, share in zip(found.states, left, strict=True):
        assert state.parts["nut.preload"].low < share < state.parts["nut.preload"].high
        assert state.parts["constant_torque"].low < 0 < state.parts["constant_torque"].high
    assert found.states[-1].parts["nut.preload"].told


def test_seals_that_wear_are_no_preload_beside_each_other():
    found = condition(logs(PAPER, 2, [1.0] * 7, seals=[0.2] * 5 + [0.1, 0.0]), screw_speed=None)
    # alone, the preload would have to be less; beside a constant torque it need not
    assert found.states[-1].preload_high < 1
    parts = found.states[-1].parts
    assert parts["nut.preload"].low < 1 < parts["nut.preload"].high
    assert parts["constant_torque"].low < -0.2 < parts["constant_torque"].high


def test_one_direction_is_said():
    some = logs(PAPER, 3, [1.0] * 6)
    forward = [{name: one[log["screw_speed"] > 0] for name, one in log.items()} for log in some]
    found = condition(forward, screw_speed=None, kind="friction")
    assert "condition.one_direction" in {record.id for record in found.warning_records}


# -- what is said ---------------------------------------------------------------------------------


def ids(found):
    return {record.id for record in found.warning_records}


def test_repeated_torques_are_said():
    same = STEADY.copy()
    same[2:6] = 0.4911
    assert "condition.repeated" in ids(condition({"torque": same, "number": NUMBER}))
    assert "condition.repeated" not in ids(condition({"torque": STEADY, "number": NUMBER}))


def test_a_torque_of_another_screw_is_said():
    model = float(PAPER(SCREW, OIL, axial_load=0.0, screw_speed=SPEED).screw_torque)
    found = condition({"torque": STEADY * 4 * model / 0.4, "number": NUMBER})
    assert found.factor == pytest.approx(4, rel=0.01)
    assert "condition.factor" in ids(found)
    assert "condition.factor" not in ids(condition({"torque": STEADY * model / 0.4, "number": NUMBER}))


def test_a_rise_is_not_called_wear():
    found = condition({**series(PAPER, 5), "torque": series(PAPER, 5)["torque"] * np.repeat([1.0, 1.25], 15)})
    assert found.alarm is not None
    assert not found.chart.falls
    assert "look for dirt" in found.verdict_records[0].text


def test_an_oil_without_a_grade_is_said():
    oil = bs.Lubricant(viscosity=OIL.viscosity, pressure_viscosity_coefficient=OIL.pressure_viscosity_coefficient)
    found = condition(series(PAPER, 1), oil=oil)
    assert "condition.temperature_unused" in ids(found)
    assert found.temperatures == 0


def test_some_temperatures_are_missing():
    table = series(PAPER, 1)
    table["temperature"][20] = math.nan
    found = condition(table)
    assert "condition.temperature_missing" in ids(found)
    widths = [math.log(one.preload_high / one.preload_low) for one in found.states]
    assert widths[20] > 2 * widths[19]


def test_a_torque_below_that_of_the_seals_has_no_preload():
    seals = dataclasses.replace(SCREW.nut, losses={"seals": bs.Seals(0.2)})
    torque = np.full(8, 1.0) + 0.003 * np.arange(8)
    torque[-1] = 0.21
    found = condition({"torque": torque, "number": np.arange(8.0)}, screw=dataclasses.replace(SCREW, nut=seals))
    assert math.isnan(found.states[-1].preload)
    assert math.isfinite(found.states[-1].torque)
    assert "condition.no_preload" in ids(found)
    assert "cannot be told" in found.verdict_records[1].text


# -- refused --------------------------------------------------------------------------------------

TABLE = {"torque": STEADY, "number": NUMBER}


def changed(place, value, name="torque"):
    values = np.array(TABLE[name], dtype=float)
    values[place:] = value if np.ndim(value) else values[place:] * value
    return {**TABLE, name: values}


BAD = {
    "too few": ({"torque": STEADY[:5]}, {}, "condition.tests: too few: the baseline alone takes 5 (5)"),
    "too many": ({"torque": np.full(1001, 0.4)}, {}, "condition.tests: more than 1000 (1001)"),
    "baseline": (TABLE, {"baseline": 2}, "condition.baseline: is too short (2)"),
    "tolerance": (TABLE, {"tolerance": 1.0}, "condition.tolerance: must lie between 0 and 1"),
    "false alarms": (TABLE, {"false_alarms": 0.5}, "condition.false_alarms: must lie between 0.0001 and 0.1"),
    "no speed": (TABLE, {"screw_speed": None}, "condition.screw_speed: is not known"),
    "back": (
        changed(7, [6.5, 9, 10, 11, 12], "number"), {}, "series row 8, time: runs back from 7 (6.5)",
    ),
    "unit": (changed(8, 1000.0), {}, "series row 9, torque: is 989 times the tests before: the unit changes midway"),
    "guess": (changed(8, 10.1972), {}, "is it in kgf cm from here on?"),
    "guess back": (changed(8, 1e-2), {}, "were the tests before in N cm?"),
    "negative": (changed(3, -1.0), {}, "series row 4, torque: is no positive friction torque"),
    "nuts": ({**TABLE, "nut": ["A"] * 6 + ["B"] * 6}, {}, "series row 7, nut: is another than A (B)"),
    "lengths": ({"torque": STEADY, "number": NUMBER[:4]}, {}, "series: has columns of different lengths"),
    "column": ({**TABLE, "wear": STEADY}, {}, "series: has a column that is not known (wear)"),
    "one direction": ({"torque_forward": STEADY}, {}, "series: has no torque of both directions"),
    "no preload": (TABLE, {"screw": dataclasses.replace(SCREW, nut=bs.SingleNut())}, "nut: has no preload"),
    "bodies": (
        TABLE, {"screw": dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=PRELOAD, bodies=bs.Bodies()))},
        "leave out [bodies] and [deviations]",
    ),
    "no torque of the model": (
        {**TABLE, "temperature": np.where(NUMBER == 7, 30.0, 300.0)}, {}, "condition: 7: the model has no torque there",
    ),
    "uncertain": (TABLE, {"distributions": {"decai": bs.Normal(1.0, 0.1)}}, "distributions.decai: unknown name"),
}  # fmt: skip


@pytest.mark.parametrize(("tests", "options", "words"), BAD.values(), ids=BAD)
def test_refused(tests, options, words):
    with pytest.raises(bs.InputError) as error:
        condition(tests, **options)
    assert words in str(error.value)


def test_a_log_of_many_loads_is_refused():
    some = logs(PAPER, 3, [1.0] * 6)
    some[2]["axial_load"] = np.linspace(0, PRELOAD, some[2]["torque"].size)
    with pytest.raises(bs.InputError, match="log 3: log: has many loads"):
        condition(some)


def test_a_log_of_another_nut_or_unit_is_refused():
    some = logs(PAPER, 3, [1.0] * 6)
    some[4]["torque"] = 10 * some[4]["torque"]
    with pytest.raises(bs.InputError) as error:
        condition(some)
    (line,) = error.value.lines()
    assert line.startswith("log 5: log: has 9.")
    assert "times the friction of log 4" in line
