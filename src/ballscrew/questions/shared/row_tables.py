"""Tables with a row for each screw as CSV or XLSX, numbers in the units of their headings."""

from __future__ import annotations

import csv
import importlib.util
import io
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Quantity
from ballscrew.questions.shared.declared import parts_of

_DIGITS = 12
#: Endings of files that are written.
KINDS = (".csv", ".xlsx")


class RowTable(NamedTuple):
    """Headings, and the cells of each row below them."""

    headings: Sequence[str]
    rows: Sequence[Sequence[Any]]


#: A cell, by its heading.
Cells = dict[str, Any]


def put(cells: Cells, quantity: Quantity, value: Any, name: str | None = None) -> None:
    """Put a number into its column, in the display unit; none where it is not finite."""
    number = None if value is None else float(units.from_si(float(value), quantity))
    shown = None if number is None or not math.isfinite(number) else float(f"{number:.{_DIGITS}g}") + 0.0
    cells[units.heading(quantity, name)] = shown


def put_columns(cells: Cells, answer: Any, name: str = "", quantity: Quantity | None = None) -> None:
    """Put the parts of an answer that are declared as columns into theirs, headings after the ``name``.

    Numbers without a unit of their own are of the ``quantity``.
    """
    for part in parts_of(type(answer)).values():
        if part.column is None:
            continue
        value, words = getattr(answer, part.name), f"{name} {part.column.heading}".strip()
        known = part.quantity or quantity
        if known is None or isinstance(value, bool):
            cells[words.replace("_", " ")] = int(value)
        else:
            put(cells, known, value, words)


def of_cells(rows: Sequence[Cells]) -> RowTable:
    """Rows that need not have the same columns; those of the first come first."""
    headings = list(dict.fromkeys(heading for cells in rows for heading in cells))
    return RowTable(headings, [[cells.get(heading) for heading in headings] for cells in rows])


# -- files ----------------------------------------------------------------------------------------


def check_path(to: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for a file that could not be written later."""
    if to.suffix.lower() not in KINDS:
        raise InputError(Fault("--to", "unknown kind of file", str(to), "end it in .csv or .xlsx"))
    if to.suffix.lower() == ".xlsx" and importlib.util.find_spec("xlsxwriter") is None:
        raise InputError(Fault("--to", "needs xlsxwriter", str(to), 'pip install "ballscrew[data]"'))
    check_writable("--to", to)


def write(to: Path, table: RowTable, sheet: str = "screws") -> None:
    """Write .csv or .xlsx, with a sheet of that name, whole or not at all."""
    with atomic_write("--to", to) as path:
        if to.suffix.lower() == ".xlsx":
            path.write_bytes(xlsx_bytes({sheet: table}))
            return
        write_csv(path, table)


def write_csv(path: Path, table: RowTable) -> None:
    """The rows of a table as CSV, below its headings."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([table.headings, *table.rows])


def xlsx_bytes(tables: Mapping[str, RowTable]) -> bytes:
    """A workbook with a sheet for each table, by title."""
    import xlsxwriter

    buffer = io.BytesIO()
    workbook = xlsxwriter.Workbook(buffer, {"in_memory": True})
    bold = workbook.add_format({"bold": True})
    for title, table in tables.items():
        sheet = workbook.add_worksheet(title)
        sheet.freeze_panes(1, 1)
        for number, row in enumerate([table.headings, *table.rows]):
            sheet.write_row(number, 0, row, bold if number == 0 else None)
        sheet.autofit()
    workbook.close()
    return buffer.getvalue()
