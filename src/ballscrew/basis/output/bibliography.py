"""Sources as people read them, made from the BibTeX of the package."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from ballscrew.basis.references import bibliography

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
