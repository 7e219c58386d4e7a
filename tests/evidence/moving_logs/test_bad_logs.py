"""Logs that cannot be used: the fault names the row and the remedy."""

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from support.moving_logs import MODEL, OIL, SCREW_OF, record, strokes

GOOD = record(strokes(repeats=1), noise=0.3)


def changed(**columns):
    return {**{name: values.copy() for name, values in GOOD.items()}, **columns}


def fault_of(data, **options):
    with pytest.raises(InputError) as caught:
        MovingLog.of(data).checked(**options)
    (fault, *_) = caught.value.faults
    return str(fault)


def test_time_that_runs_back():
    data = changed()
    data["time"][500:] -= 0.1
    assert fault_of(data).startswith("log row 501: time runs back or stands still (0.499 to 0.4) · cut the log there")


def test_a_gap():
    data = changed()
    data["time"][500:] += 0.5
    assert fault_of(data).startswith("log row 501: a gap in time (0.499 to 1) · record without gaps")


def test_missing_values():
    data = changed()
    data["force"][500:520] = np.nan
    assert "log row 501: has no force in 20 rows one after the other" in fault_of(data)


def test_a_position_that_changes_its_unit():
    data = changed()
    data["position"][2000:] *= 1000
    assert fault_of(data).startswith("log row 2001: position jumps")
    assert "a unit changes there" in fault_of(data)


def test_a_force_that_changes_its_unit():
    data = changed()
    data["force"][3000:] /= 1000
    with pytest.raises(InputError, match="the unit of the force or of the position changes midway") as caught:
        bs.fit_motion(MODEL, SCREW_OF, OIL, data)
    row = int(caught.value.faults[0].where.rpartition(" ")[2])
    assert abs(row - 3001) < 150


def test_a_force_of_the_other_sign():
    with pytest.raises(InputError, match="sign against the acceleration"):
        bs.fit_motion(MODEL, SCREW_OF, OIL, changed(force=-GOOD["force"]))


def test_too_short():
    assert "too short" in fault_of({name: values[:100] for name, values in GOOD.items()})


@pytest.mark.parametrize("name", ["position", "force"])
def test_nothing_happens(name):
    problem = {"position": "does not move", "force": "the same force in all rows"}[name]
    assert problem in fault_of(changed(**{name: np.full(GOOD["time"].size, 0.1)}))


def test_keep_going_uses_the_longest_stretch():
    data = changed()
    data["time"][1000:] += 0.5
    log = MovingLog.of(data).checked(keep_going=True)
    assert len(log) == GOOD["time"].size - 1000
    assert any("longest stretch" in note for note in log.notes)


def test_single_missing_rows_and_uneven_steps_are_filled_in():
    keep = np.ones(GOOD["time"].size, dtype=bool)
    keep[[700, 1500, 1501]] = False
    log = MovingLog.of({name: values[keep] for name, values in GOOD.items()}).checked()
    assert len(log) == GOOD["time"].size
    np.testing.assert_allclose(log.position[700], GOOD["position"][700], atol=1e-4)
    assert any("even grid" in note for note in log.notes)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"free": "viscosity"}, "must be a list of names"),
        ({"free": ["preloud"]}, "did you mean"),
        ({"free": ["axial_load"]}, "is given by the log"),
        ({"carried_mass": -1.0}, "must not be negative"),
        ({"seed": -1}, "must be a whole number"),
    ],
)
def test_options_that_make_no_sense(options, words):
    with pytest.raises(InputError, match=words):
        bs.fit_motion(MODEL, SCREW_OF, OIL, GOOD, **options)


def test_the_log_of_a_controller_that_samples_slowly():
    """Ten rows a second of short moves: hardly a row stands clear of its noise, and no filter makes more of them."""
    random = np.random.default_rng(1)
    speed = np.tile(np.repeat([0.0, 0.03, 0.0, -0.03], [15, 4, 15, 4]), 6)
    speed = speed + np.where(speed == 0, 0.0, 0.005) * random.standard_normal(speed.size)
    force = 400 * np.sign(speed) + 100 * random.standard_normal(speed.size)
    data = {"time": 0.1 * np.arange(speed.size), "speed": np.round(speed, 3), "force": force}
    with pytest.raises(InputError, match="moves too little above its noise: ") as caught:
        bs.fit_motion(MODEL, SCREW_OF, OIL, data)
    assert "12 of 228 rows are faster than " in str(caught.value.faults[0])
    assert "a fit needs 16" in str(caught.value.faults[0])
