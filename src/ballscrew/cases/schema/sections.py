"""The sections of a case in SI: every table validated once, before any part is built."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from ballscrew.basis.errors import Fault
from ballscrew.cases.schema.case_schema import NUT_TABLES, validated
from ballscrew.cases.schema.duty_schema import DUTY_TABLES, SUPPORT_TABLES

#: The sections with a schema, in the order of messages.
_VALIDATED = ("screw", "lubricant", "operation", "model", *NUT_TABLES, *DUTY_TABLES, *SUPPORT_TABLES)


@dataclasses.dataclass(frozen=True)
class Sections:
    """The tables of a case as they are written, their values in SI, and the errors in them."""

    tables: Mapping[str, Any]
    values: Mapping[str, dict[str, Any]]
    errors: Mapping[str, list[Fault]]

    def __contains__(self, name: str) -> bool:
        return name in self.tables

    def values_of(self, name: str, faults: list[Fault]) -> dict[str, Any]:
        """A copy of the values of a section; its errors are added to ``faults``."""
        faults += self.errors[name]
        return dict(self.values[name])


def validated_sections(tables: Mapping[str, Any]) -> Sections:
    """The tables with their values in SI. The section of the model may be left out."""
    values: dict[str, dict[str, Any]] = {}
    errors: dict[str, list[Fault]] = {}
    for name in _VALIDATED:
        if name in tables or name == "model":
            errors[name] = []
            values[name] = validated(name, tables.get(name, {}), errors[name])
    return Sections(tables, values, errors)
