"""Languages of the page: one file of texts each, put into the page before it is sent, so that nothing moves later.

``page/texts/en.json`` has every text of the page by its key. A translation is one more file with the same keys: its
name is the tag of the language (RFC 5646), ``language`` in it is the name that the menu shows.
"""

from __future__ import annotations

import functools
import html
import json
import re
from collections.abc import Mapping
from importlib import resources

#: The language of the texts that the server makes, and of the page where none is known that the visitor reads.
DEFAULT = "en"
#: The cookie that keeps the choice of a visitor in their browser.
COOKIE = "ballscrew-language"

_TAG = re.compile(r"<[a-z][^<>]*\sdata-text[^<>]*>")
_KEY = re.compile(r'\sdata-text(?:-([a-z-]+))?="([^"]+)"')
_HTML = re.compile(r'<html lang="[^"]*">')
_TABLE = '<template id="texts">'
_MENU = re.compile(r'(<select id="language"[^>]*>)')


@functools.cache
def texts() -> Mapping[str, Mapping[str, str]]:
    """The texts of all languages by tag, the default one first."""
    folder = resources.files("ballscrew.faces.web").joinpath("page", "texts")
    found = {
        file.name.removesuffix(".json"): json.loads(file.read_text(encoding="utf-8"))
        for file in folder.iterdir()
        if file.name.endswith(".json")
    }
    return {name: found[name] for name in sorted(found, key=lambda name: (name != DEFAULT, name))}


def language_of(chosen: str | None, accepted: str) -> str:
    """The language for a visitor: their choice, else the first of ``Accept-Language`` that there is (RFC 9110)."""
    if chosen is not None and chosen in texts():
        return chosen
    return next((name for name in _by_preference(accepted) if name in texts()), DEFAULT)


def _by_preference(accepted: str) -> list[str]:
    """The primary tags of a header ``Accept-Language``, the most wanted first."""
    wanted: list[tuple[float, str]] = []
    for one in accepted.split(","):
        tag, _, weight = one.partition(";")
        found = re.fullmatch(r"\s*q=([01](?:\.\d{0,3})?)\s*", weight) if weight else None
        quality = float(found[1]) if found else 1.0
        if quality > 0.0:
            wanted.append((quality, tag.strip().lower().partition("-")[0]))
    return [tag for _, tag in sorted(wanted, key=lambda pair: -pair[0])]


def filled(page: str, language: str) -> str:
    """The page in a language.

    ``data-text="key"`` puts a text into an element, ``data-text-title="key"`` into its attribute ``title``. The
    whole table follows as JSON in a ``<template>``, where the scripts find it without a request.
    """
    table = {**texts()[DEFAULT], **texts()[language]}

    def with_texts(tag: re.Match[str]) -> str:
        attributes = [(name, html.escape(table[key])) for name, key in _KEY.findall(tag[0])]
        start = _KEY.sub("", tag[0]).removesuffix(">")
        start += "".join(f' {name}="{text}"' for name, text in attributes if name)
        return f"{start}>" + "".join(text for name, text in attributes if not name)

    names = {name: one["language"] for name, one in texts().items()}
    options = "".join(
        f'<option value="{name}" lang="{name}"{" selected" if name == language else ""}>{html.escape(text)}</option>'
        for name, text in names.items()
    )
    found = _HTML.sub(f'<html lang="{language}">', page)
    found = _TAG.sub(with_texts, found)
    found = _MENU.sub(lambda menu: menu[0] + options, found)
    document = html.escape(json.dumps(table, ensure_ascii=False), quote=False)
    return found.replace(_TABLE, _TABLE + document)
