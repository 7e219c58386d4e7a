"""Response models of the API for schemas of what people write."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.shared.answer_parts import (
    Open,
    Tables,
)


class CaseSchema(Open):
    """JSON Schema of a case file."""

    dialect: str = Field(alias="$schema")
    properties: Tables


class NeedSchema(Open):
    """JSON Schema of a need."""

    dialect: str = Field(alias="$schema")
    properties: Tables
