"""``ballscrew service``: two logs, one log, one torque; as words, JSON and picture; and what is refused."""

import shutil
from types import SimpleNamespace

import pytest

from ballscrew.questions.service.sheet import causes
from support.commands import ROOT
from support.processes import document_of

EXAMPLES = ROOT / "examples"
CASE, NEW, WORN = (EXAMPLES / name for name in ("service.toml", "nut_new.csv", "nut_worn.csv"))
#: The model of the paper answers the quickest.
QUICK = ("--case", CASE, "--model", "olaru2005")


def test_one_log_against_the_case(ballscrew):
    settings = ("--set", "nut.preload=4326 N ± 10 %")
    found = document_of(ballscrew("service", WORN, *QUICK, *settings, "--json"))
    new = found["results"]["new"]
    assert new["rows"] is None
    assert new["low"] == pytest.approx(4326 * 0.905, rel=0.01)
    assert "of the nominal preload is left" in found["verdicts"][0]["text"]
    assert [one["log"] for one in found["provenance"]["logs"]] == ["nut_worn.csv"]


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


@pytest.mark.parametrize(
    ("shares", "sentences"),
    [
        (
            {"nut.preload": 0.3, "seals": 0.6, "lubricant.temperature": 0.05},
            ["most of the interval is from: seals (60%), preload (30%)"],
        ),
        # a half is not most of it, and of many causes the three largest are named
        (
            {"a": 0.2, "b": 0.15, "c": 0.15, "d": 0.12},
            ["no cause makes most of the interval; the largest: a (20%), c (15%), b (15%)"],
        ),
        ({"a": 0.09, "b": float("nan")}, []),
    ],
)
def test_the_causes_of_an_interval_are_named_by_their_shares(shares, sentences):
    assert causes(SimpleNamespace(change=None, preload=SimpleNamespace(shares=shares))) == sentences
