"""Sensitivity, optimisation and condition by the API: the documents of the commands, and limits on what they cost."""

import json
import math
import tomllib

import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.basis.output.sheet import document as document_of_sheet
from ballscrew.questions.condition import MOST_LOGS
from ballscrew.questions.optimise.answer import document as of_optimisation
from ballscrew.questions.optimise.compute import optimise
from ballscrew.questions.optimise.sheet import sheet as sheet_of

from .conftest import ROOT
from .test_equal_to_commands import document, written
from .test_hostile import refused

pytestmark = pytest.mark.slow

NEED = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "life": "20000 h"}
MOVING = {name: value for name, value in NEED.items() if name != "force"}
#: A search of a second.
FEW = {"population": 16, "generations": 6, "members": 4}


def sent_table(name="nut_over_years.csv"):
    return [{"name": name, "text": (ROOT / "examples" / name).read_text(encoding="utf-8")}]


@pytest.fixture
def service():
    return tomllib.loads((ROOT / "examples" / "service.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"samples": 2**30}, "--samples: too many"),
        ({"samples": 2**70}, "--samples: too many"),
        ({"output": "x" * 900}, "unknown output"),
    ],
)
def test_a_sensitivity_is_refused(server, paper, options, words):
    refused(server, "sensitivity", {"case": paper, **options}, 422, words)


def test_an_optimisation(server):
    """The document of the command; each design is a case with the numbers of its member."""
    need = {**NEED, "optimise": {"elastic_generations": 1}}
    found = server.post("optimise", {"need": need, **FEW, "objectives": ["loss", "drive-torque"]}).json()
    sheet = found.pop("sheet")
    expected = optimise(need, objectives=["loss", "drive_torque"], **FEW)
    assert sheet == json.loads(json.dumps(plain(document_of_sheet(sheet_of(expected)))))
    assert found == json.loads(json.dumps(plain(of_optimisation(expected))))
    for member in found["candidates"]:
        run = server.post("run", {"case": member["case"]}).json()["results"]
        assert run["screw_torque"] == member["results"]["screw_torque"]
        assert run["friction_power"] == pytest.approx(member["objectives"]["loss"], rel=1e-9)
        sizes = member["case"]["screw"]
        assert float(sizes["lead"].removesuffix(" mm")) == pytest.approx(1000 * member["variables"]["lead"])


def test_a_plan_of_an_optimisation(server):
    need = {**NEED, "optimise": {"elastic_generations": 0}}
    found = server.post("optimise/plan", {"need": need, **FEW}).json()
    assert (found["designs"], found["members"]) == (96, 4)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ({"population": 10**9}, "optimise.population: must be at most 100000"),
        ({"members": 10**30}, "optimise.members"),
        (
            {"need": {**NEED, "optimise": {"samples": 10**9}}, "quantile": 0.5},
            "optimise.samples: must be at most 65536",
        ),
        ({"need": {**NEED, "screw": {"catalogue_file": "/etc/passwd"}}}, "is not taken from a request"),
        (
            {"need": {**MOVING, "mass": "400 kg", "stroke": "0.8 m", "acceleration": "2 m/s^2"}},
            "is too much for a search",
        ),
    ],
)
def test_an_optimisation_is_refused(server, body, words):
    for address in ("optimise", "optimise/plan"):
        refused(server, address, {"need": NEED, **body}, 422, words)


def test_a_condition(server, service, tmp_path):
    """As the command; the trend goes through as many tests above as below, with the slope that is said."""
    found = server.post("condition", {"case": service, "tests": sent_table()}).json()
    sheet = found.pop("sheet")
    table = ROOT / "examples" / "nut_over_years.csv"
    words = ("condition", table, "--case", written(service, tmp_path))
    assert found == document(*words, "--json")
    assert sheet == document(*words, "--sheet")
    assert found["results"]["alarm"] is not None
    chart = next(block for block in sheet["blocks"] if block.get("title") == "preload left")
    trend = next(mark["y"] for mark in chart["marks"] if mark["name"] == "trend")
    states = found["results"]["states"]
    span = states[-1]["time"] - states[0]["time"]
    assert math.log(trend[-1] / trend[0]) == pytest.approx(found["results"]["trend"]["slope"] * span)
    above = sum(one["preload"]["value"] > at for one, at in zip(states, trend, strict=True))
    assert abs(2 * above - len(states)) <= 1


def test_a_condition_of_logs(server, service, tmp_path):
    """Several logs, in the order in which they are sent, as files in that order."""
    text = (ROOT / "examples" / "nut_new.csv").read_text(encoding="utf-8")
    paths = [tmp_path / f"{number}.csv" for number in range(4)]
    for number, path in enumerate(paths):  # a log of its own each, which is no other one
        path.write_text(f"{text}\n# {number}\n" if number else text, encoding="utf-8")
    tests = [{"name": path.name, "text": path.read_text(encoding="utf-8")} for path in paths]
    found = server.post("condition", {"case": service, "tests": tests, "baseline": 3, "keep_going": True})
    assert found.status_code == 200, found.text[:800]
    answer = found.json()
    assert [one["log"] for one in answer["provenance"]["logs"]] == [path.name for path in paths]
    flags = ["--case", written(service, tmp_path), "--baseline", 3, "--keep-going", "--json"]
    answer.pop("sheet")
    assert answer == document("condition", *paths, *flags)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"tests": []}, "tests"),
        ({"tests": sent_table() * (MOST_LOGS + 1)}, "tests"),
        ({"tests": "nut.csv"}, "tests"),
        ({"tests": ["nut.csv"]}, "tests"),
        ({"tests": [{"name": "x.csv"}]}, "needs one content"),
        ({"tests": sent_table("nut_new.csv") * 6}, "two logs are the same file"),
        ({"tests": [{"name": "x.csv", "text": "date,torque [N m]\n"}]}, "x.csv"),
        ({"tests": [{"name": "../../x.csv", "base64": "!"}]}, "is not base64"),
    ],
)
def test_a_condition_is_refused(server, service, change, words):
    body = {"case": service, "tests": sent_table(), **change}
    found = server.post("condition", body)
    assert found.status_code == 422, found.text[:300]
    assert any(words in line for line in found.json()["lines"]), found.json()["lines"]
    assert not any("/ballscrew-" in line for line in found.json()["lines"])
