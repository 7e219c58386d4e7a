"""Records of a result: verdicts, checks and warnings of every document.

Terminal, page, report and API read the fields; the text is for people to read and for no program to parse.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any, Literal

Severity = Literal["info", "warning", "error"]


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
