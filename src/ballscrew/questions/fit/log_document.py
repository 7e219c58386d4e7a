"""The columns of a log as a document: what each heading is taken for, and what may be fitted to it; SI."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.files.tables.headings import NO_COLUMN
from ballscrew.files.torque_logs.columns import COLUMNS
from ballscrew.files.torque_logs.preview import Preview
from ballscrew.questions.fit.compute import Candidate


def document(found: Preview, candidates: Sequence[Candidate], *, moving: bool) -> dict[str, Any]:
    """The columns of a file, the columns that a log may have, and the numbers that may be fitted."""
    return {
        "file": found.file,
        "moving": moving,
        "columns": [
            {
                "heading": one.heading, "bare_heading": one.bare_heading, "taken_for": one.taken_for,
                "unit": one.unit, "cells": list(one.cells),
            }
            for one in found.columns
        ],
        "more_columns": found.more_columns,
        "constants": dict(found.constants),
        "known": [
            {
                "name": column.name,
                "meaning": column.quantity.info.meaning,
                "unit": column.quantity.unit,
                "shown_in": column.quantity.shown_in,
                "required": column.required,
            }
            for column in COLUMNS
            if column.quantity is not None
        ],
        "missing": [fault.column for fault in found.faults if fault.id == NO_COLUMN],
        "free": [
            {
                "name": one.name, "meaning": one.quantity.info.meaning, "symbol": one.quantity.info.symbol,
                "unit": one.quantity.unit, "shown_in": one.quantity.shown_in, "value": one.value,
            }
            for one in candidates
        ],
        "faults": [
            {**fault.document(), "column": fault.column}
            for fault in found.faults
        ],
    }  # fmt: skip
