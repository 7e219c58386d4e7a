"""Options that are declared once: flags, bodies of the API and fields of the page follow from their annotations.

The options of a question are a frozen dataclass. Each field has a type, a default, and an :class:`Option`:

    torque_constant: Annotated[float | None, Option('Of a motor current: "0.5 N m/A".', unit="N m/A", above=0)] = None

An instance has what is computed with, numbers in SI. What people write follows from the type, see :data:`Kind`.
Nothing here is slow to import: the command line needs it for every help.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, TypeAlias, get_args, get_origin, get_type_hints

#: The ends of a range, SI.
Range = tuple[float, float]
#: What an option is as it is written, by the type of its field:
#:
#: - ``switch`` (``bool``): true or false; a flag without a value
#: - ``whole`` (``int``), ``number`` (``float``): a number
#: - ``quantity`` (``float`` with a unit): text, ``"35 N/V"``
#: - ``quantities`` (``Sequence[float]`` with a unit): several such texts
#: - ``choice`` (``Literal``): one of its texts
#: - ``text`` (``str``)
#: - ``names`` (``Sequence[str]``): texts, also several in one with commas
#: - ``texts`` (``Mapping[str, str]``): a text for each name; a flag ``name=text``, repeated
#: - ``ranges`` (``Mapping[str, Range]``): ``low:high unit`` for each name
Kind: TypeAlias = Literal[
    "switch", "whole", "number", "quantity", "quantities", "choice", "text", "names", "texts", "ranges"
]
_SIMPLE: Mapping[Any, Kind] = {bool: "switch", int: "whole", float: "number", str: "text"}
_WRITTEN: Mapping[Kind, Any] = {
    "switch": bool, "whole": int, "number": float, "quantity": str, "quantities": list[str], "choice": str, "text": str,
    "names": list[str],
    "texts": dict[str, str], "ranges": dict[str, str],
}  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Option:
    """Everything that is said of an option beside its type and its default."""

    #: The help of the flag, and the description in the API and on the page.
    meaning: str
    _: dataclasses.KW_ONLY
    #: What stands for the value in the help of a command.
    metavar: str = ""
    #: The SI unit of a number that is written with a unit, and the unit that messages name.
    unit: str = ""
    shown_in: str = ""
    above: float | None = None
    at_least: float | None = None
    #: True for a difference of temperatures, which is in K: "2 degC" would be 275 K.
    is_difference: bool = False
    #: The remedy for a number beyond its bounds.
    hint: str = ""
    #: The name of the flag, where it is not that of the field; a short one.
    flag: str = ""
    short: str = ""
    #: The field of a case that a text gives, section.field.
    sets: str = ""
    #: True for a sequence of ``name=text`` that the question itself reads.
    is_table: bool = False
    #: Of a choice, for the message on one that is unknown; an example of a table.
    noun: str = ""
    example: str = ""


@dataclasses.dataclass(frozen=True)
class OptionField:
    """An option of a question: a field of its dataclass with what is said of it."""

    name: str
    type: Any
    default: Any
    option: Option

    @property
    def flag(self) -> str:
        """The flag of the command line."""
        return f"--{self.option.flag or self.name.replace('_', '-')}"

    @property
    def kind(self) -> Kind:
        """Kind of value as it is written."""
        bare = get_origin(self.type) or self.type
        if bare is Literal:
            return "choice"
        if bare is Sequence and self.option.unit:
            return "quantities"
        if bare is Sequence:
            return "texts" if self.option.is_table else "names"
        if bare is Mapping:
            return "texts" if get_args(self.type)[1] is str else "ranges"
        return "quantity" if self.option.unit else _SIMPLE[bare]

    @property
    def choices(self) -> tuple[str, ...]:
        """The texts of a choice."""
        return get_args(self.type) if self.kind == "choice" else ()

    @property
    def written_type(self) -> Any:
        """The type of what is written, as JSON."""
        return _WRITTEN[self.kind] | None if self.written_default is None else _WRITTEN[self.kind]

    @property
    def written_default(self) -> Any:
        """Value that stands for the default as it is written: an empty list or table, null, or the number itself."""
        if self.kind in ("names", "quantities"):
            return []
        if self.kind in ("texts", "ranges"):
            return {}
        return self.default if self.kind in ("switch", "whole", "number", "text") else None

    def is_given(self, written: Mapping[str, Any]) -> bool:
        """Test whether another value than the default was written."""
        return written[self.name] not in (None, [], self.written_default)


@functools.cache
def options_of(cls: type) -> Mapping[str, OptionField]:
    """The options of a dataclass by name, in its order."""
    hints = get_type_hints(cls, include_extras=True)
    options: dict[str, OptionField] = {}
    for field in dataclasses.fields(cls):
        annotation, *said = get_args(hints[field.name])
        option = next(one for one in said if isinstance(one, Option))
        default = field.default if field.default_factory is dataclasses.MISSING else field.default_factory()
        options[field.name] = OptionField(field.name, _without_none(annotation), default, option)
    return options


def _without_none(annotation: Any) -> Any:
    several = [one for one in get_args(annotation) if one is not type(None)]
    return several[0] if type(None) in get_args(annotation) and len(several) == 1 else annotation


def body_fields(cls: type) -> dict[str, Any]:
    """The fields of a body of the API, as ``pydantic.create_model`` takes them."""
    from pydantic import Field  # the command line does not need it

    values: dict[str, Any] = {}
    for name, one in options_of(cls).items():
        unit: Any = {"x-si-unit": one.option.unit} if one.option.unit else None
        if isinstance(one.written_default, list | dict):
            field = Field(
                default_factory=type(one.written_default), description=one.option.meaning, json_schema_extra=unit
            )
        else:
            field = Field(
                default=one.written_default, strict=True, description=one.option.meaning, json_schema_extra=unit
            )
        values[name] = (one.written_type, field)
    return values


def vocabulary_of(cls: type) -> list[dict[str, Any]]:
    """The options as the page gets them, to draw a field for each."""
    return [
        {
            "name": name,
            "flag": one.flag,
            "kind": one.kind,
            "meaning": one.option.meaning,
            "unit": one.option.unit or None,
            "default": one.written_default,
            "choices": [each for each in one.choices if each != one.default],
        }
        for name, one in options_of(cls).items()
    ]


def headings(meaning: str) -> Option:
    """Columns of a log by their headings, with an example of them in its meaning."""
    example = 'torque="M_ist [N m]"'
    return Option(meaning, metavar="NAME=HEADING", flag="column", noun="heading", example=example)


Columns = Annotated[Mapping[str, str], headings('Heading of a column: torque="M_ist [N m]".')]
TorqueKind = Annotated[
    Literal["friction", "drive", "unknown"],
    Option(
        "Kind of the torque: friction or drive; if left out, found by comparison with the model.",
        metavar="KIND",
        noun="kind of torque",
    ),
]
TorqueConstant = Annotated[
    float | None,
    Option('Torque for each ampere of a motor current: "0.5 N m/A".', metavar="VALUE", unit="N m/A", above=0),
]
Inertia = Annotated[
    float | None,
    Option(
        'Inertia that the torque accelerates, at the screw: "2e-3 kg m^2".', metavar="VALUE", unit="kg m^2", above=0
    ),
]
KeepGoing = Annotated[bool, Option("Leave faulty rows out, and say how many.")]


Level = Annotated[
    float | None, Option("With --band: share of the samples in the band; 0.95 if left out.", metavar="SHARE")
]
OnlyGiven = Annotated[bool, Option("With --band: only the uncertain inputs that the case file gives.")]


def number_of_samples(meaning: str) -> Option:
    """Option for the number of samples of a band; a meaning says of what, and how many there are if it is left out."""
    return Option(f"With --band: {meaning}.", metavar="N")
