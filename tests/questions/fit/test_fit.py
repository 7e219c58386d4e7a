"""``ballscrew fit``: what it prints, writes and draws, and what it says of logs that are not as they should be."""

import hashlib
import json
import re
import tomllib

import numpy as np
import pytest

from ballscrew import __version__
from support.documents import ITERATED, assert_same
from support.fit_logs import (
    EXAMPLES,
    FRICTION,
    NOISE,
    OFFSET,
    PAPER,
    RPM,
    changed,
    columns,
    refused,
)
from support.processes import document_of

# -- what it writes -------------------------------------------------------------------------------


def test_a_case_file_is_written_whole(fit, log):
    path = log()
    done = fit(path, "--free", f"{FRICTION},constant_torque", "-o", "fitted.toml", "--seed", 3, "--holdout", 0.1)
    assert done.returncode == 0, done.stderr
    assert "fitted.toml: the calibrated model" in done.stdout
    assert [file.name for file in done.place.iterdir()] == ["fitted.toml"]
    tables = tomllib.loads((done.place / "fitted.toml").read_text(encoding="utf-8"))
    given = tomllib.loads(PAPER)
    for section in ("screw", "lubricant", "operation"):
        assert tables[section] == given[section]
    said = document_of(fit(path, "--free", f"{FRICTION},constant_torque", "--seed", 3, "--holdout", 0.1, "--json"))
    estimate = said["estimates"][FRICTION]
    value, half = (float(part) for part in tables["model"]["friction"][FRICTION].split(" ± "))
    assert value == pytest.approx(estimate["value"], rel=1e-11)
    assert half == pytest.approx(1.959964 * estimate["std"], rel=1e-6)
    assert tables["model"]["name"] == "olaru2005"
    calibration = tables["calibration"]
    assert calibration["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
    assert calibration["log"] == "log.csv"
    assert calibration["version"] == __version__
    assert calibration["settings"]["seed"] == 3
    assert calibration["settings"]["holdout"] == 0.1
    assert calibration["settings"]["free"] == [FRICTION, "constant_torque"]
    assert calibration["numbers"] == [f"friction.{FRICTION}", "losses.constant.constant_torque"]
    constant = said["estimates"]["constant_torque"]
    variances = [calibration["covariance"][i][i] for i in range(2)]
    assert variances == [pytest.approx(one["std"] ** 2) for one in (estimate, constant)]
    # the constant torque is a loss of the nut, and so in all answers
    assert tables["losses"]["constant"]["law"] == "known"
    value, half = (part.removesuffix(" N m") for part in tables["losses"]["constant"]["constant_torque"].split(" ± "))
    assert float(value) == pytest.approx(constant["value"], rel=1e-11)
    assert float(half) == pytest.approx(1.959964 * constant["std"], rel=1e-6)


def test_a_constant_torque_that_would_help_is_named(fit, log):
    """Seals of 0.1 N m, which the noise of 0.004 N m does not hide; with them free nothing is left to say."""
    data = columns()
    path = log({**data, "torque": data["torque"] + 0.1 * np.sign(data["speed"])})
    first, *_ = document_of(fit(path, "--json"))["warnings"]
    assert first["id"] == "fit.free_more"
    assert first["value"] == pytest.approx(NOISE, rel=0.3)
    assert "with the constant torque free, too, the rows miss by" in first["text"]
    healthy = (fit(log(), "--json"), fit(path, "--json", "--free", f"{FRICTION},constant_torque"))
    for done in healthy:
        assert "fit.free_more" not in {warning["id"] for warning in document_of(done)["warnings"]}


def test_a_fit_is_not_lost_for_want_of_a_next_test(fit, log):
    found = document_of(fit(log(), "--limits", "axial_load=1:2 GN", "--json"))
    assert found["next_test"] is None
    assert any("no next test" in warning["text"] for warning in found["warnings"])
    assert found["estimates"][FRICTION]["identified"]


def test_numbers_that_are_not_identified_are_written_without_an_error(fit, log):
    path = log(columns(400, speeds=(10, 600)))
    done = fit(path, "--free", f"{FRICTION},{OFFSET}", "-o", "fitted.toml", "--keep-going")
    assert done.returncode == 0, done.stderr
    text = (done.place / "fitted.toml").read_text(encoding="utf-8")
    calibration = tomllib.loads(text)["calibration"]
    assert set(calibration["not_identified"]) == {f"friction.{FRICTION}", OFFSET}
    assert calibration["numbers"] == []
    assert "±" not in text


@pytest.mark.slow
@pytest.mark.parametrize(
    ("data", "free", "reason"),
    [
        (changed(torque=1000 * columns()["torque"]), FRICTION, "implausible: boundary friction coefficient "),
        (columns(400, speeds=(10, 600)), f"{FRICTION},{OFFSET}", "the log does not determine: boundary friction "),
    ],
)
def test_a_fit_that_is_warned_against_is_shown_and_only_written_where_that_is_asked_for(data, free, reason, fit, log):
    path = log(data)
    asked = ("--free", free, "-o", "fitted.toml", "--picture", "fit.svg")
    done = fit(path, *asked)
    assert done.returncode == 2
    (line,) = done.stderr.strip().splitlines()
    assert line.startswith(f"--to: is not written: {reason}")
    assert line.endswith("or write it all the same by --keep-going")
    assert "warning  " in done.stdout or "\nimplausible: " in done.stdout
    assert list(done.place.iterdir()) == []
    asked_for = fit(path, *asked, "--keep-going")
    assert asked_for.returncode == 0, asked_for.stderr
    assert {file.name for file in done.place.iterdir()} == {"fitted.toml", "fit.svg"}


def test_json_stays_alone_on_its_stream(fit, log):
    done = fit(log(), "--json", "-o", "fitted.toml", "--picture", "fit.svg")
    document_of(done)
    assert "fitted.toml: the calibrated model" in done.stderr
    assert {file.name for file in done.place.iterdir()} == {"fitted.toml", "fit.svg"}


# -- what can be asked ----------------------------------------------------------------------------


def test_the_next_test_is_one_that_the_rig_of_the_log_can_give(fit, log):
    """It asked for twice the largest load of the log, which nobody knows the rig to have."""
    path, data = log(), columns()
    point = document_of(fit(path, "--json"))["next_test"]["point"]
    assert point["axial_load"] <= np.abs(data["load"]).max() * (1 + 1e-9)
    assert point["screw_speed"] <= np.abs(data["speed"]).max() * RPM * (1 + 1e-9)
    assert "of the loads and speeds that the log has" in " ".join(fit(path).stdout.split())


def test_a_motor_current_with_its_torque_constant(fit, log):
    data = columns()
    expected = document_of(fit(log(data), "--json"))["estimates"][FRICTION]
    path = log({**data, "torque": data["torque"] / 0.5}, torque="motor current [A]")
    found = document_of(fit(path, "--json", "--torque-constant", "0.5 N m/A"))["estimates"][FRICTION]
    assert found["value"] == pytest.approx(expected["value"], rel=1e-6)
    (line,) = refused(fit(path), "needs the torque constant")
    assert "--torque-constant" in line


def test_headings_by_hand(fit, log):
    data = columns()
    expected = document_of(fit(log(data), "--json"))["estimates"]
    path = log({**data, "torque": 1000 * data["torque"]}, torque="Kanal 7", load="Kanal 8")
    by_hand = ("--column", "torque=Kanal 7 [N mm]", "--column", "axial_load=Kanal 8 [N]")
    found = document_of(fit(path, "--json", *by_hand))["estimates"]
    assert found[FRICTION]["value"] == pytest.approx(expected[FRICTION]["value"], rel=1e-6)


# -- the error of the oil temperature --------------------------------------------------------------

RIG = ["fit", str(EXAMPLES / "rig_log.csv"), "--case", str(EXAMPLES / "rig.toml")]
#: The model of the paper answers the quickest.
QUICK = [*RIG, "--model", "olaru2005"]


@pytest.mark.slow
def test_the_text_says_what_part_of_the_errors_it_makes(ballscrew):
    said = ballscrew(*RIG, "--free", f"{FRICTION},constant_torque").stdout
    assert (
        "in the errors: 2 K of oil temperature either way (95 %), the same in all rows; of the variance they make"
        in said
    )
    assert "for the constant torque" in said
    none = ballscrew(*QUICK, "--temperature-error", "0 K").stdout
    assert "none of the oil temperature" in none


@pytest.mark.slow
def test_the_error_of_a_temperature_that_the_case_has_is_that_of_the_case(ballscrew, tmp_path):
    import pandas

    table = pandas.read_csv(EXAMPLES / "rig_log.csv", comment="#").drop(columns="temperature [degC]")
    table.to_csv(tmp_path / "log.csv", index=False)
    asked = ["fit", str(tmp_path / "log.csv"), *QUICK[2:], "--json"]
    case = ["--set", "lubricant.temperature=35 ± 3 degC"]
    unknown, given, said = (
        json.loads(ballscrew(*asked, *more).stdout)["temperature_error"]
        for more in ([], case, [*case, "--temperature-error", "1 K"])
    )
    assert (unknown, given, said) == (10.0, pytest.approx(3.0), 1.0)


# -- numbers that no screw has -----------------------------------------------------------------------


@pytest.mark.slow
def test_a_fit_of_a_sensor_that_is_off_says_so_first_and_so_do_predictions_with_it(ballscrew, tmp_path):
    """A log of one direction whose zero is off by -0.2 N m: the constant torque is a loss that drives the screw."""
    import pandas

    table = pandas.read_csv(EXAMPLES / "rig_log.csv", comment="#")
    table["torque [N m]"] -= 0.2
    table[table["speed [rpm]"] > 0].to_csv(tmp_path / "log.csv", index=False)
    made = tmp_path / "fitted.toml"
    asked = ["fit", str(tmp_path / "log.csv"), *RIG[2:], "--free", f"{FRICTION},constant_torque", "--kind", "drive"]
    said = ballscrew(*asked, "-o", str(made), "--keep-going").stdout
    assert said.splitlines()[2].startswith("implausible: constant torque -0.0")
    assert "N m" in said.partition(" is outside")[0].replace("·", " ")
    found = json.loads(ballscrew(*asked, "--json").stdout)
    assert [(record["id"], record["subject"]) for record in found["verdicts"]] == [
        ("fit.implausible", "constant_torque")
    ]
    assert found["estimates"]["constant_torque"]["value"] < -0.05
    run = json.loads(ballscrew("run", str(made), "--json").stdout)
    assert {"calibration.implausible", "inputs.implausible"} <= {record["id"] for record in run["warnings"]}


def test_a_trade_off_is_one_sentence(ballscrew):
    text = " ".join(ballscrew(*QUICK, "--free", f"{FRICTION},constant_torque").stdout.split())
    (sentence,) = re.findall(r"Trade-off: .*?\)", text)
    assert "more boundary friction coefficient with" in sentence
    assert sentence.endswith("less constant torque fits the rows nearly as well (one standard error)")
    assert "^" not in text


# -- logs that are not as they should be, and the example ---------------------------------------------


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (changed(load=[*columns()["load"][:118], "high", "low"]), ["log.csv row 120", "log.csv row 121"]),
        ({name: values[:2] for name, values in columns().items()}, ["has 2 rows that can be used"]),
    ],
    ids=["text in a number", "two rows"],
)
def test_a_log_that_cannot_be_used_is_refused_with_the_reason(data, words, fit, log):
    """One fault that is read, and one that is counted: the others are those of logs."""
    lines = refused(fit(log(data), "-o", "fitted.toml", "--picture", "fit.svg"), words[0])
    assert [word for word in words if not any(word in line for line in lines)] == []


def test_faulty_cells_are_left_out_if_asked(fit, log):
    data = changed(load=[*columns()["load"][:118], "high", "low"])
    found = document_of(fit(log(data), "--json", "--keep-going"))
    assert found["rows"]["used"] == 118
    assert found["rows"]["left_out"] == {"a value cannot be read": 2}
    assert any("row 120" in note for note in found["rows"]["notes"])
    without = {name: values[:118] for name, values in columns().items()}
    expected = document_of(fit(log(without), "--json"))
    assert_same(found["estimates"], expected["estimates"], ITERATED)


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
    assert __version__ == second["provenance"]["version"]
