"""A sheet in a file: as tables (.csv has one, a workbook .xlsx all), in the units of headings, or as a picture.

Pictures are .png, .svg and .pdf.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.output.sheet import Cell, Column, Columns, Number, Share, Sheet, Table
from ballscrew.questions.shared import charts, every_row
from ballscrew.questions.shared.every_row import write_csv, xlsx_bytes

_DIGITS = 12


class RowTable(NamedTuple):
    """Headings, and the cells of each row below them."""

    headings: Sequence[str]
    rows: Sequence[Sequence[Any]]


def write_tables(to: Path, sheet: Sheet, name: str = "") -> None:
    """Write .xlsx (all tables) or .csv, whole or not at all.

    CSV has the table of a name, or else the first, of columns where there are some.
    """
    with atomic_write("--to", to) as path:
        if to.suffix.lower() == ".xlsx":
            path.write_bytes(xlsx_bytes({block.name: _lines(block) for block in sheet.of_kind(Table, Columns)}))
        else:
            named = [block for block in sheet.of_kind(Columns, Table) if block.name == name]
            first, *_ = [*named, *sheet.of_kind(Columns), *sheet.of_kind(Table)]
            write_csv(path, _lines(first))


def rows_of(block: Table | Columns) -> RowTable:
    """A block as headings and rows of plain numbers and texts."""
    columns = list(_of_columns(block) if isinstance(block, Columns) else _of_table(block))
    rows = zip(*(values for _, values in columns), strict=True)
    return RowTable([heading for heading, _ in columns], [list(row) for row in rows])


def _lines(block: Table | Columns) -> list[Sequence[Any]]:
    table = rows_of(block)
    return [table.headings, *table.rows]


def _of_columns(block: Columns) -> Iterator[tuple[str, Sequence[Any]]]:
    for column in block.columns:
        if column.quantity is None:
            yield column.name, column.values
        else:
            yield units.heading(column.quantity, column.name), _numbers(column)


def _numbers(column: Column) -> list[float | None]:
    assert column.quantity is not None
    return [_plain(value) for value in np.asarray(units.from_si(np.asarray(column.values, float), column.quantity))]


def _plain(value: float) -> float | None:
    return float(f"{value:.{_DIGITS}g}") + 0.0 if math.isfinite(value) else None


def _of_table(table: Table) -> Iterator[tuple[str, Sequence[Any]]]:
    """The columns of a table: one unit in the heading, or a column of units where rows have their own."""
    for index, name in enumerate(table.columns):
        cells = [row[index] for row in table.rows]
        quantities = {(cell.quantity.unit, cell.quantity.shown_in) for cell in cells if isinstance(cell, Number)}
        heading = name or table.name
        if len(quantities) == 1:
            quantity = next(cell.quantity for cell in cells if isinstance(cell, Number))
            heading = units.heading(quantity, heading)
        yield heading, [_value(cell) for cell in cells]
        if any(isinstance(cell, Number | Share) and cell.band for cell in cells):
            for end, word in enumerate(("from", "to")):
                yield f"{heading} {word}", [_end(cell, end) for cell in cells]
        if len(quantities) > 1:
            yield "unit", [units.label(cell.quantity) if isinstance(cell, Number) else None for cell in cells]


def _value(cell: Cell) -> Any:
    match cell:
        case Number(value, quantity):
            return _plain(float(units.from_si(value, quantity)))
        case Share(value):
            return _plain(value)
        case _:
            return cell


def _end(cell: Cell, end: int) -> float | None:
    if not isinstance(cell, Number | Share) or cell.band is None:
        return None
    return _value(dataclasses.replace(cell, value=cell.band[end]))


def check(paths: Iterable[Path], own_kinds: Sequence[str] = ()) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for files that could not be written later.

    ``own_kinds`` are kinds of files that a question writes beside tables and pictures.
    """
    *others, last = (*every_row.KINDS, *charts.SUFFIXES, *own_kinds)
    remedy = f"end it in {', '.join(others)} or {last}"
    unknown = [path for path in paths if path.suffix.lower() not in (*others, last)]
    raise_if_any([Fault("--to", "unknown kind of file", str(path), remedy) for path in unknown])
    for path in paths:
        if path.suffix.lower() in own_kinds:
            check_writable("--to", path)
        elif path.suffix.lower() in every_row.KINDS:
            every_row.check_path(path)
        else:
            charts.check_picture(path)


def write(to: Path, sheet: Sheet, name: str = "", option: str = "--to") -> None:
    """Write one file, whole or not at all: .csv has the columns of a name, or the first; ``option`` asks for it."""
    if to.suffix.lower() in every_row.KINDS:
        write_tables(to, sheet, name)
    else:
        from ballscrew.faces.sheets import pictures  # matplotlib is slow to import

        charts.draw(lambda: pictures.picture(sheet), to, option)
