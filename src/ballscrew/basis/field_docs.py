"""Docstrings of classes with their fields: symbol, meaning, unit and bounds from the annotation, or the comment ``#:``.

The text is made when somebody reads it, so that it costs an import nothing and stands nowhere a second time.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import linecache
import re
import sys
import textwrap
from collections.abc import Iterator, Mapping
from typing import Any, cast, get_type_hints

from ballscrew.basis.quantities import Info, quantities_of, unit_of

#: The comment above a field, and the name of the field.
_COMMENTED = re.compile(r"((?:^    #:.*\n)+)    (\w+) *:", re.MULTILINE)
#: The type of an annotation with more in it.
_SHORT = re.compile(r"Annotated\[((?:[^,\[\]]|\[[^\]]*\])*),")
#: A symbol that is a word, and says no more than the name of its field.
_WORD = re.compile(r"[a-z-]{3,}")
#: Characters of a line at most.
_WIDTH = 100


class _FieldDocs:
    """A docstring that ends with the fields of its class; read through the class, as ``help`` does."""

    def __init__(self, own: str) -> None:
        self._own = own

    def __get__(self, instance: object, owner: type) -> str:
        return _with_fields(owner, self._own)


def show_fields(cls: type) -> None:
    """Let the docstring of a dataclass say what its fields and its annotated properties are.

    Its constructor is shown without what the fields say, ``lead: Length``, and with functions by their names.
    """
    own = vars(cls).get("__doc__")
    if not dataclasses.is_dataclass(cls) or not isinstance(own, str):
        return
    cast("Any", cls).__doc__ = _FieldDocs(own)
    made = vars(cls).get("__init__")
    shown: dict[str, Any] = {} if made is None else inspect.unwrap(made).__annotations__
    for name, annotation in shown.items():
        if isinstance(annotation, str) and (short := _SHORT.match(annotation)):
            shown[name] = short[1]
    if any(inspect.isfunction(field.default) for field in dataclasses.fields(cls)):
        signature = inspect.signature(cls)
        parameters = [one.replace(default=_by_name(one.default)) for one in signature.parameters.values()]
        cast("Any", cls).__signature__ = signature.replace(parameters=parameters)


class _Named:
    """A function as the default of a parameter that is only shown: by its name, without its address."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __repr__(self) -> str:
        return self._name


def _by_name(default: Any) -> Any:
    return _Named(default.__name__) if inspect.isfunction(default) else default


@functools.cache
def _with_fields(cls: type, own: str) -> str:
    fields, described = _fields(cls), _described(cls)
    parts = {
        "Fields:": [_item(name, text) for name, text in described.items() if name in fields],
        "Computed:": [_item(name, text) for name, text in described.items() if name not in fields],
    }
    lists = ["\n".join([title, "", *items]) for title, items in parts.items() if items]
    return "\n\n".join([inspect.cleandoc(own), *lists])


def _fields(cls: Any) -> list[str]:
    return [field.name for field in dataclasses.fields(cls) if field.init]


def _described(cls: type) -> dict[str, str]:
    """Descriptions of fields and annotated properties, by name."""
    hints, comments = get_type_hints(cls, include_extras=True), comments_of(cls)
    quantities = quantities_of(cls)
    values: dict[str, str] = {}
    for name in dict.fromkeys([*_fields(cls), *quantities]):
        quantity, unit = quantities.get(name), unit_of(hints.get(name))
        if quantity is not None:
            values[name] = words_of(quantity.info, quantity.unit)
        elif name in comments:
            values[name] = comments[name]
        elif unit is not None:
            values[name] = unit
    return values


def words_of(info: Info, unit: str = "1") -> str:
    """Meaning, symbol, unit and bounds."""
    limits = ", ".join([*([] if unit == "1" else [unit]), *_bounds(info)])
    symbol = "" if _WORD.fullmatch(info.symbol) else f", :math:`{info.symbol}`"
    return f"{info.meaning}{symbol}" + (f"; {limits}" if limits else "")


def _bounds(info: Info) -> Iterator[str]:
    if info.whole:
        yield "whole"
    words = {"above": info.above, "at least": info.at_least, "below": info.below, "at most": info.at_most}
    yield from (f"{word} {bound:g}" for word, bound in words.items() if bound is not None)
    if info.usual is not None:
        yield f"usual {info.usual[0]:g} to {info.usual[1]:g}"


def comments_of(cls: type) -> Mapping[str, str]:
    """The comments ``#:`` above fields, by field, of a dataclass or named tuple and of those that it is made of."""
    comments: dict[str, str] = {}
    for owner in reversed(cls.__mro__):
        if not vars(owner).keys() & {"__dataclass_fields__", "_fields"}:
            continue
        for comment, name in _COMMENTED.findall(_source(owner)):
            lines = (line.strip().removeprefix("#:").strip() for line in comment.splitlines())
            comments[name] = " ".join(lines).removesuffix(".")
    return comments


def _source(cls: type) -> str:
    """The text of a class at the top of its module; ``inspect`` parses the whole module for it.

    Empty where the sources are not installed.
    """
    module = sys.modules[cls.__module__]
    text = "".join(linecache.getlines(getattr(module, "__file__", None) or "", vars(module)))
    match = re.search(rf"^class {cls.__name__}\b.*\n(?:[ )].*\n|\n)*", text, re.MULTILINE)
    return "" if match is None else match[0]


def _item(name: str, text: str) -> str:
    return textwrap.fill(
        f"* ``{name}``: {text}.", _WIDTH, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )
