"""``ballscrew fit`` on a log of a moving axis."""

import json

import numpy as np
import pytest

from support.fit_logs import EXAMPLES
from support.moving_logs import record, strokes
from support.pictures import drawn

CASE = """
[screw]
pitch_circle_diameter = "12.6 mm"
lead = "2.5 mm"
ball_diameter = "1.588 mm"
loaded_balls = 70
contact_angle = "45 deg"
screw_conformity = 0.53
nut_conformity = 0.53

[lubricant]
viscosity = "0.1 Pa s"

[operation]
axial_load = "100 N"
screw_speed = "1000 rpm"
"""


def csv_of(path, data):
    rows = (f"{t!r},{1e3 * x!r},{f!r}" for t, x, f in zip(*(data[n].tolist() for n in data), strict=True))
    path.write_text("\n".join(["time [s],position [mm],force [N]", *rows]), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    """A case, a log, and another log of the same axis."""
    folder = tmp_path_factory.mktemp("moving")
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    one = csv_of(folder / "one.csv", record(strokes(step=2e-3), step=2e-3, noise=0.5))
    other = csv_of(folder / "other.csv", record(strokes(speeds=(0.03, 0.1), step=2e-3), step=2e-3, noise=0.5, seed=1))
    return folder / "case.toml", one, other


def test_the_document(fit, logs, tmp_path):
    case, one, other = logs
    done = fit(one, "--json", "--test", other, "--picture", tmp_path / "fit.svg", case=case)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    for name, value, unit in (
        ("mass", 95.0, "kg"),
        ("coulomb_force", 20.0, "N"),
        ("viscous_coefficient", 200.0, "N s/m"),
    ):
        estimate = found["estimates"][name]
        low, high = estimate["interval"]
        assert low < value < high
        assert low < estimate["value"] < high
        assert estimate["unit"] == unit
        assert estimate["identified"] is True
    assert {"offset", "dead_time", "speed_exponent", "constant_force", "viscosity"} < set(found["estimates"])
    assert 0 < found["relative_error"] < 0.05
    assert 0 < found["cross_error"] < 0.05
    assert set(found["models"]) == {"coulomb-viscous", "power-law", "screw"}
    assert found["models"][found["model"]]["relative_error"] == found["relative_error"]
    assert {"cutoff", "position_cutoff", "effects"} < set(found["filter"])
    assert found["speed_exponent"]["interval"][0] <= found["speed_exponent"]["bootstrap_interval"][0]
    assert "JanotGautierBrunot2019" in found["provenance"]["references"]
    assert len(found["provenance"]["sha256"]) == 64
    # readings fill the panel of the force over time, and a curve of that of the friction runs near zero
    shown = drawn(tmp_path / "fit.svg")
    for words in ("force at the nut [N]", "time [s]"):
        assert words in shown.text


def test_the_text_says_what_the_document_says(fit, logs):
    case, one, other = logs
    done = fit(one, "--test", other, case=case)
    assert done.returncode == 0, done.stderr
    for words in ("mass", "coulomb force", "speed exponent", "other log", "as fitted", "cutoff", "blocks", "gravity"):
        assert words in done.stdout


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--to", "out.toml"], "--to: does not go with a moving log"),
        (["--inertia", "1e-4 kg m^2"], "--inertia: does not go with a moving log"),
        (["--gain", "5 V"], "--gain: wrong unit"),
        (["--carried-mass", "-1 kg"], "--carried-mass: must not be negative"),
        (["--free", "preloud"], "--free"),
        (["--test", "none.csv"], "none.csv"),
    ],
)
def test_options_that_do_not_fit_are_refused(fit, logs, options, words):
    case, one, _ = logs
    done = fit(one, *options, case=case)
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_a_fault_of_the_log_is_one_line_with_its_row(fit, logs, tmp_path):
    case, _, _ = logs
    data = record(strokes(step=2e-3, repeats=1), step=2e-3)
    data["time"][700:] += 3.0
    done = fit(csv_of(tmp_path / "gap.csv", data), case=case)
    assert done.returncode == 2
    (line,) = done.stderr.strip().splitlines()
    assert line.startswith("gap.csv row 702: a gap in time")
    going = fit(tmp_path / "gap.csv", "--keep-going", "--json", case=case)
    assert going.returncode == 0, going.stderr
    assert json.loads(going.stdout)["rows"]["checked"] == np.size(data["time"]) - 700


# -- the example ----------------------------------------------------------------------------------


def test_the_example_is_found_out(fit):
    """The truth is that of the script."""
    options = ("--json", "--test", EXAMPLES / "axis_test.csv", "--carried-mass", "40 kg")
    done = fit(EXAMPLES / "axis_log.csv", *options, case=EXAMPLES / "axis.toml")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    rotor = 2e-5 * (2 * np.pi / 5e-3) ** 2
    for name, value in (("mass", 40.0 + rotor), ("viscosity", 0.05), ("constant_force", 8.0), ("offset", -4.0)):
        low, high = found["estimates"][name]["interval"]
        assert low < value < high, name
    rows = found["rows"]
    assert rows["read"] == rows["used"] + sum(rows["left_out"].values())  # each that is not used has its reason
    assert len(rows["left_out"]) >= 2
    errors = {name: model["cross_error"] for name, model in found["models"].items()}
    assert errors["screw"] < errors["coulomb-viscous"]
