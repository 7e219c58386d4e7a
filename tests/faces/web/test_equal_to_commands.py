"""What the server answers is what the command line prints, number for number and line for line."""

import json
import math
import tomllib

import pytest
import typer.testing

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.faces.cli import main
from ballscrew.physics.sizing.catalogue import catalogue
from support.commands import ROOT
from support.documents import assert_same, differences

EXAMPLES = ROOT / "examples"
#: A row of balls, a nut of elastic bodies, and one that moves; that every example is answered is a test of commands.
KINDS = [EXAMPLES / f"{name}.toml" for name in ("olaru2005", "catalogue_screw", "vertical_axis")]
PAPER = KINDS[0]
SETTINGS = ["model.friction=greenwood-tripp", "lubricant.grade=ISO VG 32", "operation.screw_speed=0 rpm"]


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


#: Commands whose addresses send charts of their own.
WITHOUT_SHEETS = ("run", "sweep")


def assert_as_command(found, words, *, with_sheet=True):
    """Fail where an answer is not the document of a command, or its sheet is not that of the command.

    The command says one of them at a time, and computes as long again for the other.
    """
    sheet = found.pop("sheet", None)
    assert_same(found, document(*words, "--json"))
    assert (sheet is None) == (words[0] in WITHOUT_SHEETS)
    if sheet is not None and with_sheet:
        assert_same(sheet, document(*words, "--sheet"))


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


@pytest.fixture(
    params=[*((path, ()) for path in KINDS), (PAPER, SETTINGS)], ids=[*(path.stem for path in KINDS), "set"]
)
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


#: The model that answers the quickest. It is never starved of oil: the duty is of the reference model, which may be.
QUICK = "model.name=olaru2005"
#: Answers of a question that is asked in a quicker way as well, whose sheet is compared there.
MORE = ("compare of a nut", "axis at places")
#: Questions by the example, what is set in it, the options of the request and the words of the command.
ASKED = {
    "compare": ("compare", "olaru2005", (), {}, []),
    "compare of a nut": ("compare", "catalogue_screw", (), {}, []),
    "sweep over two axes": (
        "sweep", "olaru2005", (),
        {"vary": {"operation.axial_load": "1, 2 kN", "lead": "5, 10 mm"}, "outputs": ["screw_torque", "efficiency"]},
        ["--vary", "operation.axial_load=1, 2 kN", "--vary", "lead=5, 10 mm",
         "--output", "screw_torque", "--output", "efficiency"],
    ),
    "sweep of a nut": (
        "sweep", "catalogue_screw", (), {"vary": {"axial_load": "100:4000:3 N"}, "outputs": ["holding_torque"]},
        ["--vary", "axial_load=100:4000:3 N", "--output", "holding_torque"],
    ),
    "sweep with a band": (
        "sweep", "feed_drive", [QUICK],
        {"vary": {"screw_speed": "0, 300 rpm"}, "outputs": ["screw_torque", "efficiency"], "band": True},
        ["--vary", "screw_speed=0, 300 rpm", "--output", "screw_torque", "--output", "efficiency", "--band"],
    ),
    "duty": ("duty", "vertical_axis", (), {}, []),
    "warm-up": (
        "warm-up", "warm_up", [QUICK], {"hours": 0.5, "cool_down": 0.25}, ["--hours", 0.5, "--cool-down", 0.25],
    ),
    "warm-up with a band": (
        "warm-up", "rig", [QUICK], {"hours": 0.5, "band": True, "samples": 8},
        ["--hours", 0.5, "--band", "--samples", 8],
    ),
    "axis": ("axis", "feed_axis", (), {}, []),
    "axis at places": ("axis", "feed_axis", (), {"at": ["300 mm", "0.5 m"]}, ["--at", "300 mm", "--at", "0.5 m"]),
    "reversal": (
        "reversal", "service", ["operation.screw_speed=6 rpm"],
        {"from_rest": True, "travel": "50 um", "inertia": "2e-3 kg m^2", "gap": 0.25},
        ["--from-rest", "--travel", "50 um", "--inertia", "2e-3 kg m^2", "--gap", 0.25],
    ),
    "ripple": (
        "ripple", "service", ["screw.loaded_balls=20", "nut.preload=1.5 kN"],
        {"fault": ["preload=0.35"], "return_balls": 10, "turns": 6.0, "groove_deviation": "2 um"},
        ["--fault", "preload=0.35", "--return-balls", 10, "--turns", 6, "--groove-deviation", "2 um"],
    ),
    "sensitivity": (
        "sensitivity", "olaru2005", (), {"samples": 32, "output": "efficiency", "seed": 3},
        ["--samples", 32, "--output", "efficiency", "--seed", 3],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", ASKED)
def test_an_answer_is_the_document_of_the_command(server, tmp_path, name):
    command, example, settings, options, words = ASKED[name]
    tables = tables_of(EXAMPLES / f"{example}.toml", settings)
    found = server.post(command, {"case": tables, **options}).json()
    assert_as_command(found, (command, written(tables, tmp_path), *words), with_sheet=name not in MORE)


@pytest.mark.parametrize(
    ("path", "options"),
    [*((path, {"samples": 100, "level": 0.8}) for path in KINDS), (PAPER, {"samples": 64, "only_given": True})],
    ids=[*(path.stem for path in KINDS), "given"],
)
def test_band(server, path, options):
    found = server.post("band", {"case": tables_of(path), **options}).json()
    words = [word for name in ("samples", "level") if name in options for word in (f"--{name}", options[name])]
    words += ["--only-given"] * options.get("only_given", False)
    said = found.pop("words")
    assert set(said["sentences"]) < {one["text"] for one in found["verdicts"]}
    assert_as_command(found, ("run", path, "--band", *words), with_sheet=path in (PAPER, KINDS[1]))


def test_samples_of_a_sweep(server):
    """Many points have fewer samples, and more than there are is refused."""
    body = {"case": tables_of(PAPER), "vary": {"screw_speed": "1:300:200 rpm"}, "outputs": ["efficiency"], "band": True}
    assert server.post("sweep", body).json()["band"]["samples"] == 4096
    refused = server.post("sweep", {**body, "samples": 2**20})
    assert (refused.status_code, "--samples: too many" in refused.text) == (422, True)


def test_duty_of_a_recorded_motion(server, tmp_path):
    """A file that comes with the case stands in the place of its motion, as ``--trace`` does; no operating point."""
    tables = tables_of(EXAMPLES / "vertical_axis.toml")
    del tables["operation"]
    assert server.post("run", {"case": tables}).status_code == 422
    rows = [f"{0.01 * i:.2f},{100 * (1 - math.cos(0.01 * math.pi * i)):.3f}" for i in range(201)]
    log = tmp_path / "run.csv"
    log.write_text("\n".join(["time [s],position [mm]", *rows]), encoding="utf-8")
    sent = {"name": log.name, "text": log.read_text(encoding="utf-8")}
    found = server.post("duty", {"case": tables, "trace": sent}).json()
    assert_as_command(found, ("duty", written(tables, tmp_path), "--trace", str(log)))
    refused = server.post("duty", {"case": tables, "trace": {"name": "a/run.csv", "text": "x"}})
    assert (refused.status_code, refused.json()["lines"][0].startswith("run.csv")) == (422, True)


def test_catalogue(server):
    assert server.get("catalogue").json() == json.loads(printed("catalogue", "list", "--json"))
    found = server.get("catalogue", params={"words": "Double 40x"}).json()
    assert found == json.loads(printed("catalogue", "list", "double", "40x", "--json"))
    for name in [row.name for row in catalogue().values() if not row.refusal][::70]:
        row = server.get(f"catalogue/{name}").json()
        assert row.pop("case") == tomllib.loads(printed("catalogue", "show", name, "--case"))
        assert row == json.loads(printed("catalogue", "show", name.upper(), "--json"))


def test_validate(server):
    found = server.get("validate", params={"set": "thk-jis"}).json()
    assert_same(found, document("validate", "thk-jis", "--json"))


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


@pytest.mark.parametrize("path", KINDS, ids=lambda path: path.stem)
def test_drawing(server, path):
    from ballscrew.faces.report.drawing import drawing
    from ballscrew.questions.run.compute import run

    found = server.post("drawing", {"case": tables_of(path)})
    assert found.headers["content-type"].partition(";")[0] == "image/svg+xml"
    assert found.text == drawing(run(case_file.load(path)))


@pytest.mark.parametrize("kind", ["pdf", "html"])
def test_report(server, kind, tmp_path):
    """Byte for byte the file that the command writes; as HTML with a project, a date and another design beside it."""
    path, to = PAPER, tmp_path / f"report.{kind}"
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

#: What is wrong with a case is a test of cases: here one fault, several, and more than are said.
BAD = {
    "unit": ["screw.lead=5"],
    "several": [
        "screw.lead=5",
        "operation.axial_load=-4 kN",
        "screw.contact_angle=90 deg",
        "lubricant.viscosity=1 cSt",
    ],
    "too many": [f"screw.key{i}=1" for i in range(15)],
}


@pytest.mark.parametrize("name", BAD)
def test_lines_of_cases_at_fault(server, name):
    path = PAPER
    tables = case_file.override(tomllib.loads(path.read_text(encoding="utf-8")), BAD[name])
    said = refused(*["run", path, *(word for setting in BAD[name] for word in ("--set", setting))])
    for address in ("run", "band", "toml"):
        found = server.post(address, {"case": tables})
        assert found.status_code == 422
        assert found.headers["content-type"] == "application/problem+json"
        assert found.json()["lines"] == said
        assert len(found.json()["faults"]) >= len(said) or len(said) == 10


@pytest.mark.parametrize(
    ("address", "example", "more", "words"),
    [
        ("sweep", "olaru2005", {"vary": {"axial_laod": "1:2:3 N"}}, ["--vary", "axial_laod=1:2:3 N"]),
        ("sweep", "olaru2005", {"outputs": ["eficiency"]}, ["--output", "eficiency"]),
        ("band", "olaru2005", {"samples": 1}, ["--band", "--samples", 1]),
        ("warm-up", "warm_up", {"hours": 0.0}, ["--hours", 0]),
        ("warm-up", "warm_up", {"samples": 8}, ["--samples", 8]),
        ("reversal", "service", {"travel": "-1 mm"}, ["--travel", "-1 mm"]),
        ("ripple", "service", {"fault": ["rust"]}, ["--fault", "rust"]),
        ("ripple", "olaru2005", {}, []),
    ],
)
def test_lines_of_requests_at_fault(server, address, example, more, words):
    path = EXAMPLES / f"{example}.toml"
    found = server.post(address, {"case": tables_of(path), **more})
    command = {"band": "run"}.get(address, address)
    assert (found.status_code, found.json()["lines"]) == (422, refused(command, path, *words))


def test_names_that_are_not_there(server):
    assert server.get("catalogue/40x10").json()["lines"] == refused("catalogue", "show", "40x10")
    assert server.get("catalogue?words=wood").json()["lines"] == refused("catalogue", "list", "wood")
    assert server.get("validate?set=rexroth").json()["lines"] == refused("validate", "rexroth")


def refused(*words):
    with pytest.raises(InputError) as caught:
        printed(*words)
    return caught.value.lines()
