"""``ballscrew ripple``: as words, JSON and picture; and what is refused."""

import json

import pytest

from support.commands import ROOT
from support.pictures import drawn

EXAMPLE = ROOT / "examples" / "service.toml"
SHORT = ["--set", "screw.loaded_balls=20", "--set", "nut.preload=1.5 kN", "--return-balls", "10", "--turns", "6"]


@pytest.mark.slow
def test_all_forms(ballscrew, tmp_path):
    picture = tmp_path / "ripple.svg"
    fault = ["--fault", "spall=2 mm x 2 um"]
    done = ballscrew("ripple", EXAMPLE, *SHORT, *fault, "--to", picture)
    assert done.returncode == 0, done.stderr
    for words in ("torque over the angle: double nut, preload 1500 N", "ball pass", "torque is a poor sensor of it"):
        assert words in done.stdout
    shown = drawn(picture)
    assert len(shown.panels) == 2
    assert "turns of the screw" in shown.text
    found = json.loads(ballscrew("ripple", EXAMPLE, *SHORT, *fault, "--json").stdout)
    assert found["results"]["peak_to_peak"] > 0
    assert {"name", "order", "amplitude"} == set(found["results"]["orders"][0])
    assert found["results"]["faults"][0]["fault"] == "spall=2 mm x 2 um"
    assert found["units"]["peak_to_peak"] == "N m"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (("--fault", "crack"), "--fault: unknown fault (crack)"),
        (("--set", "operation.screw_speed=0 rpm"), "operation.screw_speed: must not be zero"),
        (("--set", "nut.spacer_balls=true"), "nut.spacer_balls: part the loaded balls"),
        (("--to", "nut.txt"), "--to: unknown kind of file (nut.txt)"),
    ],
)
def test_what_cannot_be_asked_is_refused(ballscrew, given, message):
    done = ballscrew("ripple", EXAMPLE, *SHORT, *given)
    assert done.returncode == 2
    assert message in done.stderr
    assert done.stdout == ""
