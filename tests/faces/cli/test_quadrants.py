"""The four quadrants of a double nut on the command line: signs, words, verdicts, checks, tables and bands."""

import csv
import io
import json
import math
from pathlib import Path

import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file

ELASTIC = Path(__file__).parents[3] / "examples" / "catalogue_screw.toml"
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
#: Signs of load and speed, and what the run calls them.
QUADRANTS = {
    (1, 1): "drives forward",
    (1, -1): "is back-driven in reverse",
    (-1, -1): "drives in reverse",
    (-1, 1): "is back-driven forward",
}
every_quadrant = pytest.mark.parametrize("signs", QUADRANTS, ids=QUADRANTS.values())


def at(load, speed):
    return ["--set", f"operation.axial_load={7 * load} kN", "--set", f"operation.screw_speed={600 * speed} rpm"]


def results(document):
    return document["results"]


def documents_of(commands, path):
    found = {}
    for signs in QUADRANTS:
        process = commands.run(["run", path, "--json", *at(*signs)], folder=path.parent)
        assert process.returncode == 0, process.stderr
        found[signs] = json.loads(process.stdout, parse_constant=pytest.fail)
    return found


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    """The example with rigid bodies, which is the same from both sides."""
    path = tmp_path_factory.mktemp("quadrants") / "rigid.toml"
    path.write_text(ELASTIC.read_text(encoding="utf-8").replace("[bodies]", "#"), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def documents(commands, example):
    return documents_of(commands, example)


@every_quadrant
def test_numbers(documents, signs):
    """Sizes are those of the first quadrant, signs are those of the torque on the shaft."""
    load, speed = signs
    first, found = results(documents[1, 1]), results(documents[signs])
    for name in ("screw_torque", "nut_torque", "friction_power", "back_driving_efficiency", "preload_drag"):
        assert found[name] == pytest.approx(first[name], rel=1e-9), name
    size = first["ideal_torque"]
    assert size == pytest.approx(7000 * ROW.lead / (2 * math.pi), rel=1e-12)
    assert found["ideal_torque"] == pytest.approx(load * size, rel=1e-12)
    assert found["drive_torque"] == pytest.approx(load * size + speed * first["screw_torque"], rel=1e-12)
    assert found["holding_torque"] == pytest.approx(load * (size - first["screw_torque"]), rel=1e-12)
    if load == speed:
        assert found["efficiency"] == pytest.approx(size / (size + first["screw_torque"]), rel=1e-12)
    else:
        assert found["efficiency"] is None
    quadrant = found["quadrants"][QUADRANTS[signs]]
    assert quadrant["shaft_torque"] == pytest.approx(found["drive_torque"], rel=1e-12)
    power_in = found["drive_torque"] * speed * 20 * math.pi
    delivered = 7000 * load * speed * ROW.lead * 10  # 600 rpm are ten turns a second
    assert power_in == pytest.approx(delivered + found["friction_power"], rel=1e-9)


@every_quadrant
def test_the_flank_that_carries(documents, signs):
    """A load of the other sign is carried by the other half."""
    first, found = documents[1, 1]["loads"], documents[signs]["loads"]
    for flank in ("loaded_flank", "relieved_flank"):
        for what in ("load", "angle"):
            assert found[flank][what] == pytest.approx(first[flank][what], rel=1e-8), (flank, what)
    assert found["loaded_flank"]["load"]["mean"] > found["relieved_flank"]["load"]["mean"]
    assert found["remaining_preload"] == pytest.approx(first["remaining_preload"], rel=1e-8)
    carrying = found["balls"]["forward_load" if signs[0] > 0 else "backward_load"]
    assert documents[signs]["results"]["screw"]["contact_load"] == pytest.approx(max(carrying))
    assert max(carrying) == pytest.approx(found["loaded_flank"]["load"]["greatest"])
    assert found["deflection"] == pytest.approx(signs[0] * first["deflection"], rel=1e-8)


def test_elastic_bodies_are_not_the_same_from_both_sides(commands, tmp_path):
    """The load enters at one end: the half there carries it otherwise than the one behind. The table knows it."""
    path = tmp_path / "elastic.toml"
    path.write_text(ELASTIC.read_text(encoding="utf-8"), encoding="utf-8")
    found = documents_of(commands, path)
    assert found[-1, -1]["results"]["screw_torque"] < 0.9 * found[1, 1]["results"]["screw_torque"]
    for document in found.values():
        for signs, name in QUADRANTS.items():
            there, quadrant = found[signs]["results"], document["results"]["quadrants"][name]
            assert quadrant["shaft_torque"] == pytest.approx(there["drive_torque"], rel=1e-9)
            drives = signs[0] == signs[1]
            assert quadrant["efficiency"] == pytest.approx(
                there["efficiency" if drives else "back_driving_efficiency"], rel=1e-9
            )
        load = document["inputs"]["operation"]["axial_load"]
        flanks = document["loads"]["loaded_flank"]["load"], document["loads"]["relieved_flank"]["load"]
        balls = document["loads"]["balls"]
        carrying, other = [balls[name] for name in ("forward_load", "backward_load")][:: 1 if load > 0 else -1]
        assert [flank["greatest"] for flank in flanks] == [pytest.approx(max(carrying)), pytest.approx(max(other))]


@every_quadrant
def test_words(ballscrew, example, documents, signs):
    text = " ".join(ballscrew("run", example, *at(*signs)).stdout.split())
    name, found = QUADRANTS[signs], results(documents[signs])
    torque = f"{abs(found['drive_torque']):.4g} N m on the shaft"
    verdicts = {record["id"]: record for record in documents[signs]["verdicts"]}
    if signs == (1, 1):  # as usual: nothing is said
        assert "verdict.quadrant" not in verdicts
    elif signs[0] == signs[1]:
        assert f"{name}: the screw moves the nut against the load; {torque} drive it" in text
    else:
        assert f"{name}: the load moves the way the screw turns; {torque} hold it back" in text
    if signs != (1, 1):
        assert verdicts["verdict.quadrant"]["value"] == pytest.approx(found["drive_torque"])
    held = f"{abs(found['holding_torque']):.4g} N m on the shaft hold it at this speed"
    assert f"back-drives: the load turns the screw; {held}" in text
    assert verdicts["verdict.back_driving"]["value"] == pytest.approx(found["holding_torque"])
    driven = f"{found['efficiency']:.4g}" if signs[0] == signs[1] else "–"
    assert f"efficiency, screw drives the nut {driven}" in text
    assert f"efficiency, the load drives the screw {found['back_driving_efficiency']:.4g}" in text
    for words in QUADRANTS.values():
        assert words in text  # the table has all four


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


@pytest.mark.parametrize("load", [1, -1])
def test_at_rest(ballscrew, example, load):
    """At rest the torque is the ideal one, and the efficiency the limit in which the screw drives."""
    found = json.loads(ballscrew("run", example, "--json", *at(load, 0)).stdout)
    numbers = found["results"]
    assert numbers["drive_torque"] == numbers["ideal_torque"]
    assert 0.9 < numbers["efficiency"] < 1
    assert "verdict.quadrant" not in {record["id"] for record in found["verdicts"]}


def test_lost_preload_of_a_load_below_zero(ballscrew, example):
    settings = ["--set", "nut.preload=500 N", "--set", "operation.axial_load=-10 kN"]
    found = json.loads(ballscrew("run", example, "--json", *settings).stdout)
    assert found["loads"]["preload_is_lost"] is True
    assert found["loads"]["relieved_flank"] is None
    record = next(record for record in found["warnings"] if record["id"] == "verdict.preload_lost")
    assert record["value"] == pytest.approx(10_000)
    assert record["value"] > record["limit"] > 0


@every_quadrant
def test_checks_are_of_magnitudes(ballscrew, example, signs):
    load, speed = signs
    point = ["--axial-load", f"{7 * load} kN", "--speed", f"{600 * speed} rpm"]
    found = json.loads(ballscrew("check", example, "--json", *point).stdout)
    usual = json.loads(ballscrew("check", example, "--json").stdout)
    assert found["verdict"] == "passes"
    for one, other in zip(found["checks"], usual["checks"], strict=True):
        assert one["value"] == pytest.approx(other["value"], rel=1e-8), one["name"]


def test_a_table_over_all_quadrants(ballscrew, example):
    """One row of speeds through rest at loads of both signs: drive torque and efficiency as mechanics has them."""
    axes = ["--vary", "axial_load=-7, 0, 7 kN", "--vary", "screw_speed=-600, 0, 600 rpm"]
    wanted = [word for name in ("drive_torque", "ideal_torque", "screw_torque", "efficiency")
              for word in ("--output", name)]  # fmt: skip
    process = ballscrew("sweep", example, *axes, *wanted)
    assert process.returncode == 0, process.stderr
    head, *rows = csv.reader(io.StringIO(process.stdout))
    assert head[:2] == ["axial load [N]", "screw speed [rpm]"]
    table = {}
    for load, speed, drive, ideal, friction, efficiency, *_ in rows:
        table[float(load), float(speed)] = float(drive)
        expected = float(ideal) + math.copysign(1, float(speed)) * float(friction) * (float(speed) != 0)
        assert float(drive) == pytest.approx(expected, rel=1e-9)
        drives = float(load) * float(speed) > 0 or (float(speed) == 0 and float(load) != 0)
        assert (efficiency not in ("", "nan")) == drives, (load, speed, efficiency)
    for (load, speed), drive in table.items():
        assert drive == pytest.approx(-table[-load, -speed], rel=1e-9, abs=1e-12)


def test_a_band_and_a_case_below_zero(ballscrew, tmp_path):
    """A case file may have signs; the band of a load below zero says how often it locks."""
    text = (ELASTIC.parent / "feed_drive.toml").read_text(encoding="utf-8")
    path = tmp_path / "lower.toml"
    path.write_text(text.replace('"5 kN"', '"-5 kN"'), encoding="utf-8")
    assert case_file.load(path).operation.axial_load == -5000
    process = ballscrew("run", path, "--band", "--samples", "256")
    assert process.returncode == 0, process.stderr
    assert "self-locking in none of the samples" in process.stdout
