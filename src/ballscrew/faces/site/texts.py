"""The words of the static page in other languages than English.

Words of fields, parts of the torque and reasons are those of the page of the server; only what the static page says
itself stands in ``page/texts/de.json``, by its English words or by the name of what it is of.
"""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Mapping
from importlib import resources
from typing import Any

from ballscrew.faces.site.judging import templates

#: A place in a text that a value takes.
_PLACE = re.compile(r"\\{\w+\\}")
_NUMBER = re.compile(r"(?<=\d)\.(?=\d)")


def texts(contents: Mapping[str, Any]) -> dict[str, dict[str, str]]:
    """The words by language, and there by name or by their English."""
    return {"de": _german(contents)}


def _german(contents: Mapping[str, Any]) -> dict[str, str]:
    served, own = _table("web", "page/texts/de.json"), _table("site", "page/texts/de.json")
    fields = [f"field.{field['path']}.{part}" for field in contents["fields"].values() for part in ("label", "help")]
    for name in contents["judging"]["given"]:
        path = name if name.startswith("limits.") else f"installation.{name}"
        fields.append(f"field.{path}.label")
    parts = [f"mechanism.{name}" for name in contents["mechanisms"]]
    found = {name: served[name] for name in (*fields, *parts) if name in served}
    reasons = {f"reason.{name}": _translated(words, served) for name, words in contents["reasons"].items()}
    said = {one: served[f"message.{one}"] for one in templates(contents) if f"message.{one}" in served}
    return {**found, **said, **{name: words for name, words in reasons.items() if words is not None}, **own}


@functools.cache
def _table(room: str, name: str) -> Mapping[str, str]:
    text = resources.files(f"ballscrew.faces.{room}").joinpath(name).read_text(encoding="utf-8")
    return json.loads(text)


def _translated(words: str, served: Mapping[str, str]) -> str | None:
    """A message in German, also one that is filled in already; its numbers with a comma."""
    if f"message.{words}" in served:
        return served[f"message.{words}"]
    for key, text in served.items():
        template = key.removeprefix("message.")
        names = re.findall(r"\{(\w+)\}", template)
        if template == key or not names or template.startswith("{"):
            continue
        filled = re.fullmatch(_PLACE.sub("(.+)", re.escape(template)), words)
        if filled is not None:
            values = {name: _NUMBER.sub(",", value) for name, value in zip(names, filled.groups(), strict=True)}
            return text.format_map(values)
    return None
