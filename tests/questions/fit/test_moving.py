"""``ballscrew fit`` on a log of a moving axis."""

import json

import numpy as np
import pytest

from support.fit_logs import EXAMPLES
from support.moving_logs import record, strokes

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
