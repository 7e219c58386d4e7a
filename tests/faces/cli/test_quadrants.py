"""The four quadrants of a double nut in words and verdicts of ``ballscrew run``."""

import json
from pathlib import Path

import pytest

ELASTIC = Path(__file__).parents[3] / "examples" / "catalogue_screw.toml"
#: Signs of load and speed, and what the run calls them.
QUADRANTS = {
    (1, 1): "drives forward",
    (1, -1): "is back-driven in reverse",
    (-1, -1): "drives in reverse",
    (-1, 1): "is back-driven forward",
}


def at(load, speed):
    return ["--set", f"operation.axial_load={7 * load} kN", "--set", f"operation.screw_speed={600 * speed} rpm"]


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    """The example with rigid bodies, which is the same from both sides."""
    path = tmp_path_factory.mktemp("quadrants") / "rigid.toml"
    path.write_text(ELASTIC.read_text(encoding="utf-8").replace("[bodies]", "#"), encoding="utf-8")
    return path


@pytest.mark.parametrize("signs", QUADRANTS, ids=QUADRANTS.values())
def test_words(ballscrew, example, signs):
    found = json.loads(ballscrew("run", example, "--json", *at(*signs)).stdout, parse_constant=pytest.fail)
    text = " ".join(ballscrew("run", example, *at(*signs)).stdout.split())
    name, results = QUADRANTS[signs], found["results"]
    torque = f"{abs(results['drive_torque']):.4g} N m on the shaft"
    verdicts = {record["id"]: record for record in found["verdicts"]}
    # sizes, signs and flanks are those of the model: here what is said of them
    assert ("verdict.quadrant" in verdicts) == (signs != (1, 1))
    if signs != (1, 1):
        assert verdicts["verdict.quadrant"]["value"] == pytest.approx(results["drive_torque"])
        moves, does = (
            ("the screw moves the nut against the load", "drive it"),
            ("the load moves the way", "hold it back"),
        )
        words, ends = moves if signs[0] == signs[1] else does
        assert f"{name}: {words}" in text
        assert f"{torque} {ends}" in text
    held = f"{abs(results['holding_torque']):.4g} N m on the shaft hold it at this speed"
    assert f"back-drives: the load turns the screw; {held}" in text
    driven = f"{results['efficiency']:.4g}" if signs[0] == signs[1] else "–"
    assert f"efficiency, screw drives the nut {driven}" in text
    assert f"efficiency, the load drives the screw {results['back_driving_efficiency']:.4g}" in text
    assert [words for words in QUADRANTS.values() if words not in text] == []  # the table has all four


def test_a_load_that_does_not_suffice(ballscrew, example):
    """Self-locking: the screw turns with the load, and has to be driven all the same."""
    light = ["--set", "operation.axial_load=-100 N", "--set", "operation.screw_speed=600 rpm"]
    text = ballscrew("run", example, *light).stdout
    assert "is back-driven forward: the load moves the way the screw turns, and does not suffice; " in text
    assert "self-locking: the load alone does not turn the screw at this speed" in text
    found = json.loads(ballscrew("run", example, "--json", *light).stdout)
    assert found["results"]["drive_torque"] > 0
    assert found["results"]["holding_torque"] > 0  # it lowers a load below zero
    assert found["results"]["self_locking"] is True
