"""The texts of the page: one file of them, and no text anywhere else."""

import re
from pathlib import Path

from ballscrew.faces.web import page_texts

PAGE = Path(page_texts.__file__).with_name("page")
TEXTS = page_texts.texts()
SCRIPTS = {file.name: file.read_text(encoding="utf-8") for file in PAGE.rglob("*.js")}
#: Comments and patterns, which are skipped; then strings, and templates, of which what is computed is left out.
_TOKEN = re.compile(
    r"""/\*.*?\*/|(?:^|\s)//[^\n]*|(?<=\()/(?:\\.|[^/\n\\])+/|"((?:\\.|[^"\\\n])*)"|'[^'\n]*'|`((?:\\.|[^`\\])*)`""",
    re.DOTALL,
)
_COMPUTED = re.compile(r"\$\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}")
#: A literal that reads like a sentence or a label: two words that are no markup.
_WORDS = re.compile(r"^[^<]*[A-Za-z]{2,}[,:;]? [a-z]{2,}")
#: Two words that nobody reads: classes of elements, units, selectors, and a defect of the page.
CODES = {
    "(prefers-color-scheme: dark)", "chart low", "chart low whole-width",
    "chart whole-width", "field given",
    "field start given",
    "area light", "area zone", "input, select", "key area", "kg cm^2", "lbf in", "line thin", "mm rpm",
    "no element #…", "no element …", "part absent", "part-of-axis absent", "point diamond", "scroll whole",
    "verdict careful", "warning card-trouble",
}  # fmt: skip


def test_the_file_is_sorted():
    """So that two people who add texts do not meet at the end of the file."""
    assert list(TEXTS) == sorted(TEXTS)


def test_every_text_is_used_and_there():
    """Literal keys are in the table; a key of the table is a literal, or begins with a prefix that names complete."""
    html = PAGE.joinpath("index.html").read_text(encoding="utf-8")
    code = "\n".join(SCRIPTS.values())
    named = set(re.findall(r'data-text(?:-[a-z-]+)?="([^"]+)"', html)) | set(re.findall(r'\btext\(\s*"([^"]+)"', code))
    assert named <= TEXTS.keys()
    quoted = set(re.findall(r'"([a-z_]+(?:\.[a-z0-9_]+)+)"', code))
    prefixes = tuple(re.findall(r"`([a-z_]+\.(?:[a-z_]+\.)*)\$\{", code))
    unused = {key for key in TEXTS.keys() - named - quoted if not key.startswith(prefixes)}
    assert unused == set()


def literals(script):
    """All that is quoted in a script."""
    return [_COMPUTED.sub("…", one[1] or one[2]) for one in _TOKEN.finditer(script) if one[1] or one[2]]


def test_no_script_has_a_text_of_its_own():
    found = {
        name: [one for one in literals(text) if _WORDS.match(one) and one not in CODES]
        for name, text in SCRIPTS.items()
    }
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_help_names_pages_of_the_theory():
    pages = set(re.findall(r'^  (?:"[a-z_.]+"|[a-z]+): "([a-z]+)",$', SCRIPTS["help.js"], re.MULTILINE))
    theory = Path(__file__).parents[3] / "docs" / "theory"
    assert len(pages) > 5
    assert {page for page in pages if not (theory / f"{page}.md").is_file()} == set()
    assert {f"help.page.{page}" for page in pages} == {key for key in TEXTS if key.startswith("help.page.")}


def test_cards_name_pages_of_the_documentation():
    pages = {page for script in SCRIPTS.values() for page in re.findall(r'"(howto/\w+)"', script)}
    docs = Path(__file__).parents[3] / "docs"
    assert {"howto/reversal", "howto/ripple"} <= pages
    assert {page for page in pages if not (docs / f"{page}.md").is_file()} == set()


def test_the_page_has_its_texts(server):
    found = server.client.get("/")
    assert TEXTS["page.lead"] in found.text
    assert "data-text" not in found.text
    again = server.client.get("/", headers={"If-None-Match": found.headers["etag"]})
    assert again.status_code == 304
