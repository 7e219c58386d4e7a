"""The files of the static page: the same bytes each time, whole or not at all, and nothing but its own scripts."""

import base64
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.faces.page import bundle, site

TESTS = Path(__file__).parents[2]
FEW = {"models": ["olaru2005"], "nuts": ["row"]}


@pytest.fixture(scope="module")
def files():
    return site.site(**FEW)


def contents_name(files):
    """The script that holds the contents has the digest of the page in its name."""
    (name,) = (name for name in files if name.startswith("contents-"))
    return name


def contents_of(script):
    return json.loads(re.fullmatch(r"globalThis\.ballscrewSite=(.*);\n", script, re.DOTALL)[1])


def test_two_builds_are_the_same_bytes(files):
    # in a process of its own, whose sets have another order
    program = f"""
import hashlib
import pytest
from ballscrew.faces.page import site
from support.quick_kernels import UNOPTIMISED, set_code_optimisation
set_code_optimisation(pytest.MonkeyPatch(), UNOPTIMISED)
for name, content in site.site(**{FEW}).items():
    print(name, hashlib.sha256(content).hexdigest())
"""
    build = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "PYTHONHASHSEED": "1", "PYTHONPATH": str(TESTS)},
        capture_output=True,
        text=True,
        check=True,
    )
    digests = [f"{name} {hashlib.sha256(content).hexdigest()}" for name, content in files.items()]
    assert build.stdout.splitlines() == digests


@pytest.mark.slow
def test_a_module_has_the_name_of_its_content(files):
    modules = {name: content for name, content in files.items() if name.endswith(".wasm")}
    assert len(modules) == 6  # two structures, the oils, the solver of elastic nuts, what is judged, and what is drawn
    for name, content in modules.items():
        assert name == f"kernels/{hashlib.sha256(content).hexdigest()[:16]}.wasm"
        script = files[f"{name}.js"].decode()
        assert base64.b64decode(script.split('"')[3]) == content


def test_the_worker_keeps_every_file_of_a_server(files):
    worker = files["service_worker.js"].decode()
    known = contents_of(files[contents_name(files)].decode())
    kept = json.loads(re.search(r"const KEPT = (\[.*?\]);", worker)[1])
    assert f'"{known["digest"]}"' in worker
    assert {name for name in files if not name.endswith(".wasm.js")} == {*kept, "service_worker.js"} - {"./"}


def test_the_policy_allows_no_text_to_run(files):
    document = files["index.html"].decode()
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', document)[1]
    assert "wasm-unsafe-eval" in policy
    assert "'unsafe-" not in policy.replace("&#x27;", "'")
    assert "default-src &#x27;none&#x27;" in policy
    assert not re.search(r"<script>|\son\w+=|style=", document)


def test_a_single_file_holds_all_and_allows_its_own_scripts_alone():
    (name, content), *others = site.site(**FEW, single=True).items()
    document = content.decode()
    assert (name, others) == ("index.html", [])
    assert not re.search(r'(?:src|href)="(?!data:|#|https?:)[^"]', document)
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', document)[1].replace("&#x27;", "'")
    for text in (
        *re.findall(r"<script>(.*?)</script>", document, re.DOTALL),
        re.search(r"<style>(.*?)</style>", document, re.DOTALL)[1],
    ):
        assert bundle.hash_of(text) in policy


def test_an_earlier_page_goes_and_other_files_stay(files, tmp_path):
    old = tmp_path / "kernels" / "0123456789abcdef.wasm"
    old.parent.mkdir()
    old.write_bytes(b"")
    own = tmp_path / "kernels" / "notes.txt"
    own.write_text("mine")
    written = site.write(tmp_path, files)
    assert written[-1] == tmp_path / "index.html"
    assert (old.exists(), own.exists()) == (False, True)
    assert {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()} == {
        *files,
        "kernels/notes.txt",
    }


def test_a_page_of_somebody_else_stays(files, tmp_path):
    own = tmp_path / "index.html"
    own.write_text("<h1>my project</h1>")
    with pytest.raises(InputError, match=r"site\.out: has a page of its own"):
        site.write(tmp_path, files)
    assert [path.name for path in tmp_path.iterdir()] == ["index.html"]
    assert own.read_text() == "<h1>my project</h1>"


def test_another_version_leaves_no_file_of_the_earlier_one(files, tmp_path):
    site.write(tmp_path, files)
    for name in ("contents", "page", "bands"):
        (tmp_path / f"{name}-0123456789abcdef.js").write_text("")
    site.write(tmp_path, files)
    assert not list(tmp_path.glob("*-0123456789abcdef.js"))
    document = files["index.html"].decode()
    assert all(f'src="{name}"' in document for name in files if re.match(r"(contents|page)-", name))


def test_a_single_file_takes_the_place_of_a_folder(files, tmp_path):
    """Also the worker goes, which would show the earlier page for good."""
    site.write(tmp_path, files)
    site.write(tmp_path, {"index.html": site._MARK.encode()})
    assert "unregister" in (tmp_path / "service_worker.js").read_text()
    assert not list(tmp_path.rglob("*.wasm*"))
    assert not list(tmp_path.glob("page-*"))


def test_the_name_of_a_file_is_one_of_a_single_page(files, tmp_path):
    with pytest.raises(InputError, match="add --single"):
        site.write(tmp_path / "screw.html", files)


def test_a_row_has_the_nut_that_it_is_checked_with(files):
    known = contents_of(files[contents_name(files)].decode())["contents"]
    assert list(known["structures"]) == ["olaru2005/row", "olaru2005/single"]


def test_a_single_file_has_the_name_that_is_asked_for(tmp_path):
    files = {"index.html": b"whole"}
    assert site.write(tmp_path / "screw.html", files) == [tmp_path / "screw.html"]
    assert site.write(tmp_path / "folder", files) == [tmp_path / "folder" / "index.html"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"models": ["olaru"]}, "site.model: unknown"),
        ({"nuts": ["tripple"]}, "site.nut: unknown"),
        ({"models": ["olaru2005"], "nuts": ["oversize-balls"]}, "no such model has such a nut"),
    ],
)
def test_what_is_not_there_is_said(options, words):
    with pytest.raises(InputError, match=words):
        site.site(**options)


def test_a_folder_that_is_a_file_is_refused_and_stays(files, tmp_path):
    place = tmp_path / "notes"
    place.write_text("mine")
    with pytest.raises(InputError, match=r"site\.out"):
        site.write(place, files)
    assert place.read_text() == "mine"


def test_no_formula_stands_in_the_scripts_of_the_page():
    """Numbers come from modules: scripts count places, pixels and units."""
    allowed = {"max", "min", "PI", "abs", "floor", "round", "ceil", "log10", "sign", "hypot", "imul"}
    # the places of balls and arrows in pictures
    drawn = {"ball_places.js", "nut_picture.js", "nut_unrolled.js", "axis_sketch.js", "shapes.js"}
    for name in {*bundle.modules()} - drawn:
        used = set(re.findall(r"\bMath\.(\w+)", bundle.text_of(name)))
        assert used <= allowed, (name, used - allowed)


def test_the_bundle_refuses_what_it_cannot_join(monkeypatch):
    texts = {"main.js": 'import { a } from "./a.js";\na();\n', "a.js": "export default function a() {}\n"}
    monkeypatch.setattr(bundle, "text_of", texts.__getitem__)
    with pytest.raises(ValueError, match=r"a\.js imports or exports in another way"):
        bundle.script.__wrapped__()
    texts["a.js"] = 'import { b } from "./main.js";\n'
    with pytest.raises(ValueError, match="circle"):
        bundle.script.__wrapped__()


def test_modules_are_joined_by_what_they_import(monkeypatch):
    """By name, by another name, all of one, and what is passed on; modules of one name in two folders are two."""
    texts = {
        "main.js": 'import { one } from "./a.js";\nimport { one as other } from "./cards/a.js";\n'
        'import * as all from "./b.js";\n',
        "a.js": "export const one = 1;\n",
        "cards/a.js": 'import { one as first } from "../a.js";\nexport const [one, two] = [first, 3];\n',
        "b.js": 'export { one } from "./a.js";\n',
    }
    monkeypatch.setattr(bundle, "text_of", texts.__getitem__)
    script = bundle.script.__wrapped__()
    for line in (
        'const { one } = ofModule["a.js"];',
        'const { one: other } = ofModule["cards/a.js"];',
        'const { one: first } = ofModule["a.js"];',
        'const all = ofModule["b.js"];',
        'one: ofModule["a.js"].one',
        "return { one, two };",
    ):
        assert line in script
