"""The page in the visitor's language: one file of texts for each, with the same keys, and no text anywhere else."""

import json
import re
from pathlib import Path

import pytest

from ballscrew.case_schema.schema import json_schema
from ballscrew.optimisation.need_schema import json_schema as need_schema
from ballscrew.web import languages

PAGE = Path(languages.__file__).with_name("page")
ENGLISH = languages.texts()["en"]
OTHERS = [name for name in languages.texts() if name != "en"]
SCRIPTS = {file.name: file.read_text(encoding="utf-8") for file in PAGE.rglob("*.js")}
#: Texts whose English stands at their source in Python: annotations of fields, and names of the vocabulary.
OF_PYTHON = (
    "cause.", "field.", "mechanism.", "option.", "problem.", "quantity.", "record.", "sentence.", "start.", "unit.",
)  # fmt: skip
#: Comments and patterns, which are skipped; then strings, and templates, of which what is computed is left out.
_TOKEN = re.compile(
    r"""/\*.*?\*/|(?:^|\s)//[^\n]*|(?<=\()/(?:\\.|[^/\n\\])+/|"((?:\\.|[^"\\\n])*)"|'[^'\n]*'|`((?:\\.|[^`\\])*)`""",
    re.DOTALL,
)
_COMPUTED = re.compile(r"\$\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}")
#: A literal that reads like a sentence or a label: two words.
_WORDS = re.compile(r"[A-Za-z]{2,}[,:;]? [a-z]{2,}")
#: Two words that nobody reads: classes of elements, units, selectors, and a defect of the page.
CODES = {
    "(prefers-color-scheme: dark)", "card-start whole-width", "chart low", "field given", "field start given",
    "input, select", "kg cm^2", "lbf in", "line thin", "mm rpm",
    "no element #…", "no element …", "scroll whole", "verdict careful",
    # English remedies of the server for files, said for a page
    "fill in the section …", "fill in {", "in a file write", "the section …",
}  # fmt: skip


def own(texts):
    return {key: text for key, text in texts.items() if not key.startswith(OF_PYTHON)}


def placeholders(text):
    return sorted(re.findall(r"\{(\w+)\}", text))


@pytest.mark.parametrize("name", OTHERS)
def test_a_translation_is_whole(name):
    found = own(languages.texts()[name])
    assert found.keys() == ENGLISH.keys()
    assert {key: placeholders(text) for key, text in found.items()} == {
        key: placeholders(text) for key, text in ENGLISH.items()
    }
    assert all(text.strip() for text in found.values())
    sentences = {
        key: text for key, text in languages.texts()[name].items() if key.startswith(("sentence.", "problem."))
    }
    assert {key for key, text in sentences.items() if key.count("{}") != text.count("{}")} == set()


@pytest.mark.parametrize("name", list(languages.texts()))
def test_files_are_sorted(name):
    """So that two people who add texts do not meet at the end of the file."""
    first, *others = json.loads(PAGE.joinpath("texts", f"{name}.json").read_text(encoding="utf-8"))
    assert first == "language"
    assert others == sorted(others)


def test_every_text_is_used_and_there():
    """Literal keys are in the table; a key of the table is a literal, or begins with a prefix that names complete."""
    html = PAGE.joinpath("index.html").read_text(encoding="utf-8")
    code = "\n".join(SCRIPTS.values())
    named = set(re.findall(r'data-text(?:-[a-z-]+)?="([^"]+)"', html)) | set(re.findall(r'\btext\(\s*"([^"]+)"', code))
    assert named <= ENGLISH.keys()
    quoted = set(re.findall(r'"([a-z_]+(?:\.[a-z0-9_]+)+)"', code))
    prefixes = tuple(re.findall(r"`([a-z_]+\.(?:[a-z_]+\.)*)\$\{", code))
    unused = {key for key in ENGLISH.keys() - named - quoted - {"language"} if not key.startswith(prefixes)}
    assert unused == set()


def fields(schema, node, path=()):
    """The paths of all fields of a case, and the last names of the fields within tables of them."""
    node = schema["$defs"][node["$ref"].rpartition("/")[2]] if "$ref" in node else node
    for option in [node, *node.get("anyOf", [])]:
        inner = option if "$ref" not in option else schema["$defs"][option["$ref"].rpartition("/")[2]]
        for name, one in inner.get("properties", {}).items():
            yield from (".".join([*path, name]), name) if len(path) < 2 else (name,)
            yield from fields(schema, one, (*path, name))


@pytest.mark.parametrize("name", OTHERS)
def test_translated_fields_are_fields(name):
    schema = json_schema()
    of_needs = need_schema()
    known = set(fields(schema, schema)) | {path for path in fields(of_needs, of_needs) if path.startswith("need.")}
    known |= {f"need.{name}" for name in of_needs["properties"]}
    translated = {key for key in languages.texts()[name] if key.startswith("field.")}
    assert len(translated) > 150
    assert {key for key in translated if key.removeprefix("field.").rpartition(".")[0] not in known} == set()


def literals(script):
    """All that is quoted in a script."""
    return [_COMPUTED.sub("…", one[1] or one[2]) for one in _TOKEN.finditer(script) if one[1] or one[2]]


def test_no_script_has_a_text_of_its_own():
    found = {
        name: [one for one in literals(text) if _WORDS.search(one) and one not in CODES]
        for name, text in SCRIPTS.items()
    }
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_help_names_pages_of_the_theory():
    pages = set(re.findall(r'^  (?:"[a-z_.]+"|[a-z]+): "([a-z]+)",$', SCRIPTS["help.js"], re.MULTILINE))
    theory = Path(__file__).parents[2] / "docs" / "theory"
    assert len(pages) > 5
    assert {page for page in pages if not (theory / f"{page}.md").is_file()} == set()
    assert {f"help.page.{page}" for page in pages} == {key for key in ENGLISH if key.startswith("help.page.")}


@pytest.mark.parametrize(
    ("cookie", "header", "language"),
    [
        (None, "", "en"), (None, "de-AT,de;q=0.9,en;q=0.8", "de"), (None, "fr, en;q=0.5, de;q=0.7", "de"),
        (None, "de;q=0, en", "en"), ("de", "en", "de"), ("en", "de", "en"), ("../x", "de", "de"),
        (None, "x;q=nan", "en"),
    ],
)  # fmt: skip
def test_language_of_a_visitor(server, cookie, header, language):
    headers = {"Accept-Language": header} | ({"Cookie": f"{languages.COOKIE}={cookie}"} if cookie else {})
    found = server.client.get("/", headers=headers)
    assert f'<html lang="{language}">' in found.text
    assert languages.texts()[language]["page.lead"] in found.text
    assert found.headers["content-language"] == language
    assert "data-text" not in found.text
    again = server.client.get("/", headers=headers | {"If-None-Match": found.headers["etag"]})
    assert again.status_code == 304


def test_the_page_in_german(visit):
    here = visit()
    here.expected = ("status of 422",)
    here.open()
    here.page.locator("#language").select_option("de")
    here.page.wait_for_selector('html[lang="de"][data-ready]')
    try:
        here.settle()
        assert here.text("#checks-title") == "Nachweise"
        assert re.search(r"\d,\d", here.text("#numbers"))
        assert not re.search(r"\d\.\d", here.text("#numbers"))
        here.unit("operation.axial_load", "N").type("operation.axial_load", "1.234")  # a thousand to most, not to all
        fault = here.page.locator("[data-path='operation.axial_load'] .fault").inner_text()
        assert "könnte zwei Zahlen sein (1.234 N): 1234 oder 1,234 schreiben" in fault
        assert here.type("operation.axial_load", "1.234,4").text("#case").startswith("1234 N")
    finally:
        here.page.context.clear_cookies()
