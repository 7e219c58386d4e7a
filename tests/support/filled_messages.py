"""Messages of the API filled in Python, as the page fills them in JavaScript."""

from collections.abc import Mapping
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.basis.records import Measured, Message, Named, Setting, UnitName, Value


def as_printed(document: Mapping[str, Any], texts: Mapping[str, str] | None = None) -> str:
    """The text of a message in display units; in another language by its ``texts``, which have templates as keys."""
    return units.filled(read(document, texts or {}))


def read(document: Mapping[str, Any], texts: Mapping[str, str]) -> Message:
    """The message that a document is of."""
    template = texts.get(document["template"], document["template"])
    return Message(template, {name: _value(one, texts) for name, one in document["values"].items()})


def _value(one: Any, texts: Mapping[str, str]) -> Value:
    if isinstance(one, str):
        return one
    if isinstance(one, list):
        return [read(each, texts) for each in one]
    if "template" in one:
        return read(one, texts)
    if "field" in one:
        return Setting(one["field"])
    if "name" in one:
        return Named(one["name"])
    if "unit_name" in one:
        return UnitName(one["unit_name"])
    quantity = Quantity("", one["unit"], Info("", "", one["shown_in"]))
    return Measured(one["value"], quantity, one["digits"], one["toward"])
