"""Answers that are declared once: their document, its units and its schema follow from their annotations.

An answer is a class: a dataclass, a named tuple, or a :class:`Declared`, whose parts are properties. Each part is a
number with a unit (``Annotated[Torque, Info(...)]``), a truth value, a text, another answer, or a sequence or a mapping
of these. A mapping that is annotated as a whole (``Annotated[Mapping[str, float], Unit("N")]``) has one unit in the
document of units, one of annotated numbers (``Mapping[str, Force]``) a unit for each key.

A part that may be None is null; one with :data:`LEFT_OUT` among its annotations is left out. Numbers that are not
finite are null in JSON; those of a part with :data:`FINITE` always are.
"""

from __future__ import annotations

import dataclasses
import functools
import types
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any, NamedTuple, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from ballscrew.basis.arrays import lazy
from ballscrew.basis.field_docs import comments_of
from ballscrew.basis.output.sheet import Cells
from ballscrew.basis.quantities import Info, Quantity, Unit, info_of, unit_of
from ballscrew.basis.records import Record, documents
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case

T = TypeVar("T")

#: Types of what is plain already.
_PLAIN = frozenset({float, int, bool, str, type(None)})
#: A part that is left out where it is None.
LEFT_OUT = "left out"
#: A part whose numbers are always finite.
FINITE = "finite"


class OneOf(NamedTuple):
    """The words that a text may be, where they are known at run time alone."""

    words: tuple[str, ...]


class Words(NamedTuple):
    """Meaning of a part, where its annotation comes from another class."""

    text: str


class Column(NamedTuple):
    """Said of a part that is a column of the tables in files: its heading."""

    heading: str


class Part(NamedTuple):
    """A part of an answer."""

    name: str
    annotation: Any
    #: The docstring of the property, or in a schema the comment above the field, up to its first full stop.
    words: str = ""

    @property
    def unit(self) -> str | None:
        """The SI unit of a number, or of all numbers of a mapping; None of other parts."""
        return unit_of(self.annotation)

    @property
    def meaning(self) -> str:
        """Meaning for people."""
        info = info_of(self.annotation)
        words = next((said.text for said in _said(self.annotation) if isinstance(said, Words)), self.words)
        return words if info is None else info.meaning

    @property
    def bare(self) -> Any:
        """The annotation without what is said of it, and without None."""
        return _bare(self.annotation)

    @property
    def may_be_none(self) -> bool:
        """True for a part that may be None."""
        return type(None) in get_args(_unwrapped(self.annotation))

    @property
    def left_out(self) -> bool:
        """True for a part that is left out where it is None."""
        return self._is(LEFT_OUT)

    @property
    def words_allowed(self) -> tuple[str, ...]:
        """The words that a text may be; none where it may be any."""
        return next((each.words for each in _said(self.annotation) if isinstance(each, OneOf)), ())

    @property
    def column(self) -> Column | None:
        """Its column in the tables in files; None of a part that has none."""
        return next((each for each in _said(self.annotation) if isinstance(each, Column)), None)

    @property
    def quantity(self) -> Quantity | None:
        """The number with its unit; None of parts whose unit is not declared."""
        unit = self.unit
        return None if unit is None else Quantity(self.name, unit, info_of(self.annotation) or Info("", self.meaning))

    @property
    def number(self) -> Any:
        """The type of its numbers in JSON."""
        return float if self._is(FINITE) else float | None

    def _is(self, what: str) -> bool:
        return what in _said(self.annotation)


def _said(annotation: Any) -> Sequence[Any]:
    """Everything that is said of an annotation beside its type."""
    return get_args(annotation)[1:] if get_origin(annotation) is Annotated else ()


def _unwrapped(annotation: Any) -> Any:
    return get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation


def _bare(annotation: Any) -> Any:
    inner = _unwrapped(annotation)
    if is_union(inner):
        several = [each for each in get_args(inner) if each is not type(None)]
        return _bare(several[0]) if len(several) == 1 else Union[tuple(several)]  # noqa: UP007  (made at run time)
    return inner


def origin_of(annotation: Any) -> Any:
    """The class behind an annotation, without its arguments; ``NDArray`` of NumPy 2.5 is a name of one."""
    kind = get_origin(annotation) or annotation
    meant = getattr(kind, "__value__", None)  # of ``type`` statements, which Python has from 3.12 on
    return kind if meant is None else get_origin(meant) or meant


def is_union(annotation: Any) -> bool:
    """True for an annotation with several types."""
    return isinstance(annotation, types.UnionType) or get_origin(annotation) is Union


@functools.cache
def parts_of(cls: type) -> Mapping[str, Part]:
    """The parts of an answer by name: fields, then public properties, those of a base class first."""
    parts: dict[str, Part] = {}
    has_parts = issubclass(cls, Declared)
    kinds: Any = (part,) if has_parts else (property, functools.cached_property)
    fields = [] if has_parts or not dataclasses.is_dataclass(cls) else [each.name for each in dataclasses.fields(cls)]
    names = set(getattr(cls, "_fields", fields))  # those of a named tuple, or of a dataclass
    if names:
        hints = get_type_hints(cls, include_extras=True)
        parts |= {name: Part(name, hint) for name, hint in hints.items() if name in names and not name.startswith("_")}
    for owner in reversed(cls.__mro__):
        for name, member in vars(owner).items():
            getter = member.fget if isinstance(member, property) else getattr(member, "func", None)
            if name.startswith("_") or getter is None or not isinstance(member, kinds):
                continue
            annotation = get_type_hints(getter, include_extras=True).get("return")
            parts[name] = Part(name, annotation, (getter.__doc__ or "").partition(".")[0])
    return parts


def described(cls: type) -> Mapping[str, Part]:
    """The parts of an answer by name, fields with the first sentence of the comment above them."""
    said = comments_of(cls)
    return {
        name: part._replace(words=said[name].partition(". ")[0]) if name in said else part
        for name, part in parts_of(cls).items()
    }


def is_answer(annotation: Any) -> bool:
    """True for a class that is an answer of its own."""
    return isinstance(annotation, type) and (
        dataclasses.is_dataclass(annotation) or hasattr(annotation, "_fields") or issubclass(annotation, Declared)
    )


_is_answer: Callable[[type], bool] = functools.cache(is_answer)


class Declared:
    """An answer whose parts are properties :class:`part`, whatever else it has."""


class part(lazy[T]):
    """A property that is a part of an answer, computed when it is first asked for."""


def table_of(quantities: Mapping[str, Quantity], *, of: Any = float, at_times: Container[str] = ()) -> type[Any]:
    """A base of answers: numbers that are declared elsewhere, or lists or answers ``of`` them.

    Those ``at_times`` are left out where they are None.
    """

    def annotated(one: Quantity) -> Any:
        said = (Unit(one.unit), one.info)
        return Annotated[of | None, *said, LEFT_OUT] if one.name in at_times else Annotated[of, *said]

    fields = [(name, annotated(one)) for name, one in quantities.items()]
    return dataclasses.make_dataclass("Numbers", fields, frozen=True, eq=False)


def parts_like(cls: type, *names: str) -> type[Any]:
    """A base of answers: the parts of these names, as another class declares them."""
    known = described(cls)
    fields = [(name, Annotated[known[name].annotation, Words(known[name].words)]) for name in names]
    return dataclasses.make_dataclass("Parts", fields, frozen=True, eq=False)


def cells(answer: Any, name: str = "", quantity: Quantity | None = None) -> Cells:
    """The parts of an answer that are declared as columns of files, by their headings after the ``name``.

    Numbers without a unit of their own are of the ``quantity``.
    """
    values: dict[str, tuple[Any, Quantity | None]] = {}
    for part in parts_of(type(answer)).values():
        if part.column is not None:
            value = getattr(answer, part.name)
            known = None if isinstance(value, bool) else part.quantity or quantity
            heading = f"{name} {part.column.heading}".strip().replace("_", " ")
            values[heading] = (int(value) if known is None else value, known)
    return values


def from_attributes(cls: type[T], *values: object, **others: Any) -> T:
    """An answer whose parts are the attributes by the same names of the first value that has them, but for others."""
    names = [name for name in parts_of(cls) if name not in others]
    return cls(**{name: getattr(_first_with(name, values), name) for name in names}, **others)


def _first_with(name: str, values: Sequence[object]) -> object:
    return next((value for value in values[:-1] if hasattr(value, name)), values[-1])


# -- document and units ---------------------------------------------------------------------------


def document(value: Any) -> Any:
    """An answer as plain tables, lists, numbers, truth values and texts, all in SI."""
    kind = type(value)
    if kind in _PLAIN:
        return value
    if _is_answer(kind):
        return dict(_items(value))
    if isinstance(value, Mapping):
        return {str(key): document(each) for key, each in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [document(each) for each in value]
    return value.item() if isinstance(value, np.generic) else value


def _items(answer: Any) -> Iterator[tuple[str, Any]]:
    for name, part in parts_of(type(answer)).items():
        value = getattr(answer, name)
        if value is not None or not part.left_out:
            yield name, document(value)


def attributes(value: Any, *names: str) -> dict[str, Any]:
    """Attributes of a value by name, as they stand in a document."""
    return {name: document(getattr(value, name)) for name in names}


def units(answer: Any) -> dict[str, Any]:
    """The SI units of the numbers of an answer, in tables like its document; parts without numbers are not in it."""
    values: dict[str, Any] = {}
    for name, part in parts_of(type(answer)).items():
        value = getattr(answer, name)
        unit = None if value is None and part.left_out else _units(part, value)
        if unit:
            values[name] = unit
    return values


def _units(part: Part, value: Any) -> Any:
    if part.unit is not None:
        return part.unit
    if _is_answer(type(value)):
        return units(value)
    kind, inner = origin_of(part.bare), get_args(part.bare)
    if is_answer(kind):
        return units_of(kind)
    if kind is Mapping:
        each = Part(part.name, inner[1])
        return {key: unit for key, one in (value or {}).items() if (unit := _units(each, one))}
    if kind is Sequence:
        return units_of(inner[0]) if is_answer(inner[0]) else unit_of(inner[0])
    return None


def units_of(cls: type) -> dict[str, Any]:
    """The SI units of the numbers of an answer of a class."""
    values = {name: _units(part, None) for name, part in parts_of(cls).items()}
    return {name: unit for name, unit in values.items() if unit}


# -- the document of an answer about a case -------------------------------------------------------


def envelope(
    case: Case,
    results: Any,
    *,
    named: str = "results",
    units: Mapping[str, str] | None = None,
    beside: Mapping[str, Any] | None = None,
    assumed: Iterable[str] | None = None,
    warnings: Iterable[Record] = (),
    verdicts: Iterable[Record] = (),
    checks: Iterable[Mapping[str, Any]] = (),
    sources: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """The document of an answer, in SI.

    ``units`` are those of numbers by other names than its own, ``beside`` are more answers by name, ``sources`` what
    else it rests on.
    """
    return {
        "inputs": descriptions.inputs(case),
        **numbers(**{named: results}, **(beside or {})),
        **({} if units is None else {"units": dict(units)}),
        **({} if assumed is None else {"assumed": list(assumed)}),
        "warnings": documents(warnings),
        "verdicts": documents(verdicts),
        "checks": list(checks),
        "provenance": {**descriptions.of_case(case), **(sources or {})},
    }


def numbers(**answers: Any) -> dict[str, Any]:
    """Answers by name, and the units of all: those of the results are not under their name."""
    by_name = {name: units(answer) for name, answer in answers.items()}
    return {
        **{name: document(answer) for name, answer in answers.items()},
        "units": by_name.pop("results", {}) | by_name,
    }
