"""All that is judged of a screw at an operating point: verdicts, warnings of the model, and checks, as tables.

The interface is three things. :data:`JUDGED` is the rows: each has an id, templates, and the names of what it ``needs``
(values), of its ``words``, and of what it gives. :func:`judged` is all formulas at once, from named values in SI to
masks and numbers: call it with numbers for one point, with arrays for many, or on a tape, and make outputs of what it
returns (:func:`outputs`). :func:`documents` is the tables as they stand in JSON, from which another program fills
sentences.

The names of values and words are explained in :mod:`ballscrew.physics.friction.verdicts` and
:mod:`ballscrew.physics.sizing.check_table`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis import records
from ballscrew.basis.records import Judgement
from ballscrew.physics.friction.verdicts import VERDICTS, WARNINGS
from ballscrew.physics.sizing.check_table import CHECKS, NOT_CHECKED

#: All rows: verdicts, warnings and checks, each group in the order in which it is said.
JUDGED: tuple[Judgement, ...] = (*VERDICTS, *WARNINGS, *CHECKS)


def judged(values: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """The masks and numbers of each row by its id, of those whose needs are among the values.

    A value that is None is not given. Numbers are in SI; truth values are masks, and a number that stands for one is to
    be compared with zero first. The ids are those of :data:`JUDGED`, and what a row gives is named in its document,
    ``masks`` and ``numbers``: see :mod:`ballscrew.basis.records` for the names that are the same in all rows.
    """
    return records.judged(JUDGED, values)


def outputs(result: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """What :func:`judged` returns under one name each, ``check.buckling:value``, as outputs of a recording."""
    return {f"{row}:{name}": value for row, of_row in result.items() for name, value in of_row.items()}


def documents() -> dict[str, Any]:
    """The tables as they stand in JSON, without their formulas.

    A row ``needs`` values by name, and ``takes`` others that may be left out: numbers are NaN then, and ``truths``
    false. Its formula gives ``masks`` and ``numbers`` by name.

    A row of ``verdicts`` and ``warnings`` is a record wherever its mask ``said`` holds, or always where it has none. A
    row of ``checks`` is one always: where a need is not given its sentence is ``not_checked`` with ``give`` of the row
    as ``input``, and where its mask ``judged`` is false it has a value, and neither limit nor truth. Of the
    ``sentences`` of a row, and of a choice that stands in one, the first counts whose mask ``said`` holds, or that has
    none. A record is of ``severity``; where its mask ``holds`` is false, of ``severity_of_failure`` if there is one. In
    a sentence a ``number`` is shown in the unit ``shown_in`` (from ``unit``) with so many ``digits`` or ``decimals``,
    ``words`` are given, and a ``constant`` stands as it is.
    """
    tables = {"verdicts": VERDICTS, "warnings": WARNINGS, "checks": CHECKS}
    values: dict[str, Any] = {name: [row.document() for row in rows] for name, rows in tables.items()}
    return values | {"not_checked": NOT_CHECKED}
