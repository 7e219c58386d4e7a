"""``POST /api/v1/select``: the document of the command; paths are refused."""

import json

import pytest

from ballscrew.basis.output import sheet as sheets
from ballscrew.basis.output.json_text import plain
from ballscrew.faces.web.request_queue import RequestQueue
from ballscrew.questions.select.answer import document
from ballscrew.questions.select.compute import select
from ballscrew.questions.select.sheet import sheet

from .conftest import asking

NEED = {
    "force": "2 kN",
    "feed": "15 m/min",
    "length": "1 m",
    "ends": "fixed-supported",
    "life": "20000 h",
    "preload": "2 %",
}


@pytest.mark.slow
def test_the_answer_is_the_document_of_the_command(server):
    found = server.post("select", {"need": NEED, "words": "rexroth 32x10"})
    assert found.status_code == 200, found.text[:500]
    selection = select(NEED, words="rexroth 32x10")
    answer = found.json()
    assert answer.pop("sheet") == json.loads(json.dumps(plain(sheets.document(sheet(selection, selection.ranked)))))
    assert answer == json.loads(json.dumps(plain(document(selection))))


def test_candidates_come_one_by_one(server):
    """The rows of the job, before its answer: each candidate once, as the answer has it."""
    started = server.post("jobs/select", {"need": NEED, "words": "rexroth 32x10"}).json()["id"]
    while (job := server.get(f"jobs/{started}", params={"wait": 5}).json())["state"] in ("waiting", "running"):
        pass
    answer = server.get(f"jobs/{started}/answer").json()["candidates"]
    assert {row["label"]: row["objectives"] for row in job["rows"]} == {
        each["label"]: each["objectives"] for each in answer
    }
    assert len(job["rows"]) == len(answer) > 1
    assert {(row["label"], row["fits"], row["complete"]) for row in job["rows"]} == {
        (each["label"], not each["fails"], each["complete"]) for each in answer
    }


@pytest.mark.slow
def test_what_a_need_leaves_open_is_said_before_it_starts(server):
    found = server.post("select/plan", {"need": NEED, "words": "rexroth 32x10"})
    assert found.status_code == 200, found.text[:500]
    assert found.json()["candidates"] == len(select(NEED, words="rexroth 32x10").ranked)
    assert found.json()["unasked"] == []
    bare = {"force": "2 kN", "feed": "15 m/min"}
    unasked = {one["input"]: one["checks"] for one in server.post("select/plan", {"need": bare}).json()["unasked"]}
    assert list(unasked) == ["limits.running_time", "installation.unsupported_length", "installation.ends"]
    missing = {name for each in select(bare, words="hiwin-20-5k4").ranked for name in _not_judged(each.candidate)}
    assert missing == {name for checks in unasked.values() for name in checks}
    moving = {"mass": "400 kg", "inclination": "90 deg", "acceleration": "3 m/s^2", "feed": "24 m/min"}
    found = server.post("select/plan", {"need": {**moving, "stroke": "600 mm"}}).json()
    assert [one["input"] for one in found["unasked"]] == ["limits.running_time", "installation.ends"]
    assert 1 < found["seconds"] < 60


def test_a_plan_with_a_table_is_no_quick_request():
    """A table of a megabyte is read for seconds: it waits with the heavy requests, of which none may wait here."""

    table = {"table": {"name": "own.csv", "text": "name,lead [mm]\n"}}
    with asking(requests=RequestQueue(waiting=0)) as client:
        bodies = ({"need": NEED, "words": "rexroth 32x10", **more} for more in ({}, table))
        assert [client.post("/api/v1/select/plan", json=body).status_code for body in bodies] == [200, 429]


def _not_judged(candidate):
    return [check.name for check in candidate.checks if check.holds is None]


@pytest.mark.slow
def test_what_is_refused(server):
    for need, words in (
        ({**NEED, "lubricant": {"oil_file": "/etc/passwd"}}, "lubricant.oil_file"),
        ({**NEED, "force": None}, "must not be null"),
        ({**NEED, "forse": "2 kN"}, "forse"),
        ({}, "operation.axial_load"),
    ):
        found = server.post("select", {"need": need})
        assert found.status_code == 422, found.text[:500]
        assert any(words in line for line in found.json()["lines"]), found.json()["lines"]
