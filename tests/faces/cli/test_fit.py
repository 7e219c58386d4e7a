"""``ballscrew fit``: what it prints, writes and draws, and what it says of logs that are not as they should be."""

import dataclasses
import hashlib
import json
import re
import subprocess
import sys
import tomllib

import numpy as np
import pytest

from ballscrew import __version__
from ballscrew.cases.case_files import case_file
from support.documents import ITERATED, assert_same
from support.fit_logs import (
    EXAMPLES,
    FRICTION,
    NOISE,
    OFFSET,
    PAPER,
    RPM,
    TRUE_FRICTION,
    changed,
    columns,
    document_of,
    refused,
)
from support.pictures import words_of

# -- what it says ---------------------------------------------------------------------------------


def test_json_has_what_is_promised(fit, log):
    path = log()
    found = document_of(fit(path, "--json"))
    assert {"estimates", "residual_rms", "holdout_rms", "warnings"} < set(found)
    assert list(found["estimates"]) == [FRICTION]
    estimate = found["estimates"][FRICTION]
    assert {"value", "std", "identified"} < set(estimate)
    assert estimate["identified"] is True
    assert abs(estimate["value"] - TRUE_FRICTION) < 4 * estimate["std"]
    assert estimate["std"] < 0.01
    assert found["residual_rms"] == pytest.approx(NOISE, rel=0.3)
    assert found["holdout_rms"] == pytest.approx(NOISE, rel=0.5)
    assert isinstance(found["warnings"], list)
    assert found["rows"]["read"] == found["rows"]["used"] == 120
    assert found["provenance"]["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
    assert found["provenance"]["version"] == __version__
    assert found["covariance"]["matrix"] == [[pytest.approx(estimate["std"] ** 2)]]


def test_json_has_no_error_for_what_is_not_identified(fit, log):
    path = log(columns(400, speeds=(10, 600)))
    found = document_of(fit(path, "--json", "--free", f"{FRICTION},{OFFSET}"))
    for estimate in found["estimates"].values():
        assert estimate["std"] is None
        assert estimate["identified"] is False
        assert np.isfinite(estimate["value"])
    assert found["covariance"]["matrix"] == [[None, None], [None, None]]
    assert any("cannot be told apart" in warning["text"] for warning in found["warnings"])
    known, unknown = found["identifiability"]["combinations"]
    assert known["identified"]
    assert not unknown["identified"]


def test_words(fit, log):
    done = fit(log())
    assert done.returncode == 0, done.stderr
    text = done.stdout
    assert text.startswith("log.csv, model olaru2005: 120 of 120 rows used\n")
    for words in (
        "torque read as: torque on the shaft, load and speed with their signs",
        "Among the numbers are 3 for a sensor whose zero wanders slowly, not listed above",
        "the model calibrated",
        "the model as given",
        "Stribeck, viscous and load",
        "efficiency pair",
        "Predicted less measured",
        "next test: ",
        "it would leave ",
    ):
        assert words in text
    (line,) = [line for line in text.splitlines() if line.startswith("  boundary friction coefficient")]
    value, error, start = re.split(r"\s{2,}", line.strip())[1:]
    assert re.fullmatch(r"0\.1\d* \(0\.1\d* to 0\.1\d*\)", value)
    assert 0 < float(error) < 0.01
    assert start == "0.2"
    assert not any(word in text for word in ("nan", "Traceback"))
    assert list(done.place.iterdir()) == []


def test_words_of_what_cannot_be_told(fit, log):
    done = fit(log(columns(400, speeds=(10, 600))), "--free", f"{FRICTION},{OFFSET}")
    assert done.returncode == 0, done.stderr
    rows = [line for line in done.stdout.splitlines() if line.startswith(("  boundary friction", "  pure rolling"))]
    assert len(rows) == 2
    assert all("not identified" in row and "(" not in row for row in rows)
    assert "warning  " in done.stdout
    text = " ".join(done.stdout.split())
    assert "Trade-off: " in text
    assert "makes no difference in this log, which determines only their combined effect" in text


def test_names_may_come_with_commas_or_one_by_one(fit, log):
    path = log()
    together = document_of(fit(path, "--json", "--free", f"{FRICTION}, constant_torque"))
    apart = document_of(fit(path, "--json", "--free", FRICTION, "--free", "constant_torque"))
    full = document_of(fit(path, "--json", "--free", f"model.friction.{FRICTION}", "--free", "constant_torque"))
    assert_same(together, apart, ITERATED)
    assert list(full["estimates"]) == [f"model.friction.{FRICTION}", "constant_torque"]
    values = [[estimate["value"] for estimate in one["estimates"].values()] for one in (full, apart)]
    assert_same(*values, ITERATED)


@pytest.mark.slow
def test_as_a_program(case, log):
    """The real command in a process of its own, as programs call it."""
    program = [sys.executable, "-m", "ballscrew.faces.cli", "fit", str(log()), "--case", str(case), "--json"]
    done = subprocess.run(program, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr
    assert FRICTION in json.loads(done.stdout)["estimates"]


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


@pytest.mark.slow
@pytest.mark.parametrize("name", ["a.png", "a.svg", "a.pdf"])
def test_pictures(name, fit, log):
    done = fit(log(), "--picture", name)
    assert done.returncode == 0, done.stderr
    assert ("torque" in words_of(done.place / name)) == (name != "a.png")
    assert f"{name}: 120 rows" in done.stdout


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["-o", "fitted.csv"], "--to: is no case file (fitted.csv)"),
        (["-o", "fitted"], "--to: is no case file (fitted)"),
        (["-o", "../log.csv/fitted.toml"], "--to"),
        (["--picture", "a.doc"], "a.doc"),
    ],
)
def test_places_that_cannot_be_written_are_refused_before_anything_is_read(options, words, fit, log):
    (line,) = refused(fit(log(columns(2)), *options), words)
    assert "rows" not in line


def test_a_log_that_is_not_there_is_refused(fit, tmp_path):
    (line,) = refused(fit(tmp_path / "missing.csv", "-o", "fitted.toml"), "missing.csv")
    assert "does not exist" in line


# -- what can be asked ----------------------------------------------------------------------------


def test_a_distribution_of_the_case_is_a_prior(fit, log):
    path = log(columns(30))
    # the share is that of what the rows tell
    free = ("--temperature-error", "0 K")
    prior = (*free, "--set", f"model.friction.{FRICTION}=0.11 ± 0.005")
    alone, told = (document_of(fit(path, "--json", *options))["estimates"][FRICTION] for options in (free, prior))
    assert alone["prior_share"] == 0
    assert 0 < told["prior_share"] < 1
    deviation = 0.005 / 1.959964
    assert told["std"] < deviation
    assert told["std"] ** 2 == pytest.approx(told["prior_share"] * deviation**2, rel=1e-6)
    assert abs(told["value"] - 0.11) < abs(alone["value"] - 0.11)


def test_bounds_are_kept(fit, log):
    found = document_of(fit(log(), "--json", "--bounds", f"{FRICTION}=0.15:0.3"))
    estimate = found["estimates"][FRICTION]
    assert estimate["value"] == pytest.approx(0.15, abs=1e-3)
    assert estimate["value"] >= 0.15
    assert estimate["at_bound"] is True
    assert estimate["std"] is None
    assert any("bound" in warning["text"] for warning in found["warnings"])


def test_the_next_test_is_one_that_the_rig_of_the_log_can_give(fit, log):
    """It asked for twice the largest load of the log, which nobody knows the rig to have."""
    path, data = log(), columns()
    point = document_of(fit(path, "--json"))["next_test"]["point"]
    assert point["axial_load"] <= np.abs(data["load"]).max() * (1 + 1e-9)
    assert point["screw_speed"] <= np.abs(data["speed"]).max() * RPM * (1 + 1e-9)
    assert "of the loads and speeds that the log has" in " ".join(fit(path).stdout.split())


def test_limits_of_the_next_test(fit, log):
    limits = ("--limits", "screw_speed=1000:3000 rpm", "--limits", "axial_load=1:2 kN")
    point = document_of(fit(log(), "--json", *limits))["next_test"]["point"]
    assert 1000 * (1 - 1e-12) <= point["axial_load"] <= 2000 * (1 + 1e-12)
    assert 1000 * RPM * (1 - 1e-12) <= point["screw_speed"] <= 3000 * RPM * (1 + 1e-12)
    within = ("--limits", "screw_speed=20:900 rpm", "--limits", "axial_load=1:2 kN")
    assert "beyond the log" not in fit(log(), *within).stdout
    beyond = ("--limits", "screw_speed=20:900 rpm", "--limits", "axial_load=6:9 kN")
    assert "that is beyond the log, which ends at axial load" in fit(log(), *beyond).stdout


def test_the_kind_wins_over_what_the_model_would_tell(fit, log):
    """A friction torque that only looks like one of the drive when it is said to be."""
    path = log()
    assert document_of(fit(path, "--json", "--kind", "drive"))["rows"]["torque"].startswith("torque on the shaft")
    wrong = document_of(fit(path, "--json", "--kind", "friction"))
    assert "friction torque" in wrong["rows"]["torque"]
    assert wrong["residual_rms"] > 20 * NOISE


def test_nothing_is_held_out_if_not_wanted(fit, log):
    done = fit(log(), "--json", "--holdout", 0)
    found = document_of(done)
    assert found["holdout_rms"] is None
    assert found["rows"]["held_out"] == 0
    assert "–" in fit(log(), "--holdout", 0).stdout


def test_a_seed_holds_out_other_rows(fit, log):
    path = log()
    one, again, other = (document_of(fit(path, "--json", "--seed", seed)) for seed in (1, 1, 2))
    assert_same(one, again, ITERATED)
    assert one["holdout_rms"] != other["holdout_rms"]


def test_a_motor_current_with_its_torque_constant(fit, log):
    data = columns()
    expected = document_of(fit(log(data), "--json"))["estimates"][FRICTION]
    path = log({**data, "torque": data["torque"] / 0.5}, torque="motor current [A]")
    found = document_of(fit(path, "--json", "--torque-constant", "0.5 N m/A"))["estimates"][FRICTION]
    assert found["value"] == pytest.approx(expected["value"], rel=1e-6)
    (line,) = refused(fit(path), "needs the torque constant")
    assert "--torque-constant" in line


@pytest.mark.parametrize("against", [False, True])
def test_a_motor_current_with_loads_as_magnitudes(against, fit, log):
    """The weight of a slide has one direction; a load of the process is against the motion and turns with it."""
    data = columns(against=against)
    path = log({**data, "torque": data["torque"] / 0.5}, torque="motor current [A]")
    found = document_of(fit(path, "--json", "--torque-constant", "0.5 N m/A"))
    words = "the load always against the motion" if against else "load and speed with their signs"
    assert found["rows"]["torque"] == f"torque on the shaft, {words}"
    estimate = found["estimates"][FRICTION]
    assert abs(estimate["value"] - TRUE_FRICTION) < 4 * estimate["std"] < 0.02


def test_a_torque_with_the_opposite_sign_is_read_as_such(fit, log):
    expected = document_of(fit(log(), "--json"))["estimates"][FRICTION]
    turned = log(changed(torque=-columns()["torque"]), torque="drive torque [N m]")
    found = document_of(fit(turned, "--json"))
    assert found["rows"]["torque"].endswith("; reversed")
    assert found["estimates"][FRICTION]["value"] == pytest.approx(expected["value"], rel=1e-6)


def test_without_any_load_nothing_is_told_of_the_balls(fit, log):
    done = fit(log(), "--json", "--column", "axial_load=0 N")
    found = document_of(done)
    assert found["estimates"][FRICTION]["identified"] is False
    assert found["estimates"][FRICTION]["std"] is None
    assert found["next_test"] is None
    for words in ("hardly depend on it", "signs, units and conditions", "no next test"):
        assert any(words in warning["text"] for warning in found["warnings"])
    assert any("one axial load only" in note for note in found["rows"]["notes"])
    assert "Traceback" not in done.stderr


def test_headings_by_hand(fit, log):
    data = columns()
    expected = document_of(fit(log(data), "--json"))["estimates"]
    path = log({**data, "torque": 1000 * data["torque"]}, torque="Kanal 7", load="Kanal 8")
    by_hand = ("--column", "torque=Kanal 7 [N mm]", "--column", "axial_load=Kanal 8 [N]")
    found = document_of(fit(path, "--json", *by_hand))["estimates"]
    assert found[FRICTION]["value"] == pytest.approx(expected[FRICTION]["value"], rel=1e-6)


def test_the_inertia_takes_its_share_of_the_torque(fit, log):
    """Speeds that rise and fall all the time: without the inertia there is next to nothing left to fit."""
    data = columns(600)
    time = 0.5 * np.arange(600)
    speed = 300 + 250 * np.sin(2 * np.pi * time / 60)
    made = case_file.build(tomllib.loads(PAPER), None, EXAMPLES)
    friction = dataclasses.replace(made.model.friction, boundary_friction_coefficient=TRUE_FRICTION)
    result = dataclasses.replace(made.model, friction=friction)(
        made.screw, made.lubricant, axial_load=data["load"], screw_speed=speed * RPM
    )
    change = 250 * RPM * 2 * np.pi / 60 * np.cos(2 * np.pi * time / 60)
    steady = result.drive_torque + np.random.default_rng(1).normal(0, NOISE, 600)
    path = log({"time": time, "speed": speed, "load": data["load"], "torque": steady + 0.02 * change})
    found = document_of(fit(path, "--json", "--inertia", "0.02 kg m^2", "--kind", "drive"))
    assert found["estimates"][FRICTION]["value"] == pytest.approx(TRUE_FRICTION, rel=0.05)
    assert found["residual_rms"] < 2 * NOISE
    assert any("inertia is taken off" in note for note in found["rows"]["notes"])


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--free", "constant_torqe"], '--free: unknown name (constant_torqe) · did you mean "constant_torque"?'),
        (["--free", "nothing"], "--free: unknown name (nothing) · known: constant_torque, axial_load"),
        (["--free", "boundary_friction"], "--free: unknown name (boundary_friction) · did you mean"),
        (["--free", "axial_load"], "--free: is given by the log (axial_load)"),
        (["--free", "loaded_balls"], "--free: is a whole number"),
        (["--free", "temperature"], "--free: unknown name (temperature)"),
        (["--free", ","], "--free"),
        (["--bounds", f"{FRICTION}=0.1"], "--bounds: is not name=low:high"),
        (["--bounds", f"{FRICTION}=0.3:0.1"], f"--bounds {FRICTION}: leaves no room"),
        (["--bounds", f"{FRICTION}=low:0.3"], f"--bounds {FRICTION}: is not a number (low)"),
        (["--bounds", "decay=1:2"], "--bounds decay: unknown name"),
        (["--limits", "screw_speed=1 kg:2 rpm"], "--limits screw_speed: wrong unit (1 kg)"),
        (["--limits", "temperature=20:60 degC"], "--limits temperature"),
        (["--limits", "speed=1:2 rpm"], "--limits speed: unknown name"),
        (["--kind", "torque"], "--kind: unknown kind of torque (torque)"),
        (["--inertia", "2 kg"], "--inertia"),
        (["--inertia", "-1 kg m^2"], "--inertia: must be positive"),
        (["--torque-constant", "0.5"], "--torque-constant"),
        (["--column", "torque"], "--column: is not name=heading (torque)"),
        (["--column", "torque=nothing [N m]"], "nothing"),
        (["--column", "tork=torque [N m]"], "tork"),
        (["--holdout", "0.9"], "--holdout: must be a share from 0 to 0.5 (0.9)"),
        (["--holdout", "nan"], "--holdout: must be a share from 0 to 0.5 (nan)"),
        (["--set", "model.friction.decay=1 ± x"], "model.friction.decay"),
        (["--model", "olaru"], "olaru"),
    ],
)  # fmt: skip
def test_what_cannot_be_asked(options, words, fit, log):
    assert len(refused(fit(log(), *options, "-o", "fitted.toml", "--picture", "fit.svg"), words)) == 1


def test_several_faults_are_told_at_once(fit, log):
    options = ["--inertia", "2 kg", "--kind", "torque", "--bounds", f"{FRICTION}=0.3:0.1"]
    assert len(refused(fit(log(), *options), "--kind")) == 3


@pytest.mark.slow
def test_a_nut_of_elastic_bodies_is_fitted(fit, log, tmp_path):
    process = fit(
        log(columns(20)), "--to", tmp_path / "fitted.toml", "--keep-going", case=EXAMPLES / "catalogue_screw.toml"
    )
    assert process.returncode == 0, process.stderr
    assert "[bodies]" in (tmp_path / "fitted.toml").read_text(encoding="utf-8")


# -- the error of the oil temperature --------------------------------------------------------------

RIG = ["fit", str(EXAMPLES / "rig_log.csv"), "--case", str(EXAMPLES / "rig.toml")]
#: The model of the paper answers the quickest.
QUICK = [*RIG, "--model", "olaru2005"]


@pytest.mark.slow
def test_the_estimates_of_a_log_with_temperatures_have_their_error_in_them(ballscrew):
    asked = [*QUICK, "--free", f"{FRICTION},constant_torque", "--json"]
    exact, usual, wide = (
        json.loads(ballscrew(*asked, *more).stdout)
        for more in (["--temperature-error", "0 K"], [], ["--temperature-error", "4 K"])
    )
    assert [found["temperature_error"] for found in (exact, usual, wide)] == [0.0, 2.0, 4.0]
    assert usual["provenance"]["settings"]["temperature_error"] == 2.0
    for name in (FRICTION, "constant_torque"):
        one, two, four = (found["estimates"][name] for found in (exact, usual, wide))
        assert one["value"] == two["value"] == four["value"]
        # variances add: twice the error of the temperature makes four times its variance
        assert four["std"] ** 2 - one["std"] ** 2 == pytest.approx(4 * (two["std"] ** 2 - one["std"] ** 2))
        assert two["std"] ** 2 - one["std"] ** 2 == pytest.approx((two["per_kelvin"] * 2 / 1.959964) ** 2)
        assert two["high"] - two["low"] > one["high"] - one["low"]
        assert (one["temperature_share"], two["temperature_share"]) == (
            0.0,
            pytest.approx(1 - (one["std"] / two["std"]) ** 2),
        )
    assert usual["covariance"]["matrix"][0][0] == pytest.approx(usual["estimates"][FRICTION]["std"] ** 2)


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


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("2 degC", 'is a difference of temperatures, in K (2 degC) · write --temperature-error "2 K"'),
        ("2", "--temperature-error: needs a unit"),
        ("-1 K", "--temperature-error: must not be negative"),
        ("200 K", "--temperature-error: must be from 0 to 100 K"),
    ],
)
def test_an_error_of_the_temperature_that_is_none_is_refused(ballscrew, text, words):
    done = ballscrew(*QUICK, "--temperature-error", text)
    assert done.returncode == 2
    assert words in done.stderr


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
    text = " ".join(ballscrew(*RIG, "--free", f"{FRICTION},constant_torque").stdout.split())
    (sentence,) = re.findall(r"Trade-off: .*?\)", text)
    assert "more boundary friction coefficient with" in sentence
    assert sentence.endswith("less constant torque fits the rows nearly as well (one standard error)")
    assert "^" not in text


# -- rows that are not used --------------------------------------------------------------------------


def test_the_reasons_sum_to_the_rows_that_are_not_used(ballscrew):
    found = json.loads(ballscrew(*QUICK, "--json").stdout)["rows"]
    assert found["read"] == found["used"] + sum(found["left_out"].values())
    assert len(found["left_out"]) == 3


@pytest.mark.slow
def test_a_log_without_a_column_of_the_load_is_one_of_no_load(ballscrew, tmp_path):
    import pandas

    table = pandas.read_csv(EXAMPLES / "nut_new.csv", comment="#")
    table.drop(columns="axial load [N]").to_csv(tmp_path / "log.csv", index=False)
    asked = ["--case", str(EXAMPLES / "service.toml"), "--model", "olaru2005", "--free", "nut.preload", "--json"]
    with_load, without = (
        json.loads(ballscrew("fit", str(path), *asked).stdout)
        for path in (EXAMPLES / "nut_new.csv", tmp_path / "log.csv")
    )
    assert_same(without["estimates"], with_load["estimates"])
    assert any("no column of the load: 0 N in every row" in note for note in without["rows"]["notes"])
    assert not any("no column of the load" in note for note in with_load["rows"]["notes"])
