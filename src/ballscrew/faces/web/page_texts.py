"""Texts of the page, put into it before it is sent, so that nothing moves later."""

from __future__ import annotations

import functools
import html
import json
import re
from collections.abc import Mapping
from importlib import resources

_TAG = re.compile(r"<[a-z][^<>]*\sdata-text[^<>]*>")
_KEY = re.compile(r'\sdata-text(?:-([a-z-]+))?="([^"]+)"')
_TABLE = '<template id="texts">'


@functools.cache
def texts() -> Mapping[str, str]:
    """The texts by key."""
    file = resources.files("ballscrew.faces.web").joinpath("page", "texts.json")
    return json.loads(file.read_text(encoding="utf-8"))


def filled(page: str) -> str:
    """The page with its texts.

    ``data-text="key"`` puts a text into an element, ``data-text-title="key"`` into its attribute ``title``. The
    whole table follows as JSON in a ``<template>``, where the scripts find it without a request.
    """

    def with_texts(tag: re.Match[str]) -> str:
        attributes = [(name, html.escape(texts()[key])) for name, key in _KEY.findall(tag[0])]
        start = _KEY.sub("", tag[0]).removesuffix(">")
        start += "".join(f' {name}="{text}"' for name, text in attributes if name)
        return f"{start}>" + "".join(text for name, text in attributes if not name)

    document = html.escape(json.dumps(texts(), ensure_ascii=False), quote=False)
    return _TAG.sub(with_texts, page).replace(_TABLE, _TABLE + document)
