"""The columns of a log, declared once: what each heading is taken for, and what may be fitted to it; SI."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.files.tables.headings import NO_COLUMN
from ballscrew.files.torque_logs.columns import COLUMNS
from ballscrew.files.torque_logs.preview import Preview, SeenColumn
from ballscrew.questions.fit.compute import Candidate
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import from_attributes


class KnownColumn(NamedTuple):
    """A column that a log may have."""

    name: str
    meaning: str
    #: SI.
    unit: str
    shown_in: str
    required: bool


class FreeNumber(NamedTuple):
    """A number that may be fitted."""

    name: str
    meaning: str
    symbol: str
    #: SI.
    unit: str
    shown_in: str
    #: In the case, SI.
    value: float


class LogColumns(NamedTuple):
    """The columns of a log, and what may be fitted to it."""

    file: str
    #: Of a moving axis: ballscrew fit takes it, this address does not.
    moving: bool
    columns: Sequence[SeenColumn]
    more_columns: int
    #: Values that count in every row, SI.
    constants: Mapping[str, float]
    known: Sequence[KnownColumn]
    #: Columns that are needed and not there.
    missing: Sequence[str]
    #: Numbers that are usually uncertain.
    free: Sequence[FreeNumber]


def document(preview: Preview, candidates: Sequence[Candidate], *, moving: bool) -> dict[str, Any]:
    """The columns of a file, the columns that a log may have, and the numbers that may be fitted."""
    answer = from_attributes(
        LogColumns,
        preview,
        moving=moving,
        known=[
            KnownColumn(column.name, quantity.info.meaning, quantity.unit, quantity.shown_in, column.required)
            for column in COLUMNS
            if (quantity := column.quantity) is not None
        ],
        missing=[fault.column for fault in preview.faults if fault.id == NO_COLUMN],
        free=[
            FreeNumber(name, quantity.info.meaning, quantity.info.symbol, quantity.unit, quantity.shown_in, value)
            for name, quantity, value in candidates
        ],
    )
    faults = [{**fault.document(), "column": fault.column} for fault in preview.faults]
    return {**declared.document(answer), "faults": faults}
