"""Rows that repeat earlier ones count once; readings that are alike by chance or by few digits all count."""

import numpy as np
import pytest

from ballscrew.files.torque_logs.cleaning import repeated_rows
from ballscrew.files.torque_logs.torque_log import TorqueLog


def coarse(seed, rows=4000):
    """Plateaus of load and speed, with torques of two digits."""
    random = np.random.default_rng(seed)
    load, speed = np.repeat(np.arange(20) * 100.0, rows // 20), np.repeat(random.permutation(20) * 50.0, rows // 20)
    return [load, speed, np.round(0.5 + 0.01 * random.standard_normal(rows), 2)]


def strokes(seed):
    """The same four speeds ten times over, with noise of one digit."""
    random = np.random.default_rng(seed)
    speed = np.tile(np.repeat([100.0, 200, -100, -200], 100), 10)
    noise = random.standard_normal((2, speed.size))
    return [np.full(speed.size, 1e3), np.round(speed + noise[0]), np.round(0.3 + 0.02 * noise[1], 2)]


@pytest.mark.parametrize("readings", [coarse, strokes])
@pytest.mark.parametrize("seed", range(5))
def test_readings_of_few_digits_are_no_repeats(readings, seed):
    """By chance one log of a million has one."""
    assert not repeated_rows(readings(seed)).any()


def test_two_readings_in_turn_are_no_repeats():
    assert not repeated_rows([np.tile([1.0, 2.0], 500), np.ones(1000)]).any()


def test_a_plan_measured_twice_with_few_digits_is_no_repeat():
    load, speed = (values.reshape(-1) for values in np.meshgrid([1e3, 2e3, 4e3], [50.0, 100, 200, 400]))
    columns = [np.tile(values, 2) for values in (load, speed, np.round(0.1 + 1e-4 * load + 1e-3 * speed, 2))]
    assert not repeated_rows(columns).any()
    assert not repeated_rows(columns, np.arange(24.0)).any()
    assert repeated_rows(columns, np.arange(24.0) % 12).sum() == 12  # the same clock again: the file was appended


def test_a_ripple_read_with_few_digits_is_no_repeat():
    """At every turn of the balls the same readings, but for their noise."""
    rows = np.arange(2000)
    noise = np.random.default_rng(0).standard_normal(rows.size)
    torque = np.round(0.5 + 0.05 * np.sin(2 * np.pi * rows / 20) + 0.002 * noise, 2)
    assert not repeated_rows([np.full(rows.size, 1e3), np.full(rows.size, 50.0), torque], rows * 0.01).any()


@pytest.mark.parametrize("readings", [coarse, strokes])
def test_a_part_that_was_appended_again_is_found(readings):
    first = readings(0)
    found = repeated_rows([np.concatenate([values, values[1000:2000]]) for values in first])
    assert np.flatnonzero(found).tolist() == [*range(4000, 5000)]


@pytest.mark.parametrize("clock", ["begins anew", "goes on", "none"])
def test_a_log_appended_to_itself_counts_once_and_says_so(clock):
    load, speed, torque = coarse(0)
    columns = {"axial_load": load + 1, "screw_speed": speed + 1, "torque": torque}
    log = {name: np.tile(values, 20) for name, values in columns.items()}
    if clock != "none":
        log["time"] = np.arange(80_000) % (4000 if clock == "begins anew" else 80_000) * 0.1
    found = TorqueLog.of(log).cleaned()
    assert found.left_out["repeats an earlier row"] == 76_000
    assert "76000 of 80000 rows repeat earlier ones, one after the other: counted once" in found.notes
    assert set(found.line) <= set(range(1, 4001))
