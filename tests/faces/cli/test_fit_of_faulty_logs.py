"""``ballscrew fit`` on logs that are not as they should be, and on the example."""

import subprocess
import sys

import numpy as np
import pytest

import ballscrew as bs
from support.documents import ITERATED, assert_same
from support.fit_logs import EXAMPLES, FRICTION, RPM, TRUE_FRICTION, changed, columns, document_of, refused

# -- logs that are not as they should be ----------------------------------------------------------


def gaps(data, share=0.1):
    """The same with cells without a value."""
    random = np.random.default_rng(5)
    return {name: np.where(random.random(values.size) < share, np.nan, values) for name, values in data.items()}


NOTHING = np.full(120, np.nan)
REFUSED = {
    "an empty column": (changed(torque=NOTHING), {}, ['log.csv column "torque [N m]": is empty']),
    "no unit": (columns(), {"torque": "torque"}, ["torque", "unit"]),
    "a unit of something else": (columns(), {"torque": "torque [N]"}, ["torque [N]"]),
    "text in a number": (
        changed(load=[*columns()["load"][:118], "high", "low"]), {}, ["log.csv row 120", "log.csv row 121"],
    ),
    "two rows": ({name: values[:2] for name, values in columns().items()}, {}, ["has 2 rows that can be used"]),
    # the nut of the paper has no preload
    "no load": (
        {name: values for name, values in columns().items() if name != "load"}, {},
        ["log: has no load, and the nut has no preload: no ball carries anything"],
    ),
    "always at rest": (changed(speed=np.zeros(120)), {}, ["at rest: 120"]),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_log_that_cannot_be_used_is_refused_with_the_reason(name, fit, log):
    data, headings, words = REFUSED[name]
    lines = refused(fit(log(data, **headings), "-o", "fitted.toml", "--picture", "fit.svg"), words[0])
    for word in words:
        assert any(word in line for line in lines)


def test_faulty_cells_are_left_out_if_asked(fit, log):
    data = changed(load=[*columns()["load"][:118], "high", "low"])
    found = document_of(fit(log(data), "--json", "--keep-going"))
    assert found["rows"]["used"] == 118
    assert found["rows"]["left_out"] == {"a value cannot be read": 2}
    assert any("row 120" in note for note in found["rows"]["notes"])
    without = {name: values[:118] for name, values in columns().items()}
    expected = document_of(fit(log(without), "--json"))
    assert_same(found["estimates"], expected["estimates"], ITERATED)


def test_gaps_are_left_out_and_counted(fit, log):
    data = gaps(columns())
    whole = np.all([np.isfinite(values) for values in data.values()], axis=0)
    done = fit(log(data), "--json")
    found = document_of(done)
    assert found["rows"]["left_out"] == {"a value is missing or impossible": int((~whole).sum())}
    assert found["rows"]["used"] == int(whole.sum())
    assert found["estimates"][FRICTION]["value"] == pytest.approx(TRUE_FRICTION, abs=0.01)
    assert "a value is missing or impossible" in fit(log(data)).stdout


def test_an_empty_column_that_is_not_needed_does_not_harm(fit, log):
    found = document_of(fit(log(changed(temperature=NOTHING), temperature="temperature [degC]"), "--json"))
    assert found["rows"]["used"] == 120
    assert any("no row has a temperature" in note for note in found["rows"]["notes"])


def test_rows_out_of_order_are_sorted(fit, log):
    data = {"time": np.arange(120.0), **columns()}
    order = np.random.default_rng(0).permutation(120)
    found = document_of(fit(log({name: values[order] for name, values in data.items()}), "--json"))
    assert any("sorted" in note for note in found["rows"]["notes"])
    assert found["estimates"][FRICTION]["value"] == pytest.approx(TRUE_FRICTION, abs=0.01)


TOLD = {
    "one load": (columns(loads=(1000, 1000.001)), "one axial load only"),
    "one speed": (columns(speeds=(100, 100.001)), "one speed only"),
    "one direction": (
        {name: values[columns()["speed"] > 0] for name, values in columns().items()}, "one direction only",
    ),
    "ten rows": (columns(10), "10 rows are few"),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", TOLD)
def test_what_a_log_cannot_tell_is_said_and_the_rest_is_fitted(name, fit, log):
    data, words = TOLD[name]
    found = document_of(fit(log(data), "--json"))
    assert any(words in note for note in found["rows"]["notes"])
    estimate = found["estimates"][FRICTION]
    assert abs(estimate["value"] - TRUE_FRICTION) < 5 * estimate["std"]
    assert words in fit(log(data)).stdout


def test_with_one_load_friction_and_seals_cannot_be_told_apart(fit, log):
    path = log(columns(loads=(1000, 1000.001), speeds=(100, 100.001)))
    found = document_of(fit(path, "--json", "--free", f"{FRICTION},constant_torque"))
    assert all(estimate["std"] is None for estimate in found["estimates"].values())
    assert any("cannot be told apart" in warning["text"] for warning in found["warnings"])


def half_turned(name, factor):
    """From the middle on, a column as it would be with another sign or in another unit."""
    data = columns()
    return {**data, name: np.where(np.arange(120) < 60, data[name], factor * data[name])}


@pytest.mark.parametrize(("name", "factor"), [("torque", -1), ("load", 1e-3)])
def test_signs_and_units_that_change_halfway_are_not_passed_over_in_silence(name, factor, fit, log):
    """No model follows half of the rows, and it says so."""
    found = document_of(fit(log(half_turned(name, factor)), "--json"))
    assert any("signs, units" in warning["text"] for warning in found["warnings"])


def test_the_sensor_has_an_error_or_is_not_identified(fit, log):
    found = document_of(fit(log(half_turned("load", 1e-3)), "--json"))
    assert all(estimate["std"] is None or estimate["std"] > 0 for estimate in found["sensor"].values())


def test_units_may_stand_behind_each_number(fit, log):
    data = columns()
    expected = document_of(fit(log(data), "--json"))["estimates"][FRICTION]
    mixed = [f"{load / 1000!r} kN" if i % 2 else f"{load!r} N" for i, load in enumerate(data["load"].tolist())]
    found = document_of(fit(log({**data, "load": mixed}, load="axial load"), "--json"))["estimates"][FRICTION]
    assert found["value"] == pytest.approx(expected["value"], rel=1e-9)


def test_a_log_in_other_units_is_no_other_log(fit, log):
    data = columns()
    expected = document_of(fit(log(data), "--json"))["estimates"][FRICTION]
    other = {"speed": data["speed"] * RPM, "load": data["load"] / 1000, "torque": 1000 * data["torque"]}
    path = log(other, speed="speed [rad/s]", load="axial load [kN]", torque="torque [N mm]")
    assert document_of(fit(path, "--json"))["estimates"][FRICTION]["value"] == pytest.approx(
        expected["value"], rel=1e-9
    )


# -- the example ----------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_example_log_is_what_its_script_makes():
    script = [sys.executable, str(EXAMPLES / "make_rig_log.py")]
    done = subprocess.run(script, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr


def test_the_example_log_says_that_it_is_synthetic_and_is_small():
    log = EXAMPLES / "rig_log.csv"
    first, second, *rows = log.read_text(encoding="utf-8").splitlines()
    assert first.startswith("# SYNTHETIC")
    assert second == "time [s],speed [rpm],axial load [N],torque [N m],temperature [degC]"
    assert 2500 < len(rows) < 3500
    assert log.stat().st_size < 250_000
    assert sum(row.count(",,") or row.endswith(",") for row in rows) == 12


@pytest.mark.slow
def test_the_example_is_found_out(fit):
    """The truth is that of the script; without the torque of the seals the residuals give it away."""
    log, case = EXAMPLES / "rig_log.csv", EXAMPLES / "rig.toml"
    first = document_of(fit(log, "--json", case=case))
    assert any("lowest fifth of the axial load" in warning["text"] for warning in first["warnings"])
    # the temperatures of the example are exact
    exact = ("--temperature-error", "0 K")
    second = document_of(fit(log, "--json", "--free", f"{FRICTION},constant_torque", *exact, case=case))
    assert not any("misses something" in warning["text"] for warning in second["warnings"])
    for name, true in ((FRICTION, 0.105), ("constant_torque", 0.08)):
        estimate = second["estimates"][name]
        assert abs(estimate["value"] - true) < 3 * estimate["std"] < 0.02 * true
    assert second["residual_rms"] == pytest.approx(0.015, rel=0.05)
    assert bs.__version__ == second["provenance"]["version"]
