"""References: the bibliography, and the addresses of the equations of the paper.

A docstring names its sources by key (``HamrockDowson1977``) and its equations by address
(``Olaru2005 §5 (23)``: section and number, because the paper uses (22) to (26) twice).

People read sources as they are made from the BibTeX of the package.
"""

from __future__ import annotations

import ast
import dataclasses
import functools
import inspect
import re
import sys
import textwrap
import tomllib
import unicodedata
from collections.abc import Iterable, Mapping
from importlib import resources
from typing import Any, NamedTuple

ADDRESS = re.compile(r"Olaru2005\s+§(?P<section>[\d.]+)\s+\((?P<number>\d+)\)")
_ENTRY = re.compile(r"@\w+\{(?P<key>[^,\s]+),.*?\n\}", re.DOTALL)


@dataclasses.dataclass(frozen=True, slots=True)
class PaperEquation:
    """One numbered equation of the paper, and the verdict on it."""

    section: str
    number: int
    what: str
    verdict: str

    @property
    def address(self) -> str:
        """The address in the paper, ``Olaru2005 §5 (23)``."""
        return f"Olaru2005 §{self.section} ({self.number})"


def _data(name: str) -> str:
    return resources.files("ballscrew").joinpath("data", name).read_text(encoding="utf-8")


@functools.cache
def paper_equations() -> tuple[PaperEquation, ...]:
    """The 41 numbered equations of the paper, in their order."""
    return tuple(PaperEquation(**row) for row in tomllib.loads(_data("olaru2005.toml"))["equations"])


@functools.cache
def bibliography() -> Mapping[str, str]:
    """BibTeX entries by key."""
    return {match["key"]: match[0] for match in _ENTRY.finditer(_data("references.bib"))}


def addresses_in(text: str | None) -> list[str]:
    """Addresses of equations of the paper that a text names, in one spelling."""
    return [f"Olaru2005 §{m['section']} ({m['number']})" for m in ADDRESS.finditer(text or "")]


@functools.cache
def keys_in(text: str | None) -> tuple[str, ...]:
    """Keys of the bibliography that a text names, in the order of the bibliography."""
    return tuple(key for key in bibliography() if re.search(rf"\b{re.escape(key)}\b", text or ""))


def documentation(documented: Any) -> str:
    """The docstring of a function or a class; of its source where the interpreter has left docstrings out (``-OO``)."""
    if sys.flags.optimize < 2:  # beyond that a dataclass makes itself a docstring of its signature
        return documented.__doc__ or ""
    try:
        (definition,) = ast.parse(textwrap.dedent(inspect.getsource(documented))).body
    except (OSError, TypeError, ValueError, SyntaxError):  # made without a source, as in a session
        return ""
    known = isinstance(definition, ast.FunctionDef | ast.ClassDef)
    return (ast.get_docstring(definition) or "") if known else ""


def citations_of(assembly: Any) -> list[str]:
    """Keys of the sources that the laws of a model name in their docstrings."""
    texts: list[str] = []
    for field in dataclasses.fields(assembly):
        law = getattr(assembly, field.name)
        documented = law if callable(law) and hasattr(law, "__name__") else type(law)
        if callable(law):
            texts.append(documentation(documented))
    result = {key for text in texts for key in keys_in(text)} | {"Olaru2005"}
    return [key for key in bibliography() if key in result]


_FIELD = re.compile(r"^\s*(\w+)\s*=\s*\{(.*)\},?\s*$", re.MULTILINE)
#: Accents of LaTeX that stand over the next letter, as Unicode combines them.
_ACCENTS = {'"': "\u0308", "u": "\u0306", "'": "\u0301", "`": "\u0300", "^": "\u0302", "v": "\u030c", "c": "\u0327"}
_ACCENT = re.compile(r"\{?\\(?P<accent>[\"'`^]|[uvc](?=\{))\{?(?P<letter>[A-Za-z])\}?\}?")


class Source(NamedTuple):
    """An entry of the bibliography in words, and where it is to be found, if that is known."""

    key: str
    words: str
    link: str


def sources(keys: Iterable[str]) -> list[Source]:
    """The entries with these keys, each once, in the order of the bibliography."""
    wanted = set(keys)
    return [_source(key, entry) for key, entry in bibliography().items() if key in wanted]


def of_catalogue(source: str) -> list[str]:
    """Keys of the catalogue that a row is from: of those whose entry has maker and number as the source has them."""
    maker, _, number = source.partition(" ")
    return [
        key
        for key, entry in bibliography().items()
        if (fields := _fields(entry)).get("note") == f"catalogue {number}"
        and maker in fields.get("organization", "").split()
    ]


def _source(key: str, entry: str) -> Source:
    fields = _fields(entry)
    doi = fields.get("doi", "")
    return Source(key, _in_words(fields), f"https://doi.org/{doi}" if doi else "")


def _fields(entry: str) -> dict[str, str]:
    return {name.lower(): plain(value) for name, value in _FIELD.findall(entry)}


def _in_words(fields: Mapping[str, str]) -> str:
    """Authors (year): title. Where it came out."""
    authors = ", ".join(map(_by_name, re.split(r"\s+and\s+", fields.get("author", fields.get("organization", "")))))
    head = f"{authors} ({fields['year']})" if "year" in fields else authors
    volume = fields.get("volume", "") + (f"({fields['number']})" if "number" in fields else "")
    places = [
        fields.get("booktitle", ""),
        " ".join(filter(None, [fields.get("journal", ""), volume])),
        f"pp. {fields['pages']}" if "pages" in fields else "",
        f"edition {fields['edition']}" if "edition" in fields else "",
        *(fields.get(name, "") for name in ("publisher", "school", "institution", "howpublished", "address", "note")),
    ]
    where = ", ".join(filter(None, places))
    return ". ".join(filter(None, [f"{head}: {fields.get('title', '')}", where])) + "."


def _by_name(author: str) -> str:
    """``Olaru, Dumitru`` as ``D. Olaru``."""
    family, comma, given = author.partition(",")
    initials = " ".join(f"{name[0]}." for name in given.split() if name[0].isalpha())
    return f"{initials} {family}" if comma else author


def plain(text: str) -> str:
    """BibTeX without braces, with its accents and dashes as letters."""

    def composed(match: re.Match[str]) -> str:
        return unicodedata.normalize("NFC", match["letter"] + _ACCENTS[match["accent"]])

    text = _ACCENT.sub(composed, text).replace("--", "–").replace(r"\&", "&").replace("~", " ")
    return re.sub(r"[{}]", "", text)
