"""Logs of torque: what of them is fit to calibrate a model, and what is said of the rest."""

import dataclasses

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

from ballscrew.basis.errors import InputError
from ballscrew.files.torque_logs import cleaning, log_rows
from ballscrew.files.torque_logs.motion import SCALES, motion_of, runs_in
from ballscrew.files.torque_logs.reservoir_sampler import ReservoirSampler
from ballscrew.files.torque_logs.torque_log import TorqueLog
from support.log_texts import lines_of

LEAD, FRICTION, INERTIA = 0.01, 0.3, 0.01
#: A cycle: times, speeds at them, and the acceleration between them.
TIMES, SPEEDS = [0.0, 0.2, 2.0, 2.2, 2.7, 2.9, 4.7, 4.9, 5.0], [0.0, 100, 100, 0, 0, -100, -100, 0, 0]


def cycle(rows=2000, step=0.01, noise=0.0, inertia=INERTIA, **changes):
    """A drive log over trapezoids of speed, half a step off their corners, and the true acceleration of each row."""
    time = (np.arange(rows) + 0.5) * step
    phase = time % TIMES[-1]
    speed = np.interp(phase, TIMES, SPEEDS)
    acceleration = (np.diff(SPEEDS) / np.diff(TIMES))[np.searchsorted(TIMES, phase, side="right") - 1]
    load = 1000 + 500 * np.sin(time)
    torque = load * LEAD / (2 * np.pi) + FRICTION * np.sign(speed) + inertia * acceleration
    speed = speed + noise * np.random.default_rng(3).standard_normal(rows)
    columns = {"axial_load": load, "screw_speed": speed, "drive_torque": torque, "time": time}
    return {**columns, **changes}, acceleration


def steady_torque(log):
    return log.axial_load * LEAD / (2 * np.pi) + FRICTION * np.sign(log.screw_speed)


def simple(**changes):
    """Twelve rows in both directions, of three speeds and three loads."""
    speed = np.array([10.0, 20, 30, 10, 20, 30, -10, -20, -30, -10, -20, -30])
    load = np.tile([100.0, 200, 300], 4)
    return {"axial_load": load, "screw_speed": speed, "friction_torque": (0.1 + load / 1e4) * np.sign(speed), **changes}


# -- data from Python -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "form", [dict, pd.DataFrame, lambda data: xr.Dataset({k: ("row", v) for k, v in data.items()})]
)
def test_a_log_of_arrays(form):
    log = TorqueLog.of(form(simple(temperature=np.full(12, 300.0))))
    assert log.kind == "friction"
    assert len(log) == log.rows == 12
    assert log.torque.tolist() == simple()["friction_torque"].tolist()
    assert log.temperature.tolist() == [300.0] * 12
    assert log.time is None
    assert log.line.tolist() == list(range(1, 13))
    assert log.forward.sum() == log.backward.sum() == 6
    assert TorqueLog.of(log) is log


def test_numbers_stand_for_every_row_and_datasets_are_flattened():
    log = TorqueLog.of(simple(axial_load=7))
    assert log.axial_load.tolist() == [7.0] * 12
    grid = xr.Dataset(
        {"torque": (("load", "speed"), np.arange(6.0).reshape(2, 3))},
        {"axial_load": ("load", [1.0, 2]), "screw_speed": ("speed", [3.0, 4, 5])},
    )
    log = TorqueLog.of(grid)
    assert log.kind == "unknown"
    assert log.axial_load.tolist() == [1, 1, 1, 2, 2, 2]
    assert log.screw_speed.tolist() == [3, 4, 5] * 2
    assert log.torque.tolist() == [0, 1, 2, 3, 4, 5]


def test_dates_are_seconds():
    dates = np.array(["2024-05-01T12:00:00", "2024-05-01T12:00:01.5", "NaT"], dtype="datetime64[ns]")
    log = TorqueLog.of({"axial_load": 1, "screw_speed": 2, "torque": [1, 2, 3], "time": dates})
    assert log.time[:2].tolist() == [0.0, 1.5]
    assert np.isnan(log.time[2])


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"screw_speed": None}, 'data: has no column "screw_speed" · give an array in rad/s'),
        ({"friction_torque": None}, 'data: has no column "torque" · give an array in N m'),
        ({"axial_load": [1.0, 2.0]}, "log: has columns of different lengths (axial_load 2, screw_speed 12, torque 12"),
        ({"axial_load": ["a"] * 12}, "data.axial_load: must be an array of numbers (a) · give a numpy.array of floats"),
        ({"axial_load": np.ones((12, 1))}, "data.axial_load: must have one dimension ((12, 1))"),
        ({"axial_load": np.ones(12, complex)}, "data.axial_load: must be an array of numbers (complex128)"),
        ({"temperature": np.full(12, 40.0)}, "data.temperature: must be in kelvin (40) · add 273.15"),
        ({"drive_torque": np.ones(12)}, "data: has more than one torque (friction_torque, drive_torque)"),
    ],
)
def test_faults_of_arrays(changes, expected):
    data = {name: values for name, values in simple(**changes).items() if values is not None}
    (line,) = lines_of(TorqueLog.of, data)
    assert line.startswith(expected)


def test_names_nearly_right():
    data = simple()
    data["axial_loads"] = data.pop("axial_load")
    assert lines_of(TorqueLog.of, data) == ['data: has no column "axial_load" · did you mean "axial_loads"?']
    assert lines_of(TorqueLog.of, 5) == [
        "data: is no log (int) · give a mapping of arrays, a pandas DataFrame or an xarray Dataset"
    ]
    assert TorqueLog.of(simple(colour=np.ones(12))).notes == ("columns not used: colour",)


def test_none_is_a_value_that_is_missing():
    log = TorqueLog.of({"axial_load": [1, None, 3, 4], "screw_speed": 5.0, "torque": [1.0] * 4}).cleaned()
    assert log.line.tolist() == [1, 3, 4]
    assert log.left_out == {"a value is missing or impossible": 1}


# -- gaps, rest, thinning -------------------------------------------------------------------------


def test_every_row_is_used_or_counted():
    data, _ = cycle(noise=0.02)
    data["axial_load"][::7] = np.nan
    log = TorqueLog.of(data).cleaned(most=500)
    assert len(log) == 500
    assert log.rows == 2000 == len(log) + sum(log.left_out.values())
    assert log.left_out["a value is missing or impossible"] == 286
    assert set(log.left_out) == {"a value is missing or impossible", "speed changes", "at rest", "thinned"}


def test_rows_without_temperature_go_unless_there_is_none_at_all():
    temperature = np.full(12, 300.0)
    temperature[4] = np.nan
    assert len(TorqueLog.of(simple(temperature=temperature)).cleaned()) == 11
    log = TorqueLog.of(simple(temperature=np.full(12, np.nan))).cleaned()
    assert len(log) == 12
    assert log.temperature is None
    assert "no row has a temperature: the column is not used" in log.notes
    assert lines_of(TorqueLog.of(simple(axial_load=np.full(12, np.nan))).cleaned) == [
        "log: has no axial load in any row · give a column with numbers in it"
    ]


def test_rest_is_small_against_the_largest_speed_were_it_not_for_outliers():
    speed = np.concatenate([np.full(4000, 100.0), [0.005, -0.005, 0.02, 1e9]])
    log = TorqueLog.of({"axial_load": 1.0, "screw_speed": speed, "torque": np.ones(4004)}).cleaned()
    assert log.left_out == {"at rest": 2}


def test_rest_with_noise():
    data, _ = cycle(rows=5000, noise=0.1)
    data["screw_speed"][np.abs(data["screw_speed"]) < 0.5] += 0.12  # beyond the share of the largest
    log = TorqueLog.of(data).cleaned()
    assert np.abs(log.screw_speed).min() > 90


def test_thinning_is_even_and_always_the_same():
    data = {"axial_load": 1.0, "screw_speed": np.full(20_000, 5.0), "torque": np.ones(20_000)}
    one, other = (TorqueLog.of(data).cleaned(most=2000) for _ in range(2))
    assert one.line.tolist() == other.line.tolist()
    assert len(one) == 2000
    assert one.left_out == {"thinned": 18_000}
    assert "longer than 2000 rows: thinned evenly at random" in one.notes
    counts, _ = np.histogram(one.line, bins=10, range=(1, 20_001))
    assert np.abs(counts - 200).max() < 5 * np.sqrt(200 * 0.9)
    assert np.all(np.diff(one.line) > 0)
    # a smaller sample is part of the larger one
    assert set(TorqueLog.of(data).cleaned(most=500).line) < set(one.line)


def test_too_few_rows():
    two = {"axial_load": [1.0, 2.0, 3.0], "screw_speed": [1.0, 2.0, 0.0], "torque": [1.0, 2.0, 3.0]}
    assert lines_of(TorqueLog.of(two).cleaned) == [
        "log: has 2 rows that can be used (at rest: 1) · a fit needs 3 rows or more at steady speed"
    ]
    two["screw_speed"] = [1.0, 2.0, 3.0]
    log = TorqueLog.of(two).cleaned()
    assert len(log) == 3
    assert "3 rows are few: expect wide intervals, or none" in log.notes


def test_cleaning_twice_changes_nothing():
    data, _ = cycle(noise=0.1)
    once = TorqueLog.of(data).cleaned(inertia=INERTIA)
    assert once.cleaned(inertia=INERTIA) is once
    assert once.keys is None
    assert once.motion is None


# -- acceleration ---------------------------------------------------------------------------------


@pytest.mark.parametrize("step", [0.0005, 0.005, 0.05])
@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_ramps_go_and_steady_rows_stay(step, noise):
    data, acceleration = cycle(int(20 / step), step, noise)
    log = TorqueLog.of(data).cleaned()
    assert not acceleration[log.line - 1].any()
    steady = np.flatnonzero((acceleration == 0) & (np.abs(data["screw_speed"]) > 50)) + 1
    assert np.isin(steady, log.line).mean() > 0.94  # at the slowest, 2 of 36 rows see a ramp beside them
    assert log.torque == pytest.approx(steady_torque(log), abs=1e-12)


@pytest.mark.parametrize("inertia", [None, INERTIA])
def test_rows_that_may_hide_a_ramp_go_too(inertia):
    """The ends of a fast and noisy log that begins in a ramp: windows that fit there can tell nothing."""
    data, acceleration = cycle(20_000, 0.001, 0.5)
    log = TorqueLog.of(data).cleaned(inertia=inertia)
    assert acceleration[0] != 0
    assert not acceleration[log.line - 1].any()
    assert len(log) > 10_000


def test_the_inertia_is_taken_off_exactly():
    """A slow ramp stays with an inertia, and its torque is that of steady motion; fast ramps go."""
    time = np.arange(4001) * 0.01
    speed = np.interp(time, [0, 10, 20, 30, 30.1, 40], [50, 50, 80, 80, 20, 20])
    acceleration = np.select([(time > 10) & (time < 20), (time > 30) & (time < 30.1)], [3.0, -600.0])
    load = np.full(time.size, 1000.0)
    torque = load * LEAD / (2 * np.pi) + FRICTION + INERTIA * acceleration
    log = TorqueLog.of({"axial_load": load, "screw_speed": speed, "drive_torque": torque, "time": time})
    clean = log.cleaned(inertia=INERTIA)
    assert clean.left_out == {"speed changes": 11}
    inside = ~np.isin(clean.line, [1001, 2001])  # the corners, where half of the slope is seen
    assert clean.torque[inside] == pytest.approx(steady_torque(clean)[inside], abs=1e-9)
    assert clean.torque == pytest.approx(steady_torque(clean), abs=INERTIA * 3)
    assert "the torque that accelerates the inertia is taken off" in clean.notes
    assert 990 < log.cleaned().left_out["speed changes"] < 1015


def test_an_acceleration_lost_in_noise_is_not_taken_off():
    """Speeds so noisy that no window tells what the inertia takes: their noise is kept out of the torque."""
    data, _ = cycle(20_000, 0.0005, 5.0)
    log = TorqueLog.of(data).cleaned(inertia=INERTIA)
    steady = np.abs(log.screw_speed) > 80
    assert log.torque[steady] == pytest.approx(data["drive_torque"][log.line - 1][steady], abs=0)
    # the widest window is the one that sees most ramps
    assert log.left_out["speed changes"] > 2500


def test_a_torque_of_friction_has_no_share_of_the_inertia():
    data, _ = cycle(inertia=0.0)
    data["friction_torque"] = FRICTION * np.sign(data["screw_speed"])
    del data["drive_torque"]
    log = TorqueLog.of(data).cleaned(inertia=INERTIA)
    assert np.abs(log.torque).tolist() == [FRICTION] * len(log)
    assert "the inertia is not used: a torque of friction has no share of it" in log.notes


@pytest.mark.parametrize("inertia", [-1.0, np.nan, "1"])
def test_an_inertia_that_is_none(inertia):
    (line,) = lines_of(TorqueLog.of(simple()).cleaned, inertia=inertia)
    assert line.startswith("log.inertia: must ")


def test_without_time_nothing_goes_and_it_is_said():
    data, _ = cycle()
    del data["time"]
    log = TorqueLog.of(data).cleaned(inertia=INERTIA)
    assert set(log.left_out) <= {"at rest"}
    assert "no time: rows under acceleration cannot be told from the others, and all stay" in log.notes
    assert "the inertia is not used, for it takes a trace of the speed over time" in log.notes


def test_a_speed_that_never_rests_is_said():
    time = np.arange(5000) * 0.01
    data = {"axial_load": 100.0, "screw_speed": 60 + 40 * np.sin(5 * time), "torque": np.ones(5000), "time": time}
    log = TorqueLog.of(data).cleaned()
    assert not log.left_out
    assert any(note.startswith("the speed hardly rests") for note in log.notes)
    data, _ = cycle(noise=0.1)
    assert not any("hardly rests" in note for note in TorqueLog.of(data).cleaned().notes)


def test_slow_drift_stays():
    time = np.arange(1000) * 1.0
    data = {"axial_load": 100.0, "screw_speed": 100 + time / 100, "torque": np.ones(1000), "time": time}
    assert not TorqueLog.of(data).cleaned().left_out


def test_jitter_of_the_clock():
    data, acceleration = cycle(4000, 0.005)
    rng = np.random.default_rng(5)
    kept = np.sort(rng.choice(4000, 3000, replace=False))
    data = {name: values[kept] for name, values in data.items()}
    log = TorqueLog.of(data).cleaned()
    assert not acceleration[kept][log.line - 1].any()
    steady = np.flatnonzero((acceleration[kept] == 0) & (np.abs(data["screw_speed"]) > 50)) + 1
    assert np.isin(steady, log.line).mean() > 0.97


def test_a_clock_that_is_coarser_than_the_rows():
    data, acceleration = cycle(20_000, 0.001)
    data["time"] = np.floor(data["time"] / 0.02) * 0.02  # twenty rows of the same time
    log = TorqueLog.of(data).cleaned()
    assert not acceleration[log.line - 1].any()
    steady = np.flatnonzero((acceleration == 0) & (np.abs(data["screw_speed"]) > 50)) + 1
    assert np.isin(steady, log.line).mean() > 0.95
    stuck = TorqueLog.of({**data, "time": np.full(20_000, 3.0)}).cleaned()
    assert "speed changes" not in stuck.left_out


def test_nothing_is_differentiated_across_a_gap():
    time = np.concatenate([np.arange(100) * 0.01, 3.0 + np.arange(100) * 0.01])
    speed = np.repeat([20.0, 90.0], 100)
    data = {"axial_load": 100.0, "screw_speed": speed, "torque": np.ones(200), "time": time}
    assert not TorqueLog.of(data).cleaned().left_out
    data["time"] = np.arange(200) * 0.01
    assert TorqueLog.of(data).cleaned().left_out == {"speed changes": 2}


# -- order of time --------------------------------------------------------------------------------


@given(st.integers(0, 2**32 - 1), st.integers(40, 300))
@settings(max_examples=30, deadline=None)
def test_a_shuffled_log_is_the_sorted_one(seed, rows):
    data, _ = cycle(rows, 0.05, 0.01)
    order = np.random.default_rng(seed).permutation(rows)
    mixed = {name: values[order] for name, values in data.items()}
    one, other = TorqueLog.of(data).cleaned(inertia=INERTIA), TorqueLog.of(mixed).cleaned(inertia=INERTIA)
    assert "rows were not in the order of time: sorted" in other.notes
    for name, values in one.columns.items():
        assert getattr(other, name).tolist() == values.tolist()
    assert (order[other.line - 1] + 1).tolist() == one.line.tolist()
    assert other.left_out == one.left_out


def test_logs_one_after_the_other_are_not_mixed():
    data, acceleration = cycle(3000)
    other = {**data, "drive_torque": 1.01 * data["drive_torque"]}  # the same readings again would count once
    twice = {name: np.concatenate([values, other[name][:2000]]) for name, values in data.items()}
    log = TorqueLog.of(twice).cleaned()
    assert "time begins anew 1 times: read as 2 logs, one after the other" in log.notes
    assert np.all(np.diff(log.line) > 0)
    assert not np.concatenate([acceleration, acceleration[:2000]])[log.line - 1].any()


@pytest.mark.parametrize(
    ("time", "runs"),
    [
        (np.arange(20.0), 1),
        (np.zeros(20), 1),
        (np.tile(np.arange(10.0), 2), 2),
        (np.arange(20.0)[::-1], None),
        (np.array([0.0, 1, 2, 4, 3, 5, 6, 7, 8, 9]), None),
        (np.array([0.0, 1, 2, 0, 1]), None),
        (np.array([5.0]), 1),
    ],
)
def test_runs(time, runs):
    assert runs_in(time) == runs


# -- signs ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["torque", "friction_torque", "drive_torque"])
@pytest.mark.parametrize("turned", ["as it is", "reversed", "magnitude"])
def test_cleaning_leaves_signs_alone(kind, turned):
    """What they mean, only a model can tell."""
    data = simple()
    torque = data.pop("friction_torque")
    data[kind] = {"as it is": torque, "reversed": -torque, "magnitude": np.abs(torque)}[turned]
    log = TorqueLog.of(data).cleaned()
    for name in ("axial_load", "screw_speed"):
        assert getattr(log, name).tolist() == data[name].tolist()
    assert log.torque.tolist() == data[kind].tolist()
    assert log.kind == {"torque": "unknown", "friction_torque": "friction", "drive_torque": "drive"}[kind]
    assert not any("sign" in note or "magnitude" in note for note in log.notes)


# -- what cannot be told --------------------------------------------------------------------------


def test_what_a_log_cannot_tell():
    def notes(**changes):
        found = TorqueLog.of(simple(time=60 * np.arange(12.0), **changes)).cleaned().notes
        return tuple(note for note in found if "jump from row to row" not in note)

    assert notes(temperature=np.linspace(290, 320, 12)) == ("12 rows are few: expect wide intervals, or none",)
    assert "no temperature: the oil is taken to be as warm as in the case" in notes()
    assert "one temperature only: what depends on the temperature cannot be told" in notes(temperature=300.0)
    assert "one axial load only: what depends on the load cannot be told" in notes(axial_load=-5.0)
    speed = 20 * np.sign(simple()["screw_speed"])
    assert "one speed only: what depends on the speed cannot be told" in notes(screw_speed=speed)
    assert not any(note.startswith("one ") for note in notes())


# -- piece by piece -------------------------------------------------------------------------------


def gathered(data, pieces, held):
    gathering = ReservoirSampler(held)
    line = np.arange(1, data["axial_load"].size + 1)
    for places in np.array_split(np.arange(line.size), pieces):
        columns = {name.replace("drive_", ""): values[places] for name, values in data.items()}
        gathering.add(columns, line[places])
    return gathering.log("drive")


def same(one, other):
    assert one.line.tolist() == other.line.tolist()
    for name, values in one.columns.items():
        assert getattr(other, name).tolist() == values.tolist()
    assert one.left_out == other.left_out
    assert one.notes == other.notes


@pytest.mark.parametrize("pieces", [1, 7, 60, 700])
@pytest.mark.parametrize("clock", [0.0, 0.013])
def test_a_log_read_in_pieces_is_the_log_read_whole(monkeypatch, pieces, clock):
    data, _ = cycle(6000, 0.004, 0.05)
    data["axial_load"][::11] = np.nan
    data["temperature"] = np.full(6000, 300.0)
    data["temperature"][::13] = np.nan
    if clock:
        data["time"] = np.floor(data["time"] / clock) * clock
    monkeypatch.setattr(cleaning, "HELD", 1500)
    whole = TorqueLog.of(data).cleaned(inertia=INERTIA, most=600)
    same(gathered(data, pieces, 1500).cleaned(inertia=INERTIA, most=600), whole)
    assert whole.left_out["thinned"] > 4000
    assert len(whole) <= 600


def test_motion_is_found_before_rows_go():
    data, _ = cycle(5000, 0.002, 0.1)
    log = gathered(data, 50, 700)
    whole = motion_of(data["time"] - data["time"][0], data["screw_speed"]).select(log.line - 1)
    np.testing.assert_array_equal(log.motion.slope, whole.slope)
    np.testing.assert_array_equal(log.motion.span, whole.span)
    np.testing.assert_array_equal(log.motion.bend, whole.bend)
    assert len(log) == 700


def test_long_logs_out_of_order():
    data, _ = cycle(3000)
    order = np.random.default_rng(1).permutation(3000)
    log = gathered({name: values[order] for name, values in data.items()}, 10, 500)
    assert log.time is None
    assert log.motion is None
    assert "rows are not in the order of time, and too many to sort (over 500): sort the file" in log.notes
    clean = log.cleaned()
    assert "speed changes" not in clean.left_out
    twice = {name: np.concatenate([values, values]) for name, values in data.items()}
    assert "time begins anew 1 times: read as 2 logs, one after the other" in gathered(twice, 10, 500).notes


def test_long_logs_with_an_empty_time_or_none():
    data, _ = cycle(3000)
    empty = gathered({**data, "time": np.full(3000, np.nan)}, 10, 500)
    assert len(empty) == 500
    assert empty.time is None
    none = gathered({name: values for name, values in data.items() if name != "time"}, 10, 500)
    assert none.line.tolist() == empty.line.tolist()
    stuck = gathered({**data, "time": np.zeros(3000)}, 10, 500)
    assert stuck.line.tolist() == empty.line.tolist()


def test_a_time_that_stands_still_does_not_pile_up():
    gathering = ReservoirSampler(500)
    for piece in range(30):
        columns = {name: np.ones(200) for name in ("axial_load", "screw_speed", "torque", "time")}
        gathering.add(columns, np.arange(200 * piece, 200 * (piece + 1)))
        assert gathering.waiting <= 700


def test_a_straight_ramp_has_its_slope_at_every_row_and_scale():
    time = np.arange(400) + np.random.default_rng(2).uniform(-0.4, 0.4, 400)
    motion = motion_of(time, 3.0 + 2.0 * time)
    for row, scale in zip(motion.slope, SCALES, strict=True):
        known = np.isfinite(row)
        assert known.sum() >= 400 - 2 * scale if scale > 1 else known.all()
        assert row[known] == pytest.approx(2.0, rel=1e-9)
    assert motion.noise() < 1e-12


def test_the_noise_of_a_speed_is_found_beside_ramps():
    data, _ = cycle(5000, 0.005, 0.2)
    assert motion_of(data["time"], data["screw_speed"]).noise() == pytest.approx(0.2, rel=0.05)


def test_a_log_is_one_of_equal_columns():
    log = TorqueLog.of(simple())
    with pytest.raises(InputError, match="has columns of different lengths"):
        dataclasses.replace(log, torque=np.ones(3))
    with pytest.raises(InputError, match="has columns of different lengths"):
        dataclasses.replace(log, line=np.ones(3))


@pytest.mark.parametrize("repeats", [1, 2, 5])
def test_readings_of_single_settings_all_stay(repeats):
    random = np.random.default_rng(1)
    settings = np.exp(random.uniform(np.log(1.0), np.log(100.0), 200)) * random.choice([-1.0, 1.0], 200)
    speed = np.repeat(settings, repeats)
    log = TorqueLog.of(
        {
            "axial_load": 1000.0,
            "screw_speed": speed,
            "friction_torque": 0.1 * np.sign(speed),
            "time": np.arange(speed.size),
        }
    ).cleaned()
    assert len(log) == speed.size
    assert any("jump from row to row" in note for note in log.notes)


def test_a_swinging_motion_is_no_row_of_settings():
    time = np.arange(0.0, 100.0, 0.1)
    speed = 50.0 * np.sin(2 * np.pi * time / 2.0)  # twenty rows a period
    log = TorqueLog.of(
        {"axial_load": 1000.0, "screw_speed": speed, "friction_torque": 0.1 * np.sign(speed), "time": time}
    )
    assert not any("jump" in note for note in log.cleaned().notes)


def test_arrays_without_a_load_are_those_of_no_load_and_say_so():
    data = {name: values for name, values in simple().items() if name != "axial_load"}
    found = TorqueLog.of(data)
    assert not found.axial_load.any()
    assert "no axial load: 0 N in every row" in found.notes
    # one that is there by another name is asked for
    assert lines_of(TorqueLog.of, {**data, "pull": np.ones(12)})[0].startswith('data: has no column "axial_load"')


def test_rows_of_a_log_are_not_converted_again(monkeypatch):
    log = TorqueLog.of({"axial_load": [1e3, 2e3], "screw_speed": [1, 2], "torque": [0.1, 0.2]})
    monkeypatch.setattr(log_rows, "si_value", None)
    chosen = log.select(np.array([False, True])).with_notes("second")
    assert (chosen.torque.tolist(), chosen.screw_speed.tolist(), chosen.notes) == ([0.2], [2.0], ("second",))
