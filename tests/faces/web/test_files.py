"""Files by the API: what is saved opens again; what cannot be read is refused in words."""

import base64
import json
import tomllib

import pytest

from ballscrew.cases.case_files import project
from support.commands import ROOT


def opened(server, name, content):
    sent = {"text": content} if isinstance(content, str) else {"base64": base64.b64encode(content).decode()}
    return server.post("open", {"file": {"name": name, **sent}})


def test_what_is_saved_opens_again(server, paper, elastic):
    designs = [{"name": "paper", "case": paper, "aside": {"shop": {"bin": 7}}}, {"name": "Ö", "case": elastic}]
    for kind in ("toml", "json"):
        saved = server.client.post(f"/api/v1/project?kind={kind}", json={"designs": designs})
        assert saved.status_code == 200, saved.text
        found = opened(server, f"two.{kind}", saved.text).json()
        assert found == {
            "kind": "project",
            "comments": 0,
            "notes": [],
            "designs": [{"aside": {}, **one} for one in designs],
        }
    saved = server.post("toml", {"case": {**paper, "aside": {"shop": {"bin": 7}}}})
    assert tomllib.loads(saved.text)["aside"] == {"shop": {"bin": 7}}
    (found,) = opened(server, "case.toml", saved.text).json()["designs"]
    assert found == {"name": "case", "case": paper, "aside": {"shop": {"bin": 7}}}


def test_a_table_of_screws(server):
    found = opened(server, "own.csv", (ROOT / "examples" / "own_screws.csv").read_bytes()).json()
    assert found["kind"] == "table"
    assert found["designs"]
    run = server.post("run", {"case": found["designs"][0]["case"]})
    assert run.status_code == 200, run.text


def test_what_is_refused(server, paper):
    future = json.dumps({project.KEY: project.VERSION + 1, "designs": [{"name": "a", "case": paper}]})
    for name, content, words in (
        ("a.toml", "screw = {", "is not TOML"),
        ("a.json", "{", "is not JSON"),
        ("a.json", future, "project of an unknown version (2)"),
        ("a.json", json.dumps({"inputs": {}, "results": {}}), "has results and no case"),
        ("a.json", '{"screw": null}', "null stands for nothing"),
        ("a.csv", "a,b\n1,2\n", "a.csv"),
        ("rig.csv", "speed [rpm],axial load [N],torque [N m]\n50,1000,0.8\n", "is a log of torques"),
        ("a.xlsx", b"PK\x03\x04 no workbook", "a.xlsx"),
        ("../../etc/passwd", "", "is empty"),
    ):
        found = opened(server, name, content)
        assert found.status_code == 422, (name, found.text[:300])
        assert words in found.json()["lines"][0], (name, found.json()["lines"])
    for designs, words in (
        ([{"name": "a", "case": {"screw": None}}], "must not be null"),
        ([{"name": "a", "case": paper}] * 2, "is the name of two designs"),
        ([], "has no designs"),
    ):
        found = server.post("project", {"designs": designs})
        assert (found.status_code, words in found.text) == (422, True), found.text[:300]


@pytest.mark.slow
def test_only_tables_have_columns(server, paper):
    """A project in one line, as many programs write JSON, has many commas in it."""
    designs = [{"name": str(i), "case": paper} for i in range(80)]
    project_in_one_line = json.dumps({project.KEY: project.VERSION, "designs": designs})
    assert project_in_one_line.count(",") > 1_000
    for name, content in (("a.json", project_in_one_line), ("a.toml", f"[aside]\na = [{'1,' * 1_100}]")):
        assert opened(server, name, content).status_code == 200
    for name in ("a.csv", "a.TSV"):
        assert "has too many columns (1,101)" in opened(server, name, "1," * 1_100).text


def test_no_small_file_takes_the_memory_or_the_stack(server):
    """Long keys took a gigabyte in ``tomllib``, deep tables the stack and the connection with it."""
    before = server.memory
    for name, content, words in (
        ("a.toml", "[screw]\n" + "a." * 12_000 + "b=1", "a key has more than 16 parts"),
        ("a.toml", "[" + "a . " * 12_000 + "b]", "a key has more than 16 parts"),
        ("a.toml", '"a".' * 900 + "b=1", "a key has more than 16 parts"),
        ("a.toml", "a=" + "{a=" * 100 + "1" + "}" * 100, "nested more than 16 deep"),
        ("a.json", '{"a":' * 300 + "1" + "}" * 300, "nested more than 16 deep"),
    ):
        found = opened(server, name, content)
        assert (found.status_code, words in found.json()["lines"][0]) == (422, True), (name, found.text[:300])
    assert server.memory - before < 50
    dots = f'[aside]\nnote = "{"a." * 99}" # {"a." * 99}\n'
    assert opened(server, "a.toml", dots).json()["comments"] == 1


def test_a_project_of_very_many_names_is_written_at_once(server, paper):
    """The writer took time by their square: more than a request may, and one of the four places of quick work."""
    designs = [{"name": "a", "case": paper, "aside": {"shop": {f"bin {i}": i for i in range(15_000)}}}]
    saved = server.post("project", {"designs": designs})
    assert saved.status_code == 200, saved.text[:300]
    assert tomllib.loads(saved.text)["designs"] == designs


def test_what_json_has_not_is_kept_as_text(server, paper):
    """Nothing is rounded or lost on the way through the page, and all that opens can be saved."""
    aside = """
    bought = 2026-01-01
    at = 2026-01-01T07:00:00Z
    price = nan
    most = [1.5, -inf]
    number = 9007199254740993
    deep = { a = { b = { c = 1 } } }
    """
    saved = server.post("toml", {"case": paper}).text
    found = opened(server, "case.toml", f"{saved}\n[shop]\n{aside}")
    assert found.status_code == 200, found.text
    (design,) = found.json()["designs"]
    assert design["aside"]["shop"] == {
        "bought": "2026-01-01",
        "at": "2026-01-01T07:00:00+00:00",
        "price": "nan",
        "most": [1.5, "-inf"],
        "number": "9007199254740993",
        "deep": {"a": {"b": {"c": 1}}},
    }
    names = ("bought", "at", "price", "most", "number")
    assert [note.partition(" is kept as text")[0] for note in found.json()["notes"]] == [f"shop.{n}" for n in names]
    again = server.post("project", {"designs": [design]})
    assert (again.status_code, tomllib.loads(again.text)["designs"][0]) == (200, design)
    too_deep = opened(server, "case.toml", f"{saved}\n[shop]\na.b.c.d.e = 1")
    assert (too_deep.status_code, "shop.a.b.c.d.e: is nested too deeply" in too_deep.text) == (422, True)


@pytest.mark.slow
def test_a_selection_tells_the_cases_of_its_candidates(server):
    need = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "preload": "2 %"}
    table = {"name": "own.csv", "text": (ROOT / "examples" / "own_screws.csv").read_text(encoding="utf-8")}
    found = server.post("select", {"need": need, "table": table})
    assert found.status_code == 200, found.text[:300]
    candidates = found.json()["candidates"]
    # the case of a candidate needs no table: it is computed alone, with the same answer
    fields = ("screw_torque", "preload_drag", "rigidity")
    for one in (candidates[0], candidates[-1]):
        run = server.post("check", {"case": one["case"]}).json()
        assert [run["results"].get(name) for name in fields] == [one["results"].get(name) for name in fields]
        assert run["ratings"]["listed"] == one["ratings"]["listed"]


def test_all_texts_of_the_page_are_sent_compressed(server):
    for path in ("/", "/style.css", "/viewer/swagger-ui-bundle.js"):
        packed = server.client.get(path, headers={"Accept-Encoding": "br, gzip"})
        plain = server.client.get(path, headers={"Accept-Encoding": "identity"})
        assert packed.headers["content-encoding"] == "gzip"
        assert "content-encoding" not in plain.headers
        assert packed.content == plain.content
        assert int(packed.headers["content-length"]) < 0.6 * len(plain.content)
        assert "Accept-Encoding" in packed.headers["vary"]
