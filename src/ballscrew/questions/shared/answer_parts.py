"""Parts of the response models that several answers share."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, create_model

from ballscrew.basis.errors import LINES_AT_MOST

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
    """What people read of the results."""

    sheet: Tables = Field(description="the sheet, as the command prints it with --sheet")


class OfLogs(Shown):
    """What stands beside results of logs: their names and digests are in the provenance."""

    provenance: Tables


class Assumed(Shown):
    """What is assumed, in words."""

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


class Said(Closed):
    """What is said of results, and what they rest on."""

    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance


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
