"""Files for MATLAB, read back by SciPy and run by Octave."""

import re
import shutil
import subprocess

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.exports.tables.friction_table import FrictionTable, friction_table
from ballscrew.exports.tables.matlab import _simscape, export

RANGES = {"axial_load": (-3000.0, 5000.0), "screw_speed": (-60.0, 100.0)}


@pytest.fixture(scope="module")
def handed(handed_over):
    return handed_over(bs.FrictionModel.olaru2005(), bs.DoubleNut(preload=900.0), to="matlab", ranges=RANGES)


@pytest.fixture(scope="module")
def exported(handed):
    return export(handed)


def test_octave_reads_and_interpolates_what_python_does(handed, exported, tmp_path):
    octave = shutil.which("octave-cli")
    if octave is None:
        pytest.skip("octave-cli is not installed")
    exported.write(tmp_path)
    random = np.random.default_rng(4)
    load, speed = random.uniform(-3500, 5500, 200), random.uniform(-70, 110, 200)
    np.savetxt(tmp_path / "points.txt", np.column_stack([load, speed]), fmt="%.17g")
    script = (
        "p = dlmread('points.txt', ' '); [m, d, v] = ballscrew_friction(p(:, 1), p(:, 2)); "
        "printf('%.17g %.17g %d\\n', [m, d, v]');"
    )
    done = subprocess.run(
        [octave, "--quiet", "--no-gui", "--norc", "--eval", script],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    found = np.array([line.split() for line in done.stdout.splitlines()], dtype=float)
    wanted = friction_table(handed).at({"axial_load": load, "screw_speed": speed})
    for column, name in enumerate(["screw_torque", "drive_torque", "valid"]):
        assert found[:, column] == pytest.approx(wanted[name].astype(float), rel=1e-12, abs=1e-15)
    assert 0 < found[:, 2].sum() < 200


def test_the_simscape_text_has_the_same_numbers_and_says_that_it_was_not_run(handed, exported):
    text = exported.files["ballscrew_friction.ssc"].decode()
    values = text[text.index("screw_torque = {[") + 17 :].partition("]")[0]
    rows = [[float(word) for word in row.split()] for row in values.split(";")]
    assert np.array_equal(rows, friction_table(handed).values["screw_torque"])
    for name, (least, greatest) in RANGES.items():
        nodes = np.array(re.search(rf"{name} = {{\[(.*?)\]", text)[1].split(), dtype=float)
        assert (nodes[0], nodes[-1]) == (least, greatest)
    travel, per_load = (float(re.search(rf"{name} = {{(.*?),", text)[1]) for name in ("travel", "torque_of_load"))
    assert travel == pytest.approx(0.005 / (2 * np.pi), rel=1e-12)
    at_load = handed.evaluate({"axial_load": 2000.0, "screw_speed": 10.0})["ideal_torque"]  # in proportion to the load
    assert per_load == pytest.approx(at_load / 2000.0, rel=1e-9)
    assert "never run" in text


def test_numbers_of_any_size_stand_in_the_simscape_text_as_they_are(handed):
    """Private, as no screw of the tests has such torques."""
    axes = {"axial_load": np.array([-1e5, 0.0, 2e5]), "screw_speed": np.array([-50.0, 0.0, 50.0])}
    friction = np.array([[12.5, 10.0, 12.25], [1.5, 1.25, 1.75], [-25.125, 100.0, 33.5]])
    ideal = 7.5e-4 * np.repeat(axes["axial_load"][:, None], 3, axis=1)
    values = {"screw_torque": friction, "ideal_torque": ideal, "drive_torque": ideal}
    text = _simscape(handed, FrictionTable(axes, values, np.ones((3, 3), dtype=bool), {}, 0.0), [])
    written = text[text.index("screw_torque = {[") + 17 :].partition("]")[0]
    assert [[float(word) for word in row.split()] for row in written.split(";")] == friction.tolist()
    assert float(re.search(r"torque_of_load = {(.*?),", text)[1]) == pytest.approx(7.5e-4, rel=1e-12)
