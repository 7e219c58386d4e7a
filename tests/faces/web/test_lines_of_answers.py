"""All answers about a case in one request: those of the addresses, line by line, of a case that is built once."""

import json
import threading
import tomllib

import pytest

from ballscrew.cases.case_files import case_file
from ballscrew.faces.web import bodies, documents
from ballscrew.faces.web.bodies import case_of
from ballscrew.faces.web.request_queue import OUT_OF_TIME, RequestQueue
from ballscrew.questions.curves import curves
from ballscrew.questions.run import compute
from support.commands import ROOT
from support.documents import assert_same

from .conftest import ask_and_leave, asking

EXAMPLES = ROOT / "examples"
#: Seconds of a request, also on a busy machine.
LONG = 600


def tables_of(name):
    return tomllib.loads((EXAMPLES / name).read_text(encoding="utf-8"))


def lines_of(server, body):
    found = server.post("answers", body)
    assert (found.status_code, found.headers["content-type"]) == (200, "application/x-ndjson")
    return [json.loads(line) for line in found.text.splitlines()]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["olaru2005.toml", "catalogue_screw.toml", "rig.toml"])
@pytest.mark.parametrize("signs", [(1, 1), (-1, -1), (0, 1)])
def test_each_line_is_what_its_address_answers(server, name, signs):
    case = tables_of(name)
    case["operation"] = {"axial_load": f"{2 * signs[0]} kN", "screw_speed": f"{300 * signs[1]} rpm"}
    lines = lines_of(server, {"case": case})
    found = {line["question"]: line["answer"] for line in lines}
    curve_of = curves(compute.run(case_of(case)))
    assert [line["question"] for line in lines][:3] == ["run", "check", "over_speed"]
    assert found.keys() == {"run", "check", "drawing", *curve_of}
    assert ("cold_and_hot" in found) == (name != "olaru2005.toml" and signs[0] != 0)
    for question in ("run", "check"):
        assert_same(found[question], server.post(question, {"case": case}).json())
    assert found["drawing"]["text"] == server.post("drawing", {"case": case}).text
    for question, curve in curve_of.items():
        body = {"case": case, "vary": dict(curve.vary), "outputs": list(curve.outputs)}
        assert_same(found[question], server.post("sweep", body).json())


def test_the_axes_are_around_the_operating_point(paper):
    paper["operation"] = {"axial_load": "-1 kN", "screw_speed": "2 rad/s"}
    found = curves(compute.run(case_of(paper)))
    loads = [float(value) for value in found["over_load"].vary["axial_load"].removesuffix(" N").split(", ")]
    speeds = [float(value) for value in found["over_speed"].vary["screw_speed"].removesuffix(" rad/s").split(", ")]
    assert (loads[0], loads[28], loads[29], loads[-1], len(loads)) == (-2000.0, -40.0, 40.0, 2000.0, 58)
    assert (speeds[0], speeds[-1], len(speeds)) == (0.04, 4.0, 41)
    assert len(found["over_both"].vary["axial_load"].split(", ")) == 20


def test_a_problem_has_its_line_and_the_others_are_answered(server, paper):
    faulty = {**paper, "operation": {"axial_load": "1 kg", "screw_speed": "1 rpm"}}
    lines = lines_of(server, {"case": paper, "beside": [faulty, paper]})
    assert [(line["question"], line["place"]) for line in lines if "answer" in line and line["place"]] == [
        ("run", 2),
        ("check", 2),
    ]
    (refused,) = (line for line in lines if "problem" in line)
    assert (refused["question"], refused["place"]) == ("run", 1)
    assert refused["problem"] == server.post("run", {"case": faulty}).json()
    of_case = {line["question"] for line in lines if not line["place"]}
    assert of_case == {"run", "check", "over_speed", "over_both", "over_load", "drawing"}


def test_what_is_no_case_is_refused_as_by_its_address(server, paper):
    faulty = {**paper, "operation": {"axial_load": "1 kg", "screw_speed": "1 rpm"}}
    found, alone = (server.post(address, {"case": faulty}) for address in ("answers", "run"))
    assert (found.status_code, found.json()) == (alone.status_code, alone.json())


def test_too_many_designs_are_refused(server, paper):
    found = server.post("answers", {"case": paper, "beside": [paper] * 9})
    assert found.status_code == 422
    assert found.json()["faults"][0]["where"] == "request.beside"


def test_a_case_is_built_and_run_once(monkeypatch, paper):
    case = {**paper, "nut": {"type": "single"}}
    built, ran = [], []
    build, run = case_file.build, compute.run
    monkeypatch.setattr(bodies.case_file, "build", lambda *a, **k: (built.append(a), build(*a, **k))[1])
    monkeypatch.setattr(documents.compute, "run", lambda *a, **k: (ran.append(a), run(*a, **k))[1])
    # as a server that has answered nothing yet
    documents._runs.clear()

    with asking(requests=RequestQueue(time_limit=LONG)) as client:
        found = client.post("/api/v1/answers", json={"case": case})
    assert len(found.text.splitlines()) == 6
    assert (len(built), len(ran)) == (1, 1)


def test_numbers_are_sent_before_the_charts_are_computed(monkeypatch, paper):
    """And a client that goes in between stops the work."""
    sent, stopped = threading.Event(), threading.Event()

    def endless(case, plan, done):
        try:
            assert sent.wait(LONG)  # or else the numbers wait for the charts
            while True:
                done(0, 1)
        finally:
            stopped.set()

    monkeypatch.setattr("ballscrew.faces.web.answers_api.sweeps.sweep", endless)
    lines = []

    def heard(message):
        lines.extend(message.get("body", b"").splitlines())
        if len(lines) == 2:
            sent.set()

    ask_and_leave("answers", paper, sent, stopped, heard)
    assert [json.loads(line)["question"] for line in lines] == ["run", "check"]


def test_a_curve_out_of_time_comes_with_what_goes_on_with_it(monkeypatch, paper):
    """As a body of the address ``sweep``, which a job takes."""

    def endless(case, plan, done):
        while True:
            done(0, 1)

    monkeypatch.setattr("ballscrew.faces.web.answers_api.sweeps.sweep", endless)
    with asking(requests=RequestQueue(time_limit=0.2)) as client:
        found = client.post("/api/v1/answers", json={"case": paper})
    lines = {line["question"]: line for line in map(json.loads, found.text.splitlines())}
    assert "answer" in lines["run"]
    wanted = curves(compute.run(case_of(paper)))
    assert wanted
    for name, curve in wanted.items():
        assert [fault["id"] for fault in lines[name]["problem"]["faults"]] == [OUT_OF_TIME]
        assert lines[name]["sweep"] == {"vary": dict(curve.vary), "outputs": list(curve.outputs)}
