"""What the scripts of the page name is there: pages of the theory and of the documentation."""

import re
from importlib import resources
from pathlib import Path

from support.commands import ROOT

PAGE = Path(str(resources.files("ballscrew.faces.page")))
SCRIPTS = {file.name: file.read_text(encoding="utf-8") for file in PAGE.rglob("*.js")}


def test_help_names_pages_of_the_theory():
    pages = set(re.findall(r'^  (?:"[a-z_.]+"|[a-z]+): "([a-z]+)",$', SCRIPTS["help.js"], re.MULTILINE))
    theory = ROOT / "docs" / "theory"
    assert len(pages) > 5
    assert {page for page in pages if not (theory / f"{page}.md").is_file()} == set()
    headings = SCRIPTS["help.js"].partition("const PAGES_IN_WORDS = {")[2].partition("};")[0]
    assert pages == set(re.findall(r"^  ([a-z]+): ", headings, re.MULTILINE))


def test_cards_name_pages_of_the_documentation():
    pages = {page for script in SCRIPTS.values() for page in re.findall(r'"(howto/\w+)"', script)}
    docs = ROOT / "docs"
    assert {"howto/reversal", "howto/ripple"} <= pages
    assert {page for page in pages if not (docs / f"{page}.md").is_file()} == set()
