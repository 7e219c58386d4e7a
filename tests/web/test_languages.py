"""The page in the visitor's language: one file of texts for each, with the same keys, and no text anywhere else."""

import json
import re
from importlib import resources
from pathlib import Path

import pytest

from ballscrew.web import languages

PAGE = resources.files("ballscrew.web").joinpath("page")
ENGLISH = languages.texts()["en"]
OTHERS = [name for name in languages.texts() if name != "en"]
SCRIPTS = {file.name: file.read_text(encoding="utf-8") for file in Path(str(PAGE)).rglob("*.js")}
#: Texts whose English stands at their source in Python: annotations of fields, and names of the vocabulary.
OF_PYTHON = ("field.",)
#: Scripts whose texts have not moved yet.
TO_MOVE = {
    "chart_parts.js", "charts.js", "compare.js", "curves.js", "faults.js", "fields.js", "form.js", "main.js",
    "plot.js", "results.js", "schema.js", "server.js", "stiffness.js", "temperatures.js",
}  # fmt: skip
#: Comments, which are skipped; then strings, and templates, of which what is computed is left out.
_TOKEN = re.compile(r"""/\*.*?\*/|(?:^|\s)//[^\n]*|"((?:\\.|[^"\\\n])*)"|'[^'\n]*'|`((?:\\.|[^`\\])*)`""", re.DOTALL)
_COMPUTED = re.compile(r"\$\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}")
#: A literal that reads like a sentence or a label: two words.
_WORDS = re.compile(r"[A-Za-z]{2,}[,:;]? [a-z]{2,}")
#: Two words that nobody reads: classes of elements, units, selectors, and a defect of the page.
CODES = {
    "(prefers-color-scheme: dark)", "card-start whole-width", "chart low", "field given", "field start given",
    "input, select", "lbf in", "mm rpm",
    "no element #…", "no element …", "scroll whole", "verdict careful",
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


def literals(script):
    """All that is quoted in a script."""
    return [_COMPUTED.sub("…", one[1] or one[2]) for one in _TOKEN.finditer(script) if one[1] or one[2]]


def test_no_script_has_a_text_of_its_own():
    found = {
        name: [one for one in literals(text) if _WORDS.search(one) and one not in CODES]
        for name, text in SCRIPTS.items()
    }
    assert {name: lines for name, lines in found.items() if lines and name not in TO_MOVE} == {}


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
    here = visit().open()
    here.page.locator("#language").select_option("de")
    here.page.wait_for_selector('html[lang="de"][data-ready]')
    try:
        here.settle()
        assert here.text("#checks-title") == "Nachweise"
        assert re.search(r"\d,\d", here.text("#numbers"))
        assert not re.search(r"\d\.\d", here.text("#numbers"))
    finally:
        here.page.context.clear_cookies()
