"""A nut of one's own as people write it: a few numbers by their names in catalogues, with their units."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from typing import Any

from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any
from ballscrew.cases.screw_tables.catalogue import COLUMNS
from ballscrew.cases.screw_tables.nut_kinds import kind_in
from ballscrew.files.tables import cells, headings
from ballscrew.files.tables.cells import Share, shown, text_of, value_of
from ballscrew.files.tables.headings import NOTHING, Column, Heading
from ballscrew.physics.sizing.own_nut import OwnNut, completed

#: Where faults say that they are.
WHERE = "own-nut"
#: What stands for the source of a row that has none.
SOURCE = "numbers of one's own"
#: Columns of a table that one nut has: it has no log, and no maker whose standard seals are known.
_COLUMNS = {
    column.name: dataclasses.replace(
        column, words={word: meant for word, meant in column.words.items() if meant != headings.STANDARD}
    )
    for column in COLUMNS
    if column.name != "log"
}
#: The numbers that no nut can do without, as people may write them.
_EXAMPLES = {"nominal_diameter": "d0=40 mm", "lead": "lead=10 mm", "turns": "turns=2x2.5"}


def own_nut_of(numbers: Mapping[str, Any]) -> OwnNut:
    """The nut of numbers as people write them: ``{"d0": "40 mm", "lead": "10 mm", "turns": "2x2.5", "Ca": "52 kN"}``.

    A name is that of a field of a row or one that catalogues have for it, in English or German. Raises
    :class:`~ballscrew.basis.errors.InputError` with all faults.
    """
    values: dict[str, Any] = {}
    faults: list[Fault] = []
    decimal = cells.evidence(text for text in numbers.values() if isinstance(text, str))
    for name, given in numbers.items():
        column = _column(name)
        if column is None:
            remedy = nearest(name, [*_COLUMNS, "d0", "Ph", "Ca", "Dw"])
            faults.append(Fault(f"{WHERE}.{name}", "unknown number of a nut", "", remedy))
            continue
        where = f"{WHERE}.{column.name}"
        if column.name in values:
            faults.append(Fault(where, "is given twice", name, "leave one out"))
            continue
        text = shown(given)
        if text in NOTHING:
            continue
        value = _value(where, given, text, column, decimal)
        if isinstance(value, Fault):
            faults.append(value)
        else:
            values[column.name] = value
    missing = [name for name in _EXAMPLES if name not in values and not any(_is_of(fault, name) for fault in faults)]
    faults += [Fault(f"{WHERE}.{name}", "is missing", "", _example(name)) for name in missing]
    raise_if_any(faults)
    try:
        return completed(_fields(values))
    except InputError as error:
        # of the row and of its screw, which have the same fields: here they are those of the nut
        raise InputError(*(_here(fault) for fault in error.faults)) from None


def numbers_in(text: str) -> dict[str, str]:
    """The numbers of a text, ``d0=40 mm, lead=10 mm``.

    Raises :class:`~ballscrew.basis.errors.InputError` for a part that is no NAME=VALUE.
    """
    numbers: dict[str, str] = {}
    for part in filter(None, map(str.strip, re.split(r"[,;](?!\d)", text))):
        name, equals, value = part.partition("=")
        name = name.strip()
        if not equals or not name or name in numbers:
            problem = "is given twice" if name in numbers else "is no NAME=VALUE"
            raise InputError(Fault(WHERE, problem, part, 'write "d0=40 mm, lead=10 mm, turns=5"'))
        numbers[name] = value.strip()
    return numbers


def _column(name: str) -> Column | None:
    """The column of that name, if one alone has it."""
    if name in _COLUMNS:
        return _COLUMNS[name]
    values = [column for column in _COLUMNS.values() if column.answers_to(name)]
    return values[0] if len(values) == 1 else None


def _value(where: str, given: Any, text: str, column: Column, decimal: frozenset[str]) -> Any:
    """A number in SI, a text, or the fault in it."""
    if isinstance(given, bool):
        given = text = headings.YES if given else headings.NO
    heading = Heading(column.name, column, 0, in_table=False)
    if column.quantity is None:
        return text_of(where, text, heading)
    return value_of(where, given, text, heading, decimal)


def _fields(values: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a row of these values."""
    fields: dict[str, Any] = {"name": "own nut", "source": SOURCE, **values}
    if fields.get("ball_diameter") == headings.ESTIMATED:
        del fields["ball_diameter"]
    if isinstance(fields.get("preload"), Share):
        fields["preload_share"] = float(fields.pop("preload"))
    if fields.get("seal_torque") == headings.NONE:
        fields["seal_torque"] = 0.0
    if "spacer_balls" in fields:
        fields["spacer_balls"] = fields["spacer_balls"] == headings.YES
    if "nut" in fields:
        fields["nut"] = kind_in(fields["nut"])
    return fields


def _is_of(fault: Fault, name: str) -> bool:
    return fault.where == f"{WHERE}.{name}"


def _here(fault: Fault) -> Fault:
    return dataclasses.replace(fault, where=f"{WHERE}.{fault.where.rpartition('.')[2]}")


def _example(name: str) -> str:
    return f"give it, for example {_EXAMPLES[name]}"
