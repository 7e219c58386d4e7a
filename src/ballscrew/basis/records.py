"""Records of a result: verdicts, checks and warnings of every document.

Terminal, page, report and API read the fields; the text is for people to read and for no program to parse. It is that
of a :class:`Message`, a template with its values.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal

from ballscrew.basis.quantities import Quantity

Severity = Literal["info", "warning", "error"]
_PLACEHOLDER = re.compile(r"\{([A-Za-z0-9_]+(?:\.[A-Za-z0-9_]+)*)\}")


@dataclasses.dataclass(frozen=True, slots=True)
class Measured:
    """A number in a message: in SI with its quantity, or a plain one, to so many digits."""

    value: float
    quantity: Quantity | None = None
    digits: int = 4
    #: -1 or 1 for the lower or the upper end of a band, which is rounded down or up; 0 for others.
    toward: int = 0
    #: The number as it is written on the terminal, from a room that knows display units; empty in rooms that do not.
    written: str = ""

    @property
    def is_plain(self) -> bool:
        """It has no unit."""
        return self.quantity is None or self.quantity.unit == "1"

    def plain(self) -> str:
        """The digits of a plain number, without the exponent of programs where a person writes none."""
        return f"{float(f'{self.value:.{self.digits}g}'):.10g}"

    def document(self) -> dict[str, Any]:
        """The number as it stands in JSON."""
        unit, shown_in = ("1", "1") if self.quantity is None else (self.quantity.unit, self.quantity.shown_in)
        return {"value": self.value, "unit": unit, "shown_in": shown_in, "digits": self.digits, "toward": self.toward}


@dataclasses.dataclass(frozen=True, slots=True)
class Setting:
    """A field that is to be set, by its path: ``preload = `` in a file, its label in a form."""

    path: str

    def __str__(self) -> str:
        return f"{self.path.rpartition('.')[2]} = "


@dataclasses.dataclass(frozen=True, slots=True)
class UnitName:
    """A unit to write, as files have it: ``um``; pages show its symbol."""

    name: str

    def __str__(self) -> str:
        return self.name


@dataclasses.dataclass(frozen=True, slots=True)
class Named:
    """The name of a field, a law or a result, by its path: ``preload`` in English, its label on the page."""

    path: str
    #: The name in English texts, where it is another one.
    written: str = ""

    def __str__(self) -> str:
        return self.written or self.path.rpartition(".")[2].replace("_", " ")


@dataclasses.dataclass(frozen=True, slots=True)
class Message:
    """A sentence for people, or a part of one: an English template, and what stands in it by name.

    ``{torque}`` in the template is replaced by the value of that
    name: a number, a text that people gave, a field to set, a name, a unit, another message, or a list of messages with
    commas between them. ``{nut.preload}`` without a value stands for setting that field.
    """

    template: str
    values: Mapping[str, Value] = dataclasses.field(default_factory=dict)

    def __hash__(self) -> int:
        return hash(self.template)

    def of(self, **values: Value) -> Message:
        """The same template with these values."""
        return Message(self.template, values)

    def filled(self, shown: Callable[[Measured], str]) -> str:
        """The English text, with its numbers as ``shown`` writes them."""

        def one(value: Value) -> str:
            if isinstance(value, Measured):
                return shown(value)
            if isinstance(value, Message):
                return value.filled(shown)
            return (
                str(value)
                if isinstance(value, str | Setting | Named | UnitName)
                else ", ".join(each.filled(shown) for each in value)
            )

        def part(found: re.Match[str]) -> str:
            name = found[1]
            return one(self.values[name]) if name in self.values else str(Setting(name)) if "." in name else found[0]

        return _PLACEHOLDER.sub(part, self.template)

    def changed(self, change: Callable[[Value], Value]) -> Message:
        """The same template with each value changed, those of the messages in it as well."""

        def one(value: Value) -> Value:
            if isinstance(value, Message):
                return value.changed(change)
            if isinstance(value, str | Measured | Setting | Named | UnitName):
                return change(value)
            return [each.changed(change) for each in value]

        return Message(self.template, {name: one(value) for name, value in self.values.items()})

    def document(self) -> dict[str, Any]:
        """The template and its values as they stand in JSON."""

        def one(value: Value) -> Any:
            if isinstance(value, str):
                return value
            if isinstance(value, Setting):
                return {"field": value.path}
            if isinstance(value, Named):
                return {"name": value.path}
            if isinstance(value, UnitName):
                return {"unit_name": value.name}
            return value.document() if isinstance(value, Measured | Message) else [each.document() for each in value]

        return {"template": self.template, "values": {name: one(value) for name, value in self.values.items()}}


#: What stands in a message.
Value = Measured | str | Setting | Named | UnitName | Message | Sequence[Message]


def listed(messages: Iterable[Message]) -> Message:
    """Messages with commas between them, as one."""
    return Message("{parts}", {"parts": list(messages)})


def message_of(text: str | Message) -> Message:
    """A message as it is; a literal text as a template."""
    return text if isinstance(text, Message) else Message(text)


def in_file(path: str) -> Named:
    """A field by its place in a case file, ``[axis] mass``; its label on the page."""
    section, _, key = path.partition(".")
    return Named(path, f"[{section}] {key}")


@dataclasses.dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """One verdict, check or warning.

    ``holds`` is the truth of the statement, None where it cannot be judged; whether it is good news ``severity`` says.
    ``value`` and ``limit`` are SI numbers in ``unit``, None where there is none. ``id`` and ``subject`` together are
    unique in a document.
    """

    #: Stable name, lower case with dots: ``validity.contact_pressure``, ``verdict.back_driving``, ``check.buckling``.
    id: str
    #: The quantity or part it concerns, by its name in the document: ``maximum_pressure``, ``nut.preload``, ``model``.
    subject: str
    #: One sentence for people, with its units.
    text: str
    #: The text as a template with its values: the rooms that face people make the text from it in display units.
    message: Message
    severity: Severity = "info"
    holds: bool | None = None
    value: float | None = None
    limit: float | None = None
    unit: str = "1"

    @property
    def name(self) -> str:
        """The last part of the id: ``contact_pressure``."""
        return self.id.rpartition(".")[2]

    def document(self) -> dict[str, Any]:
        """The record as it stands in JSON."""
        names = ("id", "subject", "value", "unit", "limit", "holds", "severity", "text")
        return {name: getattr(self, name) for name in names}


def documents(records: Iterable[Record]) -> list[dict[str, Any]]:
    """Records as they stand in JSON, in their order."""
    return [record.document() for record in records]
