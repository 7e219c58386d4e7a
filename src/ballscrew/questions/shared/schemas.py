"""The response models of answers in the API, from their annotations; and parts that several models have."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypeAlias, Union, get_args

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, create_model

from ballscrew.basis.errors import LINES_AT_MOST
from ballscrew.basis.quantities import unit_of
from ballscrew.questions.shared.declared import Part, described, is_answer, is_union, origin_of

#: A number; null where it is not finite.
Number: TypeAlias = float | None
Tables: TypeAlias = dict[str, Any]
Numbers: TypeAlias = dict[str, Number]


class Closed(BaseModel):
    """A table of these names and no others."""

    model_config = ConfigDict(extra="forbid")


class Open(BaseModel):
    """A table of at least these names."""

    model_config = ConfigDict(extra="allow")


def field(description: str = "", unit: str = "1", *, optional: bool = False) -> Any:
    """A field with its SI unit; an optional one is left out of the answer, it has no default."""

    def complete(schema: dict[str, Any]) -> None:
        schema.pop("default", None)
        if unit != "1":
            schema["x-si-unit"] = unit

    default: Any = None if optional else ...
    return Field(default, description=description or None, json_schema_extra=complete)


def model(name: str, meaning: str, base: type[BaseModel] = Closed, /, **fields: Any) -> type[BaseModel]:
    """A model whose fields are known from annotations elsewhere."""
    create: Any = create_model
    return create(name, __doc__=meaning, __base__=base, **fields)


def with_fields(base: type[BaseModel] = Closed, /, **fields: Any) -> Any:
    """A base of models, ``class Row(with_fields(…))``, whose fields are known from annotations elsewhere."""
    return model("Fields", "", base, **fields)


class FaultLine(Closed):
    """One fault, and the field that it names."""

    where: str = Field(description="section.field, and the part of it that is meant where it has several")
    path: str = Field(description="section.field")
    id: str = Field(description="the kind of fault, such as unknown; empty for most")
    text: str = Field(description="what is wrong, the value, the remedy")
    line: str = Field(description="the field and the text, as the command line prints them")
    problem: str = Field(description="what is wrong")
    given: str = Field(description="the value, empty where there is none")
    remedy: str = Field(description="what to do")


class Problem(Closed):
    """The reason why a request is refused (RFC 9457)."""

    type: Literal["about:blank"]
    title: str
    status: int = Field(ge=400, le=599)
    lines: list[str] = Field(max_length=LINES_AT_MOST, description="what the command line prints on its error stream")
    faults: list[FaultLine]


class Shown(Closed):
    """Text that people read of the results."""

    sheet: Tables = Field(description="the sheet, as the command prints it with --sheet")


class OfLogs(Shown):
    """Sheet and provenance beside results of logs; the provenance has their names and digests."""

    provenance: Tables


class Assumed(Shown):
    """Assumptions, in words."""

    assumed: list[str]


class Provenance(Closed):
    """Version, model and sources of an answer."""

    version: str
    model: str
    references: list[str]


class Record(Closed):
    """A verdict, a check or a warning."""

    id: str = Field(description="a stable name, such as validity.contact_pressure")
    subject: str = Field(description="the field or part that it concerns")
    value: Number = Field(description="SI")
    unit: str = Field(description="of the value and the limit")
    limit: Number = Field(description="SI")
    holds: bool | None
    severity: Literal["info", "warning", "error"]
    text: str = Field(description="a sentence for people")


class JudgedCheck(Record):
    """One check; null stands for what is not known."""

    name: str
    utilisation: Number = Field(description="share of the limit that is used: above 1 it fails")
    missing: str = Field(description="the input without which it is not judged; empty where it is")
    source: Literal["read", "recalled", "estimate"] = field(
        "kind of source of its formulas and its limit; left out where only given and computed numbers are compared",
        optional=True,
    )
    source_text: str | None = field(
        "the same in words beside the verdict; null where the source was read", optional=True
    )


class Drawing(Closed):
    """A drawing as SVG."""

    text: str


class CaseSchema(Open):
    """JSON Schema of a case file."""

    dialect: str = Field(alias="$schema")
    properties: Tables


class NeedSchema(Open):
    """JSON Schema of a need."""

    dialect: str = Field(alias="$schema")
    properties: Tables


def schema(cls: type, *, optional: bool = False) -> Any:
    """The response model of an answer: a name, a type and a description for each part.

    ``optional`` where each part of it may be left out.
    """
    return _schema(cls, optional)


@functools.cache
def _schema(cls: type, optional: bool) -> Any:
    fields = {name: _field(part, optional=optional) for name, part in described(cls).items()}
    return model(cls.__name__, _first_line(cls), Closed, **fields)


def with_answers(**parts: Any) -> Any:
    """A base of response models with answers as parts: a class, or a sequence of a class, for each name.

    A pair is the class with its field.
    """
    pairs = {name: part if isinstance(part, tuple) else (part, ...) for name, part in parts.items()}
    return with_fields(**{name: (_kind(Part(name, cls)), field) for name, (cls, field) in pairs.items()})


def response(cls: type, name: str, *, named: str = "results", judged: bool = False, beside: type | None = None) -> Any:
    """The response model of a document whose results are an answer, ``named`` so.

    ``judged`` where its checks are of a screw; ``beside`` is a model of what it has besides, or in another form.
    """
    base: Any = Shown if beside is None else beside
    fields = {
        "inputs": Tables,
        named: schema(cls),
        "units": Tables,
        "verdicts": list[Record],
        "checks": list[JudgedCheck if judged else Record],
        "warnings": list[Record],
        "provenance": Provenance,
    }
    own = {name: (kind, ...) for name, kind in fields.items() if name not in base.model_fields}
    return model(name, _first_line(cls), base, **own)


def _first_line(cls: type) -> str:
    return (cls.__doc__ or "").partition("\n")[0]


def _field(part: Part, *, optional: bool = False) -> tuple[Any, Any]:
    # what may be left out has a default, which the description does not show
    unit = part.unit or _unit_within(part.bare) or "1"
    says_unit = unit == "1" or not part.meaning or f", {unit}" in part.meaning
    words = part.meaning if says_unit else f"{part.meaning}, SI"
    kind = _kind(part)
    return (kind | None if part.may_be_none else kind, field(words, unit, optional=optional or part.left_out))


def _unit_within(annotation: Any) -> str | None:
    """The unit of the numbers in a sequence or a mapping; None of others."""
    return next((unit for each in get_args(annotation) if (unit := unit_of(each) or _unit_within(each))), None)


def _kind(part: Part) -> Any:
    kind, inner = origin_of(part.bare), get_args(part.bare)
    if part.words_allowed:
        return Literal[part.words_allowed]
    if kind is Mapping:
        return dict[str, _kind(Part("", inner[1]))]
    if kind is np.ndarray:
        return list[part.number]
    if kind is Sequence:
        return list[part.number if unit_of(inner[0]) or inner[0] is float else _kind(Part("", inner[0]))]
    if is_union(part.bare):
        return Union[tuple(_kind(Part("", each)) for each in inner)]  # noqa: UP007  (made at run time)
    if is_answer(kind):
        return schema(kind)
    return part.number if part.unit is not None or kind is float else part.bare  # or a truth value, or texts
