"""Tables people bring: CSV or spreadsheets in their own words and units, checked rows in SI out.

As in case files, a dimensional value needs a unit: in its heading (:mod:`ballscrew.files.tables.headings`) or
behind the number, which comes first.

Every row is either good or has a fault that names file, row, column and value: none is lost silently.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.files.tables import cells
from ballscrew.files.tables.cells import shown, text_of, value_of
from ballscrew.files.tables.headings import NOTHING, Column, Heading, checked, headings_in, known_heading_of, unused
from ballscrew.files.tables.sheets import Record, records

T = TypeVar("T")


@dataclasses.dataclass(frozen=True, eq=False)
class Row:
    """A good row: its number in the file, values in SI (or text) by column, and the same as written."""

    line: int
    values: Mapping[str, Any]
    written: Mapping[str, str]


@dataclasses.dataclass(frozen=True, eq=False)
class Table:
    """The rows of a file, good ones and the faults of the others (with the number of the row)."""

    file: str
    headings: Mapping[str, Heading]
    rows: Sequence[Row]
    faults: Sequence[tuple[int, Fault]]
    #: How many rows there are, good or not.
    count: int
    #: Headings of columns that are not used.
    unused: Sequence[str]

    def where(self, line: int, name: str) -> str:
        """``screws.csv row 7, column "Ph [mm]"``."""
        column = f'column "{self.headings[name].written}"' if name in self.headings else name.replace("_", " ")
        return f"{self.file} row {line}, {column}"

    def fault(self, row: Row, fault: Fault) -> Fault:
        """The fault of what was made of a row, in the words of the row."""
        name = fault.where.rpartition(".")[2]
        heading = self.headings.get(name)
        given = row.written.get(name, fault.given)
        if heading is not None and heading.column.quantity is not None:
            fault = units.in_display_units(fault, heading.column.quantity, given)
        return dataclasses.replace(fault, where=self.where(row.line, name), given=given)


def read(path: Path, columns: Sequence[Column]) -> Table:
    """The table of a file. Raises :class:`~ballscrew.basis.errors.InputError` for faults of the table as a whole."""
    result = records(path, lambda cell: known_heading_of(cell, 0, columns) is not None)
    start, matched = headings_in(path, result, columns)
    body = result[start + 1 :]
    headings = checked(path, matched, result[start], body, columns)
    if not body:
        raise InputError(Fault(str(path), "has no rows below its headings", "", "give one row a screw or value"))
    table = Table(
        path.name, {h.column.name: h for h in headings}, (), (), len(body), unused(result[start], headings, body)
    )
    decimal = cells.evidence(_texts(headings, body))
    rows: list[Row] = []
    faults: list[tuple[int, Fault]] = []
    for record in body:
        row = _row(table, record, result[start].cells, decimal)
        if isinstance(row, Row):
            rows.append(row)
        else:
            faults += [(record.line, fault) for fault in row]
    return dataclasses.replace(table, rows=rows, faults=faults)


def made(table: Table, make: Callable[[Row], T], keep_going: bool = False) -> tuple[list[T], list[str]]:
    """The good rows as ``make`` converts them, and the faults of the others, one line each.

    Faults that ``make`` raises are faults of the row. Raises :class:`~ballscrew.basis.errors.InputError` if there
    is any fault; with ``keep_going`` only if no row is good.
    """
    values: list[T] = []
    faults = list(table.faults)
    for row in table.rows:
        try:
            values.append(make(row))
        except InputError as error:
            faults += [(row.line, table.fault(row, fault)) for fault in error.faults]
    ordered = [fault for _, fault in sorted(faults, key=lambda numbered: numbered[0])]
    if not (keep_going and values):
        raise_if_any(ordered)
    lines = [str(fault) for fault in ordered]
    if ordered:
        lines.append(f"{table.file}: {table.count - len(values)} of {table.count} rows left out")
    if table.unused:
        lines.insert(0, f"{table.file}: columns not used: {', '.join(table.unused)}")
    return values, lines


# -- cells ----------------------------------------------------------------------------------------


def _texts(headings: Sequence[Heading], body: Sequence[Record]) -> Iterator[str]:
    """The cells that are numbers as text."""
    places = [heading.place for heading in headings if heading.column.quantity is not None]
    for record in body:
        yield from (
            cell for cell in (record.cells[p] for p in places if p < len(record.cells)) if isinstance(cell, str)
        )


def _row(table: Table, record: Record, first: Sequence[Any], decimal: frozenset[str]) -> Row | list[Fault]:
    """A row in SI, or all its faults."""
    needed = max(place for place, cell in enumerate(first) if cell != "") + 1
    if len(record.cells) < needed or any(cell != "" for cell in record.cells[len(first) :]):
        problem = f"has {len(record.cells)} cells, the headings {needed}"
        remedy = "give every column a cell, be it empty; put quotes around text that holds a delimiter"
        return [Fault(f"{table.file} row {record.line}", problem, "", remedy)]
    values: dict[str, Any] = {}
    written: dict[str, str] = {}
    faults: list[Fault] = []
    for name, heading in table.headings.items():
        where, cell = table.where(record.line, name), record.cells[heading.place]
        text = shown(cell)
        if text in NOTHING:
            if heading.column.required:
                faults.append(Fault(where, "is empty", "", "give a value; of merged cells only the first has one"))
            continue
        value = (
            text_of(where, text, heading)
            if heading.column.quantity is None
            else value_of(where, cell, text, heading, decimal)
        )
        if isinstance(value, Fault):
            faults.append(value)
        else:
            values[name], written[name] = value, text
    return faults or Row(record.line, values, written)
