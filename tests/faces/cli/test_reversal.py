"""``ballscrew reversal``: words, JSON and picture; and what is refused."""

import json
import math

import pytest

from support.commands import ROOT
from support.pictures import drawn

CASE = ROOT / "examples" / "service.toml"


@pytest.mark.slow
def test_json_and_picture(ballscrew, tmp_path):
    done = ballscrew("reversal", CASE, "--json", "--inertia", "2e-3 kg m^2", "--to", tmp_path / "turned.svg")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout, parse_constant=lambda constant: pytest.fail(f"{constant} in JSON"))
    assert {"inputs", "results", "units", "warnings", "verdicts", "checks", "provenance"} == set(found)
    results = found["results"]
    assert results["screw_torque"][0] == pytest.approx(-results["steady_torque"], rel=1e-3)
    assert results["screw_torque"][-1] == pytest.approx(results["steady_torque"], rel=2e-2)
    parts = [values[40] for values in results["contributions"].values()]
    assert sum(parts) == pytest.approx(results["screw_torque"][40], rel=1e-12)
    assert 1 < math.degrees(results["swing"][2]["screw_angle"]) < 40
    lugre = results["lugre"]["model"]
    assert lugre["micro_damping"] == pytest.approx(math.sqrt(lugre["presliding_stiffness"] * 2e-3), rel=1e-12)
    assert found["warnings"][0]["id"] == "reversal.hypothesis"
    picture = drawn(tmp_path / "turned.svg").text
    assert "angle of the screw" in picture
    assert "Maxwell-slip elements" in picture
    assert "turned.svg" in done.stderr


@pytest.mark.slow
def test_words_from_rest(ballscrew):
    done = ballscrew("reversal", CASE, "--from-rest", "--travel", "20 um", "--set", "operation.screw_speed=10 rpm")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("Friction from rest: 0 N, 10 rpm, double nut")
    assert "less than 90% of the friction is back within 20 µm" in done.stdout
    assert "hypothesis" in done.stdout
    assert "none chosen" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--travel", "2 N"), "--travel: wrong unit (2 N)"),
        (("--travel", "-1 mm"), "--travel"),
        (("--gap", "-1"), "--gap"),
        (("--set", "operation.screw_speed=0 rpm"), "operation.screw_speed: must not be zero"),
        (("--model", "olaru2005"), "model.slip: knows no slip across the path"),
        (("--to", "curve.txt"), "--to: unknown kind of file"),
    ],
)
def test_what_is_refused(ballscrew, arguments, said):
    done = ballscrew("reversal", CASE, *arguments)
    assert done.returncode == 2
    assert said in done.stderr
