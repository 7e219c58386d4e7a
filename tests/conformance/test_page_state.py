"""The state of the page is in one place: no module of its JavaScript has variables, and none keeps listeners.

What a card holds while it is open (the log that was dropped, columns given by hand) is in the functions that set it up,
and not looked for here.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import ballscrew

#: Objects of modules that change, and why each is there. One more is one more place to look for the state of the page.
HOLDERS = {
    "store.js store": "the state of the page: what somebody has",
    "answers.js answers": "what the server has answered to it, and the requests under way",
    "band_worker.js known": "the contents of the page, sent once",
    "band_worker.js modules": "modules that it was sent, by their files",
    "band_worker.js wanted": "bands that are wanted still",
    "cards.js places": "the cards, and which of them were set up",
    "dom.js listening": "elements with listeners, which stand as they were made",
    "designs.js leads": "leads that the server has computed, by screw: the same for the same screw",
    "designs.js starts": "cases to start from, as the server has them: the same for the same name",
    "history.js entries": "the place in the history of the browser",
    "hot_and_cold.js hotAndCold": "what the curves cold and hot are computed of, and the request under way",
    "keeping.js keeping": "the entry of this tab in the storage of the browser",
    "embedded.js compiled": "modules that were compiled, by their files: the same for the same file",
    "local_engine.js localEngine": "the module of the case on the page, and what is known of it",
    "long_work.js list": "the place of the lines of jobs",
    "long_work.js slow": "addresses whose requests took too long",
    "operating_point.js dragged": "tells of an operating point that is dragged",
    "palette.js screen": "the colours of the screen, read once for each set of them",
    "chart_place.js moving": "whether axes stay as they are while something moves",
    "chart_place.js places": "the charts by their places",
    "chart_place.js seen": "tells which places come into view",
    "chart_place.js sized": "tells which charts have another size",
    "results.js told": "what screen readers were told last",
    "schema.js schema": "the schema of a case, filled once before anything is shown",
    "server.js awaited": "requests under way, by what was asked: the same is asked once",
    "server.js connection": "whether the server answers",
    "server.js kept": "answers by what was asked",
    "views.js kept": "keeps the part that is seen where it is, until somebody moves",
    "vocabulary.js vocabulary": "the words of the server, filled once before anything is shown",
}
#: What ``new`` makes that does not change.
CONSTANT = {"Intl", "Promise", "RegExp"}

_DECLARED = re.compile(r"^(?:export )?(let|var|const) (?:\{[^}]*\}|\[[^\]]*\]|(\w+))", re.MULTILINE)
_MADE = re.compile(r"\bnew (\w+)")


class Statement(NamedTuple):
    """A declaration of a module by itself: ``let``, ``var`` or ``const``, its name, and its text."""

    keyword: str
    name: str
    text: str


def declarations(source: str) -> Iterator[Statement]:
    """The declarations at the top of a module, which biome has formatted: what is in a function is indented."""
    for head in _DECLARED.finditer(source):
        end = re.compile(r"^(?:\S.*)?;$", re.MULTILINE).search(source, source.index("\n", head.start()) + 1)
        line = source[head.start() : source.index("\n", head.start())]
        yield Statement(head[1], head[2] or line, line if line.endswith(";") else source[head.start() : end.end()])


def variables(source: str) -> list[str]:
    """Names at the top of a module that may be given another value."""
    return [one.name for one in declarations(source) if one.keyword != "const"]


def holders(source: str) -> list[str]:
    """Constants of a module whose content changes: objects that are made with ``new``, elements, tables written to."""

    def changes(one: Statement) -> bool:
        made = {kind for kind in _MADE.findall(one.text) if kind not in CONSTANT}
        element = re.search(r"= (?:element|byId|document\.\w+)\(", one.text)
        name = rf"(?<![\w.]){one.name}"
        assigned = rf"{name}(?:\.\w+|\[[^\]]+\])* (?:[-+*/|&?]{{0,2}})= "
        filled = rf"Object\.assign\({one.name},|{name}\.(?:push|splice|set|add|delete|clear)\("
        written = rf"^ .*(?:{assigned}|{filled})"
        return bool(made or element or re.search(written, source, re.MULTILINE))

    return [one.name for one in declarations(source) if one.keyword == "const" and changes(one)]


def modules() -> dict[str, str]:
    """The modules of the page by their names, with their text."""
    (folder,) = ballscrew.__path__
    page = Path(folder) / "faces" / "page"
    return {path.relative_to(page).as_posix(): path.read_text(encoding="utf-8") for path in sorted(page.rglob("*.js"))}


def test_modules_of_the_page_have_no_variables():
    found = modules()
    assert {"main.js", "store.js", "cards/duty.js"} <= found.keys()
    assert {name: variables(source) for name, source in found.items() if variables(source)} == {}


def test_what_changes_on_the_page_has_its_reason():
    found = [f"{name} {holder}" for name, source in modules().items() for holder in holders(source)]
    assert sorted(found) == sorted(HOLDERS)


def test_no_module_keeps_listeners_of_its_own():
    """Who wants to be told listens to events, as of the platform."""
    assert [name for name, source in modules().items() if re.search(r"Set<\(|[lL]isteners = ", source)] == []
