"""Links lead somewhere: those of the sources here, those of the built pages if they have been built."""

import functools
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
import snowballstemmer

from support.rules import for_each

from .pages import DOCS, ROOT, blocks, name, pages

BUILT = ROOT / "out" / "docs"

LINK = re.compile(r"!?\[[^\]]*\]\(<?([^)\s>]+)>?[^)]*\)")

# -- the sources ----------------------------------------------------------------------------------


def prose(page):
    """A page without its fenced blocks and without code."""
    lines = page.read_text(encoding="utf-8").splitlines()
    for block in blocks(page):
        for number in range(block.line - 1, block.line + block.text.count("\n") + 1):
            lines[number] = ""
    return re.sub(r"`[^`\n]+`", "code", "\n".join(lines))


def slug(heading):
    """The anchor that both GitHub and the documentation make of a heading."""
    words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


@functools.cache
def anchors(page):
    return {slug(match[1]) for match in re.finditer(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)}


@for_each(page={name(page): page for page in pages()})
def test_relative_links_lead_somewhere(page):
    for target in LINK.findall(prose(page)):
        parts = urlsplit(target)
        if parts.scheme:
            continue
        found = (page.parent / unquote(parts.path)).resolve() if parts.path else page
        assert found.exists(), f"{name(page)}: {target} is not there"
        if parts.fragment:
            assert unquote(parts.fragment) in anchors(found), f"{name(page)}: {target} has no such heading"


def test_every_page_can_be_reached():
    """Every page of the documentation stands in a table of contents."""
    listed = {DOCS / "index.md"}
    for page in pages():
        for block in blocks(page):
            if block.info == "{toctree}":
                for line in block.text.splitlines():
                    target = line.strip().removesuffix(">").rpartition("<")[2]
                    if target and not target.startswith(":"):
                        listed |= set(page.parent.glob(f"{target}.md"))
    assert {page for page in pages() if DOCS in page.parents} <= listed


# -- the built pages ------------------------------------------------------------------------------

#: What a browser fetches without being asked, by tag: the attributes that say from where.
FETCHED = {
    "script": ("src",),
    "img": ("src", "srcset"),
    "source": ("src", "srcset"),
    "iframe": ("src",),
    "embed": ("src",),
    "object": ("data",),
    "video": ("src", "poster"),
    "audio": ("src",),
    "track": ("src",),
    "input": ("src",),
    "image": ("href", "xlink:href"),
    "use": ("href", "xlink:href"),
}
OUTSIDE = re.compile(r"^\s*(?:https?:)?//", re.IGNORECASE)
IN_STYLES = re.compile(r"url\(\s*['\"]?\s*(?:https?:)?//|@import\s+['\"]?(?:url\()?\s*['\"]?\s*(?:https?:)?//")


class Page(HTMLParser):
    """What a page fetches, where it links to, and the places in it that others link to."""

    def __init__(self, path):
        super().__init__()
        self.fetched, self.links, self.places, self.styles = [], [], {""}, []
        self._in_style = False
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        found = {key: value for key, value in attrs if value is not None}
        self.places |= {found[key] for key in ("id", "name") if key in found}
        self.fetched += [found[key] for key in FETCHED.get(tag, ()) if key in found]
        self.styles += [found["style"]] if "style" in found else []
        self._in_style = tag == "style"
        if tag == "link":
            # where a page says that it stands is not fetched; styles, fonts, icons are
            if found.get("rel") not in ("canonical", "author", "license"):
                self.fetched.append(found.get("href", ""))
        elif tag == "a" and "href" in found:
            self.links.append(found["href"])

    def handle_data(self, data):
        if self._in_style:
            self.styles.append(data)


@functools.cache
def parsed(path):
    return Page(path)


@pytest.fixture
def built_pages():
    """The built pages, once all of them are written: ``make docs`` runs these tests at its end."""
    if not (BUILT / ".built").is_file():
        pytest.skip("the pages are not built, or are being built: make docs")
    return sorted(BUILT.rglob("*.html"))


def test_no_built_page_asks_for_anything_outside(built_pages):
    for path in built_pages:
        page = parsed(path)
        assert not [target for target in page.fetched if OUTSIDE.match(target)], path
        assert not [style for style in page.styles if IN_STYLES.search(style)], path
    for path in BUILT.rglob("*.css"):
        assert not IN_STYLES.search(path.read_text(encoding="utf-8")), path


@pytest.mark.slow
def test_links_of_the_built_pages_lead_somewhere(built_pages):
    for path in built_pages:
        page = parsed(path)
        for target in {*page.links, *page.fetched}:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            found = Path(path.parent, unquote(parts.path)).resolve() if parts.path else path
            assert found.is_file(), f"{path.relative_to(BUILT)}: {target}"
            if BUILT / "_modules" in path.parents:
                continue  # a listing leads back to where its names are documented; some are, under shorter names
            if parts.fragment and found.suffix == ".html":
                assert unquote(parts.fragment) in parsed(found).places, f"{path.relative_to(BUILT)}: {target}"


#: Words that people search, as they stand in the glossary.
SEARCHED = "L10", "C_a", "backlash", "drag", "preload", "NLGI", "DN", "buckling", "stiffness", "critical", "wiper"


def test_the_search_of_the_built_pages_finds_the_words_of_the_glossary(built_pages):
    """As the page of the search does: the word's stem in the index, and the pages that have it."""
    stem = snowballstemmer.stemmer("english").stemWord
    written = (BUILT / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(written.removeprefix("Search.setIndex(").removesuffix(")"))
    glossary = index["docnames"].index("glossary")
    for word in SEARCHED:
        places = [index[terms].get(stem(word.lower()), []) for terms in ("terms", "titleterms")]
        found = {page for some in places for page in (some if isinstance(some, list) else [some])}
        assert glossary in found, f"the search does not find {word}"
