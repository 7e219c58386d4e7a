"""``ballscrew service``: two logs, one log, one torque; as words, JSON and picture; and what is refused."""

import json
import shutil
from pathlib import Path

import pytest

from support.pictures import drawn

EXAMPLES = Path(__file__).parents[3] / "examples"
CASE, NEW, WORN = (EXAMPLES / name for name in ("service.toml", "nut_new.csv", "nut_worn.csv"))
#: The model of the paper answers the quickest.
QUICK = ("--case", CASE, "--model", "olaru2005")


def document(done):
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout, parse_constant=lambda constant: pytest.fail(f"{constant} in JSON"))


@pytest.mark.slow
def test_two_logs(ballscrew, tmp_path):
    done = ballscrew("service", NEW, WORN, *QUICK, "--json", "--picture", tmp_path / "nut.svg")
    found = document(done)
    assert {"inputs", "results", "units", "warnings", "verdicts", "checks", "provenance"} == set(found)
    results = found["results"]
    assert results["ratio"]["low"] < results["ratio"]["value"] < results["ratio"]["high"] < 1
    assert 0 <= results["probability_of_loss"] <= 1
    assert results["verdict"] == "lost"
    assert results["tolerance"] == 0.1
    for label in ("new", "worn"):
        assert results[label]["low"] < results[label]["preload"] < results[label]["high"]
        assert results[label]["rows"] > 100
    assert {one["name"] for one in results["alternatives"]} == {
        "boundary_friction_coefficient",
        "temperature",
        "constant_torque",
    }
    assert [one["log"] for one in found["provenance"]["logs"]] == ["nut_new.csv", "nut_worn.csv"]
    first = found["verdicts"][0]
    assert first["id"] == "service.preload_left"
    assert first["holds"] is False
    assert [record["severity"] for record in found["warnings"] if record["id"] == "service.temperatures_differ"] == [
        "info"
    ]
    identities = [(record["id"], record["subject"]) for record in (*found["warnings"], *found["verdicts"])]
    assert len(set(identities)) == len(identities)
    shown = drawn(tmp_path / "nut.svg")
    assert "friction torque [N m]" in shown.text
    assert len(shown.panels) > 1
    assert "nut.svg: 2 preloads" in done.stderr


@pytest.mark.slow
def test_words(ballscrew):
    done = ballscrew("service", NEW, WORN, *QUICK, "--tolerance", "0.2", environment={"COLUMNS": "110"})
    assert done.returncode == 0, done.stderr
    text = done.stdout
    assert text.startswith("nut_new.csv, nut_worn.csv: double nut, preload 4326 N, model olaru2005\n")
    assert "preload lost: " in text
    assert "less than 80% of it with a probability of " in text
    assert "with the preload of the new log: boundary friction coefficient " in text
    assert "note: the worn log is 8 K hotter than the new one" in text


def test_one_log_against_the_case(ballscrew):
    settings = ("--set", "nut.preload=4326 N ± 10 %")
    found = document(ballscrew("service", WORN, *QUICK, *settings, "--json"))
    new = found["results"]["new"]
    assert new["rows"] is None
    assert new["low"] == pytest.approx(4326 * 0.905, rel=0.01)
    assert "of the nominal preload is left" in found["verdicts"][0]["text"]
    assert [one["log"] for one in found["provenance"]["logs"]] == ["nut_worn.csv"]


def test_a_torque_without_load(ballscrew):
    asked = ("--torque", "0.40 ± 0.02 Nm", "--speed", "100 rpm", "--temperature", "35 degC")
    found = document(ballscrew("service", *asked, *QUICK, "--json"))
    results = found["results"]
    assert results["preload"]["low"] < results["preload"]["preload"] < results["preload"]["high"]
    assert results["torque"] == pytest.approx(0.4)
    assert results["preload"]["temperature"] == pytest.approx(308.15)
    assert found["verdicts"][0]["id"] == "service.preload"
    done = ballscrew("service", *asked, *QUICK)
    assert done.stdout.startswith("drag torque 0.4 N m: double nut")
    assert "\npreload " in done.stdout


REFUSALS = {
    "no case": (("service", NEW, WORN), "--case: missing"),
    "nothing": (("service", *QUICK), "WORN: missing"),
    "three logs": (("service", NEW, WORN, NEW, *QUICK), "WORN: more than two logs (3)"),
    "no such log": (("service", NEW, "gone.csv", *QUICK), "gone.csv"),
    "no preload": (("service", WORN, "--case", EXAMPLES / "rig.toml"), "nut: has no preload (a single nut)"),
    "bodies": (("service", WORN, "--case", EXAMPLES / "catalogue_screw.toml"), "leave out [bodies] and [deviations]"),
    "unit": (("service", "--torque", "1 N", "--speed", "1 rpm", *QUICK), "--torque: "),
    "huge": (("service", "--torque", "1e6 N m", "--speed", "1 rpm", *QUICK), "--torque: no preload gives it"),
    "tolerance": (("service", WORN, "--tolerance", "2", *QUICK), "--tolerance: must lie between 0 and 1 (2.0)"),
    "free": (("service", WORN, "--free", "decay", *QUICK), "--free: is not fitted to each log (decay)"),
    "picture": (("service", WORN, "--picture", "nut.txt", *QUICK), "--picture: unknown kind of file (nut.txt)"),
}  # fmt: skip


@pytest.mark.parametrize(("arguments", "words"), REFUSALS.values(), ids=REFUSALS)
def test_refused_in_a_line(ballscrew, arguments, words):
    done = ballscrew(*arguments)
    assert done.returncode == 2, done.stdout
    assert done.stdout == ""
    assert len(done.stderr.strip().splitlines()) == 1
    assert words in done.stderr


def test_one_file_given_twice_is_refused(ballscrew, tmp_path):
    copy = shutil.copy(WORN, tmp_path / "copy.csv")
    done = ballscrew("service", WORN, copy, *QUICK)
    assert done.returncode == 2
    assert done.stderr.startswith("service: both logs are the same file (nut_worn.csv, copy.csv)")


def test_a_faulty_log_is_named(ballscrew, tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("time [s],speed [rpm],axial load [N],torque [N m]\n0,0,0,0.1\n1,0,0,0.1\n2,0,0,0.1\n")
    done = ballscrew("service", WORN, bad, *QUICK)
    assert done.returncode == 2
    assert done.stderr.startswith("bad.csv: ")
