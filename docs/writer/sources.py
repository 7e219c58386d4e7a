"""The bibliography as Markdown: how a source is cited, and the list of all sources."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from command import DOCS
from pybtex.backends.markdown import Backend
from pybtex.database import parse_file
from pybtex.richtext import Text
from pybtex.style.formatting.plain import Style
from pybtex.style.template import field, sentence

BIBLIOGRAPHY = Path("src/ballscrew/data/references.bib")
_ROLE = re.compile(r"\{cite:[tp]\}`(?P<key>[\w-]+)`")


class _Titles(Style):
    """Entries whose titles stay as they are written: ASTM is not Astm."""

    def format_title(self, _entry: Any, which_field: str, as_sentence: bool = True) -> Any:
        return sentence[field(which_field)] if as_sentence else field(which_field)


class _Markdown(Backend):
    """Markdown in which no full stop is escaped."""

    def format_str(self, str_: str) -> str:
        return re.sub(r"([\\*_\[\]])", r"\\\1", str_)


@functools.cache
def _entries() -> Mapping[str, Any]:
    return parse_file(DOCS.parent / BIBLIOGRAPHY).entries


def known() -> tuple[str, ...]:
    """The keys of all sources."""
    return tuple(_entries())


def named(key: str) -> str:
    """A source as a text names it: ``Hamrock and Dowson (1977)``."""
    entry = _entries()[key]
    people = [" ".join((*person.prelast_names, *person.last_names)) for person in entry.persons.get("author", ())]
    people = people or [entry.fields.get("organization", entry.fields.get("title", key))]
    names = [str(Text.from_latex(name)) for name in people]
    who = names[0] if len(names) == 1 else " and ".join(names) if len(names) == 2 else f"{names[0]} et al."
    return f"{who} ({entry.fields['year']})" if "year" in entry.fields else who


def link(key: str, up: str) -> str:
    """A source as a link to the bibliography; ``up``: the way to the folder of the pages."""
    return f"[{named(key)}]({up}bibliography.md#{key.lower()})"


def cited(text: str, up: str) -> str:
    """The roles that cite sources as links."""
    return _ROLE.sub(lambda role: link(role["key"], up), text)


def listed() -> str:
    """All sources, each with a heading that links lead to."""
    style, backend = _Titles(), _Markdown("utf-8")
    found = []
    for key, entry in sorted(_entries().items(), key=lambda item: item[0].lower()):
        written = " ".join(style.format_entry(key, entry).text.render(backend).split())
        found.append(f"### {key}\n\n{written}\n")
    return "\n".join(found)
