"""What the server answers is what the command line prints, number for number and line for line."""

import csv
import io
import json
import math
import re
import tomllib
from pathlib import Path

import pytest
import typer.testing

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.faces.cli import main
from ballscrew.physics.sizing.catalogue import catalogue, printed_rows
from ballscrew.questions.validate import compute
from support.documents import assert_same, differences

EXAMPLES = sorted((Path(__file__).parents[3] / "examples").glob("*.toml"))
PAPER = next(path for path in EXAMPLES if path.stem == "olaru2005")
SETTINGS = [
    [],
    ["operation.axial_load=1.5 kN"],
    ["operation.screw_speed=0 rpm", "model.name=corrected"],
    ["model.friction=greenwood-tripp", "lubricant.grade=ISO VG 32", "lubricant.temperature=60 degC"],
]


def printed(*words):
    """What a command prints; a fault comes as it is."""
    found = typer.testing.CliRunner().invoke(main.app, [str(word) for word in words])
    if found.exception is not None and not isinstance(found.exception, SystemExit):
        raise found.exception
    assert found.exit_code == 0, found.output
    return found.stdout


def document(*words):
    """The JSON document that a command prints."""
    return json.loads(printed(*words))


def assert_as_command(found, words):
    """Fail where an answer is not the document of a command, or its sheet is not that of the command."""
    sheet = found.pop("sheet")
    assert_same(found, document(*words, "--json"))
    assert_same(sheet, document(*words, "--sheet"))


def without_zeros(text):
    """A text whose numbers have no zeros at the end of their decimals."""
    return re.sub(r"(\.\d*?)0+(?!\d)", lambda decimals: decimals[1].rstrip("."), text)


def tables_of(path, settings=()):
    tables = case_file.override(tomllib.loads(path.read_text(encoding="utf-8")), settings)
    if "grade" in tables["lubricant"]:
        for name in ("viscosity", "pressure_viscosity_coefficient"):
            tables["lubricant"].pop(name, None)
    return tables


def written(tables, tmp_path):
    """The tables as a file, as the server itself writes them."""
    import tomlkit

    path = tmp_path / "case.toml"
    path.write_text(tomlkit.dumps(tables), encoding="utf-8")
    return path


def cases():
    """Each file, and each group of settings; the others of their product are long."""
    for path in EXAMPLES:
        for settings in SETTINGS:
            marks = [] if path == PAPER or not settings else [pytest.mark.long]
            yield pytest.param((path, settings), marks=marks, id=path.stem)


@pytest.fixture(params=list(cases()))
def tables(request):
    return tables_of(*request.param)


def test_documents_differ_by_more_than_rounding():
    whole = {"torque": 1.0, "parts": [1, 2.5], "engine": "numpy", "valid": True, "none": None}
    assert differences(whole | {"torque": 1 + 1e-12}, whole) == []
    assert differences(whole | {"torque": 1 + 1e-8}, whole) == [".torque: 1.00000001 is not 1.0"]
    assert differences(whole | {"parts": [1, 2.6]}, whole) == [".parts[1]: 2.6 is not 2.5"]
    others = [{"parts": [1]}, {"parts": [2, 2.5]}, {"engine": "compiled"}, {"valid": 1}, {"torque": None}, {"more": 0}]
    assert all(differences(whole | other, whole) for other in others)


def test_run(server, tables, tmp_path):
    found = server.post("run", {"case": tables}).json()
    words = found.pop("words")
    assert_same(found, document("run", written(tables, tmp_path), "--json"))
    assert words["verdicts"] == [one["text"] for one in found["verdicts"]]
    rigidity = found.get("loads", {}).get("axial_rigidity", {})
    assert rigidity.get("assumed", []) == words["rigidity"]
    assert len(words["rules"]) == 2 * ("rules" in found["results"])
    text = printed("run", written(tables, tmp_path))
    flat = " ".join(text.split())
    assert " ".join(words["title"].split()) in flat
    assert all(" ".join(line.split()) in flat for line in words["verdicts"])


def test_check(server, tables, tmp_path):
    found = server.post("check", {"case": tables}).json()
    expected = document("check", written(tables, tmp_path), "--json")
    assert {"name": "case.toml", **found} == expected
    assert found["holds"] == all(one["holds"] is True for one in found["checks"])


def test_a_check_that_is_not_judged_is_no_pass(server, elastic):
    for section in ("installation", "limits"):
        elastic.pop(section, None)
    found = server.post("check", {"case": elastic}).json()
    of = {one["id"]: one for one in found["checks"]}
    assert of["check.buckling"]["holds"] is of["check.buckling"]["utilisation"] is None
    assert of["check.static_safety"]["holds"] is True
    assert 0 < of["check.static_safety"]["utilisation"] < 1
    assert found["holds"] is False
    assert "passes" not in found["verdict"]
    held = {
        **elastic,
        "installation": {"unsupported_length": "1 m", "ends": "fixed-fixed"},
        "limits": {"running_time": "100 h"},
    }
    assert server.post("check", {"case": held}).json()["holds"] is True
    long = {**held, "installation": {"unsupported_length": "19 m", "ends": "fixed-free"}}
    found = server.post("check", {"case": long}).json()
    buckling = next(one for one in found["checks"] if one["id"] == "check.buckling")
    assert buckling["utilisation"] == buckling["value"] / buckling["limit"] > 1
    assert (buckling["holds"], found["holds"]) == (False, False)


def test_check_of_a_row_without_a_nut(server, elastic):
    """The nut of the row, which may be one that has no preload."""
    del elastic["nut"]
    for row in ("hiwin-40-16k5", "rexroth-40x10x6-6-double"):
        found = server.post("check", {"case": {**elastic, "screw": {"catalogue": row}}})
        assert found.status_code == 200, found.text
        assert any("the nut of the row" in text for text in found.json()["assumed"])


def test_compare(server, tables, tmp_path):
    found = server.post("compare", {"case": tables}).json()
    assert_as_command(found, ("compare", written(tables, tmp_path)))


def banded():
    """Each way to ask with one file, and one way with a file of each kind; the others of their product are long."""
    for path in EXAMPLES:
        for options in ({}, {"samples": 100, "level": 0.8}, {"samples": 64, "only_given": True}):
            short = path == PAPER or ("level" in options and path.stem in ("catalogue_screw", "vertical_axis"))
            yield pytest.param(path, options, marks=[] if short else [pytest.mark.long], id=path.stem)


@pytest.mark.parametrize(("path", "options"), list(banded()))
def test_band(server, path, options):
    found = server.post("band", {"case": tables_of(path), **options}).json()
    words = ["--samples", options.get("samples")] * ("samples" in options)
    words += ["--level", options.get("level")] * ("level" in options)
    words += ["--only-given"] * options.get("only_given", False)
    said = found.pop("words")
    assert set(said["sentences"]) < {one["text"] for one in found["verdicts"]}
    assert_same(found, document("run", path, "--band", "--json", *words))


def test_sweep_with_a_band(server):
    """Few points have the samples of the command, many have fewer, and more than there are is refused."""
    path = EXAMPLES[0].with_name("feed_drive.toml")
    case, vary = tables_of(path), {"screw_speed": "0, 300 rpm"}
    body = {"case": case, "vary": vary, "outputs": ["screw_torque", "efficiency"], "band": True}
    words = ["--vary", "screw_speed=0, 300 rpm", "--output", "screw_torque", "--output", "efficiency", "--band"]
    assert_same(server.post("sweep", body).json(), document("sweep", path, *words, "--json"))
    many = server.post("sweep", {**body, "vary": {"screw_speed": "1:300:200 rpm"}}).json()
    assert many["band"]["samples"] == 4096
    refused = server.post("sweep", {**body, "samples": 2**20})
    assert (refused.status_code, "--samples: too many" in refused.text) == (422, True)
    refused = server.post("sweep", {**body, "outputs": ["deflection"]})
    assert (refused.status_code, "has no band" in refused.text) == (422, True)


AXES = [
    {},
    {"axial_load": "100:4000:3 N"},
    {"operation.axial_load": "1, 2 kN", "lead": "5, 10 mm", "screw_speed": "0, 600 rpm"},
]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
@pytest.mark.parametrize("vary", AXES, ids=len)
def test_sweep(server, path, vary):
    outputs = ["screw_torque", "efficiency", "holding_torque"]
    found = server.post("sweep", {"case": tables_of(path), "vary": vary, "outputs": outputs}).json()
    words = [word for name, text in vary.items() for word in ("--vary", f"{name}={text}")]
    text = printed("sweep", path, *words, *[word for name in outputs for word in ("--output", name)])
    heading, *rows = csv.reader(io.StringIO(text))
    known = server.get("vocabulary").json()["units"]
    columns = {**found["axes"], **found["outputs"]}
    assert [one.partition(" [")[0] for one in heading] == [name.replace("_", " ") for name in columns]
    points = grid(found)
    assert len(rows) == len(points) >= 3
    for row, point in zip(rows, points, strict=True):
        for cell, title, (name, value) in zip(row, heading, point.items(), strict=True):
            if not cell:  # what is not finite, or makes no sense
                continue
            _, bracket, unit = title.partition(" [")
            si = columns[name]["unit"]
            by = next((u for u in known.get(si, ()) if u["unit"] == unit.rstrip("]")), {"factor": 1, "offset": 0})
            assert bracket or si == "1"
            assert value == pytest.approx(float(cell) * by["factor"] + by["offset"], rel=1e-10, abs=1e-14)


def grid(found):
    """A swept answer as one row a point."""
    rows = [({}, [])]
    for name, axis in found["axes"].items():
        rows = [({**row, name: value}, [*at, i]) for row, at in rows for i, value in enumerate(axis["values"])]
    for row, at in rows:
        for name, output in found["outputs"].items():
            value = output["values"]
            for place in at:
                value = value[place]
            row[name] = value
    return [row for row, _ in rows]


def test_duty(server, tmp_path):
    """Of a case without an operating point, which only this address takes."""
    tables = tables_of(next(path for path in EXAMPLES if path.stem == "vertical_axis"))
    del tables["operation"]
    assert_as_command(server.post("duty", {"case": tables}).json(), ("duty", written(tables, tmp_path)))
    assert server.post("run", {"case": tables}).status_code == 422


def test_duty_of_a_recorded_motion(server, tmp_path):
    """A file that comes with the case stands in the place of its motion, as ``--trace`` does."""
    tables = tables_of(next(path for path in EXAMPLES if path.stem == "vertical_axis"))
    rows = [f"{0.01 * i:.2f},{100 * (1 - math.cos(0.01 * math.pi * i)):.3f}" for i in range(201)]
    log = tmp_path / "run.csv"
    log.write_text("\n".join(["time [s],position [mm]", *rows]), encoding="utf-8")
    sent = {"name": log.name, "text": log.read_text(encoding="utf-8")}
    found = server.post("duty", {"case": tables, "trace": sent}).json()
    assert_as_command(found, ("duty", written(tables, tmp_path), "--trace", str(log)))
    assert found["inputs"]["motion"] == {"kind": "trajectory", "file": "run.csv", "samples": 201}
    refused = server.post("duty", {"case": tables, "trace": {"name": "a/run.csv", "text": "x"}})
    assert refused.status_code == 422
    assert refused.json()["lines"][0].startswith("run.csv")


def test_warm_up(server, tmp_path):
    """Of a motion and of an operating point, with bands and without; refused as on the command line."""
    tables = tables_of(next(path for path in EXAMPLES if path.stem == "warm_up"))
    words = ("warm-up", written(tables, tmp_path), "--hours", "0.5", "--cool-down", "0.25")
    found = server.post("warm-up", {"case": tables, "hours": 0.5, "cool_down": 0.25}).json()
    assert_as_command(found, words)
    for name in ("axis", "motion"):
        del tables[name]
    words = ("warm-up", written(tables, tmp_path), "--hours", "0.5", "--band", "--samples", "8")
    body = {"case": tables, "hours": 0.5, "band": True, "samples": 8}
    found = server.post("warm-up", body).json()
    assert_as_command(found, words)
    for more, line in (
        ({"hours": 0.0}, "--hours: must be above 0 and at most 8766 (0) · write --hours 4"),
        ({"samples": 8}, "--samples: needs --band (8) · add --band"),
        ({"band": True, "samples": 100_000}, "--samples: too many (100,000) · 65,536 at most here"),
    ):
        found = server.post("warm-up", {"case": tables, **more})
        assert found.status_code == 422
        assert found.json()["lines"] == [line]


def test_axis(server, tmp_path):
    tables = tables_of(next(path for path in EXAMPLES if path.stem == "feed_axis"))
    found = server.post("axis", {"case": tables}).json()
    assert_as_command(found, ("axis", written(tables, tmp_path)))
    places = [word for place in ("300 mm", "0.5 m") for word in ("--at", place)]
    found = server.post("axis", {"case": tables, "at": places[1::2]}).json()
    assert_as_command(found, ("axis", written(tables, tmp_path), *places))
    assert len(found["results"]["position"]) == 2


def test_reversal(server, tmp_path):
    """Over a travel, and from rest."""
    tables = tables_of(next(path for path in EXAMPLES if path.stem == "service"), ["operation.screw_speed=6 rpm"])
    case = written(tables, tmp_path)
    body = {"case": tables, "from_rest": True, "travel": "50 um", "inertia": "2e-3 kg m^2", "gap": 0.25}
    words = ("--from-rest", "--travel", "50 um", "--inertia", "2e-3 kg m^2", "--gap", "0.25")
    found = server.post("reversal", body).json()
    assert_as_command(found, ("reversal", case, *words))
    assert found["results"]["from_rest"] is True
    assert max(found["results"]["travel"]) == pytest.approx(50e-6)
    ids = [one["id"] for one in found["warnings"]]
    assert ids == ["reversal.hypothesis", "reversal.work_of_elements", "reversal.first_range"]
    refusal = server.post("reversal", {"case": tables, "travel": "-1 mm"})
    assert refusal.status_code == 422
    assert refusal.json()["lines"][0].startswith("--travel: must be positive (-1 mm)")
    still = {**tables, "operation": {**tables["operation"], "screw_speed": "0 rpm"}}
    refusal = server.post("reversal", {"case": still})
    assert refusal.json()["lines"] == refused("reversal", case, "--set", "operation.screw_speed=0 rpm")
    rolling = {**tables, "model": {"name": "olaru2005"}}
    refusal = server.post("reversal", {"case": rolling})
    assert refusal.json()["lines"] == refused("reversal", case, "--set", "model.name=olaru2005")


def test_ripple(server, tmp_path):
    """With a fault and other grooves."""
    small = ["screw.loaded_balls=20", "nut.preload=1.5 kN"]
    tables = tables_of(next(path for path in EXAMPLES if path.stem == "service"), small)
    case = written(tables, tmp_path)
    body = {"case": tables, "fault": ["preload=0.35"], "return_balls": 10, "turns": 6.0, "groove_deviation": "2 um"}
    flags = ("--fault", "preload=0.35", "--return-balls", "10", "--turns", "6", "--groove-deviation", "2 um")
    found = server.post("ripple", body).json()
    assert_as_command(found, ("ripple", case, *flags))
    assert [one["fault"] for one in found["results"]["faults"]] == ["preload=0.35"]
    for more, line in (
        ({"return_balls": 10**300}, "--return-balls: too large"),
        ({"fault": ["rust"]}, "--fault: unknown"),
        ({"seeds": -1}, "--seeds: must be at least one (-1)"),
    ):
        refusal = server.post("ripple", {"case": tables, **more})
        assert refusal.status_code == 422
        assert refusal.json()["lines"][0].startswith(line), refusal.json()["lines"]
    rolling = {**tables, "model": {"name": "olaru2005"}}
    refusal = server.post("ripple", {"case": rolling})
    assert refusal.json()["lines"] == refused("ripple", case, "--set", "model.name=olaru2005")


def test_catalogue(server):
    assert server.get("catalogue").json() == json.loads(printed("catalogue", "list", "--json"))
    found = server.get("catalogue", params={"words": "Double 40x"}).json()
    assert found == json.loads(printed("catalogue", "list", "double", "40x", "--json"))
    for name in [row.name for row in catalogue().values() if not row.refusal][::70]:
        row = server.get(f"catalogue/{name}").json()
        assert row.pop("case") == tomllib.loads(printed("catalogue", "show", name, "--case"))
        assert row == json.loads(printed("catalogue", "show", name.upper(), "--json"))


@pytest.mark.parametrize("every", [4, pytest.param(1, marks=pytest.mark.long)])
def test_each_row_of_the_catalogue_is_a_case(server, every):
    """The page starts from them; that each row is a screw is tested by ``check`` (tests/faces/cli/test_check.py)."""
    for name in [row.name for row in printed_rows()][::every]:
        case = server.get(f"catalogue/{name}").json()["case"]
        assert server.post("run", {"case": case}).status_code == 200


#: One by its name is quick; the others, and all of them, take seconds.
ONE, *SETS = compute.SETS


@pytest.mark.parametrize("name", [ONE, *(pytest.param(name, marks=pytest.mark.long) for name in ["", *SETS])])
def test_validate(server, name):
    found = server.get("validate", params={"set": name}).json()
    assert_same(found, document("validate", *[name] * bool(name), "--json"))


def test_schema(server):
    assert server.get("schema").json() == json.loads(printed("schema"))


def test_toml(server, tables, tmp_path):
    found = server.post("toml", {"case": tables})
    assert found.headers["content-type"].partition(";")[0] == "application/toml"
    assert tomllib.loads(found.text) == tables
    path = tmp_path / "sent.toml"
    path.write_bytes(found.content)
    run = server.post("run", {"case": tables}).json()
    assert_same(document("run", path, "--json")["results"], run["results"])


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_drawing(server, path):
    from ballscrew.faces.report.drawing import drawing
    from ballscrew.questions.run.compute import run

    found = server.post("drawing", {"case": tables_of(path)})
    assert found.headers["content-type"].partition(";")[0] == "image/svg+xml"
    assert found.text == drawing(run(case_file.load(path)))


#: Each kind once; those of the elastic nut take four times as long.
REPORTS = [
    ("olaru2005", "pdf"),
    ("feed_drive", "html"),
    pytest.param("catalogue_screw", "html", marks=pytest.mark.long),
    pytest.param("catalogue_screw", "pdf", marks=pytest.mark.long),
]


@pytest.mark.parametrize(("stem", "kind"), REPORTS)
def test_report(server, stem, kind, tmp_path):
    """Byte for byte the file that the command writes; as HTML with a project, a date and another design beside it."""
    path, to = PAPER.with_stem(stem), tmp_path / f"report.{kind}"
    said = {"project": "Axis 2", "date": "2026-11-23"} if kind == "html" else {}
    beside = [PAPER] * bool(said)
    others = {"beside": [tables_of(other) for other in beside]} if beside else {}
    found = server.post(f"report?kind={kind}", {"case": tables_of(path), **said, **others})
    assert found.headers["content-type"].partition(";")[0] == {"pdf": "application/pdf", "html": "text/html"}[kind]
    options = [text for name, value in said.items() for text in (f"--{name}", value)]
    printed("report", path, "-o", to, *options, *(text for other in beside for text in ("--beside", other)))
    assert found.content == to.read_bytes()
    assert (b"Project: Axis 2" in found.content) == (b"side by side" in found.content) == bool(said)
    refused = server.post("report", {"case": tables_of(path), "samples": 2**20})
    assert refused.json()["lines"][0].startswith("--samples: too many (1,048,576) · ")
    refused = server.post("report", {"case": tables_of(path), "date": "tomorrow"})
    assert (refused.status_code, refused.json()["faults"][0]["where"]) == (422, "--date")
    refused = server.post("report", {"case": tables_of(path), "beside": [tables_of(path)] * 4})
    assert (refused.status_code, refused.json()["faults"][0]["where"]) == (422, "request.beside")


# -- what is refused ------------------------------------------------------------------------------

BAD = {
    "unit": ["screw.lead=5"],
    "several": [
        "screw.lead=5",
        "operation.axial_load=-4 kN",
        "screw.contact_angle=90 deg",
        "lubricant.viscosity=1 cSt",
    ],
    "unknown": ["screw.leed=5 mm", "operation.axial_laod=1 N", "oil.x=1"],
    "too many": [f"screw.key{i}=1" for i in range(15)],
    "law": ["model.hertz=exat", "model.friction.decai=1"],
    "model": ["model.name=olaru205"],
    "row": ["screw.catalogue=rexroth-40x10x6-6-doubel"],
    "calibration": ["model.calibration=rexroth-2007"],
    "nut": ["nut.type=duble", "nut.preload=7"],
    "ball": ["screw.ball_diameter=31.75 mm"],
    "distribution": ["screw.lead=5 mm ± 1 ± 2 mm", "screw.screw_conformity=uniform(0.52)"],
    "sweep": ["sweep.axial_load=5"],
    "material": ["screw.ball_material=5"],
}


@pytest.mark.parametrize("name", BAD)
def test_lines_of_cases_at_fault(server, name):
    path = PAPER
    tables = case_file.override(tomllib.loads(path.read_text(encoding="utf-8")), BAD[name])
    said = refused(*["run", path, *(word for setting in BAD[name] for word in ("--set", setting))])
    for address in ("run", "compare", "band", "sweep", "toml"):
        found = server.post(address, {"case": tables})
        assert found.status_code == 422
        assert found.headers["content-type"] == "application/problem+json"
        assert found.json()["lines"] == said
        assert len(found.json()["faults"]) >= len(said) or len(said) == 10


@pytest.mark.parametrize(
    ("address", "more", "words"),
    [
        ("sweep", {"vary": {"axial_laod": "1:2:3 N"}}, ["sweep", "--vary", "axial_laod=1:2:3 N"]),
        ("sweep", {"vary": {"axial_load": "1:2:0 N"}}, ["sweep", "--vary", "axial_load=1:2:0 N"]),
        ("sweep", {"vary": {"axial_load": "1:2:2.5 N"}}, ["sweep", "--vary", "axial_load=1:2:2.5 N"]),
        ("sweep", {"vary": {"axial_load": "1, two N"}}, ["sweep", "--vary", "axial_load=1, two N"]),
        ("sweep", {"vary": {"lead": "-1 mm"}}, ["sweep", "--vary", "lead=-1 mm"]),
        ("sweep", {"outputs": ["eficiency"]}, ["sweep", "--output", "eficiency"]),
        ("band", {"samples": 1}, ["run", "--band", "--samples", "1"]),
        ("band", {"level": 2.0}, ["run", "--band", "--level", "2"]),
    ],
)
def test_lines_of_requests_at_fault(server, paper, address, more, words):
    found = server.post(address, {"case": paper, **more})
    assert (found.status_code, found.json()["lines"]) == (422, refused(words[0], PAPER, *words[1:]))


def test_names_that_are_not_there(server):
    assert server.get("catalogue/40x10").json()["lines"] == refused("catalogue", "show", "40x10")
    assert server.get("catalogue?words=wood").json()["lines"] == refused("catalogue", "list", "wood")
    assert server.get("validate?set=rexroth").json()["lines"] == refused("validate", "rexroth")


def refused(*words):
    with pytest.raises(InputError) as caught:
        printed(*words)
    return caught.value.lines()
